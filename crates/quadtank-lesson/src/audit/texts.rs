//! The texts of a lesson: languages, links, formulas and live values.

use super::{Audit, FaultKind, Named, place_of};
use crate::{
    Block, Formula, Lesson, LiveValue, Place, Span, TaskKind, Text, bench_ids, bench_names, named_formula,
    parse_markdown,
};

/// Longest quotation of a text (characters).
const LONGEST_QUOTATION: usize = 40;

/// How markup begins, and what it looks like.
const MARKS: [(&str, &str); 5] = [
    ("{value:", "a live value is {value:name|unit} or {value:name|unit|digits}, with 1 to 9 digits"),
    ("{formula:", "a formula by name is {formula:name}"),
    ("](", "a link is [words](glossary:name), [words](bench:name) or [words](lesson:name)"),
    (
        "$",
        "a formula stands between two signs $ and has letters, digits, signs, _{}, ^{}, \\frac{}{}, \\sqrt{}, \\text{} and \\value{}{}",
    ),
    ("**", "bold words stand between ** and **, in one paragraph"),
];

impl Audit<'_> {
    pub fn texts(&mut self) {
        for (place, text) in texts(self.lesson) {
            for &tongue in &self.lesson.languages {
                match text.get(tongue) {
                    None => self.add(&place, FaultKind::NoText(tongue)),
                    Some(text) => self.markup(&format!("{place}.{}", tongue.tag()), text),
                }
            }
        }
    }

    fn markup(&mut self, place: &str, text: &str) {
        for block in parse_markdown(text) {
            let spans = match block {
                Block::Paragraph(spans) => spans,
                Block::List { items, .. } => items.into_iter().flatten().collect(),
                Block::Formula(formula) => vec![Span::Formula(formula)],
            };
            for span in spans {
                self.span(place, span);
            }
        }
    }

    fn span(&mut self, place: &str, span: Span) {
        match span {
            Span::Plain(text) => self.plain(place, &text),
            Span::Bold(words) => self.words(place, &words),
            Span::Link(words, target) => {
                self.words(place, &words);
                self.target(place, &target);
            }
            Span::Value(LiveValue { quantity, unit, .. }) => self.quantity(place, &quantity, &unit),
            Span::Formula(formula) => self.formula(place, &formula),
        }
    }

    fn words(&mut self, place: &str, words: &str) {
        if MARKS.iter().any(|(mark, _)| words.contains(mark)) {
            self.add(place, FaultKind::Nested(words.chars().take(LONGEST_QUOTATION).collect()));
        }
    }

    /// What looks like markup and is none was meant to be some.
    fn plain(&mut self, place: &str, text: &str) {
        for (mark, meant) in MARKS {
            let Some((before, after)) = text.split_once(mark) else { continue };
            let inside = after.split_once('}').map(|(inside, _)| inside);
            if let ("{formula:", Some(name)) = (mark, inside.filter(|name| named_formula(name).is_none())) {
                self.unknown(place, Named::Formula, name, &[]);
                continue;
            }
            // Of a link the words are before the mark.
            let from = if mark == "](" { before.rfind('[').unwrap_or(before.len()) } else { before.len() };
            let text = text[from..].chars().take(LONGEST_QUOTATION).collect();
            self.add(place, FaultKind::Markup { text, meant });
        }
    }

    fn target(&mut self, place: &str, target: &Place) {
        match target {
            Place::Glossary(name) if !self.terms.contains(&name.as_str()) => {
                self.unknown(place, Named::Word, name, &[]);
            }
            Place::Bench(name) if bench_names(name).is_none() => {
                self.unknown(place, Named::Bench, name, &bench_ids());
            }
            Place::Lesson(name) if !self.lessons.contains(&name.as_str()) => {
                self.unknown(place, Named::Lesson, name, &[]);
            }
            _ => {}
        }
    }

    fn formula(&mut self, place: &str, formula: &Formula) {
        match formula {
            Formula::Value(quantity, unit) => self.quantity(place, quantity, unit),
            Formula::Row(parts) => parts.iter().for_each(|part| self.formula(place, part)),
            Formula::Fraction(parts) => parts.iter().for_each(|part| self.formula(place, part)),
            Formula::Root(part) => self.formula(place, part),
            Formula::Scripts { base, below, above } => {
                let parts = [Some(base), below.as_ref(), above.as_ref()];
                parts.into_iter().flatten().for_each(|part| self.formula(place, part));
            }
            Formula::Symbol(_) | Formula::Number(_) | Formula::Sign(_) | Formula::Words(_) => {}
        }
    }
}

/// All texts of a lesson with their places.
fn texts(lesson: &Lesson) -> Vec<(String, &Text)> {
    let mut texts = vec![("title".to_owned(), &lesson.title), ("summary".to_owned(), &lesson.summary)];
    texts.extend(numbered("outcomes", &lesson.outcomes));
    texts.extend(numbered("misconceptions", &lesson.misconceptions));
    for (index, step) in lesson.steps.iter().enumerate() {
        let place = format!("steps[{index}]");
        texts.push((format!("{place}.title"), &step.title));
        texts.push((format!("{place}.text"), &step.text));
        for task in &step.tasks {
            let place = place_of(index, task);
            texts.push((format!("{place}.question"), &task.question));
            texts.extend(numbered(&format!("{place}.hints"), &task.hints));
            texts.extend(kind_texts(&format!("{place}.kind"), &task.kind));
        }
        texts.extend(step.after.iter().map(|text| (format!("{place}.after"), text)));
    }
    texts
}

fn numbered<'a>(place: &str, texts: impl IntoIterator<Item = &'a Text>) -> Vec<(String, &'a Text)> {
    texts.into_iter().enumerate().map(|(index, text)| (format!("{place}[{index}]"), text)).collect()
}

/// Texts that are a field of the entries of a list.
fn fields<'a>(place: &str, field: &str, texts: impl IntoIterator<Item = &'a Text>) -> Vec<(String, &'a Text)> {
    numbered(place, texts).into_iter().map(|(place, text)| (format!("{place}.{field}"), text)).collect()
}

fn kind_texts<'a>(place: &str, kind: &'a TaskKind) -> Vec<(String, &'a Text)> {
    match kind {
        TaskKind::Predict(predict) => numbered(&format!("{place}.predict.options"), &predict.options),
        TaskKind::Choose(choose) => {
            let place = format!("{place}.choose.options");
            let mut texts = fields(&place, "text", choose.options.iter().map(|option| &option.text));
            texts.extend(fields(&place, "feedback", choose.options.iter().map(|option| &option.feedback)));
            texts
        }
        TaskKind::Number(number) => {
            let place = format!("{place}.number.mistakes");
            fields(&place, "feedback", number.mistakes.iter().map(|mistake| &mistake.feedback))
        }
        TaskKind::Achieve(goal) => {
            let place = format!("{place}.achieve");
            let labels = goal.conditions.iter().map(|condition| &condition.label);
            let mut texts = fields(&format!("{place}.conditions"), "label", labels);
            let feedback = goal.attempts.iter().map(|attempt| &attempt.feedback);
            texts.extend(fields(&format!("{place}.attempts"), "feedback", feedback));
            texts
        }
        TaskKind::Order(order) => numbered(&format!("{place}.order.items"), &order.items),
        TaskKind::Explain(explain) => vec![(format!("{place}.explain.model"), &explain.model)],
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::sample::{faults, lesson};

    /// What is wrong with the text of the second step.
    fn told(text: &str) -> Vec<String> {
        let place = "steps[1].text.en: ";
        let told = faults(&[("/steps/1/text/en", json!(text))]);
        told.into_iter()
            .map(|fault| fault.strip_prefix(place).unwrap_or_else(|| panic!("{fault}")).to_owned())
            .collect()
    }

    #[test]
    fn every_text_is_there_in_every_language() {
        let lesson = lesson();
        let texts = super::texts(&lesson);
        assert_eq!(texts.len(), 35);
        let mut places: Vec<_> = texts.iter().map(|(place, _)| place).collect();
        places.dedup();
        assert_eq!(places.len(), texts.len());
        let more = faults(&[("/languages", json!(["en", "pt-BR", "es"]))]);
        assert_eq!(more.len(), texts.len());
        assert!(more.iter().all(|fault| fault.ends_with(": no text in pt-BR")), "{more:?}");
        let pointers = [
            ("/title/es", "title"),
            ("/outcomes/0/es", "outcomes[0]"),
            ("/steps/0/after/es", "steps[0].after"),
            ("/steps/0/tasks/1/hints/1/es", "steps[0].tasks[zero].hints[1]"),
            (
                "/steps/0/tasks/1/kind/number/mistakes/2/feedback/es",
                "steps[0].tasks[zero].kind.number.mistakes[2].feedback",
            ),
            (
                "/steps/1/tasks/0/kind/achieve/conditions/1/label/es",
                "steps[1].tasks[left].kind.achieve.conditions[1].label",
            ),
            ("/steps/1/tasks/2/kind/choose/options/1/text/es", "steps[1].tasks[why].kind.choose.options[1].text"),
            ("/steps/1/tasks/4/kind/explain/model/es", "steps[1].tasks[words].kind.explain.model"),
        ];
        for (pointer, place) in pointers {
            for empty in [json!(null), json!(""), json!(" \n")] {
                assert_eq!(faults(&[(pointer, empty)]), [format!("{place}: no text in es")]);
            }
        }
    }

    #[test]
    fn a_text_may_have_all_markup_and_plain_signs() {
        let all = "A [word](glossary:zero), [bench](bench:relay-tuning), [lesson](lesson:windup).\n\n1. **bold**\n2. {value:run.iae_sum|cm s|4}\n\n\
                   $\\frac{γ_1}{2}$ 2 * 3 < 4 & 5 > 1 [1] (2) {3}";
        assert_eq!(told(all), [""; 0]);
    }

    #[test]
    fn links_lead_somewhere() {
        assert_eq!(told("[x](glossary:zer)"), ["unknown word of the glossary `zer`"]);
        assert_eq!(told("[x](lesson:none)"), ["unknown lesson `none`"]);
        let benches = "quadruple-tank, relay-tuning, model-free, level-loop";
        assert_eq!(told("[x](bench:none)"), [format!("unknown bench `none`; there are {benches}")]);
        let link = "a link is [words](glossary:name), [words](bench:name) or [words](lesson:name)";
        for broken in ["[x](https://example.org)", "[x](javascript:alert(1))", "[x](glossary)"] {
            assert_eq!(told(&format!("See {broken}")), [format!("`{broken}` is no markup: {link}")]);
        }
    }

    #[test]
    fn values_and_formulas_exist() {
        assert_eq!(told("{value:zero.right|1/s}"), ["unknown quantity `zero.right`"]);
        assert_eq!(told("$\\value{zero.right}{1/s}$"), ["unknown quantity `zero.right`"]);
        assert_eq!(told("$\\frac{1}{\\sqrt{x_{\\value{none}{1}}}}$"), ["unknown quantity `none`"]);
        let unit = "the unit `m` does not fit a quantity in `1/s`, but `1/s`, `1/min`";
        assert_eq!(told("{value:zero.rightmost|m}"), [unit]);
        assert_eq!(told("{formula:zero-lines}"), ["unknown formula `zero-lines`"]);
    }

    #[test]
    fn what_looks_like_markup_is_some() {
        let begins = |text: &str, quoted: &str| {
            let told = told(text);
            assert_eq!(told.len(), 1, "{told:?}");
            assert!(told[0].starts_with(&format!("`{quoted}` is no markup: ")), "{told:?}");
        };
        begins("See {value:zero.rightmost}.", "{value:zero.rightmost}.");
        begins("{value:zero.rightmost|1/s|12}", "{value:zero.rightmost|1/s|12}");
        begins("Costs 5 $ a day", "$ a day");
        begins("$\\script$", "$\\script$");
        begins("One **bold", "**bold");
        begins(&format!("**{}", "x".repeat(100)), &format!("**{}", "x".repeat(38)));
    }

    #[test]
    fn bold_words_and_words_of_a_link_have_no_markup_of_their_own() {
        for (text, words) in [
            ("**[zero](glossary:zero)**", "[zero](glossary:zero)"),
            ("**{value:valves.sum|1}**", "{value:valves.sum|1}"),
            ("[**zero**](glossary:zero)", "**zero**"),
        ] {
            let told = told(text);
            assert_eq!(
                told,
                [format!("`{words}` stands inside bold words or the words of a link, where no other markup is read")]
            );
        }
    }

    #[test]
    fn a_name_that_is_wrong_in_two_texts_is_told_for_each() {
        let text = json!({ "en": "[x](glossary:no) [y](glossary:no)", "es": "[x](glossary:no)" });
        let word = "unknown word of the glossary `no`";
        assert_eq!(
            faults(&[("/steps/1/tasks/1/question", text)]),
            [format!("steps[1].tasks[sum].question.en: {word}"), format!("steps[1].tasks[sum].question.es: {word}")]
        );
    }
}

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

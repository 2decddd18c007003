//! The markup of texts in lessons. Everything that is not markup is plain text, whatever it looks like.

use super::{Formula, named_formula, parse_formula};

/// A paragraph or list.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph.
    Paragraph(Vec<Span>),
    /// A list, of which the items are numbered or not.
    List {
        /// Whether its items have numbers.
        numbered: bool,
        /// Its items.
        items: Vec<Vec<Span>>,
    },
    /// A formula on a line of its own.
    Formula(Formula),
}

/// A part of a paragraph.
#[derive(Clone, Debug, PartialEq)]
pub enum Span {
    /// Plain text.
    Plain(String),
    /// Bold text.
    Bold(String),
    /// A link.
    Link(String, Place),
    /// A live value.
    Value(LiveValue),
    /// A formula.
    Formula(Formula),
}

/// Where a link leads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// To a word of the glossary.
    Glossary(String),
    /// To a bench.
    Bench(String),
    /// To a lesson.
    Lesson(String),
}

/// A quantity of the present state of the bench.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LiveValue {
    /// Its name.
    pub quantity: String,
    /// The unit in which it is shown.
    pub unit: String,
    /// Significant digits, 1 to 9.
    pub digits: u8,
}

/// Reads a text.
pub fn parse_markdown(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    for paragraph in text.split("\n\n") {
        let mut lines = Vec::new();
        for line in paragraph.lines().map(str::trim).filter(|line| !line.is_empty()) {
            match item(line) {
                None => lines.push(line),
                Some((numbered, inside)) => {
                    end_paragraph(&mut lines, &mut blocks);
                    add_item(&mut blocks, numbered, spans(inside));
                }
            }
        }
        end_paragraph(&mut lines, &mut blocks);
    }
    blocks
}

fn end_paragraph(lines: &mut Vec<&str>, blocks: &mut Vec<Block>) {
    if lines.is_empty() {
        return;
    }
    let mut inside = spans(&lines.join(" "));
    lines.clear();
    blocks.push(match (inside.len(), inside.first_mut()) {
        (1, Some(Span::Formula(formula))) => Block::Formula(formula.clone()),
        _ => Block::Paragraph(inside),
    });
}

fn add_item(blocks: &mut Vec<Block>, numbered: bool, item: Vec<Span>) {
    match blocks.last_mut() {
        Some(Block::List { numbered: same, items }) if *same == numbered => items.push(item),
        _ => blocks.push(Block::List { numbered, items: vec![item] }),
    }
}

/// What an item of a list holds, and whether the list is numbered.
fn item(line: &str) -> Option<(bool, &str)> {
    let numbered = || {
        let (number, rest) = line.split_once(". ")?;
        (!number.is_empty() && number.len() <= 2 && number.chars().all(|c| c.is_ascii_digit())).then_some((true, rest))
    };
    line.strip_prefix("- ").map(|rest| (false, rest)).or_else(numbered)
}

fn spans(text: &str) -> Vec<Span> {
    let mut spans = Vec::new();
    let mut plain = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        if let Some((span, length)) = marked(rest) {
            if !plain.is_empty() {
                spans.push(Span::Plain(std::mem::take(&mut plain)));
            }
            spans.push(span);
            rest = &rest[length..];
        } else {
            plain.push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    if !plain.is_empty() {
        spans.push(Span::Plain(plain));
    }
    spans
}

/// The part with markup with which a text begins, and its length in bytes.
fn marked(text: &str) -> Option<(Span, usize)> {
    let between = |open: &str, close: &str| {
        let inside = text.strip_prefix(open)?;
        let end = inside.find(close)?;
        (end > 0).then(|| (&inside[..end], open.len() + end + close.len()))
    };
    if let Some((inside, length)) = between("**", "**") {
        return Some((Span::Bold(inside.to_owned()), length));
    }
    if let Some((inside, length)) = between("$", "$") {
        return Some((Span::Formula(parse_formula(inside)?), length));
    }
    // The values inside a formula in braces do not nest, so the first brace ends it.
    if let Some((inside, length)) = between("{value:", "}") {
        return Some((Span::Value(live_value(inside)?), length));
    }
    if let Some((inside, length)) = between("{formula:", "}") {
        return Some((Span::Formula(named_formula(inside)?), length));
    }
    let (label, length) = between("[", "](")?;
    let target_end = text[length..].find(')')?;
    let place = place(&text[length..length + target_end])?;
    Some((Span::Link(label.to_owned(), place), length + target_end + 1))
}

fn live_value(inside: &str) -> Option<LiveValue> {
    let mut parts = inside.split('|');
    let (quantity, unit) = (parts.next()?.to_owned(), parts.next()?.to_owned());
    let digits =
        parts.next().map_or(Some(3), |digits| digits.parse().ok().filter(|digits| (1..=9).contains(digits)))?;
    parts.next().is_none().then_some(LiveValue { quantity, unit, digits })
}

fn place(target: &str) -> Option<Place> {
    let (kind, name) = target.split_once(':')?;
    match kind {
        "glossary" => Some(Place::Glossary(name.to_owned())),
        "bench" => Some(Place::Bench(name.to_owned())),
        "lesson" => Some(Place::Lesson(name.to_owned())),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(text: &str) -> Span {
        Span::Plain(text.to_owned())
    }

    #[test]
    fn paragraphs_lists_and_formulas_are_blocks() {
        let blocks = parse_markdown("One\nline.\n\n- a\n- **b**\n\n{formula:zero-line}\n\n1. first");
        let bold = Span::Bold("b".to_owned());
        assert_eq!(blocks[0], Block::Paragraph(vec![plain("One line.")]));
        assert_eq!(blocks[1], Block::List { numbered: false, items: vec![vec![plain("a")], vec![bold]] });
        assert!(matches!(blocks[2], Block::Formula(_)));
        assert_eq!(blocks[3], Block::List { numbered: true, items: vec![vec![plain("first")]] });
    }

    #[test]
    fn links_and_values_are_spans() {
        let blocks = parse_markdown("The [zero](glossary:zero) is at {value:zero.rightmost|1/s|4}.");
        let value = LiveValue { quantity: "zero.rightmost".to_owned(), unit: "1/s".to_owned(), digits: 4 };
        let link = Span::Link("zero".to_owned(), Place::Glossary("zero".to_owned()));
        let expected = vec![plain("The "), link, plain(" is at "), Span::Value(value), plain(".")];
        assert_eq!(blocks, [Block::Paragraph(expected)]);
    }

    #[test]
    fn what_is_no_markup_stays_text() {
        for text in
            ["<b onclick=\"x\">", "[x](javascript:alert(1))", "2 * 3 ** 4", "{value:x}", "$\\script$ is 5", "a](b)"]
        {
            assert_eq!(parse_markdown(text), [Block::Paragraph(vec![plain(text)])], "{text}");
        }
    }
}

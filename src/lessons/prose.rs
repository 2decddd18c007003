//! Texts of lessons as views: their markup, live values and formulas. A text can never become markup of the page.

use leptos::prelude::*;
use quadtank_lesson::{Block, Formula, LiveValue, Place, Span, Values, parse_markdown};

use super::classroom::{Present, use_classroom};
use super::place;
use crate::glossary::TermLink;
use crate::lab::{Lab, use_lab};

/// A text with its markup.
#[component]
pub fn Prose(
    /// The text.
    #[prop(into)]
    text: Signal<String>,
) -> impl IntoView {
    move || parse_markdown(&text.get()).into_iter().map(block).collect_view()
}

/// A text of one paragraph, for a label or a line.
pub fn inline(text: &str) -> Vec<AnyView> {
    let paragraph = |block| match block {
        Block::Paragraph(spans) => spans,
        Block::List { items, .. } => items.into_iter().flatten().collect(),
        Block::Formula(formula) => vec![Span::Formula(formula)],
    };
    parse_markdown(text).into_iter().flat_map(paragraph).map(span).collect()
}

fn block(block: Block) -> AnyView {
    let line = |spans: Vec<Span>| spans.into_iter().map(span).collect_view();
    match block {
        Block::Paragraph(spans) => view! { <p>{line(spans)}</p> }.into_any(),
        Block::List { numbered: false, items } => {
            let items = items.into_iter().map(|item| view! { <li>{line(item)}</li> }).collect_view();
            view! { <ul>{items}</ul> }.into_any()
        }
        Block::List { numbered: true, items } => {
            let items = items.into_iter().map(|item| view! { <li>{line(item)}</li> }).collect_view();
            view! { <ol>{items}</ol> }.into_any()
        }
        Block::Formula(shown) => view! { <div class="formula"><math>{formula(shown)}</math></div> }.into_any(),
    }
}

fn span(span: Span) -> AnyView {
    match span {
        Span::Plain(text) => text.into_any(),
        Span::Bold(text) => view! { <b>{text}</b> }.into_any(),
        Span::Formula(shown) => view! { <math>{formula(shown)}</math> }.into_any(),
        Span::Value(value) => view! { <b class="live">{live(value)}</b> }.into_any(),
        Span::Link(text, Place::Glossary(key)) => view! { <TermLink key text /> }.into_any(),
        Span::Link(text, Place::Bench(id)) => link(text, format!("?bench={id}")),
        Span::Link(text, Place::Lesson(id)) => link(text, place::lesson_address(&id)),
    }
}

fn link(text: String, href: String) -> AnyView {
    view! { <a href=href target="_blank" rel="noopener">{text}</a> }.into_any()
}

/// How a unit is written; nothing for a ratio.
pub fn unit_name(lab: Lab, unit: &str) -> String {
    if matches!(unit, "1" | "yes/no") { String::new() } else { (lab.bench.get().unit_name)(lab, unit) }
}

/// A value with its unit as it is written; a dash where there is none.
pub fn written(lab: Lab, value: Option<f64>, unit: &str, digits: u8) -> String {
    let Some(value) = value else { return "–".to_owned() };
    let number = lab.number_style().significant(value, usize::from(digits));
    let unit = unit_name(lab, unit);
    if unit.is_empty() { number } else { format!("{number}\u{a0}{unit}") }
}

fn live(LiveValue { quantity, unit, digits }: LiveValue) -> impl Fn() -> String {
    let (lab, room) = (use_lab(), use_classroom());
    let still = use_context::<Still>();
    move || {
        room.lesson.track();
        let value = || Present(lab).shown(&quantity, &unit);
        let is_still = still.is_some_and(|Still(is_still)| is_still.get());
        let value = if is_still { untrack(value) } else { value() };
        written(lab, value, &unit, digits)
    }
}

/// Whether live values do not follow the bench any more.
#[derive(Clone, Copy)]
pub struct Still(pub RwSignal<bool>);

fn formula(shown: Formula) -> AnyView {
    match shown {
        Formula::Row(parts) => {
            let parts = parts.into_iter().map(formula).collect_view();
            view! { <mrow>{parts}</mrow> }.into_any()
        }
        Formula::Symbol(text) => view! { <mi>{text}</mi> }.into_any(),
        Formula::Number(text) => {
            let lab = use_lab();
            let localised = move || text.replace('.', &lab.number_style().decimal.to_string());
            view! { <mn>{localised}</mn> }.into_any()
        }
        Formula::Sign(text) if "()[]|".contains(&text) => view! { <mo stretchy="false">{text}</mo> }.into_any(),
        Formula::Sign(text) => view! { <mo>{text}</mo> }.into_any(),
        Formula::Words(text) => view! { <mtext>{text}</mtext> }.into_any(),
        Formula::Value(quantity, unit) => {
            let value = live(LiveValue { quantity, unit, digits: 3 });
            view! { <mn class="live">{value}</mn> }.into_any()
        }
        Formula::Fraction(parts) => {
            let [above, below] = *parts;
            view! { <mfrac>{formula(above)}{formula(below)}</mfrac> }.into_any()
        }
        Formula::Root(part) => view! { <msqrt>{formula(*part)}</msqrt> }.into_any(),
        Formula::Scripts { base, below: Some(below), above: Some(above) } => {
            view! { <msubsup>{formula(*base)}{formula(*below)}{formula(*above)}</msubsup> }.into_any()
        }
        Formula::Scripts { base, below: Some(below), above: None } => {
            view! { <msub>{formula(*base)}{formula(*below)}</msub> }.into_any()
        }
        Formula::Scripts { base, above: Some(above), .. } => {
            view! { <msup>{formula(*base)}{formula(*above)}</msup> }.into_any()
        }
        Formula::Scripts { base, .. } => formula(*base),
    }
}

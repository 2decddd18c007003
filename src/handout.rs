//! What is printed: the experiment on white paper, with its pictures, its numbers, its link and the code of that.

use leptos::prelude::*;
use qrcodegen::{QrCode, QrCodeEcc};
use quadtank_figure::{Palette, Size, Style, to_svg};
use quadtank_scenario::{Entry, EntryValue, Label};

use super::canvas;
use super::lab::{Lab, use_lab};
use super::share::address_of;
use super::texts::{say, tr};

/// Width and height of a printed picture (CSS px).
const PICTURE: Size = Size { width: 470.0, height: 350.0 };
/// Digits of printed numbers.
const DIGITS: usize = 6;

/// What is printed, as it is when printing begins.
#[derive(Clone, Debug, PartialEq)]
struct Content {
    title: String,
    label: Label,
    date: String,
    /// Each picture as SVG, with what it says.
    pictures: Vec<(String, String)>,
    entries: Vec<Entry>,
    /// The link, unless the experiment is too long for one.
    link: Option<String>,
}

impl Content {
    fn of(lab: Lab) -> Self {
        let bench = lab.bench.get();
        let style = Style { palette: Palette::LIGHT, decimal: lab.number_style().decimal, scale: canvas::FINE };
        let picture = |figure: super::lab::Figure| {
            let says = figure.summary.get();
            (figure.picture.visit(|charts| to_svg(charts, PICTURE, &style, "", &says)), says)
        };
        Self {
            title: (bench.title)(lab),
            label: (bench.label)(lab),
            date: today(lab),
            pictures: lab.shown_figures().into_iter().map(picture).collect(),
            entries: (bench.entries)(lab),
            link: address_of(lab).ok(),
        }
    }
}

/// The date, as the language writes it.
fn today(lab: Lab) -> String {
    let options = js_sys::Object::new();
    // An object takes any property.
    let _ = js_sys::Reflect::set(&options, &"dateStyle".into(), &"long".into());
    js_sys::Date::new_0().to_locale_date_string(lab.language.get().tag(), &options).into()
}

/// Prints the experiment.
pub fn print() {
    // It closes the menu first.
    set_timeout(
        || {
            let _ = window().print();
        },
        std::time::Duration::from_millis(50),
    );
}

/// The handout: made when printing begins, and on paper alone.
#[component]
pub fn Handout() -> impl IntoView {
    let lab = use_lab();
    let content = RwSignal::new(None::<Content>);
    let before = window_event_listener_untyped("beforeprint", move |_| content.set(Some(untrack(|| Content::of(lab)))));
    let after = window_event_listener_untyped("afterprint", move |_| content.set(None));
    on_cleanup(move || {
        before.remove();
        after.remove();
    });
    view! { <article class="handout" data-testid="handout">{move || content.get().map(|content| page(lab, content))}</article> }
}

/// A number without the zeros at its end.
fn plain(lab: Lab, number: f64) -> String {
    let style = lab.number_style();
    let text = style.significant(number, DIGITS);
    let is_whole_or_power = !text.contains(style.decimal) || text.contains('e');
    if is_whole_or_power { text } else { text.trim_end_matches('0').trim_end_matches(style.decimal).to_owned() }
}

fn page(lab: Lab, content: Content) -> impl IntoView {
    let Content { title, label, date, pictures, entries, link } = content;
    let heading = if label.name.is_empty() { title.clone() } else { label.name };
    let code = link.as_deref().and_then(code);
    let pictures = pictures.into_iter().map(|(svg, says)| {
        view! { <figure><div inner_html=svg></div><figcaption>{says}</figcaption></figure> }
    });
    let rows = entries.into_iter().map(|Entry { path, value, unit }| {
        let value = match value {
            EntryValue::Number(number) => plain(lab, number),
            EntryValue::Choice(name) => name,
        };
        view! { <li><code>{path}</code>" "<b>{value}</b>" "{unit}</li> }
    });
    view! {
        <header>
            <div>
                <h1>{heading}</h1>
                <p>{format!("Quadtank · {title} · {date}")}</p>
                <p class="note">{label.note}</p>
            </div>
            {code}
        </header>
        <div class="pictures">{pictures.collect_view()}</div>
        <h2>{say!(lab, handout.numbers)}</h2>
        <ul>{rows.collect_view()}</ul>
        <p class="link">{link.unwrap_or_else(|| tr!(lab, handout.no_link))}</p>
    }
}

/// The code of a link, for the camera of a phone.
fn code(link: &str) -> Option<impl IntoView + use<>> {
    let code = QrCode::encode_text(link, QrCodeEcc::Low).ok()?;
    let dark = (0..code.size()).flat_map(|y| (0..code.size()).map(move |x| (x, y)));
    let squares = dark.filter(|&(x, y)| code.get_module(x, y)).map(|(x, y)| format!("M{x} {y}h1v1h-1z"));
    let (path, border) = (squares.collect::<String>(), 4);
    let side = code.size() + 2 * border;
    Some(view! {
        <svg class="code" viewBox=format!("-{border} -{border} {side} {side}") shape-rendering="crispEdges" aria-hidden="true">
            <path d=path />
        </svg>
    })
}

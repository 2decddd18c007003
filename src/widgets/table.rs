//! Tables of figures. Their content is made anew whenever texts are updated; Leptos compares it with what stands there and
//! touches only the cells that changed.

use leptos::prelude::*;

/// A table that may be wider than its place.
#[component]
pub fn Figures(
    /// Name for tests.
    name: &'static str,
    /// What it shows, for those who do not see it.
    #[prop(into)]
    caption: Signal<String>,
    /// Its content.
    children: Children,
) -> impl IntoView {
    view! {
        <div class="scroll" tabindex="0" role="region" aria-label=caption>
            <table class="plain" data-testid=name>{children()}</table>
        </div>
    }
}

/// Whether the fold of a `toggle` event is open. Two clicks in a row may make one event, so that counting events goes wrong.
pub fn is_open(event: &leptos::ev::Event) -> bool {
    event_target::<web_sys::Element>(event).has_attribute("open")
}

/// A table that is folded away, and worked out only while it is open.
#[component]
pub fn Folded(
    /// Name for tests.
    id: &'static str,
    /// What is folded away.
    #[prop(into)]
    summary: Signal<String>,
    /// What the table shows, for those who do not see it.
    #[prop(into)]
    caption: Signal<String>,
    /// The content of the table.
    #[prop(into)]
    content: ViewFn,
    /// What can be done with it.
    #[prop(optional)]
    children: Option<Children>,
) -> impl IntoView {
    let open = RwSignal::new(false);
    view! {
        <details class="more" on:toggle=move |event| open.set(is_open(&event))>
            <summary data-testid=id>{summary}</summary>
            {children.map(|children| children())}
            <div class="scroll" tabindex="0" role="region" aria-label=caption>
                <table class="plain">{move || open.get().then(|| content.run())}</table>
            </div>
        </details>
    }
}

/// Caption, headings of the columns, and rows.
#[component]
pub fn TableContent(
    /// What the table shows, for those who do not see it.
    #[prop(into)]
    caption: String,
    /// Headings of the columns.
    columns: Vec<String>,
    /// Its rows.
    rows: Vec<AnyView>,
) -> impl IntoView {
    view! {
        <Caption text=caption />
        <thead><Headings texts=columns /></thead>
        <tbody>{rows}</tbody>
    }
}

/// A caption for those who do not see the table.
#[component]
pub fn Caption(
    /// What it says.
    #[prop(into)]
    text: String,
) -> impl IntoView {
    view! { <caption class="visually-hidden">{text}</caption> }
}

/// A row of headings of columns.
#[component]
pub fn Headings(
    /// One for each column.
    texts: Vec<String>,
) -> impl IntoView {
    let headings = texts.into_iter().map(|text| view! { <th scope="col">{text}</th> }).collect_view();
    view! { <tr>{headings}</tr> }
}

/// A row with a heading.
#[component]
pub fn Row(
    /// Class of the heading: the colour of a loop.
    #[prop(optional, into)]
    class: String,
    /// The heading.
    #[prop(into)]
    name: String,
    /// Its figures.
    #[prop(into)]
    figures: Vec<String>,
) -> impl IntoView {
    view! { <tr><th scope="row" class=class>{name}</th><Cells texts=figures /></tr> }
}

/// Plain cells of a row.
#[component]
pub fn Cells(
    /// One for each cell.
    texts: Vec<String>,
) -> impl IntoView {
    texts.into_iter().map(|text| view! { <td>{text}</td> }).collect_view()
}

/// What stands in a cell: a figure, or why there is none.
#[derive(Clone, Debug, PartialEq)]
pub enum Figure {
    /// The figure as it is shown.
    Shown(String),
    /// Why there is none: shown as a dash, with the reason for the pointer and for screen readers.
    None(String),
}

/// Cells with figures, some of which may be missing for a reason.
#[component]
pub fn FigureCells(
    /// One for each cell.
    figures: Vec<Figure>,
) -> impl IntoView {
    let cells = figures.into_iter().map(|figure| {
        let (text, why) = match figure {
            Figure::Shown(text) => (text, None),
            Figure::None(why) => ("–".to_owned(), Some(why)),
        };
        let hidden = why.is_some().then_some("true");
        let spoken = why.clone().map(|why| view! { <span class="visually-hidden">{why}</span> });
        view! { <td title=why><span aria-hidden=hidden>{text}</span>{spoken}</td> }
    });
    cells.collect_view()
}

/// A row with a heading, some of whose figures may be missing for a reason.
#[component]
pub fn ReasonedRow(
    /// Class of the heading: the colour of a loop.
    #[prop(optional, into)]
    class: String,
    /// The heading.
    #[prop(into)]
    name: String,
    /// Its figures.
    figures: Vec<Figure>,
) -> impl IntoView {
    view! { <tr><th scope="row" class=class>{name}</th><FigureCells figures /></tr> }
}

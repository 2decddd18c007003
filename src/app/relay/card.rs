//! What the four steps have in common: a picture with its settings beside it, and a verdict below.

use leptos::prelude::*;

use crate::app::widgets::html::rich;
use crate::app::widgets::{ChartCanvas, ChartMenu, Picture};
use crate::figure::Frame;

/// A step of the bench.
pub struct Step {
    /// Class of the card, and the beginning of its names for tests.
    pub name: &'static str,
    /// Its number.
    pub number: u8,
    /// Its title.
    pub title: Signal<String>,
    /// What stands beside the title.
    pub toolbar: AnyView,
    /// Its charts.
    pub picture: Picture,
    /// Where they stand.
    pub frames: RwSignal<Vec<Frame>>,
    /// Class of their place.
    pub place: &'static str,
    /// What lies over them.
    pub overlay: AnyView,
    /// The settings.
    pub settings: AnyView,
    /// What came out, and whether all is well.
    pub verdict: Signal<(bool, String)>,
    /// What is folded away below.
    pub below: Vec<AnyView>,
}

/// A step as a card. One function for all, so that it is compiled once.
pub fn card(step: Step) -> AnyView {
    let Step { name, number, title, toolbar, picture, frames, place, overlay, settings, verdict, below } = step;
    // Read in three places, worked out once.
    let verdict = Memo::new(move |_| verdict.get());
    let summary = Signal::derive(move || verdict.get().1.replace("**", ""));
    let class = Signal::derive(move || if verdict.get().0 { "verdict" } else { "verdict warm" }.to_owned());
    let text = Signal::derive(move || rich(&verdict.get().1));
    let heading = format!("{name}-title");
    let labelled_by = heading.clone();
    view! {
        <section class=format!("card {name}") aria-labelledby=labelled_by>
            <header>
                <h2 id=heading>{Signal::derive(move || format!("{number} · {}", title.get()))}</h2>
                {toolbar}
                <ChartMenu picture=picture.clone() file=name title />
            </header>
            <div class="step">
                <div class=place>
                    <ChartCanvas picture frames summary name />
                    {overlay}
                </div>
                <div class="settings">{settings}</div>
            </div>
            <div class=class role="status" data-testid=format!("{name}-verdict")><p inner_html=text></p></div>
            <div class="folded">{below}</div>
        </section>
    }
    .into_any()
}

/// A table that may be wider than its place.
pub fn figures(name: &'static str, caption: Signal<String>, content: Signal<String>) -> AnyView {
    view! {
        <div class="scroll" tabindex="0" role="region" aria-label=caption>
            <table class="plain" data-testid=name inner_html=content></table>
        </div>
    }
    .into_any()
}

/// A grey remark beside a title.
pub fn remark(text: Signal<String>) -> AnyView {
    view! { <span class="remark">{text}</span> }.into_any()
}

/// Settings that are there only sometimes.
pub fn hideable(class: &'static str, hidden: Signal<bool>, content: Vec<AnyView>) -> AnyView {
    view! { <div class=class hidden=hidden>{content}</div> }.into_any()
}

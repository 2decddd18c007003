//! What the four steps have in common: a picture with its settings beside it, and a verdict below.

use leptos::prelude::*;

use crate::widgets::html::{element, rich};
use crate::widgets::{self, ChartCanvas, ChartMenu, Picture};
use quadtank_figure::Frame;

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
    let found = Memo::new(move |_| verdict.get());
    let summary = Signal::derive(move || found.get().1.replace("**", ""));
    let warm = Signal::derive(move || !found.get().0);
    let text = Signal::derive(move || element("p", "", &rich(&found.get().1)));
    let heading = Signal::derive(move || format!("{number} · {}", title.get()));
    let menu = view! { <ChartMenu picture=picture.clone() file=name title /> }.into_any();
    let content = view! {
        <div class="step">
            <div class=place>
                <ChartCanvas picture frames summary name />
                {overlay}
            </div>
            <div class="settings">{settings}</div>
        </div>
        {widgets::verdict(format!("{name}-verdict"), warm, text)}
        <div class="folded">{below}</div>
    };
    widgets::card(name, heading, vec![toolbar, menu], vec![content.into_any()])
}

/// Settings that are there only sometimes.
pub fn hideable(class: &'static str, hidden: Signal<bool>, content: Vec<AnyView>) -> AnyView {
    view! { <div class=class hidden=hidden>{content}</div> }.into_any()
}

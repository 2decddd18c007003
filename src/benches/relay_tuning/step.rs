//! What the four steps have in common: a picture with its settings beside it, and a verdict below.

use leptos::prelude::*;

use super::guide;
use super::mends::{Offer, Offers};
use super::session::use_session;
use crate::session::Panel;
use crate::widgets::{Card, ChartCanvas, ChartMenu, Picture, Text, Verdict, marked, unmarked};
use quadtank_figure::Frame;

/// A step of the bench as a card. Its children are the settings.
#[component]
pub fn Step(
    /// Class of the card, and the beginning of its names for tests.
    name: &'static str,
    /// Its name in an address.
    panel: Panel,
    /// Its number.
    number: u8,
    /// Its title.
    #[prop(into)]
    title: Signal<String>,
    /// What stands beside the title.
    #[prop(into)]
    toolbar: ViewFnOnce,
    /// Its charts.
    picture: Picture,
    /// Where they stand.
    frames: RwSignal<Vec<Frame>>,
    /// Class of their place.
    #[prop(default = "chart")]
    place: &'static str,
    /// What lies over them.
    #[prop(into)]
    overlay: ViewFnOnce,
    /// What came out, and whether all is well.
    #[prop(into)]
    verdict: Signal<(bool, String)>,
    /// What mends it, where it is a warning.
    #[prop(optional, into)]
    offers: Signal<Vec<Offer>>,
    /// What is folded away below.
    #[prop(optional, into)]
    below: ViewFnOnce,
    /// Explanations of the words in it.
    terms: &'static [Text],
    /// The settings.
    children: Children,
) -> impl IntoView {
    // Read in three places, worked out once.
    let found = Memo::new(move |_| verdict.get());
    let heading = Signal::derive(move || format!("{number} · {}", title.get()));
    let for_menu = picture.clone();
    let beside = move || view! { {toolbar.run()}<ChartMenu picture=for_menu file=name title /> };
    let hidden = guide::is_closed(use_session(), number);
    // The first step shows what there is before anything is switched on.
    let hidden = Signal::derive(move || number > 1 && hidden.get());
    view! {
        <Card name panel title=heading beside terms hidden>
            <div class="step">
                <div class=place>
                    <ChartCanvas picture frames summary=Signal::derive(move || unmarked(&found.get().1)) name steady=true />
                    {overlay.run()}
                </div>
                <div class="settings">{children()}</div>
            </div>
            <Verdict id=format!("{name}-verdict") warm=Signal::derive(move || !found.get().0)>
                <p>{move || marked(&found.get().1)}</p>
                <Offers offers />
            </Verdict>
            <div class="folded">{below.run()}</div>
        </Card>
    }
}

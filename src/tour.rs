//! A short tour of the home bench: one thing after the other is framed and explained.

use leptos::html::Button;
use leptos::prelude::*;

use super::lab::{Lab, use_lab};
use super::texts::{say, tr};

/// What is shown at a stop, and where it is: the first of these that the present view has.
struct Stop {
    at: &'static str,
    text: fn(Lab) -> String,
}

const STOPS: [Stop; 5] = [
    Stop { at: "#bench :is(.bigrig, .process)", text: |lab| tr!(lab, tour.rig) },
    Stop { at: "#bench :is(.map, .plane)", text: |lab| tr!(lab, tour.valves) },
    Stop { at: "#bench :is(.levels, .responses)", text: |lab| tr!(lab, tour.levels) },
    Stop { at: "#bench :is(.whom, .rga)", text: |lab| tr!(lab, tour.pairing) },
    Stop { at: "#app .top", text: |lab| tr!(lab, tour.page) },
];

/// The class of what a stop is about.
const FRAMED: &str = "framed";

/// Shows the tour, from its first stop on.
pub fn begin(lab: Lab) {
    lab.large.set(None);
    lab.tour.set(Some(0));
}

/// The explanation of the present stop; nothing while there is no tour.
#[component]
pub fn Tour() -> impl IntoView {
    let lab = use_lab();
    let next = NodeRef::<Button>::new();
    let is_above = RwSignal::new(false);
    Effect::new(move || {
        let stop = lab.tour.get().and_then(|index| STOPS.get(index));
        is_above.set(frame(stop.map(|stop| stop.at)));
        if let Some(button) = next.get() {
            let _ = button.focus();
        }
    });
    // What it explains is not there any more.
    Effect::new(move || {
        lab.bench.track();
        lab.side.track();
        lab.stage.track();
        lab.tour.set(None);
    });
    let is_on = move || lab.tour.get().is_some();
    let is_last = move |index: usize| index + 1 == STOPS.len();
    let go = move |_| lab.tour.update(|at| *at = at.filter(|&index| !is_last(index)).map(|index| index + 1));
    let content = move || {
        let index = lab.tour.get()?;
        let place = tr!(lab, tour.place, number = index + 1, count = STOPS.len());
        Some(
            view! { <p>{(STOPS.get(index)?.text)(lab)}</p> <span class="remark" data-testid="tour-place">{place}</span> },
        )
    };
    view! {
        <div class="tour" class:above=is_above role="dialog" aria-label=say!(lab, tour.title) data-testid="tour" hidden=move || !is_on()>
            <div aria-live="polite">{content}</div>
            <button type="button" class="button small" data-testid="tour-end" on:click=move |_| lab.tour.set(None)>{say!(lab, tour.end)}</button>
            <button type="button" class="button" node_ref=next data-testid="tour-next" on:click=go>
                {move || if lab.tour.get().is_some_and(is_last) { tr!(lab, tour.done) } else { tr!(lab, tour.next) }}
            </button>
        </div>
    }
}

/// Frames the first element of a selector, and nothing else. Whether it is in the lower half of the window, so that its
/// explanation stands above.
fn frame(at: Option<&str>) -> bool {
    while let Ok(Some(former)) = document().query_selector(&format!(".{FRAMED}")) {
        let _ = former.class_list().remove_1(FRAMED);
    }
    let Some(Ok(Some(element))) = at.map(|at| document().query_selector(at)) else { return false };
    let _ = element.class_list().add_1(FRAMED);
    element.scroll_into_view();
    let place = element.get_bounding_client_rect();
    let height = window().inner_height().ok().and_then(|height| height.as_f64()).unwrap_or_default();
    place.top() + place.bottom() > height
}

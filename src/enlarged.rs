//! The page larger than usual, for a projector: the laboratory in a frame that is laid out as in a smaller window, as by the zoom of a
//! browser. Larger fonts alone would not choose the layout for less room.

use gloo_timers::callback::Interval;
use leptos::html::Iframe;
use leptos::prelude::*;
use web_sys::HtmlIFrameElement;

use super::share::{query_with, query_without, show_address};

/// The flag of the address.
const FLAG: &str = "scale";
/// How often the address follows that of the frame (ms).
const FOLLOW_MS: u32 = 1000;

/// The laboratory in a frame, `scale` times as large.
#[component]
pub fn Enlarged(
    /// Factor, from 1 to 4.
    scale: f64,
) -> impl IntoView {
    let frame = NodeRef::<Iframe>::new();
    let location = window().location();
    let query = query_without(&location.search().unwrap_or_default(), &[FLAG]);
    let address = format!("?{query}{}", location.hash().unwrap_or_default());
    let follow = move || frame.get_untracked().and_then(|frame| follow(&frame, scale)).unwrap_or_default();
    // It lives as long as the page.
    Interval::new(FOLLOW_MS, follow).forget();
    let usual = address.clone();
    let on_load = move |_| match frame.get_untracked() {
        // A host may forbid frames: then the page is as large as usual.
        Some(frame) if is_refused(&frame) => {
            let _ = window().location().replace(&usual);
        }
        // Keys are for the laboratory.
        Some(frame) => {
            let _ = frame.focus();
        }
        None => {}
    };
    view! {
        <iframe
            class="enlarged"
            title="Quadtank"
            allow="clipboard-write"
            node_ref=frame
            style:width=format!("{}vw", 100.0 / scale)
            style:height=format!("{}dvh", 100.0 / scale)
            style:transform=format!("scale({scale})")
            src=address
            on:load=on_load
        ></iframe>
    }
}

/// Whether the frame shows an error of the browser in place of this site.
fn is_refused(frame: &HtmlIFrameElement) -> bool {
    frame.content_window().is_some_and(|inside| inside.location().pathname().is_err())
}

/// The address follows that of the frame, so that a reload and a bookmark keep what is done; nothing while the frame is empty.
fn follow(frame: &HtmlIFrameElement, scale: f64) -> Option<()> {
    let (here, inside) = (window().location(), frame.content_window()?.location());
    if here.pathname().ok()? != inside.pathname().ok()? {
        return None;
    }
    let query = query_with(&inside.search().ok()?, &[(FLAG, &scale.to_string())]);
    let reference = format!("{query}{}", inside.hash().ok()?);
    if format!("{}{}", here.search().ok()?, here.hash().ok()?) != reference {
        show_address(&reference);
    }
    Some(())
}

//! The notice for the case that the program stops at an error (a trap of the wasm): nothing on the page reacts any more, so
//! the notice is made beforehand, with the file and the link of the experiment in it. `assets/start.js` shows it.

use gloo_timers::callback::Timeout;
use js_sys::encode_uri_component;
use leptos::attr::custom::custom_attribute;
use leptos::prelude::*;

use super::lab::{Lab, use_lab};
use super::share::{FILE, address_of, json_of};
use super::texts::say;
use super::timing::now_ms;

/// The time from a change to its being kept (ms). Writing file and link takes 0.3 ms for a short document and 3 ms for
/// one with four pinned runs (measured in Chromium): too much for every frame.
const PERIOD_MS: u32 = 1000;
/// The same as a multiple of the time that it took last: a document of several megabytes, with a record as its experiment, is kept more
/// rarely.
const PERIOD_SHARE: f64 = 20.0;

/// The experiment in a form that needs no program; nothing where it is too long for that form.
#[derive(Clone, Default)]
struct Kept {
    /// Its file as a `data:` URL.
    file: Option<String>,
    /// The address that restores it.
    link: Option<String>,
}

impl Kept {
    fn of(lab: Lab) -> Self {
        let data = |json: String| format!("data:application/json;charset=utf-8,{}", encode_uri_component(&json));
        Self { file: json_of(lab).ok().map(data), link: address_of(lab).ok() }
    }
}

/// The notice, hidden.
#[component]
pub fn Stopped() -> impl IntoView {
    let lab = use_lab();
    let kept = kept(lab);
    let file = Signal::derive(move || kept.with(|kept| kept.file.clone()));
    let link = Signal::derive(move || kept.with(|kept| kept.link.clone()));
    view! {
        <div class="notice stopped" id="stopped" data-testid="stopped" role="main" hidden>
            <div role="alert">
                // The heading of the page from then on; a second h1 beside that of the header would be one too many until then.
                <p><b role="heading" {custom_attribute("aria-level", "1")}>{say!(lab, stopped.lead)}</b></p>
                <p>{say!(lab, stopped.advice)}</p>
                <div class="toolbar">
                    <a class="button" data-testid="stopped-save" download=FILE href=file hidden=move || file.get().is_none()>
                        {say!(lab, app.export_scenario)}
                    </a>
                    <button type="button" class="button" id="again" data-testid="again">{say!(lab, stopped.again)}</button>
                </div>
                <label hidden=move || link.get().is_none()>
                    {say!(lab, stopped.link)}
                    <input type="text" class="text-field" readonly data-testid="stopped-link" value=link />
                </label>
            </div>
        </div>
    }
}

/// The experiment that is shown, at most [`PERIOD_MS`] old where it is short.
fn kept(lab: Lab) -> Signal<Kept> {
    let kept = RwSignal::new(Kept::default());
    let next = StoredValue::new_local(None::<Timeout>);
    let period_ms = StoredValue::new(PERIOD_MS);
    Effect::new(move || {
        (lab.bench.get().track)(lab);
        if next.with_value(Option::is_none) {
            let keep = move || {
                next.set_value(None);
                let begin = now_ms();
                kept.set(Kept::of(lab));
                period_ms.set_value(next_period_ms(now_ms() - begin));
            };
            next.set_value(Some(Timeout::new(period_ms.get_value(), keep)));
        }
    });
    kept.into()
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a short time")]
fn next_period_ms(took_ms: f64) -> u32 {
    PERIOD_MS.max((PERIOD_SHARE * took_ms) as u32)
}

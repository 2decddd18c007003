//! The cursor in time: it says which moment the drawing shows, and it can run.

use crate::app::widgets::handler;
use gloo_timers::callback::Interval;
use leptos::prelude::*;

use crate::app::lab::use_lab;
use crate::app::texts::{say, tr};
use crate::app::widgets::html::option;

/// Between two steps of a running cursor (ms).
const TICK_MS: u32 = 50;
/// How much faster than life the run can be shown.
const SPEEDS: [u32; 4] = [1, 5, 20, 100];
const USUAL_SPEED: u32 = 20;

/// Runs the cursor through the experiment; the drawing follows.
#[component]
pub fn PlayControls() -> impl IntoView {
    let lab = use_lab();
    let speed = RwSignal::new(USUAL_SPEED);
    let timer = StoredValue::new_local(None::<Interval>);
    let playing = RwSignal::new(false);
    let stop = move || {
        playing.set(false);
        timer.set_value(None);
    };
    let tick = move || {
        // A page that nobody sees need not run.
        if document().hidden() {
            return;
        }
        let end = lab.scenario.with_untracked(|s| s.setup.experiment.duration_s);
        let step = f64::from(speed.get_untracked()) * f64::from(TICK_MS) / 1000.0;
        let next = lab.scenario.with_untracked(|s| s.view.cursor_s).unwrap_or(0.0) + step;
        lab.scenario.update(|s| s.view.cursor_s = Some(next.min(end)));
        if next >= end {
            stop();
        }
    };
    let start = move || {
        let (end, at) = lab.scenario.with_untracked(|s| (s.setup.experiment.duration_s, s.view.cursor_s));
        if at.is_none_or(|t| t >= end) {
            lab.scenario.update(|s| s.view.cursor_s = Some(0.0));
        }
        playing.set(true);
        timer.set_value(Some(Interval::new(TICK_MS, tick)));
    };
    let text = Signal::derive(move || {
        let (sign, name) =
            if playing.get() { ("❚❚", tr!(lab, experiment.pause)) } else { ("▶", tr!(lab, experiment.play)) };
        format!("{sign} {name}")
    });
    on_cleanup(move || timer.dispose());
    let speeds =
        SPEEDS.map(|choice| option(&choice.to_string(), &format!("{choice}×"), choice == USUAL_SPEED)).concat();
    view! {
        <div class="toolbar play">
            <button
                type="button"
                class="button"
                data-testid="play"
                aria-pressed=move || playing.get().to_string()
                title=say!(lab, experiment.play_name)
                on:click=handler(move |_| if playing.get_untracked() { stop() } else { start() })
            >
                {text}
            </button>
            <select
                data-testid="speed"
                aria-label=say!(lab, experiment.speed)
                on:change=handler(move |event| if let Ok(choice) = event_target_value(&event).parse() { speed.set(choice) })
                inner_html=speeds
            ></select>
        </div>
    }
}

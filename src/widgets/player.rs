use gloo_timers::callback::Interval;
use leptos::prelude::*;

use crate::lab::use_lab;
use crate::texts::{say, tr};

/// Between two steps of a running cursor (ms).
const TICK_MS: u32 = 50;

/// Runs a cursor through time; whatever shows the moment of the cursor follows.
#[component]
pub fn Player(
    /// Where the cursor stands, if there is one (s).
    cursor: Signal<Option<f64>>,
    /// Called with where it goes (s).
    on_cursor: Callback<f64>,
    /// Where it stops (s).
    end: Signal<f64>,
    /// How many times faster than life it can go.
    speeds: &'static [u32],
    /// That one of them which it begins with.
    usual_speed: u32,
    /// Names for tests: the button, the speed.
    ids: (&'static str, &'static str),
) -> impl IntoView {
    let lab = use_lab();
    let speed = RwSignal::new(usual_speed);
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
        let end = end.get_untracked();
        let step = f64::from(speed.get_untracked()) * f64::from(TICK_MS) / 1000.0;
        let next = cursor.get_untracked().unwrap_or(0.0) + step;
        on_cursor.run(next.min(end));
        if next >= end {
            stop();
        }
    };
    let start = move || {
        if cursor.get_untracked().is_none_or(|time| time >= end.get_untracked()) {
            on_cursor.run(0.0);
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
    let speeds = speeds
        .iter()
        .map(|&choice| view! { <option value=choice.to_string() selected=choice == usual_speed>{choice}"×"</option> })
        .collect_view();
    view! {
        <div class="toolbar play">
            <button
                type="button"
                class="button"
                data-testid=ids.0
                aria-pressed=move || playing.get().to_string()
                title=say!(lab, experiment.play_name)
                on:click=move |_| if playing.get_untracked() { stop() } else { start() }
            >
                {text}
            </button>
            <select
                data-testid=ids.1
                aria-label=say!(lab, experiment.speed)
                on:change=move |event| if let Ok(choice) = event_target_value(&event).parse() { speed.set(choice) }
            >
                {speeds}
            </select>
        </div>
    }
}

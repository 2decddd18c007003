//! The values at the cursor of a picture over time.

use leptos::prelude::*;

use super::session::{Session, time_unit};
use crate::widgets::{Readout, TimeAxis, TimeSurface};
use quadtank::sim::LoopTrace;
use quadtank_figure::Frame;

/// Outputs and inputs at the cursor; nothing where there is no cursor. `visit` hands the record over.
pub fn readout(
    session: Session,
    cursor: Signal<Option<f64>>,
    visit: impl Fn(&mut dyn FnMut(&LoopTrace)) + Send + Sync + 'static,
) -> Signal<Option<Readout>> {
    Signal::derive(move || {
        let time = cursor.get()?;
        let mut readout = None;
        visit(&mut |trace| readout = Some(at(session, trace, time)));
        readout
    })
}

fn at(session: Session, trace: &LoopTrace, time: f64) -> Readout {
    let style = session.lab.number_style();
    let unit = session.throttled.setup.with(|s| time_unit(&s.plant));
    let row = trace.time.partition_point(|&t| t <= time).saturating_sub(1);
    let pair = |symbol: &str, columns: &[Vec<f64>; 2]| {
        [0, 1].map(|k| {
            let value = columns[k].get(row).copied().unwrap_or(f64::NAN);
            format!("{symbol}{} {}", ["₁", "₂"][k], style.fixed(value, 3))
        })
    };
    Readout {
        time: format!("t = {} {unit}", style.significant(time, 4)),
        pairs: vec![pair("y", &trace.outputs), pair("u", &trace.inputs)],
    }
}

/// The surface over a picture over time, with the values at its cursor.
#[component]
pub fn Surface(
    /// Name for tests.
    id: &'static str,
    /// The time axis of the picture.
    axis: TimeAxis,
    /// Where its charts stand.
    frames: RwSignal<Vec<Frame>>,
    /// What it is, for screen readers.
    label: Signal<String>,
    /// The values at the cursor.
    readout: Signal<Option<Readout>>,
) -> impl IntoView {
    let spoken = Signal::derive(move || readout.get().map_or_else(String::new, |readout| readout.spoken()));
    view! { <TimeSurface axis frames label spoken readout id /> }
}

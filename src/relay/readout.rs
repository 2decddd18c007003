//! The values at the cursor of a picture over time.

use leptos::prelude::*;

use super::session::{Session, time_unit};
use crate::widgets::html::element;
use crate::widgets::{TimeAxis, TimeSurface};
use quadtank::sim::LoopTrace;
use quadtank_figure::Frame;

/// Outputs and inputs at the cursor as HTML; empty where there is no cursor. `visit` hands the record over.
pub fn readout(
    session: Session,
    cursor: Signal<Option<f64>>,
    visit: impl Fn(&mut dyn FnMut(&LoopTrace)) + Send + Sync + 'static,
) -> Signal<String> {
    Signal::derive(move || {
        let Some(time) = cursor.get() else { return String::new() };
        let style = session.lab.number_style();
        let unit = session.words.setup.with(|s| time_unit(&s.plant));
        let mut text = String::new();
        visit(&mut |trace| {
            let row = trace.time.partition_point(|&t| t <= time).saturating_sub(1);
            let pair = |symbol: &str, columns: &[Vec<f64>; 2]| {
                let one = |k: usize| {
                    let value = columns[k].get(row).copied().unwrap_or(f64::NAN);
                    let content = format!("{symbol}{} {}", ["₁", "₂"][k], style.fixed(value, 3));
                    element("span", ["class=\"loop1\"", "class=\"loop2\""][k], &content)
                };
                element("div", "", &format!("{} · {}", one(0), one(1)))
            };
            let head = element("div", "", &format!("t = {} {unit}", style.significant(time, 4)));
            text = head + &pair("y", &trace.outputs) + &pair("u", &trace.inputs);
        });
        text
    })
}

/// The surface over a picture over time, with the values at its cursor.
pub fn surface(
    id: &'static str,
    axis: TimeAxis,
    frames: RwSignal<Vec<Frame>>,
    label: Signal<String>,
    readout: Signal<String>,
) -> AnyView {
    let spoken = Signal::derive(move || plain(&readout.get()));
    view! { <TimeSurface axis frames label spoken readout id /> }.into_any()
}

/// The words of a piece of HTML.
fn plain(html: &str) -> String {
    html.split('<').filter_map(|part| part.split_once('>')).map(|(_, words)| words).collect::<Vec<_>>().join(" ")
}

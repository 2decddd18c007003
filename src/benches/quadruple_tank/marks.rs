//! Reference marks on the walls of the lower tanks: dragged up and down, they ask for more or less water.

use leptos::prelude::*;
use leptos::svg::Svg;

use super::experiment::{holdable, step_beside_mut, step_size, step_time};
use super::flags::locks;
use super::rig::{TANK, TANKS, VIEW};
use super::session::use_session;
use crate::shown::{length_digits, per_metre, to_metres, to_shown, unit_name};
use crate::texts::say;
use crate::widgets::{Drag, Handle, Nudge};

const IDS: [&str; 2] = ["mark1", "mark2"];
/// Where the marks stand beside their tanks, and how far their lines reach.
const HANDLES_X: [f64; 2] = [52.0, 224.0];
const LINES_X: [(f64, f64); 2] = [(56.0, 132.0), (144.0, 220.0)];

/// The mark of one level.
#[component]
pub fn ReferenceMark(level: usize, drawing: NodeRef<Svg>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let (size, time_s) = (step_size(session, level), step_time(session, level));
    let height = session.part(move |s| s.plant().tanks[level].height);
    let rest = Memo::new(move |_| session.throttled.with_analysis(|a| a.operating_point.levels[level]));
    let reference = Memo::new(move |_| {
        let rest = rest.get()?;
        Some(session.document.with(|s| s.setup.experiment.reference_after(level, rest, time_s.get())))
    });
    let y = move |level_m: f64| {
        let (_, top) = TANKS[level];
        top + TANK.1 * (1.0 - (level_m / height.get()).clamp(0.0, 1.0))
    };
    let set = move |wanted: f64| {
        let Some(rest) = rest.get_untracked() else { return };
        let unit = session.own.unit.get_untracked();
        let grid = 10_f64.powi(i32::try_from(length_digits(unit)).unwrap_or_default());
        let rounded = to_metres((to_shown(wanted, unit) * grid).round() / grid, unit);
        session.edit(|s| {
            let limits = holdable(s, level, rest);
            step_beside_mut(&mut s.experiment, level).size = limits.clamp(rounded);
        });
    };
    let grabbed = StoredValue::new(None::<(f64, f64)>);
    let on_grab = move |()| {
        let metres_per_px = drawing.get_untracked().map(|drawing| {
            let place = drawing.get_bounding_client_rect();
            let px_per_unit = (place.width() / VIEW.0).min(place.height() / VIEW.1);
            untrack(|| height.get()) / TANK.1 / px_per_unit
        });
        grabbed.set_value(metres_per_px.map(|scale| (size.get_untracked(), scale)));
    };
    let on_drag = move |drag: Drag| {
        if let Some((size, metres_per_px)) = grabbed.get_value() {
            set(size - drag.moved.1 * metres_per_px);
        }
    };
    let on_nudge = move |by: Nudge| {
        let last_digit =
            0.1_f64.powi(i32::try_from(length_digits(session.own.unit.get_untracked())).unwrap_or_default());
        set(size.get_untracked() + by.along() * last_digit / per_metre(session.own.unit.get_untracked()));
    };
    let shown = Signal::derive(move || to_shown(reference.get().unwrap_or_default(), session.own.unit.get()));
    let spoken = move || {
        let unit = session.own.unit.get();
        format!("{} {}", lab.number_style().fixed(shown.get(), length_digits(unit)), unit_name(unit))
    };
    let limits = Signal::derive(move || (0.0, to_shown(height.get(), session.own.unit.get())));
    view! {
        <g visibility=move || if reference.get().is_some() { "visible" } else { "hidden" }.to_owned()>
            <line
                class=["mark one", "mark two"][level]
                x1=LINES_X[level].0
                x2=LINES_X[level].1
                y1=move || y(reference.get().unwrap_or_default())
                y2=move || y(reference.get().unwrap_or_default())
            />
            <Handle
                id=IDS[level]
                label=say!(lab, process.mark, level = level + 1)
                value=shown
                limits
                spoken=Signal::derive(spoken)
                locked=lab.locks(locks::EXPERIMENT)
                on_grab
                on_drag
                on_nudge
                at=Signal::derive(move || (HANDLES_X[level], y(reference.get().unwrap_or_default())))
            >
                <circle class="halo" r="11" />
                <circle class=["dot one", "dot two"][level] r="4.5" />
            </Handle>
        </g>
    }
}

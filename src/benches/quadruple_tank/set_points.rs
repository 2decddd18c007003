//! The set-points in the picture of the responses: dragged up and down for their size, sideways for their time.

use leptos::prelude::*;

use super::experiment::{first_step_mut, holdable, step_size, step_time};
use super::flags::locks;
use super::session::use_session;
use crate::shown::{length_digits, per_metre, to_metres, to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Drag, Handle, Nudge};
use quadtank_figure::Frame;
use quadtank_scenario::{Limits, limits};

const IDS: [&str; 2] = ["set-point1", "set-point2"];
/// Step of the left and right arrow keys (s); dragging goes by whole seconds.
const TIME_STEP_S: f64 = 10.0;

/// The handles of both set-points.
#[component]
pub fn SetPoints(
    /// Where the charts stand.
    frames: RwSignal<Vec<Frame>>,
) -> impl IntoView {
    view! {
        <svg class="over handles">
            <SetPoint level=0 frames />
            <SetPoint level=1 frames />
        </svg>
    }
}

#[component]
fn SetPoint(level: usize, frames: RwSignal<Vec<Frame>>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let (size, time_s) = (step_size(session, level), step_time(session, level));
    let frame = move || frames.with(|f| f.first().copied());
    let reference = move || {
        let rest = session.charts.with_analysis(|a| a.operating_point.levels[level])?;
        Some(session.charts.setup.with(|s| s.experiment.reference_after(level, rest, time_s.get())))
    };
    let place = move || {
        let (frame, reference) = (frame()?, reference()?);
        let (x, y) = frame.to_px((time_s.get(), to_shown(reference, session.own.unit.get())));
        let plot = frame.plot;
        ((plot.left..=plot.right()).contains(&x) && (plot.top..=plot.bottom()).contains(&y)).then_some((x, y))
    };
    let rest = Memo::new(move |_| session.throttled.with_analysis(|a| a.operating_point.levels[level]));
    let reach = session.part(move |s| rest.get().map_or(Limits::new(0.0, 0.0), |rest| holdable(s, level, rest)));
    let set = move |new_size: f64, new_time_s: f64| {
        let unit = session.own.unit.get_untracked();
        let grid = 10_f64.powi(i32::try_from(length_digits(unit)).unwrap_or_default());
        let reach = reach.get_untracked();
        let new_size = to_metres((to_shown(reach.clamp(new_size), unit) * grid).round() / grid, unit);
        let end = session.document.with_untracked(|s| s.setup.experiment.duration_s);
        let new_time_s = new_time_s.round().clamp(limits::TIME_S.min, end);
        session.edit(|s| {
            let step = first_step_mut(&mut s.experiment, level);
            (step.size, step.time_s) = (new_size, new_time_s);
        });
    };
    // The scale is that of the moment of grabbing: one that follows the drag would run away from the pointer.
    let grabbed = StoredValue::new(None::<(Frame, f64, f64)>);
    let on_grab = move |()| {
        grabbed.set_value(untrack(frame).map(|f| (f, size.get_untracked(), time_s.get_untracked())));
    };
    let on_drag = move |drag: Drag| {
        let Some((frame, size, time_s)) = grabbed.get_value() else { return };
        let (right, up) = (drag.moved.0 / frame.plot.width, -drag.moved.1 / frame.plot.height);
        let height = to_metres(frame.y.1 - frame.y.0, session.own.unit.get_untracked());
        set(size + up * height, time_s + right * (frame.x.1 - frame.x.0));
    };
    let on_nudge = move |by: Nudge| {
        let last_digit =
            0.1_f64.powi(i32::try_from(length_digits(session.own.unit.get_untracked())).unwrap_or_default());
        let rise = (by.up + by.page) * last_digit / per_metre(session.own.unit.get_untracked());
        set(size.get_untracked() + rise, time_s.get_untracked() + by.right * TIME_STEP_S);
    };
    let value = Signal::derive(move || to_shown(size.get(), session.own.unit.get()));
    let spoken = move || {
        let (style, unit) = (lab.number_style(), session.own.unit.get());
        let (size, time) = (style.fixed(value.get(), length_digits(unit)), style.fixed(time_s.get(), 0));
        tr!(lab, responses.set_point_value, size = size, unit = unit_name(unit), time = time)
    };
    let limits = Signal::derive(move || {
        let (reach, unit) = (reach.get(), session.own.unit.get());
        (to_shown(reach.min, unit), to_shown(reach.max, unit))
    });
    view! {
        // A mark that cannot be moved and stands for no step only puzzles.
        <g visibility=move || {
            let is_mute = lab.locks(locks::EXPERIMENT) && size.get() == 0.0;
            if place().is_some() && !is_mute { "visible" } else { "hidden" }.to_owned()
        }>
            <Handle
                id=IDS[level]
                label=say!(lab, responses.set_point, level = level + 1)
                value
                limits
                spoken=Signal::derive(spoken)
                locked=lab.locks(locks::EXPERIMENT)
                on_grab
                on_drag
                on_nudge
                at=Signal::derive(move || place().unwrap_or_default())
            >
                <circle class="halo" r="12" />
                <circle class=["dot one", "dot two"][level] r="5.5" />
            </Handle>
        </g>
    }
}

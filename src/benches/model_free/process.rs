//! The drawing of the rig at the shown moment, and the time bar.

use leptos::prelude::*;

use super::flags::panels;
use super::session::{set_cursor, shown, use_session};
use crate::benches::quadruple_tank::{drawing, ghosts, summary};
use crate::texts::say;
use crate::widgets::{Card, Playback, Scale, SliderField, TimeBar, shown_times};
use quadtank::literature::DisplayUnit;

/// The drawing, the time and what runs through it.
#[component]
pub fn ProcessCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let picture = move || shown(session).map(|shown| drawing(lab, &shown.plant, DisplayUnit::Cm, Some(&shown.state)));
    let marks = move || {
        let heights = session.throttled.setup.with(|s| s.plant.rig().tanks.map(|tank| tank.height));
        session.throttled.with_answer(|answer| ghosts(&answer.run.trajectory, heights))
    };
    let summary = move || shown(session).map(|shown| summary(lab, &shown.state, DisplayUnit::Cm)).unwrap_or_default();
    let end = session.part(|s| s.experiment.duration_s);
    let on_cursor = Callback::new(move |time| set_cursor(session, Some(time)));
    let events = session
        .part(|s| shown_times(s.experiment.set_point_steps.iter().map(|step| step.time_s), s.experiment.duration_s));
    let on_move = Callback::new(move |time| set_cursor(session, time));
    let playback = Playback::new(session.own.cursor.into(), on_move, events);
    view! {
        <Card name="drawing" panel=panels::PROCESS title=say!(lab, process.title) >
            <SliderField
                id=("free-time", "free-time-number")
                label="t".to_owned()
                name=say!(lab, free.time)
                value=Signal::derive(move || session.own.cursor.get().unwrap_or_else(|| end.get()))
                on_change=on_cursor
                travel=Signal::derive(move || (0.0, end.get()))
                scale=Scale::Linear(1.0)
                digits=Some(0)
                unit="s".to_owned()
            />
            <TimeBar playback id="free-play" lab slider=false />
            <svg class="rig" viewBox="0 0 276 296" role="img" aria-label=summary data-testid="free-rig">{picture} {marks}</svg>
        </Card>
    }
}

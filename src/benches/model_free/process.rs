//! The drawing of the rig at the shown moment, and the player.

use leptos::prelude::*;

use super::session::{set_cursor, shown, use_session};
use crate::benches::quadruple_tank::{drawing, summary};
use crate::texts::say;
use crate::widgets::{Card, Player, Scale, SliderField};
use quadtank::literature::DisplayUnit;

/// How much faster than life the run can be shown.
const SPEEDS: &[u32] = &[1, 5, 20, 50, 200];
const USUAL_SPEED: u32 = 20;

/// The drawing, the time and what runs through it.
#[component]
pub fn ProcessCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let picture = move || shown(session).map(|shown| drawing(lab, &shown.plant, DisplayUnit::Cm, Some(&shown.state)));
    let summary = move || shown(session).map(|shown| summary(lab, &shown.state, DisplayUnit::Cm)).unwrap_or_default();
    let end = session.part(|s| s.experiment.duration_s);
    let on_cursor = Callback::new(move |time| set_cursor(session, Some(time)));
    let player = move || {
        view! {
            <Player
                cursor=session.own.cursor.into()
                on_cursor
                end
                speeds=SPEEDS
                usual_speed=USUAL_SPEED
                ids=("free-play", "free-speed")
            />
        }
    };
    view! {
        <Card name="drawing" title=say!(lab, process.title) beside=player>
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
            <svg class="rig" viewBox="0 0 276 296" role="img" aria-label=summary data-testid="free-rig">{picture}</svg>
        </Card>
    }
}

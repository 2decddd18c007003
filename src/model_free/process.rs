//! The drawing of the rig at the shown moment, and the way through time.

use leptos::prelude::*;

use super::session::Session;
use crate::quadruple::drawing;
use crate::shown::to_shown;
use crate::texts::{say, tr};
use crate::widgets::{Player, Scale, SliderField, card as card_of};
use quadtank::plant::DisplayUnit;

/// How much faster than life the run can be shown.
const SPEEDS: &[u32] = &[1, 5, 20, 50, 200];
const USUAL_SPEED: u32 = 20;

/// The drawing, the time and what runs through it.
pub fn card(session: Session) -> AnyView {
    let lab = session.lab;
    let picture = Signal::derive(move || {
        let Some(shown) = session.shown() else { return String::new() };
        drawing(lab, &shown.plant, DisplayUnit::Cm, Some(&shown.state))
    });
    let summary = Signal::derive(move || {
        let Some(shown) = session.shown() else { return String::new() };
        let style = lab.number_style();
        let level = |k: usize| style.fixed(to_shown(shown.state.levels[k], DisplayUnit::Cm), 2);
        let pump = |k: usize| style.fixed(shown.state.pump_voltage[k], 2);
        let (h1, h2, h3, h4, v1, v2) = (level(0), level(1), level(2), level(3), pump(0), pump(1));
        tr!(lab, process.drawing, h1 = h1, h2 = h2, h3 = h3, h4 = h4, unit = "cm", v1 = v1, v2 = v2).to_string()
    });
    let end = session.part(|s| s.experiment.duration_s);
    let time = Signal::derive(move || session.cursor.get().unwrap_or_else(|| end.get()));
    let on_cursor = Callback::new(move |time| session.set_cursor(Some(time)));
    let beside = view! {
        <Player cursor=session.cursor on_cursor end speeds=SPEEDS usual_speed=USUAL_SPEED ids=("free-play", "free-speed") />
    };
    let slider = view! {
        <SliderField
            id=("free-time", "free-time-number")
            label="t".to_owned()
            name=say!(lab, free.time)
            value=time
            on_change=on_cursor
            travel=Signal::derive(move || (0.0, end.get()))
            scale=Scale::Linear(1.0)
            digits=Some(0)
            unit="s".to_owned()
        />
    };
    let rig = view! {
        <svg class="rig" viewBox="0 0 276 296" role="img" aria-label=summary data-testid="free-rig" inner_html=picture></svg>
    };
    card_of("drawing", say!(lab, process.title), vec![beside.into_any()], vec![slider.into_any(), rig.into_any()])
}

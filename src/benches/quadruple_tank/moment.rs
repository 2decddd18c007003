//! The moment that the drawing shows.

use leptos::prelude::*;

use super::session::Session;

/// Levels and voltages at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigState {
    /// When (s); `None` at rest, where there is no run.
    pub time_s: Option<f64>,
    /// Levels h1…h4 (m).
    pub levels: [f64; 4],
    /// Pump voltages (V).
    pub pump_voltage: [f64; 2],
}

/// Makes the shown moment available to the cards of the bench: where the cursor stands, else where a replay is, else the end of
/// the run. A drawing at rest beside the chart of an overflow would contradict it.
pub fn provide_moment(session: Session) {
    let cursor = Memo::new(move |_| session.document.with(|s| s.view.cursor_s).or_else(|| session.own.playback.get()));
    let moment = Memo::new(move |_| at(session, cursor.get().unwrap_or(f64::INFINITY)).or_else(|| at_rest(session)));
    provide_context(moment);
}

/// The shown moment; `None` where the setup has no operating point.
pub fn use_moment() -> Memo<Option<RigState>> {
    expect_context()
}

fn at_rest(session: Session) -> Option<RigState> {
    session.throttled.analysis.with(|outcome| {
        let point = outcome.as_ref().as_ref().ok()?.operating_point;
        Some(RigState { time_s: None, levels: point.levels, pump_voltage: point.pump_voltage })
    })
}

fn at(session: Session, time_s: f64) -> Option<RigState> {
    session.throttled.run.with(|outcome| {
        let run = &outcome.as_ref().as_ref().ok()?.nonlinear;
        let row = run.row_at(time_s)?;
        let at = |column: &Vec<f64>| column.get(row).copied();
        Some(RigState {
            time_s: at(&run.time_s),
            levels: [at(&run.levels[0])?, at(&run.levels[1])?, at(&run.levels[2])?, at(&run.levels[3])?],
            pump_voltage: [at(&run.pump_voltage[0])?, at(&run.pump_voltage[1])?],
        })
    })
}

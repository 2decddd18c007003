//! The moment that the drawing shows: the cursor of the responses, or the plant at rest.

use leptos::prelude::*;

use super::session::Session;

/// Levels and voltages at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigState {
    /// When (s); `None` at rest, before the experiment.
    pub time_s: Option<f64>,
    /// Levels h1…h4 (m).
    pub levels: [f64; 4],
    /// Pump voltages (V).
    pub pump_voltage: [f64; 2],
}

/// Makes the shown moment available to the cards of the bench.
pub fn provide_moment(session: Session) {
    let cursor = Memo::new(move |_| session.document.with(|s| s.view.cursor_s));
    let moment = Memo::new(move |_| match cursor.get() {
        Some(time_s) => at_cursor(session, time_s).or_else(|| at_rest(session)),
        None => at_rest(session),
    });
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

fn at_cursor(session: Session, time_s: f64) -> Option<RigState> {
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

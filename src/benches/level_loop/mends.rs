//! Corrections for warnings of the level loop.

use leptos::prelude::*;
use quadtank::study::level_loop::{LevelLoopSetup, Mend, mend_loop, mend_run, mend_start};

use super::flags::locks;
use super::session::{LevelLoop, Session};
use crate::mends::MendFor;
use crate::session::Lock;
use crate::texts::tr;

/// The tuning that makes the loop stable and robust.
pub fn of_loop(session: Session) -> Option<Mend> {
    let setup = session.throttled.setup.get();
    session.throttled.with_answer(|answer| mend_loop(&setup, answer)).flatten()
}

/// What lets the run go to its set-point: a calm loop first, then a level that can be held.
pub fn of_run(session: Session) -> Option<Mend> {
    let setup = session.throttled.setup.get();
    session.throttled.with_answer(|answer| mend_run(&setup, answer)).flatten()
}

/// The initial level at which the loop can rest, in the place of one at which it cannot.
pub fn of_start(session: Session) -> Option<Mend> {
    session.throttled.setup.with(|setup| mend_start(setup))
}

impl MendFor<LevelLoop> for Mend {
    fn name(self, session: Session) -> String {
        let lab = session.lab;
        let style = lab.number_style();
        let cm = |metres: f64| style.fixed(100.0 * metres, 1);
        match self {
            Self::AdvisedTuning(tuning) => {
                let (gain, time) = (style.significant(tuning.gain, 3), style.significant(tuning.integral_time_s, 3));
                tr!(lab, mend.advised_tuning, gain = gain, time = time)
            }
            Self::SetPoint(level) => tr!(lab, mend.set_point, level = cm(level)),
            Self::Start(level) => tr!(lab, mend.start, level = cm(level)),
        }
    }

    fn locks(self) -> &'static [Lock] {
        match self {
            Self::AdvisedTuning(_) => &[locks::GAINS],
            Self::SetPoint(_) | Self::Start(_) => &[locks::EXPERIMENT],
        }
    }

    fn mended(self, setup: &LevelLoopSetup) -> Option<LevelLoopSetup> {
        Some(self.applied(setup))
    }
}

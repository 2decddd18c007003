//! Corrections for warnings of the home bench.

use leptos::prelude::*;

use super::flags::locks;
use super::session::{QuadrupleTank, Session};
use crate::mends::MendFor;
use crate::session::Lock;
use crate::texts::tr;
use quadtank::study::quadruple_tank::{Mend, Setup, mend_loop, mend_rest, mend_run};

/// What makes the loop stable.
pub fn of_loop(session: Session) -> Option<Mend> {
    let setup = session.throttled.setup.get();
    session.throttled.analysis.with(|outcome| mend_loop(&setup, outcome.as_ref().as_ref().ok()))
}

/// The same on the card with the pairing, whose switch offers the advised one itself.
pub fn of_gains(session: Session) -> Option<Mend> {
    of_loop(session).filter(|mend| *mend != Mend::AdvisedPairing)
}

/// What brings the operating point within the rig.
pub fn of_rest(session: Session) -> Option<Mend> {
    session.throttled.setup.with(|setup| mend_rest(setup))
}

/// What lets the run answer its steps: a stable loop first, then an experiment within the rig.
pub fn of_run(session: Session) -> Option<Mend> {
    let setup = session.throttled.setup.get();
    of_loop(session).or_else(|| session.throttled.run.with(|outcome| mend_run(&setup, outcome.as_ref().as_ref().ok()?)))
}

impl MendFor<QuadrupleTank> for Mend {
    fn name(self, session: Session) -> String {
        let lab = session.lab;
        match self {
            Self::DetuneLoops => tr!(lab, mend.calm),
            Self::AdvisedPairing => tr!(lab, mend.pairing),
            Self::PublishedValves => tr!(lab, mend.valves),
            Self::LowerRest => tr!(lab, mend.rest),
            Self::HalvedSteps => tr!(lab, mend.steps),
        }
    }

    fn locks(self) -> &'static [Lock] {
        match self {
            Self::DetuneLoops => &[locks::GAINS],
            Self::AdvisedPairing => &[locks::PAIRING, locks::GAINS],
            Self::PublishedValves => &[locks::VALVES],
            Self::LowerRest => &[locks::VOLTAGES],
            Self::HalvedSteps => &[locks::EXPERIMENT],
        }
    }

    fn mended(self, setup: &Setup) -> Option<Setup> {
        self.applied(setup)
    }
}

//! Corrections for runs of the model-free bench that lose their levels.

use leptos::prelude::*;
use quadtank::study::model_free::{ModelFreeMend, ModelFreeSetup, ModelFreeVerdict, mend_model_free};

use super::flags::locks;
use super::session::{ModelFree, Session};
use crate::mends::MendFor;
use crate::session::Lock;
use crate::texts::tr;

/// The change with which the run keeps its levels.
pub fn of_run(session: Session) -> Option<ModelFreeMend> {
    let setup = session.throttled.setup.get();
    let is_good = session.throttled.with_answer(|answer| {
        session.throttled.analysis.with(|analysis| ModelFreeVerdict::of(&setup, answer, analysis).is_good())
    });
    (is_good == Some(false)).then(|| mend_model_free(&setup)).flatten()
}

impl MendFor<ModelFree> for ModelFreeMend {
    fn name(self, session: Session) -> String {
        let lab = session.lab;
        match self {
            Self::OtherPairing => tr!(lab, mend.other_pairing),
            Self::EasySide => tr!(lab, mend.easy_side),
        }
    }

    fn locks(self) -> &'static [Lock] {
        match self {
            Self::OtherPairing => &[locks::PAIRING],
            Self::EasySide => &[locks::VALVES, locks::PAIRING],
        }
    }

    fn mended(self, setup: &ModelFreeSetup) -> Option<ModelFreeSetup> {
        self.applied(setup)
    }
}

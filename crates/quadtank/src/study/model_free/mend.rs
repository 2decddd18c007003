//! Corrections of a setup whose run loses its levels.

use crate::control::Pairing;
use crate::plant::ValveSchedule;

use super::{ModelFreeSetup, ModelFreeVerdict, analyse_model_free, run_analysed};

/// A correction with which the law holds its levels for good, upper tanks included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ModelFreeMend {
    /// Each loop drives the other pump.
    OtherPairing,
    /// Both valves are mirrored about one half, which puts them on the minimum-phase side of γ1 + γ2 = 1, where the diagonal pairing is
    /// the one with a positive relative gain.
    EasySide,
}

impl ModelFreeMend {
    /// The setup with this change; `None` where it is there already.
    pub fn applied(self, setup: &ModelFreeSetup) -> Option<ModelFreeSetup> {
        let mut mended = setup.clone();
        match self {
            Self::OtherPairing => mended.controller.pairing = setup.controller.pairing.other(),
            Self::EasySide => {
                if setup.valves.iter().map(ValveSchedule::midpoint).sum::<f64>() > 1.0 {
                    return None;
                }
                mended.valves = setup.valves.map(|valve| valve.around(1.0 - valve.midpoint()));
                mended.controller.pairing = Pairing::Diagonal;
            }
        }
        Some(mended)
    }
}

/// The smallest correction with which the run keeps its levels; `None` where neither does.
pub fn mend_model_free(setup: &ModelFreeSetup) -> Option<ModelFreeMend> {
    let holds = |mend: &ModelFreeMend| mend.applied(setup).is_some_and(|mended| holds_levels(&mended));
    [ModelFreeMend::OtherPairing, ModelFreeMend::EasySide].into_iter().find(holds)
}

fn holds_levels(setup: &ModelFreeSetup) -> bool {
    let analysis = analyse_model_free(setup);
    run_analysed(setup, &analysis).is_ok_and(|answer| ModelFreeVerdict::of(setup, &answer, &analysis).is_good())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::junqueira::{PublishedExperiment, PublishedValves};

    #[test]
    fn case_b_is_mended_on_the_easy_side_and_case_a_needs_nothing() {
        let setup = ModelFreeSetup::published(PublishedValves::B, PublishedExperiment::S3);
        assert!(!holds_levels(&setup));
        assert_eq!(mend_model_free(&setup), Some(ModelFreeMend::EasySide));
        let mended = ModelFreeMend::EasySide.applied(&setup).unwrap();
        assert_eq!(mended.valves, PublishedValves::A.schedules());
        assert!(holds_levels(&mended));
        assert_eq!(ModelFreeMend::EasySide.applied(&mended), None);
    }

    #[test]
    fn a_wrong_pairing_on_the_easy_side_is_mended_by_the_other_one() {
        let mut setup = ModelFreeSetup::published(PublishedValves::A, PublishedExperiment::S3);
        setup.controller.pairing = Pairing::Swapped;
        assert!(!holds_levels(&setup));
        assert_eq!(mend_model_free(&setup), Some(ModelFreeMend::OtherPairing));
    }
}

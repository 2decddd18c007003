use std::sync::Arc;

use crate::study::{PinnedResults, Quantity, Study, update_pinned};
use crate::tuning::TuningError;

use super::quantities::QUANTITIES;
use super::{Designed, PlantStudy, Tested, TuningSetup};

/// The study of the relay-tuning bench.
#[derive(Clone, Copy, Debug)]
pub struct RelayTuningStudy;

/// A design; `None` where the curve has no ultimate point in the direction that a placement asks for.
pub type DesignOutcome = Result<Option<Designed>, TuningError>;

/// What the relay-tuning bench shows of a session.
#[derive(Clone, Debug)]
pub struct Results {
    /// The setup that the results are of.
    pub setup: Arc<TuningSetup>,
    /// What follows from the plant.
    pub study: Arc<Result<PlantStudy, TuningError>>,
    /// The relay test.
    pub test: Arc<Result<Tested, TuningError>>,
    /// The controllers with their response.
    pub design: Arc<DesignOutcome>,
    /// The pinned sessions with the steps of this one, see [`TuningSetup::in_experiment_of`].
    pub pinned: PinnedResults<TuningSetup, DesignOutcome>,
}

impl Study for RelayTuningStudy {
    type Setup = TuningSetup;
    type Results = Results;
    const QUANTITIES: &'static [Quantity<Results>] = QUANTITIES;

    fn setup_of(results: &Results) -> &Arc<TuningSetup> {
        &results.setup
    }

    /// Everything depends on the plant; test and design do not depend on each other.
    fn update(setup: &TuningSetup, pinned: &[TuningSetup], last: Option<&Results>) -> Results {
        let last = last.map(|last| (last, last.setup.as_ref()));
        let same_plant = last.filter(|(_, before)| before.plant == setup.plant);
        let same_test = same_plant.filter(|(_, before)| before.test == setup.test);
        let same_design =
            same_plant.filter(|(_, before)| before.design == setup.design && before.response == setup.response);
        let study = match same_plant {
            Some((last, _)) => Arc::clone(&last.study),
            None => Arc::new(PlantStudy::of(&setup.plant)),
        };
        let known = || study.as_ref().as_ref().map_err(|&error| error);
        let compared: Vec<TuningSetup> = pinned.iter().map(|pinned| pinned.in_experiment_of(setup)).collect();
        Results {
            setup: match last {
                Some((last, before)) if before == setup => Arc::clone(&last.setup),
                _ => Arc::new(setup.clone()),
            },
            test: match same_test {
                Some((last, _)) => Arc::clone(&last.test),
                None => Arc::new(known().and_then(|study| study.test(setup))),
            },
            design: match same_design {
                Some((last, _)) => Arc::clone(&last.design),
                None => Arc::new(known().and_then(|study| study.design(setup))),
            },
            pinned: update_pinned(&compared, last.map(|(last, _)| &last.pinned), |setup| {
                PlantStudy::of(&setup.plant).and_then(|study| study.design(setup))
            }),
            study,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::campestrini::PublishedPlant;
    use crate::study::relay_tuning::{TestKind, TuningPlant};

    fn update(setup: &TuningSetup, last: &Results) -> [bool; 3] {
        let found = RelayTuningStudy::update(setup, &[], Some(last));
        let study = PlantStudy::of(&setup.plant).unwrap();
        assert_eq!(*found.test, study.test(setup));
        assert_eq!(*found.design, study.design(setup));
        [
            Arc::ptr_eq(&found.study, &last.study),
            Arc::ptr_eq(&found.test, &last.test),
            Arc::ptr_eq(&found.design, &last.design),
        ]
    }

    #[test]
    fn a_change_makes_anew_what_depends_on_it() {
        let setup = TuningSetup::default();
        let last = RelayTuningStudy::update(&setup, &[], None);
        let kept = |change: fn(&mut TuningSetup)| {
            let mut changed = setup.clone();
            change(&mut changed);
            update(&changed, &last)
        };
        assert_eq!(kept(|_| ()), [true, true, true]);
        assert_eq!(kept(|s| s.test.kind = TestKind::Single), [true, false, true]);
        assert_eq!(kept(|s| s.design.target[0] = -0.25), [true, true, false]);
        assert_eq!(kept(|s| s.response.duration = 100.0), [true, true, false]);
        assert_eq!(kept(|s| s.plant = TuningPlant::Published(PublishedPlant::ProcessTwo)), [false; 3]);
    }

    #[test]
    fn a_pinned_session_answers_the_present_step() {
        let pinned = [TuningSetup::default(), {
            let plant = TuningPlant::Published(PublishedPlant::ProcessTwo);
            TuningSetup { plant, ..TuningSetup::default() }
        }];
        let mut setup = pinned[0].clone();
        setup.response.references = [0.0, 2.0];
        setup.response.duration *= 0.5;
        setup.design.target[0] = -0.25;
        let found = RelayTuningStudy::update(&setup, &pinned, None).pinned;
        for (found, pinned) in found.iter().zip(&pinned) {
            assert_eq!((&found.setup.plant, found.setup.design), (&pinned.plant, pinned.design));
            assert_eq!(found.setup.response.references, [0.0, 2.0]);
            assert_eq!(*found.result, PlantStudy::of(&found.setup.plant).unwrap().design(&found.setup));
        }
        let durations = [0, 1].map(|k: usize| found[k].setup.response.duration);
        // The plants have different units of time.
        assert_eq!(durations, [setup.response.duration, pinned[1].response.duration]);
        // A change of the controllers leaves it alone.
        let last = RelayTuningStudy::update(&setup, &pinned, None);
        setup.design.target[0] = -0.3;
        assert!(Arc::ptr_eq(&RelayTuningStudy::update(&setup, &pinned, Some(&last)).pinned, &last.pinned));
    }
}

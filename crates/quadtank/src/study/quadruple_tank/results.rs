use std::sync::Arc;

use crate::study::{PinnedResults, Quantity, Study, StudyError, update_pinned};

use super::quantities::QUANTITIES;
use super::{Analysis, Prepared, Run, Setup, run};

/// The study of the home bench.
#[derive(Clone, Copy, Debug)]
pub struct QuadrupleTankStudy;

/// What the home bench shows of a setup.
#[derive(Clone, Debug)]
pub struct Results {
    /// The setup that the results are of.
    pub setup: Arc<Setup>,
    /// What theory says.
    pub analysis: Arc<Result<Analysis, StudyError>>,
    /// What happens.
    pub run: Arc<Result<Run, StudyError>>,
    /// The pinned setups in the experiment of this one, see [`Setup::in_experiment_of`].
    pub pinned: PinnedResults<Setup, Result<Run, StudyError>>,
}

impl Study for QuadrupleTankStudy {
    type Setup = Setup;
    type Results = Results;
    const QUANTITIES: &'static [Quantity<Results>] = QUANTITIES;

    fn setup_of(results: &Results) -> &Arc<Setup> {
        &results.setup
    }

    /// The analysis does not depend on the experiment; the run depends on everything, and the pinned runs on the experiment.
    fn update(setup: &Setup, pinned: &[Setup], last: Option<&Results>) -> Results {
        let compared: Vec<Setup> = pinned.iter().map(|pinned| pinned.in_experiment_of(setup)).collect();
        let pinned = update_pinned(&compared, last.map(|last| &last.pinned), run);
        if let Some(last) = last.filter(|last| *last.setup == *setup) {
            return Results { pinned, ..last.clone() };
        }
        let prepared = Prepared::of(setup);
        let known = last.filter(|last| has_same_theory(&last.setup, setup)).map(|last| Arc::clone(&last.analysis));
        let analysis = known.unwrap_or_else(|| Arc::new(prepared.and_then(|prepared| Analysis::of(&prepared, setup))));
        let stability = analysis.as_ref().as_ref().ok().map(|analysis| analysis.closed_loop.stability);
        let run = Arc::new(prepared.and_then(|prepared| Run::of(&prepared, setup, stability)));
        Results { setup: Arc::new(setup.clone()), analysis, run, pinned }
    }
}

fn has_same_theory(one: &Setup, other: &Setup) -> bool {
    let theory = |setup: &Setup| (setup.plant, setup.valves, setup.operating_point, setup.controller);
    theory(one) == theory(other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::PresetId;
    use crate::study::quadruple_tank::{OperatingPointSpec, analyse, setup_of};

    fn results(setup: &Setup, pinned: &[Setup], last: Option<&Results>) -> Results {
        let found = QuadrupleTankStudy::update(setup, pinned, last);
        assert_eq!(*found.analysis, analyse(setup));
        assert_eq!(*found.run, run(setup));
        assert_eq!(*found.setup, *setup);
        found
    }

    #[test]
    fn a_change_of_the_experiment_keeps_the_analysis() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        let before = results(&setup, &[], None);
        setup.experiment.set_point_steps[0].size *= 2.0;
        let after = results(&setup, &[], Some(&before));
        assert!(Arc::ptr_eq(&before.analysis, &after.analysis));
        assert!(!Arc::ptr_eq(&before.run, &after.run));
    }

    #[test]
    fn a_change_of_what_theory_depends_on_makes_all_anew() {
        let setup = setup_of(PresetId::JohanssonMinimumPhase);
        let before = results(&setup, &[], None);
        let changes: [fn(&mut Setup); 3] =
            [|s| s.valves[0] = 0.4, |s| s.controller.loops[1].gain = 1.0, |s| *s = setup_of(PresetId::JunqueiraB)];
        for change in changes {
            let mut changed = setup.clone();
            change(&mut changed);
            let after = results(&changed, &[], Some(&before));
            assert!(!Arc::ptr_eq(&before.analysis, &after.analysis) && !Arc::ptr_eq(&before.run, &after.run));
        }
    }

    #[test]
    fn without_a_change_everything_is_kept() {
        let setup = setup_of(PresetId::CocotaMinimumPhase);
        let before = results(&setup, std::slice::from_ref(&setup), None);
        let after = results(&setup, std::slice::from_ref(&setup), Some(&before));
        assert!(Arc::ptr_eq(&before.setup, &after.setup) && Arc::ptr_eq(&before.run, &after.run));
        assert!(Arc::ptr_eq(&before.pinned, &after.pinned));
    }

    #[test]
    fn a_pinned_run_is_computed_once() {
        let setups = [PresetId::JohanssonMinimumPhase, PresetId::CocotaMinimumPhase].map(setup_of);
        // A change of valves or controller leaves the pinned runs alone.
        let before_that = results(&setups[1], &setups, None);
        let mut changed = setups[1].clone();
        changed.valves[0] = 0.7;
        let pinned = results(&changed, &setups, Some(&before_that)).pinned;
        assert!(Arc::ptr_eq(&pinned, &before_that.pinned));
        let before = results(&setups[0], &setups, None);
        let after = results(&setups[0], &setups[1..], Some(&before));
        assert_eq!(after.pinned.len(), 1);
        assert!(Arc::ptr_eq(&after.pinned[0].result, &before.pinned[1].result));
    }

    #[test]
    fn a_pinned_run_is_one_of_the_present_experiment() {
        let pinned = setup_of(PresetId::JohanssonMinimumPhase);
        let mut setup = pinned.clone();
        setup.controller.loops[0].gain *= 0.5;
        setup.operating_point = OperatingPointSpec::PumpVoltage([2.5, 2.8]);
        setup.experiment.set_point_steps[0].size *= 2.0;
        setup.experiment.measurement.noise_std = 1e-4;
        let compared = results(&setup, std::slice::from_ref(&pinned), None).pinned[0].clone();
        assert_eq!(
            (&compared.setup.experiment, compared.setup.operating_point),
            (&setup.experiment, setup.operating_point)
        );
        assert_eq!((compared.setup.controller, compared.setup.valves), (pinned.controller, pinned.valves));
        assert_eq!(*compared.result, run(&compared.setup));
        // Another rig keeps its own operating point.
        let other = setup_of(PresetId::CocotaMinimumPhase);
        let compared = results(&setup, std::slice::from_ref(&other), None).pinned[0].clone();
        assert_eq!(
            (&compared.setup.experiment, compared.setup.operating_point),
            (&setup.experiment, other.operating_point)
        );
        assert!(!compared.setup.is_same_rig(&setup));
    }
}

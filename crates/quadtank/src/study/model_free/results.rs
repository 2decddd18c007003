use std::sync::Arc;

use crate::study::{Quantity, Study, StudyError};

use super::quantities::QUANTITIES;
use super::{ModelFreeAnalysis, ModelFreeAnswer, ModelFreeSetup, analyse_model_free, run_analysed};

/// The study of the model-free bench.
#[derive(Clone, Copy, Debug)]
pub struct ModelFreeStudy;

/// What the model-free bench shows of a run.
#[derive(Clone, Debug)]
pub struct Results {
    /// The setup that the results are of.
    pub setup: Arc<ModelFreeSetup>,
    /// What theory says.
    pub analysis: Arc<ModelFreeAnalysis>,
    /// The run with its figures.
    pub answer: Arc<Result<ModelFreeAnswer, StudyError>>,
}

impl Study for ModelFreeStudy {
    type Setup = ModelFreeSetup;
    type Results = Results;
    const QUANTITIES: &'static [Quantity<Results>] = QUANTITIES;

    fn setup_of(results: &Results) -> &Arc<ModelFreeSetup> {
        &results.setup
    }

    /// Everything depends on the whole setup; nothing is pinned.
    fn update(setup: &ModelFreeSetup, _: &[ModelFreeSetup], last: Option<&Results>) -> Results {
        if let Some(last) = last.filter(|last| *last.setup == *setup) {
            return last.clone();
        }
        let analysis = analyse_model_free(setup);
        let answer = run_analysed(setup, &analysis);
        Results { setup: Arc::new(setup.clone()), analysis: Arc::new(analysis), answer: Arc::new(answer) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::model_free::run_model_free;

    #[test]
    fn a_change_makes_all_anew_and_none_keeps_all() {
        let mut setup = ModelFreeSetup::default();
        let before = ModelFreeStudy::update(&setup, &[], None);
        let same = ModelFreeStudy::update(&setup, &[], Some(&before));
        assert!(Arc::ptr_eq(&before.answer, &same.answer) && Arc::ptr_eq(&before.analysis, &same.analysis));
        setup.controller.loops[0].proportional = 1.0;
        let after = ModelFreeStudy::update(&setup, &[], Some(&before));
        assert_eq!(*after.answer, run_model_free(&setup));
        assert_eq!(*after.analysis, analyse_model_free(&setup));
        assert!(after.answer != before.answer);
    }
}

use quadtank::study::model_free::{analyse_model_free, run_model_free};

use super::{AnswerError, Answers, report_json_by_key, studied};
use crate::model_free::{ModelFreeScenario, run_to_csv};
use crate::report::model_free::{ModelFreeAnalysisReport, ModelFreeReport};

impl Answers for ModelFreeScenario {
    fn analysis_json(&self) -> Result<String, AnswerError> {
        let setup = &self.model_free;
        report_json_by_key(&ModelFreeAnalysisReport::of(setup, &analyse_model_free(setup)))
    }

    fn run_json(&self) -> Result<String, AnswerError> {
        report_json_by_key(&ModelFreeReport::from(&studied::<Self, _>(run_model_free(&self.model_free))?))
    }

    fn run_csv(&self) -> Result<String, AnswerError> {
        Ok(run_to_csv(&studied::<Self, _>(run_model_free(&self.model_free))?, &self.model_free))
    }
}

use quadtank::study::quadruple_tank::{analyse, run};

use super::{AnswerError, Answers, report_json, studied};
use crate::report::quadruple::AnalysisReport;
use crate::{Scenario, run_to_csv};

impl Answers for Scenario {
    fn analysis_json(&self) -> Result<String, AnswerError> {
        report_json(&AnalysisReport::from(&studied::<Self, _>(analyse(&self.setup))?))
    }

    fn run_json(&self) -> Result<String, AnswerError> {
        report_json(&studied::<Self, _>(run(&self.setup))?)
    }

    fn run_csv(&self) -> Result<String, AnswerError> {
        Ok(run_to_csv(&studied::<Self, _>(run(&self.setup))?))
    }
}

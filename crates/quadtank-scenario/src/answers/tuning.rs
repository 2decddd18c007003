use quadtank::sim::LoopTrace;
use quadtank::study::relay_tuning::{Tested, tune};

use super::{AnswerError, Answers, SearchRequest, report_json_by_key};
use crate::report::tuning::{TuningAnalysisReport, TuningReport};
use crate::tuning::{TuningScenario, record_to_csv, response_to_csv, warnings};

impl TuningScenario {
    fn report_json(&self) -> Result<String, AnswerError> {
        report_json_by_key(&TuningReport::of(&self.tuning, &tune(&self.tuning)?)?)
    }
}

impl Answers for TuningScenario {
    fn analysis_json(&self) -> Result<String, AnswerError> {
        report_json_by_key(&TuningAnalysisReport::of(&self.tuning)?)
    }

    fn run_json(&self) -> Result<String, AnswerError> {
        self.report_json()
    }

    /// The response of the design, one row per sample and per arrival of what a dead time had held back, beside the one that it is
    /// compared with.
    fn run_csv(&self) -> Result<String, AnswerError> {
        let found = tune(&self.tuning)?;
        Ok(found.design.as_ref().map(response_to_csv).unwrap_or_default())
    }

    fn tuning_json(&self, _: &SearchRequest) -> Result<String, AnswerError> {
        self.report_json()
    }

    /// The record of the relay test, one row per step, switch and arrival.
    fn tuning_csv(&self, _: &SearchRequest) -> Result<String, AnswerError> {
        Ok(relay_record(&tune(&self.tuning)?.test).map(record_to_csv).unwrap_or_default())
    }

    fn warnings(&self) -> Vec<String> {
        warnings(&self.tuning).iter().map(ToString::to_string).collect()
    }
}

/// The record of a relay test; of several tests the last.
pub fn relay_record(test: &Tested) -> Option<&LoopTrace> {
    match test {
        Tested::Single(test, _) | Tested::Simultaneous(test, _) => Some(&test.trace),
        Tested::Independent(loops) => loops.last().map(|(test, _)| &test.trace),
        Tested::Sequential(steps) => steps.last().map(|step| &step.test.trace),
    }
}

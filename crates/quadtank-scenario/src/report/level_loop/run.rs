use quadtank::assess::{BothIndices, HarrisError, HarrisIndex, IndexError, IndexVerdict, ValveTravel, VarianceIndex};
use quadtank::sim::level::{LevelFigures, LevelRunError, LevelStepResponse, NoStepAnswer};
use quadtank::study::level_loop::{Finding, LevelLoopAnswer, LevelLoopSetup, Objective};
use serde::Serialize;

use super::{ClosedLoopReport, finite};
use crate::level_loop::{LevelLoopWarning, warnings};
use crate::report::Answer;

/// What happens in the run of a level loop.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelLoopReport {
    /// Figures of level, outflow and output over all of the log.
    pub figures: LevelFigures,
    /// The answer to a step of the set-point, or why there is none; null where that does not step once, at the start.
    pub step: Option<Answer<LevelStepResponse, NoStepAnswer>>,
    /// How the valve moves.
    pub travel: ValveTravel,
    /// The linear loop with the controller; null for an output by hand.
    pub closed_loop: Option<Answer<ClosedLoopReport>>,
    /// Figures of the reference tuning on the model with its error, or why it has no run.
    pub reference: Answer<LevelFigures, LevelRunError>,
    /// Variances of the reference over those of the loop, or why they have no ratio; null without a run of the reference.
    pub indices: Option<Answer<IndicesReport, IndexError>>,
    /// The Harris index of the level, or why there is none.
    pub harris: Answer<HarrisReport, HarrisError>,
    /// What is to be said about the run.
    pub findings: Vec<Finding>,
    /// What the document may not have been meant to say.
    pub warnings: Vec<LevelLoopWarning>,
}

/// The indices of the level and of the outflow (Andreis 2017, equations 27 to 30).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct IndicesReport {
    /// Of the level, for tight control.
    pub level: IndexReport,
    /// Of the outflow, for averaging control.
    pub outflow: IndexReport,
    /// Which of them is that of the objective.
    pub of_objective: ObjectiveOf,
    /// Whether both advise the same.
    pub agree: bool,
}

/// Which variable an objective is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ObjectiveOf {
    /// Tight control.
    Level,
    /// Averaging control.
    Outflow,
}

/// A variance that could be had over the one there is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct IndexReport {
    /// Variance of the reference (m² or (m³/s)²).
    pub reference_variance: f64,
    /// Variance of the loop (m² or (m³/s)²).
    pub actual_variance: f64,
    /// Their ratio: 1 for the best loop (no unit); null where it is too large for a number.
    pub quality: Option<f64>,
    /// One less that: 0 for the best loop (no unit); null likewise.
    pub loss: Option<f64>,
    /// What it advises.
    pub verdict: IndexVerdict,
}

/// The index of Harris.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct HarrisReport {
    /// Least variance that feedback could leave over the one there is.
    pub index: IndexReport,
    /// Coefficients of the autoregressive model (no unit).
    pub coefficients: Vec<f64>,
    /// Variance of its residuals (m²).
    pub residual_variance: f64,
}

impl LevelLoopReport {
    /// The report of the run of a setup.
    pub fn of(setup: &LevelLoopSetup, found: &LevelLoopAnswer) -> Self {
        let quality = found.quality.transpose();
        Self {
            figures: found.figures,
            step: found.step.map(|step| Answer::of(&step, |answer| *answer)),
            travel: found.travel,
            closed_loop: quality.map(|quality| Answer::of(&quality, ClosedLoopReport::from)),
            reference: Answer::of(&found.reference, |figures| *figures),
            indices: found.indices.map(|indices| Answer::of(&indices, |both| IndicesReport::of(setup, both))),
            harris: Answer::of(&found.harris, HarrisReport::from),
            findings: found.findings.clone(),
            warnings: warnings(setup),
        }
    }
}

impl IndicesReport {
    fn of(setup: &LevelLoopSetup, both: &BothIndices) -> Self {
        let of_objective = match setup.objective {
            Objective::Tight => ObjectiveOf::Level,
            Objective::Averaging { .. } => ObjectiveOf::Outflow,
        };
        Self { level: both.level.into(), outflow: both.outflow.into(), of_objective, agree: both.agree() }
    }
}

impl From<VarianceIndex> for IndexReport {
    fn from(index: VarianceIndex) -> Self {
        Self {
            reference_variance: index.reference,
            actual_variance: index.actual,
            quality: finite(index.quality()),
            loss: finite(index.loss()),
            verdict: index.verdict(),
        }
    }
}

impl From<&HarrisIndex> for HarrisReport {
    fn from(found: &HarrisIndex) -> Self {
        Self {
            index: found.index.into(),
            coefficients: found.coefficients.clone(),
            residual_variance: found.residual_variance,
        }
    }
}

//! Controllers by rules and published ones, side by side in the experiment of a session.

use crate::control::{Pairing, ParallelPid};
use crate::linear::LoopStability;
use crate::literature::campestrini::PublishedPlant;
use crate::literature::wood_berry::PublishedControllers;
use crate::sim::StepMetrics;
use crate::tuning::{PairRule, PairRuleError, TuningError};

use super::{DesignRoot, GivenPid, LoopPeaks, PlantStudy, TuningPlant, TuningSetup};

/// Stability, robustness and step figures of a loop with a pair of controllers, in the response of a session without its decoupler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControllerAssessment {
    /// Whether the loop is stable.
    pub stability: LoopStability,
    /// Its peaks.
    pub peaks: LoopPeaks,
    /// Figures of both outputs in the response to the references of the session.
    pub figures: [StepMetrics; 2],
    /// Whether the response stays bounded, so that its figures mean something.
    pub is_bounded: bool,
}

/// Published controllers and what they do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparedControllers {
    /// Which ones.
    pub published: PublishedControllers,
    /// What they do.
    pub judged: ControllerAssessment,
}

/// The controllers that a rule finds for a plant, with their assessment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RuleControllers {
    /// The rule.
    pub rule: PairRule,
    /// Its controllers with what they do, or why there are none.
    pub outcome: Result<([GivenPid; 2], ControllerAssessment), PairRuleError>,
}

impl PlantStudy {
    /// What each pair of published controllers does in the response of a session, without a decoupler; none for a plant that has no
    /// published controllers.
    ///
    /// # Errors
    /// [`TuningError::UnstablePlant`] or [`TuningError::Linear`], as [`Design::new`](crate::tuning::Design::new).
    pub fn compare_published(&self, setup: &TuningSetup) -> Result<Vec<ComparedControllers>, TuningError> {
        if setup.plant != TuningPlant::Published(PublishedPlant::WoodBerry) {
            return Ok(Vec::new());
        }
        let compared = |published: PublishedControllers| {
            Ok(ComparedControllers { published, judged: self.judge(published.gains(), Pairing::Diagonal, setup)? })
        };
        PublishedControllers::ALL.into_iter().map(compared).collect()
    }

    /// What each rule makes of the plant in the pairing of the session.
    pub fn compare_rules(&self, setup: &TuningSetup) -> Vec<RuleControllers> {
        let outcome = |rule| {
            let controllers = self.by_rule(rule, setup.design.pairing)?;
            let judged = self.judge(controllers.map(ParallelPid::from), setup.design.pairing, setup)?;
            Ok((controllers, judged))
        };
        PairRule::ALL.into_iter().map(|rule| RuleControllers { rule, outcome: outcome(rule) }).collect()
    }

    /// What the controllers at work do, as the others are judged: without a decoupler.
    ///
    /// # Errors
    /// [`TuningError::UnstablePlant`] or [`TuningError::Linear`], as [`Design::new`](crate::tuning::Design::new).
    pub fn judge_root(&self, root: &DesignRoot, setup: &TuningSetup) -> Result<ControllerAssessment, TuningError> {
        self.judge(root.controllers, root.pairing, setup)
    }

    /// The controllers that a rule makes of the plant in a pairing.
    ///
    /// # Errors
    /// [`PairRuleError`] for a plant of which the rule makes nothing.
    pub fn by_rule(&self, rule: PairRule, pairing: Pairing) -> Result<[GivenPid; 2], PairRuleError> {
        Ok(rule.settings(&self.wired(pairing))?.map(GivenPid::from))
    }

    fn judge(
        &self,
        controllers: [ParallelPid; 2],
        pairing: Pairing,
        setup: &TuningSetup,
    ) -> Result<ControllerAssessment, TuningError> {
        let (stability, response) = self.response_with(controllers, pairing, setup)?;
        let peaks = LoopPeaks::of(&self.wired(pairing), controllers, stability)?;
        Ok(ControllerAssessment { stability, peaks, figures: response.figures, is_bounded: response.is_bounded })
    }
}

//! The controllers that are published for a plant, side by side in the experiment of a session.

use crate::linear::LoopStability;
use crate::literature::campestrini::PublishedPlant;
use crate::literature::wood_berry::PublishedControllers;
use crate::sim::StepMetrics;
use crate::tuning::TuningError;

use super::{LoopPeaks, PlantStudy, TuningPlant, TuningSetup};

/// Published controllers and what they do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparedControllers {
    /// Which ones.
    pub published: PublishedControllers,
    /// Whether the loop is stable.
    pub stability: LoopStability,
    /// Its peaks.
    pub peaks: LoopPeaks,
    /// Figures of both outputs in the response to the references of the session.
    pub figures: [StepMetrics; 2],
    /// Whether the response stays bounded, so that its figures mean something.
    pub is_bounded: bool,
}

impl PlantStudy {
    /// What each pair of published controllers does in the response of a session, without a decoupler; none for a plant that has no
    /// published controllers.
    ///
    /// # Errors
    /// What is wrong with the plant.
    pub fn compare_published(&self, setup: &TuningSetup) -> Result<Vec<ComparedControllers>, TuningError> {
        if setup.plant != TuningPlant::Published(PublishedPlant::WoodBerry) {
            return Ok(Vec::new());
        }
        let compared = |published: PublishedControllers| {
            let gains = published.gains();
            let (stability, response) = self.response_with(gains, setup)?;
            let peaks = LoopPeaks::of(&self.plant, gains, stability)?;
            let (figures, is_bounded) = (response.figures, response.is_bounded);
            Ok(ComparedControllers { published, stability, peaks, figures, is_bounded })
        };
        PublishedControllers::ALL.into_iter().map(compared).collect()
    }
}

use crate::plant::{Jacobian, OperatingPoint, QuadrupleTank};
use crate::study::StudyError;

use super::Setup;

/// The plant of a setup at its operating point: what analysis and run both begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared {
    /// The rig, with the valves of the setup.
    pub plant: QuadrupleTank,
    /// The operating point; walls and pump limits are ignored.
    pub operating_point: OperatingPoint,
    /// The linear model around it.
    pub jacobian: Jacobian,
}

impl Prepared {
    /// Prepares a setup.
    ///
    /// # Errors
    /// [`StudyError`] at `operating_point` when levels are given and no input holds them.
    pub fn of(setup: &Setup) -> Result<Self, StudyError> {
        let (plant, operating_point) = (setup.plant(), setup.operating_point()?);
        Ok(Self { plant, operating_point, jacobian: plant.linearise(&operating_point) })
    }
}

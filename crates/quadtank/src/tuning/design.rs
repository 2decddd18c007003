//! A plant and its controllers as a loop: stability, loci, margins and peaks by the generalised Nyquist criterion.

use nalgebra::Matrix2;

use crate::control::PidMatrix;
use crate::linear::{
    Closure, Complex, Loci, LoopPeak, LoopStability, Margins, ReturnRatio, TransferMatrix, biggest_log_modulus,
    largest_sensitivity,
};

use super::TuningError;
use super::critical::frequency_range;
use super::experiment::check_stable;

/// Points of the loci where nothing else is asked for.
const POINTS: usize = 600;

/// A loop of a stable plant and linear controllers.
#[derive(Clone, Debug)]
pub struct Design<'a> {
    plant: &'a TransferMatrix,
    controllers: PidMatrix,
    ratio: ReturnRatio<'a>,
}

impl<'a> Design<'a> {
    /// # Errors
    /// [`TuningError::UnstablePlant`], or [`TuningError::Linear`] for gains that are not finite.
    pub fn new(plant: &'a TransferMatrix, controllers: PidMatrix) -> Result<Self, TuningError> {
        check_stable(plant)?;
        let ratio = ReturnRatio::new(plant, controllers.transfer_matrix()?, controllers.integrators());
        Ok(Self { plant, controllers, ratio })
    }

    /// Return ratio G(jω) K(jω), with derivative filters.
    pub fn ratio(&self, frequency: f64) -> Matrix2<Complex> {
        self.ratio.at(frequency)
    }

    /// Whether the closed loop is stable, dead times included.
    pub fn stability(&self) -> LoopStability {
        LoopStability::of(&self.ratio)
    }

    /// Both characteristic loci over the frequencies of the plant.
    ///
    /// # Errors
    /// As [`frequency_range`].
    pub fn loci(&self) -> Result<Loci, TuningError> {
        let (low, high) = frequency_range(self.plant)?;
        Ok(self.loci_between(low, high))
    }

    /// The loci between two frequencies, for a picture: far beyond the critical one a dead time winds them round the origin.
    pub fn loci_between(&self, low: f64, high: f64) -> Loci {
        Loci::along(|w| self.ratio(w), low, high, POINTS)
    }

    /// Margins over all frequencies; `None` where the search is beyond its bound on work.
    pub fn margins(&self) -> Option<Margins> {
        Margins::of(&self.ratio)
    }

    /// Largest singular value of the sensitivity over all frequencies, for a stable loop; as [`largest_sensitivity`].
    pub fn largest_sensitivity(&self) -> Option<LoopPeak> {
        largest_sensitivity(&self.ratio)
    }

    /// Biggest closed-loop log modulus (dB), for a stable loop; as [`biggest_log_modulus`].
    pub fn biggest_log_modulus(&self) -> Option<LoopPeak> {
        biggest_log_modulus(&self.ratio)
    }

    /// How the loci close, by what the loop is at ω = 0: G(0) Ki with integral action in both loops, else G(0) Kp.
    pub fn closure(&self) -> Closure {
        let gains = if self.controllers.integrators() == 2 {
            self.controllers.integral()
        } else {
            Matrix2::from_fn(|row, column| self.controllers.0[row][column].proportional)
        };
        Closure::of(&(self.plant.dc_gain() * gains))
    }
}

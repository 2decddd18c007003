//! A plant and its controllers as a loop: stability, loci and margins by the generalised Nyquist criterion.

use nalgebra::Matrix2;

use crate::control::{ParallelPid, PidMatrix};
use crate::linear::{Closure, Complex, Loci, LoopOutline, LoopStability, Margins, TransferFunction, TransferMatrix};

use super::TuningError;
use super::critical::{frequency_range, least_damping};
use super::experiment::check_stable;

/// Points of the loci where nothing else is asked for.
const POINTS: usize = 600;

/// A loop of a stable plant and linear controllers.
#[derive(Clone, Debug)]
pub struct Design<'a> {
    plant: &'a TransferMatrix,
    controllers: PidMatrix,
    range: (f64, f64),
    damping: f64,
}

impl<'a> Design<'a> {
    /// # Errors
    /// [`TuningError::UnstablePlant`], or as [`frequency_range`].
    pub fn new(plant: &'a TransferMatrix, controllers: PidMatrix) -> Result<Self, TuningError> {
        check_stable(plant)?;
        Ok(Self { plant, controllers, range: frequency_range(plant)?, damping: least_damping(plant)? })
    }

    /// Return ratio G(jω) K(jω), with derivative filters.
    pub fn ratio(&self, frequency: f64) -> Matrix2<Complex> {
        self.plant.at(Complex::new(0.0, frequency)) * self.controllers.at(frequency)
    }

    /// Whether the closed loop is stable, dead times included.
    pub fn stability(&self) -> LoopStability {
        let (low, high) = self.range;
        let filters = self.controllers.0.as_flattened().iter().map(ParallelPid::filter_time).filter(|&time| time > 0.0);
        let quickest = filters.map(f64::recip).fold(0.0, f64::max);
        let dead_time = self.plant.0.as_flattened().iter().map(TransferFunction::dead_time).fold(0.0, f64::max);
        let integrators = self.controllers.integrators();
        let damping = self.damping;
        // Two loops turn at most as quickly as the longest dead time twice.
        let outline =
            LoopOutline { low, high: high.max(10.0 * quickest), integrators, damping, dead_time: 2.0 * dead_time };
        LoopStability::of(|w| self.ratio(w), &outline)
    }

    /// Both characteristic loci over the frequencies of the plant.
    pub fn loci(&self) -> Loci {
        Loci::along(|w| self.ratio(w), self.range.0, self.range.1, POINTS)
    }

    /// The loci between two frequencies, for a picture: far beyond the critical one a dead time winds them round the origin.
    pub fn loci_between(&self, low: f64, high: f64) -> Loci {
        Loci::along(|w| self.ratio(w), low, high, POINTS)
    }

    /// Margins of [`loci`](Self::loci).
    pub fn margins(&self, loci: &Loci) -> Margins {
        loci.margins(|w| self.ratio(w))
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

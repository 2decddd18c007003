use nalgebra::{DMatrix, Matrix2};

use crate::interaction::{niederlinski, relative_gain_array};
use crate::linear::{LinearError, TransferMatrix};

/// What the steady-state gain says of a plant with two loops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyState {
    /// G(0); not finite for integrating elements.
    pub dc_gain: Matrix2<f64>,
    /// Gains and rates at rest, see [`TransferMatrix::rest_gain`].
    pub rest_gain: Matrix2<f64>,
    /// λ11 of the relative gain array, in the limit s → 0 for an integrating plant; an error where the gains at rest are singular.
    pub rga_11: Result<f64, LinearError>,
    /// Niederlinski index of the diagonal pairing; `None` where a diagonal gain is 0, and where the gains at rest are singular, because its
    /// sign is rounding there.
    pub niederlinski_diagonal: Option<f64>,
}

impl SteadyState {
    /// The steady state of a plant.
    pub fn of(plant: &TransferMatrix) -> Self {
        let (dc_gain, rest_gain) = (plant.dc_gain(), plant.rest_gain());
        let gain = DMatrix::from_fn(2, 2, |row, column| rest_gain[(row, column)]);
        let rga_11 = relative_gain_array(&gain).map(|array| array[(0, 0)]);
        let niederlinski_diagonal = if rga_11.is_ok() { niederlinski(&gain)[0] } else { None };
        Self { dc_gain, rest_gain, rga_11, niederlinski_diagonal }
    }
}

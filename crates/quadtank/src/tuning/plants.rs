use nalgebra::Matrix2;
use serde::{Deserialize, Serialize};

use crate::control::{ParallelPid, PidMatrix};
use crate::linear::{LinearError, TransferFunction, TransferMatrix};
use crate::plant::Jacobian;

/// A published plant with two inputs and two outputs, as transfer functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum PublishedPlant {
    /// Distillation column of Wood and Berry (1973), as in Campestrini (2006, eq. 86). Time in minutes, which that source
    /// calls seconds. Loop 2 has negative gain.
    WoodBerry,
    /// "Process II" of Campestrini (2006, eq. 70), after Zgorzelski, Unbehauen and Niederlinski (1990). Time in seconds.
    ProcessTwo,
}

impl PublishedPlant {
    /// The plant, in its own unit of time.
    ///
    /// # Errors
    /// None for the printed parameters; the type is that of [`TransferFunction::new`].
    pub fn transfer_matrix(self) -> Result<TransferMatrix, LinearError> {
        let g = TransferFunction::lags;
        Ok(TransferMatrix(match self {
            Self::WoodBerry => {
                [[g(12.8, &[16.7], 1.0)?, g(-18.9, &[21.0], 3.0)?], [g(6.6, &[10.9], 7.0)?, g(-19.4, &[14.4], 3.0)?]]
            }
            Self::ProcessTwo => [
                [g(0.5, &[0.1, 0.1, 0.2, 0.2], 0.0)?, g(-1.0, &[0.1, 0.2, 0.2], 0.0)?],
                [g(1.0, &[0.1, 0.2, 0.2], 0.0)?, g(2.4, &[0.1, 0.2, 0.2, 0.5], 0.0)?],
            ],
        }))
    }
}

/// The full controller of the column of Wood and Berry, A diag(μ1, μ2) B by the characteristic-locus method (Campestrini 2006,
/// eqs. 87 and 88). A21 has lost its sign in print; with −0.18 the product is the printed one, but for the rounding of A and B.
pub fn wood_berry_full_controller() -> PidMatrix {
    let pi = |proportional, integral| ParallelPid { proportional, integral, ..ParallelPid::default() };
    let a = Matrix2::new(-1.0, 0.42, -0.18, 1.0);
    let b = Matrix2::new(-1.08, 0.45, -0.20, 1.08);
    PidMatrix::between(&a, [pi(0.437, 0.154), pi(-0.167, -0.019)], &b)
}

/// The linear model of the quadruple tank as transfer functions, from pump voltages (V) to measured levels (V), in seconds:
/// one lag where a pump feeds a lower tank, two where its water passes an upper one (Johansson 2000, eq. 2). The
/// outflow of a quasi-steady tank equals its inflow.
///
/// # Errors
/// None for a model of a plant; the type is that of [`TransferFunction::new`].
pub fn tank_transfer_matrix(jacobian: &Jacobian) -> Result<TransferMatrix, LinearError> {
    let Jacobian { a, b, c, quasi_steady } = jacobian;
    let time = |tank: usize| -1.0 / a[(tank, tank)];
    let none = || TransferFunction::lags(0.0, &[], 0.0);
    let own = |i: usize| {
        if quasi_steady[i] { none() } else { TransferFunction::lags(c[(i, i)] * b[(i, i)] * time(i), &[time(i)], 0.0) }
    };
    let across = |i: usize| {
        let (upper, other) = (i + 2, 1 - i);
        if quasi_steady[i] {
            none()
        } else if quasi_steady[upper] {
            TransferFunction::lags(c[(i, i)] * b[(i, other)] * time(i), &[time(i)], 0.0)
        } else {
            let gain = c[(i, i)] * a[(i, upper)] * b[(upper, other)] * time(i) * time(upper);
            TransferFunction::lags(gain, &[time(i), time(upper)], 0.0)
        }
    };
    Ok(TransferMatrix([[own(0)?, across(0)?], [across(1)?, own(1)?]]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::{Complex, StateSpace};
    use crate::plant::PresetId;

    #[test]
    fn elements_of_the_tank_are_those_of_its_state_space() {
        for preset in PresetId::ALL.map(PresetId::preset) {
            for valves in [preset.plant.valves, [0.0, 0.4], [1.0, 1.0]] {
                let plant = preset.plant.with_valves(valves);
                let jacobian = plant.linearise(&plant.free_equilibrium(preset.pump_voltage));
                let (a, b, c) = jacobian.reduced();
                let model = StateSpace::strictly_proper(a, b, c).unwrap();
                let transfer = tank_transfer_matrix(&jacobian).unwrap();
                for w in [1e-3, 0.02, 0.5] {
                    let (found, expected) = (transfer.at(Complex::new(0.0, w)), model.frequency_response(w).unwrap());
                    let size = expected.norm();
                    for i in 0..4 {
                        let at = (i / 2, i % 2);
                        assert!((found[at] - expected[at]).norm() <= 1e-12 * size, "{valves:?}, {w}, {at:?}");
                    }
                }
            }
        }
    }
}

use nalgebra::Matrix2;
use serde::{Deserialize, Serialize};

use crate::control::PidMatrix;
use crate::linear::{LinearError, TransferFunction, TransferMatrix};

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
    let a = Matrix2::new(-1.0, 0.42, -0.18, 1.0);
    let b = Matrix2::new(-1.08, 0.45, -0.20, 1.08);
    PidMatrix::between(&a, [(0.437, 0.154), (-0.167, -0.019)], &b)
}

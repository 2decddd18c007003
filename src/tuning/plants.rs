use crate::linear::{LinearError, TransferFunction, TransferMatrix};

/// A published plant with two inputs and two outputs, as transfer functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

    /// Lowest and highest frequency between which its critical points lie (rad per unit of time).
    pub const fn frequencies(self) -> (f64, f64) {
        match self {
            Self::WoodBerry => (0.02, 20.0),
            Self::ProcessTwo => (0.1, 100.0),
        }
    }
}

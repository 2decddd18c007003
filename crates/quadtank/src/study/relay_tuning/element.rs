use thiserror::Error;

use crate::linear::{LinearError, TransferFunction, degree};
use crate::tuning::poles_off_the_origin;
use serde::{Deserialize, Serialize};

/// An element `b(s)/a(s) e^(−θ s)` of a plant of one's own.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Element {
    /// Coefficients of b by rising powers of s.
    pub numerator: Vec<f64>,
    /// Coefficients of a by rising powers of s.
    pub denominator: Vec<f64>,
    /// Dead time θ.
    #[serde(default)]
    pub dead_time: f64,
}

/// Why the bench cannot work with an element: it takes proper elements whose poles are in the left half-plane or at the origin.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum ElementError {
    /// All coefficients of the denominator are zero.
    #[error("the denominator is zero")]
    NoDenominator,
    /// More zeros than poles.
    #[error(
        "an improper element (degree {numerator} over {denominator}) is not supported: it would answer a step with an impulse"
    )]
    Improper {
        /// Degree of the numerator.
        numerator: usize,
        /// Degree of the denominator.
        denominator: usize,
    },
    /// A pole that is neither in the left half-plane nor at the origin.
    #[error(
        "an unstable element (a pole with the real part {real_part}) is not supported, only stable and integrating ones"
    )]
    Unstable {
        /// Real part of the right-most pole.
        real_part: f64,
    },
}

impl From<TransferFunction> for Element {
    fn from(of: TransferFunction) -> Self {
        let dead_time = of.dead_time();
        Self { numerator: of.numerator().to_vec(), denominator: of.denominator().to_vec(), dead_time }
    }
}

impl Element {
    /// As a transfer function.
    ///
    /// # Errors
    /// As [`TransferFunction::new`].
    pub fn transfer_function(&self) -> Result<TransferFunction, LinearError> {
        TransferFunction::new(self.numerator.clone(), self.denominator.clone(), self.dead_time)
    }

    /// What is wrong with an element whose numbers are all finite. One whose numerator is zero passes nothing, whatever its
    /// degrees are, but its poles count as any other.
    pub fn fault(&self) -> Option<ElementError> {
        let Some(denominator) = degree(&self.denominator) else { return Some(ElementError::NoDenominator) };
        match degree(&self.numerator) {
            Some(numerator) if numerator > denominator => {
                return Some(ElementError::Improper { numerator, denominator });
            }
            _ => {}
        }
        // Poles that no iteration finds are an error where the plant is studied.
        let rightmost = self.transfer_function().and_then(|element| poles_off_the_origin(&element)).ok()?.last()?.re;
        (rightmost >= 0.0).then_some(ElementError::Unstable { real_part: rightmost })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_says_what_is_not_supported() {
        let fault = |numerator: &[f64], denominator: &[f64]| {
            Element { numerator: numerator.to_vec(), denominator: denominator.to_vec(), dead_time: 0.0 }.fault()
        };
        let improper = ElementError::Improper { numerator: 2, denominator: 1 };
        assert_eq!(fault(&[1.0, 0.0, 3.0], &[5.0, 1.0]), Some(improper));
        assert_eq!(fault(&[1.0], &[0.0, 0.0]), Some(ElementError::NoDenominator));
        assert_eq!(fault(&[1.0], &[]), Some(ElementError::NoDenominator));
        assert_eq!(fault(&[1.0], &[-0.5, 1.0]), Some(ElementError::Unstable { real_part: 0.5 }));
        // An oscillator: the imaginary axis is not stable either.
        assert!(matches!(fault(&[1.0], &[4.0, 0.0, 1.0]), Some(ElementError::Unstable { .. })));
        assert_eq!(fault(&[1.0], &[0.0, -2.0, 1.0]), Some(ElementError::Unstable { real_part: 2.0 }));
        let supported: [(&[f64], &[f64]); 7] = [
            (&[1.0], &[1.0, 2.0]),
            (&[0.0, 0.0], &[1.0]),
            (&[], &[1.0, 1.0]),
            // Biproper and integrating ones.
            (&[1.0, 1.0], &[5.0, 1.0]),
            (&[1.0, 0.0], &[2.0, 0.0, 0.0]),
            (&[1.0], &[0.0, 1.0, 1.0]),
            (&[1.0], &[0.0, 0.0, 3.0]),
        ];
        for (numerator, denominator) in supported {
            assert_eq!(fault(numerator, denominator), None, "{numerator:?} / {denominator:?}");
        }
    }
}

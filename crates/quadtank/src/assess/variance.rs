use serde::Serialize;
use thiserror::Error;

use crate::sim::level::SampleStatistics;

/// The ratio of a variance that could be had to the one there is (Andreis 2017, Eqs. 27, 28).
///
/// Of the level it is the index of tight control, `Id_varPV` (Eq. 51), of the outflow that of averaging control, `Id_varMV`
/// (Eqs. 30, 53). With the variance of minimum-variance control it is the index of Harris (Eq. 29).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VarianceIndex {
    /// Variance that could be had, such as that of the optimal tuning.
    pub reference: f64,
    /// Variance of the loop as it is.
    pub actual: f64,
}

/// Variances without an index.
#[derive(Clone, Copy, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum IndexError {
    /// The loop does not move, so its variance is not to be improved.
    #[error("the variance of the loop is zero")]
    ZeroVariance,
    /// A variance that is negative or not finite.
    #[error("{value} is no variance")]
    NoVariance {
        /// What was given for one.
        #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
        value: f64,
    },
}

/// What an index advises. The bounds are ours: the source says "near 1" and "near 0".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum IndexVerdict {
    /// 0.9 to 1.05: leave the tuning.
    Keep,
    /// 0.5 to 0.9: something is to be gained.
    Fair,
    /// Below 0.5: tune anew.
    Retune,
    /// Above 1.05: the reference is worse than the loop, which the index of the other objective, or a wrong model, makes it.
    WrongIndex,
}

impl VarianceIndex {
    /// Of a reference and an actual variance.
    ///
    /// # Errors
    /// [`IndexError`] for an actual variance of 0 and for what is no variance.
    pub fn new(reference: f64, actual: f64) -> Result<Self, IndexError> {
        for value in [reference, actual] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(IndexError::NoVariance { value });
            }
        }
        if actual == 0.0 { Err(IndexError::ZeroVariance) } else { Ok(Self { reference, actual }) }
    }

    /// `η = J_des/J_act` (Eq. 28): 1 for the best loop, 0 for the worst.
    pub fn quality(&self) -> f64 {
        self.reference / self.actual
    }

    /// `η = 1 − J_des/J_act` (Eq. 27): 0 for the best loop, 1 for the worst.
    pub fn loss(&self) -> f64 {
        1.0 - self.quality()
    }

    /// What it advises.
    pub fn verdict(&self) -> IndexVerdict {
        match self.quality() {
            quality if quality > 1.05 => IndexVerdict::WrongIndex,
            quality if quality >= 0.9 => IndexVerdict::Keep,
            quality if quality >= 0.5 => IndexVerdict::Fair,
            _ => IndexVerdict::Retune,
        }
    }
}

/// The indices of level and outflow of the same loops, one of which is that of the objective (Andreis 2017, §5.6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BothIndices {
    /// Of the level, for tight control.
    pub level: VarianceIndex,
    /// Of the outflow, for averaging control.
    pub outflow: VarianceIndex,
}

impl BothIndices {
    /// Of the statistics of level and outflow under a reference and the actual controller.
    ///
    /// # Errors
    /// As [`VarianceIndex::new`].
    pub fn of(reference: &[SampleStatistics; 2], actual: &[SampleStatistics; 2]) -> Result<Self, IndexError> {
        let of = |k: usize| {
            // Rounding is no variance.
            let actual = if actual[k].is_still() { 0.0 } else { actual[k].variance };
            VarianceIndex::new(reference[k].variance, actual)
        };
        Ok(Self { level: of(0)?, outflow: of(1)? })
    }

    /// Whether both advise the same. Where they do not, the index of the wrong objective misleads.
    pub fn agree(&self) -> bool {
        self.level.verdict() == self.outflow.verdict()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use IndexVerdict::{Keep, Retune, WrongIndex};

    #[test]
    fn both_definitions_and_their_advice() {
        let index = VarianceIndex::new(3.0, 4.0).unwrap();
        assert_eq!((index.quality(), index.loss(), index.verdict()), (0.75, 0.25, IndexVerdict::Fair));
        let verdict = |reference| VarianceIndex::new(reference, 1.0).unwrap().verdict();
        assert_eq!([0.0, 0.02, 0.94, 1.0, 4.7].map(verdict), [Retune, Retune, Keep, Keep, WrongIndex]);
    }

    #[test]
    fn what_is_no_variance_has_no_index() {
        assert_eq!(VarianceIndex::new(1.0, 0.0), Err(IndexError::ZeroVariance));
        assert_eq!(VarianceIndex::new(-1.0, 1.0), Err(IndexError::NoVariance { value: -1.0 }));
        assert!(matches!(VarianceIndex::new(1.0, f64::NAN), Err(IndexError::NoVariance { .. })));
    }
}

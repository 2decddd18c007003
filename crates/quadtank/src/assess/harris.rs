use nalgebra::{DMatrix, DVector};
use serde::Serialize;
use thiserror::Error;

use super::{IndexError, VarianceIndex};
use crate::sim::level::is_rounding;

/// The index of Harris (1989) from routine data: the variance that no feedback can remove, because it is made within the dead time,
/// over the variance there is (Andreis 2017, Eq. 29).
///
/// The data are described by an autoregressive model by least squares, `y(k) = Σ a_i y(k − i) + e(k)` about their mean; with its
/// impulse response ψ the least variance is `σ_e² Σ_{i < b} ψ_i²` for a dead time of b samples.
#[derive(Clone, Debug, PartialEq)]
pub struct HarrisIndex {
    /// The index: least over actual variance.
    pub index: VarianceIndex,
    /// Coefficients `a_1, a_2, …` of the model.
    pub coefficients: Vec<f64>,
    /// Variance `σ_e²` of its residuals.
    pub residual_variance: f64,
}

/// Data without an index of Harris.
#[derive(Clone, Copy, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum HarrisError {
    /// A model without coefficients, or a dead time without samples.
    #[error("{field} is {value}, below 1")]
    OutOfRange {
        /// The parameter.
        field: &'static str,
        /// Its value.
        value: usize,
    },
    /// Fewer samples than a model of this order needs.
    #[error("{samples} samples are too few for a model of order {order}")]
    TooFewSamples {
        /// How many there are.
        samples: usize,
        /// Order of the model.
        order: usize,
    },
    /// The dead time is as long as the data, so that no row shows the effect of feedback.
    #[error("a dead time of {dead_time} samples is as long as the data, {samples} samples")]
    DeadTimeTooLong {
        /// The dead time in samples.
        dead_time: usize,
        /// How many samples there are.
        samples: usize,
    },
    /// More samples and coefficients than are fitted.
    #[error("{samples} samples are too many for a model of order {order}")]
    TooMuchWork {
        /// How many there are.
        samples: usize,
        /// Order of the model.
        order: usize,
    },
    /// The data are such that their model is not unique, as a constant or a pure sine.
    #[error("the data do not determine a model of order {order}")]
    NotDetermined {
        /// Order of the model.
        order: usize,
    },
    /// The data have no variance.
    #[error(transparent)]
    #[serde(untagged)]
    Index(#[from] IndexError),
}

/// Samples per coefficient.
const SAMPLES_PER_COEFFICIENT: usize = 4;
/// Most samples times the square of the order, some 30 ms.
const MAX_WORK: usize = 10_000_000;
/// Smallest pivot, relative to the largest.
const SMALLEST_PIVOT: f64 = 1e-10;

/// The index of Harris of samples under feedback, for a dead time of `dead_time` samples, the one of the sampling included, and a model
/// of an order.
///
/// # Errors
/// [`HarrisError`] for too few samples, and for such as do not determine a model.
pub fn harris_index(samples: &[f64], dead_time: usize, order: usize) -> Result<HarrisIndex, HarrisError> {
    for (field, value) in [("dead_time", dead_time), ("order", order)] {
        if value == 0 {
            return Err(HarrisError::OutOfRange { field, value });
        }
    }
    let count = samples.len();
    if count < order.saturating_mul(SAMPLES_PER_COEFFICIENT + 1) {
        return Err(HarrisError::TooFewSamples { samples: count, order });
    }
    if dead_time >= count {
        return Err(HarrisError::DeadTimeTooLong { dead_time, samples: count });
    }
    if count.saturating_mul(order).saturating_mul(order) > MAX_WORK {
        return Err(HarrisError::TooMuchWork { samples: count, order });
    }
    let mean = samples.iter().sum::<f64>() / count as f64;
    let deviations: Vec<f64> = samples.iter().map(|y| y - mean).collect();
    let actual = deviations.iter().map(|y| y * y).sum::<f64>() / (count - 1) as f64;
    // Nothing moves; rounding of the mean is no movement.
    VarianceIndex::new(0.0, if is_rounding(actual.sqrt(), mean) { 0.0 } else { actual })?;
    let rows = count - order;
    let past = DMatrix::from_fn(rows, order, |row, i| deviations[order + row - 1 - i]);
    let present = DVector::from_column_slice(&deviations[order..]);
    let factors = past.clone().qr();
    let upper = factors.r();
    let pivots = upper.diagonal().map(f64::abs);
    let coefficients = (pivots.min() > SMALLEST_PIVOT * pivots.max())
        .then(|| upper.solve_upper_triangular(&(factors.q().transpose() * &present)))
        .flatten()
        .ok_or(HarrisError::NotDetermined { order })?;
    let residuals = present - past * &coefficients;
    let residual_variance = residuals.norm_squared() / (rows - order) as f64;
    let response = impulse_response(coefficients.as_slice(), dead_time);
    let least = residual_variance * response.iter().map(|psi| psi * psi).sum::<f64>();
    // The model is of the same data, so more than all of their variance is its error.
    let index = VarianceIndex::new(least.min(actual), actual)?;
    Ok(HarrisIndex { index, coefficients: coefficients.as_slice().to_vec(), residual_variance })
}

/// `ψ_0 = 1`, `ψ_k = Σ a_i ψ_{k − i}`, so many of them.
fn impulse_response(coefficients: &[f64], length: usize) -> Vec<f64> {
    let mut response = vec![1.0];
    for k in 1..length {
        let next = coefficients.iter().take(k).enumerate().map(|(i, a)| a * response[k - 1 - i]).sum();
        response.push(next);
    }
    response
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::level::ParkMillerNormal;

    /// `y(k) = Σ a_i y(k − i) + e(k)`.
    fn process(coefficients: &[f64], count: usize) -> Vec<f64> {
        let mut samples: Vec<f64> = Vec::with_capacity(count);
        for (k, shock) in ParkMillerNormal::new(7).take(count).enumerate() {
            let past = coefficients.iter().take(k).enumerate().map(|(i, a)| a * samples[k - 1 - i]).sum::<f64>();
            samples.push(past + shock);
        }
        samples
    }

    /// A first-order process has the index `1 − a^(2 b)`.
    #[test]
    fn a_first_order_process_has_its_index() {
        let samples = process(&[0.9], 20_000);
        for dead_time in [1, 2, 5] {
            let found = harris_index(&samples, dead_time, 6).unwrap();
            let expected = 1.0 - 0.9_f64.powi(2 * i32::try_from(dead_time).unwrap());
            // Four standard errors of a variance ratio of strongly coloured data.
            assert!((found.index.quality() - expected).abs() < 0.03, "{dead_time}: {found:?}");
            assert!((found.coefficients[0] - 0.9).abs() < 0.03 && (found.residual_variance - 1.0).abs() < 0.04);
        }
    }

    #[test]
    fn minimum_variance_data_have_an_index_of_one() {
        // A moving average over the dead time is what minimum-variance control leaves.
        let shocks: Vec<f64> = ParkMillerNormal::new(3).take(10_000).collect();
        let samples: Vec<f64> = (2..10_000).map(|k| shocks[k] + 0.7 * shocks[k - 1] + 0.4 * shocks[k - 2]).collect();
        assert!(harris_index(&samples, 3, 20).unwrap().index.quality() > 0.97);
        assert!(harris_index(&samples, 1, 20).unwrap().index.quality() < 0.65);
    }

    #[test]
    fn the_mean_does_not_matter_and_more_dead_time_excuses_more() {
        let samples = process(&[1.4, -0.6], 2_000);
        let raised: Vec<f64> = samples.iter().map(|y| 50.0 + y).collect();
        let mut last = 0.0;
        for dead_time in 1..10 {
            let quality = harris_index(&samples, dead_time, 8).unwrap().index.quality();
            let other = harris_index(&raised, dead_time, 8).unwrap().index.quality();
            assert!((quality - other).abs() < 1e-9 && quality >= last);
            last = quality;
        }
    }

    #[test]
    fn data_without_an_index_are_refused() {
        let constant = [0.3; 200];
        assert_eq!(harris_index(&constant, 2, 4), Err(HarrisError::Index(IndexError::ZeroVariance)));
        assert_eq!(harris_index(&[], 2, 4), Err(HarrisError::TooFewSamples { samples: 0, order: 4 }));
        let late = Err(HarrisError::DeadTimeTooLong { dead_time: 200, samples: 200 });
        assert_eq!(harris_index(&constant, 200, 4), late);
        assert_eq!(harris_index(&constant, 0, 4), Err(HarrisError::OutOfRange { field: "dead_time", value: 0 }));
        assert_eq!(harris_index(&constant, 2, 0), Err(HarrisError::OutOfRange { field: "order", value: 0 }));
        let long = vec![0.3; 200_000];
        assert_eq!(harris_index(&long, 2, 20), Err(HarrisError::TooMuchWork { samples: 200_000, order: 20 }));
        let sine: Vec<f64> = (0..300).map(|k| (0.2 * f64::from(k)).sin()).collect();
        assert!(matches!(harris_index(&sine, 2, 8), Err(HarrisError::NotDetermined { order: 8 })));
        let broken = [f64::NAN; 200];
        assert!(matches!(harris_index(&broken, 2, 4), Err(HarrisError::Index(IndexError::NoVariance { .. }))));
    }
}

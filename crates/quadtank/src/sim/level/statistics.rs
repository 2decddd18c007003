use serde::Serialize;

/// A change below this share of a value is rounding of it.
const ROUNDING: f64 = 1e-12;

/// Whether a change of a value is no more than rounding of it.
pub fn is_rounding(change: f64, value: f64) -> bool {
    change.abs() <= ROUNDING * value.abs()
}

/// Statistics of a column of samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SampleStatistics {
    /// Number of samples, 2 at least.
    pub count: usize,
    /// Smallest sample.
    pub minimum: f64,
    /// Largest sample.
    pub maximum: f64,
    /// Mean of the samples.
    pub mean: f64,
    /// Variance with the divisor N − 1.
    pub variance: f64,
}

impl SampleStatistics {
    /// Of two samples or more; `None` of fewer.
    pub fn of(samples: &[f64]) -> Option<Self> {
        let count = samples.len();
        if count < 2 {
            return None;
        }
        let mean = samples.iter().sum::<f64>() / count as f64;
        let squares: f64 = samples.iter().map(|x| (x - mean) * (x - mean)).sum();
        Some(Self {
            count,
            minimum: samples.iter().copied().fold(f64::INFINITY, f64::min),
            maximum: samples.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            mean,
            variance: squares / (count - 1) as f64,
        })
    }

    /// Largest less smallest sample.
    pub fn range(&self) -> f64 {
        self.maximum - self.minimum
    }

    /// Whether nothing moves: a deviation that is rounding of the mean.
    pub fn is_still(&self) -> bool {
        is_rounding(self.standard_deviation(), self.mean)
    }

    /// Standard deviation.
    pub fn standard_deviation(&self) -> f64 {
        self.variance.sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_four_samples() {
        let found = SampleStatistics::of(&[1.0, 4.0, 2.0, 5.0]).unwrap();
        assert_eq!((found.minimum, found.maximum, found.mean, found.range()), (1.0, 5.0, 3.0, 4.0));
        assert!((found.variance - 10.0 / 3.0).abs() < 1e-15);
        assert!(!found.is_still() && SampleStatistics::of(&[0.1 + 0.2, 0.3]).unwrap().is_still());
        assert_eq!((SampleStatistics::of(&[]), SampleStatistics::of(&[1.0])), (None, None));
    }
}

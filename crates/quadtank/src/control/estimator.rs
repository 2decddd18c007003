//! The algebraic estimator of what an ultra-local model leaves out (Junqueira, Neves and Angelico, eqs. 5 to 15).
//!
//! Near the present, a level is taken to move as `dy/dt = φ + α u` with φ unknown and constant over a window of length T
//! (eq. 5). In Laplace transforms, `s Y − y(0) = φ/s + α U`. Two steps make φ observable from y and u alone (eqs. 8 to 11):
//! differentiate in s, which removes y(0), and divide by s², so that only integrals are left,
//!
//! ```text
//! Y′/s + Y/s² = −φ/s⁴ + α U′/s²
//! ```
//!
//! Back in time (eqs. 12, 13: `1/sⁿ` is an n-fold integral, a derivative in s a factor −t; the integrals end at t, where print
//! has infinity) this is eq. 14,
//!
//! ```text
//! φ = −6/T³ ∫₀ᵀ (T − 2τ) y dτ − 6α/T³ ∫₀ᵀ (T − τ) τ u dτ
//! ```
//!
//! which is exact for `y = (φ + α u) t + y0` with constant u. The sums of eq. 15 replace the integrals; print leaves out their
//! factor Ts, which is 1 s there.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Most samples of a window.
pub const MAX_WINDOW_SAMPLES: usize = 1000;
/// Slack within which a window counts as a whole number of samples.
const WHOLE: f64 = 1e-6;

/// When the estimate is renewed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Window {
    /// Every T seconds, from the samples since the last time, both ends included; it is held in between (the source).
    Block,
    /// At every sample, from the last T seconds.
    Sliding,
}

/// How the integrals of eq. 14 become sums.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Quadrature {
    /// All samples of the window count the same, its two ends included (eq. 15). With ten samples of a window a slope then
    /// weighs 1.32 instead of 1, an input 0.99.
    Rectangular,
    /// Both ends count half.
    Trapezoidal,
}

/// Which input signal the estimator uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FedWith {
    /// The controller output after the pump limits.
    Applied,
    /// The output that the law computes before the limits; while a pump is at a limit the estimate then drifts.
    Commanded,
}

/// Settings of the estimator.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct EstimatorSettings {
    /// Length T of the window (s): a whole number of samples, two at least.
    pub window_s: f64,
    /// When the estimate is renewed.
    pub window: Window,
    /// How the integrals become sums.
    pub quadrature: Quadrature,
    /// Which input signal the estimator uses.
    pub fed_with: FedWith,
}

/// Why an estimator or a law cannot work.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum EstimatorError {
    /// The window has fewer than two samples.
    #[error("the window of {window_s} s is shorter than two samples of {sampling_time_s} s")]
    WindowTooShort {
        /// T (s).
        window_s: f64,
        /// Ts (s).
        sampling_time_s: f64,
    },
    /// The window has more samples than [`MAX_WINDOW_SAMPLES`].
    #[error("the window of {window_s} s has more than {MAX_WINDOW_SAMPLES} samples of {sampling_time_s} s")]
    WindowTooLong {
        /// T (s).
        window_s: f64,
        /// Ts (s).
        sampling_time_s: f64,
    },
    /// The window is no whole number of samples.
    #[error("the window of {window_s} s is no multiple of the sampling time of {sampling_time_s} s")]
    WindowNotWhole {
        /// T (s).
        window_s: f64,
        /// Ts (s).
        sampling_time_s: f64,
    },
    /// The gain α̂ of the ultra-local model is not positive.
    #[error("the model gain is {value} m/(s V) and must be positive")]
    ModelGain {
        /// α̂ (m/(s V)).
        value: f64,
    },
}

impl EstimatorSettings {
    /// The estimator as published: blocks of T = 10 s.
    pub const PUBLISHED: Self =
        Self { window_s: 10.0, window: Window::Block, quadrature: Quadrature::Rectangular, fed_with: FedWith::Applied };

    /// Samples N = T/Ts in a window, beside the one it begins with.
    ///
    /// # Errors
    /// [`EstimatorError`] when there are fewer than two, too many, or no whole number of them.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 2 and 1000")]
    pub fn samples(&self, sampling_time_s: f64) -> Result<usize, EstimatorError> {
        let window_s = self.window_s;
        let count = window_s / sampling_time_s;
        let whole = count.round();
        if !(whole >= 2.0 && count >= 2.0 - WHOLE) {
            Err(EstimatorError::WindowTooShort { window_s, sampling_time_s })
        } else if whole > MAX_WINDOW_SAMPLES as f64 {
            Err(EstimatorError::WindowTooLong { window_s, sampling_time_s })
        } else if (count - whole).abs() > WHOLE {
            Err(EstimatorError::WindowNotWhole { window_s, sampling_time_s })
        } else {
            Ok(whole as usize)
        }
    }

    /// What the measurement (1/s) and, with α̂ = `model_gain`, the input before it (m/(s V)) of sample n = 0…N of a window
    /// contribute to φ̂ (eq. 15).
    ///
    /// # Errors
    /// As [`samples`](Self::samples).
    pub fn weights(&self, model_gain: f64, sampling_time_s: f64) -> Result<Vec<[f64; 2]>, EstimatorError> {
        let weights = weights(self.samples(sampling_time_s)?, sampling_time_s, self.quadrature);
        Ok(weights.into_iter().map(|[y, u]| [y, model_gain * u]).collect())
    }
}

/// A running estimator of one loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimator {
    window: Window,
    /// Weight of the measurement at sample n of a window (1/s) and, with α̂, of the input before it (m/(s V)).
    weights: Vec<[f64; 2]>,
    /// The latest measurements (m) and inputs (V), the oldest first: those of the window so far, and with one that slides up to
    /// as many before it.
    samples: Vec<[f64; 2]>,
    estimate: f64,
}

impl Estimator {
    /// An estimator at its first sample, with `level` (m) after the input `input` (V), with the estimate φ̂ that it
    /// gives until its first window is full (m/s).
    ///
    /// # Errors
    /// As [`EstimatorSettings::samples`].
    pub fn new(
        settings: EstimatorSettings,
        model_gain: f64,
        sampling_time_s: f64,
        (level, input, estimate): (f64, f64, f64),
    ) -> Result<Self, EstimatorError> {
        let weights = settings.weights(model_gain, sampling_time_s)?;
        Ok(Self { window: settings.window, weights, samples: vec![[level, input]], estimate })
    }

    /// Corrects what the first sample measured (m).
    pub fn begin(&mut self, level: f64) {
        if let [first] = &mut self.samples[..] {
            first[0] = level;
        }
    }

    /// Takes the measurement (m) at a sample and the input (V) that acted on the way to it.
    pub fn push(&mut self, level: f64, input: f64) {
        self.samples.push([level, input]);
        let count = self.weights.len();
        let Some(first) = self.samples.len().checked_sub(count) else { return };
        let terms = self.weights.iter().zip(&self.samples[first..]);
        self.estimate = terms.map(|(weight, sample)| weight[0] * sample[0] + weight[1] * sample[1]).sum();
        match self.window {
            // The last sample of a window is the first of the next.
            Window::Block => drop(self.samples.drain(..count - 1)),
            Window::Sliding if first == count => drop(self.samples.drain(..=first)),
            Window::Sliding => (),
        }
    }

    /// φ̂ (m/s).
    pub fn estimate(&self) -> f64 {
        self.estimate
    }
}

/// What the measurement and the input of sample n = 0…N contribute to φ̂: `−6 (T − 2 n Ts) Ts/T³` and
/// `−6 (T − n Ts) n Ts Ts/T³` (eq. 15, with the factor Ts); the second is still to be multiplied by α̂.
fn weights(count: usize, sampling_time_s: f64, quadrature: Quadrature) -> Vec<[f64; 2]> {
    let window = count as f64 * sampling_time_s;
    let factor = -6.0 * sampling_time_s / window.powi(3);
    let of = |n: usize| {
        let time = n as f64 * sampling_time_s;
        let share = if quadrature == Quadrature::Trapezoidal && (n == 0 || n == count) { 0.5 } else { 1.0 };
        [factor * share * (window - 2.0 * time), factor * share * (window - time) * time]
    };
    (0..=count).map(of).collect()
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    const SETTINGS: EstimatorSettings = EstimatorSettings {
        window_s: 10.0,
        window: Window::Block,
        quadrature: Quadrature::Rectangular,
        fed_with: FedWith::Applied,
    };

    /// Eq. 14 with Simpson's rule, which is exact for its integrands, both of second degree.
    #[test]
    fn the_integrals_are_exact_for_what_the_model_describes() {
        let (phi, alpha, u, y0, window) = (-0.3, 0.1, 4.0, 7.0, 10.0);
        let y = |t: f64| (phi + alpha * u) * t + y0;
        let integrand = |t: f64| (window - 2.0 * t) * y(t) + alpha * (window - t) * t * u;
        let simpson = window / 6.0 * (integrand(0.0) + 4.0 * integrand(window / 2.0) + integrand(window));
        assert_relative_eq!(-6.0 / f64::powi(window, 3) * simpson, phi, max_relative = 1e-13);
    }

    #[test]
    fn sums_weigh_a_slope_and_an_input_as_they_do() {
        for (quadrature, slope, input) in
            [(Quadrature::Rectangular, 1.32, -0.99), (Quadrature::Trapezoidal, 1.02, -0.99)]
        {
            let weights = weights(10, 1.0, quadrature);
            // A level that does not move weighs nothing.
            assert_relative_eq!(weights.iter().map(|w| w[0]).sum::<f64>(), 0.0, epsilon = 1e-15);
            let of_slope: f64 = weights.iter().enumerate().map(|(n, w)| w[0] * n as f64).sum();
            assert_relative_eq!(of_slope, slope, max_relative = 1e-12);
            assert_relative_eq!(weights.iter().map(|w| w[1]).sum::<f64>(), input, max_relative = 1e-12);
        }
    }

    #[test]
    fn with_short_samples_the_sums_are_the_integrals() {
        let (phi, alpha, u, ts) = (-0.3, 0.1, 4.0, 0.01);
        let settings = EstimatorSettings { quadrature: Quadrature::Trapezoidal, ..SETTINGS };
        let mut estimator = Estimator::new(settings, alpha, ts, (7.0, u, 0.0)).unwrap();
        for n in 1..=1000 {
            assert_eq!(estimator.estimate(), 0.0);
            estimator.push(7.0 + (phi + alpha * u) * ts * f64::from(n), u);
        }
        assert_relative_eq!(estimator.estimate(), phi, max_relative = 1e-5);
    }

    #[test]
    fn a_block_holds_and_a_sliding_window_follows() {
        let run = |window| {
            let mut estimator =
                Estimator::new(EstimatorSettings { window, ..SETTINGS }, 0.1, 1.0, (0.0, 0.0, 5.0)).unwrap();
            let estimates: Vec<f64> = (1..=30)
                .map(|n| {
                    estimator.push(f64::from(n * n), 0.0);
                    estimator.estimate()
                })
                .collect();
            estimates
        };
        let (block, sliding) = (run(Window::Block), run(Window::Sliding));
        assert!(block[..9].iter().chain(&sliding[..9]).all(|&phi| phi == 5.0));
        assert!(block[9..19].iter().all(|&phi| phi == block[9]) && block[19] != block[9]);
        assert_eq!([block[9], block[19], block[29]], [sliding[9], sliding[19], sliding[29]]);
        assert!(sliding[9..].windows(2).all(|pair| pair[1] > pair[0]));
    }

    #[test]
    fn a_window_is_two_samples_or_more_and_a_whole_number_of_them() {
        let with = |window_s, ts| EstimatorSettings { window_s, ..SETTINGS }.samples(ts);
        assert_eq!((with(10.0, 1.0), with(2.0, 1.0), with(0.3, 0.1)), (Ok(10), Ok(2), Ok(3)));
        let short = EstimatorError::WindowTooShort { window_s: 1.9, sampling_time_s: 1.0 };
        assert_eq!(with(1.9, 1.0), Err(short));
        assert!(matches!(with(10.5, 1.0), Err(EstimatorError::WindowNotWhole { .. })));
        assert!(matches!(with(1e6, 1.0), Err(EstimatorError::WindowTooLong { .. })));
        for nonsense in [f64::NAN, -3.0, 0.0] {
            assert!(with(nonsense, 1.0).is_err() && with(10.0, nonsense).is_err());
        }
    }
}

use serde::{Deserialize, Serialize};

use crate::numeric::{larger, smaller};

/// What keeps the integral from winding up while the output is limited.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum AntiWindup {
    /// Nothing: the integral runs on.
    Off,
    /// Back-calculation with the tracking time `Tt = tracking_ratio Ti` (Cocota 2009, ch. 4: Tt = Ti/2).
    BackCalculation {
        /// `Tt / Ti`.
        tracking_ratio: f64,
    },
}

/// Whether the controller or an operator sets the output of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum LoopMode {
    /// The controller.
    Automatic,
    /// Manual until the given time; the transfer to automatic is bumpless.
    Manual {
        /// Controller output while in manual mode (V).
        output: f64,
        /// Time at which the controller takes over (s).
        until_s: f64,
    },
}

/// Settings of one PI loop, `u = K (b r − y + (1/Ti) ∫ (r − y) dt)` in volts of measured signal and controller output.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PiSettings {
    /// Gain K (V/V); negative where the loop needs it.
    pub gain: f64,
    /// Integral time Ti (s).
    pub integral_time_s: f64,
    /// Set-point weight b in the proportional part.
    pub set_point_weight: f64,
    /// Anti-windup.
    pub anti_windup: AntiWindup,
    /// Automatic or manual.
    pub mode: LoopMode,
}

/// A running PI loop: settings, limits and state.
///
/// It starts from rest: at the signal `rest_signal` and the output `initial_output` the plant stands still. Whatever
/// the set-point weight, a reference and a measurement equal to `rest_signal` leave the output where it is. Call
/// [`Pi::step`] once per sampling time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pi {
    settings: PiSettings,
    limits: (f64, f64),
    rest_signal: f64,
    /// `K Ts/(2 Ti)`, the weight of one trapezium of error in the integral.
    integral_gain: f64,
    /// `Ts/Tt`, the share of the excess that one sample takes back from the integral.
    tracking_gain: f64,
    /// Integral part I (V). It starts at the initial output and carries all of it.
    integral: f64,
    previous_error: Option<f64>,
    /// Output of the last sample (V).
    output: f64,
}

impl Pi {
    /// A loop at rest.
    ///
    /// `limits` are the lowest and highest controller output (V), `sampling_time_s` is Ts (s), `initial_output` the
    /// controller output at rest (V) and `rest_signal` the measured signal, and so the reference, at rest (V).
    ///
    /// A tracking time shorter than Ts counts as Ts: the integral cannot give back more than the whole excess.
    pub fn new(
        settings: PiSettings,
        limits: (f64, f64),
        sampling_time_s: f64,
        initial_output: f64,
        rest_signal: f64,
    ) -> Self {
        let integral_gain = settings.gain * sampling_time_s / (2.0 * settings.integral_time_s);
        let tracking_gain = match settings.anti_windup {
            AntiWindup::Off => 0.0,
            AntiWindup::BackCalculation { tracking_ratio } => {
                limited(sampling_time_s / (tracking_ratio * settings.integral_time_s), (0.0, 1.0))
            }
        };
        Self {
            settings,
            limits,
            rest_signal,
            integral_gain,
            tracking_gain,
            integral: initial_output,
            previous_error: None,
            output: limited(initial_output, limits),
        }
    }

    /// One sample: takes reference and measurement (V) at time `time_s`, returns the limited controller output (V) to
    /// be held until the next sample.
    ///
    /// In automatic mode, with `e = r − y`, `e_prev = e` at the first sample and the rest signal `r0`:
    ///
    /// ```text
    /// I += K Ts/(2 Ti) (e + e_prev)
    /// v  = K (e − (1 − b) (r − r0)) + I
    /// c  = v within the limits
    /// I += Ts/Tt (c − v)
    /// ```
    ///
    /// The first term of v is `K (b r − y)` plus the constant `K (1 − b) r0`, which only moves the value at which I
    /// starts: to the initial output, for every b. Tustin's rule and the back-calculation are those of Cocota (2009,
    /// eq. 4.2, §4.4).
    ///
    /// In manual mode c is the manual output within the limits, and I follows so that the controller would give just
    /// that; it takes over, without a bump, at the first sample at or after the given time.
    ///
    /// A reference or measurement that is not finite leaves state and output as they are.
    #[inline]
    pub fn step(&mut self, time_s: f64, reference_v: f64, measured_v: f64) -> f64 {
        let error = reference_v - measured_v;
        if !error.is_finite() {
            return self.output;
        }
        let weighted_error = error - (1.0 - self.settings.set_point_weight) * (reference_v - self.rest_signal);
        let proportional = self.settings.gain * weighted_error;
        match self.settings.mode {
            LoopMode::Manual { output, until_s } if time_s < until_s => {
                self.output = limited(output, self.limits);
                self.integral = self.output - proportional;
            }
            _ => {
                self.integral += self.integral_gain * (error + self.previous_error.unwrap_or(error));
                let unlimited = proportional + self.integral;
                self.output = limited(unlimited, self.limits);
                self.integral += self.tracking_gain * (self.output - unlimited);
            }
        }
        self.previous_error = Some(error);
        self.output
    }
}

/// The value within the limits. Where they are in the wrong order the upper one applies; NaN becomes the lower limit.
#[inline]
pub(super) fn limited(value: f64, (min, max): (f64, f64)) -> f64 {
    smaller(larger(value, min), max)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    const SETTINGS: PiSettings = PiSettings {
        gain: 1.75,
        integral_time_s: 40.0,
        set_point_weight: 1.0,
        anti_windup: AntiWindup::BackCalculation { tracking_ratio: 0.5 },
        mode: LoopMode::Automatic,
    };
    const LIMITS: (f64, f64) = (0.0, 10.0);

    #[test]
    fn rest_is_left_alone_for_every_weight_and_sign() {
        for set_point_weight in [0.0, 0.3, 1.0, 2.0] {
            for gain in [1.75, -0.12] {
                let mut pi = Pi::new(PiSettings { gain, set_point_weight, ..SETTINGS }, LIMITS, 1.0, 8.39, 5.2);
                for k in 0..100 {
                    assert_eq!(pi.step(f64::from(k), 5.2, 5.2), 8.39);
                }
            }
        }
    }

    #[test]
    fn a_step_kicks_by_the_weighted_gain() {
        for set_point_weight in [0.0, 0.4, 1.0] {
            let mut pi = Pi::new(PiSettings { set_point_weight, ..SETTINGS }, LIMITS, 1.0, 5.0, 6.0);
            pi.step(0.0, 6.0, 6.0);
            // Tustin: half a sample of the new error is integrated at once.
            let expected = 5.0 + 1.75 * 0.1 * (set_point_weight + 1.0 / (2.0 * 40.0));
            assert_relative_eq!(pi.step(1.0, 6.1, 6.0), expected, max_relative = 1e-12);
        }
    }

    #[test]
    fn the_first_sample_counts_its_error_as_old() {
        let mut pi = Pi::new(SETTINGS, LIMITS, 1.0, 5.0, 6.0);
        assert_relative_eq!(pi.step(0.0, 6.1, 6.0), 5.0 + 0.175 * (1.0 + 1.0 / 40.0), max_relative = 1e-12);
    }

    #[test]
    fn the_integral_grows_by_gain_over_integral_time() {
        let mut pi = Pi::new(PiSettings { gain: -0.5, ..SETTINGS }, LIMITS, 2.0, 5.0, 6.0);
        let (first, mut last) = (pi.step(0.0, 6.01, 6.0), 0.0);
        for k in 1..=100 {
            last = pi.step(2.0 * f64::from(k), 6.01, 6.0);
        }
        assert_relative_eq!(last - first, -0.5 / 40.0 * 0.01 * 200.0, max_relative = 1e-9);
    }

    /// Samples until the output leaves its limit after 300 s of an error that cannot be removed has turned round.
    fn samples_to_recover(anti_windup: AntiWindup) -> usize {
        let mut pi = Pi::new(PiSettings { anti_windup, ..SETTINGS }, LIMITS, 1.0, 5.0, 5.0);
        for k in 0..300 {
            pi.step(f64::from(k), 9.0, 5.0);
        }
        (300..2000).position(|k| pi.step(f64::from(k), 4.0, 5.0) < 10.0).unwrap_or(usize::MAX)
    }

    #[test]
    fn back_calculation_recovers_at_once_and_windup_does_not() {
        assert_eq!(samples_to_recover(AntiWindup::BackCalculation { tracking_ratio: 0.5 }), 0);
        assert!(samples_to_recover(AntiWindup::Off) > 100);
    }

    #[test]
    fn a_vanishing_tracking_time_is_one_sample() {
        for tracking_ratio in [0.0, 1e-9, 1.0 / 40.0] {
            let anti_windup = AntiWindup::BackCalculation { tracking_ratio };
            let mut pi = Pi::new(PiSettings { anti_windup, ..SETTINGS }, LIMITS, 1.0, 9.5, 5.0);
            assert_eq!(pi.step(0.0, 8.0, 5.0), 10.0);
            // The integral took back the whole excess, so the output is at its limit by a hair.
            assert_relative_eq!(pi.integral + 1.75 * 3.0, 10.0, max_relative = 1e-12);
        }
    }

    #[test]
    fn manual_output_is_held_and_handed_over_without_a_bump() {
        let mode = LoopMode::Manual { output: 7.0, until_s: 50.0 };
        for set_point_weight in [0.0, 1.0] {
            let mut pi = Pi::new(PiSettings { set_point_weight, mode, ..SETTINGS }, LIMITS, 1.0, 5.0, 6.0);
            for k in 0..50 {
                assert_eq!(pi.step(f64::from(k), 6.5, 6.0 + 0.01 * f64::from(k)), 7.0);
            }
            // The same signals once more: only one sample of integral moves the output.
            let error = 6.5 - 6.49;
            assert_relative_eq!(pi.step(50.0, 6.5, 6.49), 7.0 + 1.75 / 40.0 * error, max_relative = 1e-12);
        }
    }

    #[test]
    fn manual_output_keeps_the_limits() {
        let mode = LoopMode::Manual { output: 70.0, until_s: 2.0 };
        let mut pi = Pi::new(PiSettings { mode, ..SETTINGS }, LIMITS, 1.0, 5.0, 6.0);
        assert_eq!(pi.step(0.0, 6.0, 6.0), 10.0);
        assert_eq!(pi.step(1.0, 6.0, 6.0), 10.0);
        assert_eq!(pi.step(2.0, 6.0, 6.0), 10.0);
    }

    #[test]
    fn a_lost_signal_holds_the_output() {
        let mut pi = Pi::new(SETTINGS, LIMITS, 1.0, 5.0, 6.0);
        let before = pi.step(0.0, 6.1, 6.0);
        assert_eq!(pi.step(1.0, f64::NAN, 6.0), before);
        assert_eq!(pi.step(2.0, 6.1, f64::INFINITY), before);
        assert_relative_eq!(pi.step(3.0, 6.1, 6.0), before + 1.75 / 40.0 * 0.1, max_relative = 1e-12);
        // Also when it is lost from the beginning and the plant rests beyond the limits.
        assert_eq!(Pi::new(SETTINGS, LIMITS, 1.0, 12.0, 6.0).step(0.0, f64::NAN, 6.0), 10.0);
    }

    #[test]
    fn reversed_limits_do_not_panic() {
        let mut pi = Pi::new(SETTINGS, (10.0, 0.0), 1.0, 5.0, 6.0);
        assert_eq!(pi.step(0.0, 6.0, 6.0), 0.0);
    }

    #[test]
    fn back_calculation_returns_the_share_of_a_sample_in_the_tracking_time() {
        // Tt = 20 s, Ts = 2 s: a tenth of the excess.
        let mut pi = Pi::new(SETTINGS, LIMITS, 2.0, 9.0, 5.0);
        assert_eq!(pi.step(0.0, 7.0, 5.0), 10.0);
        let integrated = 9.0 + 1.75 * 2.0 / 40.0 * 2.0;
        let excess = 1.75 * 2.0 + integrated - 10.0;
        assert_relative_eq!(pi.integral, integrated - 0.1 * excess, max_relative = 1e-14);
    }
}

use serde::{Deserialize, Serialize};

/// What keeps the integral from winding up while the output is limited.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum AntiWindup {
    /// Nothing: the integral runs on.
    Off,
    /// Back-calculation with the tracking time `Tt = tracking_ratio Ti` (Cocota 2009, ch. 4: Tt = Ti/2).
    BackCalculation {
        /// `Tt / Ti`.
        tracking_ratio: f64,
    },
}

/// Who moves the output of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum LoopMode {
    /// The controller.
    Automatic,
    /// A person, until the given time; then the controller takes over without a bump.
    Manual {
        /// Controller output while in manual mode (V).
        output: f64,
        /// Time at which the controller takes over (s).
        until_s: f64,
    },
}

/// Settings of one PI loop, `u = K (b r − y + (1/Ti) ∫ (r − y) dt)` in volts of measured signal and controller output.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
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
    /// The first term is `K (b r − y)` plus the constant `K (1 − b) r0`, which only moves the value at which I starts: to the
    /// initial output, for every b. Tustin's rule and the back-calculation are those of Cocota (2009, eq. 4.2, §4.4).
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

/// Limits in the wrong order: the upper one wins. A value that is not a number becomes the lower limit.
#[inline]
fn limited(value: f64, (min, max): (f64, f64)) -> f64 {
    value.max(min).min(max)
}

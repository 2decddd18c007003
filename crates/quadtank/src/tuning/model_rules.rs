use serde::{Deserialize, Serialize};

use super::error::positive;
use super::{ProcessModel, TuningError};
use crate::control::IsaPid;

/// A rule that makes PI settings of a process model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum ModelRule {
    /// SIMC (Skogestad 2003; Andreis 2017, Eqs. 40, 41): `Kp = τ/(K (τc + θ))`, `Ti = min(τ, 4 (τc + θ))`; integrating
    /// `Kp = 1/(K' (τc + θ))`, `Ti = 4 (τc + θ)`. The condition is τc > −θ; that source prints it without the sign.
    Simc {
        /// Wanted closed-loop time constant τc (s).
        closed_loop_time_s: f64,
    },
    /// Lambda tuning (Andreis 2017, Eqs. 43, 44): `Kp = τ/(K (λ + θ))`, `Ti = τ`; integrating `Kp = (2 λ + θ)/(K' (λ + θ)²)`,
    /// `Ti = 2 λ + θ`.
    Lambda {
        /// Wanted closed-loop time constant λ (s).
        closed_loop_time_s: f64,
    },
    /// AMIGO for PI (Åström and Hägglund 2006, §7.4), which needs a dead time.
    Amigo,
}

impl ModelRule {
    /// The settings for a model.
    ///
    /// # Errors
    /// [`TuningError::OutOfRange`] for a model without meaning, for a closed-loop time with which `τc + θ` is not positive, and for
    /// AMIGO without dead time.
    ///
    /// ```
    /// use quadtank::tuning::{ModelRule, ProcessModel};
    ///
    /// let model = ProcessModel::SelfRegulating { gain: 5.75, time_constant_s: 588.0, dead_time_s: 0.0 };
    /// let settings = ModelRule::Simc { closed_loop_time_s: 5.88 }.settings(&model)?;
    /// assert!((settings.gain - 17.391).abs() < 5e-4 && (settings.integral_time - 23.52).abs() < 1e-9);
    /// # Ok::<(), quadtank::tuning::TuningError>(())
    /// ```
    pub fn settings(self, model: &ProcessModel) -> Result<IsaPid, TuningError> {
        model.check()?;
        let theta = model.dead_time_s();
        let (gain, integral_time) = match (self, *model) {
            (Self::Simc { closed_loop_time_s }, _) => {
                let sum = closed_loop_time_s + theta;
                positive("closed_loop_time_s", sum)?;
                let gain = 1.0 / (model.slope() * sum);
                match *model {
                    ProcessModel::SelfRegulating { time_constant_s, .. } => (gain, time_constant_s.min(4.0 * sum)),
                    ProcessModel::Integrating { .. } => (gain, 4.0 * sum),
                }
            }
            (Self::Lambda { closed_loop_time_s: lambda }, model) => {
                positive("closed_loop_time_s", lambda)?;
                let sum = lambda + theta;
                match model {
                    ProcessModel::SelfRegulating { gain, time_constant_s, .. } => {
                        (time_constant_s / (gain * sum), time_constant_s)
                    }
                    ProcessModel::Integrating { slope, .. } => {
                        let time = 2.0 * lambda + theta;
                        (time / (slope * sum * sum), time)
                    }
                }
            }
            (Self::Amigo, ProcessModel::SelfRegulating { gain, time_constant_s: t, .. }) => {
                positive("dead_time_s", theta)?;
                let sum = theta + t;
                let share = 0.35 - theta * t / (sum * sum);
                let time = 0.35 * theta + 13.0 * theta * t * t / (t * t + 12.0 * theta * t + 7.0 * theta * theta);
                (0.15 / gain + share * t / (gain * theta), time)
            }
            (Self::Amigo, ProcessModel::Integrating { slope, .. }) => {
                positive("dead_time_s", theta)?;
                (0.35 / (slope * theta), 13.4 * theta)
            }
        };
        Ok(IsaPid { gain, integral_time, derivative_time: 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn lagged(time_constant_s: f64, dead_time_s: f64) -> ProcessModel {
        ProcessModel::SelfRegulating { gain: time_constant_s * 0.02, time_constant_s, dead_time_s }
    }

    /// A long lag is an integrator to a controller that is much quicker.
    #[test]
    fn rules_for_long_lags_tend_to_those_for_integrators() {
        let integrating = ProcessModel::Integrating { slope: 0.02, dead_time_s: 3.0 };
        for rule in [ModelRule::Simc { closed_loop_time_s: 3.0 }, ModelRule::Amigo] {
            let (slow, ramp) = (rule.settings(&lagged(1e6, 3.0)).unwrap(), rule.settings(&integrating).unwrap());
            assert_relative_eq!(slow.gain, ramp.gain, max_relative = 1e-4);
            assert_relative_eq!(slow.integral_time, ramp.integral_time, max_relative = 0.01);
        }
        let lambda = ModelRule::Lambda { closed_loop_time_s: 30.0 };
        let ramp = lambda.settings(&integrating).unwrap();
        assert_relative_eq!(ramp.gain, 63.0 / (0.02 * 33.0 * 33.0), max_relative = 1e-14);
        assert_eq!(ramp.integral_time, 63.0);
    }

    #[test]
    fn the_half_rule_shares_the_second_lag() {
        let model = ProcessModel::by_half_rule(2.7, &[5.0, 117.0, 0.5], 1.0);
        let expected = ProcessModel::SelfRegulating { gain: 2.7, time_constant_s: 119.5, dead_time_s: 4.0 };
        assert_eq!(model, expected);
        assert_eq!(
            ProcessModel::by_half_rule(2.7, &[8.0], 0.0),
            ProcessModel::SelfRegulating { gain: 2.7, time_constant_s: 8.0, dead_time_s: 0.0 }
        );
    }

    #[test]
    fn models_and_times_without_meaning_are_refused() {
        let simc = |time| ModelRule::Simc { closed_loop_time_s: time };
        let refused = |rule: ModelRule, model: &ProcessModel| match rule.settings(model) {
            Err(TuningError::OutOfRange { field, .. }) => field,
            other => panic!("{other:?}"),
        };
        assert!(simc(-1.0).settings(&lagged(100.0, 3.0)).is_ok());
        assert_eq!(refused(simc(-3.0), &lagged(100.0, 3.0)), "closed_loop_time_s");
        assert_eq!(refused(simc(0.0), &lagged(100.0, 0.0)), "closed_loop_time_s");
        assert_eq!(refused(ModelRule::Amigo, &lagged(100.0, 0.0)), "dead_time_s");
        assert_eq!(refused(simc(1.0), &lagged(0.0, 0.0)), "gain");
        assert_eq!(refused(simc(1.0), &lagged(100.0, f64::NAN)), "dead_time_s");
    }
}

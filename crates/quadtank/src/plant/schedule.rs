use serde::{Deserialize, Serialize};

/// How a valve fraction γ moves in time (γ without unit, time in s).
///
/// The schedules of Junqueira, Neves and Angelico (cases a, b and c) are constants and sines; steps and ramps are ours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ValveSchedule {
    /// It stands still.
    Constant {
        /// γ.
        gamma: f64,
    },
    /// It jumps once.
    Step {
        /// γ before.
        from: f64,
        /// γ after.
        to: f64,
        /// When (s).
        at_s: f64,
    },
    /// It moves evenly from one value to another.
    Ramp {
        /// γ before.
        from: f64,
        /// γ after.
        to: f64,
        /// When it begins (s).
        begin_s: f64,
        /// When it ends (s), not before it begins.
        end_s: f64,
    },
    /// `γ = mean + amplitude sin(ω t + phase)`.
    Sine {
        /// Mean of γ.
        mean: f64,
        /// Amplitude of γ.
        amplitude: f64,
        /// ω (rad/s).
        frequency: f64,
        /// Phase at t = 0 (rad).
        phase: f64,
    },
}

impl ValveSchedule {
    /// γ at a time (s). A step counts from its instant on.
    #[inline]
    pub fn at(&self, time_s: f64) -> f64 {
        match *self {
            Self::Constant { gamma } => gamma,
            Self::Step { from, to, at_s } => {
                if time_s < at_s {
                    from
                } else {
                    to
                }
            }
            Self::Ramp { from, to, begin_s, end_s } => {
                if time_s < begin_s {
                    from
                } else if time_s >= end_s {
                    to
                } else {
                    from + (to - from) * (time_s - begin_s) / (end_s - begin_s)
                }
            }
            Self::Sine { mean, amplitude, frequency, phase } => mean + amplitude * (frequency * time_s + phase).sin(),
        }
    }

    /// Lowest and highest γ of the schedule over all times.
    pub fn extremes(&self) -> (f64, f64) {
        match *self {
            Self::Constant { gamma } => (gamma, gamma),
            Self::Step { from, to, .. } | Self::Ramp { from, to, .. } => (from.min(to), from.max(to)),
            // One that does not turn stays where its phase is.
            Self::Sine { frequency: 0.0, .. } => (self.at(0.0), self.at(0.0)),
            Self::Sine { mean, amplitude, .. } => (mean - amplitude.abs(), mean + amplitude.abs()),
        }
    }

    /// Half way between the lowest and the highest γ.
    pub fn midpoint(&self) -> f64 {
        let (low, high) = self.extremes();
        f64::midpoint(low, high)
    }

    /// How far γ goes to either side of its [`midpoint`](Self::midpoint).
    pub fn amplitude(&self) -> f64 {
        let (low, high) = self.extremes();
        0.5 * (high - low)
    }

    /// The same movement around another middle.
    #[must_use]
    pub fn around(self, middle: f64) -> Self {
        let by = middle - self.midpoint();
        match self {
            Self::Constant { .. } => Self::Constant { gamma: middle },
            Self::Step { from, to, at_s } => Self::Step { from: from + by, to: to + by, at_s },
            Self::Ramp { from, to, begin_s, end_s } => Self::Ramp { from: from + by, to: to + by, begin_s, end_s },
            Self::Sine { mean, amplitude, frequency, phase } => {
                Self::Sine { mean: mean + by, amplitude, frequency, phase }
            }
        }
    }

    /// Whether γ ever moves.
    pub fn is_constant(&self) -> bool {
        let (low, high) = self.extremes();
        low == high
    }

    /// The instants (s) at which γ jumps or bends, in order; an integration must not step across one.
    pub fn breaks_s(&self) -> [Option<f64>; 2] {
        match *self {
            Self::Constant { .. } | Self::Sine { .. } => [None; 2],
            Self::Step { at_s, .. } => [Some(at_s), None],
            Self::Ramp { begin_s, end_s, .. } => [Some(begin_s), Some(end_s)],
        }
    }

    /// How fast γ turns (rad/s); 0 for what does not swing.
    pub fn angular_frequency(&self) -> f64 {
        match *self {
            Self::Sine { frequency, amplitude, .. } if amplitude != 0.0 => frequency.abs(),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    #[test]
    fn each_kind_moves_as_its_name_says() {
        let step = ValveSchedule::Step { from: 0.7, to: 0.3, at_s: 10.0 };
        assert_eq!([9.999, 10.0, 11.0].map(|t| step.at(t)), [0.7, 0.3, 0.3]);
        let ramp = ValveSchedule::Ramp { from: 0.25, to: 0.75, begin_s: 10.0, end_s: 20.0 };
        assert_eq!([0.0, 10.0, 15.0, 20.0, 30.0].map(|t| ramp.at(t)), [0.25, 0.25, 0.5, 0.75, 0.75]);
        // Case c of the paper, valve 1.
        let sine = ValveSchedule::Sine { mean: 0.5, amplitude: 0.1, frequency: 0.2, phase: 0.0 };
        assert_relative_eq!(sine.at(5.0), 0.5 + 0.1 * 1.0_f64.sin(), max_relative = 1e-15);
        assert_eq!(sine.extremes(), (0.4, 0.6));
        assert_eq!(ValveSchedule::Ramp { from: 0.2, to: 0.8, begin_s: 5.0, end_s: 5.0 }.at(5.0), 0.8);
    }

    #[test]
    fn a_movement_keeps_its_shape_around_another_middle() {
        let ramp = ValveSchedule::Ramp { from: 0.25, to: 0.75, begin_s: 10.0, end_s: 20.0 };
        let sine = ValveSchedule::Sine { mean: 0.5, amplitude: -0.125, frequency: 0.2, phase: 1.0 };
        let step = ValveSchedule::Step { from: 0.5, to: 0.25, at_s: 3.0 };
        for schedule in [ramp, sine, step, ValveSchedule::Constant { gamma: 0.5 }] {
            let moved = schedule.around(0.625);
            assert_eq!((moved.midpoint(), moved.amplitude()), (0.625, schedule.amplitude()), "{schedule:?}");
            let by = 0.625 - schedule.midpoint();
            assert_relative_eq!(moved.at(14.0), schedule.at(14.0) + by, max_relative = 1e-15);
        }
    }

    #[test]
    fn what_stands_still_is_constant() {
        assert!(ValveSchedule::Constant { gamma: 0.6 }.is_constant());
        let still = ValveSchedule::Sine { mean: 0.5, amplitude: 0.1, frequency: 0.0, phase: 0.5 };
        assert!(still.is_constant());
        assert_relative_eq!(still.extremes().0, still.at(77.0), max_relative = 1e-15);
        assert!(!ValveSchedule::Step { from: 0.7, to: 0.3, at_s: 10.0 }.is_constant());
    }
}

use serde::{Deserialize, Serialize};

use super::{Pi, PiSettings};

/// Which pump each level commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Pairing {
    /// Level 1 – pump 1, level 2 – pump 2.
    Diagonal,
    /// Level 1 – pump 2, level 2 – pump 1.
    Swapped,
}

impl Pairing {
    /// Both pairings.
    pub const ALL: [Self; 2] = [Self::Diagonal, Self::Swapped];

    /// The pairing that this one is not.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Diagonal => Self::Swapped,
            Self::Swapped => Self::Diagonal,
        }
    }

    /// Index of the pump that the loop of level `loop_index` drives; both indices are 0 or 1.
    pub const fn pump_of(self, loop_index: usize) -> usize {
        match self {
            Self::Diagonal => loop_index,
            Self::Swapped => loop_index ^ 1,
        }
    }

    /// Index of the loop that drives pump `pump`, the inverse of [`pump_of`](Self::pump_of).
    pub const fn loop_of(self, pump: usize) -> usize {
        self.pump_of(pump)
    }

    /// Puts values that belong to loops 1 and 2 into the order of the pumps that those loops drive.
    pub fn by_pump<T>(self, of_loops: [T; 2]) -> [T; 2] {
        match self {
            Self::Diagonal => of_loops,
            Self::Swapped => {
                let [first, second] = of_loops;
                [second, first]
            }
        }
    }

    /// Puts values that belong to pumps 1 and 2 into the order of the loops that drive them, the inverse of
    /// [`by_pump`](Self::by_pump).
    pub fn by_loop<T>(self, of_pumps: [T; 2]) -> [T; 2] {
        self.by_pump(of_pumps)
    }
}

/// Two PI loops that know nothing of each other. Loop 1 controls level 1, loop 2 level 2, whatever pump they drive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct DecentralisedPi {
    /// Which pump each loop drives.
    pub pairing: Pairing,
    /// Settings of the loops that control levels 1 and 2.
    pub loops: [PiSettings; 2],
    /// Sampling time Ts of both loops (s).
    pub sampling_time_s: f64,
}

impl DecentralisedPi {
    /// Both loops at rest, ready to [`step`](RunningPi::step).
    ///
    /// `limits` (lowest, highest controller output, V) and `output` (controller output at rest, V) are by pump,
    /// `rest_signal` (measured signals at rest, V) is by level.
    pub fn start(&self, limits: [(f64, f64); 2], output: [f64; 2], rest_signal: [f64; 2]) -> RunningPi {
        let limits = self.pairing.by_loop(limits);
        let output = self.pairing.by_loop(output);
        RunningPi {
            loops: std::array::from_fn(|i| {
                Pi::new(self.loops[i], limits[i], self.sampling_time_s, output[i], rest_signal[i])
            }),
        }
    }
}

/// The two loops of a [`DecentralisedPi`] with their states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunningPi {
    loops: [Pi; 2],
}

impl RunningPi {
    /// One sample of both loops at `time_s` (s): takes references and measured signals of levels 1 and 2 (V), returns
    /// the limited outputs of loops 1 and 2 (V), see [`Pi::step`]. [`Pairing::by_pump`] sorts them by pump.
    #[inline]
    pub fn step(&mut self, time_s: f64, references_v: [f64; 2], measured_v: [f64; 2]) -> [f64; 2] {
        let [first, second] = &mut self.loops;
        [first.step(time_s, references_v[0], measured_v[0]), second.step(time_s, references_v[1], measured_v[1])]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::{AntiWindup, LoopMode};

    fn loop_with_gain(gain: f64) -> PiSettings {
        PiSettings {
            gain,
            integral_time_s: 30.0,
            set_point_weight: 1.0,
            anti_windup: AntiWindup::BackCalculation { tracking_ratio: 0.5 },
            mode: LoopMode::Automatic,
        }
    }

    #[test]
    fn pairings_are_permutations() {
        for pairing in Pairing::ALL {
            assert_eq!(pairing.other().other(), pairing);
            assert_ne!(pairing.other(), pairing);
            for index in [0, 1] {
                assert_eq!(pairing.loop_of(pairing.pump_of(index)), index);
                assert_eq!(pairing.by_pump([0, 1])[pairing.pump_of(index)], index);
                assert_eq!(pairing.by_loop(["pump 1", "pump 2"])[index], ["pump 1", "pump 2"][pairing.pump_of(index)]);
            }
        }
        assert_eq!(Pairing::Swapped.pump_of(0), 1);
        assert_eq!(Pairing::Diagonal.pump_of(1), 1);
    }

    #[test]
    fn swapped_loops_take_limits_and_rest_of_the_other_pump() {
        let controller = DecentralisedPi {
            pairing: Pairing::Swapped,
            loops: [loop_with_gain(2.0), loop_with_gain(1.0)],
            sampling_time_s: 1.0,
        };
        let mut running = controller.start([(0.0, 10.0), (0.0, 4.0)], [5.0, 3.0], [6.0, 7.0]);
        assert_eq!(running.step(0.0, [6.0, 7.0], [6.0, 7.0]), [3.0, 5.0]);
        // Loop 1 drives pump 2, which stops at 4 V.
        assert_eq!(running.step(1.0, [8.0, 7.0], [6.0, 7.0]), [4.0, 5.0]);
    }
}

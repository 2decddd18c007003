use crate::control::{LoopMode, PiSettings};
use crate::literature::level_slides::DERIVATIVE_FILTER_S;
use crate::sim::level::LevelController;

use super::{LevelLoopSetup, PiTuning};

/// A kind of controller, by its name alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ControllerKind {
    /// A continuous PI controller.
    Pi,
    /// A sampled PI controller.
    Sampled,
    /// A continuous parallel PID controller.
    Pid,
    /// None: the output is set by hand.
    Off,
}

/// Sampling time (s) of a sampled controller that was another kind before.
const SAMPLING_TIME_S: f64 = 1.0;

impl ControllerKind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Pi, Self::Sampled, Self::Pid, Self::Off];

    /// The kind of a controller.
    pub const fn of(controller: &LevelController) -> Self {
        match controller {
            LevelController::Pi { .. } => Self::Pi,
            LevelController::Sampled { .. } => Self::Sampled,
            LevelController::Pid { .. } => Self::Pid,
            LevelController::Manual { .. } => Self::Off,
        }
    }
}

impl LevelLoopSetup {
    /// Makes the controller another kind, with the tuning and the anti-windup that it has, as far as the new kind has them. What the
    /// present one does not say, such as the integral time of a PID controller without P or without I, is taken from `kept`.
    pub fn set_controller_kind(&mut self, kind: ControllerKind, kept: PiTuning) {
        let (tuning, anti_windup) = (self.controller.tuning_or(kept), self.anti_windup());
        let PiTuning { gain, integral_time_s } = tuning;
        self.controller = match kind {
            kind if kind == ControllerKind::of(&self.controller) => return,
            ControllerKind::Pi => LevelController::Pi { gain, integral_time_s, anti_windup },
            ControllerKind::Sampled => {
                let (set_point_weight, mode) = (1.0, LoopMode::Automatic);
                LevelController::Sampled {
                    settings: PiSettings { gain, integral_time_s, set_point_weight, anti_windup, mode },
                    sampling_time_s: SAMPLING_TIME_S,
                }
            }
            ControllerKind::Pid => LevelController::Pid {
                proportional: gain,
                integral: gain / integral_time_s,
                derivative: 0.0,
                filter_time_s: DERIVATIVE_FILTER_S,
            },
            ControllerKind::Off => LevelController::off(),
        };
    }
}

impl LevelController {
    /// Gain and integral time of a PI controller; `None` for any other.
    pub fn pi_tuning(&self) -> Option<PiTuning> {
        match *self {
            Self::Pi { gain, integral_time_s, .. } => Some(PiTuning { gain, integral_time_s }),
            Self::Sampled { settings: PiSettings { gain, integral_time_s, .. }, .. } => {
                Some(PiTuning { gain, integral_time_s })
            }
            Self::Manual { .. } | Self::Pid { .. } => None,
        }
    }

    /// The PI tuning that comes next to a controller. A PID controller has the gain P and the integral time P/I where both act in one
    /// direction.
    fn tuning_or(&self, kept: PiTuning) -> PiTuning {
        match *self {
            Self::Pid { proportional: gain, integral, .. } if gain != 0.0 => {
                let integral_time_s = gain / integral;
                let acts = integral_time_s > 0.0 && integral_time_s.is_finite();
                PiTuning { gain, integral_time_s: if acts { integral_time_s } else { kept.integral_time_s } }
            }
            _ => self.pi_tuning().unwrap_or(kept),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::{AntiWindup, ParallelPid};

    const KEPT: PiTuning = PiTuning { gain: 2.0, integral_time_s: 120.0 };

    fn pid(proportional: f64, integral: f64) -> LevelController {
        LevelController::pid(ParallelPid { proportional, integral, ..ParallelPid::default() }, DERIVATIVE_FILTER_S)
    }

    fn converted(controller: LevelController, kind: ControllerKind) -> LevelController {
        let mut setup = LevelLoopSetup { controller, ..LevelLoopSetup::default() };
        setup.set_controller_kind(kind, KEPT);
        setup.controller
    }

    #[test]
    fn every_kind_becomes_every_other_with_numbers_that_run() {
        let gains = [0.0, 1e-9, 2.0, -2.0];
        let of_pid = gains.into_iter().flat_map(|p| [0.0, 1e-3, -1e-3].map(|i| pid(p, i)));
        let of_pi = gains.into_iter().flat_map(|gain| {
            let pi = LevelController::pi(gain, 120.0);
            [converted(pi.clone(), ControllerKind::Sampled), pi]
        });
        for controller in of_pid.chain(of_pi).chain([LevelController::off()]) {
            for first in ControllerKind::ALL {
                for second in ControllerKind::ALL {
                    let found = converted(converted(controller.clone(), first), second);
                    assert_eq!(ControllerKind::of(&found), second);
                    assert_eq!(found.check(), Ok(()), "{controller:?} {first:?} {second:?}");
                }
            }
        }
    }

    #[test]
    fn a_tuning_survives_the_change_of_its_form() {
        let there = converted(LevelController::pi(-4.0, 250.0), ControllerKind::Pid);
        assert_eq!(there, pid(-4.0, -0.016));
        assert_eq!(converted(there, ControllerKind::Pi), LevelController::pi(-4.0, 250.0));
    }

    #[test]
    fn what_a_pid_controller_does_not_say_is_kept() {
        let tuning = |p: f64, i: f64| converted(pid(p, i), ControllerKind::Pi);
        assert_eq!(tuning(0.0, 0.5), LevelController::pi(KEPT.gain, KEPT.integral_time_s));
        assert_eq!(tuning(5.0, 0.0), LevelController::pi(5.0, KEPT.integral_time_s));
        assert_eq!(tuning(5.0, -0.5), LevelController::pi(5.0, KEPT.integral_time_s));
    }

    #[test]
    fn the_kind_that_a_controller_has_changes_nothing() {
        let controller = LevelController::Pi {
            gain: 3.0,
            integral_time_s: 40.0,
            anti_windup: AntiWindup::BackCalculation { tracking_ratio: 0.5 },
        };
        assert_eq!(converted(controller.clone(), ControllerKind::Pi), controller);
        assert_eq!(converted(pid(0.0, 0.5), ControllerKind::Pid), pid(0.0, 0.5));
    }
}

//! What mends a session in which a part finds nothing, or controllers that are not stable.

use crate::control::PidMatrix;
use crate::linear::{Complex, LoopStability};
use crate::tuning::{Action, Design, RelayVerdict, TuningError, TuningRule, propose};

use super::start::DEAD_TIME_S;
use super::{Designed, PlantStudy, SeriesElement, Tested, TuningPlant, TuningSetup, rule_targets};

/// Half widths of hysteresis that may end chattering, as shares of what the relay moves its output by at rest; the least that does
/// is taken, because hysteresis moves the point that the test finds.
const HYSTERESES: [f64; 5] = [0.02, 0.05, 0.1, 0.2, 0.4];

/// A change of a session.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mend {
    /// The target λ becomes that of this rule.
    TargetOfRule(TuningRule),
    /// The relays get hysteresis of these half widths.
    Hysteresis([f64; 2]),
    /// The rig gets the dead time that it begins with (s), on its linear model.
    DeadTime(f64),
    /// Each loop drives the other input.
    OtherPairing,
}

impl Mend {
    /// Changes a session.
    pub fn apply(self, setup: &mut TuningSetup) {
        match self {
            Self::TargetOfRule(rule) => {
                if let Some((_, at)) = rule_targets().into_iter().find(|(of, _)| *of == rule) {
                    setup.design.target = [at.re, at.im];
                }
            }
            Self::Hysteresis(half_widths) => setup.test.hysteresis = half_widths,
            Self::OtherPairing => {
                if let TuningPlant::Elements(rows) = &mut setup.plant {
                    for row in rows {
                        row.swap(0, 1);
                    }
                } else if let Some(tank) = setup.plant.tank_mut() {
                    *tank.pairing = tank.pairing.other();
                }
            }
            Self::DeadTime(time_s) => {
                if let Some(tank) = setup.plant.tank_mut() {
                    (*tank.dead_time_s, *tank.nonlinear) = (time_s, false);
                }
            }
        }
    }
}

impl TuningSetup {
    /// The dead time that a rig without one lacks.
    pub fn missing_dead_time(&self) -> Option<Mend> {
        let tank = self.plant.tank()?;
        let has_none = tank.dead_time_s == 0.0 && tank.rig.pumps.iter().any(|pump| pump.delay_s == 0.0);
        has_none.then_some(Mend::DeadTime(DEAD_TIME_S))
    }
}

/// The pairing with which both loops have a gain of their own, where one of them has none.
pub fn mend_pairing(error: &TuningError) -> Option<Mend> {
    matches!(error, TuningError::NoOwnGain { other_pairing: true, .. }).then_some(Mend::OtherPairing)
}

impl Tested {
    /// Whether a relay of the test switches as fast as it can.
    pub fn chatters(&self) -> bool {
        let is_chattering = |verdict: RelayVerdict| matches!(verdict, RelayVerdict::Chattering { .. });
        match self {
            Self::Single(test, _) | Self::Simultaneous(test, _) => is_chattering(test.reading.verdict),
            Self::Independent(loops) => loops.iter().any(|(test, _)| is_chattering(test.reading.verdict)),
            Self::Sequential(steps) => steps.iter().any(|step| is_chattering(step.test.reading.verdict)),
        }
    }
}

impl PlantStudy {
    /// The least hysteresis with which no relay of a session chatters, by trying; `None` where none of those tried does. Whether
    /// both loops then swing with one period is another question.
    pub fn mend_chattering(&self, setup: &TuningSetup) -> Option<Mend> {
        HYSTERESES.into_iter().find_map(|share| {
            // Direct feedthrough moves the output by its part at once, which hysteresis has to exceed.
            let half_width = |k: usize| {
                let [at_rest, at_once] = [self.rest_gain, self.plant.instant_gain()].map(|gain| gain[(k, k)].abs());
                setup.test.amplitudes[k] * (at_once + share * (at_rest - at_once).max(0.0))
            };
            let mend = Mend::Hysteresis([half_width(0), half_width(1)]);
            let mut mended = setup.clone();
            mend.apply(&mut mended);
            self.test(&mended).is_ok_and(|tested| !tested.chatters()).then_some(mend)
        })
    }

    /// By how much the output of a chattering relay jumps with it, through the direct feedthrough of its own element; `None` for another
    /// verdict, and where nothing is passed straight on.
    pub fn jump_with_relay(&self, setup: &TuningSetup, verdict: RelayVerdict) -> Option<f64> {
        let RelayVerdict::Chattering { relay } = verdict else { return None };
        let jump = 2.0 * setup.test.amplitudes[relay] * self.plant.instant_gain()[(relay, relay)].abs();
        (jump != 0.0 && setup.test.behind == SeriesElement::Nothing).then_some(jump)
    }

    /// The rule whose target makes the chosen root of a placement stable, where it is not.
    pub fn mend_placement(&self, setup: &TuningSetup, designed: &Designed) -> Option<Mend> {
        let spec = &setup.design;
        if spec.controllers.is_some() || designed.chosen_root().stability == LoopStability::Stable {
            return None;
        }
        let (root, critical) = (designed.chosen, designed.critical?);
        let is_pi = |rule: TuningRule| matches!(rule, TuningRule::ZieglerNicholsPi | TuningRule::TyreusLuybenPi);
        let is_stable = |target: Complex| {
            let found = propose(&self.rest_gain, &critical.g, critical.frequency, spec.method, spec.action, target);
            let controllers = found.ok().map(|roots| roots[root].controllers);
            let design = controllers.and_then(|of| Design::new(&self.plant, PidMatrix::decentralised(of)).ok());
            design.is_some_and(|design| design.stability() == LoopStability::Stable)
        };
        let of_action = rule_targets().into_iter().filter(|(rule, _)| is_pi(*rule) == (spec.action == Action::Pi));
        of_action
            .map(|(rule, at)| (rule, is_stable(at)))
            .find(|(_, stable)| *stable)
            .map(|(rule, _)| Mend::TargetOfRule(rule))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::PresetId;
    use crate::study::relay_tuning::tune;

    fn study(setup: &TuningSetup) -> PlantStudy {
        PlantStudy::of(&setup.plant).unwrap()
    }

    #[test]
    fn a_target_of_a_rule_makes_an_unstable_root_stable() {
        for action in [Action::Pi, Action::Pid] {
            let mut setup = TuningSetup::default();
            setup.design.action = action;
            setup.design.target = [-1.4, -0.2];
            let chosen = setup.design.root - 1;
            let plant = study(&setup);
            let designed = plant.design(&setup).unwrap().unwrap();
            assert!(matches!(designed.roots[chosen].stability, LoopStability::Unstable { .. }), "{action:?}");
            plant.mend_placement(&setup, &designed).unwrap().apply(&mut setup);
            let designed = plant.design(&setup).unwrap().unwrap();
            assert_eq!(designed.roots[chosen].stability, LoopStability::Stable, "{action:?}");
            assert_eq!(plant.mend_placement(&setup, &designed), None);
        }
    }

    #[test]
    fn hysteresis_or_a_dead_time_ends_chattering() {
        let mut setup = TuningSetup::on(TuningPlant::rig(PresetId::JohanssonMinimumPhase));
        let is_chattering = |setup: &TuningSetup| study(setup).test(setup).unwrap().chatters();
        assert!(!is_chattering(&setup) && setup.missing_dead_time().is_none());
        *setup.plant.tank_mut().unwrap().dead_time_s = 0.0;
        assert!(is_chattering(&setup));
        for mend in [study(&setup).mend_chattering(&setup), setup.missing_dead_time()] {
            let mut mended = setup.clone();
            mend.unwrap().apply(&mut mended);
            assert!(!is_chattering(&mended), "{mend:?}");
        }
    }

    #[test]
    fn loops_without_a_gain_of_their_own_are_tuned_in_the_other_pairing() {
        let element = |gain: f64| crate::study::relay_tuning::Element {
            numerator: vec![gain],
            denominator: vec![1.0, 3.0, 3.0, 1.0],
            dead_time: 0.2,
        };
        let rig = TuningPlant::QuadrupleTank {
            preset: crate::literature::PresetId::JohanssonNonMinimumPhase,
            valves: Some([0.0, 0.3]),
            pairing: crate::control::Pairing::Diagonal,
            dead_time_s: 5.0,
            lag_s: 0.0,
            nonlinear: false,
        };
        let cross = TuningPlant::Elements([[element(0.0), element(2.0)], [element(1.0), element(0.5)]]);
        for plant in [rig, cross] {
            let mut setup = TuningSetup::on(plant);
            let error = PlantStudy::of(&setup.plant).unwrap_err();
            assert_eq!(error, TuningError::NoOwnGain { number: 1, other_pairing: true });
            mend_pairing(&error).unwrap().apply(&mut setup);
            let found = tune(&setup).unwrap();
            let design = found.design.unwrap();
            assert!(design.chosen_root().controllers.iter().all(|pid| pid.proportional != 0.0), "{design:?}");
        }
        let none = TuningPlant::Elements([[element(0.0), element(0.0)], [element(1.0), element(0.5)]]);
        let error = PlantStudy::of(&none).unwrap_err();
        assert_eq!((error, mend_pairing(&error)), (TuningError::NoOwnGain { number: 1, other_pairing: false }, None));
    }
}

//! What one bench hands to another: gains that were tuned by relays go to the rig, a rig goes to the relays or under the law
//! without a model.

use crate::control::{ModelFree, Pairing, ParallelPid, smallest_model_gain};
use crate::linear::LinearError;
use crate::plant::ValveSchedule;

use super::StudyError;
use super::model_free::{ModelFreeSetup, StartSpec};
use super::quadruple_tank::{self, PlantSpec, setup_of};
use super::relay_tuning::{Designed, TuningPlant, TuningSetup};

/// The rig of a relay session under its PI controllers, in the published experiment of the rig. The gains of a
/// session are those from the measured level to the pump, the controllers of the rig act before its power module: K = kp/gain,
/// Ti = kp/ki.
///
/// `None` for another plant, for controllers with derivative action, and for one without integral action of the same sign.
pub fn rig_under(setup: &TuningSetup, designed: &Designed) -> Option<quadruple_tank::Setup> {
    let TuningPlant::QuadrupleTank { preset, valves, pairing, .. } = setup.plant else { return None };
    let mut rig = setup_of(preset);
    rig.valves = valves.unwrap_or(rig.valves);
    let root = designed.chosen_root();
    rig.controller.pairing = match root.pairing {
        Pairing::Diagonal => pairing,
        Pairing::Swapped => pairing.other(),
    };
    let power_gain = rig.plant().power_gain;
    for (settings, pid) in rig.controller.loops.iter_mut().zip(&root.controllers) {
        let &ParallelPid { proportional, integral, derivative, .. } = pid;
        let integral_time_s = proportional / integral;
        if derivative != 0.0 || !(integral_time_s.is_finite() && integral_time_s > 0.0) {
            return None;
        }
        (settings.gain, settings.integral_time_s) = (proportional / power_gain, integral_time_s);
    }
    Some(rig)
}

/// A relay session on a rig with the valves and the pairing that it has; `None` for a rig of one's own, which relay sessions do
/// not know.
pub fn relay_session_on(rig: &quadruple_tank::Setup) -> Option<TuningSetup> {
    let PlantSpec::Preset(id) = rig.plant else { return None };
    let mut plant = TuningPlant::rig(id);
    if let TuningPlant::QuadrupleTank { valves, pairing, .. } = &mut plant {
        (*valves, *pairing) = (Some(rig.valves), rig.controller.pairing);
    }
    Some(TuningSetup::on(plant))
}

/// α̂ of a law that is made here, as a multiple of the smallest one that is stable: about that of the published case a.
const MODEL_GAIN_MARGIN: f64 = 1.5;

/// A rig under the law without a model, in its own experiment and beside its own PI controllers. The law is the published one but
/// for α̂, which is as far from the limit of stability as there; where no α̂ makes the loop stable it is the published one too.
///
/// # Errors
/// [`StudyError`] as [`quadruple_tank::Setup::operating_point`], and at `plant` where a hose delays a pump: that bench knows no dead time.
pub fn model_free_on(rig: &quadruple_tank::Setup) -> Result<ModelFreeSetup, StudyError> {
    let point = rig.operating_point()?;
    let plant = rig.plant();
    if let Some(value) = plant.pumps.iter().map(|pump| pump.delay_s).find(|&delay_s| delay_s > 0.0) {
        return Err(LinearError::OutOfRange { field: "delay_s", value }.into());
    }
    let jacobian = plant.linearise(&point);
    let mut law = ModelFree { pairing: rig.controller.pairing, ..ModelFree::PUBLISHED };
    if let Ok(Some(smallest)) = smallest_model_gain(&jacobian, &law, plant.power_gain) {
        for settings in &mut law.loops {
            settings.model_gain = MODEL_GAIN_MARGIN * smallest;
        }
    }
    Ok(ModelFreeSetup {
        plant: rig.plant,
        valves: rig.valves.map(|gamma| ValveSchedule::Constant { gamma }),
        start: StartSpec::Rest([point.levels[0], point.levels[1]]),
        controller: law,
        compare: Some(rig.controller),
        experiment: rig.experiment.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::{LoopStability, Stability};
    use crate::literature::PresetId;
    use crate::sim::Settling;
    use crate::study::model_free::{analyse_model_free, run_model_free};
    use crate::study::quadruple_tank::analyse;
    use crate::study::relay_tuning::{Mend, PlantStudy};
    use crate::tuning::{Action, TuningRule};

    #[test]
    fn gains_of_a_stable_design_are_stable_on_the_rig() {
        for id in PresetId::ALL {
            let mut session = TuningSetup::on(TuningPlant::rig(id));
            session.design.action = Action::Pi;
            Mend::TargetOfRule(TuningRule::TyreusLuybenPi).apply(&mut session);
            let design = PlantStudy::of(&session.plant).unwrap().design(&session).unwrap().unwrap();
            let rig = rig_under(&session, &design).unwrap();
            let root = &design.roots[session.design.root - 1];
            assert_eq!(root.stability, LoopStability::Stable, "{id:?}");
            let power_gain = rig.plant().power_gain;
            for (settings, pid) in rig.controller.loops.iter().zip(&root.controllers) {
                let kp = settings.gain * power_gain;
                assert!((kp - pid.proportional).abs() <= 1e-12 * kp.abs());
                assert!((kp / settings.integral_time_s - pid.integral).abs() <= 1e-12 * pid.integral.abs());
            }
            // The session has a dead time of 5 s besides, so what is stable there is stable here.
            assert_eq!(analyse(&rig).unwrap().closed_loop.stability, Stability::Stable, "{id:?}");
            let back = relay_session_on(&rig).unwrap();
            assert!(matches!(back.plant, TuningPlant::QuadrupleTank { preset, valves: Some(valves), .. }
                if preset == id && valves == rig.valves));
        }
    }

    #[test]
    fn derivative_action_stays_on_its_bench() {
        let mut session = TuningSetup::on(TuningPlant::rig(PresetId::JohanssonMinimumPhase));
        session.design.action = Action::Pid;
        let design = PlantStudy::of(&session.plant).unwrap().design(&session).unwrap().unwrap();
        assert_eq!(rig_under(&session, &design), None);
    }

    /// The home bench finds settling times by interpolation between rows, the model-free bench by samples, so they agree to one.
    #[test]
    fn the_same_loops_settle_after_the_same_time_on_both_benches() {
        let rig = setup_of(PresetId::JohanssonMinimumPhase);
        let at_home = quadruple_tank::run(&rig).unwrap().metrics;
        let (_, compared) = run_model_free(&model_free_on(&rig).unwrap()).unwrap().comparison.unwrap();
        for (home, other) in at_home.iter().zip(compared) {
            let Some(Settling::After { time_s }) = home.settling_2_percent else { panic!("{home:?}") };
            let other = other.settling_s.unwrap();
            assert!((other - time_s).abs() <= rig.controller.sampling_time_s, "{other} s and {time_s} s");
        }
    }

    #[test]
    fn a_rig_runs_from_rest_under_the_law_without_a_model() {
        for id in PresetId::ALL {
            let rig = setup_of(id);
            let setup = model_free_on(&rig).unwrap();
            assert_eq!((setup.controller.pairing, setup.plant), (rig.controller.pairing, rig.plant));
            let answer = run_model_free(&setup).unwrap();
            let run = &answer.run.trajectory;
            let start = rig.operating_point().unwrap();
            for level in 0..4 {
                assert!((run.levels[level][0] - start.levels[level]).abs() < 1e-9, "{id:?}");
            }
            assert!(answer.comparison.is_some());
        }
        // On the diagonal pairing of a minimum-phase rig some α̂ is stable.
        let rig = setup_of(PresetId::JohanssonMinimumPhase);
        assert_eq!(rig.controller.pairing, Pairing::Diagonal);
        let poles = analyse_model_free(&model_free_on(&rig).unwrap()).poles.unwrap().unwrap();
        assert_eq!(poles.stability, Stability::Stable);
    }
}

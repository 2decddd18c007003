//! What one bench hands to another: gains that were tuned by relays go to the rig, a rig goes to the relays or under the law
//! without a model.

use crate::control::{ModelFree, Pairing, ParallelPid, smallest_model_gain};
use crate::linear::LinearError;
use crate::literature::{DisplayUnit, PresetId};
use crate::plant::{QuadrupleTank, ValveSchedule};

use super::StudyError;
use super::model_free::{ModelFreeSetup, StartSpec};
use super::quadruple_tank::{self, OperatingPointSpec, PlantSpec, setup_of};
use super::relay_tuning::{Designed, TunedTank, TuningPlant, TuningSetup};

/// Steps of the references of a rig of one's own, as a share of the levels.
const STEP_SHARE: f64 = 0.05;

/// A rig of one's own in the experiment of Johansson's (2000), with steps of 5 % of its levels and times by its slowest tank.
fn own_setup(tank: &TunedTank) -> quadruple_tank::Setup {
    let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
    let slowest = |rig: &QuadrupleTank, pump_voltage: [f64; 2]| {
        let times = rig.time_constants_s(&rig.free_equilibrium(pump_voltage));
        times.into_iter().flatten().fold(0.0, f64::max)
    };
    let published = PresetId::JohanssonMinimumPhase.preset();
    let scale = slowest(&tank.rig, tank.pump_voltage) / slowest(&published.plant, published.pump_voltage);
    // Round times, such as 270 s.
    let scale = if scale > 0.0 { (10.0 * scale).ceil() / 10.0 } else { 1.0 };
    let levels = tank.rig.free_equilibrium(tank.pump_voltage).levels;
    for step in &mut setup.experiment.set_point_steps {
        (step.time_s, step.size) = (step.time_s * scale, STEP_SHARE * levels[step.level]);
    }
    setup.experiment.duration_s *= scale;
    setup.controller.sampling_time_s *= scale;
    setup.plant = PlantSpec::Parameters { rig: tank.rig, display_unit: DisplayUnit::Cm };
    setup.operating_point = OperatingPointSpec::PumpVoltage(tank.pump_voltage);
    setup
}

/// The rig of a relay session under its PI controllers, in the published experiment of the rig, or in one like it. The gains of a
/// session are those from the measured level to the pump, the controllers of the rig act before its power module: K = kp/gain,
/// Ti = kp/ki.
///
/// `None` for another plant, for controllers with derivative action, and for one without integral action of the same sign.
pub fn rig_under(setup: &TuningSetup, designed: &Designed) -> Option<quadruple_tank::Setup> {
    let tank = setup.plant.tank()?;
    let mut rig = match setup.plant {
        TuningPlant::QuadrupleTank { preset, .. } => setup_of(preset),
        _ => own_setup(&tank),
    };
    rig.valves = tank.rig.valves;
    let root = designed.chosen_root();
    rig.controller.pairing = match root.pairing {
        Pairing::Diagonal => tank.pairing,
        Pairing::Swapped => tank.pairing.other(),
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

/// A relay session on a rig with the valves and the pairing that it has, at its published voltages, or at those of the setup for one
/// of one's own.
///
/// # Errors
/// [`StudyError`] as [`quadruple_tank::Setup::operating_point`], for a rig of one's own.
pub fn relay_session_on(rig: &quadruple_tank::Setup) -> Result<TuningSetup, StudyError> {
    let mut plant = match rig.plant {
        PlantSpec::Preset(id) => TuningPlant::rig(id),
        PlantSpec::Parameters { .. } => TuningPlant::own_rig(rig.plant(), rig.operating_point()?.pump_voltage),
    };
    plant.set_valves(rig.valves);
    if let Some(tank) = plant.tank_mut() {
        *tank.pairing = rig.controller.pairing;
    }
    Ok(TuningSetup::on(plant))
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

    /// A published rig written as one of the user's own, with other voltages and valves than the published ones.
    fn own_rig(id: PresetId) -> quadruple_tank::Setup {
        let mut setup = setup_of(id);
        setup.plant = PlantSpec::Parameters { rig: setup.plant(), display_unit: setup.plant.display_unit() };
        setup.operating_point = OperatingPointSpec::PumpVoltage(id.preset().pump_voltage.map(|v| 0.9 * v));
        setup.valves = setup.valves.map(|gamma| 0.95 * gamma);
        setup.controller.pairing = TuningPlant::rig(id).tank().unwrap().pairing;
        setup
    }

    #[test]
    fn a_rig_of_ones_own_goes_to_the_relays_and_back() {
        for id in PresetId::ALL {
            let own = own_rig(id);
            let mut session = relay_session_on(&own).unwrap();
            let TuningPlant::Parameters { ref rig, pump_voltage, .. } = session.plant else {
                panic!("a rig of one's own")
            };
            assert_eq!((**rig, OperatingPointSpec::PumpVoltage(pump_voltage)), (own.plant(), own.operating_point));
            session.design.action = Action::Pi;
            Mend::TargetOfRule(TuningRule::TyreusLuybenPi).apply(&mut session);
            let design = PlantStudy::of(&session.plant).unwrap().design(&session).unwrap();
            let design = design.unwrap_or_else(|| panic!("{id:?} has a design"));
            let back = rig_under(&session, &design).unwrap();
            assert_eq!((back.plant(), back.operating_point), (own.plant(), own.operating_point), "{id:?}");
            assert_eq!(analyse(&back).unwrap().closed_loop.stability, Stability::Stable, "{id:?}");
            let levels = own.operating_point().unwrap().levels;
            for step in &back.experiment.set_point_steps {
                assert!((step.size - STEP_SHARE * levels[step.level]).abs() < 1e-12, "{id:?}");
                assert!(step.time_s < back.experiment.duration_s, "{id:?}");
            }
            assert!(quadruple_tank::run(&back).is_ok(), "{id:?}");
        }
    }

    #[test]
    fn relays_see_the_same_rig_whoever_describes_it() {
        for id in [PresetId::JohanssonMinimumPhase, PresetId::CocotaNonMinimumPhase, PresetId::Seville] {
            let published = TuningPlant::rig(id);
            let mut own = TuningPlant::own_rig(id.preset().plant, id.preset().pump_voltage);
            assert_eq!(own.transfer_matrix().unwrap(), published.transfer_matrix().unwrap(), "{id:?}");
            assert!(own.has_same_time_unit(&published));
            let mut sessions = [published, own.clone()].map(TuningSetup::on);
            for session in &mut sessions {
                let tank = session.plant.tank_mut().unwrap();
                (*tank.dead_time_s, *tank.nonlinear) = (0.0, true);
            }
            let [published, nonlinear] = sessions.map(|session| PlantStudy::of(&session.plant).unwrap().test(&session));
            assert_eq!(published, nonlinear, "{id:?}");
            // Hoses are dead times of the elements.
            let TuningPlant::Parameters { rig, .. } = &mut own else { panic!("a rig of one's own") };
            for (pump, delay_s) in rig.pumps.iter_mut().zip([3.0, 4.0]) {
                pump.delay_s = delay_s;
            }
            let pairing = own.tank().unwrap().pairing;
            let dead_times = own.transfer_matrix().unwrap().0.map(|row| row.map(|element| element.dead_time()));
            let by_loop = [8.0, 9.0].map(|time: f64| time);
            let expected = if pairing == Pairing::Diagonal { by_loop } else { [by_loop[1], by_loop[0]] };
            assert_eq!(dead_times, [expected; 2], "{id:?}");
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

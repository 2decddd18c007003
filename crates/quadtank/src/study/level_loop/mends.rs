use crate::assess::LoopQuality;
use crate::sim::level::LevelController;

use super::findings::{lasting_inflow, set_point_out_of_reach};
use super::{Finding, LevelLoopAnswer, LevelLoopSetup, PiTuning};

/// A correction of a setup that removes a warning.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mend {
    /// Gain and integral time by a rule for the model at the operating point, with which the loop is stable.
    AdvisedTuning(PiTuning),
    /// Steps of the set-point scaled to end at this level (m), the nearest to the requested one that the loop can hold.
    SetPoint(f64),
    /// Initial level (m), the nearest to the requested one at which the loop can rest.
    Start(f64),
}

/// Bisections for the largest feasible step of the set-point.
const HALVINGS: usize = 40;
/// Share of the largest feasible step that is offered: at the whole of it the valve stands at its limit.
const WITHIN: f64 = 0.98;
/// Initial levels that are tried, evenly spaced over the height.
const STARTS: u32 = 200;

impl Mend {
    /// The setup with this change.
    #[must_use]
    pub fn applied(self, setup: &LevelLoopSetup) -> LevelLoopSetup {
        let mut mended = setup.clone();
        match self {
            Self::AdvisedTuning(tuning) => mended.controller = tuned(&setup.controller, tuning, setup),
            Self::SetPoint(level) => {
                let start = setup.experiment.level;
                let share = (level - start) / (setup.final_set_point() - start);
                mended.experiment.set_point_steps.iter_mut().for_each(|step| step.size *= share);
            }
            Self::Start(level) => mended.experiment.level = level,
        }
        mended
    }
}

/// The tuning that makes an unstable or fragile loop, or one without a gain, stable and robust.
pub fn mend_loop(setup: &LevelLoopSetup, found: &LevelLoopAnswer) -> Option<Mend> {
    let quality = found.quality.as_ref().ok()?.as_ref()?;
    let has_no_gain = found.findings.contains(&Finding::NoGain);
    if !quality.is_fragile() && !has_no_gain {
        return None;
    }
    let plant = setup.plant();
    let gains = plant.gains(&plant.rest(setup.experiment.level, setup.experiment.inflow).ok()?);
    let is_calm = |tuning: &PiTuning| {
        let quality = LoopQuality::of(&gains, &tuned(&setup.controller, *tuning, setup));
        matches!(quality, Ok(Some(quality)) if !quality.is_fragile())
    };
    setup.tunings_by_rule().into_iter().flatten().find(is_calm).map(Mend::AdvisedTuning)
}

/// The change with which the run reaches its set-point: a robust loop first, then a feasible set-point.
pub fn mend_run(setup: &LevelLoopSetup, found: &LevelLoopAnswer) -> Option<Mend> {
    let swings = found.quality.as_ref().is_ok_and(|quality| quality.is_some_and(|quality| quality.is_on_the_edge()));
    let fails = |finding: &Finding| matches!(finding, Finding::Unstable | Finding::NoGain);
    let loop_first = (swings || found.findings.iter().any(fails)).then(|| mend_loop(setup, found)).flatten();
    loop_first.or_else(|| mend_set_point(setup))
}

/// The feasible set-point in the place of one that the loop cannot hold.
fn mend_set_point(setup: &LevelLoopSetup) -> Option<Mend> {
    let plant = setup.plant();
    set_point_out_of_reach(setup, &plant)?;
    let start = setup.experiment.level;
    let inflow = (setup.experiment.inflow + lasting_inflow(&setup.experiment)).max(0.0);
    let change = setup.final_set_point() - start;
    let is_held = |share: f64| plant.rest(start + share * change, inflow).is_ok();
    if !is_held(0.0) {
        return None;
    }
    let (mut held, mut lost) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let share = f64::midpoint(held, lost);
        if is_held(share) { held = share } else { lost = share }
    }
    let share = WITHIN * held;
    (share > 0.0 && is_held(share)).then_some(Mend::SetPoint(start + share * change))
}

/// The initial level at which the loop can rest, in the place of one at which it cannot.
pub fn mend_start(setup: &LevelLoopSetup) -> Option<Mend> {
    let (plant, wanted) = (setup.plant(), setup.experiment.level);
    let is_held = |level: f64| plant.rest(level, setup.experiment.inflow).is_ok();
    if is_held(wanted) {
        return None;
    }
    let levels = (1..STARTS).map(|k| plant.tank.height * f64::from(k) / f64::from(STARTS));
    levels
        .filter(|&level| is_held(level))
        .min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs()))
        .map(Mend::Start)
}

/// The controller with a PI tuning, of its present kind; a PI controller where there is none.
fn tuned(controller: &LevelController, tuning: PiTuning, setup: &LevelLoopSetup) -> LevelController {
    let PiTuning { gain, integral_time_s } = tuning;
    match controller.clone() {
        LevelController::Sampled { mut settings, sampling_time_s } => {
            (settings.gain, settings.integral_time_s) = (gain, integral_time_s);
            LevelController::Sampled { settings, sampling_time_s }
        }
        LevelController::Pid { filter_time_s, .. } => LevelController::Pid {
            proportional: gain,
            integral: gain / integral_time_s,
            derivative: 0.0,
            filter_time_s,
        },
        LevelController::Pi { .. } | LevelController::Manual { .. } => {
            LevelController::Pi { gain, integral_time_s, anti_windup: setup.anti_windup() }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::ParallelPid;
    use crate::literature::level_slides::DERIVATIVE_FILTER_S;
    use crate::sim::level::{InflowSignal, SetPointScale, SignalStep};
    use crate::study::level_loop::{ControllerKind, run_level_loop};

    fn quality(setup: &LevelLoopSetup) -> LoopQuality {
        run_level_loop(setup).unwrap().quality.unwrap().unwrap()
    }

    #[test]
    fn an_unstable_loop_of_every_kind_is_put_on_the_rule() {
        let wild = ParallelPid { proportional: 150.0, integral: 1.0, ..ParallelPid::default() };
        for controller in [
            LevelController::pi(100.0, 588.0),
            LevelController::pid(wild, DERIVATIVE_FILTER_S),
            LevelController::pi(0.0, 588.0),
        ] {
            let setup = LevelLoopSetup { controller, ..LevelLoopSetup::default() };
            let mend = mend_loop(&setup, &run_level_loop(&setup).unwrap()).unwrap();
            let mended = mend.applied(&setup);
            assert!(!quality(&mended).is_fragile(), "{mended:?}");
            assert_eq!(ControllerKind::of(&mended.controller), ControllerKind::of(&setup.controller));
            assert_eq!(mend_loop(&mended, &run_level_loop(&mended).unwrap()), None);
        }
    }

    #[test]
    fn a_set_point_out_of_reach_becomes_the_nearest_that_is_held() {
        for scale in [SetPointScale::Level, SetPointScale::Signal] {
            let mut setup = LevelLoopSetup::default();
            assert_eq!(mend_set_point(&setup), None);
            setup.experiment.disturbance.signal = InflowSignal::None;
            setup.experiment.set_point_scale = scale;
            let per_metre = if scale == SetPointScale::Level { 1.0 } else { setup.plant().transmitter.gain() };
            setup.experiment.set_point_steps = vec![SignalStep { time_s: 0.0, size: -0.99 * per_metre }];
            assert!(set_point_out_of_reach(&setup, &setup.plant()).is_some());
            let Some(mend @ Mend::SetPoint(level)) = mend_set_point(&setup) else { panic!("a level can be held") };
            let mended = mend.applied(&setup);
            assert!((mended.final_set_point() - level).abs() < 1e-12 && level < 1.0, "{level}");
            assert_eq!(set_point_out_of_reach(&mended, &mended.plant()), None);
        }
    }

    #[test]
    fn a_start_that_does_not_rest_becomes_one_that_does() {
        let mut setup = LevelLoopSetup::default();
        assert_eq!(mend_start(&setup), None);
        setup.experiment.level = 0.001;
        let mended = mend_start(&setup).unwrap().applied(&setup);
        assert!(run_level_loop(&mended).is_ok() && mended.experiment.level < 1.0);
        setup.experiment.inflow = 1e3;
        assert_eq!(mend_start(&setup), None);
    }
}

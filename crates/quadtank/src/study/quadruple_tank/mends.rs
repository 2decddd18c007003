use crate::linear::Stability;
use crate::plant::OperatingPoint;
use crate::sim::NoResponse;

use super::{Analysis, OperatingPointSpec, PlantSpec, Run, Setup, detuned, run};

/// How the operating point is lowered from one try to the next, and how often.
const LOWER: f64 = 0.95;
const MAX_LOWERED: i32 = 60;
/// How often steps are halved at most.
const MAX_HALVED: i32 = 10;

/// A change of a setup that mends what a warning says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mend {
    /// Both loops are detuned until they are stable, see [`detuned`].
    DetuneLoops,
    /// The pairing that the relative gains suggest, with detuned loops where the present ones are not good for that.
    AdvisedPairing,
    /// The valves of the published rig, with which its gain is not singular.
    PublishedValves,
    /// A lower operating point, with which no tank runs over and no pump is beyond its limits.
    LowerRest,
    /// Steps of the references that are halved until no tank runs over or dry and no pump meets a limit.
    HalvedSteps,
}

impl Mend {
    /// The setup with this change; `None` where it would mend nothing.
    pub fn applied(self, setup: &Setup) -> Option<Setup> {
        match self {
            Self::DetuneLoops => detuned(setup),
            Self::AdvisedPairing => {
                let mut tried = setup.clone();
                tried.controller.pairing = setup.controller.pairing.other();
                detuned(&tried)
            }
            Self::PublishedValves => {
                let PlantSpec::Preset(id) = setup.plant else { return None };
                let valves = id.preset().plant.valves;
                (valves != setup.valves).then(|| Setup { valves, ..setup.clone() })
            }
            Self::LowerRest => (1..=MAX_LOWERED).map(|tries| lowered(setup, LOWER.powi(tries))).find(rests_within),
            Self::HalvedSteps => (1..=MAX_HALVED).map(|times| stepping(setup, 0.5_f64.powi(times))).find(is_free),
        }
    }
}

/// What makes an unstable loop stable. A pairing that is advised against comes before gains. On the border of stability, as with a
/// singular gain, no gains help: other valves do. `analysis` is `None` where no voltages hold the levels that are asked for.
pub fn mend_loop(setup: &Setup, analysis: Option<&Analysis>) -> Option<Mend> {
    let candidates = match analysis.map(|analysis| (analysis.closed_loop.stability, analysis.linear.advised_pairing()))
    {
        Some((Stability::Stable, _)) => &[][..],
        None | Some((Stability::Marginal, _)) => &[Mend::PublishedValves],
        Some((Stability::Unstable, advised)) => {
            if advised.is_some_and(|advised| advised != setup.controller.pairing) {
                &[Mend::AdvisedPairing]
            } else {
                &[Mend::DetuneLoops]
            }
        }
    };
    candidates.iter().copied().find(|mend| mend.applied(setup).is_some())
}

/// What brings an operating point within walls and pumps.
pub fn mend_rest(setup: &Setup) -> Option<Mend> {
    (!rests_within(setup)).then_some(Mend::LowerRest).filter(|mend| mend.applied(setup).is_some())
}

/// What keeps a run of a stable loop off walls and limits. Halving the steps is offered where the run without them meets none; how
/// often it takes is found when it is asked for.
pub fn mend_run(setup: &Setup, found: &Run) -> Option<Mend> {
    let reasons = found.metrics.map(|metrics| metrics.no_response);
    if reasons.contains(&Some(NoResponse::StartOverflows)) {
        return mend_rest(setup);
    }
    let is_judged = !reasons.iter().flatten().any(|reason| {
        matches!(reason, NoResponse::UnstableLoop | NoResponse::MarginalLoop | NoResponse::TooLongToJudge)
    });
    let steps = setup.experiment.set_point_steps.iter().any(|step| step.size != 0.0);
    let offers = is_judged && steps && !found.nonlinear.events.is_empty() && is_free(&stepping(setup, 0.0));
    offers.then_some(Mend::HalvedSteps)
}

/// With whatever gives the operating point at a share of it.
fn lowered(setup: &Setup, share: f64) -> Setup {
    let operating_point = match setup.operating_point {
        OperatingPointSpec::PumpVoltage(voltages) => OperatingPointSpec::PumpVoltage(voltages.map(|v| v * share)),
        OperatingPointSpec::Levels(levels) => OperatingPointSpec::Levels(levels.map(|level| level * share)),
        OperatingPointSpec::State(OperatingPoint { levels, pump_voltage }) => {
            OperatingPointSpec::State(OperatingPoint {
                levels: levels.map(|level| level * share),
                pump_voltage: pump_voltage.map(|v| v * share),
            })
        }
    };
    Setup { operating_point, ..setup.clone() }
}

fn rests_within(setup: &Setup) -> bool {
    setup.operating_point().is_ok_and(|point| setup.plant().violations(&point).is_empty())
}

/// With steps of the references of a share of their size.
fn stepping(setup: &Setup, share: f64) -> Setup {
    let mut tried = setup.clone();
    tried.experiment.set_point_steps.iter_mut().for_each(|step| step.size *= share);
    tried
}

/// Whether nothing runs over or dry and no pump meets a limit.
fn is_free(setup: &Setup) -> bool {
    run(setup).is_ok_and(|run| run.nonlinear.events.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Pairing;
    use crate::literature::PresetId;
    use crate::study::quadruple_tank::{analyse, setup_of};

    fn for_loop(setup: &Setup) -> Option<Mend> {
        mend_loop(setup, analyse(setup).ok().as_ref())
    }

    fn is_stable(setup: &Setup) -> bool {
        analyse(setup).unwrap().closed_loop.stability == Stability::Stable
    }

    #[test]
    fn unstable_loops_are_mended_by_pairing_or_by_gains() {
        let stable = setup_of(PresetId::JohanssonMinimumPhase);
        assert_eq!(for_loop(&stable), None);
        let mut wrong = stable.clone();
        wrong.controller.pairing = Pairing::Swapped;
        let mut eager = stable.clone();
        eager.controller.loops.iter_mut().for_each(|settings| settings.gain *= 200.0);
        for (setup, mend) in [(wrong, Mend::AdvisedPairing), (eager, Mend::DetuneLoops)] {
            assert!(!is_stable(&setup));
            assert_eq!(for_loop(&setup), Some(mend));
            let mended = mend.applied(&setup).unwrap();
            assert!(is_stable(&mended), "{mend:?}");
            assert_eq!(mended.controller.pairing, Pairing::Diagonal);
        }
    }

    #[test]
    fn on_the_line_other_valves_are_offered() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.valves = [0.6, 0.4];
        for operating_point in [setup.operating_point, OperatingPointSpec::Levels([0.12, 0.13])] {
            setup.operating_point = operating_point;
            assert_eq!(for_loop(&setup), Some(Mend::PublishedValves));
            assert!(is_stable(&Mend::PublishedValves.applied(&setup).unwrap()));
        }
        // A rig of one's own has no published valves.
        let unit = setup.plant.display_unit();
        setup.plant = PlantSpec::Parameters { rig: setup.plant.rig(), display_unit: unit };
        assert_eq!(for_loop(&setup), None);
    }

    #[test]
    fn an_operating_point_is_lowered_until_it_fits() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        assert_eq!(mend_rest(&setup), None);
        for (valves, point) in [
            ([0.3, 0.7], OperatingPointSpec::PumpVoltage([3.0, 3.0])),
            ([0.7, 0.6], OperatingPointSpec::Levels([0.25, 0.22])),
        ] {
            (setup.valves, setup.operating_point) = (valves, point);
            assert_eq!(mend_rest(&setup), Some(Mend::LowerRest), "{point:?}");
            let mended = Mend::LowerRest.applied(&setup).unwrap();
            assert!(rests_within(&mended), "{:?}", mended.operating_point);
            assert_eq!(mend_rest(&mended), None);
        }
        // No pump runs backwards, however low the levels are.
        (setup.valves, setup.operating_point) = ([0.7, 0.6], OperatingPointSpec::Levels([0.19, 0.005]));
        assert!(!rests_within(&setup));
        assert_eq!(mend_rest(&setup), None);
    }

    #[test]
    fn steps_are_halved_until_no_pump_is_at_its_limit() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.experiment.set_point_steps[0].size = 0.07;
        let found = run(&setup).unwrap();
        assert!(!found.nonlinear.events.is_empty());
        assert_eq!(mend_run(&setup, &found), Some(Mend::HalvedSteps));
        let mended = Mend::HalvedSteps.applied(&setup).unwrap();
        let free = run(&mended).unwrap();
        assert!(free.nonlinear.events.is_empty() && mend_run(&mended, &free).is_none());
        // Once less would not do.
        let share = mended.experiment.set_point_steps[0].size / 0.07;
        assert!(!is_free(&stepping(&setup, 2.0 * share)));
        setup.valves = [0.3, 0.7];
        assert_eq!(mend_run(&setup, &run(&setup).unwrap()), Some(Mend::LowerRest));
    }
}

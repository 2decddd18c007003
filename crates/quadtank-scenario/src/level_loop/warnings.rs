use quadtank::control::AntiWindup;
use quadtank::plant::level::SignalUnit;
use quadtank::sim::level::{InflowSignal, LevelController, LevelExperiment, SetPointScale};
use quadtank::study::level_loop::{LevelLoopSetup, ModelError, Objective};
use serde::Serialize;
use thiserror::Error;

/// What a level loop may not have been meant to say. Nothing is refused for it.
#[derive(Clone, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "warning", rename_all = "kebab-case")]
pub enum LevelLoopWarning {
    /// A setting that changes nothing here.
    #[error("{field}: without effect here; it acts only {acts}")]
    NoEffect {
        /// Where in the document.
        field: String,
        /// Where it would act.
        acts: &'static str,
    },
    /// A process whose signal falls when the output rises, with a search among positive gains.
    #[error(
        "{field}: the signal falls when the output rises ({slope_gain} 1/s per signal), so only a negative gain controls it"
    )]
    NegativeProcess {
        /// Where in the document.
        field: &'static str,
        /// Slope K' of the signal per unit of output (1/s).
        slope_gain: f64,
    },
    /// Two instruments that are connected name their signal by different units.
    #[error("{field}: {} goes into an instrument for {}", name(*unit), name(*expected))]
    UnitsDiffer {
        /// Where in the document.
        field: &'static str,
        /// Unit of what comes.
        unit: SignalUnit,
        /// Unit of what is expected.
        expected: SignalUnit,
    },
}

fn name(unit: SignalUnit) -> &'static str {
    match unit {
        SignalUnit::Milliampere => "mA",
        SignalUnit::Psi => "psi",
    }
}

/// What a level loop may not have been meant to say.
pub fn warnings(setup: &LevelLoopSetup) -> Vec<LevelLoopWarning> {
    units(setup).into_iter().chain(negative_process(setup)).chain(settings_without_effect(setup)).collect()
}

fn units(setup: &LevelLoopSetup) -> Option<LevelLoopWarning> {
    let plant = setup.plant();
    let (unit, expected) = (plant.output.signal.unit, plant.converter?.input.unit);
    let field = "level_loop.plant.parameters.output.signal.unit";
    (unit != expected).then_some(LevelLoopWarning::UnitsDiffer { field, unit, expected })
}

/// A level that cannot be held has no such slope; the run says so.
fn negative_process(setup: &LevelLoopSetup) -> Option<LevelLoopWarning> {
    let plant = setup.plant();
    let rest = plant.rest(setup.experiment.level, setup.experiment.inflow).ok()?;
    let slope_gain = plant.gains(&rest).slope_gain();
    let is_negative = slope_gain < 0.0 && slope_gain.is_finite();
    is_negative.then_some(LevelLoopWarning::NegativeProcess { field: "level_loop.search.gain", slope_gain })
}

const WITH_A_MOVE: &str = "with a disturbance or a step of the set-point within the run";
const WITH_STEPS: &str = "with a step of the set-point within the run";
const WITH_LIMITS: &str = "where the output ends at its range (`output.clips`)";
const WITHIN_THE_RUN: &str = "at a time within the run";

/// Settings with a value of their own that change nothing, because the document has no use for them.
fn settings_without_effect(setup: &LevelLoopSetup) -> Vec<LevelLoopWarning> {
    let (experiment, search) = (&setup.experiment, &setup.search);
    let steps = experiment.set_point_steps.iter().any(|step| acts_in(experiment, step.time_s) && step.size != 0.0);
    let disturbed = is_disturbed(experiment);
    let has_disturbance = experiment.disturbance.signal != InflowSignal::None
        || experiment.disturbance.from_s != 0.0
        || experiment.disturbance.until_s != 0.0;
    let is_tight = setup.objective == Objective::Tight;
    let clips = setup.plant().output.clips;
    let (windup, windup_field, weight) = match &setup.controller {
        LevelController::Pi { anti_windup, .. } => (*anti_windup, "controller.pi.anti_windup", 1.0),
        LevelController::Sampled { settings, .. } => {
            (settings.anti_windup, "controller.sampled.settings.anti_windup", settings.set_point_weight)
        }
        LevelController::Pid { .. } | LevelController::Manual { .. } => (AntiWindup::Off, "controller", 1.0),
    };
    let idle = [
        (
            !disturbed && has_disturbance,
            "experiment.disturbance",
            "with a size that is not 0, for a time within the run",
        ),
        (!steps && experiment.set_point_scale == SetPointScale::Signal, "experiment.set_point_scale", WITH_STEPS),
        (!steps && weight != 1.0, "controller.sampled.settings.set_point_weight", WITH_STEPS),
        (!clips && windup != AntiWindup::Off, windup_field, WITH_LIMITS),
        (!steps && !disturbed && setup.model_error != ModelError::NONE, "model_error", WITH_A_MOVE),
        (!steps && !disturbed, "reference", WITH_A_MOVE),
        (is_tight && search.keep_band, "search.keep_band", "with the band of averaging control"),
    ];
    let warn = |field: String, acts| LevelLoopWarning::NoEffect { field: format!("level_loop.{field}"), acts };
    let idle = idle.into_iter().filter(|(is_idle, ..)| *is_idle).map(|(_, field, acts)| warn(field.to_owned(), acts));
    let by_hand = match &setup.controller {
        LevelController::Manual { steps } => steps.as_slice(),
        _ => &[],
    };
    let lists =
        [("experiment.set_point_steps", experiment.set_point_steps.as_slice()), ("controller.manual.steps", by_hand)];
    let late = lists.into_iter().flat_map(|(list, steps)| {
        let late = steps.iter().enumerate().filter(|(_, step)| !acts_in(experiment, step.time_s));
        late.map(move |(index, _)| warn(format!("{list}[{index}]"), WITHIN_THE_RUN))
    });
    idle.chain(late).collect()
}

fn acts_in(experiment: &LevelExperiment, time_s: f64) -> bool {
    time_s < experiment.duration_s
}

fn is_disturbed(experiment: &LevelExperiment) -> bool {
    let disturbance = &experiment.disturbance;
    let size = match disturbance.signal {
        InflowSignal::None => 0.0,
        InflowSignal::Step { size } => size,
        InflowSignal::Sine { amplitude, .. } => amplitude,
        InflowSignal::SimulinkNormal { std, .. } | InflowSignal::Normal { std, .. } => std,
    };
    size != 0.0 && disturbance.from_s < disturbance.until_s && acts_in(experiment, disturbance.from_s)
}

#[cfg(test)]
mod tests {
    use quadtank::literature::LevelPresetId;
    use quadtank::literature::andreis::PublishedDisturbance;
    use quadtank::sim::level::{InflowDisturbance, SignalStep};
    use quadtank::study::level_loop::{LevelPlantSpec, published_setup};

    use super::*;

    fn fields(change: impl Fn(&mut LevelLoopSetup)) -> Vec<String> {
        let mut setup = LevelLoopSetup::default();
        change(&mut setup);
        warnings(&setup).iter().map(|warning| warning.to_string().split(':').next().unwrap().to_owned()).collect()
    }

    #[test]
    fn published_loops_have_none() {
        for id in LevelPresetId::ALL {
            for disturbance in PublishedDisturbance::ALL {
                assert_eq!(warnings(&published_setup(id, disturbance)), []);
            }
        }
    }

    #[test]
    fn what_has_no_effect_is_named() {
        let still = |setup: &mut LevelLoopSetup| setup.experiment.disturbance = InflowDisturbance::NONE;
        assert_eq!(fields(still), ["level_loop.reference"]);
        assert_eq!(fields(|setup| setup.search.keep_band = true), ["level_loop.search.keep_band"]);
        let scaled = |setup: &mut LevelLoopSetup| setup.experiment.set_point_scale = SetPointScale::Signal;
        assert_eq!(fields(scaled), ["level_loop.experiment.set_point_scale"]);
        let late = |setup: &mut LevelLoopSetup| {
            setup.experiment.set_point_steps = vec![SignalStep { time_s: 300.0, size: 0.1 }];
        };
        assert_eq!(fields(late), ["level_loop.experiment.set_point_steps[0]"]);
        let gone = |setup: &mut LevelLoopSetup| setup.experiment.disturbance.from_s = 150.0;
        assert_eq!(fields(gone), ["level_loop.experiment.disturbance", "level_loop.reference"]);
    }

    #[test]
    fn a_process_of_the_other_sign_is_named() {
        let found = fields(|setup| {
            let mut plant = setup.plant();
            plant.actuator.curve.0.iter_mut().for_each(|point| point[1] = 1.0 - point[1]);
            setup.plant = LevelPlantSpec::Parameters(plant);
        });
        assert_eq!(found, ["level_loop.search.gain"]);
    }

    #[test]
    fn instruments_of_different_units_are_named() {
        let found = fields(|setup| {
            let mut plant = setup.plant();
            plant.output.signal.unit = SignalUnit::Psi;
            setup.plant = LevelPlantSpec::Parameters(plant);
        });
        assert_eq!(found, ["level_loop.plant.parameters.output.signal.unit"]);
    }
}

use crate::control::{
    DecentralisedPi, ModelFree, ModelFreePoles, Pairing, closed_loop, continuous_model_free_poles, model_free_poles,
    smallest_model_gain, smallest_model_gain_of_integrator,
};
use crate::linear::{Complex, LinearError, Stability};
use crate::plant::{OperatingPoint, PlantError, QuadrupleTank, ValveSchedule};
use crate::sim::{
    Experiment, MAX_JUDGED_WORK, ModelFreeRun, NoResponse, TrackingMetrics, Trajectory, ZeroDynamics, ZeroDynamicsEnd,
    simulate_model_free, simulate_with_valves, tracking_metrics,
};
use crate::study::{LinearPlant, StudyError, whole};

use super::{ModelFreeSetup, StartSpec};

/// What theory says of a setup at the references that it ends with, and with its valves as they stand after their last step or
/// ramp; where they swing, as at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelFreeAnalysis {
    /// Where the loops should end, or why nothing holds those levels.
    pub rest: Result<OperatingPoint, PlantError>,
    /// The linear plant there.
    pub linear: Option<Result<LinearPlant, LinearError>>,
    /// Poles of the linear loop there.
    pub poles: Option<Result<ModelFreePoles, LinearError>>,
    /// Poles of the loop in continuous time without estimator there (1/s).
    pub continuous_poles: Option<Result<Vec<Complex>, LinearError>>,
    /// Smallest α̂ of a stable loop there (m/(s V)), see [`smallest_model_gain`].
    pub smallest_model_gain: Option<f64>,
    /// The same of each lower tank alone and without drain (m/(s V)).
    pub smallest_of_integrators: Option<[f64; 2]>,
}

/// Analyses a setup at the references that its experiment ends with.
pub fn analyse_model_free(setup: &ModelFreeSetup) -> ModelFreeAnalysis {
    let plant = setup.plant_at(setup.valves_rest_from_s());
    let rest = plant.rest_at(last_references(setup));
    let jacobian = rest.as_ref().ok().map(|rest| plant.linearise(rest));
    let gain = plant.power_gain;
    ModelFreeAnalysis {
        linear: jacobian.as_ref().map(LinearPlant::of),
        poles: jacobian.map(|jacobian| model_free_poles(&jacobian, &setup.controller, gain)),
        continuous_poles: jacobian.map(|jacobian| continuous_model_free_poles(&jacobian, &setup.controller, gain)),
        smallest_of_integrators: jacobian.map(|jacobian| {
            let ModelFree { pairing, loops, sampling_time_s, .. } = setup.controller;
            [0, 1].map(|i| {
                let slope = gain * jacobian.b[(i, pairing.pump_of(i))];
                smallest_model_gain_of_integrator(slope, loops[i].proportional, loops[i].integral, sampling_time_s)
            })
        }),
        smallest_model_gain: jacobian.and_then(|j| smallest_model_gain(&j, &setup.controller, gain).ok().flatten()),
        rest,
    }
}

/// References at the end of the experiment (m).
fn last_references(setup: &ModelFreeSetup) -> [f64; 2] {
    let start = match setup.start {
        StartSpec::Rest(levels) => levels,
        StartSpec::Empty => [0.0; 2],
    };
    [0, 1].map(|level| setup.experiment.reference_after(level, start[level], setup.experiment.duration_s))
}

/// When the upper tanks will end the tracking, as they stand at some time of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PredictedLoss {
    /// From when on it is predicted (s).
    pub from_s: f64,
    /// When and how it ends, or `None` when it goes on.
    pub ends: Option<ZeroDynamicsEnd>,
}

/// What happens in the experiment of a setup.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelFreeAnswer {
    /// The run.
    pub run: ModelFreeRun,
    /// How both loops did. Where the linear loop is not stable, or the level was not at rest, they have no figures of a response.
    pub figures: [TrackingMetrics; 2],
    /// The same experiment with two PI loops, where one is asked for.
    pub comparison: Option<(Trajectory, [TrackingMetrics; 2])>,
    /// Whether the figures of the responses are those of the same experiment without noise, since this one has some.
    pub judged_without_noise: bool,
    /// What the zero dynamics say once both levels are held at their last references; `None` where they never are, while
    /// valves move, and where the linear loop is stable: it does not hold the levels at any price. Loads are not foreseen.
    pub predicted: Option<PredictedLoss>,
}

impl ModelFreeAnswer {
    /// When the first level is lost (s); `None` where none is.
    pub fn lost_at_s(&self) -> Option<f64> {
        self.figures.iter().filter_map(|figures| figures.lost_at_s).reduce(f64::min)
    }
}

/// How near to its reference a level counts as held (a share of the reference), and for how long (s): it must not only pass.
const HELD: f64 = 0.02;
const HELD_FOR_S: f64 = 10.0;

/// Runs the experiment of a setup.
///
/// # Errors
/// [`StudyError`] at `start` when no input holds the levels that it begins with, at `experiment.duration_s` when the run takes too
/// much work.
pub fn run_model_free(setup: &ModelFreeSetup) -> Result<ModelFreeAnswer, StudyError> {
    run_analysed(setup, &analyse_model_free(setup))
}

/// The same for a setup that is analysed already.
///
/// # Errors
/// As [`run_model_free`].
pub fn run_analysed(setup: &ModelFreeSetup, analysis: &ModelFreeAnalysis) -> Result<ModelFreeAnswer, StudyError> {
    let (plant, start) = (setup.plant_at(0.0), setup.start()?);
    let ModelFreeSetup { valves, controller, experiment, .. } = setup;
    let figures_of = |run: &Trajectory, rows: usize, pairing: Pairing| tracking_metrics(run, rows, &plant, pairing);
    let law = |experiment: &Experiment| {
        let run = simulate_model_free(&plant, valves, &start, controller, experiment)
            .map_err(StudyError::at("controller"))?;
        let run = ModelFreeRun { trajectory: whole(run.trajectory)?, ..run };
        let figures = figures_of(&run.trajectory, run.rows_per_sample, controller.pairing);
        Ok::<_, StudyError>((run, figures))
    };
    let pi = |compare: &DecentralisedPi, experiment: &Experiment| {
        let (run, rows) = simulate_with_valves(&plant, valves, &start, compare, experiment);
        let run = whole(run)?;
        let figures = figures_of(&run, rows, compare.pairing);
        Ok::<_, StudyError>((run, figures))
    };
    let (run, figures) = law(experiment)?;
    let mut comparison = setup.compare.as_ref().map(|compare| pi(compare, experiment)).transpose()?;
    let predicted = predicted_loss(setup, &plant, &run.trajectory, analysis);
    let is_noisy = experiment.is_noisy();
    let work = run.trajectory.work + comparison.as_ref().map_or(0, |(run, _)| run.work);
    let mut judged = figures;
    if is_noisy && work > MAX_JUDGED_WORK {
        judged = figures.map(|figures| figures.without_response(NoResponse::TooLongToJudge));
        if let Some((_, figures)) = &mut comparison {
            *figures = figures.map(|figures| figures.without_response(NoResponse::TooLongToJudge));
        }
    } else if is_noisy {
        let noiseless = experiment.without_noise();
        judged = judge(figures, law(&noiseless)?.1);
        if let (Some((_, figures)), Some(compare)) = (&mut comparison, &setup.compare) {
            *figures = judge(*figures, pi(compare, &noiseless)?.1);
        }
    }
    let figures = with_reasons(judged, setup, stability(setup, analysis));
    let comparison = comparison.map(|(run, figures)| {
        (
            run,
            with_reasons(figures, setup, setup.compare.and_then(|compare| stability_of_pi(setup, analysis, &compare))),
        )
    });
    Ok(ModelFreeAnswer { run, figures, comparison, judged_without_noise: is_noisy, predicted })
}

/// The figures of a noisy run with those of the responses from its twin without noise.
fn judge(figures: [TrackingMetrics; 2], twin: [TrackingMetrics; 2]) -> [TrackingMetrics; 2] {
    [0, 1].map(|level| figures[level].judged_by(&twin[level]))
}

/// The figures without those of a response where the loop is not stable, and with a step that comes too late called so.
fn with_reasons(
    figures: [TrackingMetrics; 2],
    setup: &ModelFreeSetup,
    stability: Option<Stability>,
) -> [TrackingMetrics; 2] {
    let of_loop = match stability {
        Some(Stability::Unstable) => Some(NoResponse::UnstableLoop),
        Some(Stability::Marginal) => Some(NoResponse::MarginalLoop),
        Some(Stability::Stable) | None => None,
    };
    [0, 1].map(|level| {
        let mut figures = of_loop.map_or(figures[level], |reason| figures[level].without_response(reason));
        if let (Some(NoResponse::NoStep), Some(time_s)) =
            (figures.no_response, setup.experiment.step_after_end_s(level))
        {
            figures.no_response = Some(NoResponse::StepAfterEnd { time_s });
        }
        figures
    })
}

/// Whether the linear loop of the law is stable where its run ends; `None` where it is not known or valves swing for ever.
fn stability(setup: &ModelFreeSetup, analysis: &ModelFreeAnalysis) -> Option<Stability> {
    let poles = analysis.poles.as_ref()?.as_ref().ok()?;
    comes_to_rest(setup).then_some(poles.stability)
}

/// The same of two PI loops.
fn stability_of_pi(
    setup: &ModelFreeSetup,
    analysis: &ModelFreeAnalysis,
    compare: &DecentralisedPi,
) -> Option<Stability> {
    let plant = setup.plant_at(setup.valves_rest_from_s());
    let jacobian = plant.linearise(analysis.rest.as_ref().ok()?);
    let closed = closed_loop(&jacobian, compare, plant.power_gain).ok()?;
    comes_to_rest(setup).then_some(closed.stability)
}

fn comes_to_rest(setup: &ModelFreeSetup) -> bool {
    let swings = |valve: &ValveSchedule| matches!(valve, ValveSchedule::Sine { .. }) && valve.amplitude() > 0.0;
    !setup.valves.iter().any(swings)
}

fn predicted_loss(
    setup: &ModelFreeSetup,
    plant: &QuadrupleTank,
    run: &Trajectory,
    analysis: &ModelFreeAnalysis,
) -> Option<PredictedLoss> {
    if !setup.valves.iter().all(ValveSchedule::is_constant) {
        return None;
    }
    let references = last_references(setup);
    // With still valves the plant of the analysis is that of the run.
    let poles = analysis.poles.as_ref()?.as_ref().ok()?;
    if poles.stability != Stability::Unstable {
        return None;
    }
    let Experiment { set_point_steps, duration_s, .. } = &setup.experiment;
    let in_time = set_point_steps.iter().filter(|step| step.size != 0.0 && step.time_s <= *duration_s);
    let last_step = in_time.map(|step| step.time_s).fold(0.0, f64::max);
    let is_held = |row: &usize| {
        let near = |i: usize| (run.levels[i][*row] - references[i]).abs() <= HELD * references[i].abs();
        run.time_s[*row] > last_step && near(0) && near(1)
    };
    let mut since = None;
    let row = (0..run.time_s.len()).find(|row| {
        let time = run.time_s[*row];
        since = is_held(row).then(|| since.unwrap_or(time));
        since.is_some_and(|since| time - since >= HELD_FOR_S)
    })?;
    let upper = [run.levels[2][row], run.levels[3][row]];
    let from_s = run.time_s[row];
    let ends = ZeroDynamics::new(plant, references).ends(upper, LONGEST_PREDICTION_S);
    Some(PredictedLoss { from_s, ends })
}

/// How far ahead a loss is predicted (s).
const LONGEST_PREDICTION_S: f64 = 10_000.0;

//! How the loops answered each step of their references.

use serde::Serialize;

use super::experiment::Experiment;
use super::response::{NoResponse, Response, Settling, late_steps};
use super::trajectory::Trajectory;

/// A step of a reference, and the response of its loop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ReferenceStepResponse {
    /// Index of the loop (and lower tank), 0 or 1.
    pub level: usize,
    /// When the reference steps (s): at the sample that it acts at, or as it is given where that is after the end of the run.
    pub time_s: f64,
    /// The reference before the step (m).
    pub from: f64,
    /// The reference after it (m).
    pub to: f64,
    /// The figures of the answer.
    #[serde(flatten)]
    pub figures: StepFigures,
}

/// How a level answered a step of its reference, within one window for all figures.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct StepFigures {
    /// How long the response is looked at (s): until anything else is done to the plant, or to the end; `None` where the run does not
    /// come to the step.
    pub window_s: Option<f64>,
    /// Why the figures are not those of an answer to this step alone; `None` where they are. A level that was not at rest has
    /// figures that count from the step itself, and any other reason leaves none.
    pub no_response: Option<NoResponse>,
    /// From 10 % to 90 % of the step (s); `None` also when 90 % is never reached.
    pub rise_time_s: Option<f64>,
    /// Into the 2 % band of the step.
    pub settling_2_percent: Option<Settling>,
    /// Into the 5 % band of the step.
    pub settling_5_percent: Option<Settling>,
    /// Furthest beyond the new reference, as a fraction of the step; 0 for none.
    pub overshoot: Option<f64>,
    /// Furthest in the wrong direction, as a fraction of the step; 0 for none.
    pub undershoot: Option<f64>,
    /// Σ |r − h| Δt within the window (m s).
    pub window_iae: Option<f64>,
    /// Furthest that the *other* level moves within the window from where it was at the step (m); 0 without a window.
    pub other_peak: f64,
}

/// The answers to all steps of the references, by time and then by loop, in a run with the given sampling time (s).
///
/// The window of each ends where anything else is done to the plant, be it a step of either reference or a load, else at the end of
/// the run. Steps of one reference that act at the same sample are one, and those that cancel are none. Steps that come at the end of the
/// run or after it stand last, without figures.
pub fn step_answers(
    trajectory: &Trajectory,
    experiment: &Experiment,
    sampling_time_s: f64,
) -> Vec<ReferenceStepResponse> {
    let of_level = |level: usize| {
        let mut reference = trajectory.references[level].first().copied().unwrap_or_default();
        let mut answers = Vec::new();
        for response in Response::all(trajectory, experiment, sampling_time_s, level) {
            let answer = ReferenceStepResponse::of(&response, level);
            reference = answer.to;
            answers.push(answer);
        }
        for (time_s, size) in late_steps(trajectory, experiment, sampling_time_s, level) {
            let figures = StepFigures::none(NoResponse::StepAfterEnd { time_s });
            answers.push(ReferenceStepResponse { level, time_s, from: reference, to: reference + size, figures });
            reference += size;
        }
        answers
    };
    let mut answers: Vec<ReferenceStepResponse> = [0, 1].into_iter().flat_map(of_level).collect();
    // A stable sort keeps loop 1 before loop 2.
    answers.sort_by(|one, other| one.time_s.total_cmp(&other.time_s));
    answers
}

impl ReferenceStepResponse {
    fn of(response: &Response<'_>, level: usize) -> Self {
        Self {
            level,
            time_s: response.step_time(),
            from: response.before(),
            to: response.after(),
            figures: StepFigures::of(response),
        }
    }

    /// The same without figures, for a reason that holds for any step of the run. It goes before that of a level which was not at
    /// rest or came to the rim, being the cause of that.
    #[must_use]
    pub fn without_response(self, reason: NoResponse) -> Self {
        let own =
            self.figures.no_response.filter(|own| !matches!(own, NoResponse::NotAtRest { .. } | NoResponse::TankFull));
        let StepFigures { window_s, other_peak, .. } = self.figures;
        let figures = StepFigures { window_s, other_peak, ..StepFigures::none(own.unwrap_or(reason)) };
        Self { figures, ..self }
    }
}

impl StepFigures {
    fn of(response: &Response<'_>) -> Self {
        let no_response = response.refusal();
        // Figures of a level that was not at rest are computed too; the reason is reported with them.
        let is_counted = no_response.is_none_or(|reason| matches!(reason, NoResponse::NotAtRest { .. }));
        let counted = Some(response).filter(|_| is_counted);
        Self {
            window_s: Some(response.duration()),
            no_response,
            rise_time_s: counted.and_then(Response::rise_time),
            settling_2_percent: counted.map(|response| response.settling(0.02)),
            settling_5_percent: counted.map(|response| response.settling(0.05)),
            overshoot: counted.map(Response::overshoot),
            undershoot: counted.map(Response::undershoot),
            window_iae: counted.map(Response::iae),
            other_peak: response.other_peak(),
        }
    }

    /// No figures, for a reason.
    pub(super) const fn none(reason: NoResponse) -> Self {
        Self {
            window_s: None,
            no_response: Some(reason),
            rise_time_s: None,
            settling_2_percent: None,
            settling_5_percent: None,
            overshoot: None,
            undershoot: None,
            window_iae: None,
            other_peak: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::sim::{Load, LoadStep, SetPointStep};

    /// One row each second for 100 s, of levels that follow their references at once but for a lag of 1 s, and rest at 0.1 m.
    fn run(experiment: &Experiment) -> Trajectory {
        let mut trajectory = Trajectory::with_rows(101);
        for (row, k) in (0..=100).enumerate() {
            let t = f64::from(k);
            let references = [0, 1].map(|level| experiment.reference_after(level, 0.1, t));
            let levels = [0, 1].map(|level| experiment.reference_after(level, 0.1, t - 1.0));
            trajectory.set(row, t, [levels[0], levels[1], 0.0, 0.0], references, [5.0; 2], [5.0; 2]);
        }
        trajectory
    }

    fn experiment(steps: &[(usize, f64, f64)], load_steps: Vec<LoadStep>) -> Experiment {
        Experiment {
            set_point_steps: steps.iter().map(|&(level, time_s, size)| SetPointStep { level, time_s, size }).collect(),
            load_steps,
            ..Experiment::at_rest(100.0)
        }
    }

    fn answers(steps: &[(usize, f64, f64)], load_steps: Vec<LoadStep>) -> Vec<ReferenceStepResponse> {
        let experiment = experiment(steps, load_steps);
        step_answers(&run(&experiment), &experiment, 1.0)
    }

    #[test]
    fn each_step_has_its_own_window_and_levels() {
        let load = LoadStep { time_s: 85.5, load: Load::PumpFlow { pump: 0, flow: 1e-6 } };
        let found = answers(&[(0, 70.0, -0.02), (0, 10.0, 0.01), (1, 40.0, 0.03), (1, 10.0, 0.02)], vec![load]);
        let expected = [
            (0, 10.0, 0.10, 0.11, 30.0),
            (1, 10.0, 0.10, 0.12, 30.0),
            (1, 40.0, 0.12, 0.15, 30.0),
            (0, 70.0, 0.11, 0.09, 15.5),
        ];
        assert_eq!(found.len(), expected.len());
        for (answer, (level, time_s, from, to, window_s)) in found.iter().zip(expected) {
            assert_eq!((answer.level, answer.time_s, answer.figures.window_s), (level, time_s, Some(window_s)));
            assert_relative_eq!(answer.from, from, max_relative = 1e-12);
            assert_relative_eq!(answer.to, to, max_relative = 1e-12);
            assert_eq!((answer.figures.no_response, answer.figures.undershoot), (None, Some(0.0)));
            assert_relative_eq!(answer.figures.rise_time_s.unwrap(), 0.8, max_relative = 1e-9);
            let Some(Settling::After { time_s }) = answer.figures.settling_2_percent else { panic!("{answer:?}") };
            assert_relative_eq!(time_s, 0.98, max_relative = 1e-9);
            assert_relative_eq!(answer.figures.window_iae.unwrap(), (to - from).abs(), max_relative = 1e-9);
        }
        assert_eq!(found[3].figures.other_peak, 0.0);
        assert_relative_eq!(found[0].figures.other_peak, 0.02, max_relative = 1e-9);
    }

    #[test]
    fn a_step_that_finds_its_level_moving_says_so() {
        // Level 1 has not answered its first step when the next one comes.
        let found = answers(&[(0, 10.0, 0.01), (0, 11.0, 0.01), (0, 50.0, 1e-10)], vec![]);
        assert_eq!((found[0].figures.no_response, found[0].figures.window_s), (None, Some(1.0)));
        assert_eq!(found[1].figures.no_response, None, "it is there in the row of the step");
        let found = answers(&[(1, 10.0, 0.01), (0, 10.5, 0.01), (1, 10.5, 0.01)], vec![]);
        assert_eq!(found.len(), 3);
        let found = answers(&[(0, 50.0, 1e-10)], vec![]);
        assert_eq!(found[0].figures.no_response, Some(NoResponse::StepTooSmall { size: 1e-10 }));
        assert_eq!((found[0].figures.overshoot, found[0].figures.window_iae), (None, None));
    }

    #[test]
    fn steps_after_the_end_stand_last_without_figures() {
        let found =
            answers(&[(0, 300.0, 0.01), (0, 300.0, 0.02), (1, 99.5, 0.05), (0, 10.0, 0.01), (1, 400.0, 0.0)], vec![]);
        let times: Vec<_> = found.iter().map(|answer| (answer.level, answer.time_s)).collect();
        assert_eq!(times, [(0, 10.0), (1, 99.5), (0, 300.0)]);
        assert_relative_eq!(found[2].from, 0.11, max_relative = 1e-12);
        assert_relative_eq!(found[2].to, 0.14, max_relative = 1e-12);
        for late in &found[1..] {
            assert_eq!(late.figures.no_response, Some(NoResponse::StepAfterEnd { time_s: late.time_s }));
            assert_eq!(
                (late.figures.window_s, late.figures.rise_time_s, late.figures.settling_2_percent),
                (None, None, None)
            );
        }
    }

    #[test]
    fn steps_that_cancel_have_no_answer() {
        assert_eq!(answers(&[(0, 10.0, 0.01), (0, 9.5, -0.01), (1, 300.0, 0.01), (1, 300.0, -0.01)], vec![]), []);
    }

    #[test]
    fn a_reason_of_the_run_goes_before_that_of_a_level_under_way() {
        let found = answers(&[(0, 10.0, 0.01), (0, 200.0, 0.01)], vec![]);
        let told =
            |answer: ReferenceStepResponse| answer.without_response(NoResponse::UnstableLoop).figures.no_response;
        assert_eq!(told(found[0]), Some(NoResponse::UnstableLoop));
        assert_eq!(told(found[1]), Some(NoResponse::StepAfterEnd { time_s: 200.0 }));
        let mut moving = found[0];
        moving.figures.no_response = Some(NoResponse::NotAtRest { distance: 0.01 });
        assert_eq!(told(moving), Some(NoResponse::UnstableLoop));
    }
}

use crate::scenario::ScenarioError;

use super::{
    ModelFreeAnswer, ModelFreeSetup, ModelFreeVerdict, PublishedExperiment, PublishedValves, analyse_model_free,
    published_model_free, run_model_free,
};

/// A run that is long enough for case b to show itself (s).
pub const LONG_RUN_S: f64 = 2000.0;

/// What Junqueira, Neves and Angelico say of their law, in the order of their text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// Case a follows well, its pumps at their limit at times.
    CaseA,
    /// Case b does as desired, slightly inferior to case a.
    CaseB,
    /// The same law serves wherever the zero lies.
    AnyZero,
    /// Case c is satisfactory, with a small oscillation.
    CaseC,
    /// α̂ = 0.1 cm/(s V) is chosen without a word on how small it may be.
    ModelGain,
}

/// How much of a claim the computation confirms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// All of it.
    Reproduced,
    /// Only for equal set-points.
    EqualSetPoints,
    /// Only for equal set-points, and only for a limited time.
    LimitedTime,
    /// Nothing.
    Refuted,
}

/// A claim with what was computed about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckedClaim {
    /// Which one.
    pub claim: Claim,
    /// What is left of it.
    pub standing: Standing,
    /// The figures behind it, see [`check_claims`].
    pub figures: [f64; 4],
    /// The case that shows it.
    pub case: (PublishedValves, PublishedExperiment),
    /// How long it has to run to show it (s).
    pub duration_s: f64,
}

impl CheckedClaim {
    /// The setup that shows it.
    pub fn setup(&self) -> ModelFreeSetup {
        let mut setup = published_model_free(self.case.0, self.case.1);
        setup.experiment.duration_s = self.duration_s;
        setup
    }
}

/// Computes every claim anew. The figures are
/// - case a, from empty tanks: IAE (m s), overshoot (share), time at a limit (share), settling time (s) of level 1;
/// - case b: IAE of level 1 over 320 s in cases b and a (m s), when an upper tank runs over or a pump stops, when a level is
///   lost (s);
/// - any zero: how long after the step one level of case b is lost (s), λ11, Niederlinski index, right-most pole of the loop in
///   continuous time without estimator (1/s);
/// - case c: largest error late in the run for equal and for unequal set-points (m);
/// - model gain: smallest α̂ by the poles of the whole loop and of tank 1 alone (m/(s V)).
///
/// # Errors
/// What [`run_model_free`] finds, which no published case has.
pub fn check_claims() -> Result<Vec<CheckedClaim>, ScenarioError> {
    use PublishedExperiment::{S1, S2, S3};
    use PublishedValves::{A, B, C};
    let run = |valves, experiment, duration_s: Option<f64>| {
        let mut setup = published_model_free(valves, experiment);
        setup.experiment.duration_s = duration_s.unwrap_or(setup.experiment.duration_s);
        let answer = run_model_free(&setup)?;
        let verdict = ModelFreeVerdict::of(&setup, &answer, &analyse_model_free(&setup));
        Ok::<_, ScenarioError>((setup.experiment.duration_s, answer, verdict))
    };
    let (long_s, short_s) = (LONG_RUN_S, 320.0);
    let (duration_s, a, a_verdict) = run(A, S1, None)?;
    let [first, second] = a.figures;
    let settles = matches!(a_verdict, ModelFreeVerdict::Settled(_));
    let saturates = first.saturated_s > 0.0 && second.saturated_s > 0.0;
    let case_a = CheckedClaim {
        claim: Claim::CaseA,
        standing: if settles && saturates { Standing::Reproduced } else { Standing::Refuted },
        figures: [
            first.iae,
            first.overshoot.unwrap_or(0.0),
            first.saturated_s / duration_s,
            first.settling_s.unwrap_or(f64::INFINITY),
        ],
        case: (A, S1),
        duration_s,
    };
    let (_, b, b_verdict) = run(B, S2, None)?;
    let (_, b_long, b_long_verdict) = run(B, S2, Some(long_s))?;
    let lost_s = lost_at(&b_long);
    let ends_s = match b_verdict {
        ModelFreeVerdict::Leaving { ends_s, .. } => ends_s,
        _ => f64::INFINITY,
    };
    let case_b = CheckedClaim {
        claim: Claim::CaseB,
        standing: match (lost_at(&b), b_long_verdict) {
            (None, ModelFreeVerdict::Settled(_)) => Standing::Reproduced,
            (None, _) => Standing::LimitedTime,
            _ => Standing::Refuted,
        },
        figures: [b.figures[0].iae, run(A, S2, None)?.1.figures[0].iae, ends_s, lost_s.unwrap_or(f64::INFINITY)],
        case: (B, S2),
        duration_s: long_s,
    };
    let (_, one, _) = run(B, S3, None)?;
    let theory = analyse_model_free(&published_model_free(B, S3));
    let moment = theory.moment.as_ref();
    let poles = theory.continuous_poles.and_then(Result::ok).unwrap_or_default();
    let step_s = published_model_free(B, S3).experiment.set_point_steps.first().map_or(0.0, |step| step.time_s);
    let any_zero = CheckedClaim {
        claim: Claim::AnyZero,
        standing: if lost_at(&one).is_some() { Standing::Refuted } else { Standing::Reproduced },
        figures: [
            lost_at(&one).unwrap_or(f64::INFINITY) - step_s,
            moment.and_then(|m| m.rga_11).unwrap_or(f64::NAN),
            moment.and_then(|m| m.niederlinski[0]).unwrap_or(f64::NAN),
            poles.iter().map(|pole| pole.re).fold(f64::NEG_INFINITY, f64::max),
        ],
        case: (B, S3),
        duration_s: short_s,
    };
    let (duration_s, _, equal) = run(C, S2, None)?;
    let (_, _, unequal) = run(C, S3, None)?;
    let error = |verdict: ModelFreeVerdict| match verdict {
        ModelFreeVerdict::Rippling([one, two]) | ModelFreeVerdict::Unsettled([one, two]) => one.max(two),
        _ => f64::NAN,
    };
    let follows = |verdict| matches!(verdict, ModelFreeVerdict::Rippling(_));
    let case_c = CheckedClaim {
        claim: Claim::CaseC,
        standing: match (follows(equal), follows(unequal)) {
            (true, true) => Standing::Reproduced,
            (true, false) => Standing::EqualSetPoints,
            _ => Standing::Refuted,
        },
        figures: [error(equal), error(unequal), 0.0, 0.0],
        case: (C, S2),
        duration_s,
    };
    let mut slow = published_model_free(A, S2);
    slow.experiment.set_point_steps.clear();
    let theory = analyse_model_free(&slow);
    let alone = theory.smallest_of_integrators.map_or(f64::NAN, |[first, _]| first);
    let smallest = theory.smallest_model_gain.unwrap_or(f64::NAN);
    let model_gain = CheckedClaim {
        claim: Claim::ModelGain,
        standing: if slow.controller.loops[0].model_gain > smallest { Standing::Reproduced } else { Standing::Refuted },
        figures: [smallest, alone, 0.0, 0.0],
        case: (A, S2),
        duration_s: short_s,
    };
    Ok(vec![case_a, case_b, any_zero, case_c, model_gain])
}

/// When the first level was lost (s).
fn lost_at(answer: &ModelFreeAnswer) -> Option<f64> {
    answer.figures.iter().filter_map(|figures| figures.lost_at_s).reduce(f64::min)
}

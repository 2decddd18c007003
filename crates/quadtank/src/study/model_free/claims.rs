use crate::study::StudyError;

use super::{ModelFreeAnswer, ModelFreeSetup, ModelFreeVerdict, analyse_model_free, run_model_free};

use crate::literature::junqueira::{PublishedExperiment, PublishedValves};

use PublishedExperiment::{S1, S2, S3};
use PublishedValves::{A, B, C};

/// A run that is long enough for case b to show itself (s).
pub const LONG_RUN_S: f64 = 2000.0;

/// A model gain that is too small, as a share of the smallest.
const TOO_SMALL: f64 = 0.95;

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
    /// The setup that shows it; for the model gain with one that is too small.
    pub fn setup(&self) -> ModelFreeSetup {
        let mut setup = ModelFreeSetup::published(self.case.0, self.case.1);
        setup.experiment.duration_s = self.duration_s;
        if self.claim == Claim::ModelGain {
            setup.controller.loops.iter_mut().for_each(|settings| settings.model_gain = TOO_SMALL * self.figures[0]);
        }
        setup
    }
}

/// Computes every claim anew. The figures are
/// - case a, from empty tanks: IAE (m s), overshoot (share), time at a limit (share), settling time (s) of level 1;
/// - case b: IAE of level 1 over 320 s in cases b and a (m s), when an upper tank runs over or a pump stops, when a level is
///   lost (s);
/// - any zero: how long after the step one level of case b is lost (s), λ11, Niederlinski index, right-most pole of the loop in
///   continuous time without estimator (1/s);
/// - case c: largest error late in the run for equal set-points, by how much further apart the upper tanks are in the last
///   quarter of a long run than in the one before (m), and the largest error late in that for unequal ones (m);
/// - model gain: smallest α̂ by the poles of the whole loop and of tank 1 alone (m/(s V)).
///
/// # Errors
/// What [`run_model_free`] finds, which no published case has.
pub fn check_claims() -> Result<Vec<CheckedClaim>, StudyError> {
    Ok(vec![case_a()?, case_b()?, any_zero()?, case_c()?, model_gain()])
}

/// What a published case shows in a time (s); in its own where none is given.
fn run(
    (valves, experiment): (PublishedValves, PublishedExperiment),
    duration_s: Option<f64>,
) -> Result<(ModelFreeAnswer, ModelFreeVerdict), StudyError> {
    let mut setup = ModelFreeSetup::published(valves, experiment);
    setup.experiment.duration_s = duration_s.unwrap_or(setup.experiment.duration_s);
    let answer = run_model_free(&setup)?;
    let verdict = ModelFreeVerdict::of(&setup, &answer, &analyse_model_free(&setup));
    Ok((answer, verdict))
}

fn case_a() -> Result<CheckedClaim, StudyError> {
    let case = (A, S1);
    let (answer, verdict) = run(case, None)?;
    let [first, second] = answer.figures;
    let settles = matches!(verdict, ModelFreeVerdict::Settled(_));
    let saturates = first.saturated_s > 0.0 && second.saturated_s > 0.0;
    let duration_s = ModelFreeSetup::published(case.0, case.1).experiment.duration_s;
    Ok(CheckedClaim {
        claim: Claim::CaseA,
        standing: if settles && saturates { Standing::Reproduced } else { Standing::Refuted },
        figures: [
            first.iae,
            first.overshoot.unwrap_or(0.0),
            first.saturated_s / duration_s,
            first.settling_s.unwrap_or(f64::INFINITY),
        ],
        case,
        duration_s,
    })
}

fn case_b() -> Result<CheckedClaim, StudyError> {
    let case = (B, S2);
    let (answer, verdict) = run(case, None)?;
    let (long, long_verdict) = run(case, Some(LONG_RUN_S))?;
    let ends_s = match verdict {
        ModelFreeVerdict::Leaving { ends_s, .. } => ends_s,
        _ => f64::INFINITY,
    };
    let of_a = run((A, S2), None)?.0.figures[0].iae;
    Ok(CheckedClaim {
        claim: Claim::CaseB,
        standing: match (answer.lost_at_s(), long_verdict) {
            (None, ModelFreeVerdict::Settled(_)) => Standing::Reproduced,
            (None, _) => Standing::LimitedTime,
            _ => Standing::Refuted,
        },
        figures: [answer.figures[0].iae, of_a, ends_s, long.lost_at_s().unwrap_or(f64::INFINITY)],
        case,
        duration_s: LONG_RUN_S,
    })
}

fn any_zero() -> Result<CheckedClaim, StudyError> {
    let case = (B, S3);
    let lost_s = run(case, None)?.0.lost_at_s();
    let setup = ModelFreeSetup::published(case.0, case.1);
    let theory = analyse_model_free(&setup);
    let plant = theory.linear.as_ref().and_then(|plant| plant.as_ref().ok());
    let poles = theory.continuous_poles.and_then(Result::ok).unwrap_or_default();
    let step_s = setup.experiment.set_point_steps.first().map_or(0.0, |step| step.time_s);
    Ok(CheckedClaim {
        claim: Claim::AnyZero,
        standing: if lost_s.is_some() { Standing::Refuted } else { Standing::Reproduced },
        figures: [
            lost_s.unwrap_or(f64::INFINITY) - step_s,
            plant.and_then(|plant| plant.rga_11.ok()).unwrap_or(f64::NAN),
            plant.and_then(|plant| plant.niederlinski[0]).unwrap_or(f64::NAN),
            poles.iter().map(|pole| pole.re).fold(f64::NEG_INFINITY, f64::max),
        ],
        case,
        duration_s: setup.experiment.duration_s,
    })
}

fn case_c() -> Result<CheckedClaim, StudyError> {
    let ripple = |verdict| match verdict {
        ModelFreeVerdict::Rippling { error: [one, two], apart } => Some((one.max(two), apart)),
        _ => None,
    };
    let equal = ripple(run((C, S2), None)?.1);
    let equal_long = ripple(run((C, S2), Some(LONG_RUN_S))?.1);
    let unequal = run((C, S3), Some(LONG_RUN_S))?.1;
    let apart = equal_long.and_then(|(_, apart)| apart);
    Ok(CheckedClaim {
        claim: Claim::CaseC,
        standing: match (equal, equal_long, apart, ripple(unequal)) {
            (None, ..) => Standing::Refuted,
            (_, Some(_), None, Some(_)) => Standing::Reproduced,
            (_, Some(_), None, None) => Standing::EqualSetPoints,
            _ => Standing::LimitedTime,
        },
        figures: [
            equal.map_or(f64::NAN, |(error, _)| error),
            apart.unwrap_or(0.0),
            match unequal {
                ModelFreeVerdict::Unsettled { error: [one, two], .. } => one.max(two),
                _ => f64::NAN,
            },
            0.0,
        ],
        case: (C, S2),
        duration_s: LONG_RUN_S,
    })
}

fn model_gain() -> CheckedClaim {
    let case = (A, S2);
    let setup = ModelFreeSetup::published(case.0, case.1);
    // At the levels that the run begins with.
    let mut before = setup.clone();
    before.experiment.set_point_steps.clear();
    let theory = analyse_model_free(&before);
    let smallest = theory.smallest_model_gain.unwrap_or(f64::NAN);
    let alone = theory.smallest_of_integrators.map_or(f64::NAN, |[first, _]| first);
    CheckedClaim {
        claim: Claim::ModelGain,
        standing: if setup.controller.loops[0].model_gain > smallest {
            Standing::Reproduced
        } else {
            Standing::Refuted
        },
        figures: [smallest, alone, 0.0, 0.0],
        case,
        duration_s: setup.experiment.duration_s,
    }
}

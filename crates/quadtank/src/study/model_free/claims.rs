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
    /// What is left of it.
    pub standing: Standing,
    /// The figures behind it.
    pub figures: ClaimFigures,
    /// The case that shows it.
    pub case: (PublishedValves, PublishedExperiment),
    /// How long it has to run to show it (s).
    pub duration_s: f64,
}

/// What was computed about a claim. Figures of a run are infinite for what does not happen in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClaimFigures {
    /// Of level 1 in case a, from empty tanks.
    CaseA {
        /// IAE (m s).
        iae: f64,
        /// Overshoot, as a share of the step.
        overshoot: f64,
        /// Time with a pump at a limit, as a share of the run.
        share_at_limit: f64,
        /// Settling time (s).
        settling_s: f64,
    },
    /// Of level 1 in case b.
    CaseB {
        /// IAE over 320 s (m s).
        iae: f64,
        /// The same in case a (m s).
        iae_of_case_a: f64,
        /// When an upper tank overflows or a pump stops (s).
        ends_s: f64,
        /// When a level is lost (s).
        lost_s: f64,
    },
    /// Of a step of one level in case b.
    AnyZero {
        /// How long after the step the level is lost (s).
        lost_after_s: f64,
        /// λ11.
        rga_11: f64,
        /// Niederlinski index.
        niederlinski: f64,
        /// Right-most pole of the loop in continuous time without estimator (1/s).
        rightmost_pole: f64,
    },
    /// Of case c.
    CaseC {
        /// Largest error late in the run for equal set-points (m).
        error: f64,
        /// By how much the upper tanks are further apart in the last quarter of a long run than in the one before (m).
        apart: f64,
        /// Largest error late in a long run for unequal set-points (m).
        error_unequal: f64,
    },
    /// Of the model gain α̂.
    ModelGain {
        /// Smallest α̂ by the poles of the whole loop (m/(s V)).
        smallest: f64,
        /// Smallest α̂ by those of tank 1 alone (m/(s V)).
        smallest_of_tank_1: f64,
    },
}

impl CheckedClaim {
    /// Which claim it is.
    pub const fn claim(&self) -> Claim {
        match self.figures {
            ClaimFigures::CaseA { .. } => Claim::CaseA,
            ClaimFigures::CaseB { .. } => Claim::CaseB,
            ClaimFigures::AnyZero { .. } => Claim::AnyZero,
            ClaimFigures::CaseC { .. } => Claim::CaseC,
            ClaimFigures::ModelGain { .. } => Claim::ModelGain,
        }
    }

    /// The setup that shows it; for the model gain with one that is too small.
    pub fn setup(&self) -> ModelFreeSetup {
        let mut setup = ModelFreeSetup::published(self.case.0, self.case.1);
        setup.experiment.duration_s = self.duration_s;
        if let ClaimFigures::ModelGain { smallest, .. } = self.figures {
            setup.controller.loops.iter_mut().for_each(|settings| settings.model_gain = TOO_SMALL * smallest);
        }
        setup
    }
}

/// Computes every claim anew.
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
        standing: if settles && saturates { Standing::Reproduced } else { Standing::Refuted },
        figures: ClaimFigures::CaseA {
            iae: first.iae,
            overshoot: first.overshoot.unwrap_or(0.0),
            share_at_limit: first.saturated_s / duration_s,
            settling_s: first.settling_s.unwrap_or(f64::INFINITY),
        },
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
        standing: match (answer.lost_at_s(), long_verdict) {
            (None, ModelFreeVerdict::Settled(_)) => Standing::Reproduced,
            (None, _) => Standing::LimitedTime,
            _ => Standing::Refuted,
        },
        figures: ClaimFigures::CaseB {
            iae: answer.figures[0].iae,
            iae_of_case_a: of_a,
            ends_s,
            lost_s: long.lost_at_s().unwrap_or(f64::INFINITY),
        },
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
        standing: if lost_s.is_some() { Standing::Refuted } else { Standing::Reproduced },
        figures: ClaimFigures::AnyZero {
            lost_after_s: lost_s.unwrap_or(f64::INFINITY) - step_s,
            rga_11: plant.and_then(|plant| plant.rga_11.ok()).unwrap_or(f64::NAN),
            niederlinski: plant.and_then(|plant| plant.niederlinski[0]).unwrap_or(f64::NAN),
            rightmost_pole: poles.iter().map(|pole| pole.re).fold(f64::NEG_INFINITY, f64::max),
        },
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
        standing: match (equal, equal_long, apart, ripple(unequal)) {
            (None, ..) => Standing::Refuted,
            (_, Some(_), None, Some(_)) => Standing::Reproduced,
            (_, Some(_), None, None) => Standing::EqualSetPoints,
            _ => Standing::LimitedTime,
        },
        figures: ClaimFigures::CaseC {
            error: equal.map_or(f64::NAN, |(error, _)| error),
            apart: apart.unwrap_or(0.0),
            error_unequal: match unequal {
                ModelFreeVerdict::Unsettled { error: [one, two], .. } => one.max(two),
                _ => f64::NAN,
            },
        },
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
        standing: if setup.controller.loops[0].model_gain > smallest {
            Standing::Reproduced
        } else {
            Standing::Refuted
        },
        figures: ClaimFigures::ModelGain { smallest, smallest_of_tank_1: alone },
        case,
        duration_s: setup.experiment.duration_s,
    }
}

//! What the bench says of each case, computed from the run and from theory.

use quadtank::control::Pairing;
use quadtank::linear::Stability;
use quadtank::literature::PresetId;
use quadtank::literature::junqueira::{PublishedExperiment, PublishedValves};
use quadtank::plant::OperatingPoint;
use quadtank::sim::{TrackingMetrics, ZeroDynamicsEnd};
use quadtank::study::LinearPlant;
use quadtank::study::StudyError;
use quadtank::study::model_free::{
    Claim, LossBy, ModelFreeAnswer, ModelFreeSetup, ModelFreeVerdict, Standing, analyse_model_free, check_claims,
    run_model_free,
};

fn verdict(v: PublishedValves, e: PublishedExperiment, duration_s: f64) -> Result<ModelFreeVerdict, StudyError> {
    let mut setup = ModelFreeSetup::published(v, e);
    setup.experiment.duration_s = duration_s;
    Ok(ModelFreeVerdict::of(&setup, &run_model_free(&setup)?, &analyse_model_free(&setup)))
}

const LONG: f64 = 2000.0;

#[test]
fn case_a_settles_whatever_is_asked_of_it() -> Result<(), StudyError> {
    use PublishedExperiment::{S1, S2, S3};
    // The settling times of the second program, S1 and S2.
    for (experiment, times) in [(S1, [122.0, 121.0]), (S2, [108.0, 107.0])] {
        let seen = verdict(PublishedValves::A, experiment, LONG)?;
        assert_eq!(seen, ModelFreeVerdict::Settled(times.map(Some)), "{experiment:?}");
    }
    // Level 2 is not asked for anything.
    assert!(matches!(verdict(PublishedValves::A, S3, LONG)?, ModelFreeVerdict::Settled([Some(_), None])));
    Ok(())
}

#[test]
fn case_b_looks_settled_while_the_upper_tanks_leave_and_is_lost_when_told() -> Result<(), StudyError> {
    let ModelFreeVerdict::Leaving { ends_s, e_folding_s, .. } =
        verdict(PublishedValves::B, PublishedExperiment::S2, 320.0)?
    else {
        panic!("the drift is not seen");
    };
    // The zero at 15 cm: T3 T4 s² + (T3 + T4) s + 1 − 2.25 = 0 with T3 = T4 = 54.38 s √1.5, so T/(1.5 − 1).
    assert!((e_folding_s.unwrap() - 2.0 * 54.38 * 1.5_f64.sqrt()).abs() < 0.05, "{e_folding_s:?}");
    let seen = verdict(PublishedValves::B, PublishedExperiment::S2, LONG)?;
    let ModelFreeVerdict::Lost {
        at_s,
        by: LossBy::Overflow { tank: 2, time_s },
        predicted: Some((by, predicted_s)),
        ..
    } = seen
    else {
        panic!("{seen:?}");
    };
    assert!((time_s - ends_s).abs() < 5.0 && (time_s - predicted_s).abs() < 5.0 && at_s > time_s);
    assert!(matches!(by, ZeroDynamicsEnd::Overflow { tank: 2, .. }), "{by:?}");
    Ok(())
}

#[test]
fn a_step_of_one_level_of_case_b_is_lost_at_the_limit_of_a_pump() -> Result<(), StudyError> {
    let seen = verdict(PublishedValves::B, PublishedExperiment::S3, 320.0)?;
    let ModelFreeVerdict::Lost { level: 0, at_s, by: LossBy::Pump(0), .. } = seen else { panic!("{seen:?}") };
    // The source: under two minutes after the step at 20 s.
    assert!(at_s - 20.0 < 120.0, "{at_s}");
    Ok(())
}

#[test]
fn case_c_ripples_for_equal_set_points_and_cannot_hold_others() -> Result<(), StudyError> {
    let equal = verdict(PublishedValves::C, PublishedExperiment::S2, 320.0)?;
    // The mean of its zeros is at the origin: the swings push the upper tanks apart, a little more in each.
    let ModelFreeVerdict::Rippling { error, apart: Some(apart) } = equal else { panic!("{equal:?}") };
    // The source: about 0.1 cm.
    assert!(error.iter().all(|error| (0.05e-2..0.15e-2).contains(error)), "{error:?}");
    let later = verdict(PublishedValves::C, PublishedExperiment::S2, LONG)?;
    let ModelFreeVerdict::Rippling { apart: Some(further), .. } = later else { panic!("{later:?}") };
    assert!(further > 5.0 * apart, "{apart} {further}");
    let other = verdict(PublishedValves::C, PublishedExperiment::S3, 320.0)?;
    assert!(matches!(other, ModelFreeVerdict::Unsettled { .. }), "{other:?}");
    let other = verdict(PublishedValves::C, PublishedExperiment::S3, LONG)?;
    assert!(matches!(other, ModelFreeVerdict::Unsettled { by: LossBy::Overflow { tank: 3, .. }, .. }), "{other:?}");
    Ok(())
}

/// What a plot of the outputs shows: a swing or noise is no loss, and a level that has just come inside has not settled.
#[test]
fn swings_and_noise_are_neither_settled_nor_lost() -> Result<(), StudyError> {
    let with = |change: &dyn Fn(&mut ModelFreeSetup)| {
        let mut setup = ModelFreeSetup::published(PublishedValves::A, PublishedExperiment::S2);
        change(&mut setup);
        Ok::<_, StudyError>((setup.clone(), run_model_free(&setup)?))
    };
    let too_slow = |s: &mut ModelFreeSetup| s.controller = s.controller.with_sampling_time(3.0);
    let noisy = |s: &mut ModelFreeSetup| s.experiment.measurement.noise_std = 0.05;
    let small = |s: &mut ModelFreeSetup| s.controller.loops.iter_mut().for_each(|l| l.model_gain = 1e-5);
    let swapped = |s: &mut ModelFreeSetup| {
        s.valves = ModelFreeSetup::published(PublishedValves::B, PublishedExperiment::S2).valves;
        s.controller.pairing = Pairing::Swapped;
    };
    // Figures of a noisy response are those of its twin without noise; what is seen is the noisy run.
    let settles = |answer: &ModelFreeAnswer| answer.figures.map(|figures| figures.settling_s);
    assert_eq!(settles(&with(&noisy)?.1), settles(&with(&|_| ())?.1));
    for change in [&too_slow as &dyn Fn(&mut ModelFreeSetup), &noisy, &small, &swapped] {
        let (setup, answer) = with(change)?;
        let settled = |f: &TrackingMetrics| f.settling_s.is_some() && !answer.judged_without_noise;
        assert!(answer.figures.iter().all(|f| !settled(f) && f.lost_at_s.is_none()), "{:?}", answer.figures);
        let seen = ModelFreeVerdict::of(&setup, &answer, &analyse_model_free(&setup));
        assert!(matches!(seen, ModelFreeVerdict::Unsettled { .. }), "{seen:?}");
    }
    Ok(())
}

#[test]
fn without_integral_action_case_a_is_stable() {
    let mut setup = ModelFreeSetup::published(PublishedValves::A, PublishedExperiment::S2);
    setup.controller.loops.iter_mut().for_each(|settings| settings.integral = 0.0);
    let poles = analyse_model_free(&setup).poles.unwrap().unwrap();
    assert_eq!(poles.stability, Stability::Stable);
}

#[test]
fn on_the_line_the_zero_is_at_the_origin_and_beside_it_on_its_side() {
    let linear = |valves: [f64; 2]| {
        let plant = PresetId::JunqueiraA.preset().plant.with_valves(valves);
        // In the middle of a run, not at rest.
        let point = OperatingPoint { levels: [0.16, 0.11, 0.07, 0.12], pump_voltage: [7.0, 5.0] };
        LinearPlant::of(&plant.linearise(&point)).unwrap()
    };
    let zero = |valves: [f64; 2]| Some(linear(valves).rightmost_zero()?.value.re);
    for gamma_1 in [0.5, 0.3, 0.85] {
        let on_the_line = [gamma_1, 1.0 - gamma_1];
        assert_eq!(zero(on_the_line), Some(0.0), "γ1 = {gamma_1}");
        assert!(linear(on_the_line).rga_11.is_err(), "γ1 = {gamma_1}");
        let beside = [1e-6, -1e-6].map(|by| zero([gamma_1, 1.0 - gamma_1 + by]).map(f64::signum));
        assert_eq!(beside, [Some(-1.0), Some(1.0)], "γ1 = {gamma_1}");
    }
    assert_eq!(zero([1.0, 1.0]), None);
}

#[test]
fn every_claim_of_the_paper_stands_as_the_documentation_says() -> Result<(), StudyError> {
    let claims = check_claims()?;
    let standing: Vec<(Claim, Standing)> = claims.iter().map(|claim| (claim.claim(), claim.standing)).collect();
    assert_eq!(
        standing,
        [
            (Claim::CaseA, Standing::Reproduced),
            (Claim::CaseB, Standing::LimitedTime),
            (Claim::AnyZero, Standing::Refuted),
            (Claim::CaseC, Standing::LimitedTime),
            (Claim::ModelGain, Standing::Reproduced),
        ]
    );
    // What the claim shows is what it was judged by.
    for claim in claims {
        let setup = claim.setup();
        let seen = ModelFreeVerdict::of(&setup, &run_model_free(&setup)?, &analyse_model_free(&setup));
        let fails = match claim.claim() {
            // It shows what is too small.
            Claim::ModelGain => !matches!(seen, ModelFreeVerdict::Unsettled { .. }),
            _ => matches!(seen, ModelFreeVerdict::Lost { .. } | ModelFreeVerdict::Rippling { apart: Some(_), .. }),
        };
        assert_eq!(fails, claim.standing != Standing::Reproduced, "{:?}: {seen:?}", claim.claim());
    }
    Ok(())
}

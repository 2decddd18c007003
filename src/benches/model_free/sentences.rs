//! What the bench says of a run, in the language of the reader. What is said is decided by the core.

use leptos::prelude::*;

use super::session::{Session, shown};
use crate::errors::{of_plant_error, of_study_error};
use crate::shown::{per_metre, to_shown};
use crate::texts::tr;
use quadtank::control::Pairing;
use quadtank::linear::Stability;
use quadtank::literature::DisplayUnit;
use quadtank::sim::ZeroDynamicsEnd;
use quadtank::study::model_free::{LossBy, ModelFreeVerdict};
use quadtank::study::{StudyError, StudyErrorKind};

/// Shown units in a metre: centimetres, as the source has them.
pub const CM_PER_M: f64 = per_metre(DisplayUnit::Cm);

/// A length (m), or what is proportional to one, with centimetres for metres as the source has it.
pub fn in_cm(metres: f64) -> f64 {
    to_shown(metres, DisplayUnit::Cm)
}

/// What the run shows, and whether all is well.
pub fn of_run(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    let seconds = |time: f64| style.fixed(time, 0);
    let cm = |metres: f64| style.fixed(in_cm(metres), 2);
    let setup = session.throttled.setup.get();
    let answer = session.throttled.answer.get();
    let answer = match answer.as_ref() {
        Ok(answer) => answer,
        Err(error) => {
            let reason = of_study_error(lab, DisplayUnit::Cm, error);
            let begins = matches!(error, StudyError { fault: StudyErrorKind::TooMuchWork { .. }, .. });
            return (false, if begins { reason } else { tr!(lab, free.no_run, reason = reason) });
        }
    };
    let end = |by: ZeroDynamicsEnd, ends_s: f64| match by {
        ZeroDynamicsEnd::Overflow { tank, .. } => {
            tr!(lab, free.end_overflow, tank = tank + 1, time = seconds(ends_s))
        }
        ZeroDynamicsEnd::Pump { pump, .. } => tr!(lab, free.end_pump, pump = pump + 1, time = seconds(ends_s)),
    };
    let cause = |by: LossBy| match by {
        LossBy::Overflow { tank, time_s } => {
            tr!(lab, free.by_overflow, tank = tank + 1, time = seconds(time_s))
        }
        LossBy::Pump(pump) => tr!(lab, free.by_pump, pump = pump + 1),
        LossBy::Other => String::new(),
    };
    let verdict = session.throttled.analysis.with(|analysis| ModelFreeVerdict::of(&setup, answer, analysis));
    let text = match verdict {
        ModelFreeVerdict::Lost { level, at_s, by, predicted } => {
            let lost = tr!(lab, free.is_lost, level = level + 1, time = seconds(at_s));
            let predicted = predicted.map(|(by, ends_s)| tr!(lab, free.foretold, end = end(by, ends_s)));
            lost + &cause(by) + &predicted.unwrap_or_default()
        }
        ModelFreeVerdict::Leaving { ends_s, by, e_folding_s } => {
            let pace = e_folding_s.map(|time| tr!(lab, free.e_folding, time = seconds(time)));
            let (leaving, goes_on) = (tr!(lab, free.is_leaving), tr!(lab, free.goes_on));
            format!("{leaving}{}: {}{goes_on}", pace.unwrap_or_default(), end(by, ends_s))
        }
        ModelFreeVerdict::Rippling { error: [one, two], apart: None } => {
            tr!(lab, free.is_rippling, one = cm(one), two = cm(two))
        }
        ModelFreeVerdict::Rippling { error: [one, two], apart: Some(apart) } => {
            tr!(lab, free.is_drifting, one = cm(one), two = cm(two), apart = cm(apart))
        }
        ModelFreeVerdict::Settled([Some(one), Some(two)]) => {
            tr!(lab, free.is_settled, one = seconds(one), two = seconds(two))
        }
        ModelFreeVerdict::Settled([one, two]) => match one.or(two) {
            Some(time) => {
                let level = if one.is_some() { 1 } else { 2 };
                tr!(lab, free.one_settled, level = level, time = seconds(time))
            }
            None => tr!(lab, free.still),
        },
        ModelFreeVerdict::Unsettled { error: [one, two], by } => {
            tr!(lab, free.is_unsettled, one = cm(one), two = cm(two)) + &cause(by)
        }
    };
    (verdict.is_good(), text)
}

/// What the PI loops are that a run is compared with; nothing where it is not.
pub fn of_comparison(session: Session) -> String {
    let lab = session.lab;
    let Some(pi) = session.throttled.setup.with(|s| s.compare) else { return String::new() };
    let number = |value: f64| lab.number_style().significant(value, 2);
    let pairing = match pi.pairing {
        Pairing::Diagonal => tr!(lab, pi.diagonal),
        Pairing::Swapped => tr!(lab, pi.swapped),
    };
    let settings = &pi.loops[0];
    let (gain, time) = (number(settings.gain), number(settings.integral_time_s));
    tr!(lab, free.pi_settings, pairing = pairing, gain = gain, time = time)
}

/// Zero, relative gain and Niederlinski index of the shown moment.
pub fn of_moment(session: Session) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let Some(shown) = shown(session) else { return String::new() };
    let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |value| style.significant(value, 3));
    let plant = shown.theory.as_ref().ok();
    let [diagonal, swapped] = plant.map_or([None; 2], |plant| plant.niederlinski).map(number);
    let zero = match plant.and_then(|plant| Some(plant.rightmost_zero()?.value.re)) {
        Some(zero) if zero > 0.0 => tr!(lab, free.zero_right, zero = style.significant(zero, 3)),
        Some(zero) if zero < 0.0 => tr!(lab, free.zero_left, zero = style.significant(zero, 3)),
        Some(_) => tr!(lab, free.zero_origin),
        None => tr!(lab, free.no_zero),
    };
    tr!(
        lab,
        free.moment,
        time = style.fixed(shown.time_s, 0),
        sum = style.fixed(shown.plant.valves.iter().sum(), 2),
        zero = zero,
        rga = number(plant.and_then(|plant| plant.rga_11.ok())),
        diagonal = diagonal,
        swapped = swapped
    )
}

/// What linear theory says of the loop at its last references.
pub fn of_loop(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    if session.throttled.setup.with(|s| s.valves.iter().any(|valve| !valve.is_constant())) {
        return (true, tr!(lab, free.loop_moves));
    }
    let looks_good = session.throttled.with_answer(|answer| answer.figures.iter().all(|figures| figures.looks_settled))
        == Some(true);
    session.throttled.analysis.with(|analysis| {
        if let Err(error) = &analysis.rest {
            let reason = of_plant_error(lab, DisplayUnit::Cm, error);
            return (false, tr!(lab, free.not_held, reason = reason));
        }
        let Some(Ok(poles)) = &analysis.poles else { return (true, String::new()) };
        let first = poles.poles_s.first();
        let slowest = first.map_or_else(String::new, |pole| style.significant(pole.re, 3));
        match poles.stability {
            Stability::Unstable => {
                let how = match first {
                    Some(pole) if pole.im != 0.0 => tr!(lab, free.it_swings),
                    _ if looks_good => tr!(lab, free.however_good),
                    _ => String::new(),
                };
                (false, tr!(lab, free.loop_unstable, pole = slowest, how = how))
            }
            Stability::Marginal => (false, tr!(lab, free.loop_marginal)),
            Stability::Stable => {
                let smallest = analysis.smallest_model_gain.map(|gain| style.significant(in_cm(gain), 3));
                let smallest = smallest.unwrap_or_else(|| "–".to_owned());
                (true, tr!(lab, free.loop_stable, pole = slowest, smallest = smallest))
            }
        }
    })
}

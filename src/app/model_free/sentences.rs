//! What the bench says of a run, in the language of the reader. What is said is decided by the core.

use super::session::Session;
use crate::app::errors::of_error;
use crate::app::shown::{to_metres, to_shown};
use crate::app::texts::tr;
use crate::plant::DisplayUnit;
use crate::scenario::model_free::{LossBy, ModelFreeVerdict};
use crate::sim::{HoldingEnds, Stability};

/// A length (m), or what is proportional to one, with centimetres for metres as the source has it.
pub fn in_cm(metres: f64) -> f64 {
    to_shown(metres, DisplayUnit::Cm)
}

/// The way back.
pub fn in_m(centimetres: f64) -> f64 {
    to_metres(centimetres, DisplayUnit::Cm)
}

/// What the run shows, and whether all is well.
pub fn of_run(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    let seconds = |time: f64| style.fixed(time, 0);
    let cm = |metres: f64| style.fixed(in_cm(metres), 2);
    let setup = session.words.setup.get();
    let answer = session.words.answer.get();
    let answer = match answer.as_ref() {
        Ok(answer) => answer,
        Err(error) => {
            let reason = of_error(lab, DisplayUnit::Cm, error);
            return (false, tr!(lab, free.no_run, reason = reason).to_string());
        }
    };
    let verdict = session.words.analysis.with(|analysis| ModelFreeVerdict::of(&setup, answer, analysis));
    let text = match verdict {
        ModelFreeVerdict::Lost { level, at_s, by, foretold_s } => {
            let mut text = tr!(lab, free.is_lost, level = level + 1, time = seconds(at_s)).to_string();
            match by {
                LossBy::Overflow { tank, time_s } => {
                    text += &tr!(lab, free.by_overflow, tank = tank + 1, time = seconds(time_s)).to_string();
                }
                LossBy::Pump(pump) => text += &tr!(lab, free.by_pump, pump = pump + 1).to_string(),
                LossBy::Other => {}
            }
            text + &foretold_s
                .map_or_else(String::new, |time| tr!(lab, free.foretold, time = seconds(time)).to_string())
        }
        ModelFreeVerdict::Leaving { ends_s, by, e_folding_s } => {
            let time = seconds(ends_s);
            let end = match by {
                HoldingEnds::Overflow { tank, .. } => {
                    tr!(lab, free.ends_by_overflow, tank = tank + 1, time = time).to_string()
                }
                HoldingEnds::Pump { pump, .. } => tr!(lab, free.ends_by_pump, pump = pump + 1, time = time).to_string(),
            };
            let pace =
                e_folding_s.map_or_else(String::new, |time| tr!(lab, free.e_folding, time = seconds(time)).to_string());
            format!("{}{pace}{end}", tr!(lab, free.is_leaving))
        }
        ModelFreeVerdict::Rippling([one, two]) => tr!(lab, free.is_rippling, one = cm(one), two = cm(two)).to_string(),
        ModelFreeVerdict::Settled([Some(one), Some(two)]) => {
            tr!(lab, free.is_settled, one = seconds(one), two = seconds(two)).to_string()
        }
        ModelFreeVerdict::Settled([one, two]) => match one.or(two) {
            Some(time) => {
                let level = if one.is_some() { 1 } else { 2 };
                tr!(lab, free.one_settled, level = level, time = seconds(time)).to_string()
            }
            None => tr!(lab, free.still).to_string(),
        },
        ModelFreeVerdict::Unsettled([one, two]) => {
            tr!(lab, free.is_unsettled, one = cm(one), two = cm(two)).to_string()
        }
    };
    (matches!(verdict, ModelFreeVerdict::Settled(_) | ModelFreeVerdict::Rippling(_)), text)
}

/// Zero, relative gain and Niederlinski index of the shown moment.
pub fn of_moment(session: Session) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let Some(shown) = session.shown() else { return String::new() };
    let number = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |value| style.significant(value, 3));
    let theory = &shown.theory;
    let [diagonal, swapped] = theory.niederlinski.map(number);
    let zero = match theory.rightmost_zero() {
        Some(zero) if zero > 0.0 => tr!(lab, free.zero_right, zero = style.significant(zero, 3)).to_string(),
        Some(zero) if zero < 0.0 => tr!(lab, free.zero_left, zero = style.significant(zero, 3)).to_string(),
        Some(_) => tr!(lab, free.zero_origin).to_owned(),
        None => tr!(lab, free.no_zero).to_owned(),
    };
    tr!(
        lab,
        free.moment,
        time = style.fixed(shown.time_s, 0),
        sum = style.fixed(shown.plant.valves.iter().sum(), 2),
        zero = zero,
        rga = number(theory.rga_11),
        diagonal = diagonal,
        swapped = swapped
    )
    .to_string()
}

/// What linear theory says of the loop at its last references; nothing while valves move.
pub fn of_loop(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    if session.words.setup.with(|s| s.valves.iter().any(|valve| !valve.is_constant())) {
        return (true, tr!(lab, free.loop_moves).to_string());
    }
    session.words.analysis.with(|analysis| {
        let Some(Ok(poles)) = &analysis.poles else { return (true, String::new()) };
        let slowest = poles.poles_s.first().map_or_else(String::new, |pole| style.significant(pole.re, 3));
        match poles.stability {
            Stability::Unstable => (false, tr!(lab, free.loop_unstable, pole = slowest).to_string()),
            Stability::Marginal => (false, tr!(lab, free.loop_marginal).to_string()),
            Stability::Stable => {
                let smallest = analysis.smallest_model_gain.map(|gain| style.significant(in_cm(gain), 3));
                let smallest = smallest.unwrap_or_else(|| "–".to_owned());
                (true, tr!(lab, free.loop_stable, pole = slowest, smallest = smallest).to_string())
            }
        }
    })
}

//! What the bench says of a run, in the language of the reader. What is said is decided by the core.

use leptos::prelude::*;
use quadtank::assess::{IndexVerdict, LoopQuality};
use quadtank::linear::LoopStability;
use quadtank::sim::level::{LevelController, NoStepAnswer};
use quadtank::study::level_loop::{Finding, LevelLoopAnswer, Objective};
use quadtank::tuning::{Regulation, RegulationReason};

use super::errors;
use super::session::Session;
use crate::errors::{of_level_error, of_linear};
use crate::lab::Lab;
use crate::texts::tr;

/// A variance of levels (m²) or flows ((m³/s)²) as the source prints it: five digits and a power of ten.
pub fn variance(lab: Lab, value: f64) -> String {
    powered(lab, value, 4)
}

/// The same with three digits, where there is little room.
pub fn short_variance(lab: Lab, value: f64) -> String {
    powered(lab, value, 2)
}

fn powered(lab: Lab, value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$e}").replace('-', "−");
    text.replace('.', &lab.number_style().decimal.to_string())
}

/// What the run shows, and whether all is well.
pub fn of_run(session: Session) -> (bool, String) {
    let lab = session.lab;
    let answer = session.throttled.answer.get();
    let answer = match answer.as_ref() {
        Ok(answer) => answer,
        Err(fault) => return (false, tr!(lab, level.no_run, reason = errors::of_loop(lab, fault))),
    };
    let objective = session.throttled.setup.with(|setup| setup.objective);
    let style = lab.number_style();
    let (level, outflow) = (answer.figures.level, answer.figures.outflow);
    let cm = |metres: f64| style.fixed(100.0 * metres, 2);
    let litres = |flow: f64| style.fixed(1000.0 * flow, 2);
    let (low, high) = (cm(level.minimum), cm(level.maximum));
    let (least, most) = (litres(outflow.minimum), litres(outflow.maximum));
    let is_manual = session.throttled.setup.with(|setup| matches!(setup.controller, LevelController::Manual { .. }));
    let main = match objective {
        _ if is_manual => tr!(lab, level.manual_run, low = low, high = high, least = least, most = most),
        Objective::Tight => tr!(lab, level.tight_run, low = low, high = high, least = least, most = most),
        Objective::Averaging { .. } => {
            tr!(lab, level.averaging_run, low = low, high = high, least = least, most = most)
        }
    };
    let findings: Vec<String> = answer.findings.iter().map(|finding| of_finding(lab, finding)).collect();
    let swings = swings(lab, answer);
    let works = swings.is_none() && !answer.findings.iter().any(Finding::is_failure);
    (works, std::iter::once(main).chain(swings).chain(findings).collect::<Vec<_>>().join(" "))
}

/// That a stable loop is next to unstable, where it is.
fn swings(lab: Lab, answer: &LevelLoopAnswer) -> Option<String> {
    let quality = answer.quality.as_ref().ok()?.as_ref().filter(|quality| quality.is_on_the_edge())?;
    let peak = lab.number_style().significant(quality.sensitivity_peak()?, 2);
    Some(tr!(lab, level.fragile_run, peak = peak))
}

fn of_finding(lab: Lab, finding: &Finding) -> String {
    let style = lab.number_style();
    let cm = |metres: f64| style.fixed(100.0 * metres, 1);
    let seconds = |time: f64| style.fixed(time, 0);
    match *finding {
        Finding::SetPointOutOfReach { level, reason } => {
            tr!(lab, level.out_of_reach, level = cm(level), reason = of_level_error(lab, &reason))
        }
        Finding::TankFull { time_s } => tr!(lab, level.tank_full, time = seconds(time_s)),
        Finding::TankEmpty { time_s } => tr!(lab, level.tank_empty, time = seconds(time_s)),
        Finding::OutputAtLimit { share } => {
            tr!(lab, level.output_at_limit, share = style.significant(100.0 * share, 2))
        }
        Finding::InflowCut { lowest } => {
            tr!(lab, level.inflow_cut, flow = style.significant(1000.0 * lowest, 3))
        }
        Finding::NoGain => tr!(lab, level.no_gain),
        Finding::Unstable => tr!(lab, level.unstable),
        Finding::LeavesBand { levels } => tr!(lab, level.leaves_band, low = cm(levels[0]), high = cm(levels[1])),
        Finding::NothingMoves => tr!(lab, level.nothing_moves),
    }
}

/// What the index of the objective advises, and whether it is the one of that objective that is asked.
pub fn of_index(session: Session) -> (bool, String) {
    let lab = session.lab;
    let objective = session.throttled.setup.with(|setup| setup.objective);
    let of = |answer: &LevelLoopAnswer| {
        if let Err(error) = answer.reference {
            return (false, tr!(lab, level.no_reference, reason = errors::of_run(lab, &error)));
        }
        if let Some(Err(error)) = answer.indices {
            return (false, errors::of_index(lab, error));
        }
        let Some(index) = answer.index_for(objective) else { return (false, String::new()) };
        let value = lab.number_style().fixed(index.quality(), 3);
        let is_tight = objective == Objective::Tight;
        let which = if is_tight { tr!(lab, level.index_level) } else { tr!(lab, level.index_outflow) };
        match index.verdict() {
            IndexVerdict::Keep if is_fragile(answer) => {
                (false, tr!(lab, level.verdict_fragile, which = which, value = value))
            }
            IndexVerdict::Keep => (true, tr!(lab, level.verdict_keep, which = which, value = value)),
            IndexVerdict::Fair => (true, tr!(lab, level.verdict_fair, which = which, value = value)),
            IndexVerdict::Retune => (false, tr!(lab, level.verdict_retune, which = which, value = value)),
            IndexVerdict::WrongIndex => (false, tr!(lab, level.verdict_wrong, which = which, value = value)),
        }
    };
    session.throttled.with_answer(of).unwrap_or_default()
}

/// Whether the linear loop is stable by a hair, or not at all.
fn is_fragile(answer: &LevelLoopAnswer) -> bool {
    answer.quality.as_ref().ok().and_then(Option::as_ref).is_some_and(LoopQuality::is_fragile)
}

/// Margins of the linear loop in one sentence, and whether it is robust.
pub fn of_quality(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    let of = |answer: &LevelLoopAnswer| {
        let quality = match &answer.quality {
            Err(error) => return (false, of_linear(lab, error)),
            Ok(None) => return (true, tr!(lab, level.no_loop)),
            Ok(Some(quality)) => quality,
        };
        match quality.stability {
            LoopStability::Unstable { .. } | LoopStability::AlgebraicLoop { .. } => {
                return (false, tr!(lab, level.unstable));
            }
            LoopStability::Marginal { .. } => return (false, tr!(lab, level.marginal)),
            LoopStability::Stable | LoopStability::NotComputed { .. } => {}
        }
        let (Some(margins), Some(peak)) = (quality.margins, quality.sensitivity_peak()) else {
            return (false, tr!(lab, level.not_computed));
        };
        let gain = margins.gain_up.map_or_else(|| "∞".to_owned(), |gain| style.fixed(gain, 2));
        let phase = margins.phase.map_or_else(|| "–".to_owned(), |phase| style.fixed(phase.to_degrees(), 0));
        let peak_text = style.significant(peak, 3);
        let text = tr!(lab, level.margins, gain = gain, phase = phase, peak = peak_text);
        if quality.is_fragile() { (false, format!("{text} {}", tr!(lab, level.fragile))) } else { (true, text) }
    };
    session.throttled.with_answer(of).unwrap_or_default()
}

/// The answer to the step of the set-point, or why there is none; nothing without such a step.
pub fn of_step(session: Session) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let of = |answer: &LevelLoopAnswer| {
        let step = match answer.step? {
            Ok(step) => step,
            Err(reason) => return Some(tr!(lab, level.step_none, reason = of_no_step(lab, reason))),
        };
        let offset = style.fixed(100.0 * step.offset, 1);
        let (Some(overshoot), Some(rise_s), Some(settling_s)) =
            (step.overshoot, step.rise_time_s, step.settling_time_s)
        else {
            return Some(tr!(lab, level.step_moves, offset = offset));
        };
        Some(tr!(
            lab,
            level.step_answer,
            offset = offset,
            overshoot = style.fixed(100.0 * overshoot, 1),
            rise = style.significant(rise_s, 3),
            settling = style.significant(settling_s, 3)
        ))
    };
    session.throttled.with_answer(of).flatten().unwrap_or_default()
}

fn of_no_step(lab: Lab, reason: NoStepAnswer) -> String {
    match reason {
        NoStepAnswer::ByHand => tr!(lab, level.step_by_hand),
        NoStepAnswer::UnstableLoop => tr!(lab, level.unstable),
        NoStepAnswer::MarginalLoop => tr!(lab, level.marginal),
        NoStepAnswer::DoesNotMove => tr!(lab, level.step_still),
    }
}

/// What kind of process a test shows, with the reason; nothing for a test without a step back.
pub fn of_regulation(lab: Lab, regulation: Regulation) -> String {
    let percent = |share: f64| lab.number_style().significant(100.0 * share, 2);
    let reason = |reason: RegulationReason| match reason {
        RegulationReason::ReturnsToStart { .. } => tr!(lab, level.returns_to_start),
        RegulationReason::StaysAway { share } => tr!(lab, level.stays_away, share = percent(share)),
        RegulationReason::RampsOn { .. } => tr!(lab, level.ramps_on),
        RegulationReason::OffsetFollows { share } => tr!(lab, level.offset_follows, share = percent(share)),
        RegulationReason::NoOffset { .. } => tr!(lab, level.no_offset),
        RegulationReason::StillMoves { share } => tr!(lab, level.still_moves, share = percent(share)),
        RegulationReason::DoesNotMove => tr!(lab, level.does_not_move),
    };
    match regulation {
        Regulation::SelfRegulating(why) => tr!(lab, level.self_regulating, reason = reason(why)),
        Regulation::Integrating(why) => tr!(lab, level.integrating, reason = reason(why)),
        Regulation::Undecided(why) => tr!(lab, level.undecided, reason = reason(why)),
    }
}

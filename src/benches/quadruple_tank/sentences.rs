//! What the cards say in plain words. Each sentence follows from a typed result, never from a number of its own.

use leptos::prelude::*;

use super::session::Session;
use crate::errors::of_plant_error;
use crate::shown::{to_shown, unit_name};
use crate::texts::tr;
use quadtank::linear::{Complex, Stability};
use quadtank::plant::PlantError;
use quadtank::study::quadruple_tank::{ZeroEffect, ZeroSituation};
use quadtank::study::{StudyError, StudyErrorKind};

const SECONDS_PER_MINUTE: f64 = 60.0;

/// The situation of the plant in force.
pub fn situation(session: Session) -> Option<ZeroSituation> {
    session.throttled.setup.with(|setup| session.throttled.with_analysis(|analysis| analysis.zero_situation(setup)))
}

/// Valve fractions of the linear model, and whether they are incremental ones, which depend on the flow.
pub fn valves_of_model(session: Session) -> ([f64; 2], bool) {
    session.throttled.setup.with(|setup| {
        let found = session.throttled.with_analysis(|a| (a.linear_valves(setup), a.flow_fractions.is_some()));
        found.unwrap_or((setup.valves, false))
    })
}

/// The sentence under the drawing, and whether it is a warning.
pub fn of_zero(session: Session) -> (String, bool) {
    let lab = session.lab;
    let style = lab.number_style();
    let (valves, depends_on_flow) = valves_of_model(session);
    let fractions = if depends_on_flow { "γ̃₁ + γ̃₂" } else { "γ₁ + γ₂" };
    let (sum, off) = (valves[0] + valves[1], (valves[0] + valves[1] - 1.0).abs());
    // Enough digits to see on which side of 1.
    let sum = style.fixed(sum, if off < 0.005 { 5 } else { 2 });
    let Some(situation) = situation(session) else {
        return (tr!(lab, process.no_equilibrium), true);
    };
    let text = match &situation {
        ZeroSituation::Left(_) => tr!(lab, process.minimum, fractions = fractions, sum = sum),
        ZeroSituation::Right(z) => {
            let zero = format!("+{}", style.significant(*z, 3));
            tr!(lab, process.right, fractions = fractions, sum = sum, zero = zero)
        }
        ZeroSituation::Origin => tr!(lab, process.origin, fractions = fractions),
        ZeroSituation::NoFinite => tr!(lab, process.few_zeros),
        ZeroSituation::Uncoupled => tr!(lab, process.none_coupled),
        ZeroSituation::Degenerate => {
            let (tank, other) = if valves[0] > valves[1] { (1, 2) } else { (2, 1) };
            tr!(lab, process.degenerate, tank = tank, other = other)
        }
    };
    (text, situation.limits_control())
}

/// How the valves divide flows where that depends on the flow.
pub fn of_flow_fractions(session: Session) -> Option<String> {
    let lab = session.lab;
    let fractions = session.throttled.with_analysis(|a| a.flow_fractions).flatten()?;
    let fixed = |fraction: f64| lab.number_style().fixed(fraction, 3);
    let ([first, second], [first_change, second_change]) =
        (fractions.of_flow.map(fixed), fractions.incremental.map(fixed));
    Some(tr!(
        lab,
        process.flow_fractions,
        first = first,
        second = second,
        first_change = first_change,
        second_change = second_change
    ))
}

/// What walls and pumps do not allow at the operating point, and that it is not at rest.
pub fn of_equilibrium(session: Session) -> Vec<String> {
    session.throttled.analysis.with(|outcome| match outcome.as_ref() {
        Ok(analysis) => {
            let limits = analysis.out_of_range.iter().map(|e| of_limit(session, e));
            limits.chain(analysis.drift.map(|drift| of_drift(session, drift))).collect()
        }
        Err(StudyError { fault: StudyErrorKind::Plant(PlantError::SingularPlant { .. }), .. }) => Vec::new(),
        Err(StudyError { fault: StudyErrorKind::Plant(error), .. }) => vec![of_limit(session, error)],
        Err(_) => Vec::new(),
    })
}

/// Which level leaves a state that is not at rest fastest, and how fast. `drift` in m/s.
fn of_drift(session: Session, drift: [f64; 4]) -> String {
    let lab = session.lab;
    let unit = session.own.unit.get();
    let (tank, rate) =
        (0..4).map(|tank| (tank, drift[tank])).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).unwrap_or_default();
    let shown = lab.number_style().significant(to_shown(rate.abs() * SECONDS_PER_MINUTE, unit), 2);
    let unit = unit_name(unit);
    if rate > 0.0 {
        tr!(lab, process.state_rises, tank = tank + 1, rate = shown, unit = unit)
    } else {
        tr!(lab, process.state_falls, tank = tank + 1, rate = shown, unit = unit)
    }
}

fn of_limit(session: Session, error: &PlantError) -> String {
    let lab = session.lab;
    let sentence = of_plant_error(lab, session.own.unit.get(), error);
    if matches!(error, PlantError::LevelOutOfRange { .. }) { sentence + &tr!(lab, process.overflow) } else { sentence }
}

/// How long the right-most zero takes, for the valve plane.
pub fn of_rightmost(session: Session) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    let signed = |z: f64| format!("{}{}", if z > 0.0 { "+" } else { "" }, style.significant(z, 3));
    let lead = |z: f64| tr!(lab, valves.rightmost, zero = signed(z));
    let time = |z: f64| style.significant(1.0 / z.abs(), 2);
    let from_zero = |z: f64| {
        let rest =
            if z > 0.0 { tr!(lab, valves.right_of, time = time(z)) } else { tr!(lab, valves.left_of, time = time(z)) };
        lead(z) + &rest
    };
    match situation(session) {
        Some(ZeroSituation::Left(z) | ZeroSituation::Right(z)) => from_zero(z),
        Some(ZeroSituation::Origin) => tr!(lab, valves.at_origin),
        _ => tr!(lab, valves.none),
    }
}

/// The direction of the right-most zero, in words.
pub fn of_direction(session: Session) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    session
        .throttled
        .with_analysis(|analysis| match &analysis.linear.zeros {
            Err(_) => tr!(lab, zeros.degenerate),
            Ok(_) => match analysis.linear.rightmost_zero() {
                None => tr!(lab, zeros.none),
                Some(zero) => {
                    let y: [f64; 2] = [zero.output_direction[0].re, zero.output_direction[1].re];
                    let lead = tr!(lab, zeros.direction, y1 = style.fixed(y[0], 2), y2 = style.fixed(y[1], 2));
                    let rest = match ZeroEffect::of(zero) {
                        ZeroEffect::Harmless => tr!(lab, zeros.easy),
                        ZeroEffect::OneLevel { level } => tr!(lab, zeros.single, level = level + 1),
                        ZeroEffect::Opposed => tr!(lab, zeros.opposed),
                        ZeroEffect::Together => tr!(lab, zeros.together),
                    };
                    lead + &rest
                }
            },
        })
        .unwrap_or_else(|| tr!(lab, process.no_equilibrium))
}

/// What the closed-loop poles say, and whether it is bad news.
pub fn of_stability(session: Session) -> (String, bool) {
    let lab = session.lab;
    let style = lab.number_style();
    session
        .throttled
        .with_analysis(|analysis| {
            let slowest = analysis.closed_loop.rightmost_pole();
            let number = |z: Complex| style.significant(z.re, 2);
            match (analysis.closed_loop.stability, slowest) {
                (Stability::Stable, _) if analysis.closed_loop.has_dead_time => {
                    let peak = analysis.closed_loop.sensitivity_peak.map_or(f64::NAN, |peak| peak.value);
                    (tr!(lab, pi.stable_delayed, peak = style.significant(peak, 3)), false)
                }
                (Stability::Unstable, _) if analysis.closed_loop.has_dead_time => (tr!(lab, pi.unstable_delayed), true),
                (Stability::Stable, Some(pole)) => {
                    let time = style.significant(1.0 / pole.re.abs(), 3);
                    let text = match analysis.closed_loop.sensitivity_peak {
                        Some(peak) => {
                            let peak = style.significant(peak.value, 3);
                            tr!(lab, pi.stable, pole = number(pole), time = time, peak = peak)
                        }
                        None => tr!(lab, pi.stable_short, pole = number(pole), time = time),
                    };
                    (text, false)
                }
                (Stability::Unstable, Some(pole)) if pole.re > 0.0 => {
                    let time = style.significant(std::f64::consts::LN_2 / pole.re, 2);
                    let pole = format!("+{}", number(pole));
                    (tr!(lab, pi.unstable, pole = pole, time = time), true)
                }
                (Stability::Marginal, _) => (tr!(lab, pi.marginal), true),
                _ => (tr!(lab, pi.unstable_fast), true),
            }
        })
        .unwrap_or_else(|| (tr!(lab, process.no_equilibrium), true))
}

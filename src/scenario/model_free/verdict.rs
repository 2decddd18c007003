use crate::plant::{QuadrupleTank, ValveSchedule};
use crate::sim::{EventKind, HoldingEnds, TrackingFigures, Trajectory};

use super::{ModelFreeAnalysis, ModelFreeAnswer, ModelFreeSetup};

/// How near to its reference a level has to be in the end to count as settled, and as followed while valves move (shares of
/// the reference).
const SETTLED: f64 = 0.02;
const FOLLOWED: f64 = 0.05;
/// The last part of a run, in which it shows how it goes on.
const LATE: f64 = 0.75;
const ROUNDING: f64 = 1e-9;

/// What took a level away from its reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LossBy {
    /// This tank (index) had run over, at this time (s).
    Overflow {
        /// Index of the tank.
        tank: usize,
        /// When (s).
        time_s: f64,
    },
    /// This pump (index) stood at a limit.
    Pump(usize),
    /// Neither.
    Other,
}

/// What a run shows to whoever sees all of it, not the two lower levels alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModelFreeVerdict {
    /// A level followed its reference and then left it for good.
    Lost {
        /// Index of the level, the one that was lost first.
        level: usize,
        /// When (s).
        at_s: f64,
        /// By what.
        by: LossBy,
        /// When the zero dynamics had said it would end (s).
        foretold_s: Option<f64>,
    },
    /// Both levels are where they should be, and the upper tanks are leaving: it cannot go on.
    Leaving {
        /// When it will end, by the zero dynamics (s).
        ends_s: f64,
        /// What will end it.
        by: HoldingEnds,
        /// The time in which the upper tanks part by another factor e (s), by the right-most zero.
        e_folding_s: Option<f64>,
    },
    /// Valves move, and the levels stay within so much of their references (m) in the last quarter of the run.
    Rippling([f64; 2]),
    /// Both levels settle, after so long (s); `None` for one whose reference never steps.
    Settled([Option<f64>; 2]),
    /// In the last quarter of the run they are as far from their references as this (m).
    Unsettled([f64; 2]),
}

impl ModelFreeVerdict {
    /// The verdict on a run with what theory says of its setup.
    pub fn of(setup: &ModelFreeSetup, answer: &ModelFreeAnswer, analysis: &ModelFreeAnalysis) -> Self {
        let run = &answer.run.trajectory;
        let foretold = answer.predicted.and_then(|predicted| Some((predicted.ends?, predicted.from_s)));
        let foretold_s = foretold.map(|(ends, from_s)| from_s + after_s(ends));
        let losses = answer.figures.iter().enumerate().filter_map(|(level, f)| Some((level, f.lost_at_s?)));
        if let Some((level, at_s)) = losses.min_by(|a, b| a.1.total_cmp(&b.1)) {
            return Self::Lost { level, at_s, by: loss_by(&setup.plant_at(at_s), run, at_s), foretold_s };
        }
        let late = [0, 1].map(|level| late_error(run, level));
        let within = |share: f64| late.iter().all(|&(error, reference)| error <= share * reference);
        if let Some((by, from_s)) = foretold.filter(|_| within(SETTLED)) {
            let zero = analysis.moment.as_ref().and_then(super::Moment::rightmost_zero).filter(|&zero| zero > 0.0);
            return Self::Leaving { ends_s: from_s + after_s(by), by, e_folding_s: zero.map(f64::recip) };
        }
        let most = late.map(|(error, _)| error);
        if !setup.valves.iter().all(ValveSchedule::is_constant) && within(FOLLOWED) {
            Self::Rippling(most)
        } else if within(SETTLED) && answer.figures.iter().all(has_settled) {
            Self::Settled(answer.figures.map(|figures| figures.settling_s))
        } else {
            Self::Unsettled(most)
        }
    }
}

fn has_settled(figures: &TrackingFigures) -> bool {
    figures.overshoot.is_none() || figures.settling_s.is_some()
}

/// Time from the prediction on (s).
fn after_s(ends: HoldingEnds) -> f64 {
    match ends {
        HoldingEnds::Pump { after_s, .. } | HoldingEnds::Overflow { after_s, .. } => after_s,
    }
}

/// Largest error and largest reference of a level in the last quarter of a run (m).
fn late_error(run: &Trajectory, level: usize) -> (f64, f64) {
    let from = LATE * run.time_s.last().copied().unwrap_or(0.0);
    let first = run.time_s.partition_point(|&time| time < from);
    let (levels, references) = (&run.levels[level][first..], &run.references[level][first..]);
    let error = levels.iter().zip(references).map(|(level, reference)| (level - reference).abs()).fold(0.0, f64::max);
    (error, references.iter().copied().fold(0.0, f64::max))
}

fn loss_by(plant: &QuadrupleTank, run: &Trajectory, at_s: f64) -> LossBy {
    let overflow = run.events.iter().find_map(|event| match event.kind {
        EventKind::Overflow { tank } if event.time_s <= at_s => Some(LossBy::Overflow { tank, time_s: event.time_s }),
        _ => None,
    });
    // The voltage is the limited output times a gain: rounding may keep it from the limit itself.
    let at_limit = |index: &usize| {
        let (pump, row) = (&plant.pumps[*index], run.row_at(at_s));
        let slack = ROUNDING * pump.voltage_max;
        let voltage = row.map(|row| run.pump_voltage[*index][row]);
        voltage.is_some_and(|v| v <= pump.voltage_min + slack || v >= pump.voltage_max - slack)
    };
    overflow.or_else(|| (0..2).find(at_limit).map(LossBy::Pump)).unwrap_or(LossBy::Other)
}

use crate::plant::{QuadrupleTank, ValveSchedule};
use crate::sim::{EventKind, NoResponse, TrackingMetrics, Trajectory, ZeroDynamicsEnd};

use super::{ModelFreeAnalysis, ModelFreeAnswer, ModelFreeSetup};

/// How near to its reference a level has to be in the end to count as settled, and as followed while valves move (shares of
/// the reference).
const SETTLED: f64 = 0.02;
const FOLLOWED: f64 = 0.05;
/// The last part of a run, in which it shows how it goes on.
const LATE: f64 = 0.75;
/// How much further apart the upper tanks are in the last quarter of a run than in the one before to count as drifting, as a
/// share of their mean level: less may be a part of a swing.
const DRIFTING: f64 = 0.03;
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

/// Verdict on a run that takes the upper tanks and the zero dynamics into account, not only the controlled levels.
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
        /// The end that the zero dynamics predicted, and its time (s).
        predicted: Option<(ZeroDynamicsEnd, f64)>,
    },
    /// Both controlled levels are at their references while the upper tanks diverge along the unstable zero dynamics,
    /// until a pump or a tank reaches a limit.
    Leaving {
        /// When it will end, by the zero dynamics (s).
        ends_s: f64,
        /// What will end it.
        by: ZeroDynamicsEnd,
        /// Time in which the upper levels diverge by another factor e, 1/z of the right-most zero (s).
        e_folding_s: Option<f64>,
    },
    /// The valves move and both levels follow their references.
    Rippling {
        /// How far from their references they are in the last quarter of the run (m).
        error: [f64; 2],
        /// By how much the upper tanks are further apart in it than in the quarter before (m), where they drift.
        apart: Option<f64>,
    },
    /// Both levels settle, after so long (s); `None` for one whose reference never steps.
    Settled([Option<f64>; 2]),
    /// A level is neither settled nor lost.
    Unsettled {
        /// How far from their references they are in the last quarter of the run (m).
        error: [f64; 2],
        /// What may keep them from settling.
        by: LossBy,
    },
}

impl ModelFreeVerdict {
    /// Whether both levels follow their references and the zero dynamics predict no loss.
    pub fn is_good(&self) -> bool {
        matches!(self, Self::Settled(_) | Self::Rippling { apart: None, .. })
    }

    /// The verdict on a run with what theory says of its setup.
    pub fn of(setup: &ModelFreeSetup, answer: &ModelFreeAnswer, analysis: &ModelFreeAnalysis) -> Self {
        let run = &answer.run.trajectory;
        let predicted = answer.predicted.and_then(|loss| loss.ends.map(|ends| (ends, loss.from_s + ends.after_s())));
        let losses = answer.figures.iter().enumerate().filter_map(|(level, f)| Some((level, f.lost_at_s?)));
        if let Some((level, at_s)) = losses.min_by(|a, b| a.1.total_cmp(&b.1)) {
            return Self::Lost { level, at_s, by: loss_by(&setup.plant_at(at_s), run, at_s), predicted };
        }
        let late = [0, 1].map(|level| late_error(run, level));
        let within = |share: f64| late.iter().all(|&(error, reference)| error <= share * reference);
        if let Some((by, ends_s)) = predicted.filter(|_| within(SETTLED)) {
            let plant = analysis.linear.as_ref().and_then(|plant| plant.as_ref().ok());
            let zero = plant.and_then(|plant| Some(plant.rightmost_zero()?.value.re)).filter(|&zero| zero > 0.0);
            return Self::Leaving { ends_s, by, e_folding_s: zero.map(f64::recip) };
        }
        let error = late.map(|(error, _)| error);
        if !setup.valves.iter().all(ValveSchedule::is_constant) && within(FOLLOWED) {
            Self::Rippling { error, apart: drift(run) }
        } else if within(SETTLED) && answer.figures.iter().all(is_settled) {
            Self::Settled(answer.figures.map(|figures| figures.settling_s))
        } else {
            let end_s = run.time_s.last().copied().unwrap_or(0.0);
            Self::Unsettled { error, by: loss_by(&setup.plant_at(end_s), run, end_s) }
        }
    }
}

/// Whether a level looks settled in a loop that is stable: any other leaves sooner or later.
fn is_settled(figures: &TrackingMetrics) -> bool {
    let stays = !matches!(figures.no_response, Some(NoResponse::UnstableLoop | NoResponse::MarginalLoop));
    figures.looks_settled && stays
}

/// Largest error and largest reference of a level in the last quarter of a run (m).
fn late_error(run: &Trajectory, level: usize) -> (f64, f64) {
    let from = LATE * run.time_s.last().copied().unwrap_or(0.0);
    let first = run.time_s.partition_point(|&time| time < from);
    let (levels, references) = (&run.levels[level][first..], &run.references[level][first..]);
    let error = levels.iter().zip(references).map(|(level, reference)| (level - reference).abs()).fold(0.0, f64::max);
    (error, references.iter().copied().fold(0.0, f64::max))
}

/// By how much the upper tanks are further apart in the last quarter than in the one before, on the average (m), if it is
/// enough to count.
fn drift(run: &Trajectory) -> Option<f64> {
    let rows = run.time_s.len();
    let mean = |tank: usize, quarter: usize| {
        let part = &run.levels[tank][quarter * rows / 4..(quarter + 1) * rows / 4];
        part.iter().sum::<f64>() / part.len() as f64
    };
    let apart = |quarter: usize| (mean(2, quarter) - mean(3, quarter)).abs();
    let more = apart(3) - apart(2);
    (more > DRIFTING * f64::midpoint(mean(2, 3), mean(3, 3))).then_some(more)
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

use serde::Serialize;
use thiserror::Error;

use super::reaction_curve::SETTLED;
use crate::sim::level::is_rounding;

/// Whether a process is self-regulating or integrating, with the reason (Rice and Cooper 2015; Andreis 2017, §2.1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "verdict", content = "reason", rename_all = "kebab-case")]
pub enum Regulation {
    /// Self-regulating.
    SelfRegulating(RegulationReason),
    /// Integrating.
    Integrating(RegulationReason),
    /// Undecided by the test.
    Undecided(RegulationReason),
}

/// What a test shows. Shares are of the largest move, of the signal in an open loop and of the set-point in a closed one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "sign", rename_all = "kebab-case")]
pub enum RegulationReason {
    /// After the step back the signal settles where it started.
    ReturnsToStart {
        /// How far from it.
        share: f64,
    },
    /// After the step back the signal stays at a new value.
    StaysAway {
        /// How far from the start.
        share: f64,
    },
    /// Between the steps the signal ramps on.
    RampsOn {
        /// By how much it moves in the last tenth of that time.
        share: f64,
    },
    /// With proportional control alone the offset grows with the set-point, and the output follows it.
    OffsetFollows {
        /// Offset per step of the set-point.
        share: f64,
    },
    /// With proportional control alone there is no offset, and the output returns.
    NoOffset {
        /// Offset per step of the set-point.
        share: f64,
    },
    /// The signal still moves.
    StillMoves {
        /// By how much in the last tenth of a step.
        share: f64,
    },
    /// The signal does not move at all.
    DoesNotMove,
}

/// Why a record cannot be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "error", rename_all = "kebab-case")]
pub enum RegulationError {
    /// A stretch is too short.
    #[error("a stretch of the test has {rows} rows, which are too few")]
    TooFewRows {
        /// Rows of the shortest stretch.
        rows: usize,
    },
    /// The set-point does not change, or there is none.
    #[error("a test with {stretches} set-points is none; it takes two")]
    TooFewStretches {
        /// How many there are.
        stretches: usize,
    },
}

/// Rows that a stretch needs.
const MIN_ROWS: usize = 10;
/// Distance from the start that counts as a return.
const RETURN: f64 = 0.1;
/// Late move from which on a stretch is a ramp, as a share of the largest move.
const RAMP: f64 = 0.05;
/// Least height of a plateau for a ramp, as a share of the largest move.
const PLATEAU: f64 = 0.5;
/// Offset per set-point step that counts as none.
const OFFSET: f64 = 0.01;

/// By how much a stretch of a signal moves in its last tenth.
fn late_move(signal: &[f64]) -> f64 {
    let last = signal.len() - 1;
    signal[last] - signal[last - (signal.len() / 10).max(1)]
}

/// Reads an open-loop test: the output steps up, and later down again. The signal is cut into the stretches before, between and after
/// the steps; the first may be one row.
///
/// # Errors
/// [`RegulationError::TooFewRows`] for a stretch with fewer than ten rows.
pub fn open_loop_regulation(start: f64, between: &[f64], after: &[f64]) -> Result<Regulation, RegulationError> {
    let rows = between.len().min(after.len());
    if rows < MIN_ROWS {
        return Err(RegulationError::TooFewRows { rows });
    }
    let (plateau, end) = (between[between.len() - 1], after[after.len() - 1]);
    let largest = between.iter().chain(after).map(|y| (y - start).abs()).fold(0.0, f64::max);
    if is_rounding(largest, start) {
        return Ok(Regulation::Undecided(RegulationReason::DoesNotMove));
    }
    let (up, back) = (late_move(between) / largest, late_move(after) / largest);
    let away = (end - start) / largest;
    let (settles, ramps) = (|share: f64| share.abs() <= SETTLED, |share: f64| share.abs() > RAMP);
    let is_high = (plateau - start).abs() > PLATEAU * largest;
    let goes_on = (end - plateau) * (plateau - start) > 0.0;
    Ok(if settles(up) && settles(back) && away.abs() <= RETURN {
        Regulation::SelfRegulating(RegulationReason::ReturnsToStart { share: away })
    } else if ramps(up) && is_high && settles(back) && away.abs() > RETURN {
        Regulation::Integrating(RegulationReason::StaysAway { share: away })
    } else if ramps(up) && ramps(back) && goes_on {
        Regulation::Integrating(RegulationReason::RampsOn { share: back })
    } else {
        Regulation::Undecided(RegulationReason::StillMoves { share: if up.abs() > back.abs() { up } else { back } })
    })
}

/// One stretch of a test with proportional control: the set-point, and signal and output under it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SetPointStretch<'a> {
    /// The set-point, in the unit of the signal.
    pub set_point: f64,
    /// The signal.
    pub signal: &'a [f64],
}

/// Reads a staircase of set-points under proportional control: the offset either follows the set-point or stays what it was.
///
/// # Errors
/// [`RegulationError`] for fewer than two stretches or one with fewer than ten rows.
pub fn proportional_regulation(stretches: &[SetPointStretch]) -> Result<Regulation, RegulationError> {
    if stretches.len() < 2 {
        return Err(RegulationError::TooFewStretches { stretches: stretches.len() });
    }
    let rows = stretches.iter().map(|stretch| stretch.signal.len()).min().unwrap_or(0);
    if rows < MIN_ROWS {
        return Err(RegulationError::TooFewRows { rows });
    }
    let set_points = || stretches.iter().map(|stretch| stretch.set_point);
    let span = set_points().fold(f64::NEG_INFINITY, f64::max) - set_points().fold(f64::INFINITY, f64::min);
    if is_rounding(span, stretches[0].set_point) {
        return Ok(Regulation::Undecided(RegulationReason::DoesNotMove));
    }
    let late = stretches.iter().map(|stretch| (late_move(stretch.signal) / span).abs()).fold(0.0, f64::max);
    if late > 0.5 * OFFSET {
        return Ok(Regulation::Undecided(RegulationReason::StillMoves { share: late }));
    }
    // The slope of the offset over the set-point, by least squares.
    let count = stretches.len() as f64;
    let offset = |stretch: &SetPointStretch| stretch.set_point - stretch.signal[stretch.signal.len() - 1];
    let mean_set_point = set_points().sum::<f64>() / count;
    let mean_offset = stretches.iter().map(offset).sum::<f64>() / count;
    let (mut product, mut square) = (0.0, 0.0);
    for stretch in stretches {
        let from_mean = stretch.set_point - mean_set_point;
        product += from_mean * (offset(stretch) - mean_offset);
        square += from_mean * from_mean;
    }
    let share = product / square;
    Ok(if share.abs() > OFFSET {
        Regulation::SelfRegulating(RegulationReason::OffsetFollows { share })
    } else {
        Regulation::Integrating(RegulationReason::NoOffset { share })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_that_is_too_short_says_what_it_lacks() {
        let signal = [1.0; 20];
        let stretch = |rows: usize| SetPointStretch { set_point: 1.0, signal: &signal[..rows] };
        let few = Err(RegulationError::TooFewRows { rows: 9 });
        assert_eq!(proportional_regulation(&[stretch(20), stretch(9)]), few);
        assert_eq!(open_loop_regulation(1.0, &signal, &signal[..9]), few);
        let one = Err(RegulationError::TooFewStretches { stretches: 1 });
        assert_eq!(proportional_regulation(&[stretch(20)]), one);
        assert_eq!(proportional_regulation(&[]), Err(RegulationError::TooFewStretches { stretches: 0 }));
    }

    #[test]
    fn a_signal_that_drifts_by_rounding_does_not_move() {
        let drifting: Vec<f64> = (0..40).map(|k| 12.0 + 2e-15 * f64::from(k)).collect();
        let found = open_loop_regulation(12.0, &drifting[..20], &drifting[20..]);
        assert_eq!(found, Ok(Regulation::Undecided(RegulationReason::DoesNotMove)));
    }
}

use serde::Serialize;

use crate::control::Pairing;
use crate::plant::QuadrupleTank;

use super::experiment::MIN_STEP;
use super::response::{AT_REST, AT_REST_FOR, NoResponse};
use super::trajectory::Trajectory;

/// Band around the new reference that counts as settled, as a share of the step.
const SETTLED: f64 = 0.02;
/// Band that counts as tracked, as a share of the reference.
const TRACKED: f64 = 0.05;

/// What lasts for less than this share of the time since the step shows nothing yet: a swing is outside the band and back
/// inside again and again, and noise leaves it now and then.
const SHOWN: f64 = 0.1;
/// Samples in a row inside the band that show that a level was there, not only passed.
const HELD: usize = 20;

/// How one level followed its reference, from samples: costs of the whole run, the last sample included, and figures of the
/// response to the last step of this reference by more than 1 nm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TrackingMetrics {
    /// Σ |r − h| Ts (m s).
    pub iae: f64,
    /// Σ (r − h)² Ts (m² s).
    pub ise: f64,
    /// Why there are no figures of a response; `None` where there are.
    pub no_response: Option<NoResponse>,
    /// Furthest beyond the reference, as a share of the step.
    pub overshoot: Option<f64>,
    /// From the step to the last time outside 2 % of it (s); `None` also when it is outside at the end or in the last tenth of the
    /// time.
    pub settling_s: Option<f64>,
    /// Σ |Δu| of the loop (V).
    pub total_variation: f64,
    /// How long the output of the loop was at a limit (s).
    pub saturated_s: f64,
    /// When the level left 5 % of its reference for good (s), after it had been there for 20 samples; `None` when it did not, or
    /// only in the last tenth of the time since the step.
    pub lost_at_s: Option<f64>,
    /// Whether the level is where it should be, as far as a plot of it shows; so is one that was never asked to move.
    pub looks_settled: bool,
}

impl TrackingMetrics {
    /// The same without the figures of a response, for a reason that holds for any step.
    #[must_use]
    pub fn without_response(self, reason: NoResponse) -> Self {
        let own = self.no_response.filter(|own| !matches!(own, NoResponse::NotAtRest { .. }));
        Self { no_response: own.or(Some(reason)), overshoot: None, settling_s: None, ..self }
    }

    /// The same with the figures of the response from another run of the experiment: its twin without noise.
    #[must_use]
    pub fn judged_by(self, twin: &Self) -> Self {
        let Self { no_response, overshoot, settling_s, looks_settled, .. } = *twin;
        Self { no_response, overshoot, settling_s, looks_settled, ..self }
    }
}

/// The figures of both loops of a run whose samples are every `rows_per_sample` rows. A level that starts away from its first
/// reference has stepped at the start.
pub fn tracking_metrics(
    run: &Trajectory,
    rows_per_sample: usize,
    plant: &QuadrupleTank,
    pairing: Pairing,
) -> [TrackingMetrics; 2] {
    let limits = pairing.by_loop(plant.controller_limits());
    let column = |values: &[f64]| values.iter().copied().step_by(rows_per_sample).collect();
    let samples: [Samples; 2] = std::array::from_fn(|i| Samples {
        time: column(&run.time_s),
        level: column(&run.levels[i]),
        reference: column(&run.references[i]),
        output: column(&run.controller_output[i]),
    });
    std::array::from_fn(|i| samples[i].figures(limits[i], &samples[1 - i].reference))
}

/// The samples of one loop.
struct Samples {
    time: Vec<f64>,
    level: Vec<f64>,
    reference: Vec<f64>,
    output: Vec<f64>,
}

impl Samples {
    /// The figures, with `other` the reference of the other level: from its next step on the response is to that as well.
    fn figures(&self, (min, max): (f64, f64), other: &[f64]) -> TrackingMetrics {
        let sampling_time = self.time.get(1).copied().unwrap_or(0.0);
        let error = |k: usize| self.reference[k] - self.level[k];
        let sum = |f: &dyn Fn(usize) -> f64| (0..self.time.len()).map(f).sum::<f64>();
        let limited = |k: usize| self.output[k] <= min || self.output[k] >= max;
        let step = self.last_step();
        let lost_at_s = self.lost_at(step.map_or(0, |(first, _)| first));
        let settling_s = step.and_then(|(first, size)| {
            let outside = |k: &usize| error(*k).abs() > SETTLED * f64::abs(size);
            let end = window_end(other, first);
            let settled = (first..end).rev().find(outside).map_or(first, |k| k + 1);
            let stays = end - settled;
            (stays >= shown(end - first)).then(|| self.time[settled] - self.time[first])
        });
        let figures = TrackingMetrics {
            iae: sampling_time * sum(&|k| error(k).abs()),
            ise: sampling_time * sum(&|k| error(k).powi(2)),
            overshoot: step
                .map(|(first, size)| (first..window_end(other, first)).map(|k| -error(k) / size).fold(0.0, f64::max)),
            no_response: None,
            settling_s,
            total_variation: self.output.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum(),
            saturated_s: sampling_time * sum(&|k| f64::from(limited(k))),
            lost_at_s,
            looks_settled: lost_at_s.is_none() && (step.is_none() || settling_s.is_some()),
        };
        let reason = step.map_or(Some(NoResponse::NoStep), |(first, size)| self.unrest(first, size));
        reason.map_or(figures, |reason| figures.without_response(reason))
    }

    /// What was wrong with the level when its reference stepped by `size` (m) at sample `first`, if it was not at rest. At the start
    /// nothing has moved it yet.
    fn unrest(&self, first: usize, size: f64) -> Option<NoResponse> {
        let steps = |k: &usize| (self.reference[*k] - self.reference[*k - 1]).abs() > MIN_STEP;
        let before = self.reference[first.checked_sub(1)?];
        let moved = (1..first).rev().find(steps).unwrap_or(0);
        let rest_s = self.time[first] - AT_REST_FOR * (self.time[first] - self.time[moved]);
        let approach = (moved..=first).filter(|&k| self.time[k] >= rest_s);
        let distance = approach.map(|k| (self.level[k] - before).abs()).fold(0.0, f64::max);
        (distance > AT_REST * size.abs()).then_some(NoResponse::NotAtRest { distance })
    }

    /// Sample of the last step of the reference, and its size (m).
    fn last_step(&self) -> Option<(usize, f64)> {
        let at_start = self.reference.first()? - self.level.first()?;
        let later = (1..self.reference.len()).rev().map(|k| (k, self.reference[k] - self.reference[k - 1]));
        later.chain([(0, at_start)]).find(|(_, size)| size.abs() > MIN_STEP)
    }

    fn lost_at(&self, first: usize) -> Option<f64> {
        let tracked = |k: &usize| (self.reference[*k] - self.level[*k]).abs() <= TRACKED * self.reference[*k].abs();
        let last = (first..self.time.len()).rev().find(tracked)?;
        let held = (first..=last).rev().take_while(tracked).count();
        let away = self.time.len() - 1 - last;
        (held >= HELD && away >= shown(self.time.len() - first)).then(|| self.time[last + 1])
    }
}

/// How many samples it takes to show something in a response of so many.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a tenth of a count")]
fn shown(samples: usize) -> usize {
    ((SHOWN * samples as f64) as usize).max(1)
}

/// Where the response to a step at sample `first` ends: at the next step of the other reference, else at the end.
fn window_end(other: &[f64], first: usize) -> usize {
    let steps = |k: &usize| (other[*k] - other[*k - 1]).abs() > MIN_STEP;
    (first + 1..other.len()).find(steps).unwrap_or(other.len())
}

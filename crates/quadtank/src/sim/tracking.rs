use serde::Serialize;

use crate::control::Pairing;
use crate::plant::QuadrupleTank;

use super::experiment::LEAST_STEP;
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

/// How one level followed its reference, from samples: sums over all of them, the last included; figures of the response from
/// the last step of this reference by more than 1 nm on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TrackingMetrics {
    /// Σ |r − h| Ts (m s).
    pub iae: f64,
    /// Σ (r − h)² Ts (m² s).
    pub ise: f64,
    /// Furthest beyond the reference, as a share of the step; `None` when it never steps.
    pub overshoot: Option<f64>,
    /// From the step to the last time outside 2 % of it (s); `None` when it never steps, or is outside at the end or in the last
    /// tenth of the time.
    pub settling_s: Option<f64>,
    /// Σ |Δu| of the loop (V).
    pub total_variation: f64,
    /// How long the output of the loop was at a limit (s).
    pub saturated_s: f64,
    /// When the level left 5 % of its reference for good (s), after it had been there for 20 samples; `None` when it did not, or
    /// only in the last tenth of the time since the step.
    pub lost_at_s: Option<f64>,
}

impl TrackingMetrics {
    /// Whether the level is where it should be, as far as a plot of it shows; so is one that was never asked to move.
    pub fn looks_settled(&self) -> bool {
        self.lost_at_s.is_none() && (self.overshoot.is_none() || self.settling_s.is_some())
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
    std::array::from_fn(|i| {
        let column = |values: &[f64]| values.iter().copied().step_by(rows_per_sample).collect();
        Samples {
            time: column(&run.time_s),
            level: column(&run.levels[i]),
            reference: column(&run.references[i]),
            output: column(&run.controller_output[i]),
        }
        .figures(limits[i])
    })
}

/// The samples of one loop.
struct Samples {
    time: Vec<f64>,
    level: Vec<f64>,
    reference: Vec<f64>,
    output: Vec<f64>,
}

impl Samples {
    fn figures(&self, (min, max): (f64, f64)) -> TrackingMetrics {
        let sampling_time = self.time.get(1).copied().unwrap_or(0.0);
        let error = |k: usize| self.reference[k] - self.level[k];
        let sum = |f: &dyn Fn(usize) -> f64| (0..self.time.len()).map(f).sum::<f64>();
        let limited = |k: usize| self.output[k] <= min || self.output[k] >= max;
        let step = self.last_step();
        TrackingMetrics {
            iae: sampling_time * sum(&|k| error(k).abs()),
            ise: sampling_time * sum(&|k| error(k).powi(2)),
            overshoot: step.map(|(first, size)| (first..self.time.len()).map(|k| -error(k) / size).fold(0.0, f64::max)),
            settling_s: step.and_then(|(first, size)| {
                let outside = |k: &usize| error(*k).abs() > SETTLED * f64::abs(size);
                let settled = (first..self.time.len()).rev().find(outside).map_or(first, |k| k + 1);
                let stays = self.time.len() - settled;
                (stays >= self.shown(first)).then(|| self.time[settled] - self.time[first])
            }),
            total_variation: self.output.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum(),
            saturated_s: sampling_time * sum(&|k| f64::from(limited(k))),
            lost_at_s: self.lost_at(step.map_or(0, |(first, _)| first)),
        }
    }

    /// Sample of the last step of the reference, and its size (m).
    fn last_step(&self) -> Option<(usize, f64)> {
        let at_start = self.reference.first()? - self.level.first()?;
        let later = (1..self.reference.len()).rev().map(|k| (k, self.reference[k] - self.reference[k - 1]));
        later.chain([(0, at_start)]).find(|(_, size)| size.abs() > LEAST_STEP)
    }

    fn lost_at(&self, first: usize) -> Option<f64> {
        let tracked = |k: &usize| (self.reference[*k] - self.level[*k]).abs() <= TRACKED * self.reference[*k].abs();
        let last = (first..self.time.len()).rev().find(tracked)?;
        let held = (first..=last).rev().take_while(tracked).count();
        let away = self.time.len() - 1 - last;
        (held >= HELD && away >= self.shown(first)).then(|| self.time[last + 1])
    }

    /// How many samples it takes to show something in a response that begins at sample `first`.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a tenth of a count")]
    fn shown(&self, first: usize) -> usize {
        ((SHOWN * (self.time.len() - first) as f64) as usize).max(1)
    }
}

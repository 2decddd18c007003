use serde::{Deserialize, Serialize};

use super::pi::limited;
use super::{Estimator, EstimatorError, EstimatorSettings, FedWith, MAX_WINDOW_SAMPLES, Pairing};

/// What keeps the integral of the law from winding up while its output is limited. The source has nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ModelFreeAntiWindup {
    /// Nothing: the integral runs on.
    Off,
    /// An error that pushes a limited output further beyond its limit is not integrated.
    Conditional,
    /// The excess over the limit flows back into the integral.
    BackCalculation {
        /// Tracking time Tt (s).
        tracking_time_s: f64,
    },
}

/// Settings of one loop of the law, `u = (−φ̂ + Kp e + Ki ∫ e dt)/α̂` with e = r − y in metres
/// (Junqueira, Neves and Angelico, eqs. 16 and 17).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ModelFreeSettings {
    /// Gain α̂ of the ultra-local model (m/(s V)), positive.
    pub model_gain: f64,
    /// Kp (1/s).
    pub proportional: f64,
    /// Ki (1/s²).
    pub integral: f64,
    /// Anti-windup.
    pub anti_windup: ModelFreeAntiWindup,
}

/// Two loops of the law that know nothing of each other. Loop 1 controls level 1, loop 2 level 2, whatever pump they drive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ModelFree {
    /// Which pump each loop drives.
    pub pairing: Pairing,
    /// Settings of the loops that control levels 1 and 2.
    pub loops: [ModelFreeSettings; 2],
    /// The estimator of φ in both loops; `None` leaves φ̂ as it begins, 0 from empty tanks. A document that says nothing about it
    /// has the published one.
    #[serde(default = "published_estimator")]
    pub estimator: Option<EstimatorSettings>,
    /// Sampling time Ts of both loops (s).
    pub sampling_time_s: f64,
}

/// What a document without the field has: `null` is for no estimator.
#[expect(clippy::unnecessary_wraps, reason = "the default of an optional field")]
fn published_estimator() -> Option<EstimatorSettings> {
    Some(EstimatorSettings::PUBLISHED)
}

impl ModelFree {
    /// The law as published: α̂ = 0.1 cm/(s V), Kp = 2, Ki = 0.05, T = 10 s, Ts = 1 s, and no anti-windup.
    pub const PUBLISHED: Self = {
        let one = ModelFreeSettings {
            model_gain: 1e-3,
            proportional: 2.0,
            integral: 0.05,
            anti_windup: ModelFreeAntiWindup::Off,
        };
        Self {
            pairing: Pairing::Diagonal,
            loops: [one; 2],
            estimator: Some(EstimatorSettings::PUBLISHED),
            sampling_time_s: 1.0,
        }
    };

    /// The same law with another sampling time (s). Its window becomes the nearest whole number of samples, two at least.
    #[must_use]
    pub fn with_sampling_time(mut self, sampling_time_s: f64) -> Self {
        self.sampling_time_s = sampling_time_s;
        if let Some(estimator) = &mut self.estimator {
            let samples = (estimator.window_s / sampling_time_s).round();
            estimator.window_s = samples.clamp(2.0, MAX_WINDOW_SAMPLES as f64) * sampling_time_s;
        }
        self
    }

    /// Whether both gains and the window can work.
    ///
    /// # Errors
    /// [`EstimatorError`] names what cannot.
    pub fn check(&self) -> Result<(), EstimatorError> {
        for settings in &self.loops {
            if !(settings.model_gain > 0.0 && settings.model_gain.is_finite()) {
                return Err(EstimatorError::ModelGain { value: settings.model_gain });
            }
        }
        self.estimator.map_or(Ok(()), |estimator| estimator.samples(self.sampling_time_s).map(|_| ()))
    }

    /// Both loops, ready to [`step`](RunningModelFree::step). `limits` (lowest and highest output, V) and `output` (at rest, or
    /// 0 where the run begins with nothing, V) are by pump, `levels` (m) by level.
    ///
    /// Until the first window is full φ̂ is `−α̂ u0`, with which the law asks for the output at rest.
    ///
    /// # Errors
    /// As [`check`](Self::check).
    pub fn start(
        &self,
        limits: [(f64, f64); 2],
        output: [f64; 2],
        levels: [f64; 2],
    ) -> Result<RunningModelFree, EstimatorError> {
        self.check()?;
        let (limits, output) = (self.pairing.by_loop(limits), self.pairing.by_loop(output));
        let start = |i: usize| ModelFreeLoop::new(self, i, limits[i], output[i], levels[i]);
        Ok(RunningModelFree { loops: [start(0)?, start(1)?] })
    }
}

/// The two loops of a [`ModelFree`] with their states.
#[derive(Clone, Debug, PartialEq)]
pub struct RunningModelFree {
    loops: [ModelFreeLoop; 2],
}

impl RunningModelFree {
    /// One sample of both loops: takes references and measured levels 1 and 2 (m), returns the limited outputs of loops 1 and
    /// 2 (V). [`Pairing::by_pump`] sorts them by pump.
    pub fn step(&mut self, references: [f64; 2], measured: [f64; 2]) -> [f64; 2] {
        let [first, second] = &mut self.loops;
        [first.step(references[0], measured[0]), second.step(references[1], measured[1])]
    }

    /// φ̂ of both loops (m/s).
    pub fn estimates(&self) -> [f64; 2] {
        self.loops.each_ref().map(ModelFreeLoop::estimate)
    }
}

#[derive(Clone, Debug, PartialEq)]
struct ModelFreeLoop {
    settings: ModelFreeSettings,
    limits: (f64, f64),
    sampling_time_s: f64,
    estimator: Option<Estimator>,
    fed_with: FedWith,
    /// φ̂ where there is no estimator.
    constant: f64,
    /// Ki ∫ e dt (m/s).
    integral: f64,
    /// Input signal for the estimator at the next sample (V); `None` before the first.
    last: Option<f64>,
}

impl ModelFreeLoop {
    fn new(law: &ModelFree, index: usize, limits: (f64, f64), output: f64, level: f64) -> Result<Self, EstimatorError> {
        let settings = law.loops[index];
        let constant = -settings.model_gain * output;
        let new = |s: EstimatorSettings| {
            Estimator::new(s, settings.model_gain, law.sampling_time_s, (level, output, constant))
        };
        Ok(Self {
            settings,
            limits,
            sampling_time_s: law.sampling_time_s,
            estimator: law.estimator.map(new).transpose()?,
            fed_with: law.estimator.map_or(FedWith::Applied, |estimator| estimator.fed_with),
            constant,
            integral: 0.0,
            last: None,
        })
    }

    fn estimate(&self) -> f64 {
        self.estimator.as_ref().map_or(self.constant, Estimator::estimate)
    }

    fn step(&mut self, reference: f64, measured: f64) -> f64 {
        match (&mut self.estimator, self.last) {
            (Some(estimator), Some(last)) => estimator.push(measured, last),
            // With noise it is not the level that the run begins with.
            (Some(estimator), None) => estimator.begin(measured),
            (None, _) => {}
        }
        let ModelFreeSettings { model_gain, proportional, integral, anti_windup } = self.settings;
        let error = reference - measured;
        let phi = self.estimate();
        let asked = |integral: f64| (-phi + proportional * error + integral) / model_gain;
        // Backward Euler (eq. 17).
        let mut next = self.integral + integral * self.sampling_time_s * error;
        let mut command = asked(next);
        let excess = command - limited(command, self.limits);
        match anti_windup {
            ModelFreeAntiWindup::Off => {}
            ModelFreeAntiWindup::Conditional => {
                if excess * error > 0.0 {
                    next = self.integral;
                    command = asked(next);
                }
            }
            ModelFreeAntiWindup::BackCalculation { tracking_time_s } => {
                if integral > 0.0 {
                    let share = (self.sampling_time_s / tracking_time_s).min(1.0);
                    next -= share * excess * model_gain;
                }
            }
        }
        self.integral = next;
        let output = limited(command, self.limits);
        self.last = Some(match self.fed_with {
            FedWith::Applied => output,
            FedWith::Commanded => command,
        });
        output
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    const LIMITS: [(f64, f64); 2] = [(0.0, 12.0); 2];

    fn with(windup: ModelFreeAntiWindup) -> ModelFree {
        let one = ModelFreeSettings { anti_windup: windup, ..ModelFree::PUBLISHED.loops[0] };
        ModelFree { loops: [one; 2], ..ModelFree::PUBLISHED }
    }

    #[test]
    fn back_calculation_stays_finite_with_the_least_integral_gain() {
        let windup = ModelFreeAntiWindup::BackCalculation { tracking_time_s: 1.0 };
        let one = ModelFreeSettings { integral: 5e-324, anti_windup: windup, ..ModelFree::PUBLISHED.loops[0] };
        let estimator = EstimatorSettings { fed_with: FedWith::Commanded, ..EstimatorSettings::PUBLISHED };
        let law = ModelFree { loops: [one; 2], estimator: Some(estimator), ..ModelFree::PUBLISHED };
        let mut law = law.start(LIMITS, [6.0, 5.0], [0.1, 0.12]).unwrap();
        for _ in 0..100 {
            assert!(law.step([10.0, -10.0], [0.1, 0.12]).into_iter().all(f64::is_finite));
            assert!(law.estimates().into_iter().all(f64::is_finite));
        }
    }

    #[test]
    fn rest_is_left_alone_until_the_first_window_is_full() {
        let mut law = ModelFree::PUBLISHED.start(LIMITS, [6.0, 5.0], [0.1, 0.12]).unwrap();
        for _ in 0..10 {
            assert_eq!(law.step([0.1, 0.12], [0.1, 0.12]), [6.0, 5.0]);
        }
        // Then the sum weighs the input by 0.99.
        let [first, second] = law.step([0.1, 0.12], [0.1, 0.12]);
        assert_relative_eq!(first, 0.99 * 6.0, max_relative = 1e-12);
        assert_relative_eq!(second, 0.99 * 5.0, max_relative = 1e-12);
    }

    #[test]
    fn a_step_kicks_by_both_gains() {
        let mut law = ModelFree::PUBLISHED.start(LIMITS, [6.0, 6.0], [0.1, 0.1]).unwrap();
        law.step([0.1, 0.1], [0.1, 0.1]);
        // 0.2 cm: (2 + 0.05) 0.2/0.1 V.
        assert_relative_eq!(law.step([0.102, 0.1], [0.1, 0.1])[0], 6.0 + 4.1, max_relative = 1e-12);
    }

    #[test]
    fn swapped_loops_drive_the_other_pump() {
        let law = ModelFree { pairing: Pairing::Swapped, ..ModelFree::PUBLISHED };
        let mut law = law.start([(0.0, 12.0), (0.0, 4.0)], [6.0, 3.0], [0.1, 0.1]).unwrap();
        assert_eq!(law.step([0.1, 0.1], [0.1, 0.1]), [3.0, 6.0]);
        assert_eq!(law.step([0.2, 0.1], [0.1, 0.1]), [4.0, 6.0]);
    }

    #[test]
    fn at_a_limit_only_the_bare_integral_winds_up() {
        let wound = |windup| {
            let mut law = with(windup).start(LIMITS, [0.0, 0.0], [0.0, 0.0]).unwrap();
            for _ in 0..9 {
                assert_eq!(law.step([0.1, 0.1], [0.0, 0.0])[0], 12.0);
            }
            law.loops[0].integral
        };
        assert_relative_eq!(wound(ModelFreeAntiWindup::Off), 0.05 * 0.9, max_relative = 1e-12);
        assert_eq!(wound(ModelFreeAntiWindup::Conditional), 0.0);
        // Every sample gives the whole excess back: what is left asks for just 12 V.
        let back = wound(ModelFreeAntiWindup::BackCalculation { tracking_time_s: 1.0 });
        assert_relative_eq!((2.0 * 0.1 + back) / 1e-3, 12.0, max_relative = 1e-9);
    }

    #[test]
    fn another_sampling_time_takes_the_nearest_window_of_whole_samples() {
        let law = |ts: f64| ModelFree::PUBLISHED.with_sampling_time(ts);
        let window = |ts: f64| law(ts).estimator.unwrap().window_s;
        assert_eq!([0.005, 0.5, 4.0, 10.0].map(window), [5.0, 10.0, 12.0, 20.0]);
        assert_eq!(law(0.5).sampling_time_s, 0.5);
    }

    /// A law without estimator and with samples of half a second, at 6 V.
    fn half_a_second(windup: ModelFreeAntiWindup) -> RunningModelFree {
        let law = ModelFree { estimator: None, sampling_time_s: 0.5, ..with(windup) };
        law.start(LIMITS, [6.0, 5.0], [0.1, 0.1]).unwrap()
    }

    #[test]
    fn the_law_is_that_of_the_source_with_any_sampling_time() {
        let mut law = half_a_second(ModelFreeAntiWindup::Conditional);
        assert_eq!(law.estimates(), [-6e-3, -5e-3]);
        for k in 1..=4 {
            // (−φ̂ + Kp e + Ki Σ e Ts)/α̂ with e = 1 mm.
            let expected = (6e-3 + 2.0 * 1e-3 + 0.05 * 0.5e-3 * f64::from(k)) / 1e-3;
            assert_relative_eq!(law.step([0.101, 0.1], [0.1, 0.1])[0], expected, max_relative = 1e-12);
        }
    }

    #[test]
    fn anti_windup_integrates_what_leads_back_and_returns_its_share_of_the_excess() {
        // An error that leads back from the limit is integrated.
        let mut law = half_a_second(ModelFreeAntiWindup::Conditional);
        law.loops[0].integral = 0.5;
        assert_eq!(law.step([0.09, 0.1], [0.1, 0.1])[0], 12.0);
        assert_relative_eq!(law.loops[0].integral, 0.5 - 0.05 * 0.5 * 0.01, max_relative = 1e-12);
        // One that leads further beyond the lower limit is not.
        let mut law = half_a_second(ModelFreeAntiWindup::Conditional);
        assert_eq!(law.step([0.0, 0.1], [0.1, 0.1])[0], 0.0);
        assert_eq!(law.loops[0].integral, 0.0);
        // A quarter of the excess of 196.5 V goes back within a sample of a quarter of the tracking time.
        let mut law = half_a_second(ModelFreeAntiWindup::BackCalculation { tracking_time_s: 2.0 });
        assert_eq!(law.step([0.2, 0.1], [0.1, 0.1])[0], 12.0);
        assert_relative_eq!(law.loops[0].integral, 0.05 * 0.05 - 0.25 * 196.5 * 1e-3, max_relative = 1e-12);
    }

    #[test]
    fn the_estimator_hears_what_the_pump_got_or_what_was_asked_for() {
        for (fed_with, expected) in [(FedWith::Applied, 12.0), (FedWith::Commanded, 6.0 + 205.0)] {
            let estimator = Some(EstimatorSettings { fed_with, ..EstimatorSettings::PUBLISHED });
            let law = ModelFree { estimator, ..ModelFree::PUBLISHED };
            let mut law = law.start(LIMITS, [6.0, 6.0], [0.1, 0.1]).unwrap();
            assert_eq!(law.step([0.2, 0.1], [0.1, 0.1])[0], 12.0);
            assert_relative_eq!(law.loops[0].last.unwrap(), expected, max_relative = 1e-12);
        }
    }

    #[test]
    fn what_cannot_work_is_named() {
        let mut law = ModelFree::PUBLISHED;
        law.loops[1].model_gain = 0.0;
        assert_eq!(law.check(), Err(EstimatorError::ModelGain { value: 0.0 }));
        let law = ModelFree { sampling_time_s: 7.0, ..ModelFree::PUBLISHED };
        assert!(matches!(law.check(), Err(EstimatorError::WindowTooShort { .. })));
        assert!(ModelFree { estimator: None, ..law }.check().is_ok());
    }
}

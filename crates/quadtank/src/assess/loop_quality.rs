use crate::control::{IsaPid, ParallelPid, level_loop};
use crate::linear::{LinearError, LoopStability, Margins};
use crate::plant::level::LevelGains;
use crate::sim::level::LevelController;

/// Stability and margins of the linear loop of a level controller around a rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopQuality {
    /// Whether it is stable.
    pub stability: LoopStability,
    /// Margins of a stable loop; `None` for any other, and where they are not computed.
    pub margins: Option<Margins>,
}

impl LoopQuality {
    /// Of a controller; `None` for an output by hand, which closes no loop. A sampled controller counts as a continuous one with half
    /// of its sampling time as dead time.
    ///
    /// # Errors
    /// As [`level_loop`].
    pub fn of(gains: &LevelGains, controller: &LevelController) -> Result<Option<Self>, LinearError> {
        let pi = |gain, integral_time| ParallelPid::from(IsaPid { gain, integral_time, derivative_time: 0.0 });
        let linear = match controller {
            LevelController::Manual { .. } => return Ok(None),
            LevelController::Pi { gain, integral_time_s, .. } => {
                level_loop(gains, &pi(*gain, *integral_time_s), 0.0, 0.0)?
            }
            LevelController::Pid { proportional, integral, derivative, filter_time_s } => {
                let pid = ParallelPid {
                    proportional: *proportional,
                    integral: *integral,
                    derivative: *derivative,
                    ..ParallelPid::default()
                };
                level_loop(gains, &pid, *filter_time_s, 0.0)?
            }
            LevelController::Sampled { settings, sampling_time_s } => {
                let pid = pi(settings.gain, settings.integral_time_s);
                level_loop(gains, &pid, 0.0, 0.5 * sampling_time_s)?
            }
        };
        let stability = linear.stability();
        let margins = if stability == LoopStability::Stable { linear.margins() } else { None };
        Ok(Some(Self { stability, margins }))
    }

    /// Largest sensitivity peak of a robust loop (Åström and Hägglund 2006, §4.6: 1.2 to 2).
    const ROBUST: f64 = 2.0;

    /// Whether the loop is not stable, or has a sensitivity peak above 2.
    pub fn is_fragile(&self) -> bool {
        self.sensitivity_peak().is_none_or(|peak| peak > Self::ROBUST)
    }

    /// Sensitivity peak from which a stable loop goes on swinging: a pair of poles with it has a damping ratio of about
    /// 1/(2 Ms) = 0.1, and needs six swings to come within 2 %.
    const SWINGING: f64 = 5.0;

    /// Whether the loop is stable, but so close to the border that it hardly stops swinging.
    pub fn is_on_the_edge(&self) -> bool {
        self.sensitivity_peak().is_some_and(|peak| peak > Self::SWINGING)
    }

    /// Sensitivity peak Ms, 1 at least.
    pub fn sensitivity_peak(&self) -> Option<f64> {
        self.margins.map(|margins| margins.distance.recip())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::{AntiWindup, LoopMode, PiSettings};
    use crate::literature::{andreis, level_slides};

    #[test]
    fn every_controller_has_the_quality_of_its_loop() {
        let plant = andreis::plant();
        let gains = plant.gains(&plant.rest(1.0, 0.017).unwrap());
        let of = |controller: &LevelController| LoopQuality::of(&gains, controller).unwrap();
        assert_eq!(of(&LevelController::off()), None);
        let continuous = of(&LevelController::pi(10.0, 2500.0)).unwrap();
        let settings = PiSettings {
            gain: 10.0,
            integral_time_s: 2500.0,
            set_point_weight: 1.0,
            anti_windup: AntiWindup::Off,
            mode: LoopMode::Automatic,
        };
        let sampled = of(&LevelController::Sampled { settings, sampling_time_s: 1.0 }).unwrap();
        assert!(sampled.sensitivity_peak().unwrap() > continuous.sensitivity_peak().unwrap());
        let unstable = of(&LevelController::pi(120.0, 2500.0)).unwrap();
        assert!(unstable.margins.is_none() && unstable.sensitivity_peak().is_none());
        // Without a gain nothing is sensitive.
        assert!((of(&LevelController::pi(0.0, 2500.0)).unwrap().sensitivity_peak().unwrap() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_loop_is_on_the_edge_from_a_sensitivity_peak_of_5_until_it_is_unstable() {
        let plant = andreis::plant();
        let gains = plant.gains(&plant.rest(1.0, 0.017).unwrap());
        let of = |gain: f64| LoopQuality::of(&gains, &LevelController::pi(gain, 2500.0)).unwrap().unwrap();
        let (mut calm, mut swinging) = (10.0, 120.0);
        for _ in 0..40 {
            let gain = f64::midpoint(calm, swinging);
            if of(gain).sensitivity_peak().is_some_and(|peak| peak < 5.0) { calm = gain } else { swinging = gain }
        }
        assert!((of(calm).sensitivity_peak().unwrap() - 5.0).abs() < 1e-6, "the peak grows with the gain");
        assert!(!of(0.99 * calm).is_on_the_edge() && of(0.99 * calm).is_fragile());
        assert!(of(1.01 * calm).is_on_the_edge());
        assert!(!of(120.0).is_on_the_edge() && of(120.0).is_fragile(), "what is unstable is not on the edge");
    }

    #[test]
    fn the_loops_of_the_slides_are_stable() {
        let plant = level_slides::plant();
        let gains = plant.gains(&plant.rest(0.5, 0.0).unwrap());
        for pid in level_slides::settings() {
            let controller = LevelController::pid(pid, level_slides::DERIVATIVE_FILTER_S);
            assert_eq!(LoopQuality::of(&gains, &controller).unwrap().unwrap().stability, LoopStability::Stable);
        }
    }
}

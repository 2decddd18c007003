use crate::literature::level_slides;
use crate::sim::level::{HeatedRun, LevelRunError, heated_run};

/// The heated tank of the lecture slides over a step of the Runge–Kutta method.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatedAnswer {
    /// The run, a row for each step.
    pub run: HeatedRun,
    /// The exact level at each row (m).
    pub exact_level: Vec<f64>,
    /// Largest difference of the level from the exact one (m).
    pub level_error: f64,
    /// Largest difference of the temperature from that of a run with a hundredth of the step (K).
    pub temperature_error: f64,
}

impl HeatedAnswer {
    /// Error of the level (m) from which on the numbers are none of the tank: a tenth of the 10 m at which it comes to rest.
    const DIVERGED: f64 = 1.0;

    /// Whether the step is too long for the method.
    pub fn diverges(&self) -> bool {
        self.level_error > Self::DIVERGED
    }
}

/// Length of the run (s): 10 h as in the slides.
const DURATION_S: f64 = 10.0 * level_slides::HOUR;
/// Steps of the method into which a step is cut for the temperature to compare with, which has no solution in closed form.
const FINE: f64 = 100.0;

/// Steps (s) for which there is an answer: from the 0.01 h of the slides to half of the run, far beyond where the method diverges.
pub const HEATED_STEPS_S: [f64; 2] = [0.01 * level_slides::HOUR, 0.5 * DURATION_S];

/// Fills and heats the tank of Example 5 from its start, in steps (s).
///
/// # Errors
/// [`LevelRunError`] for a step that is not positive, or so small that a run takes too many.
pub fn heated_tank(step_s: f64) -> Result<HeatedAnswer, LevelRunError> {
    let tank = level_slides::heated_tank();
    let [level, temperature] = level_slides::HEATED_START;
    let inflow = level_slides::HEATED_INFLOW;
    let of = |step_s| heated_run(&tank, [level, temperature], inflow, DURATION_S, step_s);
    let run = of(step_s)?;
    let fine = of(step_s / FINE)?;
    // The level is that of a linear tank: its final value and what is left of the distance to it.
    let model = tank.tank.linearise(level);
    let net = inflow - tank.tank.outflow.flow(level);
    let exact_level: Vec<f64> = run.time_s.iter().map(|&time| level + model.step_response(net, time)).collect();
    let largest = |differences: &mut dyn Iterator<Item = f64>| differences.map(f64::abs).fold(0.0, f64::max);
    let level_error = largest(&mut run.level.iter().zip(&exact_level).map(|(found, exact)| found - exact));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
    let every = FINE as usize;
    let finer = fine.temperature.iter().step_by(every);
    let temperature_error = largest(&mut run.temperature.iter().zip(finer).map(|(found, finer)| found - finer));
    Ok(HeatedAnswer { run, exact_level, level_error, temperature_error })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The vector of the source notes for Example 5, recomputed independently with a relative tolerance of 1e-10.
    #[test]
    fn level_and_temperature_of_example_5() {
        let answer = heated_tank(0.05 * level_slides::HOUR).unwrap();
        for (row, level, temperature) in
            [(2, 2.865_78, 538.304_3), (20, 5.451_02, 532.925_9), (200, 9.949_47, 530.397_2)]
        {
            assert!((answer.run.level[row] - level).abs() < 1e-5, "{}", answer.run.level[row]);
            assert!((answer.run.temperature[row] - temperature).abs() < 1e-3, "{}", answer.run.temperature[row]);
        }
        assert!((answer.exact_level[200] - 9.949_47).abs() < 1e-5);
    }

    #[test]
    fn half_the_step_has_about_a_sixteenth_of_the_error() {
        let error = |hours: f64| heated_tank(hours * level_slides::HOUR).unwrap().level_error;
        let ratio = error(1.0) / error(0.5);
        assert!((14.0..20.0).contains(&ratio), "{ratio}");
    }

    /// The method is stable up to 2.785 time constants (of 2 h).
    #[test]
    fn a_step_beyond_the_stable_ones_diverges() {
        assert!(!heated_tank(2.0 * level_slides::HOUR).unwrap().diverges());
        let beyond = heated_tank(0.5 * DURATION_S).unwrap();
        assert!(beyond.level_error > heated_tank(2.0 * level_slides::HOUR).unwrap().level_error, "{beyond:?}");
    }
}

use super::LevelRunError;
use crate::numeric::runge_kutta_step;
use crate::plant::level::HeatedTank;

/// A run of a heated tank at a constant inflow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeatedRun {
    /// Time (s).
    pub time_s: Vec<f64>,
    /// Level (m).
    pub level: Vec<f64>,
    /// Temperature (K).
    pub temperature: Vec<f64>,
}

/// Most steps of a run.
const MAX_STEPS: f64 = 1e5;

/// Level and temperature in steps (s) of the classical Runge–Kutta method, a row for each. The step is that of the method, so that
/// its error can be seen.
///
/// # Errors
/// [`LevelRunError`] for parameters without meaning, a start with an empty tank, or more than 10⁵ steps.
pub fn heated_run(
    tank: &HeatedTank,
    [level, temperature]: [f64; 2],
    inflow: f64,
    duration_s: f64,
    step_s: f64,
) -> Result<HeatedRun, LevelRunError> {
    tank.check()?;
    for (field, value) in
        [("level", level), ("temperature", temperature), ("duration_s", duration_s), ("step_s", step_s)]
    {
        if !(value > 0.0 && value.is_finite()) {
            return Err(LevelRunError::OutOfRange { field, value });
        }
    }
    if !(inflow >= 0.0 && inflow.is_finite()) {
        return Err(LevelRunError::OutOfRange { field: "inflow", value: inflow });
    }
    let steps = (duration_s / step_s * (1.0 + 1e-12)).floor();
    if steps > MAX_STEPS {
        return Err(LevelRunError::TooMuchWork { field: "step_s", steps, max: MAX_STEPS });
    }
    let mut run = HeatedRun { time_s: vec![0.0], level: vec![level], temperature: vec![temperature] };
    let mut state = [level, temperature];
    let mut row = 0.0;
    while row < steps {
        state = runge_kutta_step(|[level, temperature]| tank.rates(level, temperature, inflow), state, step_s);
        row += 1.0;
        run.time_s.push(row * step_s);
        run.level.push(state[0]);
        run.temperature.push(state[1]);
    }
    Ok(run)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::level_slides;

    #[test]
    fn an_empty_tank_and_a_step_of_nothing_are_refused() {
        let run = |start, step_s| heated_run(&level_slides::heated_tank(), start, 1e-3, 3600.0, step_s);
        assert_eq!(run([0.0, 540.0], 36.0), Err(LevelRunError::OutOfRange { field: "level", value: 0.0 }));
        assert_eq!(run([1.0, 540.0], 0.0), Err(LevelRunError::OutOfRange { field: "step_s", value: 0.0 }));
        assert!(matches!(run([1.0, 540.0], 1e-3), Err(LevelRunError::TooMuchWork { .. })));
        assert_eq!(run([1.0, 540.0], 36.0).unwrap().level.len(), 101);
    }
}

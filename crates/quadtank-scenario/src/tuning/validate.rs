use crate::limits::{self, Limits};
use crate::{ScenarioError, validate};

use quadtank::study::relay_tuning::{Element, ResponseSpec, TestSpec, TunedTank, TuningPlant, TuningSetup};

type Checked = Result<(), ScenarioError>;

/// Checks what has to hold between the numbers of the session at a path.
pub fn setup(setup: &TuningSetup, at: &str) -> Checked {
    plant(&setup.plant, &format!("{at}.plant"))?;
    test(&setup.test, &format!("{at}.test"))?;
    response(&setup.response, &format!("{at}.response"))?;
    pace(setup, at)
}

fn plant(plant: &TuningPlant, at: &str) -> Checked {
    if let Some(tank) = plant.tank() {
        no_delay(&tank, &format!("{at}.{}", name_of_tank(plant)))?;
    }
    match plant {
        TuningPlant::Elements(rows) => {
            validate::each(rows, &format!("{at}.elements"), |row, at| validate::each(row, at, element))
        }
        TuningPlant::Parameters { rig, .. } => validate::rig(rig, &format!("{at}.parameters.rig")),
        TuningPlant::Published(_) | TuningPlant::QuadrupleTank { .. } => Ok(()),
    }
}

/// How documents call a plant with a quadruple tank.
pub fn name_of_tank(plant: &TuningPlant) -> &'static str {
    if matches!(plant, TuningPlant::Parameters { .. }) { "parameters" } else { "quadruple_tank" }
}

/// The nonlinear plant has neither dead time nor lag, and no hose.
fn no_delay(tank: &TunedTank, at: &str) -> Checked {
    if !tank.nonlinear {
        return Ok(());
    }
    let none = Limits::new(0.0, 0.0);
    none.check(&format!("{at}.dead_time_s"), tank.dead_time_s)?;
    none.check(&format!("{at}.lag_s"), tank.lag_s)?;
    validate::each(&tank.rig.pumps, &format!("{at}.rig.pumps"), |pump, at| {
        none.check(&format!("{at}.delay_s"), pump.delay_s)
    })
}

fn element(element: &Element, at: &str) -> Checked {
    validate::each(&element.numerator, &format!("{at}.numerator"), |&value, at| coefficient(value, at))?;
    validate::each(&element.denominator, &format!("{at}.denominator"), |&value, at| coefficient(value, at))?;
    match element.fault() {
        Some(fault) => Err(ScenarioError::Element { field: at.to_owned(), fault }),
        None => Ok(()),
    }
}

fn coefficient(value: f64, at: &str) -> Checked {
    if value == 0.0 { Ok(()) } else { limits::COEFFICIENT_MAGNITUDE.check(at, value.abs()) }
}

fn test(test: &TestSpec, at: &str) -> Checked {
    Limits::new(0.0, test.duration).check(&format!("{at}.release"), test.release)?;
    limits::row_step(test.duration).check(&format!("{at}.step"), test.step)?;
    let rows = test.passes as f64 * test.duration / test.step;
    limits::ROWS_OF_ALL.check(&format!("{at}: passes * duration / step"), rows)
}

fn response(response: &ResponseSpec, at: &str) -> Checked {
    limits::row_step(response.duration).check(&format!("{at}.step"), response.step)
}

/// The quickest part of the plant can be followed over the longest record and over its dead times.
fn pace(setup: &TuningSetup, at: &str) -> Checked {
    // A plant that cannot be built has no rates to check; `PlantStudy::of` reports why.
    let (quickest, dead_time) = setup.plant.fastest_rate_and_dead_time().unwrap_or_default();
    let longest = setup.test.duration.max(setup.response.duration);
    limits::QUICKEST_IN_RECORD.check(&format!("{at}.plant: quickest pole * duration"), quickest * longest)?;
    limits::QUICKEST_IN_DEAD_TIME.check(&format!("{at}.plant: quickest pole * dead time"), quickest * dead_time)
}

//! The moment that drawing, valve plane and s-plane show.

use crate::benches::quadruple_tank;
use quadtank::linear::LinearError;
use quadtank::plant::{OperatingPoint, QuadrupleTank};
use quadtank::study::LinearPlant;
use quadtank::study::model_free::{ModelFreeAnswer, ModelFreeSetup};

/// A moment of a run with what theory says of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Shown {
    /// When (s).
    pub time_s: f64,
    /// Levels and voltages.
    pub state: quadruple_tank::RigState,
    /// The rig with its valves as they stand.
    pub plant: QuadrupleTank,
    /// Poles, zeros, relative gain and Niederlinski index.
    pub theory: Result<LinearPlant, LinearError>,
}

impl Shown {
    /// The moment at the cursor (s), or at the end of the run.
    pub fn of(setup: &ModelFreeSetup, answer: &ModelFreeAnswer, cursor_s: Option<f64>) -> Option<Self> {
        let run = &answer.run.trajectory;
        let row = run.row_at(cursor_s.unwrap_or(f64::INFINITY))?;
        let time_s = run.time_s[row];
        let levels = run.levels.each_ref().map(|column| column[row]);
        let pump_voltage = run.pump_voltage.each_ref().map(|column| column[row]);
        let plant = setup.plant_at(time_s);
        let theory = LinearPlant::of(&plant.linearise(&OperatingPoint { levels, pump_voltage }));
        Some(Self {
            time_s,
            state: quadruple_tank::RigState { time_s: Some(time_s), levels, pump_voltage },
            plant,
            theory,
        })
    }
}

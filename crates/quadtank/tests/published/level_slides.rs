//! The lecture slides on a level tank: parameters, loop gain, closed forms and vectors.

use quadtank::literature::level_slides::{self, MINUTE};
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::within;

/// §1.2: area, time constant, valve, sensor and loop gain, in minutes as printed.
#[test]
fn data_of_the_control_example() {
    let plant = level_slides::plant();
    within(plant.tank.area, 0.785, 0.5e-3, "area");
    let model = plant.tank.linearise(1.0);
    within(model.time_constant().unwrap() / MINUTE, 5.0, 0.005, "τ (min)");
    within(plant.flows(0.0, 1.0)[0] * MINUTE, 0.1545, 1e-9, "flow of the open valve (m³/min)");
    within(plant.transmitter.signal_of(3.0), 15.0, 1e-9, "signal at 3 m (psi)");
    let gains = plant.gains(&plant.rest(0.5, 0.0).unwrap());
    within(gains.process_gain().unwrap(), 0.328_06, 0.5e-5, "Kv Kp Km");
    // The open valve alone holds at most 0.984 m: a set-point of 1 m cannot be reached without q1.
    within(plant.level_at_output(15.0, 0.0).unwrap(), 0.984, 0.5e-3, "highest level (m)");
    assert!(plant.rest(1.0, 0.0).is_err());
}

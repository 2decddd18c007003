//! Andreis (2017): the plant at rest and its linear models.

use quadtank::literature::andreis::{self, NOMINAL_INFLOW, NOMINAL_LEVEL, STEP_TEST_INFLOW};
use quadtank::plant::level::LevelSignals;
#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use crate::within;

fn nominal() -> LevelSignals {
    andreis::plant().rest(NOMINAL_LEVEL, NOMINAL_INFLOW).unwrap()
}

/// Signals at rest: half a unit of the last printed digit.
#[test]
fn tables_4_1_and_4_2() {
    let rest = nominal();
    within(rest.measured, 12.0, 1e-12, "transmitter output");
    within(rest.output, 7.3540, 0.5e-4, "manual output");
    within(rest.pressure, 5.5155, 0.5e-4, "I/P output");
    within(rest.travel, 0.8323, 0.5e-4, "actuator output");
    within(rest.opening, 0.565_312, 0.5e-6, "f(X)");
    let plant = andreis::plant();
    within(plant.flows(2.0, 1.0)[0], 0.0425, 0.5e-4, "largest valve flow");
    within(plant.flows(1.0, 1.0 / 30.0)[1], 0.001_002_4, 0.5e-7, "leak of the closed valve");
    // K_V from gpm/√psi to m³/s, with water of 999 kg/m³: 2.40151e-5, two units of the last digit off.
    within(6.309_02e-5 * (999.0_f64 / 6_894.757).sqrt(), 2.401_53e-5, 2e-10, "K_V");
}

/// The bias of the step test (§4.2.7.1) needs the inflow of Appendix B, not that of Table 4.2.
#[test]
fn bias_of_the_step_test() {
    let rest = andreis::plant().rest(NOMINAL_LEVEL, STEP_TEST_INFLOW).unwrap();
    within(rest.output, 11.652, 0.5e-3, "output (mA)");
    let share = 100.0 * andreis::plant().output.signal.share(rest.output);
    within(share, 47.83, 0.5e-2, "output (%)");
    let other = 100.0 * andreis::plant().output.signal.share(nominal().output);
    within(other, 20.96, 0.5e-2, "output at 0.017 m³/s (%)");
}

/// Eqs. 64 to 69 at four operating points: R, τ and K, computed a second time outside this program.
#[test]
fn linear_models() {
    let plant = andreis::plant();
    let rows = [(0.017, 1.0, 117.65, 2.721), (0.006, 1.0, 333.33, 4.081), (0.006, 1.92, 640.0, 7.836)];
    for (inflow, level, resistance, gain) in rows {
        let gains = plant.gains(&plant.rest(level, inflow).unwrap());
        within(gains.resistance.unwrap(), resistance, 0.5e-2, "R");
        within(gains.time_constant().unwrap(), resistance, 0.5e-2, "τ");
        within(gains.process_gain().unwrap(), gain, 1e-3, "K");
    }
    // K/τ at the point of the simulations is 2.4 times that of the tuning.
    let slope = plant.gains(&nominal()).slope_gain();
    within(slope, 0.02313, 0.5e-5, "K/τ");
    within(slope / (5.75 / 588.0), 2.4, 0.05, "ratio to the thesis");
}

//! Lecture slides on the control of a level tank: a linear tank with valve and sensor, four PID settings, and a heated tank.

use std::f64::consts::PI;

use crate::control::ParallelPid;
use crate::plant::level::{
    Actuator, ActuatorCurve, Characteristic, ControlValve, HeatedTank, LevelPlant, LevelTank, Outflow, OutputStage,
    SignalRange, Transmitter, ValvePlace,
};

/// One minute (s), the unit of time of the control example.
pub const MINUTE: f64 = 60.0;
/// One hour (s), the unit of time of the examples without control.
pub const HOUR: f64 = 3600.0;

/// Inflow of the examples without control (m³/s): 10 m³/h.
pub const INFLOW: f64 = 10.0 / HOUR;
/// Inflow of the heated tank (m³/s).
pub const HEATED_INFLOW: f64 = INFLOW;
/// Level (m) and temperature (K) at which the heated tank starts: 5/A and `T_H`.
pub const HEATED_START: [f64; 2] = [2.5, 540.0];
/// Time constant of the derivative filter of the Simulink block with its default coefficient of 100 per minute (s).
pub const DERIVATIVE_FILTER_S: f64 = MINUTE / 100.0;

/// The tank of the control example: 1 m wide, R = 6.37 min/m², a linear valve in the feed q2 that gives 0.0103 m³/min per psi from
/// 0 to 15 psi, a sensor of 5 psi/m. The height of the tank is the range of the sensor, 3 m; signals end at 0 and 15 psi.
pub fn plant() -> LevelPlant {
    LevelPlant {
        tank: LevelTank { area: PI / 4.0, height: 3.0, outflow: Outflow::Linear { resistance: 6.37 * MINUTE } },
        transmitter: Transmitter {
            level_range: [0.0, 3.0],
            signal: SignalRange::PNEUMATIC_FROM_ZERO,
            lag_s: 0.0,
            clips: true,
        },
        output: OutputStage { signal: SignalRange::PNEUMATIC_FROM_ZERO, clips: true },
        converter: None,
        actuator: Actuator { lag_s: 0.0, curve: ActuatorCurve(vec![[0.0, 0.0], [15.0, 1.0]]) },
        valve: ControlValve {
            characteristic: Characteristic::Linear,
            place: ValvePlace::Inlet { full_flow: 0.0103 * 15.0 / MINUTE },
        },
    }
}

/// The four settings to try, (P, I, D) of a parallel PID with I in 1/min and D in min, here in seconds.
pub fn settings() -> [ParallelPid; 4] {
    [[2.0, 0.0, 0.0], [2.0, 25.0, 0.0], [2.0, 1.0, 0.0], [2.0, 1.0, 5.0]].map(|[p, i, d]| ParallelPid {
        proportional: p,
        integral: i / MINUTE,
        derivative: d * MINUTE,
        filter: None,
    })
}

/// The tank of Examples 3 and 4: R = 1 h/m², A = 2 m².
pub fn draining_tank() -> LevelTank {
    LevelTank { area: 2.0, height: 10.0, outflow: Outflow::Linear { resistance: HOUR } }
}

/// The heated tank of Example 5. U is printed as 150 kJ/(m² s K); the code of the slides takes it per hour, which is meant here.
pub fn heated_tank() -> HeatedTank {
    HeatedTank {
        tank: draining_tank(),
        inflow_temperature: 530.0,
        heater_temperature: 540.0,
        heat_transfer: 150e3 / HOUR,
        density: 1000.0,
        heat_capacity: 750.0,
    }
}

use crate::plant::level::{
    Actuator, ActuatorCurve, Characteristic, ControlValve, Converter, LevelPlant, LevelTank, Outflow, OutputStage,
    SignalRange, Transmitter, ValvePlace,
};
use crate::tuning::PiTuning;

/// Level of all experiments (m), Table 4.2.
pub const NOMINAL_LEVEL: f64 = 1.0;
/// Inflow that all experiments of chapter 5 start with (m³/s), Table 4.2.
pub const NOMINAL_INFLOW: f64 = 0.017;
/// Inflow of the step test of §4.2.7.1 (m³/s), printed in Appendix B alone: another operating point than that of chapter 5.
pub const STEP_TEST_INFLOW: f64 = 0.006;
/// `C_V` of the valve (gpm/√psi), Table 4.1.
pub const VALVE_COEFFICIENT: f64 = 400.0;
/// `C_V` of the model with errors, §5.1.
pub const UNCERTAIN_VALVE_COEFFICIENT: f64 = 380.0;
/// Area of the model with errors (m²), §5.1.
pub const UNCERTAIN_AREA: f64 = 1.1;
/// The controller of the plant as it is, §5.1.
pub const CURRENT_TUNING: PiTuning = PiTuning { gain: 10.0, integral_time_s: 2500.0 };

/// `K_V`, from gpm/√psi to m³/s, Table 4.1.
const UNIT_FACTOR: f64 = 2.401_53e-5;
/// Acceleration of gravity (m/s²), Table 4.1.
const GRAVITY: f64 = 9.8;

/// The plant of Tables 4.1 and 4.2 and Appendices A and B: 1 m², 2 m, a valve in the outlet with
/// `q = K_V C_V 30^(X − 1) √(g h)` (Eq. 84 with equal pressures above the tank and behind the valve).
pub fn plant() -> LevelPlant {
    LevelPlant {
        tank: LevelTank {
            area: 1.0,
            height: 2.0,
            outflow: Outflow::SquareRoot { coefficient: UNIT_FACTOR * VALVE_COEFFICIENT * GRAVITY.sqrt() },
        },
        transmitter: Transmitter { level_range: [0.0, 2.0], signal: SignalRange::CURRENT, lag_s: 0.5, clips: true },
        output: OutputStage { signal: SignalRange::CURRENT, clips: true },
        converter: Some(Converter { input: SignalRange::CURRENT, output: SignalRange::PNEUMATIC }),
        actuator: Actuator {
            lag_s: 5.0,
            curve: ActuatorCurve(vec![[3.0, 1.0], [6.0, 0.8], [9.0, 0.5], [12.0, 0.2], [15.0, 0.0]]),
        },
        valve: ControlValve {
            characteristic: Characteristic::EqualPercentage { rangeability: 30.0 },
            place: ValvePlace::Outlet,
        },
    }
}

/// The model "with uncertainties" of §5.1: another area and another valve.
pub fn uncertain_plant() -> LevelPlant {
    plant().with_model_error(UNCERTAIN_AREA, UNCERTAIN_VALVE_COEFFICIENT / VALVE_COEFFICIENT)
}

use serde::{Deserialize, Serialize};

use super::error::within;
use super::{Actuator, ControlValve, Converter, LevelError, LevelTank, OutputStage, Transmitter, ValvePlace};

/// A tank with its instruments, everything but the controller.
///
/// The signal path is level → transmitter → (controller) → output → converter → actuator → valve → flow. Each element can be
/// switched off: a lag by 0 s, a limit by `clips`, the converter by `None`, a curve or a characteristic by a linear one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct LevelPlant {
    /// The tank, with the outflow of an open valve where the valve is in the outlet.
    pub tank: LevelTank,
    /// Level to measured signal.
    pub transmitter: Transmitter,
    /// Range of the controller output.
    pub output: OutputStage,
    /// Controller output to actuator pressure; `None` where the output drives the actuator itself.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub converter: Option<Converter>,
    /// Pressure to travel.
    pub actuator: Actuator,
    /// Travel to flow.
    pub valve: ControlValve,
}

/// The values of all signals of a level loop at one moment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelSignals {
    /// Disturbed inflow (m³/s), without that of a valve in the inlet.
    pub inflow: f64,
    /// Flow through the control valve (m³/s).
    pub valve_flow: f64,
    /// Outflow of the tank (m³/s); the same as the flow of the valve where that is in the outlet.
    pub outflow: f64,
    /// Level (m).
    pub level: f64,
    /// Signal that the transmitter sends.
    pub measured: f64,
    /// Controller output.
    pub output: f64,
    /// Pressure behind the converter; the output itself without one.
    pub pressure: f64,
    /// Pressure that acts in the actuator, behind its lag.
    pub actuator_pressure: f64,
    /// Travel X of the valve, 0 to 1.
    pub travel: f64,
    /// Opening f(X), 0 to 1.
    pub opening: f64,
}

impl LevelPlant {
    /// Refuses parameters without meaning.
    ///
    /// # Errors
    /// [`LevelError::OutOfRange`] with the first of them, [`LevelError::ActuatorCurve`].
    pub fn check(&self) -> Result<(), LevelError> {
        self.tank.check()?;
        self.transmitter.check()?;
        self.output.check()?;
        self.converter.map_or(Ok(()), |converter| converter.check())?;
        self.actuator.check()?;
        self.valve.check()
    }

    /// Pressure behind the converter for a controller output.
    pub fn pressure(&self, output: f64) -> f64 {
        self.converter.map_or(output, |converter| converter.convert(output))
    }

    /// Flows at a level and an opening: through the valve, and out of the tank (m³/s).
    pub fn flows(&self, level: f64, opening: f64) -> [f64; 2] {
        let open = self.tank.outflow.flow(level);
        match self.valve.place {
            ValvePlace::Outlet => [open * opening; 2],
            ValvePlace::Inlet { full_flow } => [full_flow * opening, open],
        }
    }

    /// All signals that follow from the level, the two lagged signals, the output and the inflow.
    pub fn signals(
        &self,
        level: f64,
        transmitted: f64,
        output: f64,
        actuator_pressure: f64,
        inflow: f64,
    ) -> LevelSignals {
        let travel = self.actuator.curve.travel(actuator_pressure);
        let opening = self.valve.characteristic.opening(travel);
        let [valve_flow, outflow] = self.flows(level, opening);
        LevelSignals {
            inflow,
            valve_flow,
            outflow,
            level,
            measured: self.transmitter.sent(transmitted),
            output,
            pressure: self.pressure(output),
            actuator_pressure,
            travel,
            opening,
        }
    }

    /// The signals at rest with a level (m) and an inflow (m³/s); its output is the bias of the controller (Andreis 2017,
    /// Eqs. 85, 86).
    ///
    /// # Errors
    /// [`LevelError::LevelOutsideTank`], [`LevelError::NegativeFlow`]; [`LevelError::ValveOutOfReach`] and
    /// [`LevelError::OutputOutOfReach`] where the loop cannot hold that level; what [`check`](Self::check) finds.
    pub fn rest(&self, level: f64, inflow: f64) -> Result<LevelSignals, LevelError> {
        self.check()?;
        if !(level >= 0.0 && level <= self.tank.height) {
            return Err(LevelError::LevelOutsideTank { value: level, height: self.tank.height });
        }
        within("inflow", inflow, -f64::MAX, f64::MAX)?;
        if inflow < 0.0 {
            return Err(LevelError::NegativeFlow { value: inflow });
        }
        let open = self.tank.outflow.flow(level);
        let opening = match self.valve.place {
            ValvePlace::Outlet => inflow / open,
            ValvePlace::Inlet { full_flow } => (open - inflow) / full_flow,
        };
        let travel = self.valve.characteristic.travel(opening)?;
        let curve = &self.actuator.curve;
        let pressure = curve.pressure(travel).ok_or_else(|| self.unreachable(opening))?;
        let output = self.converter.map_or(pressure, |converter| converter.invert(pressure));
        let range = self.output.signal;
        // Rounding of the converter alone does not put an output beyond its range.
        let slack = 1e-12 * range.span();
        if self.output.clips && !(output >= range.low - slack && output <= range.high + slack) {
            return Err(LevelError::OutputOutOfReach { needed: output, min: range.low, max: range.high });
        }
        Ok(self.signals(level, self.transmitter.signal_of(level), output, pressure, inflow))
    }

    /// Level at which the tank comes to rest with a held output (m), which may be beyond its walls; `None` where it has none, as
    /// with pumped outflow.
    pub fn level_at_output(&self, output: f64, inflow: f64) -> Option<f64> {
        let travel = self.actuator.curve.travel(self.pressure(self.output.sent(output)));
        let opening = self.valve.characteristic.opening(travel);
        match self.valve.place {
            ValvePlace::Outlet => self.tank.outflow.scaled(opening).level_for(inflow),
            ValvePlace::Inlet { full_flow } => self.tank.outflow.level_for(inflow + full_flow * opening),
        }
    }

    /// The same loop with another area (m²) and with all flows of the tank multiplied by a factor: the model error of Andreis
    /// (2017, §5.1), whose factor is the ratio of the valve coefficients.
    #[must_use]
    pub fn with_model_error(&self, area: f64, flow_factor: f64) -> Self {
        let tank = LevelTank { area, outflow: self.tank.outflow.scaled(flow_factor), ..self.tank };
        Self { tank, ..self.clone() }
    }

    /// The error for a valve opening outside the range of the actuator curve.
    fn unreachable(&self, needed: f64) -> LevelError {
        let travels = || self.actuator.curve.0.iter().map(|point| point[1]);
        let (low, high) = (travels().fold(1.0, f64::min), travels().fold(0.0, f64::max));
        let [min, max] = [low, high].map(|travel| self.valve.characteristic.opening(travel));
        LevelError::ValveOutOfReach { needed, min, max }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::literature::{andreis, level_slides};
    use crate::plant::level::{Characteristic, Outflow};

    #[test]
    fn at_rest_all_flows_balance_and_every_element_passes_its_signal_on() {
        for plant in [andreis::plant(), level_slides::plant()] {
            let rest = plant.rest(0.5, 0.0011).unwrap();
            let fed = if matches!(plant.valve.place, ValvePlace::Outlet) { 0.0 } else { rest.valve_flow };
            assert_relative_eq!(rest.inflow + fed, rest.outflow, max_relative = 1e-12);
            assert_relative_eq!(rest.pressure, rest.actuator_pressure, max_relative = 1e-12);
            assert_relative_eq!(plant.level_at_output(rest.output, rest.inflow).unwrap(), 0.5, max_relative = 1e-12);
        }
    }

    #[test]
    fn what_the_loop_cannot_hold_is_refused_with_its_value() {
        let plant = andreis::plant();
        assert_eq!(plant.rest(2.5, 0.017), Err(LevelError::LevelOutsideTank { value: 2.5, height: 2.0 }));
        assert_eq!(plant.rest(-0.1, 0.017), Err(LevelError::LevelOutsideTank { value: -0.1, height: 2.0 }));
        assert!(matches!(plant.rest(f64::NAN, 0.017), Err(LevelError::LevelOutsideTank { .. })));
        assert_eq!(plant.rest(1.0, -0.01), Err(LevelError::NegativeFlow { value: -0.01 }));
        // More than the open valve carries, and less than it leaks; an empty tank carries nothing.
        assert!(matches!(plant.rest(1.0, 0.031), Err(LevelError::ValveOutOfReach { needed, .. }) if needed > 1.0));
        assert!(
            matches!(plant.rest(1.0, 0.001), Err(LevelError::ValveOutOfReach { needed, .. }) if needed < 1.0 / 30.0)
        );
        assert!(
            matches!(plant.rest(0.0, 0.017), Err(LevelError::ValveOutOfReach { needed, .. }) if needed.is_infinite())
        );
        let mut narrow = andreis::plant();
        narrow.output.signal.low = 8.0;
        assert!(matches!(narrow.rest(1.0, 0.017), Err(LevelError::OutputOutOfReach { max: 20.0, .. })));
        narrow.output.clips = false;
        assert!(narrow.rest(1.0, 0.017).is_ok());
        let mut stuck = andreis::plant();
        stuck.actuator.curve.0.truncate(2);
        assert!(matches!(stuck.rest(1.0, 0.002), Err(LevelError::ValveOutOfReach { max: 1.0, .. })));
    }

    #[test]
    fn parameters_without_meaning_are_named() {
        let broken = |change: fn(&mut LevelPlant)| {
            let mut plant = andreis::plant();
            change(&mut plant);
            match plant.rest(1.0, 0.017) {
                Err(LevelError::OutOfRange { field, .. }) => field,
                other => panic!("{other:?}"),
            }
        };
        assert_eq!(broken(|plant| plant.tank.area = 0.0), "area");
        assert_eq!(broken(|plant| plant.tank.height = f64::NAN), "height");
        assert_eq!(broken(|plant| plant.tank.outflow = Outflow::SquareRoot { coefficient: -1.0 }), "coefficient");
        assert_eq!(broken(|plant| plant.transmitter.level_range = [1.0, 1.0]), "level_range");
        assert_eq!(broken(|plant| plant.transmitter.lag_s = -1.0), "lag_s");
        assert_eq!(
            broken(|plant| plant.valve.characteristic = Characteristic::EqualPercentage { rangeability: 1.0 }),
            "rangeability"
        );
        assert_eq!(broken(|plant| plant.valve.place = ValvePlace::Inlet { full_flow: 0.0 }), "full_flow");
    }
}

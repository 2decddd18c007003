use super::{LevelPlant, LevelSignals, ValvePlace};

/// The linear model of a level loop around a rest: in signals of output and transmitter,
/// `G(s) = K/((τ s + 1)(τ_a s + 1)(τ_t s + 1))`, with `K'/s` in the place of `K/(τ s + 1)` for a tank that integrates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelGains {
    /// Cross-section A (m²).
    pub area: f64,
    /// Resistance R at the level and the opening of the rest (s/m²); `None` for a tank that integrates.
    pub resistance: Option<f64>,
    /// Net flow into the tank per unit of controller output (m³/s per signal).
    pub flow_gain: f64,
    /// Signal per metre of level.
    pub transmitter_gain: f64,
    /// Lag `τ_a` of the actuator (s).
    pub actuator_lag_s: f64,
    /// Lag `τ_t` of the transmitter (s).
    pub transmitter_lag_s: f64,
}

impl LevelPlant {
    /// The linear model around a rest. Where the actuator stands on a point of its curve, the segment above it counts.
    pub fn gains(&self, rest: &LevelSignals) -> LevelGains {
        let per_pressure =
            self.valve.characteristic.slope(rest.travel) * self.actuator.curve.slope(rest.actuator_pressure);
        let per_output = per_pressure * self.converter.map_or(1.0, |converter| converter.gain());
        let open = self.tank.outflow;
        let (law, flow_gain) = match self.valve.place {
            ValvePlace::Outlet => (open.scaled(rest.opening), -open.flow(rest.level) * per_output),
            ValvePlace::Inlet { full_flow } => (open, full_flow * per_output),
        };
        LevelGains {
            area: self.tank.area,
            resistance: law.resistance(rest.level),
            flow_gain,
            transmitter_gain: self.transmitter.gain(),
            actuator_lag_s: self.actuator.lag_s,
            transmitter_lag_s: self.transmitter.lag_s,
        }
    }
}

impl LevelGains {
    /// `τ = R A` (s); `None` for a tank that integrates.
    pub fn time_constant(&self) -> Option<f64> {
        Some(self.resistance? * self.area)
    }

    /// K, transmitter signal per unit of output at rest; `None` for a tank that integrates.
    pub fn process_gain(&self) -> Option<f64> {
        Some(self.flow_gain * self.resistance? * self.transmitter_gain)
    }

    /// `K' = K/τ`, the slope of the transmitter signal per unit of output (1/s); it stays finite for a tank that integrates.
    pub fn slope_gain(&self) -> f64 {
        self.flow_gain * self.transmitter_gain / self.area
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use crate::literature::{andreis, level_slides};
    use crate::plant::level::Outflow;

    #[test]
    fn the_gain_is_the_slope_of_the_level_at_rest_over_the_output() {
        for (plant, inflow) in [(andreis::plant(), 0.017), (andreis::plant(), 0.006), (level_slides::plant(), 0.0005)] {
            let rest = plant.rest(0.7, inflow).unwrap();
            let level = |output: f64| plant.level_at_output(output, inflow).unwrap();
            let slope = (level(rest.output + 1e-5) - level(rest.output - 1e-5)) / 2e-5;
            let gains = plant.gains(&rest);
            assert_relative_eq!(gains.process_gain().unwrap(), slope * gains.transmitter_gain, max_relative = 1e-7);
            let ratio = gains.process_gain().unwrap() / gains.time_constant().unwrap();
            assert_relative_eq!(gains.slope_gain(), ratio, max_relative = 1e-14);
        }
    }

    #[test]
    fn a_pumped_tank_has_a_slope_and_no_gain() {
        let mut plant = andreis::plant();
        plant.tank.outflow = Outflow::Pumped { flow: 0.03 };
        let gains = plant.gains(&plant.rest(1.0, 0.017).unwrap());
        assert_eq!((gains.process_gain(), gains.time_constant()), (None, None));
        // The same valve carries the same flow, so its slope is that of the self-regulating tank.
        let valve = andreis::plant();
        let expected = valve.gains(&valve.rest(1.0, 0.017).unwrap()).slope_gain();
        assert_relative_eq!(gains.slope_gain(), expected, max_relative = 1e-12);
    }
}

use super::{Fields, ITSELF, Part, names};
use crate::limits::{self, Limits};
use quadtank::plant::{CrossSection, DisplayUnit, Outlet, PresetId, Pump, QuadrupleTank, Sensor, Tank, ValveSchedule};

impl Part for PresetId {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.name(self, &Self::ALL.map(|id| (id.name(), id)));
    }
}

names!(DisplayUnit: "cm" Cm, "mm" Mm);

impl Part for QuadrupleTank {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.part("tanks", &mut self.tanks);
        f.part("pumps", &mut self.pumps);
        f.pair("valves", &mut self.valves, limits::VALVE);
        f.number("power_gain", &mut self.power_gain, limits::POWER_GAIN);
        f.part("sensor", &mut self.sensor);
        f.number("gravity", &mut self.gravity, limits::GRAVITY);
    }
}

/// A tank must not close above its bottom, nor be all outlet.
impl Part for Tank {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.part("section", &mut self.section);
        f.part("outlet", &mut self.outlet);
        f.number("height", &mut self.height, limits::TANK_HEIGHT);

        let (area, slope) = (self.section.area_at_empty, self.section.area_slope);
        let narrowest = (limits::TANK_AREA.min - area) / self.height;
        f.check("section.area_slope", slope, Limits { min: narrowest, ..limits::TANK_AREA_SLOPE });
        let widest_outlet = limits::OUTLET_SHARE * area.min(area + slope * self.height);
        let outlet = Limits { max: limits::OUTLET_AREA.max.min(widest_outlet), ..limits::OUTLET_AREA };
        f.check("outlet.area", self.outlet.area, outlet);
    }
}

impl Part for CrossSection {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("area_at_empty", &mut self.area_at_empty, limits::TANK_AREA);
        f.number("area_slope", &mut self.area_slope, limits::TANK_AREA_SLOPE);
    }
}

impl Part for Outlet {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("area", &mut self.area, limits::OUTLET_AREA);
        f.number("loss_coefficient", &mut self.loss_coefficient, limits::LOSS_COEFFICIENT);
    }
}

impl Part for Pump {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("gain", &mut self.gain, limits::PUMP_GAIN);
        f.number("voltage_min", &mut self.voltage_min, limits::PUMP_VOLTAGE);
        f.number("voltage_max", &mut self.voltage_max, limits::PUMP_VOLTAGE);
        f.check("voltage_max", self.voltage_max, Limits { min: self.voltage_min, ..limits::PUMP_VOLTAGE });
    }
}

impl Part for Sensor {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("gain", &mut self.gain, limits::SENSOR_GAIN);
        f.number("range", &mut self.range, limits::SENSOR_RANGE);
        f.number("resolution", &mut self.resolution, limits::SENSOR_RESOLUTION);
        if self.resolution != 0.0 {
            let least = Limits { min: limits::LEAST_SENSOR_RESOLUTION, ..limits::SENSOR_RESOLUTION };
            f.check("resolution", self.resolution, least);
        }
    }
}

/// γ stays in [0, 1] whatever the time.
impl Part for ValveSchedule {
    fn fields(&mut self, f: &mut Fields<'_>) {
        const ZERO: f64 = 0.0;
        let table = [
            ("constant", Self::Constant { gamma: ZERO }),
            ("step", Self::Step { from: ZERO, to: ZERO, at_s: ZERO }),
            ("ramp", Self::Ramp { from: ZERO, to: ZERO, begin_s: ZERO, end_s: ZERO }),
            ("sine", Self::Sine { mean: ZERO, amplitude: ZERO, frequency: ZERO, phase: ZERO }),
        ];
        f.choice(self, &table, |valve, f| match valve {
            Self::Constant { gamma } => f.number("gamma", gamma, limits::VALVE),
            Self::Step { from, to, at_s } => {
                f.number("from", from, limits::VALVE);
                f.number("to", to, limits::VALVE);
                f.number("at_s", at_s, limits::TIME_S);
            }
            Self::Ramp { from, to, begin_s, end_s } => {
                f.number("from", from, limits::VALVE);
                f.number("to", to, limits::VALVE);
                f.number("begin_s", begin_s, limits::TIME_S);
                f.number("end_s", end_s, limits::TIME_S);
                f.check("end_s", *end_s, Limits { min: *begin_s, ..limits::TIME_S });
            }
            Self::Sine { mean, amplitude, frequency, phase } => {
                f.number("mean", mean, limits::VALVE);
                f.number("amplitude", amplitude, limits::VALVE_AMPLITUDE);
                f.number("frequency", frequency, limits::VALVE_FREQUENCY);
                f.number("phase", phase, limits::VALVE_PHASE);
            }
        });
        let (lowest, highest) = self.extremes();
        f.check(ITSELF, lowest, limits::VALVE);
        f.check(ITSELF, highest, limits::VALVE);
    }
}

use super::experiment::check_duration;
use super::{Fields, ITSELF, Part};
use crate::limits::{self, Limits};
use crate::{OperatingPointSpec, PlantSpec, Scenario, Setup, View, setup_of};
use quadtank::plant::{DisplayUnit, PresetId};

/// The rig that blanks are made of: any would do.
const ANY: PresetId = PresetId::JohanssonMinimumPhase;

impl Part for Scenario {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.version(&mut self.version, Self::VERSION);
        f.part("setup", &mut self.setup);
        let list = f.hidden_if(self.pinned.is_empty());
        list.list("pinned", &mut self.pinned, Self::MAX_PINNED, || setup_of(ANY), Part::fields);
        f.spare().part("view", &mut self.view);
    }
}

impl Part for Setup {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.part("plant", &mut self.plant);
        f.pair("valves", &mut self.valves, limits::VALVE);
        f.part("operating_point", &mut self.operating_point);
        f.part("controller", &mut self.controller);
        f.part("experiment", &mut self.experiment);
        check_duration(f, &self.experiment, self.controller.sampling_time_s);
    }
}

impl Part for PlantSpec {
    fn fields(&mut self, f: &mut Fields<'_>) {
        let own = Self::Parameters { rig: ANY.preset().plant, display_unit: DisplayUnit::Cm };
        f.choice(self, &[("preset", Self::Preset(ANY)), ("parameters", own)], |plant, f| match plant {
            Self::Preset(id) => id.fields(f),
            Self::Parameters { rig, display_unit } => {
                f.part("rig", rig);
                f.part("display_unit", display_unit);
            }
        });
    }
}

impl Part for OperatingPointSpec {
    fn fields(&mut self, f: &mut Fields<'_>) {
        let table = [("pump_voltage", Self::PumpVoltage([0.0; 2])), ("levels", Self::Levels([0.0; 2]))];
        f.choice(self, &table, |point, f| match point {
            Self::PumpVoltage(voltage) => f.pair(ITSELF, voltage, limits::PUMP_VOLTAGE),
            Self::Levels(levels) => f.pair(ITSELF, levels, limits::LEVEL),
        });
    }
}

impl Part for View {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.option("cursor_s", &mut self.cursor_s, f64::default, |time, f| f.number(ITSELF, time, limits::TIME_S));
        f.option("zoom_s", &mut self.zoom_s, Default::default, |zoom, f| {
            f.pair(ITSELF, zoom, limits::TIME_S);
            f.check("[1]", zoom[1], Limits { min: zoom[0], ..limits::TIME_S });
        });
        f.spare().flag("hide_linear", &mut self.hide_linear);
    }
}

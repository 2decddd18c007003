use super::{Fields, Part};
use crate::limits;
use quadtank::sim::{Experiment, Load, LoadStep, Measurement, SetPointStep};

/// How long it may last depends on the sampling time, which is not in it: see [`check_duration`].
impl Part for Experiment {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("duration_s", &mut self.duration_s, limits::DURATION_S);
        let no_step = || SetPointStep { level: 0, time_s: 0.0, size: 0.0 };
        f.list("set_point_steps", &mut self.set_point_steps, limits::MAX_STEPS, no_step, Part::fields);
        let no_load = || LoadStep { time_s: 0.0, load: Load::Leak { tank: 0, area: 0.0 } };
        f.list("load_steps", &mut self.load_steps, limits::MAX_STEPS, no_load, Part::fields);
        f.part("measurement", &mut self.measurement);
    }
}

/// Checks how many samples (every `sampling_time_s`, in s) the experiment of a setup takes.
pub fn check_duration(f: &mut Fields<'_>, experiment: &Experiment, sampling_time_s: f64) {
    f.check("experiment.duration_s", experiment.duration_s, limits::duration_s(sampling_time_s));
}

impl Part for SetPointStep {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.index("level", &mut self.level, 0, 1);
        f.number("time_s", &mut self.time_s, limits::TIME_S);
        f.number("size", &mut self.size, limits::SET_POINT_STEP);
    }
}

impl Part for LoadStep {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("time_s", &mut self.time_s, limits::TIME_S);
        f.part("load", &mut self.load);
    }
}

impl Part for Load {
    fn fields(&mut self, f: &mut Fields<'_>) {
        let table = [("pump_flow", Self::PumpFlow { pump: 0, flow: 0.0 }), ("leak", Self::Leak { tank: 0, area: 0.0 })];
        f.choice(self, &table, |load, f| match load {
            Self::PumpFlow { pump, flow } => {
                f.index("pump", pump, 0, 1);
                f.number("flow", flow, limits::LOAD_FLOW);
            }
            Self::Leak { tank, area } => {
                f.index("tank", tank, 0, 3);
                f.number("area", area, limits::LEAK_AREA);
            }
        });
    }
}

impl Part for Measurement {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("noise_std", &mut self.noise_std, limits::NOISE_STD);
        f.whole("seed", &mut self.seed, limits::SEED);
        f.flag("quantised", &mut self.quantised);
    }
}

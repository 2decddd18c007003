use crate::fields::{Fields, ITSELF, Part, check_duration};
use crate::limits::{self, Limits};
use crate::setup_of;
use quadtank::plant::PresetId;

use super::{ModelFreeScenario, ModelFreeSetup, StartSpec};

impl Part for ModelFreeScenario {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.version(&mut self.version, Self::VERSION);
        f.part("model_free", &mut self.model_free);
        let cursor = f.hidden_if(self.cursor_s.is_none());
        cursor.option("cursor_s", &mut self.cursor_s, f64::default, |time, f| f.number(ITSELF, time, limits::TIME_S));
    }
}

impl Part for ModelFreeSetup {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.part("plant", &mut self.plant);
        f.part("valves", &mut self.valves);
        f.part("start", &mut self.start);
        f.part("controller", &mut self.controller);
        let blank = || setup_of(PresetId::JohanssonMinimumPhase).controller;
        f.hidden_if(self.compare.is_none()).option("compare", &mut self.compare, blank, Part::fields);
        f.part("experiment", &mut self.experiment);

        let sampling_time_s = self.controller.sampling_time_s;
        if let Some(compare) = &self.compare {
            // Its samples are no more than those of the law.
            let limits = Limits { min: sampling_time_s.min(1.0), ..limits::SAMPLING_TIME_S };
            f.check("compare.sampling_time_s", compare.sampling_time_s, limits);
        }
        check_duration(f, &self.experiment, sampling_time_s);
        let limits = limits::valve_frequency(self.experiment.duration_s);
        for (name, valve) in ["valves[0].sine.frequency", "valves[1].sine.frequency"].into_iter().zip(&self.valves) {
            f.check(name, valve.turning(), limits);
        }
    }
}

impl Part for StartSpec {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.choice(self, &[("rest", Self::Rest([0.0; 2])), ("empty", Self::Empty)], |start, f| {
            if let Self::Rest(levels) = start {
                f.pair(ITSELF, levels, limits::LEVEL);
            }
        });
    }
}

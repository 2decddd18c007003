use super::{Fields, Part, names};
use crate::ScenarioError;
use crate::limits;
use quadtank::control::{
    AntiWindup, DecentralisedPi, EstimatorSettings, FedWith, LoopMode, ModelFree, ModelFreeSettings, ModelFreeWindup,
    Pairing, PiSettings, Quadrature, Window,
};

names!(Pairing: "diagonal" Diagonal, "swapped" Swapped);

impl Part for DecentralisedPi {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.part("pairing", &mut self.pairing);
        f.part("loops", &mut self.loops);
        f.number("sampling_time_s", &mut self.sampling_time_s, limits::SAMPLING_TIME_S);
    }
}

impl Part for PiSettings {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("gain", &mut self.gain, limits::GAIN);
        f.check("gain", self.gain, limits::gain_like(self.gain));
        f.number("integral_time_s", &mut self.integral_time_s, limits::INTEGRAL_TIME_S);
        f.number("set_point_weight", &mut self.set_point_weight, limits::SET_POINT_WEIGHT);
        f.part("anti_windup", &mut self.anti_windup);
        f.part("mode", &mut self.mode);
    }
}

impl Part for AntiWindup {
    fn fields(&mut self, f: &mut Fields<'_>) {
        let table = [("off", Self::Off), ("back_calculation", Self::BackCalculation { tracking_ratio: 1.0 })];
        f.choice(self, &table, |choice, f| {
            if let Self::BackCalculation { tracking_ratio } = choice {
                f.number("tracking_ratio", tracking_ratio, limits::TRACKING_RATIO);
            }
        });
    }
}

impl Part for LoopMode {
    fn fields(&mut self, f: &mut Fields<'_>) {
        let table = [("automatic", Self::Automatic), ("manual", Self::Manual { output: 0.0, until_s: 0.0 })];
        f.choice(self, &table, |choice, f| {
            if let Self::Manual { output, until_s } = choice {
                f.number("output", output, limits::MANUAL_OUTPUT);
                f.number("until_s", until_s, limits::TIME_S);
            }
        });
    }
}

impl Part for ModelFree {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.part("pairing", &mut self.pairing);
        f.part("loops", &mut self.loops);
        f.option("estimator", &mut self.estimator, || EstimatorSettings::PUBLISHED, Part::fields);
        f.number("sampling_time_s", &mut self.sampling_time_s, limits::SAMPLING_TIME_S);
        if let Some(Err(error)) = self.estimator.map(|estimator| estimator.samples(self.sampling_time_s)) {
            f.refuse("estimator.window_s", |field| ScenarioError::Law { field, error });
        }
    }
}

impl Part for ModelFreeSettings {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("model_gain", &mut self.model_gain, limits::MODEL_GAIN);
        f.number("proportional", &mut self.proportional, limits::MODEL_FREE_FEEDBACK);
        f.number("integral", &mut self.integral, limits::MODEL_FREE_FEEDBACK);
        f.part("anti_windup", &mut self.anti_windup);
    }
}

impl Part for ModelFreeWindup {
    fn fields(&mut self, f: &mut Fields<'_>) {
        let table = [
            ("off", Self::Off),
            ("conditional", Self::Conditional),
            ("back_calculation", Self::BackCalculation { tracking_time_s: 1.0 }),
        ];
        f.choice(self, &table, |choice, f| {
            if let Self::BackCalculation { tracking_time_s } = choice {
                f.number("tracking_time_s", tracking_time_s, limits::INTEGRAL_TIME_S);
            }
        });
    }
}

impl Part for EstimatorSettings {
    fn fields(&mut self, f: &mut Fields<'_>) {
        f.number("window_s", &mut self.window_s, limits::WINDOW_S);
        f.part("window", &mut self.window);
        f.part("quadrature", &mut self.quadrature);
        f.part("fed_with", &mut self.fed_with);
    }
}

names!(Window: "block" Block, "sliding" Sliding);

names!(Quadrature: "rectangular" Rectangular, "trapezoidal" Trapezoidal);

names!(FedWith: "applied" Applied, "commanded" Commanded);

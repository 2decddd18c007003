use quadtank::plant::QuadrupleTank;
use quadtank_scenario::{Limits, limits};
use serde::{Deserialize, Serialize};

/// The longest delay of a hose that is always sought (s).
const MIN_LONGEST_DELAY_S: f64 = 60.0;

/// A parameter of a rig that can be fitted to a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Parameter {
    /// Valve fraction γ of a pump (index 0 or 1).
    Valve(usize),
    /// Flow per volt k of a pump (index 0 or 1; m³/(s V)).
    PumpGain(usize),
    /// Area a of the outlet of a tank (index 0 to 3; m²). Its loss coefficient stays: the two act as their product.
    OutletArea(usize),
    /// What the sensor of a lower tank (index 0 or 1) shows too much (m).
    LevelOffset(usize),
    /// Transport delay θ of the hose behind a pump (index 0 or 1; s).
    PumpDelay(usize),
    /// Level of a tank at the beginning of the record (index 0 to 3; m), in the place of the recorded one or of the one at rest.
    StartLevel(usize),
}

impl Parameter {
    /// All of them.
    pub const ALL: [Self; 16] = [
        Self::Valve(0),
        Self::Valve(1),
        Self::PumpGain(0),
        Self::PumpGain(1),
        Self::OutletArea(0),
        Self::OutletArea(1),
        Self::OutletArea(2),
        Self::OutletArea(3),
        Self::LevelOffset(0),
        Self::LevelOffset(1),
        Self::PumpDelay(0),
        Self::PumpDelay(1),
        Self::StartLevel(0),
        Self::StartLevel(1),
        Self::StartLevel(2),
        Self::StartLevel(3),
    ];

    /// Its name on the command line and in reports: `gamma1`, `k2`, `a3`, `offset1`, `delay2`, `start4`.
    pub fn name(self) -> String {
        let (word, index) = match self {
            Self::Valve(index) => ("gamma", index),
            Self::PumpGain(index) => ("k", index),
            Self::OutletArea(index) => ("a", index),
            Self::LevelOffset(index) => ("offset", index),
            Self::PumpDelay(index) => ("delay", index),
            Self::StartLevel(index) => ("start", index),
        };
        format!("{word}{}", index + 1)
    }

    /// The parameter of a name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|parameter| parameter.name() == name)
    }

    /// Its unit.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Valve(_) => "1",
            Self::PumpGain(_) => "m³/(s V)",
            Self::OutletArea(_) => "m²",
            Self::LevelOffset(_) | Self::StartLevel(_) => "m",
            Self::PumpDelay(_) => "s",
        }
    }

    /// Its value on a rig whose water begins at the levels `first` (m); an offset begins at nothing.
    pub const fn of(self, rig: &QuadrupleTank, first: &[f64; 4]) -> f64 {
        match self {
            Self::Valve(index) => rig.valves[index],
            Self::PumpGain(index) => rig.pumps[index].gain,
            Self::OutletArea(index) => rig.tanks[index].outlet.area,
            Self::LevelOffset(_) => 0.0,
            Self::PumpDelay(index) => rig.pumps[index].delay_s,
            Self::StartLevel(index) => first[index],
        }
    }

    /// Puts a value on a rig; offsets and levels are no part of it.
    pub const fn put(self, rig: &mut QuadrupleTank, value: f64) {
        match self {
            Self::Valve(index) => rig.valves[index] = value,
            Self::PumpGain(index) => rig.pumps[index].gain = value,
            Self::OutletArea(index) => rig.tanks[index].outlet.area = value,
            Self::PumpDelay(index) => rig.pumps[index].delay_s = value,
            Self::LevelOffset(_) | Self::StartLevel(_) => {}
        }
    }

    /// Limits of the parameter, which bounds may not exceed.
    pub fn allowed(self, rig: &QuadrupleTank) -> Limits {
        match self {
            Self::Valve(_) => limits::VALVE,
            Self::PumpGain(_) => limits::PUMP_GAIN,
            Self::OutletArea(index) => {
                // Torricelli's law has to hold.
                let widest = limits::OUTLET_SHARE * rig.tanks[index].section.area_at_empty;
                Limits { max: limits::OUTLET_AREA.max.min(widest), ..limits::OUTLET_AREA }
            }
            Self::LevelOffset(index) => Limits::new(-rig.tanks[index].height, rig.tanks[index].height),
            Self::PumpDelay(_) => limits::PUMP_DELAY_S,
            Self::StartLevel(index) => Limits::new(0.0, rig.tanks[index].height),
        }
    }

    /// Bounds of the search where no others are given, in the unit of the parameter: a valve fraction over almost all of 0 to 1; gains and areas from a fifth to
    /// five times their present value; a sensor offset within a fifth of the height of its tank; a delay from 0 to one minute, or to
    /// five times its present value if that is longer; a level from empty to full.
    pub fn bounds(self, rig: &QuadrupleTank) -> [f64; 2] {
        let five_times = |value: f64| [0.2 * value, 5.0 * value];
        match self {
            Self::Valve(_) => [0.01, 0.99],
            Self::PumpGain(index) => five_times(rig.pumps[index].gain),
            Self::OutletArea(index) => five_times(rig.tanks[index].outlet.area),
            Self::LevelOffset(index) => [-0.2 * rig.tanks[index].height, 0.2 * rig.tanks[index].height],
            Self::PumpDelay(index) => {
                [0.0, limits::PUMP_DELAY_S.clamp(f64::max(MIN_LONGEST_DELAY_S, 5.0 * rig.pumps[index].delay_s))]
            }
            Self::StartLevel(index) => [0.0, rig.tanks[index].height],
        }
    }
}

/// A parameter to estimate, with its starting value and bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sought {
    /// The parameter.
    pub parameter: Parameter,
    /// Starting value; one outside of the bounds is replaced by the nearer bound.
    pub start: f64,
    /// Lower and upper bound.
    pub bounds: [f64; 2],
}

impl Sought {
    /// Starts at the value of the rig, within the default bounds. `first` are the starting values of the initial levels (m).
    pub fn usual(parameter: Parameter, rig: &QuadrupleTank, first: &[f64; 4]) -> Self {
        let allowed = parameter.allowed(rig);
        Self {
            parameter,
            start: parameter.of(rig, first),
            bounds: parameter.bounds(rig).map(|bound| allowed.clamp(bound)),
        }
    }

    /// Whether the bounds are an interval within the limits of the parameter.
    pub fn is_valid(&self, rig: &QuadrupleTank) -> bool {
        let [low, high] = self.bounds;
        let allowed = self.parameter.allowed(rig);
        low < high && allowed.contains(low) && allowed.contains(high) && self.start.is_finite()
    }
}

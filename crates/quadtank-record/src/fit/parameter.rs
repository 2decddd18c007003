use quadtank::plant::QuadrupleTank;
use serde::{Deserialize, Serialize};

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
}

impl Parameter {
    /// All of them.
    pub const ALL: [Self; 10] = [
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
    ];

    /// Its name on the command line and in reports: `gamma1`, `k2`, `a3`, `offset1`.
    pub fn name(self) -> String {
        let (word, index) = match self {
            Self::Valve(index) => ("gamma", index),
            Self::PumpGain(index) => ("k", index),
            Self::OutletArea(index) => ("a", index),
            Self::LevelOffset(index) => ("offset", index),
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
            Self::LevelOffset(_) => "m",
        }
    }

    /// Its value on a rig; an offset begins at nothing.
    pub const fn of(self, rig: &QuadrupleTank) -> f64 {
        match self {
            Self::Valve(index) => rig.valves[index],
            Self::PumpGain(index) => rig.pumps[index].gain,
            Self::OutletArea(index) => rig.tanks[index].outlet.area,
            Self::LevelOffset(_) => 0.0,
        }
    }

    /// Puts a value on a rig; an offset is no part of it.
    pub const fn put(self, rig: &mut QuadrupleTank, value: f64) {
        match self {
            Self::Valve(index) => rig.valves[index] = value,
            Self::PumpGain(index) => rig.pumps[index].gain = value,
            Self::OutletArea(index) => rig.tanks[index].outlet.area = value,
            Self::LevelOffset(_) => {}
        }
    }

    /// Where it is sought: a valve over almost all of its travel, gains and areas from a fifth to five times of what they are, an offset
    /// within a fifth of the wall.
    pub fn bounds(self, rig: &QuadrupleTank) -> [f64; 2] {
        match self {
            Self::Valve(_) => [0.01, 0.99],
            Self::PumpGain(_) | Self::OutletArea(_) => [0.2 * self.of(rig), 5.0 * self.of(rig)],
            Self::LevelOffset(index) => [-0.2 * rig.tanks[index].height, 0.2 * rig.tanks[index].height],
        }
    }
}

use serde::Serialize;

/// Something that happened to a tank or a pump.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum EventKind {
    /// The level reached the top of the walls: water is lost.
    Overflow {
        /// Index of the tank.
        tank: usize,
    },
    /// The tank ran dry.
    Empty {
        /// Index of the tank.
        tank: usize,
    },
    /// The controller asked for more than the pump can do.
    Saturated {
        /// Index of the pump.
        pump: usize,
    },
}

/// An event and when it first began.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Event {
    /// When (s).
    pub time_s: f64,
    /// What.
    pub kind: EventKind,
}

/// A run, by columns of equal length. Row k is at `time_s[k]`; inputs are those that hold from that time on.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Trajectory {
    /// Time (s).
    pub time_s: Vec<f64>,
    /// Levels h1…h4 (m).
    pub levels: [Vec<f64>; 4],
    /// References of levels 1 and 2 (m).
    pub references: [Vec<f64>; 2],
    /// Outputs of loops 1 and 2, limited (V). With the swapped pairing loop 1 drives pump 2.
    pub controller_output: [Vec<f64>; 2],
    /// Voltages of pumps 1 and 2 (V).
    pub pump_voltage: [Vec<f64>; 2],
    /// What happened, in order; each kind once, when it first began. Empty for a linear run.
    pub events: Vec<Event>,
}

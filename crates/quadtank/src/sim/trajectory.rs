use serde::Serialize;

/// Something that happened to a tank or a pump.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    /// The level reached the top of the walls: water is lost.
    Overflow {
        /// Index of the tank, from 0.
        tank: usize,
    },
    /// The tank ran dry.
    Empty {
        /// Index of the tank, from 0.
        tank: usize,
    },
    /// The controller asked for more than the pump can do.
    Saturated {
        /// Index of the pump, from 0.
        pump: usize,
    },
}

/// An event and when it first began.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Event {
    /// When (s).
    pub time_s: f64,
    /// What happened.
    pub kind: EventKind,
}

/// A run, by columns of equal length. Row k is at `time_s[k]`; inputs are those that hold from that time on.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// Work of the integration in explicit steps, the same on every machine; 0 for a linear run, which needs none.
    #[serde(skip)]
    pub work: u64,
    /// When the run ended early because it had reached [`MAX_RUN_WORK`](super::MAX_RUN_WORK) (s); `None` for a whole run.
    #[serde(skip)]
    pub halted_at_s: Option<f64>,
}

impl Trajectory {
    /// `rows` rows of zeros, to be [`set`](Self::set).
    pub(super) fn with_rows(rows: usize) -> Self {
        let column = || vec![0.0; rows];
        let pair = || [column(), column()];
        Self {
            time_s: column(),
            levels: [column(), column(), column(), column()],
            references: pair(),
            controller_output: pair(),
            pump_voltage: pair(),
            events: Vec::new(),
            work: 0,
            halted_at_s: None,
        }
    }

    /// The row in force at a time (s): the last one not after it, or the first; `None` for a run without rows.
    pub fn row_at(&self, time_s: f64) -> Option<usize> {
        let after = self.time_s.partition_point(|&t| t <= time_s);
        (!self.time_s.is_empty()).then(|| after.saturating_sub(1))
    }

    /// Drops the rows from one on.
    pub(super) fn truncate(&mut self, rows: usize) {
        let pairs = self.references.iter_mut().chain(&mut self.controller_output).chain(&mut self.pump_voltage);
        pairs.chain(&mut self.levels).chain([&mut self.time_s]).for_each(|column| column.truncate(rows));
    }

    /// Fills a row, which must be there.
    pub(super) fn set(
        &mut self,
        row: usize,
        time_s: f64,
        levels: [f64; 4],
        references: [f64; 2],
        controller_output: [f64; 2],
        pump_voltage: [f64; 2],
    ) {
        self.time_s[row] = time_s;
        for (column, level) in self.levels.iter_mut().zip(levels) {
            column[row] = level;
        }
        for i in 0..2 {
            self.references[i][row] = references[i];
            self.controller_output[i][row] = controller_output[i];
            self.pump_voltage[i][row] = pump_voltage[i];
        }
    }
}

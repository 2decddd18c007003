use super::PublishedPlant;
use crate::tuning::{Action, PlacementMethod, TuningRule};

/// A published case of Campestrini (2006): a table and its row. Equation 88 counts as table 88, and the record of the solvents
/// column, §6.4, as table 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PublishedCase {
    /// Number of the table.
    pub table: u32,
    /// Row, from 1.
    pub row: usize,
}

/// The placement of a case, as printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedPlacement {
    /// The plant.
    pub plant: PublishedPlant,
    /// Gains kc1, kc2 of the critical point.
    pub critical_gains: [f64; 2],
    /// Its period Tc, in the unit of time of the plant.
    pub critical_period: f64,
    /// Which loci.
    pub method: PlacementMethod,
    /// With which controllers.
    pub action: Action,
    /// Target λ: real and imaginary part.
    pub target: [f64; 2],
    /// Root 1 or 2; root 1 has the larger controller in loop 1.
    pub root: usize,
}

/// The rows of Table 4.
pub const RULES: [(TuningRule, Action); 4] = [
    (TuningRule::ZieglerNicholsPi, Action::Pi),
    (TuningRule::ZieglerNicholsPid, Action::Pid),
    (TuningRule::TyreusLuybenPi, Action::Pi),
    (TuningRule::TyreusLuybenPid, Action::Pid),
];

/// How many rows of each table are cases, in the order of the thesis.
const TABLES: [(u32, usize); 16] = [
    (3, 2),
    (88, 1),
    (4, 4),
    (5, 1),
    (6, 2),
    (7, 4),
    (8, 2),
    (9, 1),
    (10, 2),
    (11, 2),
    (12, 4),
    (13, 3),
    (14, 4),
    (15, 2),
    (16, 2),
    (0, 1),
];

impl PublishedCase {
    /// All cases, in the order of the thesis.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLES.into_iter().flat_map(|(table, rows)| (1..=rows).map(move |row| Self { table, row }))
    }

    /// Whether it is a controller by placement, so that its session can be told by its design.
    pub fn is_placement(self) -> bool {
        matches!(self.table, 5 | 6 | 8..=12 | 14..=16)
    }

    /// Its name on the command line: `table-12-row-3`, `equation-88`, `usol`.
    pub fn name(self) -> String {
        match self.table {
            0 => "usol".to_owned(),
            88 => "equation-88".to_owned(),
            table => format!("table-{table}-row-{}", self.row),
        }
    }

    /// The case with a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::all().find(|case| case.name() == name)
    }

    /// The placement of the case; with method A the root is the one that has the sign of the plant.
    pub fn placement(self) -> PublishedPlacement {
        use Action::{Pi, Pid};
        use PlacementMethod::{BothLoci, OneLocus};
        use PublishedPlant::{ProcessTwo, WoodBerry};
        let wood_berry = |point: usize| -> [f64; 3] {
            match point {
                1 => [0.096, -0.417, 11.57],
                2 => [0.710, -0.264, 12.70],
                3 => [1.270, -0.252, 12.25],
                _ => [1.900, -0.253, 12.00],
            }
        };
        let process_two = |point: usize| -> [f64; 3] {
            match point {
                1 => [1.250, 1.082, 1.46],
                2 => [0.100, 2.110, 1.35],
                _ => [5.000, 0.494, 1.17],
            }
        };
        let rule_target = |rule: TuningRule| [rule.target().re, rule.target().im];
        let (plant, [kc1, kc2, critical_period], method, action, target, root) = match (self.table, self.row) {
            (4, row) => {
                let (rule, action) = RULES[row - 1];
                (WoodBerry, wood_berry(2), OneLocus, action, rule_target(rule), 2)
            }
            (5, _) => (WoodBerry, [0.450, -0.290, 12.90], OneLocus, Pi, [-0.40, 0.08], 2),
            (6, root) => (WoodBerry, wood_berry(1), BothLoci, Pid, [-0.60, -0.28], root),
            (8, point) => (WoodBerry, wood_berry(point), OneLocus, Pi, [-0.3, 0.08], 2),
            (9, _) => (WoodBerry, wood_berry(1), OneLocus, Pid, [0.2, -0.5], 1),
            (10, point) => (WoodBerry, wood_berry(point), BothLoci, Pi, [-0.2, 0.01], 2),
            (11, root) => (WoodBerry, wood_berry(2), BothLoci, Pid, rule_target(TuningRule::TyreusLuybenPid), root),
            (7 | 12, point) => (WoodBerry, wood_berry(point), BothLoci, Pid, [-0.2, -0.3], 2),
            (3 | 88 | 0, _) => (WoodBerry, wood_berry(2), BothLoci, Pid, [-0.2, -0.3], 2),
            (14, 4) => (ProcessTwo, process_two(3), OneLocus, Pi, [-0.4, 0.15], 2),
            (14, point) => (ProcessTwo, process_two(point), OneLocus, Pi, [-0.3, 0.1], 2),
            (15, point) => (ProcessTwo, process_two(point), BothLoci, Pi, [-0.2, 0.01], 2),
            // Tables 13 and 16.
            (_, point) => (ProcessTwo, process_two(point), BothLoci, Pid, [-0.3, -0.3], 2),
        };
        PublishedPlacement { plant, critical_gains: [kc1, kc2], critical_period, method, action, target, root }
    }
}

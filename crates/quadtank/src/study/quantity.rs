/// A number that follows from the results of a bench, by its name.
///
/// The table of a bench is [`Study::QUANTITIES`](super::Study::QUANTITIES). Metrics tables, tasks, the command line and
/// `docs/quantities.md` read it, so that a name means the same number everywhere.
pub struct Quantity<R: 'static> {
    /// Words in snake case, joined by dots from the whole to its part: `zero.rightmost`. It is never renamed.
    pub name: &'static str,
    /// Its unit in SI, one of [`UNITS`].
    pub unit: &'static str,
    /// What it is, in one sentence of plain English.
    pub description: &'static str,
    /// The number; `None` where it does not exist for this setup.
    pub read: fn(&R) -> Option<f64>,
}

/// The units of quantities; `1` is a ratio, and of `yes/no` yes is 1 and no is 0.
///
/// `signal` is the unit of the signals of a level loop. Plants of the relay-tuning bench have units of their own: `time`, `input` and
/// `output`.
pub const UNITS: [&str; 24] = [
    "1",
    "dB",
    "yes/no",
    "s",
    "1/s",
    "rad",
    "rad/s",
    "m",
    "m s",
    "m s²",
    "m²",
    "m² s",
    "m³/s",
    "m⁶/s²",
    "V",
    "m/(s V)",
    "signal",
    "time",
    "rad/time",
    "input",
    "output",
    "output time",
    "output/input",
    "input/output",
];

impl<R: 'static> Quantity<R> {
    /// A row of a table.
    pub(super) const fn new(
        name: &'static str,
        unit: &'static str,
        description: &'static str,
        read: fn(&R) -> Option<f64>,
    ) -> Self {
        Self { name, unit, description, read }
    }

    /// The number that results have; `None` where it does not exist, and where it is not finite.
    pub fn value(&self, results: &R) -> Option<f64> {
        (self.read)(results).filter(|value| value.is_finite())
    }

    /// The quantity of a table with this name.
    pub fn find(table: &'static [Self], name: &str) -> Option<&'static Self> {
        table.iter().find(|quantity| quantity.name == name)
    }
}

/// The largest number of a column; `None` for an empty one.
pub(super) fn highest(column: &[f64]) -> Option<f64> {
    column.iter().copied().reduce(f64::max)
}

/// The smallest number of a column; `None` for an empty one.
pub(super) fn lowest(column: &[f64]) -> Option<f64> {
    column.iter().copied().reduce(f64::min)
}

/// A verdict as a number.
pub(super) const fn yes(is_so: bool) -> f64 {
    if is_so { 1.0 } else { 0.0 }
}

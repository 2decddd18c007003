use serde::{Deserialize, Serialize};

use crate::unit_name::{NamedUnit, plain, split_unit};
use crate::{RecordError, Table};

/// What a column of a record is a record of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Signal {
    /// The time.
    Time,
    /// Level of a tank (index 0 to 3).
    Level(usize),
    /// Reference of a level (index 0 or 1).
    Reference(usize),
    /// Voltage of a pump (index 0 or 1).
    PumpVoltage(usize),
    /// Flow into a tank from outside of the rig (index 0 to 3).
    Inflow(usize),
}

impl Signal {
    /// All of them.
    pub const ALL: [Self; 13] = [
        Self::Time,
        Self::Level(0),
        Self::Level(1),
        Self::Level(2),
        Self::Level(3),
        Self::Reference(0),
        Self::Reference(1),
        Self::PumpVoltage(0),
        Self::PumpVoltage(1),
        Self::Inflow(0),
        Self::Inflow(1),
        Self::Inflow(2),
        Self::Inflow(3),
    ];

    /// Its name on the command line: `time`, `level1`, `reference2`, `pump1`, `inflow3`.
    pub fn name(self) -> String {
        let (word, index) = match self {
            Self::Time => return "time".to_owned(),
            Self::Level(index) => ("level", index),
            Self::Reference(index) => ("reference", index),
            Self::PumpVoltage(index) => ("pump", index),
            Self::Inflow(index) => ("inflow", index),
        };
        format!("{word}{}", index + 1)
    }

    /// The units that it may be written in; the first one where nothing else is said.
    pub const fn units(self) -> &'static [Unit] {
        use Unit::{
            Centimetre, CubicCentimetre, CubicMetre, Hour, Inch, LitrePerMinute, Metre, Millimetre, Millisecond,
            Millivolt, Minute, Second, SensorVolt, Volt,
        };
        match self {
            Self::Time => &[Second, Millisecond, Minute, Hour],
            Self::Level(_) | Self::Reference(_) => &[Centimetre, Metre, Millimetre, Inch, SensorVolt],
            Self::PumpVoltage(_) => &[Volt, Millivolt],
            Self::Inflow(_) => &[CubicCentimetre, CubicMetre, LitrePerMinute],
        }
    }
}

/// A unit of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Unit {
    /// s
    Second,
    /// ms
    Millisecond,
    /// min
    Minute,
    /// h
    Hour,
    /// m
    Metre,
    /// cm
    Centimetre,
    /// mm
    Millimetre,
    /// in
    Inch,
    /// V of the level sensor
    SensorVolt,
    /// V
    Volt,
    /// mV
    Millivolt,
    /// cm³/s
    CubicCentimetre,
    /// m³/s
    CubicMetre,
    /// L/min
    LitrePerMinute,
}

impl Unit {
    /// How it is written.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Second => "s",
            Self::Millisecond => "ms",
            Self::Minute => "min",
            Self::Hour => "h",
            Self::Metre => "m",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
            Self::Inch => "in",
            Self::SensorVolt | Self::Volt => "V",
            Self::Millivolt => "mV",
            Self::CubicCentimetre => "cm³/s",
            Self::CubicMetre => "m³/s",
            Self::LitrePerMinute => "L/min",
        }
    }

    /// Its name on the command line: the symbol, but for volts of a level sensor and for cubes.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SensorVolt => "sensor-V",
            Self::CubicCentimetre => "cm3/s",
            Self::CubicMetre => "m3/s",
            other => other.symbol(),
        }
    }

    /// What one of it is in SI, where level sensors give `sensor_gain` (V/m).
    pub fn in_si(self, sensor_gain: f64) -> f64 {
        match self {
            Self::Second | Self::Metre | Self::Volt | Self::CubicMetre => 1.0,
            Self::Millisecond | Self::Millimetre | Self::Millivolt => 1e-3,
            Self::Minute => 60.0,
            Self::Hour => 3600.0,
            Self::Centimetre => 1e-2,
            Self::Inch => 0.0254,
            Self::CubicCentimetre => 1e-6,
            Self::LitrePerMinute => 1e-3 / 60.0,
            Self::SensorVolt => sensor_gain.recip(),
        }
    }
}

/// What a column holds, and in which unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ColumnMeaning {
    /// What.
    pub signal: Signal,
    /// In which unit.
    pub unit: Unit,
}

/// What the columns of a table hold; `None` for a column that is left out.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Mapping(pub Vec<Option<ColumnMeaning>>);

/// Words of names, as laboratories write them in English, Portuguese and Spanish. The first that fits counts.
const WORDS: [(&str, Kind); 29] = [
    ("time", Kind::Time),
    ("tempo", Kind::Time),
    ("tiempo", Kind::Time),
    ("linear", Kind::Other),
    ("output", Kind::Other),
    ("inflow", Kind::Inflow),
    ("disturb", Kind::Inflow),
    ("perturb", Kind::Inflow),
    ("vazao", Kind::Inflow),
    ("caudal", Kind::Inflow),
    ("reference", Kind::Reference),
    ("referencia", Kind::Reference),
    ("setpoint", Kind::Reference),
    ("set-point", Kind::Reference),
    ("ref", Kind::Reference),
    ("sp", Kind::Reference),
    ("pump", Kind::Pump),
    ("bomb", Kind::Pump),
    ("volt", Kind::Pump),
    ("level", Kind::Level),
    ("nivel", Kind::Level),
    ("tank", Kind::Level),
    ("tanque", Kind::Level),
    ("h", Kind::Level),
    ("x", Kind::Level),
    ("y", Kind::Level),
    ("r", Kind::Reference),
    ("u", Kind::Pump),
    ("v", Kind::Pump),
];

/// What a name says.
#[derive(Clone, Copy)]
enum Kind {
    Time,
    Level,
    Reference,
    Pump,
    Inflow,
    Other,
}

impl Mapping {
    /// A mapping that leaves out everything of a table with so many columns.
    pub fn empty(columns: usize) -> Self {
        Self(vec![None; columns])
    }

    /// What the names of the columns say. A table without names, or with none that says so, has its time in the first column if that
    /// rises. No signal is found twice.
    pub fn guess(table: &Table) -> Self {
        let mut found = Self::empty(table.columns.len());
        for (index, column) in table.columns.iter().enumerate() {
            let meaning = meaning_of(&column.name);
            let is_new = meaning.is_some_and(|meaning| found.column_of(meaning.signal).is_none());
            found.0[index] = meaning.filter(|_| is_new);
        }
        let rises = table.columns.first().is_some_and(|first| first.values.windows(2).all(|pair| pair[0] < pair[1]));
        if found.column_of(Signal::Time).is_none() && rises && found.0[0].is_none() {
            found.0[0] = Some(ColumnMeaning { signal: Signal::Time, unit: Unit::Second });
        }
        found
    }

    /// The column of a signal.
    pub fn column_of(&self, signal: Signal) -> Option<usize> {
        self.0.iter().position(|meaning| meaning.is_some_and(|meaning| meaning.signal == signal))
    }

    /// Whether it can be used: a time, a signal, and none of them twice.
    ///
    /// # Errors
    /// [`RecordError::NoTime`], [`RecordError::NoSignal`], [`RecordError::SameSignal`].
    pub fn check(&self) -> Result<(), RecordError> {
        let signals = || self.0.iter().enumerate().filter_map(|(index, meaning)| Some((index, (*meaning)?.signal)));
        for (index, signal) in signals() {
            if let Some((other, _)) = signals().find(|&(other, same)| other > index && same == signal) {
                return Err(RecordError::SameSignal { columns: [index + 1, other + 1], signal });
            }
        }
        if self.column_of(Signal::Time).is_none() {
            return Err(RecordError::NoTime);
        }
        if signals().all(|(_, signal)| signal == Signal::Time) { Err(RecordError::NoSignal) } else { Ok(()) }
    }
}

/// What the name of a column says: the kind by its word, which one by its digit, the unit by what stands in brackets or at its end.
fn meaning_of(name: &str) -> Option<ColumnMeaning> {
    let name = plain(name);
    let (words, _) = split_unit(&name);
    let number = words.chars().find_map(|c| c.to_digit(10)).map(|digit| digit as usize);
    let letters = words.trim().trim_end_matches(|c: char| c.is_ascii_digit() || "_ .".contains(c));
    if letters == "t" {
        return Some(meant_by(Signal::Time, &name));
    }
    let is_word = |word: &str| if word.len() <= 2 { letters == word } else { words.contains(word) };
    let (_, kind) = WORDS.iter().find(|(word, _)| is_word(word))?;
    let within = |count: usize| number.and_then(|number| number.checked_sub(1)).filter(|&index| index < count);
    let signal = match kind {
        Kind::Time => Signal::Time,
        Kind::Level => Signal::Level(within(4)?),
        Kind::Reference => Signal::Reference(within(2)?),
        Kind::Pump => Signal::PumpVoltage(within(2)?),
        Kind::Inflow => Signal::Inflow(within(4)?),
        Kind::Other => return None,
    };
    Some(meant_by(signal, &name))
}

fn meant_by(signal: Signal, name: &str) -> ColumnMeaning {
    ColumnMeaning { signal, unit: NamedUnit::of(name, signal).or_usual(signal) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_laboratories_are_understood() {
        for (name, signal, unit) in [
            ("t (s)", Signal::Time, Unit::Second),
            ("Tempo [min]", Signal::Time, Unit::Minute),
            ("time_s", Signal::Time, Unit::Second),
            ("time ms", Signal::Time, Unit::Millisecond),
            ("h1 (cm)", Signal::Level(0), Unit::Centimetre),
            ("level_3_m", Signal::Level(2), Unit::Metre),
            ("Nível 2 [mm]", Signal::Level(1), Unit::Millimetre),
            ("y2/V", Signal::Level(1), Unit::SensorVolt),
            ("Tank 4", Signal::Level(3), Unit::Centimetre),
            ("r1", Signal::Reference(0), Unit::Centimetre),
            ("reference_2_m", Signal::Reference(1), Unit::Metre),
            ("pump_voltage_1_v", Signal::PumpVoltage(0), Unit::Volt),
            ("u2 (mV)", Signal::PumpVoltage(1), Unit::Millivolt),
            ("Bomba 1", Signal::PumpVoltage(0), Unit::Volt),
            ("inflow 3", Signal::Inflow(2), Unit::CubicCentimetre),
            ("Inflow_4 (m3/s)", Signal::Inflow(3), Unit::CubicMetre),
            ("disturbance1 [cm³/s]", Signal::Inflow(0), Unit::CubicCentimetre),
            ("Vazão 2 (L/min)", Signal::Inflow(1), Unit::LitrePerMinute),
        ] {
            assert_eq!(meaning_of(name), Some(ColumnMeaning { signal, unit }), "{name}");
        }
        for (name, signal, unit) in [
            ("time (sec)", Signal::Time, Unit::Second),
            ("Tiempo [horas]", Signal::Time, Unit::Hour),
            ("h1 (inches)", Signal::Level(0), Unit::Inch),
            ("h1 (volts)", Signal::Level(0), Unit::SensorVolt),
            ("u1 (Volts)", Signal::PumpVoltage(0), Unit::Volt),
        ] {
            assert_eq!(NamedUnit::of(name, signal), NamedUnit::Known(unit), "{name}");
        }
        for name in ["", "comment", "h7", "h", "linear_level_1_m", "controller_output_1_v", "flow 1"] {
            assert_eq!(meaning_of(name), None, "{name}");
        }
    }

    #[test]
    fn a_first_column_that_rises_is_the_time() {
        let table = Table::read(b"0,5,1\n1,6,1\n").unwrap();
        let time = Some(ColumnMeaning { signal: Signal::Time, unit: Unit::Second });
        assert_eq!(Mapping::guess(&table).0, [time, None, None]);
        let table = Table::read(b"h1,h2,h1\n3,5,1\n1,6,1\n").unwrap();
        let level = |index| Some(ColumnMeaning { signal: Signal::Level(index), unit: Unit::Centimetre });
        assert_eq!(Mapping::guess(&table).0, [level(0), level(1), None]);
    }

    #[test]
    fn a_mapping_without_time_or_signal_says_so() {
        let of = |signals: &[Signal]| {
            Mapping(signals.iter().map(|&signal| Some(ColumnMeaning { signal, unit: signal.units()[0] })).collect())
        };
        assert_eq!(of(&[Signal::Time, Signal::Level(0)]).check(), Ok(()));
        assert_eq!(of(&[Signal::Level(0)]).check(), Err(RecordError::NoTime));
        assert_eq!(of(&[Signal::Time]).check(), Err(RecordError::NoSignal));
        let twice = RecordError::SameSignal { columns: [2, 3], signal: Signal::Level(1) };
        assert_eq!(of(&[Signal::Time, Signal::Level(1), Signal::Level(1)]).check(), Err(twice));
    }
}

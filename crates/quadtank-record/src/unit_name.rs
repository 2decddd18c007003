//! Units in the names of columns.

use crate::{Signal, Unit};

/// The unit in the name of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NamedUnit {
    /// A unit that fits the signal.
    Known(Unit),
    /// A unit that does not, such as `ft` or `%`, as written.
    Unknown(String),
    /// None.
    None,
}

impl NamedUnit {
    /// Reads the unit of a signal from a column name. Text in brackets or behind a slash is a unit, known or not; a word at the
    /// end only if it is known.
    pub fn of(name: &str, signal: Signal) -> Self {
        let small = plain(name);
        let known = match signal {
            Signal::Inflow(_) => unit_of_flow(&small),
            _ => unit_of(signal, split_unit(&small).1),
        };
        match (known, enclosed(name)) {
            (Some(unit), _) => Self::Known(unit),
            (None, Some(unit)) => Self::Unknown(unit.to_owned()),
            (None, None) => Self::None,
        }
    }

    /// The unit; the default one of the signal where the name gives none.
    pub fn or_usual(&self, signal: Signal) -> Unit {
        if let Self::Known(unit) = self { *unit } else { signal.units()[0] }
    }
}

/// Small letters without accents.
pub(crate) fn plain(name: &str) -> String {
    let accents = [('á', 'a'), ('é', 'e'), ('ê', 'e'), ('í', 'i'), ('ó', 'o'), ('ú', 'u'), ('ç', 'c'), ('ã', 'a')];
    let bare = |c: char| accents.iter().find(|(accent, _)| *accent == c).map_or(c, |(_, bare)| *bare);
    name.to_lowercase().chars().map(bare).collect()
}

/// A name and the unit behind it: `h1 (cm)`, `h1 [cm]`, `h1/cm`, `level_1_m`, `h1 cm`.
pub(crate) fn split_unit(name: &str) -> (&str, &str) {
    match name.rsplit_once(['(', '[', '/', '_', ' ']) {
        Some((words, unit)) => {
            let unit = unit.trim_end_matches([')', ']']).trim();
            if unit.chars().any(|c| c.is_ascii_digit()) { (name, "") } else { (words, unit) }
        }
        None => (name, ""),
    }
}

/// What stands in brackets at the end of a name, or behind its last slash, as units do; `None` for what has blanks or digits, as no
/// unit of a level, a voltage or a time has.
fn enclosed(name: &str) -> Option<&str> {
    let name = name.trim();
    let inside = name.strip_suffix([')', ']']).and_then(|open| open.rsplit_once(['(', '[']));
    let unit = inside.or_else(|| name.rsplit_once('/')).map(|(_, unit)| unit.trim())?;
    (!unit.is_empty() && !unit.contains(|c: char| c.is_whitespace() || c.is_ascii_digit())).then_some(unit)
}

/// The unit of an inflow, found anywhere in the name of its column. [`split_unit`] cannot read `cm3/s`:
/// it splits at the slash and takes nothing with a digit for a unit.
fn unit_of_flow(name: &str) -> Option<Unit> {
    let has = |parts: &[&str]| parts.iter().any(|part| name.contains(part));
    if has(&["l/min", "lpm"]) {
        Some(Unit::LitrePerMinute)
    } else if has(&["cm3", "cm³"]) {
        Some(Unit::CubicCentimetre)
    } else {
        has(&["m3", "m³"]).then_some(Unit::CubicMetre)
    }
}

/// Units as people write them in English, Portuguese and Spanish, without accents, beside their symbols.
const UNIT_WORDS: [(Unit, &[&str]); 9] = [
    (Unit::Second, &["sec", "secs", "seg", "segs", "second", "seconds", "segundo", "segundos"]),
    (Unit::Millisecond, &["msec", "mseg", "milliseconds"]),
    (Unit::Minute, &["mins", "minute", "minutes", "minuto", "minutos"]),
    (Unit::Hour, &["hr", "hrs", "hour", "hours", "hora", "horas"]),
    (Unit::Metre, &["meter", "meters", "metre", "metres", "metro", "metros"]),
    (Unit::Centimetre, &["centimeters", "centimetres", "centimetros", "cms"]),
    (Unit::Millimetre, &["millimeters", "millimetres", "milimetros"]),
    (Unit::Inch, &["inch", "inches", "polegadas", "pulgadas"]),
    (Unit::Volt, &["volt", "volts", "voltios"]),
];

/// The unit of a signal by its symbol or its word.
fn unit_of(signal: Signal, symbol: &str) -> Option<Unit> {
    // A level in volts is the signal of its sensor.
    let is_sensor = |unit: Unit, word: Unit| unit == word || (unit, word) == (Unit::SensorVolt, Unit::Volt);
    let is_word = |unit: Unit| UNIT_WORDS.iter().any(|(word, all)| is_sensor(unit, *word) && all.contains(&symbol));
    signal.units().iter().copied().find(|&unit| unit.symbol().eq_ignore_ascii_case(symbol) || is_word(unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_that_is_not_said_or_not_known_is_told() {
        let level = Signal::Level(0);
        for name in ["h1", "Tank 1", "level_1", "h1 (tank 1)", "h1 measured", "h1_raw", ""] {
            assert_eq!(NamedUnit::of(name, level), NamedUnit::None, "{name}");
        }
        for (name, unit) in [("h1 (ft)", "ft"), ("h1 [%]", "%"), ("y1/feet", "feet"), ("Level 1 (cmH)", "cmH")] {
            assert_eq!(NamedUnit::of(name, level), NamedUnit::Unknown(unit.to_owned()), "{name}");
        }
        assert_eq!(NamedUnit::of("inflow 3", Signal::Inflow(2)), NamedUnit::None);
        assert_eq!(NamedUnit::of("inflow 3 (gpm)", Signal::Inflow(2)), NamedUnit::Unknown("gpm".to_owned()));
        assert_eq!(NamedUnit::of("u1 (kV)", Signal::PumpVoltage(0)), NamedUnit::Unknown("kV".to_owned()));
    }
}

//! Between the SI units of the core and the units on the screen. The only place that converts.

use quadtank::literature::DisplayUnit;

/// Shown units in a metre.
pub const fn per_metre(unit: DisplayUnit) -> f64 {
    match unit {
        DisplayUnit::Cm => 100.0,
        DisplayUnit::Mm => 1000.0,
        DisplayUnit::M => 1.0,
    }
}

/// A length (m) in the shown unit.
pub fn to_shown(metres: f64, unit: DisplayUnit) -> f64 {
    metres * per_metre(unit)
}

/// A length in the shown unit in m.
pub fn to_metres(shown: f64, unit: DisplayUnit) -> f64 {
    shown / per_metre(unit)
}

/// Abbreviation of the unit.
pub const fn unit_name(unit: DisplayUnit) -> &'static str {
    match unit {
        DisplayUnit::Cm => "cm",
        DisplayUnit::Mm => "mm",
        DisplayUnit::M => "m",
    }
}

/// Decimals of a level in this unit: the sources print tenths of a millimetre at most, and one more tells a drift.
pub const fn length_digits(unit: DisplayUnit) -> usize {
    match unit {
        DisplayUnit::Cm => 2,
        DisplayUnit::Mm => 1,
        DisplayUnit::M => 4,
    }
}

/// Decimals that a length in a field has beyond those in centimetres, so that it tells millimetres apart.
pub const fn finer_digits(unit: DisplayUnit) -> usize {
    match unit {
        DisplayUnit::Cm | DisplayUnit::Mm => 0,
        DisplayUnit::M => 2,
    }
}

/// The unit of a field that is not that of the document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShownUnit {
    /// Its abbreviation; empty for none.
    pub name: &'static str,
    /// How many make one unit of the document.
    pub per_unit: f64,
}

impl ShownUnit {
    /// Of flows (m³/s).
    pub const FLOW: Self = Self { name: "cm³/s", per_unit: 1e6 };
    /// Of small areas (m²).
    pub const SMALL_AREA: Self = Self { name: "mm²", per_unit: 1e6 };
    /// Of shares.
    pub const PER_CENT: Self = Self { name: "%", per_unit: 100.0 };

    /// Of lengths (m).
    pub const fn length(unit: DisplayUnit) -> Self {
        Self { name: unit_name(unit), per_unit: per_metre(unit) }
    }

    /// The unit of the document, by a name of the bench.
    pub const fn called(name: &'static str) -> Self {
        Self { name, per_unit: 1.0 }
    }
}

//! Between the SI units of the core and the units on the screen. The only place that converts.

use quadtank::literature::DisplayUnit;

/// Shown units in a metre.
pub const fn per_metre(unit: DisplayUnit) -> f64 {
    match unit {
        DisplayUnit::Cm => 100.0,
        DisplayUnit::Mm => 1000.0,
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
    }
}

/// Decimals of a level in this unit: the sources print tenths of a millimetre at most, and one more tells a drift.
pub const fn length_digits(unit: DisplayUnit) -> usize {
    match unit {
        DisplayUnit::Cm => 2,
        DisplayUnit::Mm => 1,
    }
}

/// Flows (m³/s) are shown in cm³/s.
pub const CM3_PER_M3: f64 = 1e6;
/// Small areas (m²) are shown in mm².
pub const MM2_PER_M2: f64 = 1e6;

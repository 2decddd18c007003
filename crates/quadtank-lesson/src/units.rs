//! Units of tasks and of live values: factors to the SI units that quantities have.

use std::f64::consts::PI;

use thiserror::Error;

/// A unit that does not fit a quantity.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("the unit `{unit}` does not fit a quantity in `{si}`, but {}", fitting(si))]
pub struct UnitError {
    /// The unit asked for.
    pub unit: String,
    /// The unit of the quantity.
    pub si: String,
}

/// Unit, the SI unit of which it is a multiple, and the factor.
const UNITS: [(&str, &str, f64); 18] = [
    ("%", "1", 0.01),
    ("cm", "m", 0.01),
    ("mm", "m", 1e-3),
    ("min", "s", 60.0),
    ("h", "s", 3600.0),
    ("1/min", "1/s", 1.0 / 60.0),
    ("cm s", "m s", 0.01),
    ("cm² s", "m² s", 1e-4),
    ("cm s²", "m s²", 0.01),
    ("cm²", "m²", 1e-4),
    ("mm²", "m²", 1e-6),
    ("°", "rad", PI / 180.0),
    ("L/min", "m³/s", 1.0 / 60_000.0),
    ("L/s", "m³/s", 1e-3),
    ("L²/s²", "m⁶/s²", 1e-6),
    ("cm³/s", "m³/s", 1e-6),
    ("cm/s", "m/s", 0.01),
    ("cm/V", "m/V", 0.01),
];

/// The units that fit a quantity, for an error.
fn fitting(si: &str) -> String {
    let others = UNITS.iter().filter(|(_, base, _)| *base == si).map(|(unit, ..)| *unit);
    [si].into_iter().chain(others).map(|unit| format!("`{unit}`")).collect::<Vec<_>>().join(", ")
}

/// A value of a quantity, which has the unit `si`, in another unit.
///
/// # Errors
/// [`UnitError`] where the unit measures something else.
pub fn in_unit(value: f64, si: &str, unit: &str) -> Result<f64, UnitError> {
    if unit == si {
        return Ok(value);
    }
    match UNITS.iter().find(|(name, base, _)| *name == unit && *base == si) {
        Some((.., factor)) => Ok(value / factor),
        None => Err(UnitError { unit: unit.to_owned(), si: si.to_owned() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_converted_to_units_of_their_kind_only() {
        assert_eq!(in_unit(0.125, "m", "cm"), Ok(12.5));
        assert_eq!(in_unit(90.0, "s", "min"), Ok(1.5));
        assert_eq!(in_unit(2.0, "V", "V"), Ok(2.0));
        assert!(in_unit(2.0, "V", "cm").is_err());
    }
}

//! What the laboratory finds, as it is written to JSON: complex numbers as `{"re", "im"}`, matrices by rows, and where theory has
//! no answer the typed error in its place. A number that is not finite is `null`.
//!
//! One module for each version of the documents. What `simulate` finds of version 1 is a
//! [`Run`](quadtank::study::quadruple_tank::Run), which is its own report.

use nalgebra::Matrix2;
use quadtank::linear::{Complex, LinearError};
use serde::Serialize;

pub mod level_loop;
pub mod model_free;
pub mod quadruple;
pub mod tuning;

/// A complex number; its unit is that of the field that contains it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComplexNumber {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

/// A value, or the error that explains why there is none.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(untagged)]
pub enum Answer<T, E = LinearError> {
    /// The answer.
    Value(T),
    /// The error in its place.
    Error(E),
}

impl<T, E: Copy> Answer<T, E> {
    fn of<'a, S>(result: &'a Result<S, E>, report: impl FnOnce(&'a S) -> T) -> Self {
        result.as_ref().map_or_else(|error| Self::Error(*error), |value| Self::Value(report(value)))
    }
}

impl From<Complex> for ComplexNumber {
    fn from(number: Complex) -> Self {
        Self { re: number.re, im: number.im }
    }
}

fn complex_numbers(numbers: &[Complex]) -> Vec<ComplexNumber> {
    numbers.iter().copied().map(ComplexNumber::from).collect()
}

/// A 2 × 2 matrix by rows.
fn rows<T: Copy, S: From<T>>(matrix: &Matrix2<T>) -> [[S; 2]; 2] {
    [0, 1].map(|row| [0, 1].map(|column| matrix[(row, column)].into()))
}

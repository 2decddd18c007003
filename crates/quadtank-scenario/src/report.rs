use nalgebra::{DMatrix, DVector};
use serde::Serialize;

use quadtank::interaction::PairingVerdict;
use quadtank::linear::{Complex, LinearError, Stability, TransmissionZero};
use quadtank::plant::{OperatingPoint, PlantError};

use quadtank::study::quadruple_tank::{Analysis, GuaranteedMargins};

/// An [`Analysis`] as it is written to JSON: complex numbers as `{"re", "im"}`, matrices by rows, and where theory has
/// no answer the typed error in its place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AnalysisReport {
    operating_point: OperatingPoint,
    out_of_range: Vec<PlantError>,
    time_constants_s: [Option<f64>; 4],
    model: Model,
    poles: Vec<Point>,
    zeros: Answer<Vec<Zero>>,
    dc_gain: [[f64; 2]; 2],
    rga_11: Answer<f64>,
    niederlinski: ByPairing,
    suggestion: PairingVerdict,
    closed_loop: Loop,
}

/// What was asked for, or why there is no answer.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
enum Answer<T> {
    Value(T),
    Error(LinearError),
}

impl<T> Answer<T> {
    fn of<S>(result: &Result<S, LinearError>, report: impl Fn(&S) -> T) -> Self {
        result.as_ref().map_or_else(|error| Self::Error(*error), |value| Self::Value(report(value)))
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
struct Point {
    re: f64,
    im: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Model {
    a: Vec<Vec<f64>>,
    b: Vec<Vec<f64>>,
    c: Vec<Vec<f64>>,
    d: Vec<Vec<f64>>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Zero {
    value: Point,
    input_direction: Vec<Point>,
    output_direction: Vec<Point>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
struct ByPairing {
    diagonal: Option<f64>,
    swapped: Option<f64>,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
struct Loop {
    stability: Stability,
    poles_z: Vec<Point>,
    poles_s: Vec<Point>,
    sensitivity_peak: Option<f64>,
    guaranteed_margins: Option<GuaranteedMargins>,
}

impl From<&Analysis> for AnalysisReport {
    fn from(analysis: &Analysis) -> Self {
        let [diagonal, swapped] = analysis.niederlinski;
        let model = &analysis.model;
        let closed_loop = &analysis.closed_loop;
        Self {
            operating_point: analysis.operating_point,
            out_of_range: analysis.out_of_range.clone(),
            time_constants_s: analysis.time_constants_s,
            model: Model { a: rows(&model.a), b: rows(&model.b), c: rows(&model.c), d: rows(&model.d) },
            poles: points(&analysis.poles),
            zeros: Answer::of(&analysis.zeros, |zeros| zeros.iter().map(Zero::from).collect()),
            dc_gain: analysis.dc_gain,
            rga_11: Answer::of(&analysis.rga_11, |gain| *gain),
            niederlinski: ByPairing { diagonal, swapped },
            suggestion: analysis.verdict,
            closed_loop: Loop {
                stability: closed_loop.stability,
                poles_z: points(&closed_loop.poles_z),
                poles_s: points(&closed_loop.poles_s),
                sensitivity_peak: closed_loop.sensitivity_peak,
                guaranteed_margins: closed_loop.sensitivity_peak.map(GuaranteedMargins::of),
            },
        }
    }
}

impl From<&TransmissionZero> for Zero {
    fn from(zero: &TransmissionZero) -> Self {
        let direction = |vector: &DVector<Complex>| points(vector.as_slice());
        Self {
            value: Point::from(zero.value),
            input_direction: direction(&zero.input_direction),
            output_direction: direction(&zero.output_direction),
        }
    }
}

impl From<Complex> for Point {
    fn from(number: Complex) -> Self {
        Self { re: number.re, im: number.im }
    }
}

fn points(numbers: &[Complex]) -> Vec<Point> {
    numbers.iter().copied().map(Point::from).collect()
}

fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

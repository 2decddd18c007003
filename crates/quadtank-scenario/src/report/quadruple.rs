//! What theory says of a setup of the quadruple tank, version 1.

use nalgebra::DMatrix;
use quadtank::interaction::PairingVerdict;
use quadtank::linear::{ClosedLoop, Stability, StateSpace, TransmissionZero};
use quadtank::plant::{FlowFractions, OperatingPoint, PlantError};
use quadtank::study::quadruple_tank::{Analysis, GuaranteedMargins};
use serde::Serialize;

use super::{Answer, ComplexNumber, complex_numbers};

/// What linear theory says of a setup at its operating point.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AnalysisReport {
    /// Levels (m) and pump voltages (V), walls and limits ignored.
    pub operating_point: OperatingPoint,
    /// Where the walls (m) or the pumps (V) do not allow it.
    pub out_of_range: Vec<PlantError>,
    /// How fast the levels leave an operating point that is not at rest by themselves (m/s); absent at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift: Option<[f64; 4]>,
    /// How the valves divide flows; absent where they divide any flow alike.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flow_fractions: Option<FlowFractions>,
    /// Time constants T1…T4 (s); null for a tank that is dry.
    pub time_constants_s: [Option<f64>; 4],
    /// The linear model without dry tanks: inputs pump voltages (V), outputs measured signals (V), states levels (m).
    pub model: LinearModel,
    /// Open-loop poles (1/s).
    pub poles: Vec<ComplexNumber>,
    /// Transmission zeros, by rising real part; an error where the plant is singular for every s.
    pub zeros: Answer<Vec<Zero>>,
    /// G(0), by rows (V/V).
    pub dc_gain: [[f64; 2]; 2],
    /// λ11 of the relative gain array at steady state (no unit); an error where G(0) is singular.
    pub rga_11: Answer<f64>,
    /// Niederlinski index of both pairings (no unit).
    pub niederlinski: ByPairing,
    /// Which pairing is suggested, and by which rule.
    pub suggestion: PairingVerdict,
    /// The sampled closed loop with the controller of the setup.
    pub closed_loop: ClosedLoopReport,
}

/// Matrices of a state-space model, by rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LinearModel {
    /// A (1/s).
    pub a: Vec<Vec<f64>>,
    /// B (m/(s V)).
    pub b: Vec<Vec<f64>>,
    /// C (V/m).
    pub c: Vec<Vec<f64>>,
    /// D (V/V).
    pub d: Vec<Vec<f64>>,
}

/// A transmission zero with its directions, which have length 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Zero {
    /// Where it is (1/s).
    pub value: ComplexNumber,
    /// Direction of the pump voltages that pass nothing (no unit).
    pub input_direction: Vec<ComplexNumber>,
    /// Direction of the measured signals that no input moves there (no unit).
    pub output_direction: Vec<ComplexNumber>,
}

/// A number for each pairing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ByPairing {
    /// Of the diagonal one; null where it is not defined.
    pub diagonal: Option<f64>,
    /// Of the swapped one; null where it is not defined.
    pub swapped: Option<f64>,
}

/// The sampled closed loop.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ClosedLoopReport {
    /// Whether it is stable.
    pub stability: Stability,
    /// Whether a hose delays a pump. Such a loop has a pole more for each sample of the delay: none is listed.
    pub has_dead_time: bool,
    /// Poles in the z-plane (no unit), by falling modulus; empty with dead time.
    pub poles_z: Vec<ComplexNumber>,
    /// The same mapped to the s-plane, ln(z)/Ts (1/s); a pole at z = 0 has no image and is left out.
    pub poles_s: Vec<ComplexNumber>,
    /// Peak Ms of the largest singular value of the sensitivity (no unit); null when the loop is not stable.
    pub sensitivity_peak: Option<f64>,
    /// Frequency of this peak (rad/s); null when the loop is not stable.
    pub sensitivity_peak_frequency: Option<f64>,
    /// Margins that this peak guarantees in each channel; null when the loop is not stable.
    pub guaranteed_margins: Option<GuaranteedMargins>,
}

impl From<&Analysis> for AnalysisReport {
    fn from(analysis: &Analysis) -> Self {
        let [diagonal, swapped] = analysis.linear.niederlinski;
        Self {
            operating_point: analysis.operating_point,
            drift: analysis.drift,
            flow_fractions: analysis.flow_fractions,
            out_of_range: analysis.out_of_range.clone(),
            time_constants_s: analysis.time_constants_s,
            model: LinearModel::from(&analysis.linear.model),
            poles: complex_numbers(&analysis.linear.poles),
            zeros: Answer::of(&analysis.linear.zeros, |zeros| zeros.iter().map(Zero::from).collect()),
            dc_gain: analysis.linear.dc_gain,
            rga_11: Answer::of(&analysis.linear.rga_11, |gain| *gain),
            niederlinski: ByPairing { diagonal, swapped },
            suggestion: analysis.linear.verdict,
            closed_loop: ClosedLoopReport::from(&analysis.closed_loop),
        }
    }
}

impl From<&StateSpace> for LinearModel {
    fn from(model: &StateSpace) -> Self {
        Self { a: rows(&model.a), b: rows(&model.b), c: rows(&model.c), d: rows(&model.d) }
    }
}

impl From<&TransmissionZero> for Zero {
    fn from(zero: &TransmissionZero) -> Self {
        Self {
            value: zero.value.into(),
            input_direction: complex_numbers(zero.input_direction.as_slice()),
            output_direction: complex_numbers(zero.output_direction.as_slice()),
        }
    }
}

impl From<&ClosedLoop> for ClosedLoopReport {
    fn from(closed_loop: &ClosedLoop) -> Self {
        Self {
            stability: closed_loop.stability,
            has_dead_time: closed_loop.has_dead_time,
            poles_z: complex_numbers(&closed_loop.poles_z),
            poles_s: complex_numbers(&closed_loop.poles_s),
            sensitivity_peak: closed_loop.sensitivity_peak.map(|peak| peak.value),
            sensitivity_peak_frequency: closed_loop.sensitivity_peak.map(|peak| peak.frequency),
            guaranteed_margins: closed_loop.sensitivity_peak.map(|peak| GuaranteedMargins::of(peak.value)),
        }
    }
}

fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
}

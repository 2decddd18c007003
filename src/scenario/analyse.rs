use crate::interaction::PairingVerdict;
use crate::linear::{Complex, LinearError, StateSpace, TransmissionZero};
use crate::plant::{OperatingPoint, PlantError};
use crate::sim::ClosedLoop;

/// All that linear theory says about a setup, at the exact equilibrium of its inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// The equilibrium; walls and pump limits are ignored so that theory goes on where the rig would overflow.
    pub operating_point: OperatingPoint,
    /// Where the walls or the pumps do not allow this equilibrium.
    pub out_of_range: Vec<PlantError>,
    /// T1…T4 (s); `None` for a tank that is dry.
    pub time_constants_s: [Option<f64>; 4],
    /// The linear model without dry tanks: inputs pump voltages, outputs measured signals.
    pub model: StateSpace,
    /// Open-loop poles (1/s).
    pub poles: Vec<Complex>,
    /// Transmission zeros, by rising real part; an error where the plant is singular for every s.
    pub zeros: Result<Vec<TransmissionZero>, LinearError>,
    /// G(0), by rows (V/V).
    pub dc_gain: [[f64; 2]; 2],
    /// λ11 of the relative gain array at steady state; an error where G(0) is singular.
    pub rga_11: Result<f64, LinearError>,
    /// Niederlinski index of the diagonal and of the swapped pairing; `None` where a paired gain is 0.
    pub niederlinski: [Option<f64>; 2],
    /// Which pairing is suggested, and by which rule.
    pub verdict: PairingVerdict,
    /// The sampled closed loop with the controller of the setup.
    pub closed_loop: ClosedLoop,
    /// Largest singular value of the sensitivity over frequency, Ms; `None` when the loop is not stable.
    pub sensitivity_peak: Option<f64>,
}

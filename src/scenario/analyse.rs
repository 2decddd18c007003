use crate::interaction::{
    PairingVerdict, interpolation_integral, niederlinski, recommend_pairing, relative_gain_array,
};
use crate::linear::{Complex, LinearError, StateSpace, TransmissionZero, transmission_zeros};
use crate::plant::{OperatingPoint, PlantError};
use crate::sim::{ClosedLoop, Experiment, closed_loop};

use super::{ScenarioError, Setup};

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
}

/// Asks linear theory about a setup.
///
/// # Errors
/// [`ScenarioError::Plant`] when levels are given and no input holds them, [`ScenarioError::Linear`] when the model has
/// no poles or no steady-state gain. Questions that only singular plants leave open are answered by an error in place.
pub fn analyse(setup: &Setup) -> Result<Analysis, ScenarioError> {
    let plant = setup.plant();
    let operating_point = setup.operating_point()?;
    let jacobian = plant.linearise(&operating_point);
    let (a, b, c) = jacobian.reduced();
    let model = StateSpace::strictly_proper(a, b, c)?;
    let gain = model.dc_gain()?;
    Ok(Analysis {
        operating_point,
        out_of_range: plant.violations(&operating_point),
        time_constants_s: plant.time_constants_s(&operating_point),
        poles: model.poles()?,
        zeros: transmission_zeros(&model),
        dc_gain: [[gain[(0, 0)], gain[(0, 1)]], [gain[(1, 0)], gain[(1, 1)]]],
        rga_11: relative_gain_array(&gain).map(|array| array[(0, 0)]),
        niederlinski: niederlinski(&gain),
        verdict: recommend_pairing(&gain),
        closed_loop: closed_loop(&jacobian, &setup.controller, plant.power_gain)?,
        model,
    })
}

impl Analysis {
    /// The relative gain array by rows; its rows and columns sum to 1. `None` where G(0) is singular.
    pub fn rga(&self) -> Option<[[f64; 2]; 2]> {
        let lambda = *self.rga_11.as_ref().ok()?;
        Some([[lambda, 1.0 - lambda], [1.0 - lambda, lambda]])
    }

    /// The right-most transmission zero, which limits the loops.
    pub fn rightmost_zero(&self) -> Option<&TransmissionZero> {
        self.zeros.as_ref().ok()?.last()
    }

    /// `∫ ηᵀe(t) e^(−zt) dt` (m s) from the first set-point step of an experiment on, for every stabilising controller
    /// (see [`interpolation_integral`]). `None` without a zero in the right half-plane or without a step.
    pub fn interpolation_integral(&self, experiment: &Experiment) -> Option<f64> {
        interpolation_integral(self.rightmost_zero()?, experiment.first_reference_step()?)
    }
}

use crate::control::closed_loop;
use crate::interaction::{
    PairingVerdict, interpolation_integral, niederlinski, recommend_pairing, relative_gain_array,
};
use crate::linear::{
    ClosedLoop, Complex, LinearError, StateSpace, TransmissionZero, place_nearest_at_origin, transmission_zeros,
};
use crate::plant::{OperatingPoint, PlantError};
use crate::sim::Experiment;

use super::{Prepared, Setup};
use crate::study::StudyError;

/// Relative gains above 5 to 10 make a plant hard to control (Skogestad and Postlethwaite 2005, §3.4).
const LARGE_RELATIVE_GAIN: f64 = 5.0;

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
    /// Transmission zeros, by rising real part, one of them exactly zero where G(0) is singular; an error where the plant is singular for every s.
    pub zeros: Result<Vec<TransmissionZero>, LinearError>,
    /// G(0), by rows (V/V).
    pub dc_gain: [[f64; 2]; 2],
    /// λ11 of the relative gain array at steady state; an error where G(0) is singular.
    pub rga_11: Result<f64, LinearError>,
    /// Niederlinski index of the diagonal and of the swapped pairing; `None` where a paired gain is 0, and where G(0) is singular,
    /// because its sign is rounding there.
    pub niederlinski: [Option<f64>; 2],
    /// Which pairing is suggested, and by which rule.
    pub verdict: PairingVerdict,
    /// The sampled closed loop with the controller of the setup.
    pub closed_loop: ClosedLoop,
}

/// Asks linear theory about a setup.
///
/// # Errors
/// [`StudyError`] at `operating_point` when levels are given and no input holds them, at `plant` when the model has
/// no poles or no steady-state gain. Questions that only singular plants leave open are answered by an error in place.
///
/// # Examples
/// λ11 = γ1 γ2/(γ1 + γ2 − 1) = 1.4 for the valves 0.7 and 0.6 of Johansson (2000).
/// ```
/// use quadtank::literature::PresetId;
/// use quadtank::study::quadruple_tank::{analyse, setup_of};
///
/// let analysis = analyse(&setup_of(PresetId::JohanssonMinimumPhase))?;
/// let lambda = analysis.rga_11.expect("the gain is not singular");
/// assert!((lambda - 1.4).abs() < 1e-9);
/// # Ok::<(), quadtank::study::StudyError>(())
/// ```
pub fn analyse(setup: &Setup) -> Result<Analysis, StudyError> {
    Analysis::of(&Prepared::of(setup)?, setup)
}

impl Analysis {
    /// The analysis of a setup that is prepared.
    ///
    /// # Errors
    /// As [`analyse`], but for the operating point.
    pub fn of(prepared: &Prepared, setup: &Setup) -> Result<Self, StudyError> {
        let Prepared { plant, operating_point, jacobian } = prepared;
        let (a, b, c) = jacobian.reduced();
        let model = StateSpace::strictly_proper(a, b, c)?;
        let gain = model.dc_gain()?;
        let rga_11 = relative_gain_array(&gain).map(|array| array[(0, 0)]);
        let poles = model.poles()?;
        let mut zeros = transmission_zeros(&model);
        if let (Ok(zeros), Err(LinearError::SingularGain { .. })) = (&mut zeros, &rga_11) {
            place_nearest_at_origin(zeros);
        }
        Ok(Self {
            operating_point: *operating_point,
            out_of_range: plant.violations(operating_point),
            time_constants_s: plant.time_constants_s(operating_point),
            poles,
            zeros,
            dc_gain: [[gain[(0, 0)], gain[(0, 1)]], [gain[(1, 0)], gain[(1, 1)]]],
            niederlinski: if rga_11.is_ok() { niederlinski(&gain) } else { [None; 2] },
            rga_11,
            verdict: recommend_pairing(&gain),
            closed_loop: closed_loop(jacobian, &setup.controller, plant.power_gain)?,
            model,
        })
    }

    /// The relative gain array by rows; its rows and columns sum to 1. `None` where G(0) is singular.
    pub fn rga(&self) -> Option<[[f64; 2]; 2]> {
        let lambda = *self.rga_11.as_ref().ok()?;
        Some([[lambda, 1.0 - lambda], [1.0 - lambda, lambda]])
    }

    /// Whether relative gains are so large that some directions need far more input than others: the plant is hard to control.
    pub fn has_large_relative_gains(&self) -> bool {
        self.rga_11.is_ok_and(|gain| gain.abs() > LARGE_RELATIVE_GAIN)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::PresetId;
    use crate::study::quadruple_tank::setup_of;

    #[test]
    fn on_the_line_the_zero_is_at_the_origin_and_nothing_of_rounding_is_told() {
        for k in 1..20 {
            let gamma = f64::from(k) * 0.05;
            let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
            setup.valves = [gamma, 1.0 - gamma];
            let analysis = analyse(&setup).unwrap();
            let zeros = analysis.zeros.unwrap();
            assert!(zeros.iter().any(|zero| zero.value == Complex::ZERO), "{gamma}: {zeros:?}");
            assert!(analysis.rga_11.is_err());
            assert_eq!(analysis.niederlinski, [None; 2]);
            assert_eq!(analysis.closed_loop.slowest(), Some(Complex::ZERO), "{gamma}");
        }
        // Beside the line the zero is as small as may be, and is told.
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.valves = [0.5, 0.5 + 1e-8];
        let right_most = analyse(&setup).unwrap().rightmost_zero().unwrap().value.re;
        assert!(right_most < 0.0 && right_most > -1e-8, "{right_most}");
    }
}

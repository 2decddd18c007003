use crate::control::closed_loop;
use crate::interaction::interpolation_integral;
use crate::linear::ClosedLoop;
use crate::plant::{FlowFractions, OperatingPoint, PlantError};
use crate::sim::Experiment;
use crate::study::{LinearPlant, StudyError};

use super::{Prepared, Setup, ZeroSituation};

/// All that linear theory says about a setup, at the exact equilibrium of its inputs or at a state of one's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// The operating point; walls and pump limits are ignored so that theory goes on where the rig would overflow.
    pub operating_point: OperatingPoint,
    /// Where the walls or the pumps do not allow it.
    pub out_of_range: Vec<PlantError>,
    /// How fast the levels leave the operating point by themselves (m/s), the loops being open; `None` at rest.
    pub drift: Option<[f64; 4]>,
    /// How the valves divide the flows there; `None` where they divide any flow alike, by the fractions of the setup.
    pub flow_fractions: Option<FlowFractions>,
    /// T1…T4 (s); `None` for a tank that is dry.
    pub time_constants_s: [Option<f64>; 4],
    /// The linear plant around the operating point.
    pub linear: LinearPlant,
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
/// let lambda = analysis.linear.rga_11.expect("the gain is not singular");
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
        Ok(Self {
            operating_point: *operating_point,
            out_of_range: plant.violations(operating_point),
            drift: (!jacobian.is_at_rest()).then(|| jacobian.drift.into()),
            flow_fractions: plant.flow_fractions(operating_point.pump_voltage),
            time_constants_s: plant.time_constants_s(operating_point),
            linear: LinearPlant::of(jacobian)?,
            closed_loop: closed_loop(jacobian, &setup.controller, plant.power_gain)?,
        })
    }

    /// Valve fractions of the linear model: incremental ones where the fractions depend on the flow, else those of the setup.
    pub fn linear_valves(&self, setup: &Setup) -> [f64; 2] {
        self.flow_fractions.map_or(setup.valves, |fractions| fractions.incremental)
    }

    /// Where the right-most transmission zero is.
    pub fn zero_situation(&self, setup: &Setup) -> ZeroSituation {
        ZeroSituation::of(&self.linear, self.linear_valves(setup))
    }

    /// `∫ ηᵀe(t) e^(−zt) dt` (m s) from the first set-point step of an experiment on, for every stabilising controller
    /// (see [`interpolation_integral`]). `None` without a zero in the right half-plane or without a step.
    pub fn interpolation_integral(&self, experiment: &Experiment) -> Option<f64> {
        interpolation_integral(self.linear.rightmost_zero()?, experiment.first_reference_step()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::Complex;
    use crate::literature::PresetId;
    use crate::study::quadruple_tank::setup_of;

    #[test]
    fn on_the_line_the_zero_is_at_the_origin_and_nothing_of_rounding_is_told() {
        for k in 1..20 {
            let gamma = f64::from(k) * 0.05;
            let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
            setup.valves = [gamma, 1.0 - gamma];
            let analysis = analyse(&setup).unwrap();
            let zeros = analysis.linear.zeros.unwrap();
            assert!(zeros.iter().any(|zero| zero.value == Complex::ZERO), "{gamma}: {zeros:?}");
            assert!(analysis.linear.rga_11.is_err());
            assert_eq!(analysis.linear.niederlinski, [None; 2]);
            assert_eq!(analysis.closed_loop.rightmost_pole(), Some(Complex::ZERO), "{gamma}");
        }
        // Beside the line the zero is as small as may be, and is told.
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.valves = [0.5, 0.5 + 1e-8];
        let right_most = analyse(&setup).unwrap().linear.rightmost_zero().unwrap().value.re;
        assert!(right_most < 0.0 && right_most > -1e-8, "{right_most}");
    }
}

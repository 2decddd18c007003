use nalgebra::Matrix2;
use serde::{Deserialize, Serialize};

use crate::control::{ParallelPid, PidMatrix};
use crate::linear::{Complex, LinearError, TransferMatrix};

use super::TuningError;
use super::error::positive;
use super::placement::{ControllerPair, integral_action_may_be_stable, place_both_loci, place_one_locus};

/// Which loci a placement moves to the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum PlacementMethod {
    /// Method A: one locus, both controllers alike.
    OneLocus,
    /// Method B: both loci.
    BothLoci,
}

/// Which actions the controllers have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Action {
    /// Proportional and integral.
    Pi,
    /// With a derivative, Td = Ti/4.
    Pid,
}

/// What to beware of with a pair of controllers (Campestrini 2006, §5.4 and its tables).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", tag = "warning")]
pub enum PlacementWarning {
    /// A proportional gain has the sign that its loop alone does not want.
    WrongSign {
        /// Number of the loop, 1 or 2.
        number: usize,
    },
    /// An integral gain has another sign than the loop alone wants.
    WrongIntegralSign {
        /// Number of the loop.
        number: usize,
    },
    /// `det(G(0) diag(ki)) ≤ 0`: a real pole in the right half-plane, whatever else.
    IntegralActionUnstable,
    /// Both roots of method A have the sign of the plant, so the rule of the source does not choose.
    AmbiguousRoot,
    /// Both loci meet at the target, where they are sensitive to every error of the measurement.
    DoubleEigenvalue,
    /// The target is on the wrong side of what PI reaches: the integral gain is negative relative to the proportional one.
    BeyondPi {
        /// Number of the loop.
        number: usize,
    },
    /// The target is −1 itself: the loop stays at its limit.
    OnMinusOne,
}

/// One root of a placement with all that follows.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// What the controllers are at the critical frequency.
    pub pair: ControllerPair,
    /// Their gains.
    pub controllers: [ParallelPid; 2],
    /// What to beware of.
    pub warnings: Vec<PlacementWarning>,
}

impl Proposal {
    /// Both controllers as a matrix.
    pub fn matrix(&self) -> PidMatrix {
        PidMatrix::decentralised(self.controllers)
    }
}

/// Distance from −1 below which a target is −1.
const ON_MINUS_ONE: f64 = 1e-6;

/// Both roots of a placement at a frequency, root 1 the one with the larger controller in loop 1. `g` is G(jω), of the plant
/// or as measured; G(0) gives the signs, and for method A the ratio of the controllers.
///
/// # Errors
/// [`TuningError::OutOfRange`] for a frequency that is not positive or a target that is 0 or not finite;
/// [`LinearError::SingularGain`] where G(0) has a zero on its diagonal or a determinant of zero, or no controller exists.
pub fn propose(
    dc_gain: &Matrix2<f64>,
    g: &Matrix2<Complex>,
    frequency: f64,
    method: PlacementMethod,
    action: Action,
    target: Complex,
) -> Result<[Proposal; 2], TuningError> {
    positive("frequency", frequency)?;
    if target == Complex::ZERO || !target.is_finite() {
        return Err(TuningError::OutOfRange { field: "target", value: target.re });
    }
    let singular = TuningError::Linear(LinearError::SingularGain { reciprocal_condition: 0.0 });
    let [g11, g22] = [dc_gain[(0, 0)], dc_gain[(1, 1)]];
    let determinant = dc_gain.determinant();
    if [g11, g22].contains(&0.0)
        || determinant.abs() <= f64::EPSILON * dc_gain.norm_squared()
        || !determinant.is_finite()
    {
        return Err(singular);
    }
    let pairs = match method {
        PlacementMethod::OneLocus => place_one_locus(g, target, g11 / g22),
        PlacementMethod::BothLoci => place_both_loci(g, target),
    };
    let through = |p: Complex| match action {
        Action::Pi => Some(ParallelPid::pi_through(p, frequency)),
        Action::Pid => ParallelPid::pid_through(p, frequency),
    };
    let fits = |pair: &ControllerPair| pair[0].re * g11 > 0.0;
    let ambiguous = method == PlacementMethod::OneLocus && pairs.iter().all(fits);
    let proposal = |pair: ControllerPair| {
        let finite = pair.iter().all(|p| p.is_finite());
        let (Some(first), Some(second)) = (through(pair[0]), through(pair[1])) else { return Err(singular) };
        if !finite {
            return Err(singular);
        }
        let controllers = [first, second];
        let mut warnings = warnings(dc_gain, controllers, action);
        let general = [
            (ambiguous, PlacementWarning::AmbiguousRoot),
            (method == PlacementMethod::BothLoci, PlacementWarning::DoubleEigenvalue),
            ((target + 1.0).norm() < ON_MINUS_ONE, PlacementWarning::OnMinusOne),
        ];
        warnings.extend(general.into_iter().filter(|(holds, _)| *holds).map(|(_, warning)| warning));
        Ok(Proposal { pair, controllers, warnings })
    };
    let [one, two] = pairs;
    Ok([proposal(one)?, proposal(two)?])
}

fn warnings(dc_gain: &Matrix2<f64>, controllers: [ParallelPid; 2], action: Action) -> Vec<PlacementWarning> {
    let mut found = Vec::new();
    for (i, pid) in controllers.iter().enumerate() {
        let (number, sign) = (i + 1, dc_gain[(i, i)]);
        if pid.proportional * sign < 0.0 {
            found.push(PlacementWarning::WrongSign { number });
        }
        if pid.integral * sign < 0.0 {
            found.push(PlacementWarning::WrongIntegralSign { number });
        }
        if action == Action::Pi && pid.integral * pid.proportional < 0.0 {
            found.push(PlacementWarning::BeyondPi { number });
        }
    }
    if !integral_action_may_be_stable(dc_gain, controllers.map(|pid| pid.integral)) {
        found.push(PlacementWarning::IntegralActionUnstable);
    }
    found
}

/// What to beware of with gains that no placement made, from G(0) with its columns in the order of the loops. The necessary condition
/// on integral action holds of two loops that both have it.
pub fn warnings_of_gains(dc_gain: &Matrix2<f64>, controllers: [ParallelPid; 2]) -> Vec<PlacementWarning> {
    let mut found = warnings(dc_gain, controllers, Action::Pid);
    if controllers.iter().any(|pid| pid.integral == 0.0) {
        found.retain(|warning| *warning != PlacementWarning::IntegralActionUnstable);
    }
    found
}

/// G(jω) of a plant.
pub fn response_at(plant: &TransferMatrix, frequency: f64) -> Matrix2<Complex> {
    plant.at(Complex::new(0.0, frequency))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::literature::campestrini::PublishedPlant;

    fn of(
        method: PlacementMethod,
        action: Action,
        re: f64,
        im: f64,
        plant: PublishedPlant,
        period: f64,
    ) -> [Proposal; 2] {
        let transfer = plant.transfer_matrix().unwrap();
        let w = TAU / period;
        propose(&transfer.dc_gain(), &response_at(&transfer, w), w, method, action, Complex::new(re, im)).unwrap()
    }

    #[test]
    fn the_warnings_of_the_published_cases() {
        use PlacementWarning as W;
        // Table 15: row 1 has a wrong proportional sign and is stable, row 2 cannot be.
        let [_, row_1] = of(PlacementMethod::BothLoci, Action::Pi, -0.2, 0.01, PublishedPlant::ProcessTwo, 1.46);
        assert!(row_1.warnings.contains(&W::WrongSign { number: 1 }));
        assert!(!row_1.warnings.contains(&W::IntegralActionUnstable));
        let [_, row_2] = of(PlacementMethod::BothLoci, Action::Pi, -0.2, 0.01, PublishedPlant::ProcessTwo, 1.35);
        assert!(row_2.warnings.contains(&W::IntegralActionUnstable));
        assert!(row_2.warnings.contains(&W::WrongIntegralSign { number: 2 }));
        // Method A in the third quadrant leaves the root open, in the second it does not.
        let third = of(PlacementMethod::OneLocus, Action::Pid, -0.6, -0.28, PublishedPlant::WoodBerry, 12.70);
        assert!(third.iter().all(|root| root.warnings.contains(&W::AmbiguousRoot)));
        let second = of(PlacementMethod::OneLocus, Action::Pi, -0.3, 0.08, PublishedPlant::WoodBerry, 12.70);
        assert!(second.iter().all(|root| !root.warnings.contains(&W::AmbiguousRoot)));
        // With PI a target below the real axis asks for a negative integral time.
        let below = of(PlacementMethod::OneLocus, Action::Pi, -0.3, -0.3, PublishedPlant::ProcessTwo, 1.46);
        assert!(below.iter().any(|root| root.warnings.contains(&W::BeyondPi { number: 1 })));
    }

    #[test]
    fn bad_targets_and_gains_are_refused() {
        let transfer = PublishedPlant::WoodBerry.transfer_matrix().unwrap();
        let g = response_at(&transfer, 0.5);
        let ask = |gain: &Matrix2<f64>, frequency: f64, target: Complex| {
            propose(gain, &g, frequency, PlacementMethod::OneLocus, Action::Pid, target).err()
        };
        let gain = transfer.dc_gain();
        assert_eq!(ask(&gain, 0.5, Complex::ZERO), Some(TuningError::OutOfRange { field: "target", value: 0.0 }));
        assert_eq!(ask(&gain, 0.0, Complex::ONE), Some(TuningError::OutOfRange { field: "frequency", value: 0.0 }));
        let singular = Some(TuningError::Linear(LinearError::SingularGain { reciprocal_condition: 0.0 }));
        assert_eq!(ask(&Matrix2::new(1.0, 2.0, 2.0, 4.0), 0.5, Complex::ONE), singular);
        assert_eq!(ask(&Matrix2::new(0.0, 1.0, 1.0, 1.0), 0.5, Complex::ONE), singular);
        let at_limit = propose(&gain, &g, 0.5, PlacementMethod::OneLocus, Action::Pi, Complex::from(-1.0)).unwrap();
        assert!(at_limit[0].warnings.contains(&PlacementWarning::OnMinusOne));
    }
}

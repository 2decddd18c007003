//! The response of a session to steps of its references, beside that of other controllers.

use std::f64::consts::TAU;

use crate::control::{Pairing, ParallelPid, PidMatrix};
use crate::interaction::{Decoupling, decoupled_paths, static_decoupler};
use crate::linear::{DelayedPlant, LoopStability, SignalPath};
use crate::literature::campestrini::{PublishedPlant, wood_berry_full_controller};
use crate::sim::{HeldPlant, LoopTrace, MAX_WORK, StepMetrics, TwoLoops, run_two_loops_within};
use crate::tuning::{Action, Design, TuningError, TuningRule, UltimatePoint};

use super::rig::nonlinear;
use super::{CompareSpec, CriticalResponse, DecouplerSpec, DesignRoot, PlantStudy, TuningPlant, TuningSetup};

/// A response and the figures of both outputs in it.
#[derive(Clone, Debug, PartialEq)]
pub struct StepResponse {
    /// The record.
    pub trace: LoopTrace,
    /// Its figures.
    pub figures: [StepMetrics; 2],
    /// Whether it stays bounded, so that its figures mean something: the loop is stable and the record went to its end. With a
    /// decoupler, which the count of encirclements does not see, or where it is not computed, only the record can tell.
    pub is_bounded: bool,
}

/// Other controllers on the same plant.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The controllers.
    pub controllers: PidMatrix,
    /// Whether the loop is stable.
    pub stability: LoopStability,
    /// The response.
    pub response: StepResponse,
}

impl StepResponse {
    /// A response of a loop with this stability.
    fn of_loop(self, stability: LoopStability) -> Self {
        let may_stay_bounded = matches!(stability, LoopStability::Stable | LoopStability::NotComputed { .. });
        Self { is_bounded: self.is_bounded && may_stay_bounded, ..self }
    }

    /// With the inputs in the order of the plant, for loops that drive them in the order of a pairing.
    fn with_inputs_of(mut self, pairing: Pairing) -> Self {
        if pairing == Pairing::Swapped {
            self.trace.inputs.swap(0, 1);
            self.trace.limited.swap(0, 1);
        }
        self
    }
}

impl PlantStudy {
    /// The response of a session with the controllers of a root and the decoupler of the session.
    pub(super) fn response_of(&self, root: &DesignRoot, setup: &TuningSetup) -> Result<StepResponse, TuningError> {
        let response = self.decoupled(root, setup)?.with_inputs_of(root.pairing);
        let is_decoupled = setup.design.decoupler != DecouplerSpec::None;
        Ok(if is_decoupled { response } else { response.of_loop(root.stability) })
    }

    fn decoupled(&self, root: &DesignRoot, setup: &TuningSetup) -> Result<StepResponse, TuningError> {
        let plant = self.wired(root.pairing);
        let controllers = PidMatrix::decentralised(root.controllers);
        let which = match setup.design.decoupler {
            DecouplerSpec::None => return self.response(controllers, root.pairing, setup),
            DecouplerSpec::Static => {
                let decoupled = PidMatrix::decoupled(root.controllers, static_decoupler(&plant)?);
                return self.response(decoupled, root.pairing, setup);
            }
            DecouplerSpec::Dynamic => Decoupling::Both,
            DecouplerSpec::FirstOutput => Decoupling::FirstOutput,
            DecouplerSpec::SecondOutput => Decoupling::SecondOutput,
        };
        // A dynamic decoupler is part of the paths, so it is simulated with the linear plant.
        linear_response(&decoupled_paths(&plant, which)?, controllers, setup)
    }

    /// The response with any controllers, of the nonlinear plant where the session asks for it; inputs are in the order of the loops.
    fn response(
        &self,
        controllers: PidMatrix,
        pairing: Pairing,
        setup: &TuningSetup,
    ) -> Result<StepResponse, TuningError> {
        match nonlinear(&setup.plant) {
            Some(rig) => Ok(step_response(&mut rig.paired(pairing).held(), controllers, setup)),
            None => linear_response(&self.wired(pairing).paths(), controllers, setup),
        }
    }

    /// What the response of a session is compared with; `None` for nothing, and for rules on a plant without a critical point.
    pub(super) fn comparison(
        &self,
        setup: &TuningSetup,
        critical: Option<&CriticalResponse>,
        root: &DesignRoot,
    ) -> Result<Option<Comparison>, TuningError> {
        let has_derivative = match setup.design.controllers {
            Some(_) => root.controllers.iter().any(|pid| pid.derivative != 0.0),
            None => setup.design.action == Action::Pid,
        };
        let by_rule = |pi: TuningRule, pid: TuningRule| {
            let rule = if has_derivative { pid } else { pi };
            let &CriticalResponse { gains, frequency, .. } = critical?;
            let settings = |gain| rule.settings(UltimatePoint { gain, period: TAU / frequency }).into();
            Some(PidMatrix::decentralised(gains.map(settings)))
        };
        let controllers = match setup.response.compare {
            CompareSpec::ZieglerNichols => by_rule(TuningRule::ZieglerNicholsPi, TuningRule::ZieglerNicholsPid),
            CompareSpec::TyreusLuyben => by_rule(TuningRule::TyreusLuybenPi, TuningRule::TyreusLuybenPid),
            CompareSpec::Full if setup.plant == TuningPlant::Published(PublishedPlant::WoodBerry) => {
                Some(wood_berry_full_controller())
            }
            CompareSpec::Nothing | CompareSpec::Full => None,
        };
        let compared = |controllers| {
            let stability = Design::new(&self.plant, controllers)?.stability();
            let response = self.response(controllers, Pairing::Diagonal, setup)?.of_loop(stability);
            Ok(Comparison { controllers, stability, response })
        };
        controllers.map(compared).transpose()
    }

    /// The response of a session without a decoupler and its stability, with other controllers.
    pub(super) fn response_with(
        &self,
        controllers: [ParallelPid; 2],
        pairing: Pairing,
        setup: &TuningSetup,
    ) -> Result<(LoopStability, StepResponse), TuningError> {
        let controllers = PidMatrix::decentralised(controllers);
        let stability = Design::new(&self.wired(pairing), controllers)?.stability();
        Ok((stability, self.response(controllers, pairing, setup)?.of_loop(stability)))
    }
}

fn loops(controllers: PidMatrix, setup: &TuningSetup) -> TwoLoops {
    let spec = &setup.response;
    TwoLoops {
        relays: [None; 2],
        controllers,
        references: spec.references,
        release: 0.0,
        duration: spec.duration,
        step: spec.step,
    }
}

fn linear_response(
    paths: &[SignalPath],
    controllers: PidMatrix,
    setup: &TuningSetup,
) -> Result<StepResponse, TuningError> {
    Ok(step_response(&mut DelayedPlant::new(paths)?, controllers, setup))
}

/// Most work of a response. Two of them, one compared with the other, take half as long as the longest relay test: on the page
/// they are computed together with the stability of both roots, and all of it is to be done in 100 ms.
const MAX_RESPONSE_WORK: f64 = 0.25 * MAX_WORK;

fn step_response(plant: &mut dyn HeldPlant, controllers: PidMatrix, setup: &TuningSetup) -> StepResponse {
    let trace = run_two_loops_within(plant, &loops(controllers, setup), MAX_RESPONSE_WORK);
    let figures = trace.step_metrics(setup.response.references);
    let is_bounded = trace.halt.is_none();
    StepResponse { trace, figures, is_bounded }
}

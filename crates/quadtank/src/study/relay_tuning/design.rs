use std::f64::consts::TAU;

use nalgebra::Matrix2;

use crate::control::{IsaPid, ParallelPid, PidMatrix, SeriesPid};
use crate::interaction::{Decoupling, decoupled_paths, static_decoupler};
use crate::linear::{Closure, Complex, DelayedPlant, Loci, LoopStability, SignalPath};
use crate::literature::campestrini::{PublishedPlant, wood_berry_full_controller};
use crate::sim::{HeldPlant, LoopTrace, MAX_WORK, StepMetrics, TwoLoops, run_two_loops_within};
use crate::tuning::{
    Action, Design, GainLimit, PlacementWarning, TuningError, TuningRule, UltimatePoint, dynamic_relative_gain,
    importance_direction, propose, response_at,
};

use super::rig::nonlinear;
use super::{CompareSpec, CriticalSpec, DecouplerSpec, PlantStudy, TuningPlant, TuningSetup};

/// Both roots of a placement.
#[derive(Clone, Debug, PartialEq)]
pub struct Designed {
    /// Gains of the critical point.
    pub critical_gains: [f64; 2],
    /// Critical frequency.
    pub frequency: f64,
    /// G(jω) there.
    pub g: Matrix2<Complex>,
    /// Relative gain λ11(jω) there.
    pub dynamic_relative_gain_11: Complex,
    /// Root 1, with the larger controller in loop 1, and root 2.
    pub roots: [DesignRoot; 2],
    /// Characteristic loci at the critical gains, and with the chosen root, around the critical frequency.
    pub loci: [Loci; 2],
    /// The response with the chosen root.
    pub response: StepResponse,
    /// The response with what it is compared with.
    pub comparison: Option<Comparison>,
}

/// One root with what it does to the loop, without a decoupler.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignRoot {
    /// The controllers.
    pub controllers: [ParallelPid; 2],
    /// The same in other forms.
    pub forms: [ControllerForms; 2],
    /// What to beware of.
    pub warnings: Vec<PlacementWarning>,
    /// Whether the loop is stable.
    pub stability: LoopStability,
    /// How its loci close.
    pub closure: Closure,
}

/// A controller in the forms of other textbooks (Campestrini 2006, eqs. 9 to 11).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControllerForms {
    /// ISA; `None` where the proportional gain is 0.
    pub isa: Option<IsaPid>,
    /// Series; `None` where its zeros are complex.
    pub series: Option<SeriesPid>,
}

impl From<ParallelPid> for ControllerForms {
    fn from(pid: ParallelPid) -> Self {
        let isa = IsaPid::from_parallel(pid);
        Self { isa, series: isa.and_then(SeriesPid::from_isa) }
    }
}

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

/// Frequencies that a picture of the loci shows, as multiples of the critical one: far beyond it a dead time winds them round
/// the origin.
const SHOWN: (f64, f64) = (0.02, 6.0);

impl Designed {
    /// Critical period.
    pub fn period(&self) -> f64 {
        TAU / self.frequency
    }
}

impl PlantStudy {
    /// The controllers of a session; `None` where the curve has no ultimate point in the direction asked for.
    ///
    /// # Errors
    /// [`TuningError::OutOfRange`] for a root that is neither 1 nor 2 or a target of 0, or what is wrong with the plant.
    pub fn design(&self, setup: &TuningSetup) -> Result<Option<Designed>, TuningError> {
        let spec = &setup.design;
        if !(1..=2).contains(&spec.root) {
            return Err(TuningError::OutOfRange { field: "design.root", value: spec.root as f64 });
        }
        let (critical_gains, frequency) = match spec.critical {
            CriticalSpec::Point { gains, period } => (gains, TAU / period),
            CriticalSpec::Importance(r) => match self.search.limit(importance_direction(&self.dc_gain, r)) {
                GainLimit::Oscillation(point) => (point.gains, point.frequency),
                GainLimit::RealPole { .. } | GainLimit::None => return Ok(None),
            },
        };
        let g = response_at(&self.plant, frequency);
        let [re, im] = spec.target;
        let [one, two] = propose(&self.dc_gain, &g, frequency, spec.method, spec.action, Complex::new(re, im))?;
        let chosen = if spec.root == 2 { two.controllers } else { one.controllers };
        let root = |controllers: [ParallelPid; 2], warnings: Vec<PlacementWarning>| {
            let design = Design::new(&self.plant, PidMatrix::decentralised(controllers))?;
            let (stability, closure) = (design.stability(), design.closure());
            let forms = controllers.map(ControllerForms::from);
            Ok::<_, TuningError>(DesignRoot { controllers, forms, warnings, stability, closure })
        };
        let roots = [root(one.controllers, one.warnings)?, root(two.controllers, two.warnings)?];
        let proportional = critical_gains.map(|proportional| ParallelPid { proportional, ..ParallelPid::default() });
        let shown = |controllers| {
            let design = Design::new(&self.plant, PidMatrix::decentralised(controllers))?;
            Ok::<_, TuningError>(design.loci_between(SHOWN.0 * frequency, SHOWN.1 * frequency))
        };
        let loci = [shown(proportional)?, shown(chosen)?];
        let mut response = self.decoupled_response(chosen, setup)?;
        response.is_bounded &=
            may_stay_bounded(roots[spec.root - 1].stability) || spec.decoupler != DecouplerSpec::None;
        let comparison = self.comparison(setup, critical_gains, frequency)?;
        Ok(Some(Designed {
            critical_gains,
            frequency,
            g,
            dynamic_relative_gain_11: dynamic_relative_gain(&g),
            roots,
            loci,
            response,
            comparison,
        }))
    }

    /// The response of the session with these controllers and its decoupler.
    fn decoupled_response(
        &self,
        controllers: [ParallelPid; 2],
        setup: &TuningSetup,
    ) -> Result<StepResponse, TuningError> {
        let which = match setup.design.decoupler {
            DecouplerSpec::None => {
                return self.response(PidMatrix::decentralised(controllers), setup);
            }
            DecouplerSpec::Static => {
                return self.response(PidMatrix::decoupled(controllers, static_decoupler(&self.plant)?), setup);
            }
            DecouplerSpec::Dynamic => Decoupling::Both,
            DecouplerSpec::FirstOutput => Decoupling::FirstOutput,
            DecouplerSpec::SecondOutput => Decoupling::SecondOutput,
        };
        // A dynamic decoupler is part of the paths, so it is simulated with the linear plant.
        linear_response(&decoupled_paths(&self.plant, which)?, PidMatrix::decentralised(controllers), setup)
    }

    /// The response with any controllers, of the nonlinear plant where the session asks for it.
    fn response(&self, controllers: PidMatrix, setup: &TuningSetup) -> Result<StepResponse, TuningError> {
        match nonlinear(&setup.plant) {
            Some(rig) => Ok(step_response(&mut rig.held(), controllers, setup)),
            None => linear_response(&self.plant.paths(), controllers, setup),
        }
    }

    fn comparison(
        &self,
        setup: &TuningSetup,
        gains: [f64; 2],
        frequency: f64,
    ) -> Result<Option<Comparison>, TuningError> {
        let by_rule = |pi: TuningRule, pid: TuningRule| {
            let rule = if setup.design.action == Action::Pi { pi } else { pid };
            let settings = |gain| rule.settings(UltimatePoint { gain, period: TAU / frequency }).into();
            PidMatrix::decentralised(gains.map(settings))
        };
        let controllers = match setup.response.compare {
            CompareSpec::ZieglerNichols => by_rule(TuningRule::ZieglerNicholsPi, TuningRule::ZieglerNicholsPid),
            CompareSpec::TyreusLuyben => by_rule(TuningRule::TyreusLuybenPi, TuningRule::TyreusLuybenPid),
            CompareSpec::Full if setup.plant == TuningPlant::Published(PublishedPlant::WoodBerry) => {
                wood_berry_full_controller()
            }
            CompareSpec::Nothing | CompareSpec::Full => return Ok(None),
        };
        let stability = Design::new(&self.plant, controllers)?.stability();
        let mut response = self.response(controllers, setup)?;
        response.is_bounded &= may_stay_bounded(stability);
        Ok(Some(Comparison { controllers, stability, response }))
    }
}

/// Whether a loop is stable, or only its record can tell.
fn may_stay_bounded(stability: LoopStability) -> bool {
    matches!(stability, LoopStability::Stable | LoopStability::NotComputed { .. })
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

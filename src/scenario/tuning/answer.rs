use std::f64::consts::TAU;

use nalgebra::Matrix2;

use crate::control::{Pairing, ParallelPid, PidMatrix, Relay};
use crate::interaction::{Decoupling, decoupled_paths, static_decoupler};
use crate::linear::{Closure, Complex, DelayedPlant, LinearError, LoopStability, Margins, Path, TransferMatrix};
use crate::plant::{OperatingPoint, QuadrupleTank};
use crate::sim::{HeldTank, LoopTrace, StepFigures, TwoLoops, run_two_loops};
use crate::tuning::{
    CriticalCurve, CriticalSearch, CurveDistance, Design, GainLimit, PlacementWarning, RelayTest, SequentialStep,
    TestAndSettings, TestTime, TuningError, check_stable, distance_from_curve, frequency_range, importance_direction,
    independent_tuning, modulus_estimator, propose, relay_test, response_at, sequential_tuning, single_loop_test,
    with_integrator,
};

use super::{Behind, CriticalSpec, DecouplerSpec, DesignSpec, TestKind, TestSpec, TuningPlant, TuningSetup};

/// Directions of the critical curve.
const DIRECTIONS: usize = 200;

/// What a session finds.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuning {
    /// G(0).
    pub dc_gain: Matrix2<f64>,
    /// The boundary of the stable gains.
    pub curve: CriticalCurve,
    /// The relay test.
    pub test: Tested,
    /// The controllers; `None` where the curve has no ultimate point in the direction asked for.
    pub design: Option<Designed>,
}

/// Relay tests.
#[derive(Clone, Debug, PartialEq)]
pub enum Tested {
    /// One of a single element, and its frequency response where it oscillated.
    Single(Box<RelayTest>, Option<FoundPoint>),
    /// One of each loop, with the settings by the rule.
    Independent(Box<[TestAndSettings; 2]>),
    /// The steps of a sequence.
    Sequential(Vec<SequentialStep>),
    /// One of both loops, with its distances from the curve by peaks and by first harmonics.
    Simultaneous(Box<RelayTest>, [Option<CurveDistance>; 2]),
}

/// A point of a frequency response as a relay found it, and as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundPoint {
    /// Frequency of the oscillation.
    pub frequency: f64,
    /// Modulus by the describing function.
    pub modulus: f64,
    /// The response of the element there.
    pub response: Complex,
}

/// Both roots of a placement.
#[derive(Clone, Debug, PartialEq)]
pub struct Designed {
    /// Gains of the critical point.
    pub critical_gains: [f64; 2],
    /// Critical frequency.
    pub frequency: f64,
    /// G(jω) there.
    pub g: Matrix2<Complex>,
    /// Root 1, with the larger controller in loop 1, and root 2.
    pub roots: [DesignRoot; 2],
    /// The response with the chosen root.
    pub response: LoopTrace,
    /// Figures of both outputs in it.
    pub figures: [StepFigures; 2],
}

/// One root with what it does to the loop, without a decoupler.
#[derive(Clone, Debug, PartialEq)]
pub struct DesignRoot {
    /// The controllers.
    pub controllers: [ParallelPid; 2],
    /// What to beware of.
    pub warnings: Vec<PlacementWarning>,
    /// Whether the loop is stable.
    pub stability: LoopStability,
    /// How far from −1.
    pub margins: Margins,
    /// How its loci close.
    pub closure: Closure,
}

/// Runs a session.
///
/// # Errors
/// [`TuningError::UnstablePlant`], [`TuningError::OutOfRange`] for what the methods refuse, or what is wrong with the plant.
pub fn tune(setup: &TuningSetup) -> Result<Tuning, TuningError> {
    let numbers = [("test.number", setup.test.number), ("design.root", setup.design.root)];
    if let Some((field, number)) = numbers.into_iter().find(|(_, number)| !(1..=2).contains(number)) {
        return Err(TuningError::OutOfRange { field, value: number as f64 });
    }
    let plant = setup.plant.transfer_matrix()?;
    check_stable(&plant)?;
    // Importance, signs and normalised gains all rest on the diagonal of G(0).
    if plant.dc_gain().diagonal().iter().any(|&g| g == 0.0 || !g.is_finite()) {
        return Err(LinearError::SingularGain { reciprocal_condition: 0.0 }.into());
    }
    let (low, high) = frequency_range(&plant)?;
    let search = CriticalSearch::new(&plant, low, high);
    Ok(Tuning {
        dc_gain: plant.dc_gain(),
        curve: CriticalCurve::of(&plant, &search, DIRECTIONS),
        test: test(&plant, &search, setup)?,
        design: design(&plant, &search, setup)?,
    })
}

fn test(plant: &TransferMatrix, search: &CriticalSearch, setup: &TuningSetup) -> Result<Tested, TuningError> {
    let spec = &setup.test;
    let time = TestTime { duration: spec.duration, release: spec.release, step: spec.step };
    match spec.kind {
        TestKind::Single => single(plant, spec, time),
        TestKind::Independent => {
            let tuned = independent_tuning(plant, spec.amplitudes, spec.rule, spec.detuning, time)?;
            Ok(Tested::Independent(Box::new(tuned)))
        }
        TestKind::Sequential => {
            Ok(Tested::Sequential(sequential_tuning(plant, spec.amplitudes, spec.rule, spec.passes, time)?))
        }
        TestKind::Simultaneous => {
            let gain = plant.dc_gain();
            let relay = |i: usize| Relay {
                hysteresis: spec.hysteresis[i],
                bias: spec.bias[i],
                ..Relay::ideal(spec.amplitudes[i], gain[(i, i)])
            };
            let relays = [Some(relay(0)), Some(relay(1))];
            let controllers = PidMatrix::default();
            let test = match nonlinear(&setup.plant) {
                Some(rig) => relay_test(&mut rig.held(), relays, controllers, time)?,
                None => relay_test(&mut DelayedPlant::new(&plant.paths())?, relays, controllers, time)?,
            };
            let distance = |gains: Option<[f64; 2]>, period| distance_from_curve(search, gains?, period);
            let distances = test.reading.oscillation.map_or([None; 2], |o| {
                [distance(o.gains_by_peak(), o.period), distance(o.gains_by_harmonic(), o.period)]
            });
            Ok(Tested::Simultaneous(Box::new(test), distances))
        }
    }
}

/// A relay on one element of the diagonal, with what stands behind it.
fn single(plant: &TransferMatrix, spec: &TestSpec, time: TestTime) -> Result<Tested, TuningError> {
    let index = spec.number - 1;
    let element = &plant.0[index][index];
    let with = match spec.behind {
        Behind::Nothing => element.clone(),
        Behind::Integrator => with_integrator(element),
        Behind::Modulus(r) => modulus_estimator(element, r)?,
    };
    let gain = if matches!(spec.behind, Behind::Modulus(_)) { 1.0 } else { element.dc_gain() };
    let relay = Relay {
        hysteresis: spec.hysteresis[index],
        bias: spec.bias[index],
        ..Relay::ideal(spec.amplitudes[index], gain)
    };
    let test = single_loop_test(&with, relay, time)?;
    let found = test.reading.oscillation.and_then(|oscillation| {
        let frequency = oscillation.frequency();
        let gain = oscillation.loops[0].gain_by_peak?.abs();
        let modulus = match spec.behind {
            Behind::Nothing => gain.recip(),
            Behind::Integrator => frequency / gain,
            Behind::Modulus(r) => r,
        };
        Some(FoundPoint { frequency, modulus, response: element.at(Complex::new(0.0, frequency)) })
    });
    Ok(Tested::Single(Box::new(test), found))
}

/// The nonlinear rig that a session runs on, at rest.
struct Rig {
    plant: QuadrupleTank,
    op: OperatingPoint,
    pairing: Pairing,
}

impl Rig {
    fn held(&self) -> HeldTank<'_> {
        HeldTank::new(&self.plant, &self.op, self.pairing)
    }
}

fn nonlinear(plant: &TuningPlant) -> Option<Rig> {
    match plant {
        TuningPlant::QuadrupleTank { preset, valves, pairing, nonlinear: true, .. } => {
            let rig = preset.preset();
            let plant = rig.plant.with_valves(valves.unwrap_or(rig.plant.valves));
            let op = plant.free_equilibrium(rig.pump_voltage);
            Some(Rig { plant, op, pairing: *pairing })
        }
        _ => None,
    }
}

fn design(
    plant: &TransferMatrix,
    search: &CriticalSearch,
    setup: &TuningSetup,
) -> Result<Option<Designed>, TuningError> {
    let spec = &setup.design;
    let gain = plant.dc_gain();
    let (critical_gains, frequency) = match spec.critical {
        CriticalSpec::Point { gains, period } => (gains, TAU / period),
        CriticalSpec::Importance(r) => match search.limit(importance_direction(&gain, r)) {
            GainLimit::Oscillation(point) => (point.gains, point.frequency),
            GainLimit::RealPole { .. } | GainLimit::None => return Ok(None),
        },
    };
    let g = response_at(plant, frequency);
    let [re, im] = spec.target;
    let [one, two] = propose(&gain, &g, frequency, spec.method, spec.action, Complex::new(re, im))?;
    let chosen = if spec.root == 2 { two.controllers } else { one.controllers };
    let response = respond(plant, chosen, spec, setup)?;
    let root = |controllers: [ParallelPid; 2], warnings: Vec<PlacementWarning>| {
        let design = Design::new(plant, PidMatrix::decentralised(controllers))?;
        let margins = design.margins(&design.loci());
        let (stability, closure) = (design.stability(), design.closure());
        Ok::<_, TuningError>(DesignRoot { controllers, warnings, stability, margins, closure })
    };
    let roots = [root(one.controllers, one.warnings)?, root(two.controllers, two.warnings)?];
    let figures = response.step_figures(setup.response.references);
    Ok(Some(Designed { critical_gains, frequency, g, roots, response, figures }))
}

fn respond(
    plant: &TransferMatrix,
    controllers: [ParallelPid; 2],
    spec: &DesignSpec,
    setup: &TuningSetup,
) -> Result<LoopTrace, TuningError> {
    let (paths, controllers): (Vec<Path>, PidMatrix) = match spec.decoupler {
        DecouplerSpec::None => (plant.paths(), PidMatrix::decentralised(controllers)),
        DecouplerSpec::Static => (plant.paths(), PidMatrix::decoupled(controllers, static_decoupler(plant)?)),
        DecouplerSpec::Dynamic | DecouplerSpec::FirstOutput | DecouplerSpec::SecondOutput => {
            let which = match spec.decoupler {
                DecouplerSpec::FirstOutput => Decoupling::FirstOutput,
                DecouplerSpec::SecondOutput => Decoupling::SecondOutput,
                _ => Decoupling::Both,
            };
            (decoupled_paths(plant, which)?, PidMatrix::decentralised(controllers))
        }
    };
    let response = &setup.response;
    let loops = TwoLoops {
        relays: [None; 2],
        controllers,
        references: response.references,
        release: 0.0,
        duration: response.duration,
        step: response.step,
    };
    // A dynamic decoupler is part of the paths, so it is simulated with the linear plant.
    match nonlinear(&setup.plant).filter(|_| matches!(spec.decoupler, DecouplerSpec::None | DecouplerSpec::Static)) {
        Some(rig) => Ok(run_two_loops(&mut rig.held(), &loops)),
        None => Ok(run_two_loops(&mut DelayedPlant::new(&paths)?, &loops)),
    }
}

use nalgebra::Matrix2;

use crate::control::{IsaPid, PidMatrix, Relay};
use crate::linear::{Complex, DelayedPlant, LinearError, MatrixPolesAndZeros, TransferMatrix};
use crate::tuning::{
    CriticalCurve, CriticalSearch, CurveDistance, RelayTest, SequentialStep, TestAndSettings, TestTime, TuningError,
    check_stable, distance_from_curve, frequency_range, independent_tuning, relay_test, sequential_tuning,
    single_loop_test,
};

use super::details::excited;
use super::rig::nonlinear;
use super::{Designed, SeriesElement, SteadyState, TestKind, TestSpec, TuningPlant, TuningSetup};

/// Directions of the critical curve.
const DIRECTIONS: usize = 200;

/// What follows from the plant alone. Tests and designs start from it.
#[derive(Clone, Debug)]
pub struct PlantStudy {
    /// The plant as transfer functions.
    pub plant: TransferMatrix,
    /// Gains at rest, which give signs and units: G(0), or rates where elements integrate, see [`TransferMatrix::rest_gain`].
    pub rest_gain: Matrix2<f64>,
    /// λ11 of the relative gain array at rest; `None` where the gains at rest are singular.
    pub rga_11: Option<f64>,
    /// Poles and transmission zeros; `None` where dead times do not leave det G as a whole, see [`MatrixPolesAndZeros::of`].
    pub poles_and_zeros: Result<Option<MatrixPolesAndZeros>, LinearError>,
    /// The boundary of the stable gains.
    pub curve: CriticalCurve,
    /// Finds critical points in any direction.
    pub search: CriticalSearch,
}

/// What a session finds.
#[derive(Clone, Debug)]
pub struct Tuning {
    /// What follows from the plant.
    pub study: PlantStudy,
    /// The relay test.
    pub test: Tested,
    /// The controllers; `None` where the curve has no ultimate point in the direction that a placement asks for.
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

impl Tested {
    /// The settings of both loops that an independent or a sequential test ends in; `None` where a loop is left without, and for other
    /// tests.
    pub fn settings(&self) -> Option<[IsaPid; 2]> {
        match self {
            Self::Independent(loops) => Some([loops[0].1?, loops[1].1?]),
            // A test without settings is the last one.
            Self::Sequential(steps) => match steps.as_slice() {
                [.., first, second] => Some([first.settings?, second.settings?]),
                _ => None,
            },
            Self::Single(..) | Self::Simultaneous(..) => None,
        }
    }
}

/// A point of a frequency response as a relay found it, and as it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundPoint {
    /// Frequency of the oscillation (rad per unit of time of the plant).
    pub frequency: f64,
    /// Modulus by the describing function.
    pub modulus: f64,
    /// The response of the element there.
    pub response: Complex,
    /// Its phase without the sign of the gain (rad): that which the relay finds, also in a loop with negative gain.
    pub phase: f64,
}

/// Runs a session.
///
/// # Errors
/// As [`PlantStudy::of`], [`PlantStudy::test`] and [`PlantStudy::design`].
pub fn tune(setup: &TuningSetup) -> Result<Tuning, TuningError> {
    let study = PlantStudy::of(&setup.plant)?;
    let (test, design) = (study.test(setup)?, study.design(setup)?);
    Ok(Tuning { study, test, design })
}

impl PlantStudy {
    /// Studies a plant.
    ///
    /// # Errors
    /// [`TuningError::UnstablePlant`], [`TuningError::NoOwnGain`], or what is wrong with the plant.
    pub fn of(plant: &TuningPlant) -> Result<Self, TuningError> {
        let plant = plant.transfer_matrix()?;
        check_stable(&plant)?;
        let SteadyState { rest_gain, rga_11, .. } = SteadyState::of(&plant);
        // Importance, signs and normalised gains all rest on the diagonal of the gains at rest.
        let is_none = |gain: f64| gain == 0.0 || !gain.is_finite();
        if let Some(index) = (0..2).find(|&i| is_none(rest_gain[(i, i)])) {
            let other_pairing = !is_none(rest_gain[(0, 1)]) && !is_none(rest_gain[(1, 0)]);
            return Err(TuningError::NoOwnGain { number: index + 1, other_pairing });
        }
        let (low, high) = frequency_range(&plant)?;
        let search = CriticalSearch::new(&plant, low, high);
        let curve = CriticalCurve::of(&plant, &search, DIRECTIONS);
        let poles_and_zeros = MatrixPolesAndZeros::of(&plant);
        Ok(Self { plant, rest_gain, rga_11: rga_11.ok(), poles_and_zeros, curve, search })
    }

    /// Gains on the axes of the normalised critical curve, k1 g11(0) and k2 g22(0) (Campestrini 2006, Fig. 25).
    pub fn normalised(&self, gains: [f64; 2]) -> (f64, f64) {
        (gains[0] * self.rest_gain[(0, 0)], gains[1] * self.rest_gain[(1, 1)])
    }

    /// The relay test of a session.
    ///
    /// # Errors
    /// [`TuningError::OutOfRange`] for what the test refuses.
    pub fn test(&self, setup: &TuningSetup) -> Result<Tested, TuningError> {
        let number = setup.test.number;
        if !(1..=2).contains(&number) {
            return Err(TuningError::OutOfRange { field: "test.number", value: number as f64 });
        }
        test(&self.plant, &self.search, setup)
    }
}

fn test(plant: &TransferMatrix, search: &CriticalSearch, setup: &TuningSetup) -> Result<Tested, TuningError> {
    let spec = &setup.test;
    let time = TestTime { duration: spec.duration, release: spec.release, step: spec.step };
    let gain = plant.rest_gain();
    let relays = [0, 1].map(|i| relay(spec, i, gain[(i, i)]));
    match spec.kind {
        TestKind::Single => single(plant, spec, time),
        TestKind::Independent => {
            Ok(Tested::Independent(Box::new(independent_tuning(plant, relays, spec.rule, spec.detuning, time)?)))
        }
        TestKind::Sequential => Ok(Tested::Sequential(sequential_tuning(plant, relays, spec.rule, spec.passes, time)?)),
        TestKind::Simultaneous => {
            let relays = relays.map(Some);
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

/// The relay of a loop with index 0 or 1, for a loop whose gain has the sign of `gain`.
fn relay(spec: &TestSpec, index: usize, gain: f64) -> Relay {
    Relay { hysteresis: spec.hysteresis[index], bias: spec.bias[index], ..Relay::ideal(spec.amplitudes[index], gain) }
}

/// A relay on one element of the diagonal, with what stands behind it.
fn single(plant: &TransferMatrix, spec: &TestSpec, time: TestTime) -> Result<Tested, TuningError> {
    let index = spec.number - 1;
    let element = &plant.0[index][index];
    let with = excited(plant, spec)?;
    let gain = if matches!(spec.behind, SeriesElement::Modulus(_)) { 1.0 } else { element.rest_gain() };
    let test = single_loop_test(&with, relay(spec, index, gain), time)?;
    let found = test.reading.oscillation.and_then(|oscillation| {
        let frequency = oscillation.frequency();
        let gain = oscillation.loops[0].gain_by_peak?.abs();
        let modulus = match spec.behind {
            SeriesElement::Nothing => gain.recip(),
            SeriesElement::Integrator => frequency / gain,
            SeriesElement::Modulus(r) => r,
        };
        let response = element.at(Complex::new(0.0, frequency));
        let phase = (response * element.rest_gain().signum()).arg();
        Some(FoundPoint { frequency, modulus, response, phase })
    });
    Ok(Tested::Single(Box::new(test), found))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::{Pairing, ParallelPid};
    use crate::linear::LoopStability;
    use crate::tuning::{Design, TuningRule};

    fn found(change: impl FnOnce(&mut TestSpec)) -> (PlantStudy, Tested) {
        let mut setup = TuningSetup::default();
        change(&mut setup.test);
        let study = PlantStudy::of(&setup.plant).unwrap();
        let test = study.test(&setup).unwrap();
        (study, test)
    }

    #[test]
    fn a_test_of_one_loop_after_the_other_ends_in_a_verdict_on_the_pair() {
        for kind in [TestKind::Independent, TestKind::Sequential] {
            let (study, test) = found(|test| (test.kind, test.passes) = (kind, 2));
            let settings = test.settings().unwrap();
            if let Tested::Sequential(steps) = &test {
                assert_eq!(settings.map(Some), [steps[2].settings, steps[3].settings]);
            }
            let pair = study.pair_of_test(&test).unwrap().unwrap();
            let controllers = settings.map(ParallelPid::from);
            assert_eq!((pair.controllers, pair.pairing), (controllers, Pairing::Diagonal));
            let design = Design::new(&study.plant, PidMatrix::decentralised(controllers)).unwrap();
            assert_eq!(pair.stability, design.stability());
        }
    }

    #[test]
    fn settings_that_hold_a_loop_alone_may_not_hold_both() {
        // Ziegler-Nichols PID for each loop of the column alone, as strong as it is and detuned by 2.5.
        let of = |detuning: f64| {
            let (study, test) = found(|test| {
                (test.kind, test.rule) = (TestKind::Independent, TuningRule::ZieglerNicholsPid);
                test.detuning = [detuning; 2];
            });
            study.pair_of_test(&test).unwrap().unwrap().stability
        };
        assert!(matches!(of(1.0), LoopStability::Unstable { .. }));
        assert_eq!(of(2.5), LoopStability::Stable);
    }

    #[test]
    fn other_tests_have_no_settings_for_both_loops() {
        for kind in [TestKind::Single, TestKind::Simultaneous] {
            let (study, test) = found(|test| test.kind = kind);
            assert_eq!((test.settings(), study.pair_of_test(&test)), (None, Ok(None)));
        }
        // A relay that never switches back leaves its loop without.
        let (study, test) = found(|test| (test.kind, test.hysteresis) = (TestKind::Sequential, [0.0, 1e3]));
        assert_eq!((test.settings(), study.pair_of_test(&test)), (None, Ok(None)));
    }
}

//! A plant and its controllers as a loop: stability, loci, margins and peaks by the generalised Nyquist criterion.

use nalgebra::Matrix2;

use crate::control::PidMatrix;
use crate::linear::{
    Complex, Loci, LociClosure, LoopPeak, LoopStability, Margins, ReturnRatio, TransferMatrix, biggest_log_modulus,
    largest_sensitivity,
};

use super::TuningError;
use super::critical::frequency_range;
use super::experiment::check_stable;

/// A point of the real axis near the origin, in the lowest frequency of the plant.
const NEAR_ORIGIN: f64 = 1e-6;
/// Points of the loci where nothing else is asked for.
const POINTS: usize = 600;

/// A loop of linear controllers and a plant that is stable but for integrators.
#[derive(Clone, Debug)]
pub struct Design<'a> {
    plant: &'a TransferMatrix,
    ratio: ReturnRatio<'a>,
}

impl<'a> Design<'a> {
    /// The loop of a plant (2 × 2) and its controllers, K with derivative filters.
    ///
    /// # Errors
    /// [`TuningError::UnstablePlant`], or [`TuningError::Linear`] for gains that are not finite.
    pub fn new(plant: &'a TransferMatrix, controllers: PidMatrix) -> Result<Self, TuningError> {
        check_stable(plant)?;
        let integrators = plant.integrators() + controllers.integrators();
        let ratio = ReturnRatio::new(plant, controllers.transfer_matrix()?, integrators);
        Ok(Self { plant, ratio })
    }

    /// Return ratio G(jω) K(jω), with derivative filters.
    pub fn ratio(&self, frequency: f64) -> Matrix2<Complex> {
        self.ratio.at(frequency)
    }

    /// Whether the closed loop is stable, dead times included.
    pub fn stability(&self) -> LoopStability {
        LoopStability::of(&self.ratio)
    }

    /// Both characteristic loci over the frequencies of the plant.
    ///
    /// # Errors
    /// As [`frequency_range`].
    pub fn loci(&self) -> Result<Loci, TuningError> {
        let (low, high) = frequency_range(self.plant)?;
        Ok(self.loci_between(low, high))
    }

    /// The loci between two frequencies, for a picture: far beyond the critical one a dead time winds them round the origin.
    pub fn loci_between(&self, low: f64, high: f64) -> Loci {
        Loci::along(|w| self.ratio(w), low, high, POINTS)
    }

    /// Margins over all frequencies; `None` where the search is beyond its bound on work.
    pub fn margins(&self) -> Option<Margins> {
        Margins::of(&self.ratio)
    }

    /// Largest singular value of the sensitivity over all frequencies, for a stable loop; as [`largest_sensitivity`].
    pub fn largest_sensitivity(&self) -> Option<LoopPeak> {
        largest_sensitivity(&self.ratio)
    }

    /// Biggest closed-loop log modulus (dB), for a stable loop; as [`biggest_log_modulus`].
    pub fn biggest_log_modulus(&self) -> Option<LoopPeak> {
        biggest_log_modulus(&self.ratio)
    }

    /// How the loci close, by what the loop is near ω = 0, where one of them may be infinite and the other not. With direct
    /// feedthrough they close at ω = ∞ too, and two joints make each locus a closed curve again.
    pub fn closure(&self) -> LociClosure {
        let [at_rest, at_infinity] = [self.closure_at_rest(), LociClosure::of(self.ratio.at_infinity())];
        if at_rest == at_infinity { LociClosure::Separate } else { LociClosure::Joint }
    }

    fn closure_at_rest(&self) -> LociClosure {
        // The sign of the discriminant near the origin, on the real axis, where the elements are real.
        frequency_range(self.plant)
            .map_or(LociClosure::Separate, |(low, _)| LociClosure::of(&self.ratio.at_real(low * NEAR_ORIGIN)))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use approx::assert_relative_eq;

    use super::*;
    use crate::control::ParallelPid;
    use crate::linear::{DelayedPlant, LoopStability, MatrixPolesAndZeros, TransferFunction};
    use crate::sim::{Halt, TwoLoops, run_two_loops};

    fn element(numerator: &[f64], denominator: &[f64], dead_time: f64) -> TransferFunction {
        TransferFunction::new(numerator.to_vec(), denominator.to_vec(), dead_time).unwrap()
    }

    fn pi(proportional: f64, integral: f64) -> ParallelPid {
        ParallelPid { proportional, integral, ..ParallelPid::default() }
    }

    fn diagonal(first: TransferFunction, second: TransferFunction) -> TransferMatrix {
        let none = element(&[0.0], &[1.0], 0.0);
        TransferMatrix([[first, none.clone()], [none, second]])
    }

    fn of(plant: &TransferMatrix, controllers: [ParallelPid; 2]) -> Design<'_> {
        Design::new(plant, PidMatrix::decentralised(controllers)).unwrap()
    }

    /// A harmless second loop.
    fn lag() -> TransferFunction {
        element(&[1.0], &[1.0, 2.0], 0.0)
    }

    #[test]
    fn an_integrator_with_dead_time_has_the_margins_by_hand() {
        // k e^(−s)/s: gain margin π/(2 k), phase margin π/2 − k.
        let plant = diagonal(element(&[1.0], &[0.0, 1.0], 1.0), lag());
        let loops = |k: f64| [pi(k, 0.0), pi(0.1, 0.0)];
        let margins = of(&plant, loops(0.5)).margins().unwrap();
        assert_relative_eq!(margins.gain_up.unwrap(), FRAC_PI_2 / 0.5, max_relative = 1e-9);
        assert_relative_eq!(margins.phase.unwrap(), FRAC_PI_2 - 0.5, max_relative = 1e-9);
        assert_eq!(of(&plant, loops(1.5)).stability(), LoopStability::Stable);
        assert_eq!(of(&plant, loops(1.6)).stability(), LoopStability::Unstable { poles: 2 });
        assert_eq!(of(&plant, loops(-0.1)).stability(), LoopStability::Unstable { poles: 1 });
        // An integrator that nobody controls stays one.
        assert_eq!(of(&plant, loops(0.0)).stability(), LoopStability::Marginal { frequency: 0.0 });
        assert!(of(&plant, loops(0.5)).largest_sensitivity().is_some_and(|peak| peak.value > 1.0));
    }

    #[test]
    fn a_loop_through_direct_feedthrough_has_margins_or_is_none() {
        // (s + 1)/(s + 5) with the gain −1/2: L runs from −0.1 to −0.5, so that twice the gain is the end, at infinite frequency.
        let plant = diagonal(element(&[1.0, 1.0], &[5.0, 1.0], 0.0), lag());
        let design = of(&plant, [pi(-0.5, 0.0), pi(0.1, 0.0)]);
        assert_eq!(design.stability(), LoopStability::Stable);
        let margins = design.margins().unwrap();
        assert_relative_eq!(margins.gain_up.unwrap(), 2.0, max_relative = 1e-9);
        assert_eq!((margins.distance, margins.distance_frequency), (0.5, f64::INFINITY));
        assert_relative_eq!(design.largest_sensitivity().unwrap().value, 2.0, max_relative = 1e-9);
        let beyond = of(&plant, [pi(-2.0, 0.0), pi(0.1, 0.0)]).stability();
        assert_eq!(beyond, LoopStability::AlgebraicLoop { eigenvalue: -2.0 });
        // Behind a dead time the same gains have poles without number.
        let late = diagonal(element(&[1.0, 1.0], &[5.0, 1.0], 1.0), lag());
        assert!(matches!(of(&late, [pi(-2.0, 0.0), pi(0.1, 0.0)]).stability(), LoopStability::NotComputed { .. }));
        assert_eq!(of(&late, [pi(-0.5, 0.0), pi(0.1, 0.0)]).stability(), LoopStability::Stable);
    }

    /// I + G K of elements without dead time; its zeros are the poles of the closed loop.
    fn return_difference(plant: &TransferMatrix, controllers: [ParallelPid; 2]) -> TransferMatrix {
        let controllers = controllers.map(|pid| pid.transfer_function().unwrap());
        let entry = |row: usize, column: usize| {
            let path = plant.0[row][column].times(&controllers[column]);
            if row != column {
                return path;
            }
            let (b, a) = (path.numerator(), path.denominator());
            let at = |of: &[f64], k: usize| of.get(k).copied().unwrap_or(0.0);
            let sum: Vec<f64> = (0..a.len().max(b.len())).map(|k| at(b, k) + at(a, k)).collect();
            element(&sum, a, 0.0)
        };
        TransferMatrix([[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]])
    }

    #[test]
    fn the_count_of_encirclements_is_that_of_the_poles_of_the_closed_loop() {
        let mut seed = 1_u64;
        let mut draw = |low: f64, high: f64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            low + (high - low) * (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let (mut stable, mut unstable) = (0, 0);
        for round in 0..300 {
            let mut any = |number: usize| {
                // The diagonal is the larger part.
                let size = [1.0, 0.4, 0.4, 1.0][number] * if draw(0.0, 1.0) < 0.2 { -1.0 } else { 1.0 };
                match (round + number) % 4 {
                    0 => element(&[size * draw(0.2, 2.0)], &[0.0, 1.0, draw(0.0, 2.0)], 0.0),
                    1 => element(&[size * draw(0.2, 2.0), size * draw(-1.0, 2.0)], &[1.0, draw(0.2, 3.0)], 0.0),
                    2 => element(&[size * draw(0.2, 2.0)], &[1.0, draw(0.2, 3.0)], 0.0),
                    _ => element(&[size * draw(0.2, 2.0), size], &[0.0, 1.0, draw(0.3, 2.0)], 0.0),
                }
            };
            let plant = TransferMatrix([[any(0), any(1)], [any(2), any(3)]]);
            let controllers = [pi(draw(0.1, 3.0), draw(0.01, 1.0)), pi(draw(0.1, 3.0), draw(0.01, 1.0))];
            let found = of(&plant, controllers).stability();
            let zeros =
                MatrixPolesAndZeros::of(&return_difference(&plant, controllers)).unwrap().unwrap().zeros.unwrap();
            let right = zeros.iter().filter(|zero| zero.re > 0.0).count();
            match found {
                LoopStability::Stable => assert_eq!(right, 0, "{plant:?} {controllers:?} {zeros:?}"),
                LoopStability::Unstable { poles } => {
                    assert_eq!(right, poles as usize, "{plant:?} {controllers:?} {zeros:?}");
                }
                LoopStability::AlgebraicLoop { .. } => continue,
                other => panic!("{other:?} {plant:?} {controllers:?} {zeros:?}"),
            }
            *if right == 0 { &mut stable } else { &mut unstable } += 1;
        }
        assert!(stable > 60 && unstable > 60, "{stable} {unstable}");
    }

    #[test]
    fn a_sampled_loop_moves_through_direct_feedthrough_as_the_continuous_one() {
        // (s + 1)/(s + 5) with the gain 1: y = 1/6 + e^(−3 t)/3; the jump is exact, the rest to the order of the sampling time.
        let plant = diagonal(element(&[1.0, 1.0], &[5.0, 1.0], 0.0), lag());
        let loops = TwoLoops {
            relays: [None; 2],
            controllers: PidMatrix::decentralised([pi(1.0, 0.0), pi(0.1, 0.0)]),
            references: [1.0, 0.0],
            release: 0.0,
            duration: 2.0,
            step: 1e-3,
        };
        let trace = run_two_loops(&mut DelayedPlant::new(&plant.paths()).unwrap(), &loops);
        assert_relative_eq!(trace.outputs[0][0], 0.5, max_relative = 1e-14);
        for (t, y) in trace.time.iter().zip(&trace.outputs[0]) {
            assert_relative_eq!(*y, 1.0 / 6.0 + (-3.0 * t).exp() / 3.0, epsilon = 2e-3);
        }
        // What is no loop has no motion.
        let none = TwoLoops { controllers: PidMatrix::decentralised([pi(-2.0, 0.0), pi(0.1, 0.0)]), ..loops };
        let trace = run_two_loops(&mut DelayedPlant::new(&plant.paths()).unwrap(), &none);
        assert_eq!(trace.halt, Some(Halt::Diverged { time: 0.0 }));
    }

    #[test]
    fn loci_of_integrators_close_as_their_residues_say() {
        let matrix = |[a, b, c, d]: [f64; 4]| {
            let of = |rate: f64| element(&[rate], &[0.0, 1.0], 0.5);
            TransferMatrix([[of(a), of(b)], [of(c), of(d)]])
        };
        let closure = |gains| of(&matrix(gains), [pi(0.1, 0.0); 2]).closure();
        assert_eq!(closure([1.0, 0.5, 0.5, 1.0]), LociClosure::Separate);
        assert_eq!(closure([1.0, 0.5, -0.5, 1.0]), LociClosure::Joint);
    }

    #[test]
    fn loci_with_integral_action_in_one_loop_do_not_join() {
        // G(0) = [1, 1; −1, 1]: towards ω = 0 one locus goes to infinity, the other to 2.
        let of = |gain: f64| element(&[gain], &[1.0, 1.0], 0.0);
        let plant = TransferMatrix([[of(1.0), of(1.0)], [of(-1.0), of(1.0)]]);
        let closure = |integral: [f64; 2]| super::tests::of(&plant, integral.map(|ki| pi(1.0, ki))).closure();
        assert_eq!(closure([1.0, 0.0]), LociClosure::Separate);
        assert_eq!(closure([0.0, 0.0]), LociClosure::Joint);
        assert_eq!(closure([1.0, 1.0]), LociClosure::Joint);
    }

    #[test]
    fn an_integrator_before_a_zero_at_the_origin_stays() {
        let washout = || element(&[0.0, 1.0], &[1.0, 1.0], 0.0);
        let plant = diagonal(washout(), washout());
        assert_eq!(of(&plant, [pi(1.0, 1.0); 2]).stability(), LoopStability::Marginal { frequency: 0.0 });
        assert_eq!(of(&plant, [pi(1.0, 0.0); 2]).stability(), LoopStability::Stable);
        let plant = diagonal(washout(), lag());
        assert_eq!(of(&plant, [pi(1.0, 1.0); 2]).stability(), LoopStability::Marginal { frequency: 0.0 });
    }
}

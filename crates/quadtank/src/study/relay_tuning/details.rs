//! What only numbers ask for, apart from what follows every move of a control: each takes as long as a whole design.

use nalgebra::Matrix2;

use crate::control::{ParallelPid, PidMatrix};
use crate::linear::{Complex, LoopPeak, LoopStability, Margins, TransferFunction, TransferMatrix, locus_values};
use crate::tuning::{
    Design, LimitCycle, Oscillation, TuningError, complete_response, limit_cycles, modulus_estimator,
    poles_off_the_origin, response_at, sine_test, with_integrator,
};

use super::{DesignRoot, PlantStudy, SeriesElement, TestSpec};

/// Time constants after which a transient of a sine test counts as gone: 1e-7 of it is left.
const SETTLED: f64 = 16.0;
/// Periods of a sine test, at least and at most.
const PERIODS: (f64, f64) = (4.0, 500.0);
/// An exact limit cycle is sought from a share of the period that was read to a multiple of it.
const SOUGHT: (f64, f64) = (0.1, 5.0);

/// G(jω) at the frequency of an oscillation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecoveredResponse {
    /// From a sine in input 1 and the fundamentals of the relay test.
    pub measured: Matrix2<Complex>,
    /// Of the model.
    pub exact: Matrix2<Complex>,
}

/// The peaks of a loop over all frequencies. Each is `None` for a loop that is not known to be stable, and where the search is beyond
/// its bound on work.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LoopPeaks {
    /// Largest singular value of the sensitivity, Ms.
    pub sensitivity: Option<LoopPeak>,
    /// Biggest closed-loop log modulus (dB); `None` for a loop that is open, too.
    pub log_modulus: Option<LoopPeak>,
}

impl LoopPeaks {
    /// The peaks of controllers on a plant, in a loop with this stability.
    ///
    /// # Errors
    /// [`TuningError::UnstablePlant`] or [`TuningError::Linear`], as [`Design::new`].
    pub(super) fn of(
        plant: &TransferMatrix,
        controllers: [ParallelPid; 2],
        stability: LoopStability,
    ) -> Result<Self, TuningError> {
        if stability != LoopStability::Stable {
            return Ok(Self::default());
        }
        let design = Design::new(plant, PidMatrix::decentralised(controllers))?;
        Ok(Self { sensitivity: design.largest_sensitivity(), log_modulus: design.biggest_log_modulus() })
    }
}

/// Where both characteristic loci are at the critical frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlacedLoci {
    /// The one that is nearest to the target.
    pub placed: Complex,
    /// The other one, which the placement of one locus leaves to itself.
    pub other: Complex,
}

impl PlantStudy {
    /// How far from −1 the loci stay with a root; `None` where the search is beyond its bound on work.
    ///
    /// # Errors
    /// [`TuningError::UnstablePlant`] or [`TuningError::Linear`], as [`Design::new`].
    pub fn margins(&self, root: &DesignRoot) -> Result<Option<Margins>, TuningError> {
        Ok(Design::new(&self.wired(root.pairing), PidMatrix::decentralised(root.controllers))?.margins())
    }

    /// How robust a root is by the peaks of its loop; neither of a loop that is not known to be stable.
    ///
    /// # Errors
    /// [`TuningError::UnstablePlant`] or [`TuningError::Linear`], as [`Design::new`].
    pub fn peaks(&self, root: &DesignRoot) -> Result<LoopPeaks, TuningError> {
        LoopPeaks::of(&self.wired(root.pairing), root.controllers, root.stability)
    }

    /// Where the loci are at a frequency with a root, derivative filters included, the one near `target` (real and imaginary part)
    /// told from the other.
    ///
    /// # Errors
    /// [`TuningError::UnstablePlant`] or [`TuningError::Linear`], as [`Design::new`].
    pub fn placed_loci(&self, root: &DesignRoot, frequency: f64, target: [f64; 2]) -> Result<PlacedLoci, TuningError> {
        let plant = self.wired(root.pairing);
        let design = Design::new(&plant, PidMatrix::decentralised(root.controllers))?;
        let [a, b] = locus_values(&design.ratio(frequency));
        let off = |locus: Complex| (locus - Complex::new(target[0], target[1])).norm();
        let (placed, other) = if off(a) <= off(b) { (a, b) } else { (b, a) };
        Ok(PlacedLoci { placed, other })
    }

    /// All four responses at the ultimate frequency without a model (Campestrini 2006, eqs. 122 and 123): the first column by
    /// a sine in input 1, the second from what simultaneous relays left. The sine runs on the linear plant.
    ///
    /// # Errors
    /// As [`sine_test`].
    pub fn recover(&self, oscillation: &Oscillation) -> Result<RecoveredResponse, TuningError> {
        let frequency = oscillation.frequency();
        let periods = (SETTLED / (slowest_rate(&self.plant)? * oscillation.period)).clamp(PERIODS.0, PERIODS.1);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within PERIODS")]
        let column = sine_test(&self.plant, 0, frequency, periods.ceil() as u32)?;
        Ok(RecoveredResponse {
            measured: complete_response(column, oscillation),
            exact: response_at(&self.plant, frequency),
        })
    }

    /// The exact limit cycle beside the reading of a single relay test, of the period nearest to it and with the amplitude of
    /// its relay. `None` with a dead time, direct feedthrough, hysteresis or bias, for which the equations do not hold, and where there
    /// is none.
    ///
    /// # Errors
    /// As [`limit_cycles`].
    pub fn exact_limit_cycle(&self, spec: &TestSpec, period: f64) -> Result<Option<LimitCycle>, TuningError> {
        let index = spec.number.clamp(1, 2) - 1;
        let element = excited(&self.plant, spec)?;
        let has_equations = element.dead_time() == 0.0 && element.feedthrough() == 0.0;
        if !has_equations || spec.hysteresis[index] != 0.0 || spec.bias[index] != 0.0 {
            return Ok(None);
        }
        let sign = self.plant.0[index][index].rest_gain().signum();
        let sign = if matches!(spec.behind, SeriesElement::Modulus(_)) { 1.0 } else { sign };
        let half = period / 2.0;
        let cycles = limit_cycles(&element.scaled(sign), SOUGHT.0 * half, SOUGHT.1 * half)?;
        let distance = |cycle: &LimitCycle| (cycle.period / period).ln().abs();
        let nearest = cycles.into_iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        Ok(nearest.map(|cycle| LimitCycle { amplitude: cycle.amplitude * spec.amplitudes[index], ..cycle }))
    }
}

/// The element of the diagonal that a single relay test excites, with what stands behind it.
///
/// # Errors
/// As [`modulus_estimator`].
pub(super) fn excited(plant: &TransferMatrix, spec: &TestSpec) -> Result<TransferFunction, TuningError> {
    let index = spec.number.clamp(1, 2) - 1;
    let element = &plant.0[index][index];
    match spec.behind {
        SeriesElement::Nothing => Ok(element.clone()),
        SeriesElement::Integrator => Ok(with_integrator(element)),
        SeriesElement::Modulus(r) => modulus_estimator(element, r),
    }
}

/// Distance of the slowest pole that decays from the imaginary axis (rad per unit of time); infinite for a plant of gains and
/// integrators alone. An integrator keeps a constant of its transient, which a sine test does not see.
fn slowest_rate(plant: &TransferMatrix) -> Result<f64, TuningError> {
    let mut slowest = f64::INFINITY;
    for element in plant.0.as_flattened() {
        slowest = poles_off_the_origin(element)?.iter().map(|pole| pole.re.abs()).fold(slowest, f64::min);
    }
    Ok(slowest)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use approx::assert_relative_eq;

    use super::super::{TestKind, Tested, TuningPlant, TuningSetup};
    use super::*;
    use crate::literature::campestrini::PublishedPlant;
    use crate::tuning::{Action, PlacementMethod};

    fn study(setup: &TuningSetup) -> (PlantStudy, Oscillation) {
        let study = PlantStudy::of(&setup.plant).unwrap();
        let reading = match study.test(setup).unwrap() {
            Tested::Simultaneous(test, _) | Tested::Single(test, _) => test.reading,
            _ => unreachable!("not asked for"),
        };
        (study, reading.oscillation.unwrap())
    }

    #[test]
    fn relays_and_a_sine_tell_the_whole_of_g() {
        for plant in [PublishedPlant::WoodBerry, PublishedPlant::ProcessTwo] {
            let setup = TuningSetup::on(TuningPlant::Published(plant));
            let (study, oscillation) = study(&setup);
            let found = study.recover(&oscillation).unwrap();
            for (measured, exact) in found.measured.iter().zip(&found.exact) {
                // The fundamentals come from the same inputs and outputs, so they fit the model whatever the wave is.
                assert!((measured - exact).norm() < 5e-3 * exact.norm(), "{plant:?}: {measured} {exact}");
            }
        }
    }

    #[test]
    fn placement_of_one_locus_leaves_the_other_to_itself() {
        let setup = TuningSetup::on(TuningPlant::Published(PublishedPlant::WoodBerry));
        let study = PlantStudy::of(&setup.plant).unwrap();
        let target = Complex::new(setup.design.target[0], setup.design.target[1]);
        let placed = |method: PlacementMethod| {
            let mut setup = setup.clone();
            (setup.design.method, setup.design.action) = (method, Action::Pi);
            let design = study.design(&setup).unwrap().unwrap();
            let frequency = design.critical.unwrap().frequency;
            study.placed_loci(&design.roots[0], frequency, setup.design.target).unwrap()
        };
        let one = placed(PlacementMethod::OneLocus);
        assert!((one.placed - target).norm() < 1e-9 && (one.other - target).norm() > 1e-2, "{one:?}");
        // A double eigenvalue: rounding shows as its square root.
        let both = placed(PlacementMethod::BothLoci);
        assert!((both.placed - target).norm() < 1e-6 && (both.other - target).norm() < 1e-6, "{both:?}");
    }

    #[test]
    fn an_exact_limit_cycle_is_what_a_single_test_reads() {
        let mut setup = TuningSetup::on(TuningPlant::Published(PublishedPlant::ProcessTwo));
        setup.test.kind = TestKind::Single;
        setup.test.amplitudes = [2.0, 3.0];
        for number in [1, 2] {
            for behind in [SeriesElement::Nothing, SeriesElement::Integrator] {
                (setup.test.number, setup.test.behind) = (number, behind);
                let (study, oscillation) = study(&setup);
                let cycle = study.exact_limit_cycle(&setup.test, oscillation.period).unwrap().unwrap();
                assert_relative_eq!(cycle.period, oscillation.period, max_relative = 1e-3);
                assert_relative_eq!(cycle.amplitude, oscillation.loops[0].amplitude, max_relative = 1e-3);
                assert!(cycle.is_stable());
            }
        }
        setup.test.hysteresis = [0.1; 2];
        assert_eq!(PlantStudy::of(&setup.plant).unwrap().exact_limit_cycle(&setup.test, 1.0), Ok(None));
        setup = TuningSetup::on(TuningPlant::Published(PublishedPlant::WoodBerry));
        assert_eq!(PlantStudy::of(&setup.plant).unwrap().exact_limit_cycle(&setup.test, 1.0), Ok(None));
    }
}

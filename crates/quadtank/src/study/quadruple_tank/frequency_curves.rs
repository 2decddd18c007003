use crate::control::PiLoop;
use crate::linear::{Complex, LoopPeak, SensitivityGains};

use super::{Analysis, Prepared, Setup, ZeroSituation};
use crate::study::StudyError;

/// Points of a curve.
const POINTS: u32 = 240;
/// How far curves reach below the slowest and above the fastest time constant.
const BELOW: f64 = 0.1;
const ABOVE: f64 = 10.0;
/// The sensitivity that curves begin with at most, so that the bandwidth is in sight; each try goes a decade down.
const FIRST_SENSITIVITY: f64 = 0.3;
const MAX_DECADES: u32 = 6;
/// Halvings of the interval that holds the bandwidth: 240 points over some decades leave 5 % between two of them.
const HALVINGS: u32 = 40;

/// What plant and loop do to sinusoids: singular values over frequency, each the largest and the smallest of all directions.
///
/// The plant is the linear one without sampling. The loop is the sampled one of [`ClosedLoop`](crate::linear::ClosedLoop), both
/// controllers automatic and away from their limits: the peak of the largest singular value of its S is the Ms there.
#[derive(Clone, Debug, PartialEq)]
pub struct FrequencyCurves {
    /// Frequencies (rad/s), rising, at most that of Nyquist. For a stable loop, that of its peak is among them.
    pub frequencies: Vec<f64>,
    /// Of G(jω), from pump voltages to measured signals (V/V).
    pub plant: [Vec<f64>; 2],
    /// A zero in the right half-plane (1/s), which no bandwidth goes beyond with a bearable peak.
    pub zero: Option<f64>,
    /// Of the loop, where it is stable.
    pub closed: Option<ClosedCurves>,
}

/// Singular values of a stable loop over frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosedCurves {
    /// Of the sensitivity S at the outputs.
    pub sensitivity: [Vec<f64>; 2],
    /// Of the complementary sensitivity T = I − S.
    pub complementary: [Vec<f64>; 2],
    /// Ms, the peak of the largest singular value of S, and its frequency (rad/s).
    pub peak: LoopPeak,
    /// Bandwidth ωB (rad/s): below it feedback helps in every direction, `σ̄(S) < 1/√2`; `None` where that holds at no frequency shown.
    pub bandwidth: Option<f64>,
}

impl FrequencyCurves {
    /// The curves of a setup.
    ///
    /// # Errors
    /// As [`analyse`](super::analyse); [`StudyError`] at `plant` when G is not finite at a frequency.
    ///
    /// # Examples
    /// The slow loop of Johansson (2000) beyond the line γ1 + γ2 = 1 cannot use frequencies beyond its zero.
    /// ```
    /// use quadtank::literature::PresetId;
    /// use quadtank::study::quadruple_tank::{FrequencyCurves, analyse, setup_of};
    ///
    /// let setup = setup_of(PresetId::JohanssonNonMinimumPhase);
    /// let analysis = analyse(&setup)?;
    /// let curves = FrequencyCurves::of(&setup, &analysis)?;
    /// assert!(curves.closed.and_then(|closed| closed.bandwidth) < curves.zero);
    /// # Ok::<(), quadtank::study::StudyError>(())
    /// ```
    pub fn of(setup: &Setup, analysis: &Analysis) -> Result<Self, StudyError> {
        let prepared = Prepared::of(setup)?;
        let pi_loop = PiLoop::new(&prepared.jacobian, &setup.controller, prepared.plant.power_gain);
        let gains = |w: f64| SensitivityGains::of(&pi_loop.at(w));
        let peak = analysis.closed_loop.sensitivity_peak;
        let frequencies = frequencies(setup, analysis, peak, |w| gains(w).sensitivity[0]);
        let mut plant = [Vec::new(), Vec::new()];
        for &w in &frequencies {
            let values = analysis.linear.model.singular_values(w)?;
            for (column, value) in plant.iter_mut().zip(values) {
                column.push(value);
            }
        }
        let closed = peak.map(|peak| {
            let all: Vec<SensitivityGains> = frequencies.iter().map(|&w| gains(w)).collect();
            let column = |read: fn(&SensitivityGains) -> f64| all.iter().map(read).collect::<Vec<f64>>();
            ClosedCurves {
                sensitivity: [column(|g| g.sensitivity[0]), column(|g| g.sensitivity[1])],
                complementary: [column(|g| g.complementary[0]), column(|g| g.complementary[1])],
                peak,
                bandwidth: bandwidth(&frequencies, |w| gains(w).sensitivity[0]),
            }
        });
        let zero = match analysis.zero_situation(setup) {
            ZeroSituation::Right(zero) => Some(zero),
            _ => None,
        };
        Ok(Self { frequencies, plant, zero, closed })
    }
}

/// The frequencies of the curves: evenly spaced in the logarithm, with that of the peak among them.
fn frequencies(
    setup: &Setup,
    analysis: &Analysis,
    peak: Option<LoopPeak>,
    sensitivity: impl Fn(f64) -> f64,
) -> Vec<f64> {
    let nyquist = std::f64::consts::PI / setup.controller.sampling_time_s;
    let zeros = analysis.linear.zeros.iter().flatten().map(|zero| zero.value);
    let poles = analysis.linear.poles.iter().chain(&analysis.closed_loop.poles_s).copied();
    let rates = zeros.chain(poles).map(Complex::norm).filter(|&rate| rate > 0.0 && rate.is_finite());
    let (slowest, fastest) = rates
        .map(|rate| rate.min(nyquist))
        .fold((nyquist, 0.0), |(low, high): (f64, f64), rate| (low.min(rate), high.max(rate)));
    let peak = peak.map(|peak| peak.frequency);
    let high = (ABOVE * fastest).max(peak.unwrap_or_default()).min(nyquist);
    let mut low = BELOW * slowest.min(peak.unwrap_or(nyquist));
    // A loop that does not act never begins so low.
    let acts = peak.is_some() && setup.controller.loops.iter().all(|settings| settings.gain != 0.0);
    for _ in 0..MAX_DECADES {
        if acts && sensitivity(low) > FIRST_SENSITIVITY {
            low *= 0.1;
        }
    }
    let ratio = high / low;
    let grid = (0..=POINTS).map(|k| low * ratio.powf(f64::from(k) / f64::from(POINTS)));
    let mut frequencies: Vec<f64> = grid.map(|w| w.min(high)).chain(peak).collect();
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
    frequencies
}

/// Bandwidth (rad/s): where the largest singular value of S first crosses 1/√2 from below, up to which feedback helps in every
/// direction (Skogestad and Postlethwaite 2005, §3.3). `None` where S is above that from the first frequency on, as with a loop that
/// does not act, or never crosses it.
fn bandwidth(frequencies: &[f64], sensitivity: impl Fn(f64) -> f64) -> Option<f64> {
    let is_above = |w: f64| sensitivity(w) >= std::f64::consts::FRAC_1_SQRT_2;
    let first = frequencies.iter().position(|&w| is_above(w))?;
    let (mut low, mut high) = (*frequencies.get(first.checked_sub(1)?)?, frequencies[first]);
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if is_above(middle) { high = middle } else { low = middle }
    }
    Some(high)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::control::Pairing;
    use crate::literature::PresetId;
    use crate::study::quadruple_tank::{analyse, detuned, first_experiment, setup_of};

    fn curves(setup: &Setup) -> (Analysis, FrequencyCurves) {
        let analysis = analyse(setup).unwrap();
        let curves = FrequencyCurves::of(setup, &analysis).unwrap();
        (analysis, curves)
    }

    fn largest(column: &[f64]) -> f64 {
        column.iter().copied().fold(0.0, f64::max)
    }

    #[test]
    fn the_curve_of_s_peaks_at_the_ms_of_the_loop() {
        let mut setups: Vec<Setup> = PresetId::ALL.map(setup_of).into();
        // Nervous loops, whose peak is narrow, and slow ones far from the sampling.
        for (gain, sampling_time_s) in [(4.0, 1.0), (12.0, 0.2), (0.2, 5.0)] {
            let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
            setup.controller.sampling_time_s = sampling_time_s;
            setup.controller.loops.iter_mut().for_each(|settings| settings.gain *= gain);
            setups.push(setup);
        }
        let mut stable = 0;
        for setup in setups {
            let (analysis, curves) = curves(&setup);
            let Some(closed) = curves.closed else { continue };
            stable += 1;
            let peak = analysis.closed_loop.sensitivity_peak.unwrap();
            assert_eq!(closed.peak, peak);
            // The page shows three digits; the grid of the curve may find a peak that is higher by what the search leaves.
            assert_relative_eq!(largest(&closed.sensitivity[0]), peak.value, max_relative = 1e-4);
            let at = curves.frequencies.iter().position(|&w| w == peak.frequency).unwrap();
            assert_relative_eq!(closed.sensitivity[0][at], peak.value, max_relative = 1e-12);
        }
        assert!(stable >= 11, "{stable}");
    }

    #[test]
    fn at_low_frequencies_the_plant_is_its_steady_gain_and_the_loop_holds_both_levels() {
        let (analysis, curves) = curves(&setup_of(PresetId::CocotaMinimumPhase));
        let [[a, b], [c, d]] = analysis.linear.dc_gain;
        // σ₁² + σ₂² = ‖G‖² and σ₁ σ₂ = |det G|; at a tenth of the slowest rate a lag is 0.5 % from its gain at rest.
        let [first, last] = [curves.plant[0][0], curves.plant[1][0]];
        assert_relative_eq!(first.hypot(last), (a * a + b * b + c * c + d * d).sqrt(), max_relative = 0.01);
        assert_relative_eq!(first * last, (a * d - b * c).abs(), max_relative = 0.02);
        let closed = curves.closed.unwrap();
        assert!(closed.sensitivity[0][0] <= FIRST_SENSITIVITY);
        assert!(closed.complementary.iter().all(|column| (column[0] - 1.0).abs() < 2.0 * FIRST_SENSITIVITY));
        let at = curves.frequencies.iter().position(|&w| w >= closed.bandwidth.unwrap()).unwrap();
        assert!(closed.sensitivity[0][at] >= 0.70 && closed.sensitivity[0][at - 1] < 0.7072);
    }

    #[test]
    fn a_zero_in_the_right_half_plane_is_a_ceiling_for_detuned_loops() {
        for valves in [[0.43, 0.34], [0.3, 0.3], [0.2, 0.2]] {
            let mut setup = first_experiment();
            (setup.valves, setup.controller.pairing) = (valves, Pairing::Swapped);
            let (analysis, curves) = curves(&detuned(&setup).unwrap());
            let zero = curves.zero.unwrap();
            assert_eq!(zero, analysis.linear.rightmost_zero().unwrap().value.re);
            let bandwidth = curves.closed.unwrap().bandwidth.unwrap();
            assert!(zero > 0.0 && bandwidth < zero, "{valves:?}: {bandwidth} {zero}");
        }
    }

    #[test]
    fn loops_that_are_not_stable_or_do_not_act_answer_in_place() {
        let mut setup = setup_of(PresetId::JohanssonMinimumPhase);
        setup.controller.pairing = Pairing::Swapped;
        let (_, unstable) = curves(&setup);
        assert!(unstable.closed.is_none() && unstable.plant[1].iter().all(|value| *value > 0.0));
        for valves in [[0.6, 0.4], [1.0, 0.0]] {
            let mut singular = setup_of(PresetId::JohanssonMinimumPhase);
            singular.valves = valves;
            assert_eq!(curves(&singular).1.closed, None, "{valves:?}");
        }
        let mut open = setup_of(PresetId::JohanssonMinimumPhase);
        open.controller.loops[1].gain = 0.0;
        assert_eq!(curves(&open).1.closed.unwrap().bandwidth, None);
        open.controller.loops[0].gain = 0.0;
        let closed = curves(&open).1.closed.unwrap();
        assert_eq!((largest(&closed.sensitivity[0]), largest(&closed.complementary[0])), (1.0, 0.0));
    }

    #[test]
    fn frequencies_rise_within_what_sampling_shows() {
        for id in PresetId::ALL {
            let setup = setup_of(id);
            let frequencies = curves(&setup).1.frequencies;
            let nyquist = std::f64::consts::PI / setup.controller.sampling_time_s;
            assert!(frequencies.windows(2).all(|pair| pair[0] < pair[1]), "{id:?}");
            assert!(frequencies[0] > 0.0 && frequencies.last().is_some_and(|&w| w <= nyquist), "{id:?}");
        }
    }
}

//! The numbers of the relay-tuning bench by their names. Plants of this bench have units of their own.

use crate::control::{IsaPid, ParallelPid};
use crate::linear::{Complex, LoopStability, Margins};
use crate::sim::StepMetrics;
use crate::study::Quantity;
use crate::study::quantity::yes;
use crate::tuning::{
    Corner, CriticalPoint, CurveDistance, GainLimit, LimitCycle, LoopMeasurement, Oscillation, RelayTest, RelayVerdict,
    UltimatePoint, ultimate_point_of,
};

use super::{
    Comparison, CriticalReading, CriticalResponse, DesignRoot, Designed, FoundPoint, LoopPeaks, PlacedLoci, PlantStudy,
    Results, SeriesElement, SteadyState, Tested,
};

type Read = fn(&Results) -> Option<f64>;

const fn q(name: &'static str, unit: &'static str, description: &'static str, read: Read) -> Quantity<Results> {
    Quantity::new(name, unit, description, read)
}

fn study(results: &Results) -> Option<&PlantStudy> {
    results.study.as_ref().as_ref().ok()
}

/// A gain at rest; `None` for an integrating element, whose gain is infinite.
fn gain(results: &Results, at: (usize, usize)) -> Option<f64> {
    Some(steady(results)?.dc_gain[at]).filter(|gain| gain.is_finite())
}

fn steady(results: &Results) -> Option<SteadyState> {
    Some(SteadyState::of(&study(results)?.plant))
}

fn tested(results: &Results) -> Option<&Tested> {
    results.test.as_ref().as_ref().ok()
}

/// Index of the loop that `relay.period` and `ultimate.gain` are about: that of a single test, else the first.
fn asked(results: &Results) -> usize {
    if matches!(tested(results), Some(Tested::Single(..))) { results.setup.test.number.clamp(1, 2) - 1 } else { 0 }
}

/// The test of a loop, and where in its reading the loop stands: that of one element alone has it first.
fn test_of(results: &Results, index: usize) -> Option<(&RelayTest, usize)> {
    match tested(results)? {
        Tested::Single(test, _) => (index == asked(results)).then_some((test, 0)),
        Tested::Independent(tests) => Some((&tests[index].0, index)),
        Tested::Sequential(steps) => Some((&steps.iter().rfind(|step| step.index == index)?.test, index)),
        Tested::Simultaneous(test, _) => Some((test, index)),
    }
}

fn oscillation(results: &Results, index: usize) -> Option<Oscillation> {
    test_of(results, index)?.0.reading.oscillation
}

fn measured(results: &Results, index: usize) -> Option<LoopMeasurement> {
    let (test, place) = test_of(results, index)?;
    Some(test.reading.oscillation?.loops[place])
}

fn is_unimodal(results: &Results) -> Option<f64> {
    let verdicts: Vec<RelayVerdict> =
        [0, 1].into_iter().filter_map(|index| Some(test_of(results, index)?.0.reading.verdict)).collect();
    (!verdicts.is_empty()).then(|| yes(verdicts.iter().all(|verdict| *verdict == RelayVerdict::Unimodal)))
}

/// Distances of a simultaneous test from the critical curve, by peaks and by first harmonics.
fn distances(results: &Results) -> Option<[Option<CurveDistance>; 2]> {
    match tested(results)? {
        Tested::Simultaneous(_, distances) => Some(*distances),
        _ => None,
    }
}

fn found_point(results: &Results) -> Option<FoundPoint> {
    match tested(results)? {
        Tested::Single(_, found) => *found,
        _ => None,
    }
}

fn exact_cycle(results: &Results) -> Option<LimitCycle> {
    let Tested::Single(test, _) = tested(results)? else { return None };
    let period = test.reading.oscillation?.period;
    study(results)?.exact_limit_cycle(&results.setup.test, period).ok()?
}

/// The exact ultimate point of a loop alone.
fn ultimate(results: &Results, index: usize) -> Option<UltimatePoint> {
    ultimate_point_of(&study(results)?.plant.0[index][index]).ok()?
}

/// By how much 4d/(πa) is larger than the exact ultimate gain, as a share of it.
fn gain_error(results: &Results) -> Option<f64> {
    if !matches!(results.setup.test.behind, SeriesElement::Nothing) {
        return None;
    }
    let index = asked(results);
    Some(measured(results, index)?.gain_by_peak? / ultimate(results, index)?.gain - 1.0)
}

fn corner(results: &Results) -> Option<&Corner> {
    study(results)?.curve.corners.first()
}

fn design(results: &Results) -> Option<&Designed> {
    results.design.as_ref().as_ref().ok()?.as_ref()
}

fn root(results: &Results) -> Option<&DesignRoot> {
    Some(design(results)?.chosen_root())
}

/// The root of a placement with an index; none of given controllers.
fn root_of_placement(results: &Results, index: usize) -> Option<&DesignRoot> {
    if results.setup.design.controllers.is_some() { None } else { design(results)?.roots.get(index) }
}

fn critical(results: &Results) -> Option<CriticalResponse> {
    design(results)?.critical
}

fn controller(results: &Results, index: usize) -> Option<ParallelPid> {
    Some(root(results)?.controllers[index])
}

fn isa(results: &Results, index: usize) -> Option<IsaPid> {
    root(results)?.forms[index].isa
}

/// Infinite without integral action.
fn integral_time(results: &Results, index: usize) -> Option<f64> {
    Some(isa(results, index)?.integral_time).filter(|time| time.is_finite())
}

fn stability(of: LoopStability) -> Option<f64> {
    match of {
        LoopStability::NotComputed { .. } => None,
        stability => Some(yes(stability == LoopStability::Stable)),
    }
}

fn unstable_poles(results: &Results) -> Option<f64> {
    match root(results)?.stability {
        LoopStability::Unstable { poles } => Some(f64::from(poles)),
        LoopStability::Stable => Some(0.0),
        LoopStability::Marginal { .. } | LoopStability::NotComputed { .. } | LoopStability::AlgebraicLoop { .. } => {
            None
        }
    }
}

/// What takes a search of its own.
fn reading(results: &Results) -> Option<CriticalReading> {
    CriticalReading::of(results).ok()
}

fn limit(results: &Results) -> Option<CriticalPoint> {
    match reading(results)?.limit {
        GainLimit::Oscillation(point) => Some(point),
        GainLimit::RealPole { .. } | GainLimit::AlgebraicLoop { .. } | GainLimit::None => None,
    }
}

fn margins(results: &Results) -> Option<Margins> {
    reading(results)?.margins
}

/// The peaks of the loop with the controllers at work.
fn peaks(results: &Results) -> Option<LoopPeaks> {
    study(results)?.peaks(root(results)?).ok()
}

fn placed(results: &Results) -> Option<PlacedLoci> {
    let root = root_of_placement(results, design(results)?.chosen)?;
    study(results)?.placed_loci(root, critical(results)?.frequency, results.setup.design.target).ok()
}

fn distance(locus: Complex) -> f64 {
    (locus + 1.0).norm()
}

/// Figures of a bounded response.
fn output(results: &Results, index: usize) -> Option<StepMetrics> {
    let response = &design(results)?.response;
    response.is_bounded.then_some(response.figures[index])
}

fn compared(results: &Results) -> Option<&Comparison> {
    design(results)?.comparison.as_ref()
}

fn compared_output(results: &Results, index: usize) -> Option<StepMetrics> {
    let response = &compared(results)?.response;
    response.is_bounded.then_some(response.figures[index])
}

/// The numbers of the relay-tuning bench.
#[rustfmt::skip]
pub const QUANTITIES: &[Quantity<Results>] = &[
    q("gain.g11", "output/input", "Steady-state gain g11(0).", |r| gain(r, (0, 0))),
    q("gain.g12", "output/input", "Steady-state gain g12(0).", |r| gain(r, (0, 1))),
    q("gain.g21", "output/input", "Steady-state gain g21(0).", |r| gain(r, (1, 0))),
    q("gain.g22", "output/input", "Steady-state gain g22(0).", |r| gain(r, (1, 1))),
    q("rga.lambda11", "1", "Relative gain λ11 at steady state; none where G(0) is singular.", |r| study(r)?.rga_11),
    q("niederlinski", "1", "Niederlinski index of the diagonal pairing; negative means unstable with integral action.", |r| steady(r)?.niederlinski_diagonal),
    q("relay.drive1", "input", "Amplitude d of relay 1.", |r| Some(r.setup.test.amplitudes[0])),
    q("relay.drive2", "input", "Amplitude d of relay 2.", |r| Some(r.setup.test.amplitudes[1])),
    q("relay.drive_ratio", "1", "Amplitude of relay 2 over that of relay 1, d2/d1, in their own units.", |r| Some(r.setup.test.amplitudes[1] / r.setup.test.amplitudes[0])),
    q("relay.hysteresis1", "output", "Half width ε of the hysteresis of relay 1.", |r| Some(r.setup.test.hysteresis[0])),
    q("relay.hysteresis2", "output", "Half width ε of the hysteresis of relay 2.", |r| Some(r.setup.test.hysteresis[1])),
    q("relay.bias1", "input", "Mean of the output of relay 1.", |r| Some(r.setup.test.bias[0])),
    q("relay.bias2", "input", "Mean of the output of relay 2.", |r| Some(r.setup.test.bias[1])),
    q("relay.is_unimodal", "yes/no", "Whether every test ends periodically with two switches of each relay in a period.", is_unimodal),
    q("relay.period", "time", "Period that the test reads, of the loop of a single test, else of loop 1.", |r| Some(oscillation(r, asked(r))?.period)),
    q("relay.frequency", "rad/time", "Frequency that the test reads, of the loop of a single test, else of loop 1.", |r| Some(oscillation(r, asked(r))?.frequency())),
    q("relay.amplitude", "output", "Half of what the output moves from peak to peak, a, of the loop of a single test, else of loop 1.", |r| Some(measured(r, asked(r))?.amplitude)),
    q("relay.ultimate_gain", "input/output", "Ultimate gain 4d/(πa) as read, with the sign of the loop, of the loop of a single test, else of loop 1.", |r| measured(r, asked(r))?.gain_by_peak),
    q("relay.gain_error", "1", "By how much 4d/(πa) exceeds the exact ultimate gain of the loop alone, as a share of it; none with an element behind the relay.", gain_error),
    q("relay.period1", "time", "Period that the test of loop 1 reads.", |r| Some(oscillation(r, 0)?.period)),
    q("relay.period2", "time", "Period that the test of loop 2 reads.", |r| Some(oscillation(r, 1)?.period)),
    q("relay.amplitude1", "output", "Amplitude a of output 1 in its test.", |r| Some(measured(r, 0)?.amplitude)),
    q("relay.amplitude2", "output", "Amplitude a of output 2 in its test.", |r| Some(measured(r, 1)?.amplitude)),
    q("relay.ultimate_gain1", "input/output", "Ultimate gain 4d/(πa) of loop 1 as read.", |r| measured(r, 0)?.gain_by_peak),
    q("relay.ultimate_gain2", "input/output", "Ultimate gain 4d/(πa) of loop 2 as read.", |r| measured(r, 1)?.gain_by_peak),
    q("relay.harmonic_gain1", "input/output", "Ultimate gain |U1|/|Y1| of loop 1 by first harmonics.", |r| measured(r, 0)?.gain_by_harmonic),
    q("relay.harmonic_gain2", "input/output", "Ultimate gain |U1|/|Y1| of loop 2 by first harmonics.", |r| measured(r, 1)?.gain_by_harmonic),
    q("relay.turn1", "rad", "Angle by which loop 1 differs from a proportional one; 0 at a critical point.", |r| measured(r, 0)?.turn),
    q("relay.turn2", "rad", "Angle by which loop 2 differs from a proportional one; 0 at a critical point.", |r| measured(r, 1)?.turn),
    q("relay.phase", "rad", "Phase of the element at the frequency that a single test found; near π or −π for an ideal relay alone.", |r| Some(found_point(r)?.phase)),
    q("relay.modulus", "output/input", "Modulus of the element there by the describing function.", |r| Some(found_point(r)?.modulus)),
    q("relay.exact_modulus", "output/input", "Modulus that the element has there.", |r| Some(found_point(r)?.response.norm())),
    q("relay.exact_period", "time", "Period of the exact limit cycle of a single test; none with dead time, hysteresis or bias.", |r| Some(exact_cycle(r)?.period)),
    q("relay.exact_amplitude", "output", "Amplitude of the exact limit cycle of a single test; none with dead time, hysteresis or bias.", |r| Some(exact_cycle(r)?.amplitude)),
    q("relay.excess_by_peak", "1", "By how much the gains of a simultaneous test by peaks are beyond the critical curve, as a share; negative inside.", |r| Some(distances(r)?[0]?.excess)),
    q("relay.excess_by_harmonic", "1", "By how much the gains of a simultaneous test by first harmonics are beyond the critical curve, as a share; negative inside.", |r| Some(distances(r)?[1]?.excess)),
    q("relay.curve_period", "time", "Period of the critical curve in the direction of a simultaneous test.", |r| Some(distances(r)?[1]?.period)),
    q("relay.is_on_boundary", "yes/no", "Whether a simultaneous test oscillates on the branch that bounds the stable gains; if not, it is no critical point.", |r| Some(yes(distances(r)?[1]?.same_branch))),
    q("ultimate.gain", "input/output", "Exact ultimate gain of the loop of a single test alone, else of loop 1.", |r| Some(ultimate(r, asked(r))?.gain)),
    q("ultimate.period", "time", "Exact ultimate period of the loop of a single test alone, else of loop 1.", |r| Some(ultimate(r, asked(r))?.period)),
    q("ultimate.frequency", "rad/time", "Exact ultimate frequency of the loop of a single test alone, else of loop 1.", |r| Some(ultimate(r, asked(r))?.frequency())),
    q("ultimate.gain1", "input/output", "Exact ultimate gain of loop 1 alone.", |r| Some(ultimate(r, 0)?.gain)),
    q("ultimate.gain2", "input/output", "Exact ultimate gain of loop 2 alone.", |r| Some(ultimate(r, 1)?.gain)),
    q("ultimate.period1", "time", "Exact ultimate period of loop 1 alone.", |r| Some(ultimate(r, 0)?.period)),
    q("ultimate.period2", "time", "Exact ultimate period of loop 2 alone.", |r| Some(ultimate(r, 1)?.period)),
    q("ultimate.frequency1", "rad/time", "Exact ultimate frequency of loop 1 alone.", |r| Some(ultimate(r, 0)?.frequency())),
    q("ultimate.frequency2", "rad/time", "Exact ultimate frequency of loop 2 alone.", |r| Some(ultimate(r, 1)?.frequency())),
    q("corner.count", "1", "How many corners the critical curve has; up to four are sought.", |r| Some(study(r)?.curve.corners.len() as f64)),
    q("corner.r2", "1", "Importance r2 of loop 2 at the first corner of the critical curve.", |r| Some(corner(r)?.importance)),
    q("corner.gain1", "input/output", "Gain of loop 1 at the first corner.", |r| Some(corner(r)?.points[0].gains[0])),
    q("corner.gain2", "input/output", "Gain of loop 2 at the first corner.", |r| Some(corner(r)?.points[0].gains[1])),
    q("corner.slow_period", "time", "The longer period of the first corner.", |r| Some(corner(r)?.points[0].period())),
    q("corner.fast_period", "time", "The shorter period of the first corner.", |r| Some(corner(r)?.points[1].period())),
    q("critical.r2", "1", "Importance r2 = kc2 g22(0)/(kc1 g11(0)) of the critical point of the design.", |r| r.setup.importance().ok().filter(|r2| r2.is_finite())),
    q("critical.gain1", "input/output", "Gain kc1 of the critical point of the design.", |r| Some(critical(r)?.gains[0])),
    q("critical.gain2", "input/output", "Gain kc2 of the critical point of the design.", |r| Some(critical(r)?.gains[1])),
    q("critical.period", "time", "Period of the critical point of the design.", |r| Some(critical(r)?.period())),
    q("critical.frequency", "rad/time", "Frequency of the critical point of the design.", |r| Some(critical(r)?.frequency)),
    q("critical.normalised1", "1", "kc1 g11(0) of the critical point of the design.", |r| Some(study(r)?.normalised(critical(r)?.gains).0)),
    q("critical.normalised2", "1", "kc2 g22(0) of the critical point of the design.", |r| Some(study(r)?.normalised(critical(r)?.gains).1)),
    q("critical.curve_gain1", "input/output", "Gain of loop 1 on the critical curve at that importance.", |r| Some(limit(r)?.gains[0])),
    q("critical.curve_gain2", "input/output", "Gain of loop 2 on the critical curve at that importance.", |r| Some(limit(r)?.gains[1])),
    q("critical.curve_period", "time", "Period of the critical curve at that importance.", |r| Some(limit(r)?.period())),
    q("placement.target_re", "1", "Real part of the target λ.", |r| Some(r.setup.design.target[0])),
    q("placement.target_im", "1", "Imaginary part of the target λ.", |r| Some(r.setup.design.target[1])),
    q("placement.placed_re", "1", "Real part of the placed locus at the critical frequency, derivative filters included.", |r| Some(placed(r)?.placed.re)),
    q("placement.placed_im", "1", "Imaginary part of the placed locus at the critical frequency, derivative filters included.", |r| Some(placed(r)?.placed.im)),
    q("placement.placed_distance", "1", "Distance of the placed locus from −1 at the critical frequency.", |r| Some(distance(placed(r)?.placed))),
    q("placement.other_re", "1", "Real part of the other locus at the critical frequency.", |r| Some(placed(r)?.other.re)),
    q("placement.other_im", "1", "Imaginary part of the other locus at the critical frequency.", |r| Some(placed(r)?.other.im)),
    q("placement.other_distance", "1", "Distance of the other locus from −1 at the critical frequency.", |r| Some(distance(placed(r)?.other))),
    q("loop1.gain", "input/output", "Proportional gain kp of controller 1 of the chosen root, or as given.", |r| Some(controller(r, 0)?.proportional)),
    q("loop2.gain", "input/output", "Proportional gain kp of controller 2 of the chosen root, or as given.", |r| Some(controller(r, 1)?.proportional)),
    q("loop1.integral_time", "time", "Integral time Ti of controller 1 of the chosen root, or as given; none without integral or proportional part.", |r| integral_time(r, 0)),
    q("loop2.integral_time", "time", "Integral time Ti of controller 2 of the chosen root, or as given; none without integral or proportional part.", |r| integral_time(r, 1)),
    q("loop1.derivative_time", "time", "Derivative time Td of controller 1 of the chosen root, or as given; 0 for PI.", |r| Some(isa(r, 0)?.derivative_time)),
    q("loop2.derivative_time", "time", "Derivative time Td of controller 2 of the chosen root, or as given; 0 for PI.", |r| Some(isa(r, 1)?.derivative_time)),
    q("closed_loop.is_stable", "yes/no", "Whether the linear loop with the chosen root, or with given controllers, is stable, without a decoupler; none where it is not computed.", |r| stability(root(r)?.stability)),
    q("closed_loop.unstable_poles", "1", "Number of poles of that loop in the right half-plane.", unstable_poles),
    q("closed_loop.sensitivity_peak", "1", "Peak Ms of the largest singular value of the sensitivity, without a decoupler; none where the loop is not stable.", |r| Some(peaks(r)?.sensitivity?.value)),
    q("closed_loop.log_modulus", "dB", "Biggest closed-loop log modulus Lc, without a decoupler (Luyben 1986); none where the loop is not stable or open.", |r| Some(peaks(r)?.log_modulus?.value)),
    q("root1.is_stable", "yes/no", "Whether the loop with root 1 is stable, which has the larger controller in loop 1.", |r| stability(root_of_placement(r, 0)?.stability)),
    q("root2.is_stable", "yes/no", "Whether the loop with root 2 is stable.", |r| stability(root_of_placement(r, 1)?.stability)),
    q("margins.distance", "1", "Shortest distance of a characteristic locus from −1 with the controllers at work.", |r| Some(margins(r)?.distance)),
    q("margins.gain", "1", "Smallest factor above 1 on all gains at which a locus reaches −1; none where no factor does.", |r| margins(r)?.gain_up),
    q("margins.gain_down", "1", "Largest factor below 1 on all gains at which a locus reaches −1; none where no factor does.", |r| margins(r)?.gain_down),
    q("margins.phase", "rad", "Smallest phase lag in all loops at which a locus reaches −1.", |r| margins(r)?.phase),
    q("response.is_bounded", "yes/no", "Whether the response stays bounded, so that its figures mean something.", |r| Some(yes(design(r)?.response.is_bounded))),
    q("output1.overshoot", "1", "How far output 1 passes its reference, as a share of it; none for a reference of 0.", |r| output(r, 0)?.overshoot),
    q("output2.overshoot", "1", "How far output 2 passes its reference, as a share of it; none for a reference of 0.", |r| output(r, 1)?.overshoot),
    q("output1.settling_2_percent", "time", "When output 1 enters the band of 2 % for good; none where it does not in the run.", |r| output(r, 0)?.settling_time),
    q("output2.settling_2_percent", "time", "When output 2 enters the band of 2 % for good; none where it does not in the run.", |r| output(r, 1)?.settling_time),
    q("output1.peak", "output", "Largest distance of output 1 from a reference of 0; none for any other.", |r| output(r, 0)?.peak),
    q("output2.peak", "output", "Largest distance of output 2 from a reference of 0; none for any other.", |r| output(r, 1)?.peak),
    q("output1.iae", "output time", "∫ |r − y| dt of output 1.", |r| Some(output(r, 0)?.iae)),
    q("output2.iae", "output time", "∫ |r − y| dt of output 2.", |r| Some(output(r, 1)?.iae)),
    q("comparison.is_stable", "yes/no", "Whether the loop that the response is compared with is stable.", |r| stability(compared(r)?.stability)),
    q("comparison.iae1", "output time", "∫ |r − y| dt of output 1 with what the response is compared with.", |r| Some(compared_output(r, 0)?.iae)),
    q("comparison.iae2", "output time", "∫ |r − y| dt of output 2 with what the response is compared with.", |r| Some(compared_output(r, 1)?.iae)),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Study;
    use crate::study::relay_tuning::{Element, RelayTuningStudy, TestKind, TuningPlant, TuningSetup};

    fn numbers<const N: usize>(setup: &TuningSetup, names: [&str; N]) -> [f64; N] {
        let results = RelayTuningStudy::update(setup, &[], None);
        names.map(|name| Quantity::find(QUANTITIES, name).expect(name).value(&results).expect(name))
    }

    /// Campestrini (2006), §4.2: the column of Wood and Berry.
    #[test]
    fn the_column_has_a_corner_and_tests_that_are_not_critical() {
        let mut setup = TuningSetup::default();
        let [r2, slow, fast, count] =
            numbers(&setup, ["corner.r2", "corner.slow_period", "corner.fast_period", "corner.count"]);
        assert!((r2 - 0.201).abs() < 5e-4 && count == 1.0, "{r2}");
        assert!((slow - 11.98).abs() < 5e-3 && (fast - 3.94).abs() < 5e-3, "{slow} {fast}");
        let names = ["relay.is_unimodal", "relay.is_on_boundary", "relay.drive_ratio"];
        assert_eq!(numbers(&setup, names), [1.0, 1.0, 1.0]);
        setup.test.amplitudes = [1.0, 0.1];
        assert_eq!(numbers(&setup, names), [1.0, 0.0, 0.1]);
    }

    /// One element 2 e^(−2 s)/(10 s + 1): its ultimate point is where atan(10 ω) + 2 ω = π.
    #[test]
    fn a_relay_reads_less_than_the_ultimate_gain() {
        let element = |gain: f64, lag: f64, dead_time: f64| Element {
            numerator: vec![gain],
            denominator: vec![1.0, lag],
            dead_time,
        };
        let nothing = element(0.0, 1.0, 0.0);
        let plant =
            TuningPlant::Elements([[element(2.0, 10.0, 2.0), nothing.clone()], [nothing, element(1.0, 1.0, 1.0)]]);
        let mut setup = TuningSetup::on(plant);
        setup.test.kind = TestKind::Single;
        (setup.test.duration, setup.test.step) = (200.0, 0.05);
        let names =
            ["ultimate.frequency", "ultimate.gain", "relay.ultimate_gain", "relay.gain_error", "relay.amplitude"];
        let [frequency, exact, read, error, amplitude] = numbers(&setup, names);
        assert!(((10.0 * frequency).atan() + 2.0 * frequency - std::f64::consts::PI).abs() < 1e-6, "{frequency}");
        assert!((exact - (1.0 + 100.0 * frequency * frequency).sqrt() / 2.0).abs() < 1e-6, "{exact}");
        // The output is made of exponentials: its peak is 2 d (1 − e^(−θ/τ)).
        assert!((amplitude - 2.0 * (1.0 - (-0.2_f64).exp())).abs() < 1e-3, "{amplitude}");
        assert!(
            (read - 4.0 / (std::f64::consts::PI * amplitude)).abs() < 1e-9 && (read / exact - 1.0 - error).abs() < 1e-9
        );
        assert!((error + 0.17).abs() < 0.01, "{error}");
        setup.test.hysteresis[0] = 0.1;
        let [with_hysteresis] = numbers(&setup, ["relay.gain_error"]);
        assert!(with_hysteresis < error, "{with_hysteresis}");
    }

    #[test]
    fn a_design_has_controllers_margins_and_a_response() {
        let names = ["closed_loop.is_stable", "response.is_bounded", "margins.gain", "margins.distance", "output1.iae"];
        let [stable, bounded, gain, distance, iae] = numbers(&TuningSetup::default(), names);
        assert_eq!([stable, bounded], [1.0, 1.0]);
        assert!(gain > 1.0 && (0.0..1.0).contains(&distance) && iae > 0.0, "{gain} {distance} {iae}");
        let results = RelayTuningStudy::update(&TuningSetup::default(), &[], None);
        assert_eq!(margins(&results), CriticalReading::of(&results).unwrap().margins);
    }
}

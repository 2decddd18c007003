//! The numbers of the home bench by their names.

use crate::control::{AntiWindup, LoopMode, Pairing};
use crate::linear::{LinearError, Stability, TransmissionZero};
use crate::sim::{EventKind, LoopMetrics, Settling};
use crate::study::Quantity;
use crate::study::quantity::{highest, lowest, yes};

use super::{Analysis, FrequencyCurves, GuaranteedMargins, Results, Run};

type Read = fn(&Results) -> Option<f64>;

const fn q(name: &'static str, unit: &'static str, description: &'static str, read: Read) -> Quantity<Results> {
    Quantity::new(name, unit, description, read)
}

/// What linear theory says, where it answers.
fn theory(results: &Results) -> Option<&Analysis> {
    results.analysis.as_ref().as_ref().ok()
}

/// The run, where there is one.
fn ran(results: &Results) -> Option<&Run> {
    results.run.as_ref().as_ref().ok()
}

fn rightmost(results: &Results) -> Option<&TransmissionZero> {
    theory(results)?.linear.rightmost_zero()
}

/// det G(0), exactly 0 where the gain is singular: the rest would be rounding.
fn gain_determinant(results: &Results) -> Option<f64> {
    let linear = &theory(results)?.linear;
    let [[g11, g12], [g21, g22]] = linear.dc_gain;
    let is_singular = matches!(linear.rga_11, Err(LinearError::SingularGain { .. }));
    Some(if is_singular { 0.0 } else { g11 * g22 - g12 * g21 })
}

fn niederlinski_of(results: &Results, pairing: Pairing) -> Option<f64> {
    theory(results)?.linear.niederlinski_of(pairing)
}

fn recommended_is_diagonal(results: &Results) -> Option<f64> {
    Some(yes(theory(results)?.linear.advised_pairing()? == Pairing::Diagonal))
}

fn has_anti_windup(results: &Results, index: usize) -> bool {
    results.setup.controller.loops[index].anti_windup != AntiWindup::Off
}

fn is_automatic(results: &Results, index: usize) -> bool {
    results.setup.controller.loops[index].mode == LoopMode::Automatic
}

fn margins(results: &Results) -> Option<GuaranteedMargins> {
    Some(GuaranteedMargins::of(theory(results)?.closed_loop.sensitivity_peak?.value))
}

fn bandwidth(results: &Results) -> Option<f64> {
    FrequencyCurves::of(&results.setup, theory(results)?).ok()?.closed?.bandwidth
}

/// The costs of a whole run.
fn costs(results: &Results, index: usize) -> Option<&LoopMetrics> {
    Some(&ran(results)?.metrics[index])
}

/// The figures of the answer to a step, where it has any.
fn answer(results: &Results, index: usize) -> Option<&LoopMetrics> {
    costs(results, index).filter(|metrics| metrics.no_response.is_none())
}

fn after(settling: Option<Settling>) -> Option<f64> {
    match settling? {
        Settling::After { time_s } => Some(time_s),
        Settling::Never => None,
    }
}

/// The costs of the loop that drives a pump.
fn costs_of_pump(results: &Results, pump: usize) -> Option<&LoopMetrics> {
    costs(results, results.setup.controller.pairing.loop_of(pump))
}

fn last(column: &[f64]) -> Option<f64> {
    column.last().copied()
}

fn happened(results: &Results, is_meant: fn(EventKind) -> bool) -> Option<f64> {
    Some(yes(ran(results)?.nonlinear.events.iter().any(|event| is_meant(event.kind))))
}

/// The numbers of the home bench.
#[rustfmt::skip]
pub const QUANTITIES: &[Quantity<Results>] = &[
    q("valves.gamma1", "1", "Fraction γ1 of the flow of pump 1 that goes into lower tank 1.", |r| Some(r.setup.valves[0])),
    q("valves.gamma2", "1", "Fraction γ2 of the flow of pump 2 that goes into lower tank 2.", |r| Some(r.setup.valves[1])),
    q("valves.sum", "1", "γ1 + γ2; at 1 the steady-state gain is singular (Johansson 2000).", |r| Some(r.setup.valves.iter().sum())),
    q("levels.h1", "m", "Level of lower tank 1 at the operating point, walls ignored.", |r| Some(theory(r)?.operating_point.levels[0])),
    q("levels.h2", "m", "Level of lower tank 2 at the operating point, walls ignored.", |r| Some(theory(r)?.operating_point.levels[1])),
    q("levels.h3", "m", "Level of upper tank 3 at the operating point, walls ignored.", |r| Some(theory(r)?.operating_point.levels[2])),
    q("levels.h4", "m", "Level of upper tank 4 at the operating point, walls ignored.", |r| Some(theory(r)?.operating_point.levels[3])),
    q("pumps.v1", "V", "Voltage of pump 1 at the operating point, limits ignored.", |r| Some(theory(r)?.operating_point.pump_voltage[0])),
    q("pumps.v2", "V", "Voltage of pump 2 at the operating point, limits ignored.", |r| Some(theory(r)?.operating_point.pump_voltage[1])),
    q("tank1.time_constant", "s", "Time constant T1 = A1/a1 √(2 h1/g) of tank 1 at the operating point; none for a dry tank.", |r| theory(r)?.time_constants_s[0]),
    q("tank2.time_constant", "s", "Time constant T2 = A2/a2 √(2 h2/g) of tank 2 at the operating point; none for a dry tank.", |r| theory(r)?.time_constants_s[1]),
    q("tank3.time_constant", "s", "Time constant T3 = A3/a3 √(2 h3/g) of tank 3 at the operating point; none for a dry tank.", |r| theory(r)?.time_constants_s[2]),
    q("tank4.time_constant", "s", "Time constant T4 = A4/a4 √(2 h4/g) of tank 4 at the operating point; none for a dry tank.", |r| theory(r)?.time_constants_s[3]),
    q("gain.g11", "1", "Steady-state gain from pump 1 to the signal of level 1 (V/V).", |r| Some(theory(r)?.linear.dc_gain[0][0])),
    q("gain.g12", "1", "Steady-state gain from pump 2 to the signal of level 1 (V/V).", |r| Some(theory(r)?.linear.dc_gain[0][1])),
    q("gain.g21", "1", "Steady-state gain from pump 1 to the signal of level 2 (V/V).", |r| Some(theory(r)?.linear.dc_gain[1][0])),
    q("gain.g22", "1", "Steady-state gain from pump 2 to the signal of level 2 (V/V).", |r| Some(theory(r)?.linear.dc_gain[1][1])),
    q("gain.det", "1", "Determinant of the steady-state gain G(0); exactly 0 where it is singular.", gain_determinant),
    q("zero.rightmost", "1/s", "Right-most transmission zero; positive in the right half-plane, exactly 0 where G(0) is singular.", |r| Some(rightmost(r)?.value.re)),
    q("zero.leftmost", "1/s", "Left-most transmission zero; positive in the right half-plane.", |r| Some(theory(r)?.linear.zeros.as_ref().ok()?.first()?.value.re)),
    q("zero.output_direction1", "1", "Part of level 1 in the output direction η of the right-most zero, of length 1; its largest part is positive.", |r| Some(rightmost(r)?.output_direction.get(0)?.re)),
    q("zero.output_direction2", "1", "Part of level 2 in the output direction η of the right-most zero, of length 1; its largest part is positive.", |r| Some(rightmost(r)?.output_direction.get(1)?.re)),
    q("zero.input_direction1", "1", "Part of pump 1 in the input direction of the right-most zero, of length 1; its largest part is positive.", |r| Some(rightmost(r)?.input_direction.get(0)?.re)),
    q("zero.input_direction2", "1", "Part of pump 2 in the input direction of the right-most zero, of length 1; its largest part is positive.", |r| Some(rightmost(r)?.input_direction.get(1)?.re)),
    q("rga.lambda11", "1", "Relative gain λ11 at steady state, level 1 with pump 1; none where G(0) is singular.", |r| Some(theory(r)?.linear.rga()?[0][0])),
    q("rga.lambda12", "1", "Relative gain λ12 = 1 − λ11 at steady state, level 1 with pump 2; none where G(0) is singular.", |r| Some(theory(r)?.linear.rga()?[0][1])),
    q("niederlinski", "1", "Niederlinski index of the pairing that the controller has; negative means unstable with integral action.", |r| niederlinski_of(r, r.setup.controller.pairing)),
    q("niederlinski.diagonal", "1", "Niederlinski index of the diagonal pairing.", |r| niederlinski_of(r, Pairing::Diagonal)),
    q("niederlinski.swapped", "1", "Niederlinski index of the swapped pairing.", |r| niederlinski_of(r, Pairing::Swapped)),
    q("pairing.is_diagonal", "yes/no", "Whether level 1 commands pump 1 and level 2 pump 2.", |r| Some(yes(r.setup.controller.pairing == Pairing::Diagonal))),
    q("pairing.recommended_is_diagonal", "yes/no", "Whether the relative gains suggest the diagonal pairing; none where they suggest none.", recommended_is_diagonal),
    q("loop1.gain", "1", "Gain K of the controller of level 1 (V/V), with its sign.", |r| Some(r.setup.controller.loops[0].gain)),
    q("loop2.gain", "1", "Gain K of the controller of level 2 (V/V), with its sign.", |r| Some(r.setup.controller.loops[1].gain)),
    q("loop1.integral_time", "s", "Integral time Ti of the controller of level 1.", |r| Some(r.setup.controller.loops[0].integral_time_s)),
    q("loop2.integral_time", "s", "Integral time Ti of the controller of level 2.", |r| Some(r.setup.controller.loops[1].integral_time_s)),
    q("loop1.set_point_weight", "1", "Set-point weight b of the controller of level 1.", |r| Some(r.setup.controller.loops[0].set_point_weight)),
    q("loop2.set_point_weight", "1", "Set-point weight b of the controller of level 2.", |r| Some(r.setup.controller.loops[1].set_point_weight)),
    q("loop1.is_automatic", "yes/no", "Whether loop 1 is automatic from the start.", |r| Some(yes(is_automatic(r, 0)))),
    q("loop2.is_automatic", "yes/no", "Whether loop 2 is automatic from the start.", |r| Some(yes(is_automatic(r, 1)))),
    q("controller.anti_windup", "yes/no", "Whether both loops have anti-windup.", |r| Some(yes(has_anti_windup(r, 0) && has_anti_windup(r, 1)))),
    q("closed_loop.is_stable", "yes/no", "Whether the sampled linear loop is stable; no also on the border of stability.", |r| Some(yes(theory(r)?.closed_loop.stability == Stability::Stable))),
    q("closed_loop.rightmost_pole", "1/s", "Real part of the right-most pole of the sampled linear loop, mapped to the s-plane.", |r| Some(theory(r)?.closed_loop.rightmost_pole()?.re)),
    q("closed_loop.largest_modulus", "1", "Largest modulus of a pole of the sampled linear loop in the z-plane; below 1 for a stable loop.", |r| Some(theory(r)?.closed_loop.poles_z.first()?.norm())),
    q("closed_loop.sensitivity_peak", "1", "Peak Ms of the largest singular value of the sensitivity; none where the loop is not stable.", |r| Some(theory(r)?.closed_loop.sensitivity_peak?.value)),
    q("closed_loop.sensitivity_peak_frequency", "rad/s", "Frequency of the peak Ms, up to that of Nyquist; none where the loop is not stable.", |r| Some(theory(r)?.closed_loop.sensitivity_peak?.frequency)),
    q("closed_loop.bandwidth", "rad/s", "Where the largest singular value of the sensitivity first crosses 1/√2 from below; none where the loop is not stable or holds a level at no frequency.", bandwidth),
    q("closed_loop.guaranteed_gain", "1", "Largest factor on the gain of each channel that Ms guarantees, Ms/(Ms − 1).", |r| margins(r)?.gain_max),
    q("closed_loop.guaranteed_phase", "rad", "Largest phase lag in each channel that Ms guarantees, 2 asin(1/(2 Ms)).", |r| Some(margins(r)?.phase_rad)),
    q("interpolation.area", "m s", "∫ ηᵀe e^(−zt) dt = ηᵀr/z from the first step on, the same for every stabilising controller; none without a zero in the right half-plane or a step.", |r| theory(r)?.interpolation_integral(&r.setup.experiment)),
    q("set_point.step1", "m", "First step of the reference of level 1; none where it never moves.", |r| r.setup.experiment.first_step_of(0)),
    q("set_point.step2", "m", "First step of the reference of level 2; none where it never moves.", |r| r.setup.experiment.first_step_of(1)),
    q("level1.rise_time", "s", "From 10 % to 90 % of the first step of level 1.", |r| answer(r, 0)?.rise_time_s),
    q("level2.rise_time", "s", "From 10 % to 90 % of the first step of level 2.", |r| answer(r, 1)?.rise_time_s),
    q("level1.settling_2_percent", "s", "From the first step of level 1 until it stays within 2 % of it; none where it does not within its window.", |r| after(answer(r, 0)?.settling_2_percent)),
    q("level2.settling_2_percent", "s", "From the first step of level 2 until it stays within 2 % of it; none where it does not within its window.", |r| after(answer(r, 1)?.settling_2_percent)),
    q("level1.settling_5_percent", "s", "From the first step of level 1 until it stays within 5 % of it; none where it does not within its window.", |r| after(answer(r, 0)?.settling_5_percent)),
    q("level2.settling_5_percent", "s", "From the first step of level 2 until it stays within 5 % of it; none where it does not within its window.", |r| after(answer(r, 1)?.settling_5_percent)),
    q("level1.overshoot", "1", "How far level 1 goes beyond its new reference, as a share of the step; 0 for not at all.", |r| answer(r, 0)?.overshoot),
    q("level2.overshoot", "1", "How far level 2 goes beyond its new reference, as a share of the step; 0 for not at all.", |r| answer(r, 1)?.overshoot),
    q("level1.undershoot", "1", "How far level 1 goes the wrong way, as a positive share of the step; 0 for not at all.", |r| answer(r, 0)?.undershoot),
    q("level2.undershoot", "1", "How far level 2 goes the wrong way, as a positive share of the step; 0 for not at all.", |r| answer(r, 1)?.undershoot),
    q("level1.coupling", "m", "Largest move of level 2 within the window of the first step of level 1.", |r| Some(answer(r, 0)?.other_peak)),
    q("level2.coupling", "m", "Largest move of level 1 within the window of the first step of level 2.", |r| Some(answer(r, 1)?.other_peak)),
    q("level1.window_iae", "m s", "∫ |r − h| dt of level 1 within the window of its first step.", |r| answer(r, 0)?.window_iae),
    q("level2.window_iae", "m s", "∫ |r − h| dt of level 2 within the window of its first step.", |r| answer(r, 1)?.window_iae),
    q("level1.window", "s", "From the first step of level 1 until anything else is done to the plant, or to the end of the run.", |r| answer(r, 0)?.window_s),
    q("level2.window", "s", "From the first step of level 2 until anything else is done to the plant, or to the end of the run.", |r| answer(r, 1)?.window_s),
    q("level1.iae", "m s", "∫ |r − h| dt of level 1 over the whole run.", |r| Some(costs(r, 0)?.iae)),
    q("level2.iae", "m s", "∫ |r − h| dt of level 2 over the whole run.", |r| Some(costs(r, 1)?.iae)),
    q("level1.ise", "m² s", "∫ (r − h)² dt of level 1 over the whole run.", |r| Some(costs(r, 0)?.ise)),
    q("level2.ise", "m² s", "∫ (r − h)² dt of level 2 over the whole run.", |r| Some(costs(r, 1)?.ise)),
    q("level1.itae", "m s²", "∫ t |r − h| dt of level 1 over the whole run, t from its first step.", |r| Some(costs(r, 0)?.itae)),
    q("level2.itae", "m s²", "∫ t |r − h| dt of level 2 over the whole run, t from its first step.", |r| Some(costs(r, 1)?.itae)),
    q("pump1.travel", "V", "Sum of all moves of the controller output that drives pump 1, over the whole run.", |r| Some(costs_of_pump(r, 0)?.total_variation)),
    q("pump2.travel", "V", "Sum of all moves of the controller output that drives pump 2, over the whole run.", |r| Some(costs_of_pump(r, 1)?.total_variation)),
    q("pump1.time_at_limit", "s", "How long the controller output that drives pump 1 is at a limit, in the whole run.", |r| Some(costs_of_pump(r, 0)?.saturated_s)),
    q("pump2.time_at_limit", "s", "How long the controller output that drives pump 2 is at a limit, in the whole run.", |r| Some(costs_of_pump(r, 1)?.saturated_s)),
    q("pump1.highest_voltage", "V", "Highest voltage of pump 1 in the run.", |r| highest(&ran(r)?.nonlinear.pump_voltage[0])),
    q("pump2.highest_voltage", "V", "Highest voltage of pump 2 in the run.", |r| highest(&ran(r)?.nonlinear.pump_voltage[1])),
    q("pump1.lowest_voltage", "V", "Lowest voltage of pump 1 in the run.", |r| lowest(&ran(r)?.nonlinear.pump_voltage[0])),
    q("pump2.lowest_voltage", "V", "Lowest voltage of pump 2 in the run.", |r| lowest(&ran(r)?.nonlinear.pump_voltage[1])),
    q("run.duration", "s", "How long the experiment lasts.", |r| Some(r.setup.experiment.duration_s)),
    q("run.time_at_limit", "s", "How long the outputs of both controllers are at a limit, added.", |r| Some(costs(r, 0)?.saturated_s + costs(r, 1)?.saturated_s)),
    q("run.iae_sum", "m s", "∫ |r − h| dt over the whole run, both levels added.", |r| Some(costs(r, 0)?.iae + costs(r, 1)?.iae)),
    q("run.largest_model_error1", "m", "Largest distance of level 1 from that of the linear model in the same experiment.", |r| ran(r)?.largest_model_error(0)),
    q("run.largest_model_error2", "m", "Largest distance of level 2 from that of the linear model in the same experiment.", |r| ran(r)?.largest_model_error(1)),
    q("run.final_level1", "m", "Level 1 at the end of the run.", |r| last(&ran(r)?.nonlinear.levels[0])),
    q("run.final_level2", "m", "Level 2 at the end of the run.", |r| last(&ran(r)?.nonlinear.levels[1])),
    q("run.final_level3", "m", "Level 3 at the end of the run.", |r| last(&ran(r)?.nonlinear.levels[2])),
    q("run.final_level4", "m", "Level 4 at the end of the run.", |r| last(&ran(r)?.nonlinear.levels[3])),
    q("run.final_linear_level1", "m", "Level 1 of the linear model at the end of the run.", |r| last(&ran(r)?.linear.levels[0])),
    q("run.final_linear_level2", "m", "Level 2 of the linear model at the end of the run.", |r| last(&ran(r)?.linear.levels[1])),
    q("run.peak_level1", "m", "Highest level 1 of the run.", |r| highest(&ran(r)?.nonlinear.levels[0])),
    q("run.peak_level2", "m", "Highest level 2 of the run.", |r| highest(&ran(r)?.nonlinear.levels[1])),
    q("run.peak_level3", "m", "Highest level 3 of the run.", |r| highest(&ran(r)?.nonlinear.levels[2])),
    q("run.peak_level4", "m", "Highest level 4 of the run.", |r| highest(&ran(r)?.nonlinear.levels[3])),
    q("run.overflows", "yes/no", "Whether a tank runs over in the run.", |r| happened(r, |kind| matches!(kind, EventKind::Overflow { .. }))),
    q("run.runs_dry", "yes/no", "Whether a tank runs dry in the run.", |r| happened(r, |kind| matches!(kind, EventKind::Empty { .. }))),
];

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::literature::PresetId;
    use crate::sim::SetPointStep;
    use crate::study::Study;
    use crate::study::quadruple_tank::{OperatingPointSpec, QuadrupleTankStudy, Setup, setup_of};

    fn values<const N: usize>(setup: &Setup, names: [&str; N]) -> [Option<f64>; N] {
        let results = QuadrupleTankStudy::update(setup, &[], None);
        names.map(|name| Quantity::find(QUANTITIES, name).expect(name).value(&results))
    }

    fn numbers<const N: usize>(setup: &Setup, names: [&str; N]) -> [f64; N] {
        values(setup, names).map(Option::unwrap)
    }

    /// The rig of Johansson (2000) with both pumps at 3 V.
    fn at(valves: [f64; 2]) -> Setup {
        let operating_point = OperatingPointSpec::PumpVoltage([3.0; 2]);
        Setup { valves, operating_point, ..setup_of(PresetId::JohanssonMinimumPhase) }
    }

    fn with_steps(id: PresetId, sizes: [f64; 2]) -> Setup {
        let mut setup = setup_of(id);
        let step = |level: usize| SetPointStep { level, time_s: 100.0, size: sizes[level] };
        setup.experiment.set_point_steps = [0, 1].map(step).to_vec();
        setup
    }

    #[test]
    fn the_zero_crosses_where_the_relative_gain_is_unbounded() {
        for (gamma, zero) in [(0.3, 0.0248), (0.4, 0.0107), (0.6, -0.0104)] {
            let [found] = numbers(&at([gamma; 2]), ["zero.rightmost"]);
            assert!((found - zero).abs() < 5e-5, "{gamma}: {found}");
        }
        let line = values(&at([0.4, 0.6]), ["zero.rightmost", "gain.det", "rga.lambda11", "niederlinski"]);
        assert_eq!(line, [Some(0.0), Some(0.0), None, None]);
        // λ11 = γ1 γ2/(γ1 + γ2 − 1).
        for (gamma, lambda) in [(0.49, -0.49 * 0.49 / 0.02), (5.0 - 20.0_f64.sqrt(), 5.0)] {
            let [one, other] = numbers(&at([gamma; 2]), ["rga.lambda11", "rga.lambda12"]);
            assert_relative_eq!(one, lambda, max_relative = 1e-9);
            assert_relative_eq!(other, 1.0 - lambda, max_relative = 1e-9);
        }
    }

    /// Johansson (2000), Tables 1 and 2: time constants, levels, zeros.
    #[test]
    fn the_printed_rigs_have_their_printed_numbers() {
        let names = ["tank1.time_constant", "tank3.time_constant", "levels.h1", "zero.rightmost", "zero.leftmost"];
        let minimum = numbers(&setup_of(PresetId::JohanssonMinimumPhase), names);
        let other = numbers(&setup_of(PresetId::JohanssonNonMinimumPhase), names);
        let printed = [[62.0, 23.0, 0.124, -0.018, -0.060], [63.0, 39.0, 0.126, 0.013, -0.057]];
        for (found, printed) in [minimum, other].iter().flatten().zip(printed.as_flattened()) {
            assert_relative_eq!(found, printed, max_relative = 0.07);
        }
    }

    #[test]
    fn the_swapped_pairing_makes_two_positive_gains_stable() {
        let mut setup = setup_of(PresetId::JohanssonNonMinimumPhase);
        let names = ["closed_loop.is_stable", "niederlinski", "pairing.is_diagonal", "pairing.recommended_is_diagonal"];
        let [stable, index, diagonal, advised] = numbers(&setup, names);
        assert!(index < 0.0);
        assert_eq!([stable, diagonal, advised], [1.0, 1.0, 0.0]);
        let [peak] = numbers(&setup, ["closed_loop.sensitivity_peak"]);
        assert!((peak - 2.21).abs() < 5e-3, "{peak}");
        setup.controller.pairing = Pairing::Swapped;
        let swapped = values(&setup, ["closed_loop.is_stable", "closed_loop.sensitivity_peak", "level1.overshoot"]);
        assert_eq!(swapped, [Some(0.0), None, None]);
        setup.controller.pairing = Pairing::Diagonal;
        for (gain, integral_time_s) in [(0.3, 170.0), (0.1, 300.0), (0.02, 1000.0)] {
            for settings in &mut setup.controller.loops {
                (settings.gain, settings.integral_time_s) = (gain, integral_time_s);
            }
            assert_eq!(numbers(&setup, ["closed_loop.is_stable"]), [0.0], "{gain}");
        }
    }

    #[test]
    fn steps_across_the_direction_of_the_zero_cost_four_times_as_much() {
        let errors = ["level1.iae", "level2.iae", "level1.undershoot", "level2.undershoot"];
        let swapped = |sizes: [f64; 2]| {
            let mut setup = with_steps(PresetId::JohanssonNonMinimumPhase, sizes);
            setup.controller.pairing = Pairing::Swapped;
            for (settings, (gain, time)) in setup.controller.loops.iter_mut().zip([(0.3, 170.0), (0.28, 160.0)]) {
                (settings.gain, settings.integral_time_s) = (gain, time);
            }
            numbers(&setup, errors)
        };
        let near = |found: [f64; 4], told: [f64; 4]| {
            for (found, (told, slack)) in found.into_iter().zip(told.into_iter().zip([0.01, 0.015, 0.005, 0.005])) {
                assert!((found - told).abs() < slack, "{found} {told}");
            }
        };
        near(swapped([0.005, 0.005]), [0.77, 0.70, 0.0, 0.0]);
        near(swapped([0.005, -0.005]), [2.99, 3.00, 0.088, 0.12]);
        let [easy] = numbers(&with_steps(PresetId::JohanssonMinimumPhase, [0.005; 2]), ["level2.iae"]);
        let [hard] = numbers(&with_steps(PresetId::JohanssonMinimumPhase, [0.005, -0.005]), ["level2.iae"]);
        assert!((easy - 0.068).abs() < 5e-4 && (hard - 0.063).abs() < 5e-4, "{easy} {hard}");
    }

    #[test]
    fn windup_doubles_the_overshoot() {
        let mut setup = with_steps(PresetId::JohanssonMinimumPhase, [0.07, 0.0]);
        let names = ["controller.anti_windup", "level1.overshoot", "set_point.step1"];
        let [with, calm, step] = numbers(&setup, names);
        setup.controller.loops.iter_mut().for_each(|settings| settings.anti_windup = AntiWindup::Off);
        let [without, wild, _] = numbers(&setup, names);
        assert_eq!([with, without, step], [1.0, 0.0, 0.07]);
        assert!((calm - 0.038).abs() < 5e-4 && (wild - 0.079).abs() < 5e-4, "{calm} {wild}");
        assert_eq!(values(&setup, ["set_point.step2"]), [None]);
        let [pump, run] = numbers(&setup, ["pump1.time_at_limit", "run.time_at_limit"]);
        assert_eq!((pump, run), (7.0, 7.0));
    }

    #[test]
    fn a_model_is_good_for_small_moves_of_a_pump() {
        let error = |share: f64| {
            let mut setup = at([0.7, 0.6]);
            let output = [3.0 * (1.0 + share), 3.0];
            for (settings, output) in setup.controller.loops.iter_mut().zip(output) {
                settings.mode = LoopMode::Manual { output, until_s: setup.experiment.duration_s };
            }
            numbers(&setup, ["run.largest_model_error1", "loop1.is_automatic"])
        };
        let ([small, by_hand], [large, _]) = (error(0.05), error(0.4));
        assert_eq!(by_hand, 0.0);
        // The rest of a square root grows with the square of the move.
        assert!(large > 40.0 * small && small > 0.0, "{small} {large}");
    }

    #[test]
    fn a_pump_has_the_costs_of_the_loop_that_drives_it() {
        let mut setup = setup_of(PresetId::JohanssonNonMinimumPhase);
        setup.controller.pairing = Pairing::Swapped;
        let results = QuadrupleTankStudy::update(&setup, &[], None);
        let travel = results.run.as_ref().as_ref().unwrap().metrics.map(|metrics| metrics.total_variation);
        assert_eq!(numbers(&setup, ["pump1.travel", "pump2.travel"]), [travel[1], travel[0]]);
    }
}

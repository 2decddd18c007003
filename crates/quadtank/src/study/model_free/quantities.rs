//! The numbers of the model-free bench by their names.

use crate::control::{ModelFreePoles, Pairing};
use crate::linear::{Stability, TransmissionZero};
use crate::plant::OperatingPoint;
use crate::sim::{EventKind, TrackingMetrics, Trajectory};
use crate::study::quantity::{highest, lowest, yes};
use crate::study::{LinearPlant, Quantity};

use super::{ModelFreeAnswer, ModelFreeVerdict, PredictedLoss, Results};

type Read = fn(&Results) -> Option<f64>;

const fn q(name: &'static str, unit: &'static str, description: &'static str, read: Read) -> Quantity<Results> {
    Quantity::new(name, unit, description, read)
}

/// Valve fractions where theory looks: after their last step or ramp.
fn valve(results: &Results, index: usize) -> f64 {
    results.setup.plant_at(results.setup.valves_rest_from_s()).valves[index]
}

fn rest(results: &Results) -> Option<OperatingPoint> {
    results.analysis.rest.as_ref().ok().copied()
}

fn linear(results: &Results) -> Option<&LinearPlant> {
    results.analysis.linear.as_ref()?.as_ref().ok()
}

fn rightmost(results: &Results) -> Option<&TransmissionZero> {
    linear(results)?.rightmost_zero()
}

fn niederlinski(results: &Results) -> Option<f64> {
    linear(results)?.niederlinski_of(results.setup.controller.pairing)
}

fn poles(results: &Results) -> Option<&ModelFreePoles> {
    results.analysis.poles.as_ref()?.as_ref().ok()
}

fn continuous_pole(results: &Results) -> Option<f64> {
    let poles = results.analysis.continuous_poles.as_ref()?.as_ref().ok()?;
    poles.iter().map(|pole| pole.re).reduce(f64::max)
}

fn answer(results: &Results) -> Option<&ModelFreeAnswer> {
    results.answer.as_ref().as_ref().ok()
}

fn ran(results: &Results) -> Option<&Trajectory> {
    Some(&answer(results)?.run.trajectory)
}

fn figures(results: &Results, index: usize) -> Option<TrackingMetrics> {
    Some(answer(results)?.figures[index])
}

/// The figures of the loop that drives a pump.
fn figures_of_pump(results: &Results, pump: usize) -> Option<TrackingMetrics> {
    figures(results, results.setup.controller.pairing.loop_of(pump))
}

/// The figures of a response, where it has any.
fn response(results: &Results, index: usize) -> Option<TrackingMetrics> {
    figures(results, index).filter(|figures| figures.no_response.is_none())
}

fn compared(results: &Results, index: usize) -> Option<TrackingMetrics> {
    Some(answer(results)?.comparison.as_ref()?.1[index])
}

fn predicted(results: &Results) -> Option<PredictedLoss> {
    answer(results)?.predicted
}

/// When the zero dynamics end the tracking.
fn foretold_end(results: &Results) -> Option<f64> {
    let predicted = predicted(results)?;
    Some(predicted.from_s + predicted.ends?.after_s())
}

fn verdict(results: &Results, is_meant: fn(&ModelFreeVerdict) -> bool) -> Option<f64> {
    let verdict = ModelFreeVerdict::of(&results.setup, answer(results)?, &results.analysis);
    Some(yes(is_meant(&verdict)))
}

fn happened(results: &Results, is_meant: fn(EventKind) -> bool) -> Option<f64> {
    Some(yes(ran(results)?.events.iter().any(|event| is_meant(event.kind))))
}

/// The numbers of the model-free bench.
#[rustfmt::skip]
pub const QUANTITIES: &[Quantity<Results>] = &[
    q("valves.gamma1", "1", "Valve fraction γ1 after the last step or ramp of the valves; where they swing, as at the start.", |r| Some(valve(r, 0))),
    q("valves.gamma2", "1", "Valve fraction γ2 after the last step or ramp of the valves; where they swing, as at the start.", |r| Some(valve(r, 1))),
    q("valves.sum", "1", "γ1 + γ2 there; at 1 the steady-state gain is singular.", |r| Some(valve(r, 0) + valve(r, 1))),
    q("levels.h1", "m", "Level of lower tank 1 at the references that the run ends with; none where nothing holds them.", |r| Some(rest(r)?.levels[0])),
    q("levels.h2", "m", "Level of lower tank 2 at the references that the run ends with; none where nothing holds them.", |r| Some(rest(r)?.levels[1])),
    q("levels.h3", "m", "Level of upper tank 3 that would hold those references.", |r| Some(rest(r)?.levels[2])),
    q("levels.h4", "m", "Level of upper tank 4 that would hold those references.", |r| Some(rest(r)?.levels[3])),
    q("pumps.v1", "V", "Voltage of pump 1 that would hold those references.", |r| Some(rest(r)?.pump_voltage[0])),
    q("pumps.v2", "V", "Voltage of pump 2 that would hold those references.", |r| Some(rest(r)?.pump_voltage[1])),
    q("zero.rightmost", "1/s", "Right-most transmission zero at those references; positive in the right half-plane.", |r| Some(rightmost(r)?.value.re)),
    q("zero.leftmost", "1/s", "Left-most transmission zero at those references.", |r| Some(linear(r)?.zeros.as_ref().ok()?.first()?.value.re)),
    q("zero.output_direction1", "1", "Part of level 1 in the output direction of the right-most zero, of length 1; its largest part is positive.", |r| Some(rightmost(r)?.output_direction.get(0)?.re)),
    q("zero.output_direction2", "1", "Part of level 2 in the output direction of the right-most zero, of length 1; its largest part is positive.", |r| Some(rightmost(r)?.output_direction.get(1)?.re)),
    q("zero_dynamics.is_stable", "yes/no", "Whether the upper tanks come to rest while both lower levels are held: whether the right-most zero is negative.", |r| Some(yes(rightmost(r)?.value.re < 0.0))),
    q("zero_dynamics.e_folding", "s", "Time in which the upper tanks part by another factor e, 1/z of a zero in the right half-plane; none without one.", |r| Some(rightmost(r)?.value.re).filter(|z| *z > 0.0).map(f64::recip)),
    q("rga.lambda11", "1", "Relative gain λ11 at those references; none where G(0) is singular.", |r| linear(r)?.rga_11.ok()),
    q("niederlinski", "1", "Niederlinski index of the pairing of the law; negative means unstable with integral action.", niederlinski),
    q("pairing.is_diagonal", "yes/no", "Whether level 1 commands pump 1 and level 2 pump 2.", |r| Some(yes(r.setup.controller.pairing == Pairing::Diagonal))),
    q("loop1.model_gain", "m/(s V)", "Gain α̂ of the ultra-local model of loop 1.", |r| Some(r.setup.controller.loops[0].model_gain)),
    q("loop2.model_gain", "m/(s V)", "Gain α̂ of the ultra-local model of loop 2.", |r| Some(r.setup.controller.loops[1].model_gain)),
    q("model_gain.smallest", "m/(s V)", "Smallest α̂ of both loops with which the linear loop is stable at those references; none where no α̂ is.", |r| r.analysis.smallest_model_gain),
    q("model_gain.smallest_of_tank1", "m/(s V)", "The same of lower tank 1 alone and without drain.", |r| Some(r.analysis.smallest_of_integrators?[0])),
    q("model_gain.smallest_of_tank2", "m/(s V)", "The same of lower tank 2 alone and without drain.", |r| Some(r.analysis.smallest_of_integrators?[1])),
    q("closed_loop.is_stable", "yes/no", "Whether the whole linear loop, upper tanks included, is stable at those references; no also on the border of stability.", |r| Some(yes(poles(r)?.stability == Stability::Stable))),
    q("closed_loop.rightmost_pole", "1/s", "Real part of the right-most pole of that loop, mapped to the s-plane.", |r| poles(r)?.poles_s.iter().map(|pole| pole.re).reduce(f64::max)),
    q("closed_loop.continuous_rightmost_pole", "1/s", "Real part of the right-most pole of the loop in continuous time without estimator.", continuous_pole),
    q("level1.iae", "m s", "∫ |r − h| dt of level 1 over the whole run.", |r| Some(figures(r, 0)?.iae)),
    q("level2.iae", "m s", "∫ |r − h| dt of level 2 over the whole run.", |r| Some(figures(r, 1)?.iae)),
    q("level1.ise", "m² s", "∫ (r − h)² dt of level 1 over the whole run.", |r| Some(figures(r, 0)?.ise)),
    q("level2.ise", "m² s", "∫ (r − h)² dt of level 2 over the whole run.", |r| Some(figures(r, 1)?.ise)),
    q("level1.overshoot", "1", "How far level 1 goes beyond its reference after its last step, as a share of the step.", |r| response(r, 0)?.overshoot),
    q("level2.overshoot", "1", "How far level 2 goes beyond its reference after its last step, as a share of the step.", |r| response(r, 1)?.overshoot),
    q("level1.settling_2_percent", "s", "From the last step of level 1 until it stays within 2 % of it; none where it does not.", |r| response(r, 0)?.settling_s),
    q("level2.settling_2_percent", "s", "From the last step of level 2 until it stays within 2 % of it; none where it does not.", |r| response(r, 1)?.settling_s),
    q("level1.looks_settled", "yes/no", "Whether level 1 is where it should be, as far as a plot of it shows.", |r| Some(yes(figures(r, 0)?.looks_settled))),
    q("level2.looks_settled", "yes/no", "Whether level 2 is where it should be, as far as a plot of it shows.", |r| Some(yes(figures(r, 1)?.looks_settled))),
    q("level1.lost_at", "s", "When level 1 leaves 5 % of its reference for good; none where it does not.", |r| figures(r, 0)?.lost_at_s),
    q("level2.lost_at", "s", "When level 2 leaves 5 % of its reference for good; none where it does not.", |r| figures(r, 1)?.lost_at_s),
    q("pump1.travel", "V", "Sum of all moves of the controller output that drives pump 1.", |r| Some(figures_of_pump(r, 0)?.total_variation)),
    q("pump2.travel", "V", "Sum of all moves of the controller output that drives pump 2.", |r| Some(figures_of_pump(r, 1)?.total_variation)),
    q("pump1.time_at_limit", "s", "How long the controller output that drives pump 1 is at a limit.", |r| Some(figures_of_pump(r, 0)?.saturated_s)),
    q("pump2.time_at_limit", "s", "How long the controller output that drives pump 2 is at a limit.", |r| Some(figures_of_pump(r, 1)?.saturated_s)),
    q("pump1.highest_voltage", "V", "Highest voltage of pump 1 in the run.", |r| highest(&ran(r)?.pump_voltage[0])),
    q("pump2.highest_voltage", "V", "Highest voltage of pump 2 in the run.", |r| highest(&ran(r)?.pump_voltage[1])),
    q("pump1.lowest_voltage", "V", "Lowest voltage of pump 1 in the run.", |r| lowest(&ran(r)?.pump_voltage[0])),
    q("pump2.lowest_voltage", "V", "Lowest voltage of pump 2 in the run.", |r| lowest(&ran(r)?.pump_voltage[1])),
    q("set_point.step1", "m", "By how much the reference of level 1 steps in all.", |r| Some(r.setup.set_point_step(0))),
    q("set_point.step2", "m", "By how much the reference of level 2 steps in all.", |r| Some(r.setup.set_point_step(1))),
    q("run.duration", "s", "How long the experiment lasts.", |r| Some(r.setup.experiment.duration_s)),
    q("run.time_at_limit", "s", "How long the outputs of both loops are at a limit, added.", |r| Some(figures(r, 0)?.saturated_s + figures(r, 1)?.saturated_s)),
    q("run.iae_sum", "m s", "∫ |r − h| dt over the whole run, both levels added.", |r| Some(figures(r, 0)?.iae + figures(r, 1)?.iae)),
    q("run.lost_at", "s", "When the first level leaves its reference for good; none where none does.", |r| answer(r)?.lost_at_s()),
    q("run.foretold_from", "s", "From when on the zero dynamics foretell an end of the tracking.", |r| Some(predicted(r)?.from_s)),
    q("run.foretold_end", "s", "When the zero dynamics say that a pump or an upper tank ends the tracking; none where they foretell no end.", foretold_end),
    q("run.final_level1", "m", "Level 1 at the end of the run.", |r| ran(r)?.levels[0].last().copied()),
    q("run.final_level2", "m", "Level 2 at the end of the run.", |r| ran(r)?.levels[1].last().copied()),
    q("run.final_level3", "m", "Level 3 at the end of the run.", |r| ran(r)?.levels[2].last().copied()),
    q("run.final_level4", "m", "Level 4 at the end of the run.", |r| ran(r)?.levels[3].last().copied()),
    q("run.peak_level1", "m", "Highest level 1 of the run.", |r| highest(&ran(r)?.levels[0])),
    q("run.peak_level2", "m", "Highest level 2 of the run.", |r| highest(&ran(r)?.levels[1])),
    q("run.peak_level3", "m", "Highest level 3 of the run.", |r| highest(&ran(r)?.levels[2])),
    q("run.peak_level4", "m", "Highest level 4 of the run.", |r| highest(&ran(r)?.levels[3])),
    q("run.overflows", "yes/no", "Whether a tank runs over in the run.", |r| happened(r, |kind| matches!(kind, EventKind::Overflow { .. }))),
    q("run.runs_dry", "yes/no", "Whether a tank runs dry in the run.", |r| happened(r, |kind| matches!(kind, EventKind::Empty { .. }))),
    q("verdict.is_settled", "yes/no", "Whether both levels settle in a loop that is stable.", |r| verdict(r, |verdict| matches!(verdict, ModelFreeVerdict::Settled(_)))),
    q("verdict.is_leaving", "yes/no", "Whether both levels are where they should be while the upper tanks are leaving, so that it cannot go on.", |r| verdict(r, |verdict| matches!(verdict, ModelFreeVerdict::Leaving { .. }))),
    q("verdict.is_lost", "yes/no", "Whether a level followed its reference and then left it for good.", |r| verdict(r, |verdict| matches!(verdict, ModelFreeVerdict::Lost { .. }))),
    q("verdict.is_rippling", "yes/no", "Whether valves move and the levels follow.", |r| verdict(r, |verdict| matches!(verdict, ModelFreeVerdict::Rippling { .. }))),
    q("comparison.iae1", "m s", "∫ |r − h| dt of level 1 under the PI loops of the comparison.", |r| Some(compared(r, 0)?.iae)),
    q("comparison.iae2", "m s", "∫ |r − h| dt of level 2 under the PI loops of the comparison.", |r| Some(compared(r, 1)?.iae)),
    q("comparison.time_at_limit", "s", "How long the outputs of both PI loops are at a limit, added.", |r| Some(compared(r, 0)?.saturated_s + compared(r, 1)?.saturated_s)),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::literature::junqueira::{PublishedExperiment, PublishedValves};
    use crate::study::Study;
    use crate::study::model_free::{ModelFreeSetup, ModelFreeStudy};

    fn values<const N: usize>(setup: &ModelFreeSetup, names: [&str; N]) -> [Option<f64>; N] {
        let results = ModelFreeStudy::update(setup, &[], None);
        names.map(|name| Quantity::find(QUANTITIES, name).expect(name).value(&results))
    }

    /// Case b of Junqueira, Neves and Angelico: outputs settle while the upper tanks part.
    #[test]
    fn tracking_is_lost_when_the_zero_has_had_its_time() {
        let mut setup = ModelFreeSetup::published(PublishedValves::B, PublishedExperiment::S3);
        let names = ["run.lost_at", "level1.lost_at", "level2.lost_at", "verdict.is_lost", "run.overflows"];
        assert_eq!(values(&setup, names), [Some(135.0), Some(135.0), None, Some(1.0), Some(1.0)]);
        setup.experiment.set_point_steps[0].size = 0.01;
        assert_eq!(values(&setup, ["run.lost_at", "set_point.step1"]), [Some(194.0), Some(0.01)]);
        let names = ["zero.rightmost", "zero_dynamics.e_folding", "zero_dynamics.is_stable", "closed_loop.is_stable"];
        let [zero, time, inside, outside] = values(&setup, names).map(Option::unwrap);
        assert!(zero > 0.0 && (zero * time - 1.0).abs() < 1e-12);
        assert_eq!([inside, outside], [0.0, 0.0]);
    }

    #[test]
    fn equal_steps_hide_what_is_going_to_end_them() {
        let names = ["verdict.is_leaving", "run.lost_at", "run.foretold_end", "level1.looks_settled"];
        let hidden = ModelFreeSetup::published(PublishedValves::B, PublishedExperiment::S2);
        let [leaving, lost, end, settled] = values(&hidden, names);
        assert_eq!((leaving, lost, settled), (Some(1.0), None, Some(1.0)));
        assert!(end.is_some_and(|end| (end - 1018.0).abs() < 1.0), "{end:?}");
        let fine = ModelFreeSetup::published(PublishedValves::A, PublishedExperiment::S2);
        let [settled, inside, end] =
            values(&fine, ["verdict.is_settled", "zero_dynamics.is_stable", "run.foretold_end"]);
        assert_eq!((settled, inside, end), (Some(1.0), Some(1.0), None));
    }
}

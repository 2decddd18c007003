//! The numbers of the level-loop bench by their names.

use crate::control::AntiWindup;
use crate::linear::{LoopStability, Margins};
use crate::sim::level::{LevelFigures, LevelStepResponse};
use crate::study::Quantity;
use crate::study::quantity::yes;
use crate::tuning::{ModelRule, ProcessModel, Regulation, TuningRule, UltimatePoint};

use super::{
    Finding, LevelLoopAnswer, ModelMatch, Objective, PiTuning, PlantAnswer, Results, StepTestAnswer, SuggestedRule,
};

type Read = fn(&Results) -> Option<f64>;

const fn q(name: &'static str, unit: &'static str, description: &'static str, read: Read) -> Quantity<Results> {
    Quantity::new(name, unit, description, read)
}

/// The value if it is finite; `None` otherwise.
fn finite(value: f64) -> Option<f64> {
    Some(value).filter(|value| value.is_finite())
}

/// The plant at the rest of the experiment, where there is one.
fn plant(results: &Results) -> Option<&PlantAnswer> {
    results.plant.as_ref().as_ref().ok()
}

fn test(results: &Results) -> Option<&StepTestAnswer> {
    results.test.as_ref().as_ref().ok()
}

/// The model that was read from the step test.
fn tested(results: &Results) -> Option<ProcessModel> {
    Some(test(results)?.fit.as_ref().ok()?.model)
}

fn matched(results: &Results) -> Option<ModelMatch> {
    ModelMatch::of(test(results)?, plant(results)?)
}

fn ultimate(results: &Results) -> Option<UltimatePoint> {
    plant(results)?.ultimate
}

fn self_regulates(results: &Results) -> Option<f64> {
    match test(results)?.regulation?.ok()? {
        Regulation::SelfRegulating(_) => Some(1.0),
        Regulation::Integrating(_) => Some(0.0),
        Regulation::Undecided(_) => None,
    }
}

fn by_model(results: &Results, is_meant: fn(ModelRule) -> bool) -> Option<PiTuning> {
    suggested(results, |rule| matches!(rule, SuggestedRule::Model(rule) if is_meant(rule)))
}

fn by_point(results: &Results, wanted: TuningRule) -> Option<PiTuning> {
    suggested(results, |rule| rule == SuggestedRule::Ultimate(wanted))
}

fn suggested(results: &Results, is_meant: impl Fn(SuggestedRule) -> bool) -> Option<PiTuning> {
    results.suggestions.iter().find(|suggestion| is_meant(suggestion.rule))?.settings.ok()
}

fn simc(results: &Results) -> Option<PiTuning> {
    by_model(results, |rule| matches!(rule, ModelRule::Simc { .. }))
}

fn lambda(results: &Results) -> Option<PiTuning> {
    by_model(results, |rule| matches!(rule, ModelRule::Lambda { .. }))
}

fn amigo(results: &Results) -> Option<PiTuning> {
    by_model(results, |rule| matches!(rule, ModelRule::Amigo))
}

fn ran(results: &Results) -> Option<&LevelLoopAnswer> {
    results.answer.as_ref().as_ref().ok()
}

fn figures(results: &Results) -> Option<LevelFigures> {
    Some(ran(results)?.figures)
}

fn step(results: &Results) -> Option<LevelStepResponse> {
    ran(results)?.step?.ok()
}

fn is_stable(results: &Results) -> Option<f64> {
    match ran(results)?.quality.ok()??.stability {
        LoopStability::NotComputed { .. } => None,
        stability => Some(yes(stability == LoopStability::Stable)),
    }
}

fn margins(results: &Results) -> Option<Margins> {
    ran(results)?.quality.ok()??.margins
}

fn largest_deviation(results: &Results) -> Option<f64> {
    let (start, level) = (results.setup.experiment.level, figures(results)?.level);
    Some(f64::max(level.maximum - start, start - level.minimum))
}

fn found(results: &Results, is_meant: fn(&Finding) -> bool) -> Option<f64> {
    Some(yes(ran(results)?.findings.iter().any(is_meant)))
}

fn share_at_limit(results: &Results) -> Option<f64> {
    let shares = ran(results)?.findings.iter().filter_map(|finding| match finding {
        Finding::OutputAtLimit { share } => Some(*share),
        _ => None,
    });
    Some(shares.sum())
}

/// The numbers of the level-loop bench.
#[rustfmt::skip]
pub const QUANTITIES: &[Quantity<Results>] = &[
    q("rest.level", "m", "Level at the rest that the experiment starts from.", |r| Some(plant(r)?.rest.level)),
    q("rest.inflow", "m³/s", "Inflow at rest, without that of a valve in the inlet.", |r| Some(plant(r)?.rest.inflow)),
    q("rest.outflow", "m³/s", "Outflow of the tank at rest.", |r| Some(plant(r)?.rest.outflow)),
    q("rest.travel", "1", "Travel X of the valve at rest, 0 to 1.", |r| Some(plant(r)?.rest.travel)),
    q("rest.opening", "1", "Opening f(X) of the valve at rest, 0 to 1.", |r| Some(plant(r)?.rest.opening)),
    q("rest.output", "signal", "Controller output at rest.", |r| Some(plant(r)?.rest.output)),
    q("model.slope", "1/s", "Slope K/τ of the linear model at rest, lags of the instruments apart; none where a quick-opening valve is shut.", |r| finite(plant(r)?.gains.slope_gain())),
    q("model.gain", "1", "Gain K of the linear model at rest, signal per signal; none for a tank that integrates, and where a quick-opening valve is shut.", |r| finite(plant(r)?.gains.process_gain()?)),
    q("model.time_constant", "s", "Time constant τ = R A of the tank at rest; none for a tank that integrates.", |r| plant(r)?.gains.time_constant()),
    q("model.dead_time", "s", "Dead time θ that stands for the lags of the instruments in the rules, by the half rule (Skogestad 2003).", |r| Some(plant(r)?.model.dead_time_s())),
    q("half_rule.slope", "1/s", "Slope K/τ of the model of the rules, with half of a lag in τ by the half rule.", |r| finite(plant(r)?.model.slope())),
    q("half_rule.time_constant", "s", "Time constant of the model of the rules, by the half rule; none for a tank that integrates.", |r| plant(r)?.model.time_constant_s()),
    q("test.slope", "1/s", "Slope K/τ of the model that was read from the step test.", |r| Some(tested(r)?.slope())),
    q("test.gain", "1", "Gain K of the model of the step test, signal per signal; none for a ramp.", |r| tested(r)?.gain()),
    q("test.time_constant", "s", "Time constant τ of the model of the step test; none for a ramp.", |r| tested(r)?.time_constant_s()),
    q("test.dead_time", "s", "Dead time θ of the model of the step test.", |r| Some(tested(r)?.dead_time_s())),
    q("test.inflow", "m³/s", "Inflow of the step test.", |r| Some(r.setup.test.inflow)),
    q("test.slope_ratio", "1", "Slope of the plant where it works over that of the step test; above 1 the plant is faster.", |r| Some(matched(r)?.ratio())),
    q("test.suits", "yes/no", "Whether the slopes of plant and test differ by less than a factor of 1.5.", |r| Some(yes(matched(r)?.suits()))),
    q("test.is_self_regulating", "yes/no", "Whether the test with a step back shows a level that finds a rest of its own; none where it shows neither.", self_regulates),
    q("ultimate.gain", "1", "Gain at which the linear loop with proportional control oscillates, with the sign of the process.", |r| Some(ultimate(r)?.gain)),
    q("ultimate.period", "s", "Period of that oscillation.", |r| Some(ultimate(r)?.period)),
    q("ultimate.frequency", "rad/s", "Frequency of that oscillation.", |r| Some(ultimate(r)?.frequency())),
    q("simc.gain", "1", "Gain by SIMC from the chosen model (Skogestad 2003).", |r| Some(simc(r)?.gain)),
    q("simc.integral_time", "s", "Integral time by SIMC from the chosen model.", |r| Some(simc(r)?.integral_time_s)),
    q("lambda.gain", "1", "Gain by Lambda tuning from the chosen model.", |r| Some(lambda(r)?.gain)),
    q("lambda.integral_time", "s", "Integral time by Lambda tuning from the chosen model.", |r| Some(lambda(r)?.integral_time_s)),
    q("amigo.gain", "1", "Gain by AMIGO from the chosen model.", |r| Some(amigo(r)?.gain)),
    q("amigo.integral_time", "s", "Integral time by AMIGO from the chosen model.", |r| Some(amigo(r)?.integral_time_s)),
    q("ziegler_nichols.gain", "1", "Gain by Ziegler and Nichols from the ultimate point.", |r| Some(by_point(r, TuningRule::ZieglerNicholsPi)?.gain)),
    q("ziegler_nichols.integral_time", "s", "Integral time by Ziegler and Nichols from the ultimate point.", |r| Some(by_point(r, TuningRule::ZieglerNicholsPi)?.integral_time_s)),
    q("tyreus_luyben.gain", "1", "Gain by Tyreus and Luyben from the ultimate point.", |r| Some(by_point(r, TuningRule::TyreusLuybenPi)?.gain)),
    q("tyreus_luyben.integral_time", "s", "Integral time by Tyreus and Luyben from the ultimate point.", |r| Some(by_point(r, TuningRule::TyreusLuybenPi)?.integral_time_s)),
    q("objective.is_tight", "yes/no", "Whether the loop is for tight control of the level; no for averaging control.", |r| Some(yes(r.setup.objective == Objective::Tight))),
    q("loop.gain", "1", "Gain Kp of the PI controller, signal per signal; none for any other controller.", |r| Some(r.setup.pi_tuning()?.gain)),
    q("loop.integral_time", "s", "Integral time Ti of the PI controller, continuous or sampled.", |r| r.setup.integral_time_s()),
    q("loop.anti_windup", "yes/no", "Whether the controller has anti-windup.", |r| Some(yes(r.setup.anti_windup() != AntiWindup::Off))),
    q("reference.gain", "1", "Gain of the tuning that the loop is held against.", |r| Some(r.setup.reference.gain)),
    q("reference.integral_time", "s", "Integral time of the tuning that the loop is held against.", |r| Some(r.setup.reference.integral_time_s)),
    q("closed_loop.is_stable", "yes/no", "Whether the linear loop at rest is stable; none for an output by hand.", is_stable),
    q("margins.gain", "1", "Smallest factor above 1 on the gain at which the linear loop oscillates; none where no factor does.", |r| margins(r)?.gain_up),
    q("margins.gain_down", "1", "Largest factor below 1 on the gain at which the linear loop oscillates; none where no factor does.", |r| margins(r)?.gain_down),
    q("margins.phase", "rad", "Smallest phase lag at which the linear loop oscillates.", |r| margins(r)?.phase),
    q("margins.sensitivity_peak", "1", "Sensitivity peak Ms of the linear loop, 1 at least.", |r| ran(r)?.quality.ok()??.sensitivity_peak()),
    q("assess.variance_level", "m²", "Variance of the level in the run.", |r| Some(figures(r)?.level.variance)),
    q("assess.variance_outflow", "m⁶/s²", "Variance of the outflow in the run.", |r| Some(figures(r)?.outflow.variance)),
    q("assess.reference_variance_level", "m²", "Variance of the level with the reference tuning on the model.", |r| Some(ran(r)?.reference.ok()?.level.variance)),
    q("assess.reference_variance_outflow", "m⁶/s²", "Variance of the outflow with the reference tuning on the model.", |r| Some(ran(r)?.reference.ok()?.outflow.variance)),
    q("assess.index_level", "1", "Variance of the level with the reference over that of the loop; near 1 the loop is as tight (Andreis 2017, Eq. 28).", |r| Some(ran(r)?.indices?.ok()?.level.quality())),
    q("assess.index_outflow", "1", "Variance of the outflow with the reference over that of the loop; near 1 the loop averages as well (Andreis 2017, Eq. 28).", |r| Some(ran(r)?.indices?.ok()?.outflow.quality())),
    q("assess.index", "1", "The index of the objective: of the level for tight, of the outflow for averaging control.", |r| Some(ran(r)?.index_for(r.setup.objective)?.quality())),
    q("assess.indices_agree", "yes/no", "Whether both indices advise the same.", |r| Some(yes(ran(r)?.indices?.ok()?.agree()))),
    q("assess.harris", "1", "Index of Harris (1989): the variance of the level that no feedback can remove over the one there is.", |r| Some(ran(r)?.harris.as_ref().ok()?.index.quality())),
    q("run.duration", "s", "How long the experiment lasts.", |r| Some(r.setup.experiment.duration_s)),
    q("run.largest_level_deviation", "m", "Largest distance of the level from that at the start.", largest_deviation),
    q("run.lowest_level", "m", "Lowest level of the run.", |r| Some(figures(r)?.level.minimum)),
    q("run.highest_level", "m", "Highest level of the run.", |r| Some(figures(r)?.level.maximum)),
    q("run.mean_level", "m", "Mean level of the run.", |r| Some(figures(r)?.level.mean)),
    q("run.final_level", "m", "Level at the end of the run.", |r| ran(r)?.log.level.last().copied()),
    q("run.lowest_outflow", "m³/s", "Lowest outflow of the run.", |r| Some(figures(r)?.outflow.minimum)),
    q("run.highest_outflow", "m³/s", "Highest outflow of the run.", |r| Some(figures(r)?.outflow.maximum)),
    q("run.iae", "m s", "∫ |e| dt of the level as the transmitter sees it.", |r| Some(figures(r)?.iae)),
    q("run.ise", "m² s", "∫ e² dt of the level as the transmitter sees it.", |r| Some(figures(r)?.ise)),
    q("run.itae", "m s²", "∫ t |e| dt of the level as the transmitter sees it.", |r| Some(figures(r)?.itae)),
    q("run.output_travel", "signal", "Sum of the moves of the controller output.", |r| Some(figures(r)?.output_moves)),
    q("run.valve_travel", "1", "Sum of the moves of the valve; 1 is once through its range.", |r| Some(ran(r)?.travel.total)),
    q("run.valve_reversals", "1", "How often the valve turns round.", |r| Some(ran(r)?.travel.reversals as f64)),
    q("run.valve_at_end", "1", "Share of the rows at which the valve is fully open or fully closed.", |r| Some(ran(r)?.travel.at_end)),
    q("run.output_at_limit", "1", "Share of the rows at which the output is at an end of its range, so that the loop is open.", share_at_limit),
    q("run.full_time", "s", "How long the tank is full to the brim.", |r| Some(ran(r)?.log.full_s)),
    q("run.empty_time", "s", "How long the tank is empty.", |r| Some(ran(r)?.log.empty_s)),
    q("run.leaves_band", "yes/no", "Whether the level leaves the band of averaging control; no for tight control.", |r| found(r, |finding| matches!(finding, Finding::LeavesBand { .. }))),
    q("run.fails", "yes/no", "Whether anything that is found about the run is a failure of the loop.", |r| found(r, Finding::is_failure)),
    q("run.rise_time", "s", "From 10 to 90 % of the final move, for one step of the set-point at the start; none of a level that does not come to rest.", |r| step(r)?.rise_time_s),
    q("run.settling_time", "s", "From when on the level stays within 2 % of its final move, for one step of the set-point at the start; none of a level that does not come to rest.", |r| step(r)?.settling_time_s),
    q("run.overshoot", "1", "By how much the largest move exceeds the final one, as a share of it, for one step of the set-point at the start; none of a level that does not come to rest.", |r| step(r)?.overshoot),
    q("run.offset", "1", "Share of the step of the set-point that is missing at the end; none of an unstable loop.", |r| Some(step(r)?.offset)),
];

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;
    use crate::sim::level::LevelController;
    use crate::study::Study;
    use crate::study::level_loop::{LevelLoopSetup, LevelLoopStudy};

    fn numbers<const N: usize>(setup: &LevelLoopSetup, names: [&str; N]) -> [f64; N] {
        let results = LevelLoopStudy::update(setup, &[], None);
        names.map(|name| Quantity::find(QUANTITIES, name).expect(name).value(&results).expect(name))
    }

    /// Andreis (2017), §4.2.7.1, and what is true where the loop works.
    #[test]
    fn the_test_of_the_source_is_another_plant() {
        let names = ["test.slope", "test.suits", "model.slope", "model.time_constant", "test.inflow", "rest.outflow"];
        let [tested, suits, slope, time_constant, there, here] = numbers(&LevelLoopSetup::default(), names);
        assert!((tested - 0.0098).abs() < 1e-4 && (slope - 0.0231).abs() < 5e-5, "{tested} {slope}");
        assert_eq!((suits, there, here), (0.0, 0.006, 0.017));
        // τ = R A with R = 2 h/q of a square root.
        assert_relative_eq!(time_constant, 2.0 * 1.0 / 0.017, max_relative = 1e-12);
    }

    #[test]
    fn the_optimum_of_the_source_has_hardly_any_margin() {
        let names = ["margins.gain", "closed_loop.is_stable", "assess.index", "loop.gain", "ultimate.gain"];
        let mut setup = LevelLoopSetup::default();
        let [current, ..] = numbers(&setup, names);
        setup.controller = LevelController::pi(93.7, 2999.7);
        let [margin, stable, index, gain, ultimate] = numbers(&setup, names);
        assert!((margin - 1.06).abs() < 5e-3 && (current - 9.94).abs() < 5e-3, "{margin} {current}");
        // The loop is its own reference.
        assert_eq!((stable, index, gain), (1.0, 1.0, 93.7));
        assert!((ultimate / gain - margin).abs() < 5e-3, "{ultimate}");
    }

    #[test]
    fn the_index_of_the_other_objective_praises_the_wrong_loop() {
        let mut setup = LevelLoopSetup::default();
        let names = ["assess.index_level", "assess.index_outflow", "assess.variance_level", "assess.variance_outflow"];
        let tight = numbers(&setup, names);
        setup.controller = LevelController::pi(1.0, 2500.0);
        let slack = numbers(&setup, names);
        assert!(slack[0] < tight[0] && slack[1] > 1.0, "{tight:?} {slack:?}");
        assert!(slack[2] > tight[2] && slack[3] < tight[3], "{tight:?} {slack:?}");
    }
}

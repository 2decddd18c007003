use serde::Serialize;
use thiserror::Error;

use quadtank::literature::campestrini::PublishedPlant;

use quadtank::control::Pairing;
use quadtank::study::relay_tuning::{
    CompareSpec, DecouplerSpec, DesignSpec, Element, GivenPid, PidForm, SeriesElement, TestKind, TuningPlant,
    TuningSetup,
};

/// What a session may not have been meant to say. Nothing is refused for it.
#[derive(Clone, Debug, PartialEq, Error, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(tag = "warning", rename_all = "kebab-case")]
pub enum TuningWarning {
    /// The elements look as if the highest power of s had been written first.
    #[error("{field}: read by rising powers of s, as {read_as}; if {reversed} is meant, turn the coefficients round")]
    CoefficientOrder {
        /// The first denominator that looks so.
        field: String,
        /// The polynomial that was read.
        read_as: String,
        /// The polynomial with the coefficients turned round.
        reversed: String,
    },
    /// A relay on an element with direct feedthrough that switches itself at once.
    #[error("tuning.test.hysteresis[{}]: g{number}{number} passes its input straight on, so its output moves by {half_width} at once \
             with the relay, which chatters with less hysteresis than that", number - 1)]
    SwitchesItself {
        /// Number of the loop, 1 or 2.
        number: usize,
        /// Half width of the hysteresis that it needs at least.
        half_width: f64,
    },
    /// A setting that changes nothing here.
    #[error("{field}: without effect here; it acts only {acts}")]
    NoEffect {
        /// Where in the document.
        field: &'static str,
        /// Where it would act.
        acts: &'static str,
    },
}

/// How far apart both readings of the coefficients have to be to be told apart.
const FAR_APART: f64 = 10.0;
/// Dead time in lags up to which a reading is plausible.
const LONGEST_DEAD_TIME: f64 = 5.0;
/// Lag in sampling times of the controllers from which on a reading is plausible.
const SHORTEST_LAG: f64 = 2.0;

/// What a session may not have been meant to say.
pub fn warnings(setup: &TuningSetup) -> Vec<TuningWarning> {
    coefficient_order(setup)
        .into_iter()
        .chain(relays_that_switch_themselves(setup))
        .chain(settings_without_effect(setup))
        .chain(design_without_effect(&setup.design))
        .collect()
}

/// Relays whose own output jumps beyond their hysteresis when they switch.
fn relays_that_switch_themselves(setup: &TuningSetup) -> Vec<TuningWarning> {
    let (TuningPlant::Elements(rows), test) = (&setup.plant, &setup.test) else { return Vec::new() };
    let half_width = |index: usize| {
        let element = rows[index][index].transfer_function().ok().filter(|of| of.dead_time() == 0.0);
        test.amplitudes[index] * element.map_or(0.0, |of| of.feedthrough().abs())
    };
    let is_single = test.kind == TestKind::Single;
    let has_relay = |index: usize| !is_single || (test.number == index + 1 && test.behind == SeriesElement::Nothing);
    let of_loop = |index: usize| (has_relay(index), index, half_width(index));
    let chattering = |(has_relay, index, half_width): (bool, usize, f64)| {
        let is_one = has_relay && half_width > 0.0 && test.hysteresis[index] < half_width;
        is_one.then_some(TuningWarning::SwitchesItself { number: index + 1, half_width })
    };
    [0, 1].map(of_loop).into_iter().filter_map(chattering).collect()
}

/// Settings with a value of their own that change nothing, because the session has no use for them.
fn settings_without_effect(setup: &TuningSetup) -> Vec<TuningWarning> {
    let (test, kind) = (&setup.test, setup.test.kind);
    let is_single = kind == TestKind::Single;
    // Index of the loop without a relay.
    let idle = |index: usize| is_single && test.number != index + 1;
    let nonlinear = setup.plant.tank().is_some_and(|tank| tank.nonlinear);
    let of_motion = match setup.plant {
        TuningPlant::Parameters { .. } => "tuning.plant.parameters.nonlinear",
        _ => "tuning.plant.quadruple_tank.nonlinear",
    };
    let is_column = setup.plant == TuningPlant::Published(PublishedPlant::WoodBerry);
    let dynamic = !matches!(setup.design.decoupler, DecouplerSpec::None | DecouplerSpec::Static);
    no_effect([
        (!is_single && test.number != 1, "tuning.test.number", "in a single test"),
        (!is_single && test.behind != SeriesElement::Nothing, "tuning.test.behind", "in a single test"),
        (idle(0) && test.hysteresis[0] != 0.0, "tuning.test.hysteresis[0]", "with a relay in loop 1"),
        (idle(1) && test.hysteresis[1] != 0.0, "tuning.test.hysteresis[1]", "with a relay in loop 2"),
        (idle(0) && test.bias[0] != 0.0, "tuning.test.bias[0]", "with a relay in loop 1"),
        (idle(1) && test.bias[1] != 0.0, "tuning.test.bias[1]", "with a relay in loop 2"),
        (kind != TestKind::Independent && test.detuning != [1.0; 2], "tuning.test.detuning", "in independent tests"),
        (kind != TestKind::Sequential && test.passes != 1, "tuning.test.passes", "in a sequential test"),
        (
            nonlinear && kind != TestKind::Simultaneous,
            of_motion,
            "in a simultaneous test and in the response; other tests run on the linear model",
        ),
        (
            nonlinear && dynamic,
            of_motion,
            "without a dynamic decoupler, with which the response is that of the linear model",
        ),
        (
            setup.response.compare == CompareSpec::Full && !is_column,
            "tuning.response.compare",
            "on the column of Wood and Berry, whose full controller it is",
        ),
    ])
}

/// The same of a design: what a placement has beside given controllers, and what a given controller without derivative action or
/// gain has of these.
fn design_without_effect(design: &DesignSpec) -> Vec<TuningWarning> {
    let absent = DesignSpec::default();
    let Some(controllers) = design.controllers else {
        let is_idle = design.pairing != Pairing::Diagonal;
        return no_effect([(is_idle, "tuning.design.pairing", "on given controllers")]);
    };
    let placed = "in a placement; here the controllers are given";
    let of_placement = no_effect([
        (design.method != absent.method, "tuning.design.method", placed),
        (design.action != absent.action, "tuning.design.action", placed),
        (design.target != absent.target, "tuning.design.target", placed),
        (design.root != absent.root, "tuning.design.root", placed),
    ]);
    let [first, second] = controllers.each_ref().map(idle_parts);
    let of_controllers = no_effect([
        (first[3], "tuning.design.controllers[0].integral_time", "in the ISA and the series form"),
        (first[4], "tuning.design.controllers[0].derivative_time", "in the ISA and the series form"),
        (first[5], "tuning.design.controllers[0].integral_gain", "in the parallel form"),
        (first[6], "tuning.design.controllers[0].derivative_gain", "in the parallel form"),
        (second[3], "tuning.design.controllers[1].integral_time", "in the ISA and the series form"),
        (second[4], "tuning.design.controllers[1].derivative_time", "in the ISA and the series form"),
        (second[5], "tuning.design.controllers[1].integral_gain", "in the parallel form"),
        (second[6], "tuning.design.controllers[1].derivative_gain", "in the parallel form"),
        (first[0], "tuning.design.controllers[0].integral_time", "with a gain"),
        (first[1], "tuning.design.controllers[0].derivative_time", "with a gain"),
        (first[2], "tuning.design.controllers[0].filter_time", "with derivative action"),
        (second[0], "tuning.design.controllers[1].integral_time", "with a gain"),
        (second[1], "tuning.design.controllers[1].derivative_time", "with a gain"),
        (second[2], "tuning.design.controllers[1].filter_time", "with derivative action"),
    ]);
    [of_placement, of_controllers].concat()
}

/// Whether parts of a given controller are set without acting: integral time, derivative time and filter for want of a gain or of
/// derivative action; times in the parallel form, and integral and derivative gain in the others.
fn idle_parts(pid: &GivenPid) -> [bool; 7] {
    let &GivenPid { form, integral_time, derivative_time, integral_gain, derivative_gain, filter_time, .. } = pid;
    let is_parallel = form == PidForm::Parallel;
    let is_open = pid.is_open() && !is_parallel;
    [
        is_open && integral_time.is_some(),
        is_open && derivative_time != 0.0,
        !pid.has_derivative() && filter_time.is_some(),
        is_parallel && integral_time.is_some(),
        is_parallel && derivative_time != 0.0,
        !is_parallel && integral_gain != 0.0,
        !is_parallel && derivative_gain != 0.0,
    ]
}

fn no_effect<const N: usize>(settings: [(bool, &'static str, &'static str); N]) -> Vec<TuningWarning> {
    let idle = settings.into_iter().filter(|(is_idle, ..)| *is_idle);
    idle.map(|(_, field, acts)| TuningWarning::NoEffect { field, acts }).collect()
}

/// Whether the elements look as if the highest power of s had been written first. Then the denominators are written as those
/// of lags usually are, with the constant term 1 at the end, and either
///
/// * one ends with a zero, which as the highest power is no coefficient and as the constant term an integrator; or
/// * with the lags that were read neither sampling time nor duration of the response nor the dead times make sense, but they
///   do with the lags of the reversed polynomials, and these are far apart.
fn coefficient_order(setup: &TuningSetup) -> Option<TuningWarning> {
    let TuningPlant::Elements(rows) = &setup.plant else { return None };
    let is_dynamic = |of: &Element| of.denominator.len() > 1 && of.numerator.iter().any(|&b| b != 0.0);
    let elements = || {
        let places = [(0, 0), (0, 1), (1, 0), (1, 1)];
        places.into_iter().map(|(i, j)| ((i, j), &rows[i][j])).filter(|(_, element)| is_dynamic(element))
    };
    let integrator = elements().find(|(_, of)| of.denominator.last() == Some(&0.0) && ends_with_one(of));
    let turned = || {
        let plausible = |lag: f64| {
            let dead_time = elements().map(|(_, of)| of.dead_time).fold(0.0, f64::max);
            (SHORTEST_LAG * setup.response.step..=setup.response.duration).contains(&lag)
                && dead_time <= LONGEST_DEAD_TIME * lag
        };
        let longest = |lag: fn(&Element) -> f64| elements().map(|(_, of)| lag(of)).fold(0.0, f64::max);
        let (read, reversed) = (longest(lag_of), longest(reversed_lag_of));
        let far_apart = (reversed / read).ln().abs() >= FAR_APART.ln();
        let is_turned = far_apart && !plausible(read) && plausible(reversed);
        // The order is judged by time constants, which an integrating or biproper element does not show.
        let is_lag = |of: &Element| {
            let element = of.transfer_function();
            element.is_ok_and(|element| element.integrators() == 0 && element.feedthrough() == 0.0)
        };
        let like_lags = elements().all(|(_, of)| of.denominator.last() == Some(&1.0) && is_lag(of));
        elements().find(|(_, of)| ends_with_one(of)).filter(|_| like_lags && is_turned)
    };
    let ((row, column), element) = integrator.or_else(turned)?;
    let powers = &element.denominator;
    Some(TuningWarning::CoefficientOrder {
        field: format!("tuning.plant.elements[{row}][{column}].denominator"),
        read_as: polynomial(powers.iter()),
        reversed: polynomial(powers.iter().rev()),
    })
}

/// Whether a denominator looks as if it had been written highest power first: its last nonzero coefficient is 1, and its first one is
/// neither 1 nor 0. A first coefficient of 0 is a pole at s = 0 written by rising powers: a highest power is not written with 0.
fn ends_with_one(element: &Element) -> bool {
    let last = element.denominator.iter().rev().find(|&&a| a != 0.0);
    last == Some(&1.0) && !matches!(element.denominator.first(), Some(&1.0 | &0.0))
}

/// The sum of the time constants, a1/a0.
fn lag_of(element: &Element) -> f64 {
    (element.denominator[1] / element.denominator[0]).abs()
}

/// The same of the reversed polynomial.
fn reversed_lag_of(element: &Element) -> f64 {
    let reversed: Vec<f64> = element.denominator.iter().rev().copied().collect();
    (reversed[1] / reversed[0]).abs()
}

/// A polynomial by rising powers of s, such as `16.7 + 1 s`.
fn polynomial<'a>(coefficients: impl Iterator<Item = &'a f64>) -> String {
    let term = |(power, value): (usize, &f64)| match power {
        0 => value.to_string(),
        1 => format!("{value} s"),
        _ => format!("{value} s^{power}"),
    };
    coefficients.enumerate().filter(|(_, value)| **value != 0.0).map(term).collect::<Vec<_>>().join(" + ")
}

//! The drawing of the loop: the tank with its water, the instruments, and the value of every signal at the shown moment.

use leptos::prelude::*;
use quadtank::plant::level::{LevelPlant, LevelSignals, ValvePlace};
use quadtank::study::level_loop::{Element, Objective};

use super::pictures::{output_unit, unit_of};
use super::session::{Session, shown, use_session};
use crate::ghosts::moved_between;
use crate::lab::Lab;
use crate::texts::tr;

/// Left, top, width and height of the tank.
const TANK: (f64, f64, f64, f64) = (56.0, 64.0, 112.0, 190.0);
/// Width of a stream of the largest flow of the open valve at the brim.
const WIDEST_STREAM: f64 = 9.0;
/// Abscissa of the valve.
const VALVE_X: f64 = 236.0;
/// Ordinates of a valve in the inlet and in the outlet.
const VALVE_Y: [f64; 2] = [46.0, 246.0];
/// Ordinate of the line from transmitter to controller and converter.
const LINE_Y: f64 = 134.0;
/// Share of the height from which on a tank counts as full.
const BRIM: f64 = 1.0 - 1e-9;

/// The drawing. Each element is a button that shows its static curve.
#[component]
pub fn LoopDrawing() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let moment = Memo::new(move |_| shown(session));
    let picture = move || {
        moment.get().map(|(_, plant, signals)| {
            let (reference, band) = marks(session, &plant);
            view! { <g aria-hidden="true">{drawing(lab, &plant, &signals, reference, band)}</g> }
        })
    };
    let ghosts = move || {
        let height = session.throttled.setup.with(|setup| setup.plant().tank.height);
        let levels = session.throttled.with_answer(|answer| moved_between(&answer.log.level, height)).flatten()?;
        let (left, top, _, tall) = TANK;
        Some(levels.map(|level| {
            let y = top + tall * (1.0 - (level / height).clamp(0.0, 1.0));
            view! { <path class="ghost" d=format!("M{} {y} h9", left + 3.0) /> }
        }))
    };
    let summary = move || moment.get().map(|(time, plant, signals)| summary(lab, time, &plant, &signals));
    let buttons = Element::ALL.map(|element| view! { <ElementButton element moment=moment.into() /> });
    view! {
        <svg
            class="rig loop"
            viewBox="0 0 440 296"
            role="group"
            aria-label=move || summary().unwrap_or_default()
            data-testid="level-rig"
        >
            {picture}
            <g aria-hidden="true">{ghosts}</g>
            {buttons}
        </svg>
    }
}

/// Time, plant and signals of a moment.
type Moment = (f64, LevelPlant, LevelSignals);

/// Set-point at the shown moment and the band, in m.
fn marks(session: Session, plant: &LevelPlant) -> (Option<f64>, Option<[f64; 2]>) {
    let cursor = session.own.cursor.get().unwrap_or(f64::INFINITY);
    let reference = session.throttled.with_answer(|answer| {
        let until = answer.log.time_s.partition_point(|&time| time <= cursor);
        answer.log.reference.get(until.saturating_sub(1)).map(|&signal| plant.transmitter.level_of(signal))
    });
    let band = session.throttled.setup.with(|setup| match setup.objective {
        Objective::Averaging { band } => Some(band),
        Objective::Tight => None,
    });
    (reference.flatten(), band)
}

/// The drawing in words.
fn summary(lab: Lab, time: f64, plant: &LevelPlant, signals: &LevelSignals) -> String {
    let style = lab.number_style();
    tr!(
        lab,
        level.drawing,
        time = style.fixed(time, 0),
        level = style.fixed(100.0 * signals.level, 1),
        inflow = style.fixed(1000.0 * signals.inflow, 2),
        outflow = style.fixed(1000.0 * signals.outflow, 2),
        output = style.fixed(signals.output, 2),
        unit = output_unit(plant)
    )
}

/// All that is only looked at, from the back to the front.
fn drawing(
    lab: Lab,
    plant: &LevelPlant,
    signals: &LevelSignals,
    reference: Option<f64>,
    band: Option<[f64; 2]>,
) -> impl IntoView + use<> {
    let style = lab.number_style();
    let (left, top, width, height) = TANK;
    let (right, bottom) = (left + width, top + height);
    let y_of = |level: f64| bottom - height * (level / plant.tank.height).clamp(0.0, 1.0);
    let in_outlet = plant.valve.place == ValvePlace::Outlet;
    let valve_y = VALVE_Y[usize::from(in_outlet)];
    let flow = |value: f64| format!("{} L/s", style.fixed(1000.0 * value, 2));
    let largest = plant.flows(plant.tank.height, 1.0).into_iter().fold(f64::MIN_POSITIVE, f64::max);
    let stream = move |value: f64| (WIDEST_STREAM * (value / largest).clamp(0.0, 1.0)).to_string();
    let alarm = if signals.level >= BRIM * plant.tank.height {
        tr!(lab, process.full)
    } else if signals.level <= 0.0 {
        tr!(lab, process.dry)
    } else {
        String::new()
    };
    let band = band
        .map(|band| band.map(|level| view! { <path class="ghost" d=format!("M{left} {} h{width}", y_of(level)) /> }));
    let mark = reference.map(|level| {
        view! { <path class="mark one" d=format!("M{} {} h{}", left - 8.0, y_of(level), width + 16.0) /> }
    });
    let (fed, valve_pipe) = if in_outlet {
        (signals.inflow, format!("M{right} {valve_y} H330"))
    } else {
        (signals.inflow, format!("M330 {valve_y} H138 V64"))
    };
    let surface = y_of(signals.level);
    view! {
        <path class="pipe" d="M12 46 H84 V64" />
        <path class="pipe" d=valve_pipe />
        {(!in_outlet).then(|| view! { <path class="pipe" d=format!("M{right} 246 H330") /> })}
        <path class="flow drain" d=format!("M84 66 V{surface}") stroke-width=stream(fed) />
        {(!in_outlet).then(|| {
            view! { <path class="flow drain" d=format!("M138 66 V{surface}") stroke-width=stream(signals.valve_flow) /> }
        })}
        <path class="flow drain" d="M330 246 V284" stroke-width=stream(signals.outflow) />
        <rect class="water1" x=left y=surface width=width height=bottom - surface stroke-width="0" />
        {band}
        <path class="wall" d=format!("M{left} {top} V{bottom} H{right} V{top}") />
        {mark}
        <text class="value" x=left + width / 2.0 y=bottom - 10.0 text-anchor="middle">
            {format!("{} cm", style.fixed(100.0 * signals.level, 1))}
        </text>
        <text class="alarm" x=left + width / 2.0 y=top + 22.0 text-anchor="middle">{alarm}</text>
        <text class="value" x="12" y="36">{format!("q_in {}", flow(signals.inflow))}</text>
        <text class="value" x="320" y="291" text-anchor="end">{format!("q_out {}", flow(signals.outflow))}</text>
        {(!in_outlet).then(|| view! { <text class="value" x="340" y="50">{flow(signals.valve_flow)}</text> })}
        {signal_lines(plant, valve_y)}
        {instruments(lab, plant, signals, valve_y)}
    }
}

/// The dashed lines from instrument to instrument.
fn signal_lines(plant: &LevelPlant, valve_y: f64) -> impl IntoView + use<> {
    let to_actuator = if plant.converter.is_some() { 384.0 } else { 300.0 };
    let dome = valve_y - 28.0;
    view! {
        <path class="signal" d=format!("M168 {LINE_Y} H194") />
        <path class="signal" d=format!("M222 {LINE_Y} H{}", to_actuator - 16.0) />
        <path class="signal" d=format!("M{to_actuator} {LINE_Y} V{dome} H{}", VALVE_X + 16.0) />
        <path class="signal" d=format!("M{VALVE_X} {} V{}", dome + 8.0, valve_y) />
    }
}

/// Controller, valve body and the values of all signals. The instruments with a curve are buttons and stand on their own.
fn instruments(lab: Lab, plant: &LevelPlant, signals: &LevelSignals, valve_y: f64) -> impl IntoView + use<> {
    let style = lab.number_style();
    let with_unit = |value: f64, unit: &str| format!("{} {unit}", style.fixed(value, 2));
    let pressure = plant.converter.map(|converter| with_unit(signals.pressure, unit_of(converter.output.unit)));
    view! {
        <circle class="instrument" cx="300" cy=LINE_Y r="15" />
        <text class="tag" x="300" y=LINE_Y + 4.0 text-anchor="middle">"LC"</text>
        <text x="304" y=LINE_Y + 30.0 text-anchor="middle">{with_unit(signals.output, output_unit(plant))}</text>
        <text x="214" y=LINE_Y + 30.0 text-anchor="middle">
            {with_unit(signals.measured, unit_of(plant.transmitter.signal.unit))}
        </text>
        <text x="376" y=LINE_Y + 48.0 text-anchor="end">{pressure}</text>
        <text x=VALVE_X + 20.0 y=valve_y - 34.0>{format!("X {}", style.fixed(signals.travel, 3))}</text>
        <text x=VALVE_X y=valve_y + 24.0 text-anchor="middle">{format!("f {}", style.fixed(signals.opening, 3))}</text>
    }
}

/// An element that shows its curve when it is pressed.
#[component]
fn ElementButton(element: Element, moment: Signal<Option<Moment>>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let chosen = session.own.element;
    let is_chosen = move || chosen.get() == Some(element);
    let press = move || chosen.set(if untrack(is_chosen) { None } else { Some(element) });
    let on_key = move |event: leptos::ev::KeyboardEvent| {
        if matches!(event.key().as_str(), "Enter" | " ") {
            event.prevent_default();
            press();
        }
    };
    let shape = move || {
        let (_, plant, _) = moment.get()?;
        let valve_y = VALVE_Y[usize::from(plant.valve.place == ValvePlace::Outlet)];
        shape(element, &plant, valve_y)
    };
    // An element that the loop has not cannot be reached.
    let is_missing = move || moment.with(|moment| moment.as_ref().is_some_and(|m| !has(element, &m.1)));
    let name = move || tr!(lab, level.show_curve, element = name(lab, element));
    view! {
        <g
            class="element"
            role="button"
            tabindex=move || if is_missing() { "-1" } else { "0" }
            hidden=is_missing
            aria-pressed=move || is_chosen().to_string()
            aria-label=name
            data-testid=format!("element-{}", id(element))
            on:click=move |_| press()
            on:keydown=on_key
        >
            <title>{name}</title>
            {shape}
        </g>
    }
}

fn has(element: Element, plant: &LevelPlant) -> bool {
    element != Element::Converter || plant.converter.is_some()
}

/// The short name of an element for tests.
const fn id(element: Element) -> &'static str {
    match element {
        Element::Transmitter => "transmitter",
        Element::Converter => "converter",
        Element::Actuator => "actuator",
        Element::Valve => "valve",
        Element::Outlet => "outlet",
    }
}

/// The name of an element.
pub fn name(lab: Lab, element: Element) -> String {
    match element {
        Element::Transmitter => tr!(lab, level.transmitter),
        Element::Converter => tr!(lab, level.converter),
        Element::Actuator => tr!(lab, level.actuator),
        Element::Valve => tr!(lab, level.valve),
        Element::Outlet => tr!(lab, level.outlet),
    }
}

fn shape(element: Element, plant: &LevelPlant, valve_y: f64) -> Option<AnyView> {
    let (x, y) = (VALVE_X, valve_y);
    let drawing = match element {
        Element::Transmitter => view! {
            <circle class="instrument" cx="208" cy=LINE_Y r="15" />
            <text class="tag" x="208" y=LINE_Y + 4.0 text-anchor="middle">"LT"</text>
        }
        .into_any(),
        Element::Converter => {
            plant.converter?;
            view! {
                <rect class="instrument" x="369" y=LINE_Y - 13.0 width="30" height="26" rx="3" />
                <text class="tag" x="384" y=LINE_Y + 4.0 text-anchor="middle">"I/P"</text>
            }
            .into_any()
        }
        Element::Actuator => {
            let d = format!("M{} {} a16 14 0 0 1 32 0 Z", x - 16.0, y - 20.0);
            view! { <path class="instrument" d=d /> }.into_any()
        }
        Element::Valve => {
            let d = format!("M{} {} v18 l32 -18 v18 Z", x - 16.0, y - 9.0);
            view! { <path class="instrument" d=d /> }.into_any()
        }
        Element::Outlet => view! {
            <circle class="instrument" cx="330" cy="246" r="9" />
            <text class="tag" x="330" y="250" text-anchor="middle">"q"</text>
        }
        .into_any(),
    };
    let (left, top) = area(element, valve_y);
    Some(view! { <rect class="hit" x=left y=top width=AREA height=AREA /> {drawing} }.into_any())
}

/// Side of the area of an element that takes a press: 44 px by touch on the narrowest phone.
const AREA: f64 = 56.0;

/// Left and top of the area of an element. Those of actuator and valve lie against each other.
fn area(element: Element, valve_y: f64) -> (f64, f64) {
    let around = |x: f64, y: f64| (x - AREA / 2.0, y - AREA / 2.0);
    match element {
        Element::Transmitter => around(208.0, LINE_Y),
        Element::Converter => around(384.0, LINE_Y),
        Element::Actuator => (VALVE_X - AREA / 2.0, valve_y - 14.0 - AREA),
        Element::Valve => (VALVE_X - AREA / 2.0, valve_y - 14.0),
        Element::Outlet => around(330.0, 246.0),
    }
}

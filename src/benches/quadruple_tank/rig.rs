//! The drawing of the rig: tanks, pipes, pumps and valves, with the water where it stands and runs.

use crate::ghosts::moved_between;
use crate::lab::Lab;
use leptos::prelude::*;

use super::flags::locks;
use super::marks::ReferenceMark;
use super::moment::{RigState, use_moment};
use super::session::{turn_valves, use_session};
use super::valves::{STEP, on_grid};
use crate::shown::{length_digits, to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Drag, Handle, Nudge};
use quadtank::literature::DisplayUnit;
use quadtank::plant::{Disturbance, QuadrupleTank, Tank};
use quadtank::sim::Trajectory;

/// Width and height of the drawing.
pub const VIEW: (f64, f64) = (276.0, 296.0);
/// Where the tanks stand in the drawing (left, top), tank 1 first.
pub const TANKS: [(f64, f64); 4] = [(62.0, 158.0), (150.0, 158.0), (62.0, 40.0), (150.0, 40.0)];
/// Width and height of a tank.
pub const TANK: (f64, f64) = (64.0, 78.0);
/// Width of a stream that carries the most a pump can deliver.
const WIDEST_STREAM: f64 = 7.0;
/// A trapezoidal tank is drawn with at least this share of its brim at the bottom, so that its level can be read.
const MIN_BOTTOM: f64 = 0.8;
/// The number of the level stands so far above the bottom, and higher by so much of what the far wall leans.
const NUMBER_AT: (f64, f64) = (8.0, 2.8);
const PIPES: [&str; 4] = ["M42 258 V18 H206 V34", "M42 148 H70 V152", "M234 258 V26 H70 V34", "M234 148 H206 V152"];
/// Where the pipes end above the tanks, tank 1 first, with the colour of their pump.
const INLETS: [(f64, f64, &str); 4] =
    [(70.0, 152.0, "stroke1"), (206.0, 152.0, "stroke2"), (70.0, 34.0, "stroke2"), (206.0, 34.0, "stroke1")];
/// The valves, left and right.
const VALVES: [(f64, f64); 2] = [(42.0, 148.0), (234.0, 148.0)];
const VALVE_IDS: [&str; 2] = ["valve1", "valve2"];
/// How far a valve is dragged from shut to open (CSS px).
const VALVE_TRAVEL_PX: f64 = 120.0;

/// The drawing with the state of the shown moment.
#[component]
pub fn Rig() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let moment = use_moment();
    let drawing = move || {
        let plant = session.throttled.setup.with(|s| s.plant());
        drawing(lab, &plant, session.own.unit.get(), moment.get().as_ref())
    };
    let svg = NodeRef::new();
    let ghosts = move || {
        let heights = session.throttled.setup.with(|s| s.plant().tanks.map(|tank| tank.height));
        session.throttled.run.with(|run| run.as_ref().as_ref().ok().map(|run| ghosts(&run.nonlinear, heights)))
    };
    let summary = move || moment.get().map(|moment| summary(lab, &moment, session.own.unit.get()));
    view! {
        <svg
            class="rig"
            viewBox=format!("0 0 {} {}", VIEW.0, VIEW.1)
            role="group"
            node_ref=svg
            aria-label=move || summary().unwrap_or_default()
            data-testid="rig"
        >
            <g aria-hidden="true">{drawing}</g>
            <g aria-hidden="true">{ghosts}</g>
            <ReferenceMark level=0 drawing=svg />
            <ReferenceMark level=1 drawing=svg />
            <Valve index=0 />
            <Valve index=1 />
        </svg>
    }
}

/// The drawing in words.
pub fn summary(lab: Lab, moment: &RigState, unit: DisplayUnit) -> String {
    let style = lab.number_style();
    let [h1, h2, h3, h4] = moment.levels.map(|level| style.fixed(to_shown(level, unit), length_digits(unit)));
    let [v1, v2] = moment.pump_voltage.map(|voltage| style.fixed(voltage, 2));
    tr!(lab, process.drawing, h1 = h1, h2 = h2, h3 = h3, h4 = h4, unit = unit_name(unit), v1 = v1, v2 = v2)
}

/// All that is only looked at, from the back to the front; without a moment nothing runs and the tanks are dry.
///
/// One view of the whole moment rather than a signal for each of its sixty attributes: all of them change together, and Leptos
/// touches only those that do.
pub fn drawing(lab: Lab, plant: &QuadrupleTank, unit: DisplayUnit, moment: Option<&RigState>) -> impl IntoView + use<> {
    let levels = moment.map_or([0.0; 4], |m| m.levels);
    view! {
        {PIPES.map(|d| view! { <path class="pipe" d=d /> })}
        {moment.map(|moment| streams(plant, moment))}
        {[0, 1, 2, 3].map(|k| tank(lab, k, &plant.tanks[k], levels[k], unit))}
        <rect class="basin" x="24" y="262" width="228" height="30" rx="3" />
        {[0, 1].map(|k| pump(lab, k, moment.map(|m| m.pump_voltage[k])))}
        <path class="one" d="M36 140 h12 l-6 8 l6 8 h-12 l6 -8 Z" />
        <path class="two" d="M228 140 h12 l-6 8 l6 8 h-12 l6 -8 Z" />
        {[0, 1].map(|k| valve_texts(lab, k, plant.valves[k]))}
    }
}

/// One tank: walls, water, name, level, and a word where it overflows or is dry.
fn tank(lab: Lab, index: usize, tank: &Tank, level: f64, unit: DisplayUnit) -> impl IntoView + use<> {
    let (left, top) = TANKS[index];
    let dryness = 1.0 - share(tank, level);
    // How far the far wall leans outwards over the height of the tank, for a trapezoidal tank.
    let lean = TANK.0 * (1.0 - (tank.section.area(0.0) / tank.section.area(tank.height)).clamp(MIN_BOTTOM, 1.0));
    let (right, bottom, foot) = (left + TANK.0, top + TANK.1, left + TANK.0 - lean);
    let (surface, brim) = (top + TANK.1 * dryness, right - lean * dryness);
    // Where the tank is narrow below, its number stands higher.
    let above_bottom = NUMBER_AT.0 + NUMBER_AT.1 * lean;
    let middle = left + TANK.0 / 2.0;
    let number_at = middle - lean / 2.0 * (1.0 - above_bottom / TANK.1);
    let number = lab.number_style().fixed(to_shown(level, unit), length_digits(unit));
    let alarm = if share(tank, level) >= BRIM {
        tr!(lab, process.full)
    } else if level <= 0.0 {
        tr!(lab, process.dry)
    } else {
        String::new()
    };
    let wall = if alarm.is_empty() { "wall" } else { "wall alarmed" };
    let colour = if index == 0 || index == 3 { "water1" } else { "water2" };
    view! {
        <path class=colour d=format!("M{left} {surface} V{bottom} H{foot} L{brim} {surface} Z") stroke-width="0" />
        <path class=wall d=format!("M{left} {top} V{bottom} H{foot} L{right} {top}") />
        <path class="scale" d=scale(tank.height, unit, (right, top)) />
        <text class="name" x=middle y=top + 12.0 text-anchor="middle">{tr!(lab, process.tank, number = index + 1)}</text>
        <text class="value" x=number_at y=bottom - above_bottom text-anchor="middle" data-testid=format!("rig-level-{}", index + 1)>
            {format!("{number} {}", unit_name(unit))}
        </text>
        <text class="alarm" x=middle y=top + 26.0 text-anchor="middle">{alarm}</text>
    }
}

/// Small ticks at the least and the highest level of each tank in a run, where it moves enough to tell them apart; walls in m.
pub fn ghosts(run: &Trajectory, heights: [f64; 4]) -> impl IntoView + use<> {
    let mark = |k: usize, level: f64| {
        let (x, y) = (TANKS[k].0 + 3.0, TANKS[k].1 + TANK.1 * (1.0 - (level / heights[k]).clamp(0.0, 1.0)));
        view! { <path class="ghost" d=format!("M{x} {y} h7") /> }
    };
    let marks =
        (0..4).filter_map(move |k| Some(moved_between(&run.levels[k], heights[k])?.map(|level| mark(k, level))));
    marks.collect_view()
}

/// The scale on the far wall of a tank, in whole steps of 1, 2 or 5 times a power of ten of the shown unit.
fn scale(height: f64, unit: DisplayUnit, (right, top): (f64, f64)) -> String {
    let shown = to_shown(height, unit);
    let power = 10_f64.powf((shown / MAX_TICKS).log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|step| shown / step <= MAX_TICKS);
    let step = step.unwrap_or(shown);
    let ticks = (1..).map(|k| f64::from(k) * step).take_while(|at| *at < shown * BRIM);
    let tick = |at| format!("M{right} {} h-4", top + TANK.1 * (1.0 - at / shown));
    ticks.map(tick).collect::<Vec<_>>().join(" ")
}

/// Most ticks on a wall.
const MAX_TICKS: f64 = 10.0;

/// Share of the height from which a tank is full: a level at the wall is the square of a root, a rounding below it.
const BRIM: f64 = 1.0 - 1e-9;

fn share(tank: &Tank, level: f64) -> f64 {
    (level / tank.height).clamp(0.0, 1.0)
}

/// How far from the left wall of its tank water from outside falls.
const OUTSIDE_AT: f64 = 8.0;

/// The water that runs: into each tank from its pump and from outside, and out of each tank.
fn streams(plant: &QuadrupleTank, moment: &RigState) -> impl IntoView + use<> {
    let most = plant.pumps.iter().map(|pump| pump.flow(pump.voltage_max)).fold(f64::MIN_POSITIVE, f64::max);
    let inflow = plant.valve_flows(&moment.pump_voltage, &Disturbance::default());
    let outside = plant.flows_from_outside(&Disturbance::default());
    let outflow = plant.outflows(&moment.levels);
    let stream = |class: &str, x: f64, (from, to): (f64, f64), flow: f64| {
        let width = format!("{:.2}", (flow / most).clamp(0.0, 1.5).sqrt() * WIDEST_STREAM);
        view! { <line class=format!("flow {class}") x1=x y1=from x2=x y2=to stroke-width=width /> }
    };
    let surface = |k: usize| TANKS[k].1 + TANK.1 * (1.0 - share(&plant.tanks[k], moment.levels[k]));
    let falling = INLETS.into_iter().enumerate().map(|(k, (x, y, class))| stream(class, x, (y, surface(k)), inflow[k]));
    let drains = TANKS.into_iter().enumerate().map(|(k, (left, top))| {
        // The upper tanks pour into the lower ones; the lower ones into the basin.
        let below = if k < 2 { 268.0 } else { surface(k - 2) };
        stream("drain", left + TANK.0 / 2.0, (top + TANK.1 + 1.0, below), outflow[k])
    });
    let from_outside = TANKS.into_iter().enumerate().filter(|&(k, _)| outside[k] > 0.0).map(|(k, (left, top))| {
        // At the wall that no pipe of a pump comes to.
        stream("drain", left + OUTSIDE_AT, (top - 8.0, surface(k)), outside[k])
    });
    falling.chain(drains).chain(from_outside).collect_view()
}

fn pump(lab: Lab, index: usize, voltage: Option<f64>) -> impl IntoView {
    let (x, colour, anchor, at) = if index == 0 { (42, "one", "start", 60) } else { (234, "two", "end", 216) };
    let (left, right) = (x - 6, x + 6);
    let voltage =
        voltage.map_or_else(String::new, |v| format!("v{} {} V", ["₁", "₂"][index], lab.number_style().fixed(v, 2)));
    view! {
        <circle class="pump" cx=x cy="258" r="11" />
        <path class=colour d=format!("M{left} 262 L{x} 251 L{right} 262 Z") />
        <text class="value" x=at y="282" text-anchor=anchor data-testid=format!("rig-voltage-{}", index + 1)>{voltage}</text>
    }
}

/// Name and setting beside a valve. A text in a drawing is dear to lay out: it comes with the words.
fn valve_texts(lab: Lab, index: usize, gamma: f64) -> impl IntoView {
    let (anchor, x) = if index == 0 { ("end", 33) } else { ("start", 243) };
    let y = VALVES[index].1;
    view! {
        <text class="value" x=x y=y - 2.0 text-anchor=anchor>{["γ₁", "γ₂"][index]}</text>
        <text class="value" x=x y=y + 10.0 text-anchor=anchor>{lab.number_style().fixed(gamma, 2)}</text>
    }
}

/// A valve, which is opened and closed by dragging it up and down.
#[component]
fn Valve(index: usize) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let gamma = session.part(move |s| s.valves[index]);
    let set = move |gamma: f64| {
        let mut valves = session.document.with_untracked(|document| document.setup.valves);
        valves[index] = on_grid(gamma);
        turn_valves(session, valves);
    };
    let grabbed = StoredValue::new(0.0);
    view! {
        <Handle
            id=VALVE_IDS[index]
            label=say!(lab, process.valve, pump = index + 1)
            value=gamma
            limits=(0.0, 1.0)
            spoken=Signal::derive(move || lab.number_style().fixed(gamma.get(), 2))
            locked=lab.locks(locks::VALVES)
            on_grab=move |()| grabbed.set_value(gamma.get_untracked())
            on_drag=move |drag: Drag| set(grabbed.get_value() - drag.moved.1 / VALVE_TRAVEL_PX)
            on_nudge=move |by: Nudge| set(gamma.get_untracked() + STEP * by.along())
            at=VALVES[index]
        >
            <circle class="halo" r="13" />
        </Handle>
    }
}

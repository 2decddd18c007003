//! The drawing of the rig: tanks, pipes, pumps and valves, with the water where it stands and runs.

use leptos::prelude::*;

use super::moment::{Moment, use_moment};
use super::valves::{STEP, on_grid};
use crate::app::lab::use_lab;
use crate::app::shown::{length_digits, to_shown, unit_name};
use crate::app::start::Control;
use crate::app::texts::{say, tr};
use crate::app::widgets::{Drag, Handle, Nudge};
use crate::plant::{Disturbance, QuadrupleTank, Tank};

/// Where the tanks stand in the drawing (left, top), tank 1 first.
const TANKS: [(f64, f64); 4] = [(62.0, 158.0), (150.0, 158.0), (62.0, 40.0), (150.0, 40.0)];
const TANK: (f64, f64) = (64.0, 78.0);
/// Width of a stream that carries the most a pump can deliver.
const WIDEST_STREAM: f64 = 7.0;
/// A trapezoidal tank is drawn with at least this share of its brim at the bottom, so that its level can be read.
const LEAST_BOTTOM: f64 = 0.8;
/// The number of the level stands so far above the bottom, and higher by so much of what the far wall leans.
const NUMBER_AT: (f64, f64) = (8.0, 2.8);
/// The valves, left and right.
const VALVES: [(f64, f64); 2] = [(42.0, 148.0), (234.0, 148.0)];
const VALVE_IDS: [&str; 2] = ["valve1", "valve2"];
/// How far a valve is dragged from shut to open (CSS px).
const VALVE_TRAVEL_PX: f64 = 120.0;

/// The drawing with the state of the shown moment.
#[component]
pub fn Rig() -> impl IntoView {
    let lab = use_lab();
    let moment = use_moment();
    let summary = Signal::derive(move || {
        let unit = lab.unit.get();
        let number = |v: f64| lab.number_style().fixed(to_shown(v, unit), length_digits(unit));
        moment
            .get()
            .map(|m| {
                let v = |k: usize| lab.number_style().fixed(m.pump_voltage[k], 2);
                tr!(
                    lab,
                    process.drawing,
                    h1 = number(m.levels[0]),
                    h2 = number(m.levels[1]),
                    h3 = number(m.levels[2]),
                    h4 = number(m.levels[3]),
                    unit = unit_name(unit),
                    v1 = v(0),
                    v2 = v(1)
                )
                .to_string()
            })
            .unwrap_or_default()
    });
    view! {
        <svg class="rig" viewBox="0 0 276 296" role="group" aria-label=summary data-testid="rig">
            <g aria-hidden="true">
                <Pipes />
                {(0..4).map(|tank| view! { <TankView tank /> }).collect_view()}
                {move || moment.get().map(|m| streams(&lab.words.setup.with(|s| s.plant()), &m))}
                <rect class="basin" x="24" y="262" width="228" height="30" rx="3" />
                {(0..2).map(|pump| view! { <PumpView pump /> }).collect_view()}
            </g>
            {(0..2).map(|valve| view! { <ValveView valve /> }).collect_view()}
        </svg>
    }
}

#[component]
fn Pipes() -> impl IntoView {
    view! {
        <path class="pipe" d="M42 258 V18 H206 V34" />
        <path class="pipe" d="M42 148 H70 V152" />
        <path class="pipe" d="M234 258 V26 H70 V34" />
        <path class="pipe" d="M234 148 H206 V152" />
    }
}

/// One tank: walls, water, name, level, and a word where it overflows or is dry.
#[component]
fn TankView(tank: usize) -> impl IntoView {
    let lab = use_lab();
    let moment = use_moment();
    let (left, top) = TANKS[tank];
    let level = move || moment.get().map_or(0.0, |m| m.levels[tank]);
    let height = lab.part(move |s| s.plant().tanks[tank].height);
    let share = move || (level() / height.get()).clamp(0.0, 1.0);
    // How far the far wall leans outwards over the height of the tank, for a trapezoidal tank.
    let lean = lab.part(move |s| {
        let Tank { section, height, .. } = s.plant().tanks[tank];
        TANK.0 * (1.0 - (section.area(0.0) / section.area(height)).clamp(LEAST_BOTTOM, 1.0))
    });
    let walls =
        move || format!("M{left} {top} V{} H{} L{} {top}", top + TANK.1, left + TANK.0 - lean.get(), left + TANK.0);
    let water = move || {
        let surface = top + TANK.1 * (1.0 - share());
        let brim = left + TANK.0 - lean.get() * (1.0 - share());
        format!("M{left} {surface} V{} H{} L{brim} {surface} Z", top + TANK.1, left + TANK.0 - lean.get())
    };
    let shown = move || {
        let unit = lab.unit.get();
        let number = lab.number_style().fixed(to_shown(level(), unit), length_digits(unit));
        format!("{number} {}", unit_name(unit))
    };
    let alarm = move || {
        let (level, height) = (level(), height.get());
        if level >= height {
            Some(tr!(lab, process.full).to_string())
        } else if level <= 0.0 {
            Some(tr!(lab, process.dry).to_string())
        } else {
            None
        }
    };
    let middle = left + TANK.0 / 2.0;
    // Where the tank is narrow below, its number stands higher.
    let number_at = move || {
        let above_bottom = NUMBER_AT.0 + NUMBER_AT.1 * lean.get();
        (middle - lean.get() / 2.0 * (1.0 - above_bottom / TANK.1), top + TANK.1 - above_bottom)
    };
    let colour = if tank == 0 || tank == 3 { "water1" } else { "water2" };
    view! {
        <path class=colour d=water stroke-width="0" />
        <path class="wall" d=walls />
        <text class="name" x=middle y=top + 12.0 text-anchor="middle">{say!(lab, process.tank, number = tank + 1)}</text>
        <text class="value" x=move || number_at().0 y=move || number_at().1 text-anchor="middle" data-testid=format!("rig-level-{}", tank + 1)>
            {shown}
        </text>
        <text class="alarm" x=middle y=top + 26.0 text-anchor="middle">{alarm}</text>
    }
}

/// The water that runs: into each tank from its pump, and out of each tank.
fn streams(plant: &QuadrupleTank, moment: &Moment) -> impl IntoView + use<> {
    let most = plant.pumps.iter().map(|p| p.gain * p.voltage_max).fold(f64::MIN_POSITIVE, f64::max);
    let inflow = plant.valve_flows(&moment.pump_voltage, &Disturbance::default());
    let outflow = plant.outflows(&moment.levels);
    let width = move |flow: f64| format!("{:.2}", (flow / most).clamp(0.0, 1.5).sqrt() * WIDEST_STREAM);
    let inlets = [(70.0, 152.0, 1), (206.0, 152.0, 2), (70.0, 34.0, 2), (206.0, 34.0, 1)];
    let falling = inlets.into_iter().zip(inflow).zip(TANKS).zip(moment.levels).zip(plant.tanks).map(
        move |((((inlet, flow), (_, top)), level), tank)| {
            let (x, y, pump) = inlet;
            let surface = top + TANK.1 * (1.0 - (level / tank.height).clamp(0.0, 1.0));
            let class = format!("flow stroke{pump}");
            view! { <line class=class x1=x y1=y x2=x y2=surface stroke-width=width(flow) /> }
        },
    );
    let drains = TANKS.into_iter().zip(outflow).enumerate().map(move |(tank, ((left, top), flow))| {
        // The upper tanks pour into the lower ones; the lower ones into the basin.
        let below = if tank < 2 { 268.0 } else { TANKS[tank - 2].1 + 14.0 };
        let x = left + TANK.0 / 2.0;
        view! { <line class="flow drain" x1=x y1=top + TANK.1 + 1.0 x2=x y2=below stroke-width=width(flow) /> }
    });
    (falling.collect_view(), drains.collect_view())
}

#[component]
fn PumpView(pump: usize) -> impl IntoView {
    let lab = use_lab();
    let moment = use_moment();
    let (x, colour, anchor, at) = if pump == 0 { (42.0, "one", "start", 60.0) } else { (234.0, "two", "end", 216.0) };
    let voltage = move || {
        moment.get().map(|m| format!("v{} {} V", ["₁", "₂"][pump], lab.number_style().fixed(m.pump_voltage[pump], 2)))
    };
    view! {
        <circle class="pump" cx=x cy="258" r="11" />
        <path class=colour d=format!("M{} 262 L{x} 251 L{} 262 Z", x - 6.0, x + 6.0) />
        <text class="value" x=at y="282" text-anchor=anchor data-testid=format!("rig-voltage-{}", pump + 1)>{voltage}</text>
    }
}

/// A valve, which is opened and closed by dragging it up and down.
#[component]
fn ValveView(valve: usize) -> impl IntoView {
    let lab = use_lab();
    let gamma = lab.part(move |s| s.valves[valve]);
    let set = move |gamma: f64| lab.edit(|s| s.valves[valve] = on_grid(gamma));
    let grabbed = StoredValue::new(0.0);
    let (x, y) = VALVES[valve];
    let (colour, anchor, at) = if valve == 0 { ("one", "end", 33.0) } else { ("two", "start", 243.0) };
    let number = move |gamma: f64| lab.number_style().fixed(gamma, 2);
    // A text in a drawing is dear to lay out: it comes with the words.
    let shown = move || number(lab.words.setup.with(|s| s.valves[valve]));
    view! {
        <Handle
            id=VALVE_IDS[valve]
            label=say!(lab, process.valve, pump = valve + 1)
            value=gamma
            limits=(0.0, 1.0)
            spoken=Signal::derive(move || number(gamma.get()))
            locked=lab.locks(Control::Valves)
            on_grab=move |()| grabbed.set_value(gamma.get_untracked())
            on_drag=move |drag: Drag| set(grabbed.get_value() - drag.moved.1 / VALVE_TRAVEL_PX)
            on_nudge=move |by: Nudge| set(gamma.get_untracked() + STEP * by.along())
        >
            <circle class="halo" cx=x cy=y r="13" />
            <path class=colour d=format!("M{} {} H{} L{x} {y} L{} {} H{} L{x} {y} Z", x - 6.0, y - 8.0, x + 6.0, x - 6.0, y + 8.0, x + 6.0) />
        </Handle>
        <text class="value" x=at y=y - 2.0 text-anchor=anchor aria-hidden="true">{format!("γ{}", ["₁", "₂"][valve])}</text>
        <text class="value" x=at y=y + 10.0 text-anchor=anchor aria-hidden="true">{shown}</text>
    }
}

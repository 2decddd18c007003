//! The drawing of the rig: tanks, pipes, pumps and valves, with the water where it stands and runs.

use leptos::prelude::*;

use super::moment::{Moment, use_moment};
use super::valves::{STEP, on_grid};
use crate::lab::Lab;
use crate::shown::{length_digits, to_shown, unit_name};
use crate::start::Control;
use crate::texts::{say, tr};
use crate::widgets::html::{element, escape};
use crate::widgets::{Drag, Handle, Nudge};
use quadtank::plant::{DisplayUnit, Disturbance, QuadrupleTank, Tank};

/// Where the tanks stand in the drawing (left, top), tank 1 first.
const TANKS: [(f64, f64); 4] = [(62.0, 158.0), (150.0, 158.0), (62.0, 40.0), (150.0, 40.0)];
const TANK: (f64, f64) = (64.0, 78.0);
/// Width of a stream that carries the most a pump can deliver.
const WIDEST_STREAM: f64 = 7.0;
/// A trapezoidal tank is drawn with at least this share of its brim at the bottom, so that its level can be read.
const LEAST_BOTTOM: f64 = 0.8;
/// The number of the level stands so far above the bottom, and higher by so much of what the far wall leans.
const NUMBER_AT: (f64, f64) = (8.0, 2.8);
const PIPES: &str = "<path class=\"pipe\" d=\"M42 258 V18 H206 V34\"/><path class=\"pipe\" d=\"M42 148 H70 V152\"/>\
    <path class=\"pipe\" d=\"M234 258 V26 H70 V34\"/><path class=\"pipe\" d=\"M234 148 H206 V152\"/>";
const BASIN: &str = "<rect class=\"basin\" x=\"24\" y=\"262\" width=\"228\" height=\"30\" rx=\"3\"/>";
/// Where the pipes end above the tanks, tank 1 first, with the colour of their pump.
const INLETS: [(f64, f64, &str); 4] =
    [(70.0, 152.0, "stroke1"), (206.0, 152.0, "stroke2"), (70.0, 34.0, "stroke2"), (206.0, 34.0, "stroke1")];
/// The valves, left and right.
const VALVES: [(f64, f64); 2] = [(42.0, 148.0), (234.0, 148.0)];
const HALO: &str = "<circle class=\"halo\" r=\"13\"/>";
const VALVE_SYMBOLS: &str = "<path class=\"one\" d=\"M36 140 h12 l-6 8 l6 8 h-12 l6 -8 Z\"/>\
    <path class=\"two\" d=\"M228 140 h12 l-6 8 l6 8 h-12 l6 -8 Z\"/>";
const VALVE_IDS: [&str; 2] = ["valve1", "valve2"];
/// How far a valve is dragged from shut to open (CSS px).
const VALVE_TRAVEL_PX: f64 = 120.0;

/// The drawing with the state of the shown moment.
pub fn rig(lab: Lab) -> AnyView {
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
    let drawing = Signal::derive(move || {
        let plant = lab.words.setup.with(|s| s.plant());
        drawing(lab, &plant, lab.unit.get(), moment.get().as_ref())
    });
    view! {
        <svg class="rig" viewBox="0 0 276 296" role="group" aria-label=summary data-testid="rig">
            <g aria-hidden="true" inner_html=drawing></g>
            {valve_view(lab, 0)}
            {valve_view(lab, 1)}
        </svg>
    }
    .into_any()
}

/// All that is only looked at, from the back to the front; without a moment nothing runs and the tanks are dry.
pub fn drawing(lab: Lab, plant: &QuadrupleTank, unit: DisplayUnit, moment: Option<&Moment>) -> String {
    let levels = moment.map_or([0.0; 4], |m| m.levels);
    let tanks: String = (0..4).map(|k| tank(lab, k, &plant.tanks[k], (levels[k], unit))).collect();
    let streams = moment.map_or_else(String::new, |m| streams(plant, m));
    let pumps: String = (0..2).map(|k| pump(lab, k, moment.map(|m| m.pump_voltage[k]))).collect();
    let valves: String = (0..2).map(|k| valve_texts(lab, k, plant.valves[k])).collect();
    format!("{PIPES}{streams}{tanks}{BASIN}{pumps}{VALVE_SYMBOLS}{valves}")
}

/// One tank: walls, water, name, level, and a word where it overflows or is dry.
fn tank(lab: Lab, index: usize, tank: &Tank, (level, unit): (f64, DisplayUnit)) -> String {
    let (left, top) = TANKS[index];
    let dryness = 1.0 - share(tank, level);
    // How far the far wall leans outwards over the height of the tank, for a trapezoidal tank.
    let lean = TANK.0 * (1.0 - (tank.section.area(0.0) / tank.section.area(tank.height)).clamp(LEAST_BOTTOM, 1.0));
    let (right, bottom, foot) = (left + TANK.0, top + TANK.1, left + TANK.0 - lean);
    let (surface, brim) = (top + TANK.1 * dryness, right - lean * dryness);
    // Where the tank is narrow below, its number stands higher.
    let above_bottom = NUMBER_AT.0 + NUMBER_AT.1 * lean;
    let (middle, below) = (left + TANK.0 / 2.0, bottom - above_bottom);
    let number_at = middle - lean / 2.0 * (1.0 - above_bottom / TANK.1);
    let number = lab.number_style().fixed(to_shown(level, unit), length_digits(unit));
    let alarm = if share(tank, level) >= BRIM {
        tr!(lab, process.full)
    } else if level <= 0.0 {
        tr!(lab, process.dry)
    } else {
        ""
    };
    let colour = if index == 0 || index == 3 { "water1" } else { "water2" };
    let text = |attributes: &str, (x, y): (f64, f64), words: &str| {
        let place = format!("x=\"{x}\" y=\"{y}\" text-anchor=\"middle\" {attributes}");
        element("text", &place, &escape(words))
    };
    let name = text("class=\"name\"", (middle, top + 12.0), &tr!(lab, process.tank, number = index + 1));
    let value = format!("class=\"value\" data-testid=\"rig-level-{}\"", index + 1);
    let value = text(&value, (number_at, below), &format!("{number} {}", unit_name(unit)));
    let alarm = text("class=\"alarm\"", (middle, top + 26.0), alarm);
    format!(
        "<path class=\"{colour}\" d=\"M{left} {surface} V{bottom} H{foot} L{brim} {surface} Z\" stroke-width=\"0\"/>\
         <path class=\"wall\" d=\"M{left} {top} V{bottom} H{foot} L{right} {top}\"/>{name}{value}{alarm}"
    )
}

/// Share of the height from which a tank is full: a level at the wall is the square of a root, a rounding below it.
const BRIM: f64 = 1.0 - 1e-9;

fn share(tank: &Tank, level: f64) -> f64 {
    (level / tank.height).clamp(0.0, 1.0)
}

/// The water that runs: into each tank from its pump, and out of each tank.
fn streams(plant: &QuadrupleTank, moment: &Moment) -> String {
    let most = plant.pumps.iter().map(|p| p.gain * p.voltage_max).fold(f64::MIN_POSITIVE, f64::max);
    let inflow = plant.valve_flows(&moment.pump_voltage, &Disturbance::default());
    let outflow = plant.outflows(&moment.levels);
    let stream = |class: &str, x: f64, (from, to): (f64, f64), flow: f64| {
        let width = (flow / most).clamp(0.0, 1.5).sqrt() * WIDEST_STREAM;
        format!(
            "<line class=\"flow {class}\" x1=\"{x}\" y1=\"{from}\" x2=\"{x}\" y2=\"{to}\" stroke-width=\"{width:.2}\"/>"
        )
    };
    let surface = |k: usize| TANKS[k].1 + TANK.1 * (1.0 - share(&plant.tanks[k], moment.levels[k]));
    let falling = INLETS.into_iter().enumerate().map(|(k, (x, y, class))| stream(class, x, (y, surface(k)), inflow[k]));
    let drains = TANKS.into_iter().enumerate().map(|(k, (left, top))| {
        // The upper tanks pour into the lower ones; the lower ones into the basin.
        let below = if k < 2 { 268.0 } else { surface(k - 2) };
        stream("drain", left + TANK.0 / 2.0, (top + TANK.1 + 1.0, below), outflow[k])
    });
    falling.chain(drains).collect()
}

fn pump(lab: Lab, index: usize, voltage: Option<f64>) -> String {
    let (x, colour, anchor, at) = if index == 0 { (42, "one", "start", 60) } else { (234, "two", "end", 216) };
    let (left, right) = (x - 6, x + 6);
    let number = index + 1;
    let voltage =
        voltage.map_or_else(String::new, |v| format!("v{} {} V", ["₁", "₂"][index], lab.number_style().fixed(v, 2)));
    format!(
        "<circle class=\"pump\" cx=\"{x}\" cy=\"258\" r=\"11\"/>\
         <path class=\"{colour}\" d=\"M{left} 262 L{x} 251 L{right} 262 Z\"/>\
         <text class=\"value\" x=\"{at}\" y=\"282\" text-anchor=\"{anchor}\" data-testid=\"rig-voltage-{number}\">{voltage}</text>"
    )
}

/// Name and setting beside a valve. A text in a drawing is dear to lay out: it comes with the words.
fn valve_texts(lab: Lab, index: usize, gamma: f64) -> String {
    let (anchor, x) = if index == 0 { ("end", 33) } else { ("start", 243) };
    let text = |y: f64, words: &str| {
        format!("<text class=\"value\" x=\"{x}\" y=\"{y}\" text-anchor=\"{anchor}\">{words}</text>")
    };
    let setting = lab.number_style().fixed(gamma, 2);
    let y = VALVES[index].1;
    text(y - 2.0, ["γ₁", "γ₂"][index]) + &text(y + 10.0, &setting)
}

/// A valve, which is opened and closed by dragging it up and down.
fn valve_view(lab: Lab, valve: usize) -> AnyView {
    let gamma = lab.part(move |s| s.valves[valve]);
    let set = move |gamma: f64| lab.edit(|s| s.valves[valve] = on_grid(gamma));
    let grabbed = StoredValue::new(0.0);
    let number = move |gamma: f64| lab.number_style().fixed(gamma, 2);
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
            at=VALVES[valve]
            look=HALO
        />
    }
    .into_any()
}

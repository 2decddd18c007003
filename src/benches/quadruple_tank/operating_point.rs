//! What the levels and voltages are around which theory is asked, and what was printed of them.

use leptos::prelude::*;
use quadtank::literature::PresetId;
use quadtank::plant::OperatingPoint;
use quadtank::study::quadruple_tank::{OperatingPointSpec, Setup};
use quadtank_scenario::Limits;

use super::flags::locks;
use super::four_levels::{FourLevels, LEVEL};
use super::preset::{PresetRemark, chosen};
use super::published::PublishedFigures;
use super::rig_numbers::RigNumbers;
use super::session::use_session;
use super::valves::HoldSwitch;
use crate::controls::ParamControl;
use crate::depth::Depth;
use crate::texts::{say, tr};
use crate::widgets::{Choice, NumberField, Scale, Select, is_open};

const VOLTAGE_IDS: [&str; 2] = ["voltage1", "voltage2"];

const LOWER: ParamControl<Setup> = ParamControl {
    ids: [("", "state-level1"), ("", "state-level2")],
    name: |lab, k| tr!(lab, process.state_level, number = k + 1),
    read: |s, k| state_level(s, k),
    write: |s, k, level| set_state_level(s, k, level),
    within: |s, k| Limits::new(0.0, s.plant().tanks[k].height),
    ..STATE
};
const UPPER: ParamControl<Setup> = ParamControl {
    ids: [("", "state-level3"), ("", "state-level4")],
    name: |lab, k| tr!(lab, process.state_level, number = k + 3),
    read: |s, k| state_level(s, k + 2),
    write: |s, k, level| set_state_level(s, k + 2, level),
    within: |s, k| Limits::new(0.0, s.plant().tanks[k + 2].height),
    ..STATE
};
const STATE: ParamControl<Setup> =
    ParamControl { path: |_, _| "operating_point.state.levels[]", lock: locks::VOLTAGES, ..LEVEL };

fn state_level(setup: &Setup, tank: usize) -> f64 {
    match setup.operating_point {
        OperatingPointSpec::State(state) => state.levels[tank],
        _ => 0.0,
    }
}

fn set_state_level(setup: &mut Setup, tank: usize, level: f64) {
    if let OperatingPointSpec::State(state) = &mut setup.operating_point {
        state.levels[tank] = level;
    }
}

/// The operating point and what was printed of it, folded.
#[component]
pub fn OperatingPointFold() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let is_state = session.part(is_state);
    // Explore has the switch on its map, and a state of one's own stays whatever the valves do.
    let has_switch = move || !lab.locks(locks::VALVES) && lab.shown_depth() != Depth::Explore && !is_state.get();
    let open = RwSignal::new(false);
    view! {
        <details class="more" data-testid="operating-point-fold" on:toggle=move |event| open.set(is_open(&event))>
            <summary>{say!(lab, process.operating_point)}</summary>
            <PresetRemark />
            <div class="fields">
                <VoltageField pump=0 />
                <VoltageField pump=1 />
            </div>
            <StateControls />
            {move || has_switch().then(|| view! { <HoldSwitch /> })}
            {move || open.get().then(|| view! { <PublishedFigures /> })}
            <RigNumbers />
        </details>
    }
}

fn is_state(setup: &Setup) -> bool {
    matches!(setup.operating_point, OperatingPointSpec::State(_))
}

/// Where the rig stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Standing {
    /// At the rest that follows.
    Rest,
    /// At the levels that the source of its rig prints.
    Printed,
    /// At other levels.
    Own,
}

/// The levels and voltages that the source of the rig prints, which are seldom exactly at rest.
fn printed(rig: Option<PresetId>) -> Option<OperatingPoint> {
    let preset = rig?.preset();
    Some(OperatingPoint { levels: preset.printed?.levels, pump_voltage: preset.pump_voltage })
}

/// At rest, or at levels that are given.
#[component]
fn StateControls() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let rig = chosen(session);
    let is_given = session.part(is_state);
    let standing = {
        let point = session.part(|s| s.operating_point);
        Signal::derive(move || match point.get() {
            OperatingPointSpec::State(state) if printed(rig.get()) == Some(state) => Standing::Printed,
            OperatingPointSpec::State(_) => Standing::Own,
            _ => Standing::Rest,
        })
    };
    let choose = move |standing: Standing| {
        let printed = printed(untrack(|| rig.get()));
        session.edit(|s| {
            let Ok(present) = s.operating_point() else { return };
            s.operating_point = match standing {
                Standing::Rest => OperatingPointSpec::PumpVoltage(present.pump_voltage),
                Standing::Printed => OperatingPointSpec::State(printed.unwrap_or(present)),
                Standing::Own => OperatingPointSpec::State(present),
            };
        });
    };
    let choices = Signal::derive(move || {
        let choice = |standing, value, text| Choice::new(standing, value, text);
        let printed =
            printed(rig.get()).map(|_| choice(Standing::Printed, "printed", tr!(lab, process.standing_printed)));
        std::iter::once(choice(Standing::Rest, "rest", tr!(lab, process.standing_rest)))
            .chain(printed)
            .chain([choice(Standing::Own, "own", tr!(lab, process.standing_own))])
            .collect::<Vec<_>>()
    });
    let fields = move || view! { <FourLevels controls=[&LOWER, &UPPER] name=say!(lab, process.standing) /> };
    view! {
        <div class="row load">
            <label for="standing">{say!(lab, process.standing)}</label>
            <Select id="standing" labelled="standing" choices chosen=standing on_choose=choose disabled=lab.locks(locks::VOLTAGES) />
        </div>
        {move || is_given.get().then(fields)}
    }
}

/// The voltage of a pump at the operating point. Editing it makes the voltages, not the levels, what a rest is given by.
#[component]
fn VoltageField(pump: usize) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let computed =
        move || session.throttled.analysis.with(|a| a.as_ref().as_ref().ok().map(|a| a.operating_point.pump_voltage));
    let voltages = move || match session.document.with(|s| s.setup.operating_point) {
        OperatingPointSpec::PumpVoltage(given) => Some(given),
        OperatingPointSpec::State(state) => Some(state.pump_voltage),
        OperatingPointSpec::Levels(_) => computed(),
    };
    let on_change = move |v: f64| {
        let mut both = untrack(voltages).unwrap_or_default();
        both[pump] = v;
        session.edit(|s| match &mut s.operating_point {
            OperatingPointSpec::State(state) => state.pump_voltage = both,
            rest => *rest = OperatingPointSpec::PumpVoltage(both),
        });
    };
    let range = session.part(move |s: &Setup| {
        let pump = s.plant().pumps[pump];
        (pump.voltage_min, pump.voltage_max)
    });
    view! {
        <div class="field-row">
            <span>{["v₁", "v₂"][pump]}</span>
            <NumberField
                id=VOLTAGE_IDS[pump]
                name=say!(lab, process.voltage, pump = pump + 1)
                value=Signal::derive(move || voltages().map_or(0.0, |v| v[pump]))
                on_change
                limits=range
                scale=Scale::Linear(0.05)
                digits=Some(2)
                disabled=lab.locks(locks::VOLTAGES)
            />
            <span class="unit">"V"</span>
        </div>
    }
}

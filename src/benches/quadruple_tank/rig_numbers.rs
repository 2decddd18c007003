//! Every number of the rig, to be changed.

use leptos::prelude::*;
use quadtank::plant::QuadrupleTank;
use quadtank::study::quadruple_tank::PlantSpec;
use quadtank_scenario::params::{self, Param};
use quadtank_scenario::{BenchDocument, Label, Limits, ScenarioError};

use super::flags::locks;
use super::session::{Session, use_session};
use crate::errors::of_error;
use crate::lab::Lab;
use crate::texts::{say, tr};
use crate::widgets::{NumberField, Scale, TextField, is_open};

/// A number that each tank or each pump has, or the rig alone.
struct RigNumber {
    /// Names for tests, one for each tank or pump.
    ids: &'static [&'static str],
    /// Its name with its shown unit.
    label: fn(Lab) -> String,
    /// Its row in the table of parameters.
    path: &'static str,
    /// Shown units in one of the row.
    shown_per_unit: f64,
    get: fn(&QuadrupleTank, usize) -> f64,
    put: fn(&mut QuadrupleTank, usize, f64),
}

const TANKS: [RigNumber; 6] = [
    RigNumber {
        ids: &["rig-area1", "rig-area2", "rig-area3", "rig-area4"],
        label: |lab| tr!(lab, rig.area),
        path: "plant.parameters.rig.tanks[].section.area_at_empty",
        shown_per_unit: 1e4,
        get: |rig, k| rig.tanks[k].section.area_at_empty,
        put: |rig, k, value| rig.tanks[k].section.area_at_empty = value,
    },
    RigNumber {
        ids: &["rig-slope1", "rig-slope2", "rig-slope3", "rig-slope4"],
        label: |lab| tr!(lab, rig.slope),
        path: "plant.parameters.rig.tanks[].section.area_slope",
        shown_per_unit: 1e2,
        get: |rig, k| rig.tanks[k].section.area_slope,
        put: |rig, k, value| rig.tanks[k].section.area_slope = value,
    },
    RigNumber {
        ids: &["rig-outlet1", "rig-outlet2", "rig-outlet3", "rig-outlet4"],
        label: |lab| tr!(lab, rig.outlet),
        path: "plant.parameters.rig.tanks[].outlet.area",
        shown_per_unit: 1e4,
        get: |rig, k| rig.tanks[k].outlet.area,
        put: |rig, k, value| rig.tanks[k].outlet.area = value,
    },
    RigNumber {
        ids: &["rig-loss1", "rig-loss2", "rig-loss3", "rig-loss4"],
        label: |lab| tr!(lab, rig.loss),
        path: "plant.parameters.rig.tanks[].outlet.loss_coefficient",
        shown_per_unit: 1.0,
        get: |rig, k| rig.tanks[k].outlet.loss_coefficient,
        put: |rig, k, value| rig.tanks[k].outlet.loss_coefficient = value,
    },
    RigNumber {
        ids: &["rig-height1", "rig-height2", "rig-height3", "rig-height4"],
        label: |lab| tr!(lab, rig.height),
        path: "plant.parameters.rig.tanks[].height",
        shown_per_unit: 1e2,
        get: |rig, k| rig.tanks[k].height,
        put: |rig, k, value| rig.tanks[k].height = value,
    },
    RigNumber {
        ids: &["rig-inflow1", "rig-inflow2", "rig-inflow3", "rig-inflow4"],
        label: |lab| tr!(lab, rig.inflow),
        path: "plant.parameters.rig.inflow[]",
        shown_per_unit: 1e6,
        get: |rig, k| rig.inflow[k],
        put: |rig, k, value| rig.inflow[k] = value,
    },
];

const PUMPS: [RigNumber; 8] = [
    RigNumber {
        ids: &["rig-gain1", "rig-gain2"],
        label: |lab| tr!(lab, rig.gain),
        path: "plant.parameters.rig.pumps[].gain",
        shown_per_unit: 1e6,
        get: |rig, k| rig.pumps[k].gain,
        put: |rig, k, value| rig.pumps[k].gain = value,
    },
    RigNumber {
        ids: &["rig-low1", "rig-low2"],
        label: |lab| tr!(lab, rig.low),
        path: "plant.parameters.rig.pumps[].voltage_min",
        shown_per_unit: 1.0,
        get: |rig, k| rig.pumps[k].voltage_min,
        put: |rig, k, value| rig.pumps[k].voltage_min = value,
    },
    RigNumber {
        ids: &["rig-high1", "rig-high2"],
        label: |lab| tr!(lab, rig.high),
        path: "plant.parameters.rig.pumps[].voltage_max",
        shown_per_unit: 1.0,
        get: |rig, k| rig.pumps[k].voltage_max,
        put: |rig, k, value| rig.pumps[k].voltage_max = value,
    },
    RigNumber {
        ids: &["rig-offset1", "rig-offset2"],
        label: |lab| tr!(lab, rig.offset),
        path: "plant.parameters.rig.pumps[].offset",
        shown_per_unit: 1e6,
        get: |rig, k| rig.pumps[k].offset,
        put: |rig, k, value| rig.pumps[k].offset = value,
    },
    RigNumber {
        ids: &["rig-start1", "rig-start2"],
        label: |lab| tr!(lab, rig.start),
        path: "plant.parameters.rig.pumps[].start_voltage",
        shown_per_unit: 1.0,
        get: |rig, k| rig.pumps[k].start_voltage,
        put: |rig, k, value| rig.pumps[k].start_voltage = value,
    },
    RigNumber {
        ids: &["rig-most1", "rig-most2"],
        label: |lab| tr!(lab, rig.most),
        path: "plant.parameters.rig.pumps[].flow_max",
        shown_per_unit: 1e6,
        // Where nothing but the voltage limits the flow, what the curve gives at the highest voltage is the most there is.
        get: |rig, k| rig.pumps[k].flow(rig.pumps[k].voltage_max),
        put: |rig, k, value| rig.pumps[k] = rig.pumps[k].limited_to(value),
    },
    RigNumber {
        ids: &["rig-delay1", "rig-delay2"],
        label: |lab| tr!(lab, rig.delay),
        path: "plant.parameters.rig.pumps[].delay_s",
        shown_per_unit: 1.0,
        get: |rig, k| rig.pumps[k].delay_s,
        put: |rig, k, value| rig.pumps[k].delay_s = value,
    },
    RigNumber {
        ids: &["rig-valve-slope1", "rig-valve-slope2"],
        label: |lab| tr!(lab, rig.valve_slope),
        path: "plant.parameters.rig.valve_slopes[]",
        shown_per_unit: 1e-6,
        get: |rig, k| rig.valve_slopes[k],
        put: |rig, k, value| rig.valve_slopes[k] = value,
    },
];

const OTHERS: [RigNumber; 5] = [
    RigNumber {
        ids: &["rig-sensor-gain"],
        label: |lab| tr!(lab, rig.sensor_gain),
        path: "plant.parameters.rig.sensor.gain",
        shown_per_unit: 1e-2,
        get: |rig, _| rig.sensor.gain,
        put: |rig, _, value| rig.sensor.gain = value,
    },
    RigNumber {
        ids: &["rig-sensor-range"],
        label: |lab| tr!(lab, rig.sensor_range),
        path: "plant.parameters.rig.sensor.range",
        shown_per_unit: 1e2,
        get: |rig, _| rig.sensor.range,
        put: |rig, _, value| rig.sensor.range = value,
    },
    RigNumber {
        ids: &["rig-sensor-resolution"],
        label: |lab| tr!(lab, rig.sensor_resolution),
        path: "plant.parameters.rig.sensor.resolution",
        shown_per_unit: 1.0,
        get: |rig, _| rig.sensor.resolution,
        put: |rig, _, value| rig.sensor.resolution = value,
    },
    RigNumber {
        ids: &["rig-power-gain"],
        label: |lab| tr!(lab, rig.power_gain),
        path: "plant.parameters.rig.power_gain",
        shown_per_unit: 1.0,
        get: |rig, _| rig.power_gain,
        put: |rig, _, value| rig.power_gain = value,
    },
    RigNumber {
        ids: &["rig-gravity"],
        label: |lab| tr!(lab, rig.gravity),
        path: "plant.parameters.rig.gravity",
        shown_per_unit: 1.0,
        get: |rig, _| rig.gravity,
        put: |rig, _, value| rig.gravity = value,
    },
];

/// All numbers of the rig, folded away and made only while they are open.
#[component]
pub fn RigNumbers() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let open = RwSignal::new(false);
    let refused = RwSignal::new(None::<ScenarioError>);
    let told = move || {
        let unit = session.own.unit.get();
        refused.with(|error| error.as_ref().map(|error| of_error(lab, unit, error)))
    };
    let content = move || {
        view! {
            <p class="remark">{say!(lab, rig.about)}</p>
            <RigName />
            <p class="remark warm" role="status" data-testid="rig-refused">{told}</p>
            <Group title=say!(lab, rig.tanks) numbers=&TANKS refused which=|lab, k| tr!(lab, rig.tank, number = k + 1) />
            <Group title=say!(lab, rig.pumps) numbers=&PUMPS refused which=|lab, k| tr!(lab, rig.pump, number = k + 1) />
            <Group title=say!(lab, rig.others) numbers=&OTHERS refused which=|_, _| String::new() />
        }
    };
    view! {
        <details class="more rig-numbers" data-testid="rig-numbers" on:toggle=move |event| open.set(is_open(&event))>
            <summary>{say!(lab, rig.title)}</summary>
            {move || open.get().then(content)}
        </details>
    }
}

/// What a rig of one's own is called; a published one has its name.
#[component]
fn RigName() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let is_published = session.part(|s| matches!(s.plant, PlantSpec::Preset(_)));
    let rename = move |name: String| session.document.update(|document| document.rig_name = name);
    view! {
        <TextField
            id="rig-name"
            label=say!(lab, rig.name)
            value=Signal::derive(move || session.document.with(|document| document.rig_name.clone()))
            max=Label::MAX_NAME
            on_change=rename
            disabled=lab.locks(locks::PRESET)
            hidden=is_published
        />
    }
}

/// Numbers of the tanks, of the pumps, or of the rig alone.
#[component]
fn Group(
    title: Signal<String>,
    numbers: &'static [RigNumber],
    /// Why the last change was not taken over, if it was not.
    refused: RwSignal<Option<ScenarioError>>,
    /// The name of a tank or a pump; empty for the rig alone.
    which: fn(Lab, usize) -> String,
) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let rows = numbers.iter().map(|number| {
        let fields = (0..number.ids.len()).map(|index| {
            let name = Signal::derive(move || match which(lab, index) {
                which if which.is_empty() => (number.label)(lab),
                which => tr!(lab, rig.of, what = (number.label)(lab), which = which),
            });
            // A number of its own that all rows share says which tank or pump it is of.
            let mark = if number.ids.len() > 1 { (index + 1).to_string() } else { String::new() };
            view! { <span class="which"><span aria-hidden="true">{mark}</span><Field number index name refused /></span> }
        });
        view! {
            <div class="rig-row">
                <span aria-hidden="true">{move || (number.label)(lab)}</span>
                <div>{fields.collect_view()}</div>
            </div>
        }
    });
    view! {
        <fieldset>
            <legend>{title}</legend>
            {rows.collect_view()}
        </fieldset>
    }
}

#[component]
fn Field(
    number: &'static RigNumber,
    index: usize,
    name: Signal<String>,
    refused: RwSignal<Option<ScenarioError>>,
) -> impl IntoView {
    let session = use_session();
    let row = Param::at(number.path);
    let limits = row.map_or(Limits::NONE, |row| row.limits);
    let scale = match row.map(|row| row.scale) {
        Some(params::Scale::Logarithmic) => Scale::Logarithmic,
        Some(params::Scale::Linear) | None => Scale::Linear(0.01),
    };
    let shown = number.shown_per_unit;
    let on_change = move |value: f64| refused.set(change(session, number, index, limits.clamp(value / shown)).err());
    view! {
        <NumberField
            id=number.ids[index]
            name
            value=Signal::derive(move || session.read(|s| shown * (number.get)(&s.plant.rig(), index)))
            on_change
            limits=Signal::stored((shown * limits.min, shown * limits.max))
            scale
            digits=None
            disabled=session.lab.locks(locks::PRESET)
        />
    }
}

/// Makes the rig one's own, with another number.
///
/// # Errors
/// What is wrong about such a rig; the one of before then stays.
fn change(session: Session, number: &RigNumber, index: usize, value: f64) -> Result<(), ScenarioError> {
    let mut changed = session.document.get_untracked();
    let setup = &mut changed.setup;
    let (mut rig, display_unit) = (setup.plant.rig(), setup.plant.display_unit());
    (number.put)(&mut rig, index, value);
    setup.plant = PlantSpec::Parameters { rig, display_unit };
    changed.validate()?;
    session.document.set(changed);
    Ok(())
}

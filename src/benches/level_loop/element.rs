//! An element of the loop, opened: its static curve, and what of it can be switched.

use leptos::prelude::*;
use quadtank::literature::andreis;
use quadtank::plant::level::{ActuatorCurve, Characteristic, LevelPlant, OutflowLaw};
use quadtank::study::level_loop::{Element, LevelLoopSetup};
use quadtank_figure::Frame;

use super::drawing::name as element_name;
use super::flags::locks;
use super::pictures;
use super::session::use_session;
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::shown::ShownUnit;
use crate::texts::{say, tr};
use crate::widgets::{ChartCanvas, ChartMenu, Scale, Tick};

/// Lags of transmitter and actuator (s).
const LAG: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "transmitter-lag"), ("", "actuator-lag")],
    label: |_, k| ["τt", "τa"][k].to_owned(),
    name: |lab, k| if k == 0 { tr!(lab, level.transmitter_lag) } else { tr!(lab, level.actuator_lag) },
    path: |_, k| ["plant.parameters.transmitter.lag_s", "plant.parameters.actuator.lag_s"][k],
    read: |s, k| {
        let plant = s.plant();
        [plant.transmitter.lag_s, plant.actuator.lag_s][k]
    },
    write: |s, k, lag| {
        s.edit_plant(|plant| *if k == 0 { &mut plant.transmitter.lag_s } else { &mut plant.actuator.lag_s } = lag);
    },
    scale: Some(Scale::Linear(0.1)),
    ..ParamControl::locked_by(locks::PLANT)
};
/// Cross-section of the tank (m²).
const AREA: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "tank-area"); 2],
    label: |_, _| "A".to_owned(),
    name: |lab, _| tr!(lab, level.area),
    path: |_, _| "plant.parameters.tank.area",
    read: |s, _| s.plant().tank.area,
    write: |s, _, area| s.edit_plant(|plant| plant.tank.area = area),
    scale: Some(Scale::Linear(0.05)),
    shown_unit: Some(|_| ShownUnit::called("m²")),
    ..LAG
};

/// The chosen element; a hint where none is.
#[component]
pub fn ElementPanel() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let chosen = session.own.element;
    let title = Signal::derive(move || chosen.get().map(|element| element_name(lab, element)).unwrap_or_default());
    let content = move || {
        let picture = pictures::element(session);
        let for_menu = picture.clone();
        let frames = RwSignal::new(Vec::<Frame>::new());
        view! {
            <div class="element-curve">
                <header>
                    <h3>{title}</h3>
                    <ChartMenu picture=for_menu file="element" title />
                    <button
                        type="button"
                        class="button small"
                        aria-label=say!(lab, app.close)
                        data-testid="element-close"
                        on:click=move |_| chosen.set(None)
                    >
                        "×"
                    </button>
                </header>
                <div class="chart">
                    <ChartCanvas picture frames summary=title name="element-curve" />
                </div>
                {move || chosen.get().map(|element| view! { <Switches element /> })}
            </div>
        }
    };
    let is_open = Memo::new(move |_| chosen.get().is_some());
    view! {
        {move || is_open.get().then(content)}
        <p class="remark" hidden=move || is_open.get()>{say!(lab, level.press_element)}</p>
    }
}

/// What of an element can be switched.
#[component]
fn Switches(element: Element) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    match element {
        Element::Transmitter => view! {
            <ParamRow session control=&LAG index=0 />
            <PlantTick
                id="transmitter-clips"
                text=say!(lab, level.clips)
                read=|plant| plant.transmitter.clips
                write=|plant, clips| plant.transmitter.clips = clips
            />
        }
        .into_any(),
        Element::Converter => view! {
            <PlantTick
                id="output-clips"
                text=say!(lab, level.output_clips)
                read=|plant| plant.output.clips
                write=|plant, clips| plant.output.clips = clips
            />
        }
        .into_any(),
        Element::Actuator => view! {
            <ParamRow session control=&LAG index=1 />
            <PlantTick
                id="actuator-straight"
                text=say!(lab, level.straight)
                read=|plant| plant.actuator.curve.0.len() == 2
                write=set_straight
            />
        }
        .into_any(),
        Element::Valve => view! { <CharacteristicSwitch /> }.into_any(),
        Element::Outlet => view! {
            <LawSwitch />
            <ParamRow session control=&AREA />
        }
        .into_any(),
    }
}

/// A property of the plant that is on or off.
#[component]
fn PlantTick(
    id: &'static str,
    #[prop(into)] text: Signal<String>,
    read: fn(&LevelPlant) -> bool,
    write: fn(&mut LevelPlant, bool),
) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let ticked = lab.throttled(session.part(move |s| read(&s.plant())));
    let on_tick = move |on: bool| session.edit(|s| s.edit_plant(|plant| write(plant, on)));
    view! { <Tick id text ticked disabled=lab.locks(locks::PLANT) on_tick /> }
}

/// A straight curve between the ends of the present one; else the curve of the source between them.
fn set_straight(plant: &mut LevelPlant, straight: bool) {
    let points = &mut plant.actuator.curve.0;
    if straight {
        points.drain(1..points.len() - 1);
    } else {
        plant.actuator.curve = ActuatorCurve(andreis::plant().actuator.curve.0);
    }
}

/// A characteristic by its name alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Linear,
    EqualPercentage,
    QuickOpening,
}

#[component]
fn CharacteristicSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <Switch
            session
            label=say!(lab, level.valve)
            choices=vec![
                (Kind::Linear, "valve-linear", say!(lab, level.linear)),
                (Kind::EqualPercentage, "valve-equal", say!(lab, level.equal_percentage)),
                (Kind::QuickOpening, "valve-quick", say!(lab, level.quick_opening)),
            ]
            read=|s| match s.plant().valve.characteristic {
                Characteristic::Linear => Kind::Linear,
                Characteristic::EqualPercentage { .. } => Kind::EqualPercentage,
                Characteristic::QuickOpening => Kind::QuickOpening,
            }
            write=|s, kind| {
                s.edit_plant(|plant| {
                    plant.valve.characteristic = match kind {
                        Kind::Linear => Characteristic::Linear,
                        // That of the source.
                        Kind::EqualPercentage => andreis::plant().valve.characteristic,
                        Kind::QuickOpening => Characteristic::QuickOpening,
                    };
                });
            }
            lock=locks::PLANT
        />
    }
}

#[component]
fn LawSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <Switch
            session
            label=say!(lab, level.outlet)
            choices=vec![
                (OutflowLaw::Linear, "outflow-linear", say!(lab, level.linear)),
                (OutflowLaw::SquareRoot, "outflow-root", say!(lab, level.square_root)),
                (OutflowLaw::Pumped, "outflow-pumped", say!(lab, level.pumped)),
            ]
            read=|s| s.plant().tank.outflow.law()
            write=LevelLoopSetup::set_outflow_law
            lock=locks::PLANT
        />
    }
}

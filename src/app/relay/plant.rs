//! The plant that is tuned, and the published cases.

use leptos::prelude::*;

use super::controls::{Knob, knob, segmented};
use super::printed::{PrintedFigures, name_of_case};
use super::session::{Session, use_session};
use crate::app::preset::name_of;
use crate::app::start::Control;
use crate::app::texts::{say, tr};
use crate::app::widgets::html::option;
use crate::app::widgets::{Choice, Scale};
use crate::control::Pairing;
use crate::plant::PresetId;
use crate::scenario::tuning::{PublishedCase, TuningPlant, TuningSetup};
use crate::tuning::PublishedPlant;

const WOOD_BERRY: &str = "wood-berry";
const PROCESS_TWO: &str = "process-two";

/// The choice of the plant, the parameters of a rig, and the published cases with their figures.
#[component]
pub fn PlantCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let no_rig = session.flag(|s| !matches!(s.plant, TuningPlant::QuadrupleTank { .. }));
    view! {
        <section class="card plant" aria-labelledby="plant-title">
            <header>
                <h2 id="plant-title">{say!(lab, relay.plant)}</h2>
                <Choice id="plant" name=say!(lab, relay.plant) options=plants(session) on_choose=move |name: String| choose_plant(session, &name) disabled=lab.locks(Control::Plant) />
                <Choice id="case" name=say!(lab, relay.case) options=cases(session) on_choose=move |name: String| choose_case(session, &name) disabled=lab.locks(Control::Plant) />
            </header>
            <div class="strip" hidden=no_rig>
                {knob(session, &Knob { id: ("rig-gamma1", ""), label: "γ₁", name: say!(lab, process.gamma, pump = 1), read: |s| valves(s)[0], write: |s, v| set_valve(s, 0, v), ..field(Scale::Linear(0.01), (0.0, 1.0)) })}
                {knob(session, &Knob { id: ("rig-gamma2", ""), label: "γ₂", name: say!(lab, process.gamma, pump = 2), read: |s| valves(s)[1], write: |s, v| set_valve(s, 1, v), ..field(Scale::Linear(0.01), (0.0, 1.0)) })}
                {knob(session, &Knob { id: ("rig-dead-time", ""), label: "θ", name: say!(lab, relay.dead_time), read: |s| behind(s)[0], write: |s, v| set_behind(s, 0, v), is_time: true, ..field(Scale::Linear(0.5), (0.0, 1000.0)) })}
                {knob(session, &Knob { id: ("rig-lag", ""), label: "T", name: say!(lab, relay.lag), read: |s| behind(s)[1], write: |s, v| set_behind(s, 1, v), is_time: true, ..field(Scale::Linear(0.5), (0.0, 1000.0)) })}
                {segmented(session, say!(lab, relay.pairing), vec![("rig-diagonal", say!(lab, relay.diagonal)), ("rig-swapped", say!(lab, relay.swapped))], |s| usize::from(rig(s).is_some_and(|(pairing, _)| pairing == Pairing::Swapped)), set_pairing, Control::Plant)}
                {segmented(session, say!(lab, relay.motion), vec![("rig-linear", say!(lab, relay.linear)), ("rig-nonlinear", say!(lab, relay.nonlinear))], |s| usize::from(rig(s).is_some_and(|(_, nonlinear)| nonlinear)), set_nonlinear, Control::Plant)}
            </div>
            <PrintedFigures />
            <p class="remark about" data-testid="plant-remark">{Signal::derive(move || remark(session))}</p>
        </section>
    }
}

fn field(scale: Scale, limits: (f64, f64)) -> Knob {
    Knob {
        id: ("", ""),
        label: "",
        name: Signal::stored(String::new()),
        read: |_| 0.0,
        write: |_, _| (),
        limits,
        travel: None,
        scale,
        is_time: false,
        class: "",
        lock: Control::Plant,
    }
}

/// Pairing of a rig, and whether it runs nonlinear.
fn rig(setup: &TuningSetup) -> Option<(Pairing, bool)> {
    match setup.plant {
        TuningPlant::QuadrupleTank { pairing, nonlinear, .. } => Some((pairing, nonlinear)),
        _ => None,
    }
}

fn valves(setup: &TuningSetup) -> [f64; 2] {
    match setup.plant {
        TuningPlant::QuadrupleTank { preset, valves, .. } => valves.unwrap_or_else(|| preset.preset().plant.valves),
        _ => [0.0; 2],
    }
}

fn set_valve(setup: &mut TuningSetup, valve: usize, gamma: f64) {
    let mut both = valves(setup);
    both[valve] = gamma;
    if let TuningPlant::QuadrupleTank { valves, .. } = &mut setup.plant {
        *valves = Some(both);
    }
}

/// Dead time and lag behind a rig (s).
fn behind(setup: &TuningSetup) -> [f64; 2] {
    match setup.plant {
        TuningPlant::QuadrupleTank { dead_time_s, lag_s, .. } => [dead_time_s, lag_s],
        _ => [0.0; 2],
    }
}

/// The nonlinear rig has neither dead time nor lag, so asking for one asks for the linear model.
fn set_behind(setup: &mut TuningSetup, which: usize, time_s: f64) {
    if let TuningPlant::QuadrupleTank { dead_time_s, lag_s, nonlinear, .. } = &mut setup.plant {
        *if which == 0 { dead_time_s } else { lag_s } = time_s;
        *nonlinear = *nonlinear && time_s == 0.0;
    }
}

fn set_pairing(setup: &mut TuningSetup, index: usize) {
    if let TuningPlant::QuadrupleTank { pairing, .. } = &mut setup.plant {
        *pairing = if index == 1 { Pairing::Swapped } else { Pairing::Diagonal };
    }
}

/// The nonlinear rig has neither dead time nor lag.
fn set_nonlinear(setup: &mut TuningSetup, index: usize) {
    if let TuningPlant::QuadrupleTank { dead_time_s, lag_s, nonlinear, .. } = &mut setup.plant {
        *nonlinear = index == 1;
        if *nonlinear {
            (*dead_time_s, *lag_s) = (0.0, 0.0);
        }
    }
}

fn name_of_plant(plant: &TuningPlant) -> &'static str {
    match plant {
        TuningPlant::Published(PublishedPlant::WoodBerry) => WOOD_BERRY,
        TuningPlant::Published(PublishedPlant::ProcessTwo) => PROCESS_TWO,
        TuningPlant::QuadrupleTank { preset, .. } => preset.name(),
        TuningPlant::Elements(_) => "",
    }
}

fn plants(session: Session) -> Signal<String> {
    let lab = session.lab;
    Signal::derive(move || {
        let chosen = lab.tuning.with(|s| name_of_plant(&s.tuning.plant));
        let one = |name: &str, text: &str| option(name, text, name == chosen);
        let mut options = one(WOOD_BERRY, tr!(lab, relay.wood_berry)) + &one(PROCESS_TWO, tr!(lab, relay.process_two));
        options.extend(PresetId::ALL.map(|id| one(id.name(), &name_of(lab, id))));
        if chosen.is_empty() {
            options += &one("", tr!(lab, relay.own_plant));
        }
        options
    })
}

fn choose_plant(session: Session, name: &str) {
    let plant = match name {
        WOOD_BERRY => TuningPlant::Published(PublishedPlant::WoodBerry),
        PROCESS_TWO => TuningPlant::Published(PublishedPlant::ProcessTwo),
        name => match PresetId::ALL.into_iter().find(|id| id.name() == name) {
            Some(id) => TuningPlant::rig(id),
            None => return,
        },
    };
    session.load(TuningSetup::on(plant), None);
}

fn cases(session: Session) -> Signal<String> {
    let lab = session.lab;
    Signal::derive(move || {
        let chosen = session.case.get();
        let none = option("", tr!(lab, relay.no_case), chosen.is_none());
        let changed = chosen.is_some_and(|case| {
            case.is_placement() && session.words.setup.with(|setup| **setup != case.scenario().tuning)
        });
        let one = |case: PublishedCase| {
            let (name, is_chosen) = (name_of_case(lab, case), chosen == Some(case));
            let name = if is_chosen && changed { tr!(lab, relay.changed, name = name).to_string() } else { name };
            option(&case.name(), &name, is_chosen)
        };
        none + &PublishedCase::all().map(one).collect::<String>()
    })
}

fn choose_case(session: Session, name: &str) {
    match PublishedCase::from_name(name) {
        Some(case) => session.load(case.scenario().tuning, Some(case)),
        None => session.case.set(None),
    }
}

/// What the plant is, in one line.
fn remark(session: Session) -> String {
    let lab = session.lab;
    let study = session.words.study.get();
    let gain = match study.as_ref() {
        Ok(study) => study.rga_11,
        Err(error) => return super::errors::sentence(lab, error),
    };
    let rga = gain.map_or_else(|| "∞".to_owned(), |gain| lab.number_style().fixed(gain, 3));
    let source = session.words.setup.with(|s| match &s.plant {
        TuningPlant::Published(PublishedPlant::WoodBerry) => tr!(lab, relay.remark_wood_berry).to_owned(),
        TuningPlant::Published(PublishedPlant::ProcessTwo) => tr!(lab, relay.remark_process_two).to_owned(),
        TuningPlant::QuadrupleTank { preset, .. } => preset.preset().source.to_owned(),
        TuningPlant::Elements(_) => tr!(lab, relay.own_plant).to_owned(),
    });
    let mut text = tr!(lab, relay.plant_remark, source = source, rga = rga).to_string();
    if gain.is_some_and(|gain| gain < 0.0) {
        text = text + " " + tr!(lab, relay.negative_pairing);
    }
    if session.words.setup.with(|s| rig(s).is_some_and(|(_, nonlinear)| nonlinear)) {
        text = text + " " + tr!(lab, relay.nonlinear_remark);
    }
    text
}

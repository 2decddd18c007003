//! The plant that is tuned, and the published cases.

use leptos::prelude::*;

use super::card::hideable;
use super::controls::{TIME, choice};
use super::printed::{PrintedFigures, name_of_case};
use super::session::{Session, use_session};
use crate::controls::{Knob, knob, segmented};
use crate::preset::name_of;
use crate::start::Control;
use crate::texts::{say, tr};
use crate::widgets::html::option;
use crate::widgets::{Scale, card};
use quadtank::control::Pairing;
use quadtank::plant::PresetId;
use quadtank::tuning::PublishedPlant;
use quadtank_scenario::tuning::{PublishedCase, TuningPlant, TuningSetup, TuningWarning};

const WOOD_BERRY: &str = "wood-berry";
const PROCESS_TWO: &str = "process-two";

const VALVE: Knob<TuningSetup> = Knob {
    ids: [("", "rig-gamma1"), ("", "rig-gamma2")],
    label: |_, k| ["γ₁", "γ₂"][k],
    name: |lab, k| tr!(lab, process.gamma, pump = k + 1),
    read: |s, k| valves(s)[k],
    write: set_valve,
    ..Knob::PLAIN
};
const BEHIND: Knob<TuningSetup> = Knob {
    ids: [("", "rig-dead-time"), ("", "rig-lag")],
    label: |_, k| ["θ", "T"][k],
    name: |lab, k| if k == 0 { tr!(lab, relay.dead_time) } else { tr!(lab, relay.lag) }.to_owned(),
    read: |s, k| behind(s)[k],
    write: set_behind,
    limits: |_, _| (0.0, 1000.0),
    scale: Scale::Linear(0.5),
    ..TIME
};

/// The choice of the plant, the parameters of a rig, and the published cases with their figures.
pub fn plant_card() -> AnyView {
    let session = use_session();
    let lab = session.lab;
    let lock = Control::Plant;
    let no_rig = session.flag(|s| !matches!(s.plant, TuningPlant::QuadrupleTank { .. }));
    let pairings = vec![("rig-diagonal", say!(lab, relay.diagonal)), ("rig-swapped", say!(lab, relay.swapped))];
    let motions = vec![("rig-linear", say!(lab, relay.linear)), ("rig-nonlinear", say!(lab, relay.nonlinear))];
    let swapped = |s: &TuningSetup| usize::from(rig(s).is_some_and(|(pairing, _)| pairing == Pairing::Swapped));
    let nonlinear = |s: &TuningSetup| usize::from(rig(s).is_some_and(|(_, nonlinear)| nonlinear));
    let choices = vec![
        choice("plant", say!(lab, relay.plant), plants(session), move |name| choose_plant(session, &name), lock),
        choice("case", say!(lab, relay.case), cases(session), move |name| choose_case(session, &name), lock),
    ];
    let of_rig = vec![
        knob(session, &VALVE, 0),
        knob(session, &VALVE, 1),
        knob(session, &BEHIND, 0),
        knob(session, &BEHIND, 1),
        segmented(session, say!(lab, relay.pairing), pairings, swapped, set_pairing, lock),
        segmented(session, say!(lab, relay.motion), motions, nonlinear, set_nonlinear, lock),
    ];
    let content = view! {
        {hideable("strip", no_rig, of_rig)}
        <PrintedFigures />
        <p class="remark about" data-testid="plant-remark">{Signal::derive(move || remark(session))}</p>
    };
    card("plant", say!(lab, relay.plant), choices, vec![content.into_any()])
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
    for warning in session.words.setup.with(|s| s.warnings()) {
        if let TuningWarning::CoefficientOrder { field, read_as, reversed } = warning {
            let order = tr!(lab, relay.coefficient_order, field = field, read = read_as, reversed = reversed);
            text = text + " " + &order;
        }
    }
    text
}

//! The plant that is tuned, and the published cases.

use leptos::prelude::*;

use super::flags::{locks, panels};
use super::formulas::OwnPlant;
use super::printed::{PrintedFigures, name_of_case};
use super::roots::PlantRoots;
use super::session::{Session, load, use_session};
use crate::benches::quadruple_tank::name_of;
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::lab::{Lab, Notice};
use crate::texts::{say, tr};
use crate::widgets::{Card, Choice, Scale, Segmented, Select};
use quadtank::control::Pairing;
use quadtank::literature::PresetId;
use quadtank::literature::campestrini::PublishedCase;
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::study::relay_tuning::{TunedTankMut, TuningPlant, TuningSetup};
use quadtank_scenario::BenchDocument;
use quadtank_scenario::tuning::{TuningWarning, warnings};

const VALVE: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "rig-gamma1"), ("", "rig-gamma2")],
    label: |_, k| ["γ₁", "γ₂"][k].to_owned(),
    name: |lab, k| tr!(lab, process.gamma, pump = k + 1),
    path: |_, _| "plant.quadruple_tank.valves[]",
    read: |s, k| valves(s)[k],
    write: set_valve,
    ..ParamControl::locked_by(locks::PLANT)
};
const BEHIND: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "rig-dead-time"), ("", "rig-lag")],
    label: |_, k| ["θ", "T"][k].to_owned(),
    name: |lab, k| if k == 0 { tr!(lab, relay.dead_time) } else { tr!(lab, relay.lag) },
    read: |s, k| behind(s)[k],
    write: set_behind,
    path: |_, k| ["plant.quadruple_tank.dead_time_s", "plant.quadruple_tank.lag_s"][k],
    scale: Some(Scale::Linear(0.5)),
    ..ParamControl::locked_by(locks::PLANT)
};

/// The choice of the plant, the parameters of a rig, and the published cases with their figures.
#[component]
pub fn PlantCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let no_rig = session.throttled_part(|s| s.plant.tank().is_none());
    view! {
        <Card
            name="plant"
            panel=panels::PLANT
            title=say!(lab, relay.plant)
            beside=|| {
                view! {
                    <PlantSelect />
                    <CaseSelect />
                }
            }
        >
            <div class="strip" hidden=no_rig><RigSettings /></div>
            <PrintedFigures />
            <p class="remark about" data-testid="plant-remark">{move || remark(session)}</p>
            <div class="folded">
                <OwnPlant />
                <PlantRoots />
            </div>
        </Card>
    }
}

/// Valves, what is behind the rig, pairing, and how it moves.
#[component]
fn RigSettings() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let lock = locks::PLANT;
    view! {
        <ParamRow session control=&VALVE index=0 />
        <ParamRow session control=&VALVE index=1 />
        <ParamRow session control=&BEHIND index=0 />
        <ParamRow session control=&BEHIND index=1 />
        <Switch
            session
            label=say!(lab, relay.pairing)
            choices=vec![
                (Pairing::Diagonal, "rig-diagonal", say!(lab, relay.diagonal)),
                (Pairing::Swapped, "rig-swapped", say!(lab, relay.swapped)),
            ]
            read=|s| rig(s).map_or(Pairing::Diagonal, |(pairing, _)| pairing)
            write=set_pairing
            lock
        />
        <MotionSwitch />
    }
}

/// Linear or nonlinear. Dead time and lag of the linear rig, which the nonlinear one has not, are kept for the way back.
#[component]
fn MotionSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let kept = StoredValue::new(None::<[f64; 2]>);
    let is_nonlinear = |s: &TuningSetup| rig(s).is_some_and(|(_, nonlinear)| nonlinear);
    let choose = move |nonlinear: bool| {
        let now = session.document.with_untracked(|s| behind(&s.tuning));
        if nonlinear && now != [0.0; 2] {
            kept.set_value(Some(now));
        }
        let change = |s: &mut TuningSetup| set_nonlinear(s, nonlinear, kept.get_value().filter(|_| !nonlinear));
        let mut tried = session.document.get_untracked();
        change(&mut tried.tuning);
        // The nonlinear plant has no hoses, and a rig of one's own may have some.
        match tried.validate() {
            Ok(()) => session.edit(change),
            Err(error) => lab.notice.set(Some(Notice::Refused(error))),
        }
    };
    view! {
        <Segmented
            label=say!(lab, relay.motion)
            choices=vec![
                (false, "rig-linear", say!(lab, relay.linear)),
                (true, "rig-nonlinear", say!(lab, relay.nonlinear)),
            ]
            value=lab.throttled(session.part(is_nonlinear))
            on_choose=choose
            disabled=lab.locks(locks::PLANT)
        />
    }
}

/// Pairing of a rig, and whether it runs nonlinear.
fn rig(setup: &TuningSetup) -> Option<(Pairing, bool)> {
    setup.plant.tank().map(|tank| (tank.pairing, tank.nonlinear))
}

fn valves(setup: &TuningSetup) -> [f64; 2] {
    setup.plant.tank().map_or([0.0; 2], |tank| tank.rig.valves)
}

fn set_valve(setup: &mut TuningSetup, valve: usize, gamma: f64) {
    let mut both = valves(setup);
    both[valve] = gamma;
    setup.plant.set_valves(both);
}

/// Dead time and lag behind a rig (s).
fn behind(setup: &TuningSetup) -> [f64; 2] {
    setup.plant.tank().map_or([0.0; 2], |tank| [tank.dead_time_s, tank.lag_s])
}

/// The nonlinear rig has neither dead time nor lag, so asking for one asks for the linear model.
fn set_behind(setup: &mut TuningSetup, which: usize, time_s: f64) {
    if let Some(tank) = setup.plant.tank_mut() {
        *if which == 0 { tank.dead_time_s } else { tank.lag_s } = time_s;
        *tank.nonlinear = *tank.nonlinear && time_s == 0.0;
    }
}

fn set_pairing(setup: &mut TuningSetup, chosen: Pairing) {
    if let Some(tank) = setup.plant.tank_mut() {
        *tank.pairing = chosen;
    }
}

/// The nonlinear rig has neither dead time nor lag; the linear one gets those back that are `kept`.
fn set_nonlinear(setup: &mut TuningSetup, chosen: bool, kept: Option<[f64; 2]>) {
    if let Some(TunedTankMut { dead_time_s, lag_s, nonlinear, .. }) = setup.plant.tank_mut() {
        *nonlinear = chosen;
        if *nonlinear {
            (*dead_time_s, *lag_s) = (0.0, 0.0);
        } else if let Some(kept) = kept.filter(|_| [*dead_time_s, *lag_s] == [0.0; 2]) {
            [*dead_time_s, *lag_s] = kept;
        }
    }
}

/// A plant that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum KnownPlant {
    Published(PublishedPlant),
    Rig(PresetId),
}

impl KnownPlant {
    /// The plant of a document; nothing for a rig or elements of its own.
    fn of(plant: &TuningPlant) -> Option<Self> {
        match *plant {
            TuningPlant::Published(plant) => Some(Self::Published(plant)),
            TuningPlant::QuadrupleTank { preset, .. } => Some(Self::Rig(preset)),
            TuningPlant::Parameters { .. } | TuningPlant::Elements(_) => None,
        }
    }

    fn all() -> impl Iterator<Item = Self> {
        let published = [PublishedPlant::WoodBerry, PublishedPlant::ProcessTwo].map(Self::Published);
        published.into_iter().chain(PresetId::ALL.map(Self::Rig))
    }

    fn plant(self) -> TuningPlant {
        match self {
            Self::Published(plant) => TuningPlant::Published(plant),
            Self::Rig(preset) => TuningPlant::rig(preset),
        }
    }

    fn choice(self, lab: Lab) -> Choice<Option<Self>> {
        match self {
            Self::Published(PublishedPlant::WoodBerry) => {
                Choice::new(Some(self), "wood-berry", tr!(lab, relay.wood_berry))
            }
            Self::Published(PublishedPlant::ProcessTwo) => {
                Choice::new(Some(self), "process-two", tr!(lab, relay.process_two))
            }
            Self::Rig(id) => Choice::new(Some(self), id.name(), name_of(lab, id)),
        }
    }
}

/// Name of a plant that is not in the list of published ones: a rig of the user's own, or elements typed as formulas.
fn name_of_own(session: Session) -> String {
    let is_rig = session.document.with(|s| s.tuning.plant.tank().is_some());
    if is_rig { tr!(session.lab, preset.own) } else { tr!(session.lab, relay.own_plant) }
}

#[component]
fn PlantSelect() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let chosen = Signal::derive(move || session.document.with(|s| KnownPlant::of(&s.tuning.plant)));
    let choices = Signal::derive(move || {
        let own = chosen.get().is_none().then(|| Choice::new(None, "", name_of_own(session)));
        KnownPlant::all().map(|plant| plant.choice(lab)).chain(own).collect::<Vec<_>>()
    });
    let choose = move |plant: Option<KnownPlant>| {
        if let Some(plant) = plant {
            load(session, TuningSetup::on(plant.plant()), None);
        }
    };
    view! {
        <Select
            id="plant"
            name=say!(lab, relay.plant)
            choices
            chosen
            on_choose=choose
            disabled=lab.locks(locks::PLANT)
        />
    }
}

#[component]
fn CaseSelect() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let choices = Signal::derive(move || {
        let chosen = session.own.case.get();
        let changed = chosen.is_some_and(|case| {
            case.is_placement() && session.throttled.setup.with(|setup| **setup != TuningSetup::published(case))
        });
        let one = |case: PublishedCase| {
            let text = name_of_case(lab, case);
            let text = if changed && chosen == Some(case) { tr!(lab, relay.changed, name = text) } else { text };
            Choice::new(Some(case), case.name(), text)
        };
        let none = Choice::new(None, "", tr!(lab, relay.no_case));
        std::iter::once(none).chain(PublishedCase::all().map(one)).collect::<Vec<_>>()
    });
    let choose = move |case: Option<PublishedCase>| match case {
        Some(case) => load(session, TuningSetup::published(case), Some(case)),
        None => session.own.hide_case(session.document),
    };
    view! {
        <Select
            id="case"
            name=say!(lab, relay.case)
            choices
            chosen=session.own.case
            on_choose=choose
            disabled=lab.locks(locks::PLANT)
        />
    }
}

/// What the plant is, in one line.
fn remark(session: Session) -> String {
    let lab = session.lab;
    let study = session.throttled.study.get();
    let gain = match study.as_ref() {
        Ok(study) => study.rga_11,
        Err(error) => return super::errors::sentence(lab, error),
    };
    let rga = gain.map_or_else(|| "∞".to_owned(), |gain| lab.number_style().fixed(gain, 3));
    let source = session.throttled.setup.with(|s| match &s.plant {
        TuningPlant::Published(PublishedPlant::WoodBerry) => tr!(lab, relay.remark_wood_berry),
        TuningPlant::Published(PublishedPlant::ProcessTwo) => tr!(lab, relay.remark_process_two),
        TuningPlant::QuadrupleTank { preset, .. } => preset.preset().source.to_owned(),
        TuningPlant::Parameters { .. } | TuningPlant::Elements(_) => name_of_own(session),
    });
    let mut text = tr!(lab, relay.plant_remark, source = source, rga = rga);
    if gain.is_some_and(|gain| gain < 0.0) {
        text = text + " " + &tr!(lab, relay.negative_pairing);
    }
    if let Ok(study) = study.as_ref() {
        if study.plant.is_integrating() {
            text = text + " " + &tr!(lab, relay.integrating_remark);
        }
        if study.plant.has_feedthrough() {
            text = text + " " + &tr!(lab, relay.feedthrough_remark);
        }
    }
    if session.throttled.setup.with(|s| rig(s).is_some_and(|(_, nonlinear)| nonlinear)) {
        text = text + " " + &tr!(lab, relay.nonlinear_remark);
    }
    for warning in session.throttled.setup.with(|s| warnings(s)) {
        if let TuningWarning::CoefficientOrder { field, read_as, reversed } = warning {
            let order = tr!(lab, relay.coefficient_order, field = field, read = read_as, reversed = reversed);
            text = text + " " + &order;
        }
    }
    text
}

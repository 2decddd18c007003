//! The choice of a published rig.

use leptos::prelude::*;

use super::flags::locks;
use super::session::{Session, use_session};
use crate::lab::{Lab, Notice};
use crate::texts::{say, tr};
use crate::widgets::{Choice, Select};
use quadtank::literature::PresetId;
use quadtank::study::quadruple_tank::{PlantSpec, Setup, first_experiment, setup_of};
use quadtank_scenario::{Label, Scenario};

/// Name of a rig in the language of the laboratory.
pub fn name_of(lab: Lab, id: PresetId) -> String {
    match id {
        PresetId::JohanssonMinimumPhase => tr!(lab, preset.johansson_minus),
        PresetId::JohanssonNonMinimumPhase => tr!(lab, preset.johansson_plus),
        PresetId::CocotaMinimumPhase => tr!(lab, preset.cocota_minus),
        PresetId::CocotaNonMinimumPhase => tr!(lab, preset.cocota_plus),
        PresetId::JunqueiraA => tr!(lab, preset.junqueira_a),
        PresetId::JunqueiraB => tr!(lab, preset.junqueira_b),
        PresetId::Seville => tr!(lab, preset.seville),
        PresetId::Quanser => tr!(lab, preset.quanser),
        PresetId::MpcTools => tr!(lab, preset.mpctools),
        PresetId::Dtu => tr!(lab, preset.dtu),
    }
}

fn changed(lab: Lab, id: PresetId) -> String {
    tr!(lab, preset.changed, name = name_of(lab, id))
}

/// What a rig of one's own is called.
fn own_name(session: Session) -> String {
    let name = session.document.with(|document| document.rig_name.clone());
    if name.is_empty() { tr!(session.lab, preset.own) } else { name }
}

/// What to know about a rig.
pub fn remark_of(lab: Lab, id: Option<PresetId>) -> String {
    match id {
        Some(PresetId::JohanssonMinimumPhase) => tr!(lab, preset.remark_johansson_minus),
        Some(PresetId::JohanssonNonMinimumPhase) => tr!(lab, preset.remark_johansson_plus),
        Some(PresetId::CocotaMinimumPhase) => tr!(lab, preset.remark_cocota_minus),
        Some(PresetId::CocotaNonMinimumPhase) => tr!(lab, preset.remark_cocota_plus),
        Some(PresetId::JunqueiraA | PresetId::JunqueiraB) => tr!(lab, preset.remark_junqueira),
        Some(PresetId::Seville) => tr!(lab, preset.remark_seville),
        Some(PresetId::Quanser) => tr!(lab, preset.remark_quanser),
        Some(PresetId::MpcTools) => tr!(lab, preset.remark_mpctools),
        Some(PresetId::Dtu) => tr!(lab, preset.remark_dtu),
        None => tr!(lab, preset.remark_own),
    }
}

/// Loads a published rig with its published controller and experiment; pinned runs stay. It can be undone, and a notice says so.
pub fn load(session: Session, id: PresetId) {
    session.record();
    session.document.update(|s| {
        let fresh = Scenario {
            version: s.version,
            label: Label::default(),
            rig_name: String::new(),
            setup: setup_of(id),
            pinned: std::mem::take(&mut s.pinned),
            view: s.view.clone(),
        };
        *s = fresh;
        s.view.cursor_s = None;
        s.view.zoom_s = None;
    });
    let lab = session.lab;
    lab.notice.set(Some(Notice::Loaded(untrack(|| name_of(lab, id)))));
}

/// The rig in force, if it is a published one.
pub fn chosen(session: Session) -> Signal<Option<PresetId>> {
    session.part(|s| match s.plant {
        PlantSpec::Preset(id) => Some(id),
        PlantSpec::Parameters { .. } => None,
    })
}

/// What to know about the rig in force.
#[component]
pub fn PresetRemark() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let id = chosen(session);
    view! { <p class="remark" data-testid="preset-remark">{move || remark_of(lab, id.get())}</p> }
}

/// Whether a setup is as published, or as a first visit begins with.
fn is_published(setup: &Setup, id: PresetId) -> bool {
    *setup == setup_of(id) || *setup == first_experiment()
}

/// The choice among all published rigs.
#[component]
pub fn PresetSelect() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let id = chosen(session);
    // What was changed is none of the choices, so that choosing the same rig again brings it back.
    let intact =
        Signal::derive(move || id.get().filter(|&id| session.throttled.setup.with(|setup| is_published(setup, id))));
    let choices = Signal::derive(move || {
        let published =
            PresetId::ALL.into_iter().map(|choice| Choice::new(Some(choice), choice.name(), name_of(lab, choice)));
        let own = || id.get().map_or_else(|| own_name(session), |id| changed(lab, id));
        let other = intact.get().is_none().then(|| Choice::new(None, "", own()));
        other.into_iter().chain(published).collect::<Vec<_>>()
    });
    let choose = move |choice: Option<PresetId>| {
        if let Some(id) = choice {
            load(session, id);
        }
    };
    view! {
        <Select
            id="preset"
            name=say!(lab, preset.choose)
            title=Signal::derive(move || remark_of(lab, id.get()))
            choices
            chosen=intact
            on_choose=choose
            disabled=lab.locks(locks::PRESET)
        />
    }
}

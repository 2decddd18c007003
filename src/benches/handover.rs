//! Gains and rigs that travel from bench to bench. What was on the other bench is a step back (undo).

use leptos::prelude::*;
use quadtank::study::handover::{model_free_on, relay_session_on};
use quadtank::study::quadruple_tank::Setup;
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{BenchDocument, Scenario, ScenarioError};

use super::{ModelFree, QuadrupleTank, RelayTuning};
use crate::lab::{Lab, Notice, use_lab};
use crate::session::Bench;
use crate::share::go_to;

/// A button that hands something over. A lesson stays on its bench.
#[component]
pub fn HandOver(
    /// Name for tests.
    id: &'static str,
    /// What it says.
    name: Signal<String>,
    /// Whether there is something to hand over.
    #[prop(into)]
    is_possible: Signal<bool>,
    /// Hands it over.
    act: Callback<()>,
) -> impl IntoView {
    let lab = use_lab();
    view! {
        <button
            type="button"
            class="button small"
            data-testid=id
            hidden=move || !is_possible.get() || lab.stage.with(Option::is_some)
            on:click=move |_| act.run(())
        >
            {name}
        </button>
    }
}

/// Shows a document on its bench, under the name that the experiment has, unless that bench refuses it.
fn hand_over<B: Bench>(lab: Lab, mut document: B::Document) {
    if let Err(error) = document.validate() {
        return lab.notice.set(Some(Notice::Refused(error)));
    }
    *document.label_mut() = untrack(|| (lab.bench.get_untracked().label)(lab));
    lab.open_in::<B>(document);
    if let Some(bench) = lab.benches.iter().find(|bench| bench.id == B::ID) {
        go_to(lab, bench);
        window().scroll_to_with_x_and_y(0.0, 0.0);
    }
}

/// Tries controllers on the rig, beside what is pinned there. A rig of the user's own that is still there keeps its name and its unit.
pub fn to_rig(lab: Lab, setup: Setup) {
    let there = lab.session::<QuadrupleTank>().document.get_untracked();
    let mut scenario = Scenario { pinned: there.pinned, ..Scenario::from(setup) };
    if scenario.setup.is_same_rig(&there.setup) {
        (scenario.setup.plant, scenario.rig_name) = (there.setup.plant, there.rig_name);
    }
    hand_over::<QuadrupleTank>(lab, scenario);
}

/// Tunes a rig by relays.
pub fn to_relays(lab: Lab, rig: &Setup) {
    let session = match relay_session_on(rig) {
        Ok(session) => session,
        Err(error) => {
            return lab.notice.set(Some(Notice::Refused(ScenarioError::Study { setup: Scenario::ROOT, error })));
        }
    };
    let added_s = session.plant.tank().map(|tank| tank.dead_time_s).filter(|&dead_time_s| dead_time_s > 0.0);
    hand_over::<RelayTuning>(lab, TuningScenario::from(session));
    if let Some(dead_time_s) = added_s {
        lab.notice.set(Some(Notice::DeadTimeAdded(dead_time_s)));
    }
}

/// Compares the controllers of a rig with the law without a model.
pub fn to_model_free(lab: Lab, rig: &Setup) {
    match model_free_on(rig) {
        Ok(setup) => hand_over::<ModelFree>(lab, ModelFreeScenario::from(setup)),
        Err(error) => lab.notice.set(Some(Notice::Refused(ScenarioError::Study { setup: Scenario::ROOT, error }))),
    }
}

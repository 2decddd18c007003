//! Where the run begins, and who moves the pumps.

use leptos::prelude::*;
use quadtank::study::quadruple_tank::Setup;
use quadtank_scenario::Limits;

use super::flags::locks;
use super::four_levels::{FourLevels, LEVEL};
use super::pump_table::PumpTable;
use super::session::use_session;
use crate::controls::ParamControl;
use crate::lab::Lab;
use crate::texts::{say, tr};
use crate::widgets::{Choice, Select};

const LOWER: ParamControl<Setup> = ParamControl {
    ids: [("", "start-level1"), ("", "start-level2")],
    name: |lab, k| tr!(lab, experiment.start_level, number = k + 1),
    read: |s, k| initial_level(s, k),
    write: |s, k, level| set_initial_level(s, k, level),
    within: |s, k| Limits::new(0.0, s.plant().tanks[k].height),
    ..INITIAL
};
const UPPER: ParamControl<Setup> = ParamControl {
    ids: [("", "start-level3"), ("", "start-level4")],
    name: |lab, k| tr!(lab, experiment.start_level, number = k + 3),
    read: |s, k| initial_level(s, k + 2),
    write: |s, k, level| set_initial_level(s, k + 2, level),
    within: |s, k| Limits::new(0.0, s.plant().tanks[k + 2].height),
    ..INITIAL
};
const INITIAL: ParamControl<Setup> = ParamControl { path: |_, _| "experiment.initial_levels[]", ..LEVEL };

fn initial_level(setup: &Setup, tank: usize) -> f64 {
    setup.experiment.initial_levels.map_or(0.0, |levels| levels[tank])
}

fn set_initial_level(setup: &mut Setup, tank: usize, level: f64) {
    if let Some(levels) = &mut setup.experiment.initial_levels {
        levels[tank] = level;
    }
}

/// At rest, or from levels that are given: at first those of the rest.
#[component]
pub fn StartControls() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let is_given = session.part(|s| s.experiment.initial_levels.is_some());
    let choose = move |given: bool| {
        session.edit(|s| {
            let heights = s.plant().tanks.map(|tank| tank.height);
            let rest = s.operating_point().map_or([0.0; 4], |point| point.levels);
            let within = [0, 1, 2, 3].map(|tank| rest[tank].clamp(0.0, heights[tank]));
            s.experiment.initial_levels = given.then_some(within);
        });
    };
    let choices = Signal::derive(move || {
        vec![
            Choice::new(false, "rest", tr!(lab, experiment.start_rest)),
            Choice::new(true, "levels", tr!(lab, experiment.start_levels)),
        ]
    });
    let fields = move || view! { <FourLevels controls=[&LOWER, &UPPER] name=say!(lab, experiment.start) /> };
    view! {
        <div class="row load">
            <label for="start-kind">{say!(lab, experiment.start)}</label>
            <Select id="start-kind" labelled="start-kind" choices chosen=is_given on_choose=choose disabled=lab.locks(locks::EXPERIMENT) />
        </div>
        {move || is_given.get().then(fields)}
    }
}

/// Who moves the pumps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pumps {
    /// Their controllers.
    Controlled,
    /// A hand, in pseudo-random steps that are still to be made.
    Random,
    /// A hand, in so many steps that the document holds.
    Given(usize),
}

impl Pumps {
    fn of(setup: &Setup) -> Self {
        match setup.experiment.pump_voltage_steps.len() {
            0 => Self::Controlled,
            steps => Self::Given(steps),
        }
    }

    fn choice(self, lab: Lab) -> Choice<Self> {
        match self {
            Self::Controlled => Choice::new(self, "controlled", tr!(lab, experiment.pumps_controlled)),
            Self::Random => Choice::new(self, "random", tr!(lab, experiment.pumps_random)),
            Self::Given(count) => Choice::new(self, "given", tr!(lab, experiment.pumps_given, count = count)),
        }
    }
}

/// Controllers, or a sequence of steps by hand.
#[component]
pub fn PumpControls() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let chosen = session.part(Pumps::of);
    let choose = move |pumps: Pumps| {
        session.edit(|s| match pumps {
            Pumps::Controlled => s.experiment.pump_voltage_steps.clear(),
            Pumps::Random => s.experiment.pump_voltage_steps = s.random_moves(),
            Pumps::Given(_) => {}
        });
    };
    let choices = Signal::derive(move || {
        let given = Some(chosen.get()).filter(|pumps| matches!(pumps, Pumps::Given(_)));
        [Pumps::Controlled, Pumps::Random].into_iter().chain(given).map(|pumps| pumps.choice(lab)).collect::<Vec<_>>()
    });
    let is_by_hand = move || matches!(chosen.get(), Pumps::Given(_));
    view! {
        <div class="row load">
            <label for="pumps-kind">{say!(lab, experiment.pumps)}</label>
            <Select id="pumps-kind" labelled="pumps-kind" choices chosen on_choose=choose disabled=lab.locks(locks::EXPERIMENT) />
        </div>
        <p class="remark" hidden=move || !is_by_hand()>{say!(lab, experiment.pumps_remark)}</p>
        <PumpTable />
    }
}

/// How many steps of measured inflows the document holds, and a button that takes them out.
#[component]
pub fn InflowSteps() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let count = session.part(|s| s.experiment.inflow_steps.len());
    let remove = move |_| session.edit(|s| s.experiment.inflow_steps.clear());
    view! {
        <p class="remark" hidden=move || count.get() == 0 data-testid="inflow-steps">
            {say!(lab, experiment.inflows, count = count.get())} " "
            <button
                type="button"
                class="button small"
                data-testid="inflow-remove"
                disabled=lab.locks(locks::EXPERIMENT)
                on:click=remove
            >
                {say!(lab, experiment.inflows_remove)}
            </button>
        </p>
    }
}

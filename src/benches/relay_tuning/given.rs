//! Given controllers in the place of a placement.

use leptos::prelude::*;

use super::flags::locks;
use super::session::use_session;
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::lab::Lab;
use crate::shown::ShownUnit;
use crate::texts::{say, tr};
use crate::widgets::{Choice, Select};
use quadtank::control::Pairing;
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::literature::wood_berry::PublishedControllers;
use quadtank::study::relay_tuning::{GivenPid, TuningPlant, TuningSetup};
use quadtank_scenario::limits::{TUNING_NOT_NEGATIVE, TUNING_POSITIVE, TUNING_VALUE};

const GAIN: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "given-gain1"), ("", "given-gain2")],
    label: |_, k| ["K₁", "K₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.given_gain, number = k + 1),
    read: |s, k| given(s, k).gain,
    write: |s, k, gain| change(s, k, |pid| pid.gain = gain),
    path: |_, _| "design.controllers[].gain",
    ..OF_LOOP
};
const INTEGRAL_TIME: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "given-ti1"), ("", "given-ti2")],
    label: |_, k| ["Ti₁", "Ti₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.given_integral_time, number = k + 1),
    // Shown as a dash without integral action.
    read: |s, k| given(s, k).integral_time.unwrap_or(f64::INFINITY),
    write: |s, k, time| change(s, k, |pid| pid.integral_time = Some(time)),
    path: |_, _| "design.controllers[].integral_time",
    ..OF_LOOP
};
const DERIVATIVE_TIME: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "given-td1"), ("", "given-td2")],
    label: |_, k| ["Td₁", "Td₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.given_derivative_time, number = k + 1),
    read: |s, k| given(s, k).derivative_time,
    write: |s, k, time| change(s, k, |pid| set_derivative_time(pid, time)),
    path: |_, _| "design.controllers[].derivative_time",
    ..OF_LOOP
};
const FILTER_TIME: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "given-tf1"), ("", "given-tf2")],
    label: |_, k| ["Tf₁", "Tf₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.given_filter_time, number = k + 1),
    read: |s, k| given(s, k).filter_in_force(),
    write: |s, k, time| change(s, k, |pid| pid.filter_time = Some(time)),
    path: |_, _| "design.controllers[].filter_time",
    ..OF_LOOP
};
const OF_LOOP: ParamControl<TuningSetup> = ParamControl {
    class: ["loop1", "loop2"],
    shown_unit: Some(|_| ShownUnit::called("")),
    ..ParamControl::locked_by(locks::TARGET)
};

fn given(setup: &TuningSetup, index: usize) -> GivenPid {
    setup.design.controllers.unwrap_or_default()[index]
}

fn change(setup: &mut TuningSetup, index: usize, change: impl FnOnce(&mut GivenPid)) {
    if let Some(controllers) = &mut setup.design.controllers {
        change(&mut controllers[index]);
    }
}

/// Without derivative action there is nothing to filter.
fn set_derivative_time(pid: &mut GivenPid, time: f64) {
    pid.derivative_time = time;
    if time == 0.0 {
        pid.filter_time = None;
    }
}

/// Whether a controller has derivative action, and so something to filter.
fn has_derivative(setup: &TuningSetup, index: usize) -> bool {
    let GivenPid { gain, derivative_time, .. } = given(setup, index);
    gain != 0.0 && derivative_time != 0.0
}

/// Whether the controllers of a session are given.
pub fn is_given(setup: &TuningSetup) -> bool {
    setup.design.controllers.is_some()
}

pub fn has_published(setup: &TuningSetup) -> bool {
    setup.plant == TuningPlant::Published(PublishedPlant::WoodBerry)
}

/// The choice between a placement and given controllers, which begin as those that were placed.
#[component]
pub fn Origin() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <Switch
            session
            label=say!(lab, relay.origin)
            choices=vec![
                (false, "design-placed", say!(lab, relay.origin_placed)),
                (true, "design-given", say!(lab, relay.origin_given)),
            ]
            read=is_given
            write=set_given
            lock=locks::TARGET
        />
    }
}

fn set_given(setup: &mut TuningSetup, given: bool) {
    if !given {
        (setup.design.controllers, setup.design.pairing) = (None, Pairing::Diagonal);
    } else if !is_given(setup) {
        setup.give_placed_controllers();
        // A placement at a far target is beyond what a document holds.
        setup.design.controllers = setup.design.controllers.map(|both| both.map(within_limits));
    }
}

pub fn within_limits(pid: GivenPid) -> GivenPid {
    GivenPid {
        gain: TUNING_VALUE.clamp(pid.gain),
        integral_time: pid.integral_time.map(|time| TUNING_POSITIVE.clamp(time)),
        derivative_time: TUNING_NOT_NEGATIVE.clamp(pid.derivative_time),
        filter_time: pid.filter_time,
    }
}

/// The fields of both controllers.
#[component]
pub fn GivenControllers() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <div class="pairs">
            <ParamRow session control=&GAIN index=0 />
            <ParamRow session control=&GAIN index=1 />
            <ParamRow session control=&INTEGRAL_TIME index=0 />
            <ParamRow session control=&INTEGRAL_TIME index=1 />
            <ParamRow session control=&DERIVATIVE_TIME index=0 />
            <ParamRow session control=&DERIVATIVE_TIME index=1 />
            <div hidden=session.throttled_part(|s| !has_derivative(s, 0))><ParamRow session control=&FILTER_TIME index=0 /></div>
            <div hidden=session.throttled_part(|s| !has_derivative(s, 1))><ParamRow session control=&FILTER_TIME index=1 /></div>
        </div>
        <Switch
            session
            label=say!(lab, relay.given_pairing)
            choices=vec![
                (Pairing::Diagonal, "given-diagonal", say!(lab, relay.diagonal)),
                (Pairing::Swapped, "given-swapped", say!(lab, relay.swapped)),
            ]
            read=|s| s.design.pairing
            write=|s, pairing| s.design.pairing = pairing
            lock=locks::TARGET
        />
        <div hidden=session.throttled_part(|s| !has_published(s))><PublishedSelect /></div>
    }
}

/// The published controllers, to take over.
#[component]
fn PublishedSelect() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let choices = Signal::derive(move || {
        let published = PublishedControllers::ALL
            .map(|controllers| Choice::new(Some(controllers), controllers.name(), name_of(lab, controllers)));
        let own = Choice::new(None, "", tr!(lab, relay.own_controllers));
        std::iter::once(own).chain(published).collect::<Vec<_>>()
    });
    let chosen = Signal::derive(move || {
        let design = session.document.with(|s| s.tuning.design);
        let is_it = |of: &PublishedControllers| {
            let published = TuningSetup::with_published(*of).design;
            (published.controllers, published.pairing) == (design.controllers, design.pairing)
        };
        PublishedControllers::ALL.into_iter().find(is_it)
    });
    let choose = move |chosen: Option<PublishedControllers>| {
        if let Some(controllers) = chosen {
            let published = TuningSetup::with_published(controllers).design;
            session.edit(|s| (s.design.controllers, s.design.pairing) = (published.controllers, published.pairing));
        }
    };
    view! {
        <Select
            id="given-published"
            name=say!(lab, relay.published_controllers)
            choices
            chosen
            on_choose=choose
            disabled=lab.locks(locks::TARGET)
        />
    }
}

/// Who published controllers, and how they were found.
pub fn name_of(lab: Lab, controllers: PublishedControllers) -> String {
    match controllers {
        PublishedControllers::Blt => tr!(lab, relay.controllers_blt),
        PublishedControllers::ZieglerNichols => tr!(lab, relay.controllers_zn),
        PublishedControllers::ChenSeborg => tr!(lab, relay.controllers_chen),
        PublishedControllers::BoydHastAstrom => tr!(lab, relay.controllers_boyd),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quadtank_scenario::BenchDocument;
    use quadtank_scenario::tuning::TuningScenario;

    #[test]
    fn a_placement_is_given_and_back_within_what_a_document_holds() {
        for target in [[-0.2, -0.3], [-5e5, 0.0], [1e6, -1e6]] {
            let mut setup = TuningSetup::default();
            setup.design.target = target;
            let placed = setup.clone();
            set_given(&mut setup, true);
            assert!(is_given(&setup) && given(&setup, 0).gain != 0.0);
            assert_eq!(TuningScenario::from(setup.clone()).validate(), Ok(()), "{target:?}");
            set_given(&mut setup, false);
            assert_eq!(setup, placed);
        }
    }

    #[test]
    fn without_derivative_action_there_is_no_filter() {
        let mut setup = TuningSetup::with_published(PublishedControllers::BoydHastAstrom);
        assert_eq!(given(&setup, 1).filter_time, Some(0.3));
        change(&mut setup, 1, |pid| set_derivative_time(pid, 0.0));
        assert_eq!((given(&setup, 1).filter_time, given(&setup, 0).filter_time), (None, Some(0.3)));
    }
}

//! Given controllers in the place of a placement.

use leptos::prelude::*;

use super::flags::locks;
use super::session::use_session;
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::lab::Lab;
use crate::shown::ShownUnit;
use crate::texts::{say, tr};
use crate::widgets::{Choice, Segmented, Select};
use quadtank::control::Pairing;
use quadtank::literature::campestrini::PublishedPlant;
use quadtank::literature::wood_berry::PublishedControllers;
use quadtank::study::relay_tuning::{FormError, GivenPid, PidForm, TuningPlant, TuningSetup};
use quadtank_scenario::limits::{TUNING_NOT_NEGATIVE, TUNING_POSITIVE, TUNING_VALUE};

const PROPORTIONAL: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "given-kp1"), ("", "given-kp2")],
    label: |_, k| ["kp₁", "kp₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.given_proportional, number = k + 1),
    ..GAIN
};

const INTEGRAL_GAIN: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "given-ki1"), ("", "given-ki2")],
    label: |_, k| ["ki₁", "ki₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.given_integral_gain, number = k + 1),
    read: |s, k| given(s, k).integral_gain,
    write: |s, k, gain| change(s, k, |pid| pid.integral_gain = gain),
    path: |_, _| "design.controllers[].integral_gain",
    ..OF_LOOP
};

const DERIVATIVE_GAIN: ParamControl<TuningSetup> = ParamControl {
    ids: [("", "given-kd1"), ("", "given-kd2")],
    label: |_, k| ["kd₁", "kd₂"][k].to_owned(),
    name: |lab, k| tr!(lab, relay.given_derivative_gain, number = k + 1),
    read: |s, k| given(s, k).derivative_gain,
    write: |s, k, gain| change(s, k, |pid| set_derivative(pid, |pid| pid.derivative_gain = gain)),
    path: |_, _| "design.controllers[].derivative_gain",
    ..OF_LOOP
};

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
    write: |s, k, time| change(s, k, |pid| set_derivative(pid, |pid| pid.derivative_time = time)),
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
fn set_derivative(pid: &mut GivenPid, set: impl FnOnce(&mut GivenPid)) {
    set(pid);
    if [pid.derivative_time, pid.derivative_gain] == [0.0; 2] {
        pid.filter_time = None;
    }
}

/// The form that both controllers have, as the page gives them; that of the first where a document mixes them.
fn form_of(setup: &TuningSetup) -> PidForm {
    given(setup, 0).form
}

/// Whether a controller is in parallel form.
fn is_parallel(setup: &TuningSetup, index: usize) -> bool {
    given(setup, index).form == PidForm::Parallel
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
        ..pid
    }
}

/// The fields of both controllers.
#[component]
pub fn GivenControllers() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <FormChoice />
        <div class="pairs">
            <div class="controller"><ControllerFields index=0 /></div>
            <div class="controller"><ControllerFields index=1 /></div>
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

/// The fields of a controller in its form.
#[component]
fn ControllerFields(index: usize) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let shown_in = move |control: &'static ParamControl<TuningSetup>, parallel: bool| {
        let is_hidden = lab.throttled(session.part(move |s| is_parallel(s, index) != parallel));
        view! { <div hidden=is_hidden><ParamRow session control index /></div> }
    };
    let no_filter = lab.throttled(session.part(move |s| !given(s, index).has_derivative()));
    view! {
        {shown_in(&GAIN, false)}
        {shown_in(&PROPORTIONAL, true)}
        {shown_in(&INTEGRAL_TIME, false)}
        {shown_in(&INTEGRAL_GAIN, true)}
        {shown_in(&DERIVATIVE_TIME, false)}
        {shown_in(&DERIVATIVE_GAIN, true)}
        <div hidden=no_filter><ParamRow session control=&FILTER_TIME index /></div>
    }
}

/// The form of both controllers, which stay what they are in another one, and the formula of the form.
#[component]
fn FormChoice() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    // A refusal holds for the controllers that it is of.
    let refused = RwSignal::new(None::<([GivenPid; 2], FormError)>);
    let choose = move |form: PidForm| {
        let controllers = session.document.with_untracked(|s| s.tuning.design.controllers).unwrap_or_default();
        match in_form(controllers, form) {
            Ok(changed) => {
                refused.set(None);
                session.edit(|s| s.design.controllers = Some(changed));
            }
            Err(fault) => refused.set(Some((controllers, fault))),
        }
    };
    let formula = session.throttled_part(|s| match form_of(s) {
        PidForm::Isa => "K (1 + 1/(Ti s) + Td s/(Tf s + 1))",
        PidForm::Series => "K′ (1 + 1/(Ti′ s)) (1 + Td′ s)",
        PidForm::Parallel => "kp + ki/s + kd s/(Tf s + 1)",
    });
    let is_filtered = session.throttled_part(|s| form_of(s) == PidForm::Series && given(s, 0).has_derivative());
    let problem = move || {
        let controllers = session.document.with(|s| s.tuning.design.controllers);
        let (of, fault) = refused.get()?;
        (controllers == Some(of)).then(|| {
            view! { <p class="problem" role="alert" data-testid="form-problem">{of_fault(lab, fault)}</p> }
        })
    };
    view! {
        <Segmented
            label=say!(lab, relay.given_form)
            choices=vec![
                (PidForm::Isa, "form-isa", say!(lab, relay.form_isa)),
                (PidForm::Series, "form-series", say!(lab, relay.form_series)),
                (PidForm::Parallel, "form-parallel", say!(lab, relay.form_parallel)),
            ]
            value=lab.throttled(session.part(form_of))
            on_choose=choose
            disabled=lab.locks(locks::TARGET)
        />
        <p class="remark" data-testid="form-formula">
            {formula}
            {move || is_filtered.get().then(|| tr!(lab, relay.form_filtered))}
        </p>
        {problem}
    }
}

/// Both controllers in another form, within what a document holds.
fn in_form([first, second]: [GivenPid; 2], form: PidForm) -> Result<[GivenPid; 2], FormError> {
    Ok([first.in_form(form)?, second.in_form(form)?].map(within_limits))
}

/// Why a controller has not the form that was chosen.
fn of_fault(lab: Lab, fault: FormError) -> String {
    let number = |value: f64| lab.number_style().significant(value, 4);
    match fault {
        FormError::ComplexZeros { integral_time, derivative_time } => {
            tr!(lab, relay.form_complex, ti = number(integral_time), four_td = number(4.0 * derivative_time))
        }
        FormError::NoProportionalPart => tr!(lab, relay.form_no_gain),
        FormError::NegativeTime { time } => tr!(lab, relay.form_negative, time = number(time)),
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
        change(&mut setup, 1, |pid| set_derivative(pid, |pid| pid.derivative_time = 0.0));
        assert_eq!((given(&setup, 1).filter_time, given(&setup, 0).filter_time), (None, Some(0.3)));
    }
}

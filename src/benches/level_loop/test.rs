//! Steps 1 and 2: a step test by hand, and the model that is read from it.

use leptos::prelude::*;
use quadtank::literature::andreis;
use quadtank::study::level_loop::{LevelLoopSetup, ModelMatch, run_proportional_test};
use quadtank::tuning::ReactionMethod;
use quadtank_figure::Frame;
use quadtank_scenario::Limits;

use super::errors;
use super::flags::{locks, panels};
use super::pictures::{self, model_text, output_unit};
use super::process::{CENTIMETRES, LITRES};
use super::sentences;
use super::session::{Session, use_session};
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::shown::ShownUnit;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, ChartCanvas, ChartMenu, Scale, Sentence, Text, Tick, is_open, marked};

const START: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "test-inflow"), ("", "test-level")],
    label: |_, k| ["q₀", "h₀"][k].to_owned(),
    name: |lab, k| if k == 0 { tr!(lab, level.test_inflow) } else { tr!(lab, level.test_level) },
    path: |_, k| ["test.inflow", "test.level"][k],
    read: |s, k| [s.test.inflow, s.test.level][k],
    write: |s, k, value| *if k == 0 { &mut s.test.inflow } else { &mut s.test.level } = value,
    within: |_, _| Limits::NONE,
    digits: Some(1),
    scale: Some(Scale::Linear(0.1)),
    ..ParamControl::locked_by(locks::TEST)
};
const INFLOW: ParamControl<LevelLoopSetup> = ParamControl { shown_unit: Some(|_| LITRES), digits: Some(2), ..START };
const LEVEL: ParamControl<LevelLoopSetup> =
    ParamControl { shown_unit: Some(|_| CENTIMETRES), within: |s, _| Limits::new(0.0, s.plant().tank.height), ..START };
const STEP: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "test-step"); 2],
    label: |_, _| "Δm".to_owned(),
    name: |lab, _| tr!(lab, level.test_step),
    path: |_, _| "level_loop.test.step",
    read: |s, _| s.test.step,
    write: |s, _, step| s.test.step = step,
    digits: Some(2),
    scale: Some(Scale::Linear(0.05)),
    shown_unit: Some(|s| ShownUnit::called(output_unit(&s.plant()))),
    ..START
};
const DURATION: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "test-duration"); 2],
    label: |lab, _| tr!(lab, level.duration),
    name: |lab, _| tr!(lab, level.test_duration),
    path: |_, _| "level_loop.test.duration_s",
    read: |s, _| s.test.duration_s,
    write: |s, _, time| s.test.duration_s = time,
    within: |s, _| Limits::new(s.test.return_time_s.unwrap_or(s.test.step_time_s) * 1.05, f64::MAX),
    digits: Some(0),
    scale: Some(Scale::Linear(10.0)),
    shown_unit: Some(|_| ShownUnit::called("s")),
    ..START
};

/// Share of the time between the step and the end at which the output steps back.
const RETURN: f64 = 0.5;

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::self_regulating, terms::reaction_curve, terms::process_gain, terms::half_rule];

/// The test and the model.
#[component]
pub fn TestCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = pictures::test(session);
    let for_menu = picture.clone();
    let title = say!(lab, level.test_title);
    let found = Memo::new(move |_| sentence(session));
    let summary = Signal::derive(move || found.get().1);
    view! {
        <Card
            name="step-test"
            panel=panels::TEST
            title
            terms=TERMS
            beside=move || view! { <Places /> <ChartMenu picture=for_menu file="step-test" title /> }
        >
            <div class="chart"><ChartCanvas picture frames summary name="step-test-chart" steady=true /></div>
            <div class="pairs">
                <ParamRow session control=&INFLOW index=0 />
                <ParamRow session control=&LEVEL index=1 />
                <ParamRow session control=&STEP />
                <ParamRow session control=&DURATION />
            </div>
            <div class="toolbar">
                <MethodSwitch />
                <Tick
                    id="test-return"
                    text=say!(lab, level.step_back)
                    ticked=lab.throttled(session.part(|s| s.test.return_time_s.is_some()))
                    disabled=lab.locks(locks::TEST)
                    on_tick=move |back| session.edit(|s| set_return(s, back))
                />
            </div>
            <Sentence
                id="test-sentence"
                warm=Signal::derive(move || !found.get().0)
                text=Signal::derive(move || found.get().1)
            />
            <ProportionalTest />
        </Card>
    }
}

fn set_return(setup: &mut LevelLoopSetup, back: bool) {
    let test = &mut setup.test;
    let half = test.step_time_s + RETURN * (test.duration_s - test.step_time_s);
    test.return_time_s = back.then_some(half);
}

/// Where the test is made: where the source made it, or where the loop works.
#[component]
fn Places() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let is_here = session.part(|s| (s.test.level, s.test.inflow) == (s.experiment.level, s.experiment.inflow));
    let here = move |_| session.edit(|s| (s.test.level, s.test.inflow) = (s.experiment.level, s.experiment.inflow));
    let there = move |_| {
        session.edit(|s| (s.test.level, s.test.inflow) = (andreis::NOMINAL_LEVEL, andreis::STEP_TEST_INFLOW));
    };
    let is_there =
        session.part(|s| (s.test.level, s.test.inflow) == (andreis::NOMINAL_LEVEL, andreis::STEP_TEST_INFLOW));
    let of_source = session.part(|s| !s.published_tunings().is_empty());
    view! {
        <div class="toolbar">
            <button
                type="button"
                class="button small"
                data-testid="test-there"
                hidden=move || !of_source.get()
                aria-pressed=move || is_there.get().to_string()
                disabled=lab.locks(locks::TEST)
                on:click=there
            >
                {say!(lab, level.test_there)}
            </button>
            <button
                type="button"
                class="button small"
                data-testid="test-here"
                aria-pressed=move || is_here.get().to_string()
                disabled=lab.locks(locks::TEST)
                on:click=here
            >
                {say!(lab, level.test_here)}
            </button>
        </div>
    }
}

/// How a curve is read, by its name alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Method {
    OnePoint,
    TwoPoint,
    Ramp,
}

#[component]
fn MethodSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <Switch
            session
            label=say!(lab, level.method)
            choices=vec![
                (Method::OnePoint, "test-one-point", say!(lab, level.one_point)),
                (Method::TwoPoint, "test-two-point", say!(lab, level.two_point)),
                (Method::Ramp, "test-ramp", say!(lab, level.ramp)),
            ]
            read=|s| match s.test.method {
                ReactionMethod::OnePoint { .. } => Method::OnePoint,
                ReactionMethod::TwoPoint => Method::TwoPoint,
                ReactionMethod::Ramp => Method::Ramp,
            }
            write=|s, method| {
                s.test.method = match method {
                    Method::OnePoint => ReactionMethod::OnePoint { dead_time_s: 0.0 },
                    Method::TwoPoint => ReactionMethod::TwoPoint,
                    Method::Ramp => ReactionMethod::Ramp,
                };
            }
            lock=locks::TEST
        />
    }
}

/// The test with proportional control alone, which needs no open loop.
#[component]
fn ProportionalTest() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let open = RwSignal::new(false);
    let text = move || {
        let setup = session.throttled.setup.get();
        let gain = setup.pi_tuning().map_or(USUAL_GAIN, |tuning| tuning.gain);
        let verdict = match run_proportional_test(&setup, gain) {
            Ok(Ok(regulation)) => sentences::of_regulation(lab, regulation),
            Ok(Err(error)) => errors::of_record(lab, error),
            Err(error) => tr!(lab, level.no_test, reason = errors::of_run(lab, &error)),
        };
        tr!(lab, level.proportional_test, gain = lab.number_style().significant(gain, 3), verdict = verdict)
    };
    view! {
        <details class="more" on:toggle=move |event| open.set(is_open(&event))>
            <summary data-testid="p-only">{say!(lab, level.p_only)}</summary>
            <p class="sentence" data-testid="p-only-verdict">{move || open.get().then(|| marked(&text()))}</p>
        </details>
    }
}

/// Gain of that test where the controller has none.
const USUAL_GAIN: f64 = 5.0;

/// The model of the test beside that around the operating point, and what kind of process it is.
fn sentence(session: Session) -> (bool, String) {
    let lab = session.lab;
    let test = session.throttled.test.get();
    let test = match test.as_ref() {
        Ok(test) => test,
        Err(fault) => return (false, tr!(lab, level.no_test, reason = errors::of_test(lab, fault))),
    };
    let (mut good, model) = match &test.fit {
        Ok(fit) => (true, tr!(lab, level.test_model, model = model_text(lab, &fit.model))),
        Err(error) => (false, tr!(lab, level.no_test_model, reason = errors::of_reaction(lab, error))),
    };
    let mut parts = vec![model];
    let local = session.throttled.plant.get();
    if let Ok(plant) = local.as_ref()
        && let Some(found) = ModelMatch::of(test, plant)
    {
        let style = lab.number_style();
        let (tested, here) = (style.significant(found.tested, 3), style.significant(found.here, 3));
        let (model, ratio) = (model_text(lab, &plant.model), style.fixed(found.ratio(), 1));
        parts.push(tr!(lab, level.local_model, model = model, tested = tested, here = here, ratio = ratio));
        if !found.suits() {
            good = false;
            parts.push(tr!(lab, level.wrong_point));
        }
    }
    match test.regulation {
        Some(Ok(regulation)) => parts.push(sentences::of_regulation(lab, regulation)),
        Some(Err(error)) => parts.push(errors::of_record(lab, error)),
        None => {}
    }
    (good, parts.join(" "))
}

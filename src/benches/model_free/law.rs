//! The law: ultra-local model, feedback, estimator.

use leptos::prelude::*;

use super::flags::{locks, panels};
use super::sentences::{self, CM_PER_M};
use super::session::use_session;
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::shown::ShownUnit;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Scale, Sentence, Text};
use quadtank::control::{
    EstimatorSettings, FedWith, MAX_WINDOW_SAMPLES, ModelFreeAntiWindup, ModelFreeSettings, Pairing, Quadrature, Window,
};
use quadtank::study::model_free::ModelFreeSetup;
use quadtank_scenario::{Limits, limits};

/// Back-calculation when it is chosen.
const BACK_CALCULATION: ModelFreeAntiWindup = ModelFreeAntiWindup::BackCalculation { tracking_time_s: 10.0 };
/// Samples of a window when the estimator is switched on.
const USUAL_SAMPLES: f64 = 10.0;

const MODEL_GAIN: ParamControl<ModelFreeSetup> = ParamControl {
    ids: [("free-alpha", "free-alpha-number"); 2],
    label: |_, _| "α̂".to_owned(),
    name: |lab, _| tr!(lab, free.alpha),
    path: |_, _| "controller.loops[].model_gain",
    read: |s, _| s.controller.loops[0].model_gain,
    write: |s, _, gain| in_both(s, &|l| l.model_gain = gain),
    travel: Some(|_| (0.02, 1.0)),
    shown_unit: Some(|_| ShownUnit { name: "cm/(s V)", per_unit: CM_PER_M }),
    ..ParamControl::locked_by(locks::GAINS)
};
const PROPORTIONAL: ParamControl<ModelFreeSetup> = ParamControl {
    ids: [("free-kp", "free-kp-number"); 2],
    label: |_, _| "Kp".to_owned(),
    name: |lab, _| tr!(lab, free.kp),
    path: |_, _| "controller.loops[].proportional",
    read: |s, _| s.controller.loops[0].proportional,
    write: |s, _, gain| in_both(s, &|l| l.proportional = gain),
    travel: Some(|_| (0.05, 20.0)),
    ..ParamControl::locked_by(locks::GAINS)
};
const INTEGRAL: ParamControl<ModelFreeSetup> = ParamControl {
    ids: [("free-ki", "free-ki-number"); 2],
    label: |_, _| "Ki".to_owned(),
    name: |lab, _| tr!(lab, free.ki),
    path: |_, _| "controller.loops[].integral",
    read: |s, _| s.controller.loops[0].integral,
    write: |s, _, gain| in_both(s, &|l| l.integral = gain),
    travel: Some(|_| (0.001, 2.0)),
    ..ParamControl::locked_by(locks::GAINS)
};
const WINDOW: ParamControl<ModelFreeSetup> = ParamControl {
    ids: [("", "free-window"); 2],
    label: |_, _| "T".to_owned(),
    name: |lab, _| tr!(lab, free.window),
    read: |s, _| estimator(s).map_or(USUAL_SAMPLES * s.controller.sampling_time_s, |e| e.window_s),
    write: |s, _, window_s| with_estimator(s, |e| e.window_s = window_s),
    path: |_, _| "controller.estimator.window_s",
    within: |s, _| {
        let samples = |count: f64| count * s.controller.sampling_time_s;
        Limits::new(samples(2.0), samples(MAX_WINDOW_SAMPLES as f64))
    },
    grid: |s| s.controller.sampling_time_s,
    matters: Some(|s| s.controller.estimator.is_some()),
    ..ParamControl::locked_by(locks::GAINS)
};
const SAMPLING: ParamControl<ModelFreeSetup> = ParamControl {
    ids: [("", "free-sampling"); 2],
    label: |_, _| "Ts".to_owned(),
    name: |lab, _| tr!(lab, pi.sampling),
    read: |s, _| s.controller.sampling_time_s,
    write: |s, _, time_s| s.controller = s.controller.with_sampling_time(time_s),
    path: |_, _| "controller.sampling_time_s",
    within: |s, _| limits::sampling_time_s(s.experiment.duration_s),
    scale: Some(Scale::Linear(0.1)),
    ..ParamControl::locked_by(locks::SAMPLING)
};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::local_model, terms::estimate, terms::alpha, terms::windup];

/// The settings of the law.
#[component]
pub fn LawCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let windows = vec![
        (None, "free-off", say!(lab, free.off)),
        (Some(Window::Block), "free-block", say!(lab, free.block)),
        (Some(Window::Sliding), "free-sliding", say!(lab, free.sliding)),
    ];
    let windups = vec![
        (ModelFreeAntiWindup::Off, "free-windup", say!(lab, free.windup_off)),
        (ModelFreeAntiWindup::Conditional, "free-conditional", say!(lab, free.conditional)),
        (BACK_CALCULATION, "free-back", say!(lab, free.back_calculation)),
    ];
    let pairings = vec![
        (Pairing::Diagonal, "free-diagonal", say!(lab, pi.diagonal)),
        (Pairing::Swapped, "free-swapped", say!(lab, pi.swapped)),
    ];
    let stability = Memo::new(move |_| sentences::of_loop(session));
    let lock = locks::GAINS;
    view! {
        <Card name="law" panel=panels::CONTROLLER terms=TERMS title=say!(lab, free.law)>
            <div class="formula">{formula()}</div>
            <ParamRow session control=&MODEL_GAIN />
            <ParamRow session control=&PROPORTIONAL />
            <ParamRow session control=&INTEGRAL />
            <Switch
                session
                label=say!(lab, free.estimator)
                choices=windows
                read=|s| estimator(s).map(|estimator| estimator.window)
                write=set_window
                lock
            />
            <div hidden=session.throttled_part(|s| s.controller.estimator.is_none()) class="estimator"><EstimatorDetails /></div>
            <div class="pairs">
                <ParamRow session control=&WINDOW />
                <ParamRow session control=&SAMPLING />
            </div>
            <Switch
                session
                label=say!(lab, free.windup)
                choices=windups
                read=windup_of
                write=|s, windup| in_both(s, &|l| l.anti_windup = windup)
                lock
            />
            <Switch
                session
                label=say!(lab, pi.pairing)
                choices=pairings
                read=|s| s.controller.pairing
                write=|s, pairing| s.controller.pairing = pairing
                lock=locks::PAIRING
            />
            <Sentence
                id="free-stability"
                text=Signal::derive(move || stability.get().1)
                warm=Signal::derive(move || !stability.get().0)
                status=true
            />
        </Card>
    }
}

/// The law, eqs. 16 and 17 of the paper.
fn formula() -> impl IntoView {
    view! {
        <math>
            <mi>"v"</mi>
            <mo>"="</mo>
            <mfrac>
                <mrow>
                    <mo>"−"</mo>
                    <mover><mi>"φ"</mi><mo>"^"</mo></mover>
                    <mo>"+"</mo>
                    <msub><mi>"K"</mi><mi>"p"</mi></msub>
                    <mi>"e"</mi>
                    <mo>"+"</mo>
                    <msub><mi>"K"</mi><mi>"i"</mi></msub>
                    <mo>"∫"</mo>
                    <mi>"e"</mi>
                </mrow>
                <mover><mi>"α"</mi><mo>"^"</mo></mover>
            </mfrac>
        </math>
    }
}

/// How the estimator sums, and which voltage it is fed with.
#[component]
fn EstimatorDetails() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let sums = vec![
        (Quadrature::Rectangular, "free-rectangular", say!(lab, free.rectangular)),
        (Quadrature::Trapezoidal, "free-trapezoidal", say!(lab, free.trapezoidal)),
    ];
    let feeds = vec![
        (FedWith::Applied, "free-applied", say!(lab, free.applied)),
        (FedWith::Commanded, "free-commanded", say!(lab, free.commanded)),
    ];
    let lock = locks::GAINS;
    view! {
        <Switch
            session
            label=say!(lab, free.sum)
            choices=sums
            read=|s| estimator(s).map_or(Quadrature::Rectangular, |e| e.quadrature)
            write=|s, quadrature| with_estimator(s, |e| e.quadrature = quadrature)
            lock
        />
        <Switch
            session
            label=say!(lab, free.fed_with)
            choices=feeds
            read=|s| estimator(s).map_or(FedWith::Applied, |e| e.fed_with)
            write=|s, fed_with| with_estimator(s, |e| e.fed_with = fed_with)
            lock
        />
    }
}

/// Both loops have the same settings.
fn in_both(setup: &mut ModelFreeSetup, change: &dyn Fn(&mut ModelFreeSettings)) {
    setup.controller.loops.iter_mut().for_each(change);
}

fn estimator(setup: &ModelFreeSetup) -> Option<EstimatorSettings> {
    setup.controller.estimator
}

fn with_estimator(setup: &mut ModelFreeSetup, change: impl FnOnce(&mut EstimatorSettings)) {
    if let Some(estimator) = &mut setup.controller.estimator {
        change(estimator);
    }
}

fn set_window(setup: &mut ModelFreeSetup, window: Option<Window>) {
    let first = |window| EstimatorSettings {
        window_s: USUAL_SAMPLES * setup.controller.sampling_time_s,
        window,
        quadrature: Quadrature::Rectangular,
        fed_with: FedWith::Applied,
    };
    setup.controller.estimator =
        window.map(|window| EstimatorSettings { window, ..estimator(setup).unwrap_or_else(|| first(window)) });
}

/// The protection against windup; the tracking time of back-calculation is not chosen here.
fn windup_of(setup: &ModelFreeSetup) -> ModelFreeAntiWindup {
    match setup.controller.loops[0].anti_windup {
        ModelFreeAntiWindup::BackCalculation { .. } => BACK_CALCULATION,
        other => other,
    }
}

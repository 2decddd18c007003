//! Steps 3 and 4: what the loop is for, and how it is tuned for that.

use leptos::prelude::*;
use quadtank::control::AntiWindup;
use quadtank::sim::level::LevelController;
use quadtank::study::level_loop::{ControllerKind, LevelLoopSetup, Objective, PiTuning};
use quadtank_scenario::Limits;
use quadtank_scenario::level_loop::within_limits;

use super::flags::{locks, panels};
use super::process::CENTIMETRES;
use super::rules::Rules;
use super::session::use_session;
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::shown::ShownUnit;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Scale, Segmented, Text, Tick};

const GAIN: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("level-gain", "level-gain-number"); 2],
    label: |_, _| "Kp".to_owned(),
    name: |lab, _| tr!(lab, level.gain),
    path: |s, _| match s.controller {
        LevelController::Sampled { .. } => "controller.sampled.settings.gain",
        _ => "controller.pi.gain",
    },
    read: |s, _| s.controller.pi_tuning().map_or(f64::NAN, |tuning| tuning.gain),
    write: |s, _, gain| set_tuning(s, |(_, time)| (gain, time)),
    within: |_, _| Limits::NONE,
    travel: Some(|_| (0.05, 200.0)),
    scale: Some(Scale::Logarithmic),
    shown_unit: Some(|_| ShownUnit::called("")),
    ..ParamControl::locked_by(locks::GAINS)
};
const TIME: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("level-time", "level-time-number"); 2],
    label: |_, _| "Ti".to_owned(),
    name: |lab, _| tr!(lab, level.integral_time),
    path: |s, _| match s.controller {
        LevelController::Sampled { .. } => "controller.sampled.settings.integral_time_s",
        _ => "controller.pi.integral_time_s",
    },
    read: |s, _| s.controller.pi_tuning().map_or(f64::NAN, |tuning| tuning.integral_time_s),
    write: |s, _, time| set_tuning(s, |(gain, _)| (gain, time)),
    travel: Some(|_| (0.6, 6000.0)),
    shown_unit: Some(|_| ShownUnit::called("s")),
    ..GAIN
};
/// P of a parallel PID; I and D follow as a pair.
const PROPORTIONAL: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("level-p", "level-p-number"); 2],
    label: |_, _| "P".to_owned(),
    name: |lab, _| tr!(lab, level.proportional),
    path: |_, _| "controller.pid.proportional",
    read: |s, _| pid(s)[0],
    write: |s, _, value| set_pid(s, 0, value),
    travel: Some(|_| (0.0, 50.0)),
    scale: Some(Scale::Linear(0.1)),
    digits: Some(2),
    ..GAIN
};
const ACTION: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("level-i", "level-i-number"), ("level-d", "level-d-number")],
    label: |_, k| ["I", "D"][k].to_owned(),
    name: |lab, k| if k == 0 { tr!(lab, level.integral) } else { tr!(lab, level.derivative) },
    path: |_, k| ["controller.pid.integral", "controller.pid.derivative"][k],
    read: |s, k| pid(s)[k + 1],
    write: |s, k, value| set_pid(s, k + 1, value),
    ..PROPORTIONAL
};
const INTEGRAL: ParamControl<LevelLoopSetup> =
    ParamControl { shown_unit: Some(|_| ShownUnit { name: "1/min", per_unit: 60.0 }), ..ACTION };
const DERIVATIVE: ParamControl<LevelLoopSetup> = ParamControl {
    shown_unit: Some(|_| ShownUnit { name: "min", per_unit: 1.0 / 60.0 }),
    travel: Some(|_| (0.0, 10.0)),
    ..ACTION
};
const SAMPLING: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "level-sampling"); 2],
    label: |_, _| "Ts".to_owned(),
    name: |lab, _| tr!(lab, level.sampling_time),
    path: |_, _| "controller.sampled.sampling_time_s",
    read: |s, _| match s.controller {
        LevelController::Sampled { sampling_time_s, .. } => sampling_time_s,
        _ => f64::NAN,
    },
    write: |s, _, time| {
        if let LevelController::Sampled { sampling_time_s, .. } = &mut s.controller {
            *sampling_time_s = time;
        }
    },
    travel: None,
    ..TIME
};
/// Ends of the band of averaging control.
const BAND: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "level-band-low"), ("", "level-band-high")],
    label: |lab, k| if k == 0 { tr!(lab, level.band_low) } else { tr!(lab, level.band_high) },
    name: |lab, k| if k == 0 { tr!(lab, level.band_low_name) } else { tr!(lab, level.band_high_name) },
    path: |_, _| "objective.averaging.band[]",
    read: |s, k| band(s).map_or(f64::NAN, |band| band[k]),
    write: |s, k, level| {
        if let Objective::Averaging { band } = &mut s.objective {
            band[k] = level;
        }
    },
    within: |s, k| {
        let [low, high] = band(s).unwrap_or_default();
        if k == 0 { Limits::new(0.0, high - NARROWEST) } else { Limits::new(low + NARROWEST, s.plant().tank.height) }
    },
    digits: Some(1),
    scale: Some(Scale::Linear(0.5)),
    travel: None,
    shown_unit: Some(|_| CENTIMETRES),
    matters: Some(|s| band(s).is_some()),
    ..ParamControl::locked_by(locks::OBJECTIVE)
};

/// Narrowest band (m).
const NARROWEST: f64 = 0.01;

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[
    terms::tight,
    terms::averaging,
    terms::gain_of_signals,
    terms::integral_time,
    terms::level_windup,
    terms::simc,
    terms::lambda,
    terms::amigo,
    terms::search_box,
];

/// Objective and tuning.
#[component]
pub fn TuningCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <Card name="tuning" panel=panels::CONTROLLER title=say!(lab, level.tuning_title) terms=TERMS>
            <ObjectiveSwitch />
            <KindSwitch />
            <Dials />
            <Rules />
        </Card>
    }
}

fn band(setup: &LevelLoopSetup) -> Option<[f64; 2]> {
    match setup.objective {
        Objective::Averaging { band } => Some(band),
        Objective::Tight => None,
    }
}

/// Tight or averaging, with the band of the latter.
#[component]
fn ObjectiveSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let is_tight = session.part(|s| s.objective == Objective::Tight);
    view! {
        <Switch
            session
            label=say!(lab, level.objective)
            choices=vec![
                (true, "objective-tight", say!(lab, level.tight)),
                (false, "objective-averaging", say!(lab, level.averaging)),
            ]
            read=|s| s.objective == Objective::Tight
            write=|s, tight| {
                let objective = if tight { Objective::Tight } else { Objective::Averaging { band: s.usual_band() } };
                s.set_objective(objective);
            }
            lock=locks::OBJECTIVE
        />
        <p class="remark">
            {move || if is_tight.get() { tr!(lab, level.tight_remark) } else { tr!(lab, level.averaging_remark) }}
        </p>
        <div class="pairs" hidden=move || is_tight.get()>
            <ParamRow session control=&BAND index=0 />
            <ParamRow session control=&BAND index=1 />
        </div>
    }
}

/// Gain and integral time with which a kind of controller begins where there was none before.
const USUAL: PiTuning = PiTuning { gain: 2.0, integral_time_s: 120.0 };

/// Changes the kind of the controller; settings that the present one lacks come from `kept`.
fn set_kind(setup: &mut LevelLoopSetup, kind: ControllerKind, kept: PiTuning) {
    setup.set_controller_kind(kind, kept);
    setup.controller = within_limits(setup.controller.clone());
}

/// Which kind of controller there is. The tuning of the last PI controller is kept for the way back from none.
#[component]
fn KindSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let kept = StoredValue::new(USUAL);
    let choose = move |kind: ControllerKind| {
        if let Some(now) = session.document.with_untracked(|document| document.level_loop.controller.pi_tuning()) {
            kept.set_value(now);
        }
        session.edit(|s| set_kind(s, kind, kept.get_value()));
    };
    view! {
        <Segmented
            label=say!(lab, level.controller)
            choices=vec![
                (ControllerKind::Pi, "kind-pi", say!(lab, level.kind_pi)),
                (ControllerKind::Sampled, "kind-sampled", say!(lab, level.kind_sampled)),
                (ControllerKind::Pid, "kind-pid", say!(lab, level.kind_pid)),
                (ControllerKind::Off, "kind-off", say!(lab, level.kind_off)),
            ]
            value=lab.throttled(session.part(|s| ControllerKind::of(&s.controller)))
            on_choose=choose
            disabled=lab.locks(locks::GAINS)
        />
    }
}

/// The dials of the controller.
#[component]
fn Dials() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let kind = session.part(|s| ControllerKind::of(&s.controller));
    let dials = move || match kind.get() {
        ControllerKind::Pi => view! {
            <ParamRow session control=&GAIN />
            <ParamRow session control=&TIME />
            <WindupTick />
        }
        .into_any(),
        ControllerKind::Sampled => view! {
            <ParamRow session control=&GAIN />
            <ParamRow session control=&TIME />
            <ParamRow session control=&SAMPLING />
            <WindupTick />
        }
        .into_any(),
        ControllerKind::Pid => view! {
            <ParamRow session control=&PROPORTIONAL />
            <ParamRow session control=&INTEGRAL index=0 />
            <ParamRow session control=&DERIVATIVE index=1 />
        }
        .into_any(),
        ControllerKind::Off => view! { <p class="remark">{say!(lab, level.off_remark)}</p> }.into_any(),
    };
    view! { <div class="dials">{dials}</div> }
}

#[component]
fn WindupTick() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let set = move |on: bool| {
        let anti_windup = if on { AntiWindup::BackCalculation { tracking_ratio: 0.5 } } else { AntiWindup::Off };
        session.edit(|s| match &mut s.controller {
            LevelController::Pi { anti_windup: of_pi, .. } => *of_pi = anti_windup,
            LevelController::Sampled { settings, .. } => settings.anti_windup = anti_windup,
            LevelController::Manual { .. } | LevelController::Pid { .. } => {}
        });
    };
    view! {
        <Tick
            id="level-windup"
            text=say!(lab, level.anti_windup)
            ticked=lab.throttled(session.part(|s| s.anti_windup() != AntiWindup::Off))
            disabled=lab.locks(locks::GAINS)
            on_tick=set
        />
    }
}

fn set_tuning(setup: &mut LevelLoopSetup, change: impl FnOnce((f64, f64)) -> (f64, f64)) {
    match &mut setup.controller {
        LevelController::Pi { gain, integral_time_s, .. } => {
            (*gain, *integral_time_s) = change((*gain, *integral_time_s));
        }
        LevelController::Sampled { settings, .. } => {
            (settings.gain, settings.integral_time_s) = change((settings.gain, settings.integral_time_s));
        }
        LevelController::Manual { .. } | LevelController::Pid { .. } => {}
    }
}

/// P, I and D of a parallel PID controller; 0 for any other.
const fn pid(setup: &LevelLoopSetup) -> [f64; 3] {
    match setup.controller {
        LevelController::Pid { proportional, integral, derivative, .. } => [proportional, integral, derivative],
        _ => [0.0; 3],
    }
}

fn set_pid(setup: &mut LevelLoopSetup, which: usize, value: f64) {
    if let LevelController::Pid { proportional, integral, derivative, .. } = &mut setup.controller {
        *[proportional, integral, derivative][which] = value;
    }
}

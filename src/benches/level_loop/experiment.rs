//! What is done to the loop: a disturbance of the inflow, and steps of the set-point.

use leptos::prelude::*;
use quadtank::literature::andreis::PublishedDisturbance;
use quadtank::sim::level::{InflowSignal, SetPointScale, SignalStep};
use quadtank::study::level_loop::{LevelLoopSetup, OwnDisturbance};
use quadtank_scenario::Limits;

use super::flags::{locks, panels};
use super::pictures::unit_of;
use super::process::{CENTIMETRES, LITRES};
use super::session::use_session;
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::lab::Lab;
use crate::shown::ShownUnit;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Choice, Scale, Select, Text};

/// How large a disturbance is: amplitude, step or standard deviation.
const SIZE: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("level-size", "level-size-number"); 2],
    label: |_, _| "Δq".to_owned(),
    name: |lab, _| tr!(lab, level.disturbance_size),
    path: |s, _| match s.experiment.disturbance.signal {
        InflowSignal::None => "",
        InflowSignal::Step { .. } => "experiment.disturbance.signal.step.size",
        InflowSignal::Sine { .. } => "experiment.disturbance.signal.sine.amplitude",
        InflowSignal::SimulinkNormal { .. } => "experiment.disturbance.signal.simulink_normal.std",
        InflowSignal::Normal { .. } => "experiment.disturbance.signal.normal.std",
    },
    read: |s, _| size(&s.experiment.disturbance.signal),
    write: |s, _, size| set_size(&mut s.experiment.disturbance.signal, size),
    within: |_, _| Limits::NONE,
    travel: Some(|s| {
        let most = 1e3 * s.plant().flows(s.experiment.level, 1.0)[1];
        let least = if matches!(s.experiment.disturbance.signal, InflowSignal::Step { .. }) { -most } else { 0.0 };
        (least, most)
    }),
    scale: Some(Scale::Linear(0.01)),
    digits: Some(2),
    shown_unit: Some(|_| LITRES),
    matters: Some(|s| s.experiment.disturbance.signal != InflowSignal::None),
    ..ParamControl::locked_by(locks::EXPERIMENT)
};
/// Period of a sine, or how long a random value is held.
const PERIOD: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("level-period", "level-period-number"); 2],
    label: |_, _| "T".to_owned(),
    name: |lab, _| tr!(lab, level.disturbance_period),
    path: |s, _| match s.experiment.disturbance.signal {
        InflowSignal::None | InflowSignal::Step { .. } => "",
        InflowSignal::Sine { .. } => "experiment.disturbance.signal.sine.period_s",
        InflowSignal::SimulinkNormal { .. } => "experiment.disturbance.signal.simulink_normal.sample_time_s",
        InflowSignal::Normal { .. } => "experiment.disturbance.signal.normal.sample_time_s",
    },
    read: |s, _| period(&s.experiment.disturbance.signal).unwrap_or(f64::NAN),
    write: |s, _, time| set_period(&mut s.experiment.disturbance.signal, time),
    travel: Some(|_| (1.0, 500.0)),
    scale: Some(Scale::Logarithmic),
    digits: None,
    shown_unit: Some(|_| ShownUnit::called("s")),
    matters: Some(|s| period(&s.experiment.disturbance.signal).is_some()),
    ..SIZE
};
/// From when to when it acts.
const GATE: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "level-from"), ("", "level-until")],
    label: |lab, k| if k == 0 { tr!(lab, level.from) } else { tr!(lab, level.until) },
    name: |lab, k| if k == 0 { tr!(lab, level.from_name) } else { tr!(lab, level.until_name) },
    path: |_, k| ["experiment.disturbance.from_s", "experiment.disturbance.until_s"][k],
    read: |s, k| [s.experiment.disturbance.from_s, s.experiment.disturbance.until_s][k],
    write: |s, k, time| {
        let disturbance = &mut s.experiment.disturbance;
        *if k == 0 { &mut disturbance.from_s } else { &mut disturbance.until_s } = time;
    },
    within: |s, k| {
        let disturbance = &s.experiment.disturbance;
        if k == 0 { Limits::new(0.0, disturbance.until_s) } else { Limits::new(disturbance.from_s, f64::MAX) }
    },
    travel: None,
    digits: Some(0),
    scale: Some(Scale::Linear(1.0)),
    matters: Some(|s| s.experiment.disturbance.signal != InflowSignal::None),
    ..PERIOD
};
/// How long the run lasts.
const DURATION: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "level-duration"); 2],
    label: |lab, _| tr!(lab, level.duration),
    name: |lab, _| tr!(lab, experiment.duration_name),
    path: |_, _| "level_loop.experiment.duration_s",
    read: |s, _| s.experiment.duration_s,
    write: |s, _, time| s.experiment.duration_s = time,
    within: |s, _| Limits::new(2.0 * s.experiment.log_step_s, f64::MAX),
    matters: None,
    ..GATE
};
/// The first step of the set-point, at the beginning.
const SET_POINT: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "level-set-point"); 2],
    label: |_, _| "Δr".to_owned(),
    name: |lab, _| tr!(lab, level.set_point_step),
    path: |_, _| "level_loop.experiment.set_point_steps[].size",
    read: |s, _| s.experiment.set_point_steps.first().map_or(0.0, |step| step.size),
    write: |s, _, size| set_step(s, size),
    within: |_, _| Limits::NONE,
    digits: Some(2),
    scale: Some(Scale::Linear(0.1)),
    shown_unit: Some(|s| match s.experiment.set_point_scale {
        SetPointScale::Level => CENTIMETRES,
        SetPointScale::Signal => ShownUnit::called(unit_of(s.plant().transmitter.signal.unit)),
    }),
    matters: None,
    ..GATE
};

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::disturbance, terms::sine, terms::random, terms::reference];

/// The disturbance and the set-point.
#[component]
pub fn ExperimentCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <Card name="experiment" panel=panels::EXPERIMENT title=say!(lab, level.experiment) terms=TERMS>
            <DisturbanceSelect />
            <ParamRow session control=&SIZE />
            <ParamRow session control=&PERIOD />
            <div class="pairs">
                <ParamRow session control=&GATE index=0 />
                <ParamRow session control=&GATE index=1 />
                <ParamRow session control=&DURATION />
                <ParamRow session control=&SET_POINT />
            </div>
            <Switch
                session
                label=say!(lab, level.set_point_scale)
                choices=vec![
                    (SetPointScale::Level, "level-scale-level", say!(lab, level.scale_level)),
                    (SetPointScale::Signal, "level-scale-signal", say!(lab, level.scale_signal)),
                ]
                read=|s| s.experiment.set_point_scale
                write=|s, scale| s.experiment.set_point_scale = scale
                lock=locks::EXPERIMENT
            />
            <p class="remark" data-testid="level-scale-remark">{move || scale_remark(lab)}</p>
        </Card>
    }
}

/// What a step of a size means in the unit that was not chosen.
fn scale_remark(lab: Lab) -> String {
    let session = use_session();
    let style = lab.number_style();
    session.throttled.setup.with(|setup| {
        let gain = setup.plant().transmitter.gain();
        let unit = unit_of(setup.plant().transmitter.signal.unit);
        let step = setup.experiment.set_point_steps.first().map_or(0.0, |step| step.size);
        let (metres, signal) = match setup.experiment.set_point_scale {
            SetPointScale::Level => (step, gain * step),
            SetPointScale::Signal => (step / gain, step),
        };
        let (cm, signal) = (style.significant(100.0 * metres, 3), style.significant(signal, 3));
        let gain = style.significant(gain, 3);
        tr!(lab, level.scale_remark, gain = gain, unit = unit, cm = cm, signal = signal)
    })
}

/// A kind of disturbance that can be chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Published(PublishedDisturbance),
    Own(OwnDisturbance),
}

impl Kind {
    fn of(setup: &LevelLoopSetup) -> Self {
        if let Some(known) = setup.published_disturbance() {
            return Self::Published(known);
        }
        Self::Own(OwnDisturbance::of(&setup.experiment.disturbance.signal))
    }

    fn choice(self, lab: Lab) -> Choice<Self> {
        let (name, text) = match self {
            Self::Published(PublishedDisturbance::SineL) => ("sine-l", tr!(lab, level.sine_l)),
            Self::Published(PublishedDisturbance::SineH) => ("sine-h", tr!(lab, level.sine_h)),
            Self::Published(PublishedDisturbance::Random) => ("random", tr!(lab, level.random)),
            Self::Own(OwnDisturbance::Step) => ("step", tr!(lab, level.inflow_step)),
            Self::Own(OwnDisturbance::Sine) => ("sine", tr!(lab, level.own_sine)),
            Self::Own(OwnDisturbance::Random) => ("own-random", tr!(lab, level.own_random)),
            Self::Own(OwnDisturbance::None) => ("none", tr!(lab, level.no_disturbance)),
        };
        Choice::new(self, name, text)
    }

    fn take_up(self, setup: &mut LevelLoopSetup) {
        match self {
            Self::Published(known) => setup.set_published_disturbance(known),
            Self::Own(kind) => setup.set_own_disturbance(kind),
        }
    }
}

#[component]
fn DisturbanceSelect() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let chosen = session.part(Kind::of);
    let choices = Signal::derive(move || {
        let published = PublishedDisturbance::ALL.map(Kind::Published);
        let all = published.into_iter().chain(OwnDisturbance::ALL.map(Kind::Own));
        all.map(|kind| kind.choice(lab)).collect::<Vec<_>>()
    });
    view! {
        <Select
            id="level-disturbance"
            name=say!(lab, level.experiment)
            choices
            chosen
            on_choose=move |kind: Kind| session.edit(|setup| kind.take_up(setup))
            disabled=lab.locks(locks::EXPERIMENT)
        />
    }
}

const fn size(signal: &InflowSignal) -> f64 {
    match *signal {
        InflowSignal::None => 0.0,
        InflowSignal::Step { size } => size,
        InflowSignal::Sine { amplitude, .. } => amplitude,
        InflowSignal::SimulinkNormal { std, .. } | InflowSignal::Normal { std, .. } => std,
    }
}

const fn set_size(signal: &mut InflowSignal, value: f64) {
    match signal {
        InflowSignal::None => {}
        InflowSignal::Step { size } => *size = value,
        InflowSignal::Sine { amplitude, .. } => *amplitude = value,
        InflowSignal::SimulinkNormal { std, .. } | InflowSignal::Normal { std, .. } => *std = value,
    }
}

const fn period(signal: &InflowSignal) -> Option<f64> {
    match *signal {
        InflowSignal::None | InflowSignal::Step { .. } => None,
        InflowSignal::Sine { period_s, .. } => Some(period_s),
        InflowSignal::SimulinkNormal { sample_time_s, .. } | InflowSignal::Normal { sample_time_s, .. } => {
            Some(sample_time_s)
        }
    }
}

const fn set_period(signal: &mut InflowSignal, time: f64) {
    match signal {
        InflowSignal::None | InflowSignal::Step { .. } => {}
        InflowSignal::Sine { period_s, .. } => *period_s = time,
        InflowSignal::SimulinkNormal { sample_time_s, .. } | InflowSignal::Normal { sample_time_s, .. } => {
            *sample_time_s = time;
        }
    }
}

/// Gives the first step of the set-point another size; one of none goes.
fn set_step(setup: &mut LevelLoopSetup, size: f64) {
    let steps = &mut setup.experiment.set_point_steps;
    match steps.first_mut() {
        Some(_) if size == 0.0 => {
            steps.remove(0);
        }
        Some(step) => step.size = size,
        None if size != 0.0 => steps.push(SignalStep { time_s: 0.0, size }),
        None => {}
    }
}

//! What is done to the loop: steps, a load, noise, how long, and the run played on the drawing.

use crate::lab::Lab;
use leptos::prelude::*;

use super::flags::{locks, panels};
use super::session::{Session, use_session};
use super::start::{InflowSteps, PumpControls, StartControls};
use super::steps::AllSteps;
use crate::controls::{ParamControl, ParamNumber, ParamRow};
use crate::shown::{ShownUnit, finer_digits, to_shown};
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Choice, Scale, Select, Text, Tick};
use quadtank::sim::{Experiment, Load, LoadStep, SetPointStep};
use quadtank::study::quadruple_tank::{OperatingPointSpec, Setup};
use quadtank_scenario::{Limits, limits};

/// Time of a step that the student adds (s).
pub const FIRST_STEP_AT_S: f64 = 100.0;
/// When a load that the student adds begins, as a share of the experiment: after the steps of the published ones.
const FIRST_LOAD_AT: f64 = 0.8;
/// Extra pump flow of a load that the student adds (m³/s): about 5 % of a pump's flow on Johansson's rig.
const FIRST_LOAD_FLOW: f64 = 0.5e-6;
/// Hole of a leak that the student adds (m²): about a fifth of an outlet of Johansson's rig.
const FIRST_LEAK_AREA: f64 = 1.5e-6;
/// Change of a pump, a valve or an outlet that the student adds, as a share.
const FIRST_LOAD_SHARE: f64 = -0.2;
/// Travel of the reference sliders as a share of the lowest wall.
const REFERENCE_TRAVEL: f64 = 0.25;
/// How long an experiment lasts that is to show a step at its end, as a multiple of the time of the step.
const AFTER_STEP: f64 = 1.5;
/// Travel of the noise slider (m).
const NOISE_TRAVEL: f64 = 0.005;

const REFERENCE: ParamControl<Setup> = ParamControl {
    ids: [("step1", "step1-number"), ("step2", "step2-number")],
    label: |_, k| ["r₁", "r₂"][k].to_owned(),
    name: |lab, k| tr!(lab, experiment.reference, level = k + 1),
    path: |_, _| "experiment.set_point_steps[].size",
    read: |s, k| first_step(&s.experiment, k).size,
    write: |s, k, size| first_step_mut(&mut s.experiment, k).size = size,
    // A reference above the walls says nothing.
    within: |s, _| Limits::new(-lowest_wall(s), lowest_wall(s)),
    travel: Some(|s| {
        let reach = to_shown(REFERENCE_TRAVEL * lowest_wall(s), s.plant.display_unit());
        (-reach, reach)
    }),
    shown_unit: Some(|s| ShownUnit::length(s.plant.display_unit())),
    finer: Some(|s| finer_digits(s.plant.display_unit())),
    class: ["loop1-row", "loop2-row"],
    ..OF_EXPERIMENT
};
const REFERENCE_TIME: ParamControl<Setup> = ParamControl {
    ids: [("", "step1-time"), ("", "step2-time")],
    name: |lab, k| tr!(lab, experiment.reference_time, level = k + 1),
    path: |_, _| "experiment.set_point_steps[].time_s",
    read: |s, k| first_step(&s.experiment, k).time_s,
    write: |s, k, time_s| first_step_mut(&mut s.experiment, k).time_s = time_s,
    ..TIME
};
const LOAD: ParamControl<Setup> = ParamControl {
    ids: [("load-size", "load-size-number"); 2],
    name: |lab, _| tr!(lab, experiment.load_size),
    path: |s, _| LoadPlace::of(s).path(),
    read: |s, _| first_load(&s.experiment).map_or(0.0, |mut load| *load.size_mut()),
    write: |s, _, size| s.experiment.load_steps.iter_mut().take(1).for_each(|step| *step.load.size_mut() = size),
    travel: Some(|s| LoadPlace::of(s).travel()),
    scale: Some(Scale::Linear(0.1)),
    shown_unit: Some(|s| LoadPlace::of(s).shown_unit()),
    digits: None,
    class: [""; 2],
    ..OF_EXPERIMENT
};
const LOAD_TIME: ParamControl<Setup> = ParamControl {
    ids: [("", "load-time"); 2],
    name: |lab, _| tr!(lab, experiment.load_time),
    path: |_, _| "experiment.load_steps[].time_s",
    read: |s, _| s.experiment.load_steps.first().map_or(0.0, |step| step.time_s),
    write: |s, _, time_s| s.experiment.load_steps.iter_mut().take(1).for_each(|step| step.time_s = time_s),
    ..TIME
};
const NOISE: ParamControl<Setup> = ParamControl {
    ids: [("noise", "noise-number"); 2],
    label: |lab, _| tr!(lab, experiment.noise),
    name: |lab, _| tr!(lab, experiment.noise_name),
    path: |_, _| "experiment.measurement.noise_std",
    read: |s, _| s.experiment.measurement.noise_std,
    write: |s, _, noise| s.experiment.measurement.noise_std = noise,
    travel: Some(|s| (0.0, to_shown(NOISE_TRAVEL, s.plant.display_unit()))),
    shown_unit: Some(|s| ShownUnit::length(s.plant.display_unit())),
    finer: Some(|s| finer_digits(s.plant.display_unit())),
    ..OF_EXPERIMENT
};
const FLOW_NOISE: ParamControl<Setup> = ParamControl {
    ids: [("flow-noise", "flow-noise-number"); 2],
    label: |_, _| "σ".to_owned(),
    name: |lab, _| tr!(lab, experiment.flow_noise_name),
    path: |_, _| "experiment.pump_flow_noise_std",
    read: |s, _| s.experiment.pump_flow_noise_std,
    write: |s, _, noise| s.experiment.pump_flow_noise_std = noise,
    travel: Some(|_| (0.0, 5.0)),
    scale: Some(Scale::Linear(0.01)),
    shown_unit: Some(|_| ShownUnit::FLOW),
    ..OF_EXPERIMENT
};
const DURATION: ParamControl<Setup> = ParamControl {
    ids: [("duration", "duration-number"); 2],
    label: |lab, _| tr!(lab, experiment.duration),
    name: |lab, _| tr!(lab, experiment.duration_name),
    path: |_, _| "experiment.duration_s",
    read: |s, _| s.experiment.duration_s,
    write: |s, _, duration_s| s.experiment.duration_s = duration_s,
    within: |s, _| limits::duration_s(s.controller.sampling_time_s),
    travel: Some(|_| (100.0, 20_000.0)),
    digits: Some(0),
    ..OF_EXPERIMENT
};
const TIME: ParamControl<Setup> = ParamControl {
    within: |s, _| Limits::new(0.0, s.experiment.duration_s),
    scale: Some(Scale::Linear(10.0)),
    digits: Some(0),
    ..OF_EXPERIMENT
};
const OF_EXPERIMENT: ParamControl<Setup> =
    ParamControl { digits: Some(2), class: ["wide"; 2], ..ParamControl::locked_by(locks::EXPERIMENT) };

/// The lowest wall of the lower tanks (m).
fn lowest_wall(setup: &Setup) -> f64 {
    let [one, two, ..] = setup.plant().tanks;
    one.height.min(two.height)
}

/// The first step of a reference, or what it would be.
fn first_step(experiment: &Experiment, level: usize) -> SetPointStep {
    let step = experiment.set_point_steps.iter().copied().find(|s| s.level == level);
    step.unwrap_or(SetPointStep { level, time_s: FIRST_STEP_AT_S, size: 0.0 })
}

/// The first step of a reference, which is added where there is none.
pub fn first_step_mut(experiment: &mut Experiment, level: usize) -> &mut SetPointStep {
    let fresh = first_step(experiment, level);
    let steps = &mut experiment.set_point_steps;
    let place = steps.iter().position(|step| step.level == level).unwrap_or_else(|| {
        steps.push(fresh);
        steps.len() - 1
    });
    &mut steps[place]
}

/// The same, at the time of the other level's first step where it is added, so that both answers are seen whole.
pub fn step_beside_mut(experiment: &mut Experiment, level: usize) -> &mut SetPointStep {
    let steps = &experiment.set_point_steps;
    let beside = steps.iter().find(|step| step.level != level).map(|step| step.time_s);
    let is_new = steps.iter().all(|step| step.level != level);
    let step = first_step_mut(experiment, level);
    if let Some(time_s) = beside.filter(|_| is_new) {
        step.time_s = time_s;
    }
    step
}

/// Sizes of the first step of a level (m) that its tank can hold, where the level is at `rest` (m): the reference after the step
/// and after all others of this level stays between bottom and wall.
pub fn holdable(setup: &Setup, level: usize, rest: f64) -> Limits {
    let steps = setup.experiment.set_point_steps.iter().filter(|step| step.level == level).skip(1);
    let further = steps.map(|step| step.size).fold((0.0, 0.0, 0.0), |(sum, low, high): (f64, f64, f64), size| {
        (sum + size, low.min(sum + size), high.max(sum + size))
    });
    let (min, max) = (-rest - further.1, setup.plant().tanks[level].height - rest - further.2);
    // Where the level at rest is above the wall, the range still reaches from a step downwards to no step.
    Limits::new(min.min(0.0), max.max(min.min(0.0)))
}

/// Size of the first step of a reference (m).
pub fn step_size(session: Session, level: usize) -> Signal<f64> {
    session.part(move |s| first_step(&s.experiment, level).size)
}

/// Time of the first step of a reference (s).
pub fn step_time(session: Session, level: usize) -> Signal<f64> {
    session.part(move |s| first_step(&s.experiment, level).time_s)
}

fn first_load(experiment: &Experiment) -> Option<Load> {
    experiment.load_steps.first().map(|step| step.load)
}

/// Steps beyond the first of each level and the first load: a file may hold them, the card does not show them.
fn further_steps(experiment: &Experiment) -> usize {
    let shown_levels = (0..2).filter(|&level| experiment.set_point_steps.iter().any(|s| s.level == level)).count();
    experiment.set_point_steps.len() - shown_levels + experiment.load_steps.len().saturating_sub(1)
}

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::reference, terms::load, terms::noise];

/// The experiment.
#[component]
pub fn ExperimentCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let further = move || session.document.with(|s| further_steps(&s.setup.experiment));
    let begins = move || {
        let is_given = session.document.with(|s| {
            let is_state = matches!(s.setup.operating_point, OperatingPointSpec::State(_));
            is_state || s.setup.experiment.initial_levels.is_some()
        });
        if is_given { tr!(lab, experiment.from_levels) } else { tr!(lab, experiment.remark) }
    };
    let about = move || view! { <span class="remark">{begins}</span> };
    view! {
        <Card name="experiment" panel=panels::EXPERIMENT title=say!(lab, experiment.title) terms=TERMS beside=about>
            <Timed size=&REFERENCE time=&REFERENCE_TIME index=0 />
            <Timed size=&REFERENCE time=&REFERENCE_TIME index=1 />
            <LoadControls />
            <ParamRow session control=&NOISE />
            <ParamRow session control=&DURATION />
            <Tick
                id="quantised"
                text=say!(lab, experiment.quantised)
                ticked=session.part(|s| s.experiment.measurement.quantised)
                disabled=lab.locks(locks::EXPERIMENT)
                on_tick=move |on| session.edit(|s| s.experiment.measurement.quantised = on)
            />
            <p class="remark" hidden=move || further() == 0>{say!(lab, experiment.further, count = further())}</p>
            <MoreControls />
        </Card>
    }
}

/// What most experiments leave as it is: where it begins, who moves the pumps, and steps beyond the first. Open where it does not.
#[component]
fn MoreControls() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let is_used = session.document.with_untracked(|document| {
        let experiment = &document.setup.experiment;
        let is_moved = experiment.initial_levels.is_some() || !experiment.pump_voltage_steps.is_empty();
        is_moved || !experiment.inflow_steps.is_empty() || experiment.pump_flow_noise_std > 0.0
    });
    view! {
        <details class="more" data-testid="experiment-more" open=is_used>
            <summary>{say!(lab, experiment.more)}</summary>
            <StartControls />
            <PumpControls />
            <InflowSteps />
            <p class="remark">{say!(lab, experiment.flow_noise)}</p>
            <ParamRow session control=&FLOW_NOISE />
            <AllSteps />
        </details>
    }
}

/// A slider, and "at … s".
#[component]
fn Timed(
    size: &'static ParamControl<Setup>,
    time: &'static ParamControl<Setup>,
    #[prop(optional)] index: usize,
) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    // A set-point that does not move has nothing to say of its time.
    let late = move || {
        session.throttled.setup.with(|s| {
            let (time_s, end_s) = ((time.read)(s, index), s.experiment.duration_s);
            ((size.read)(s, index) != 0.0 && time_s >= end_s).then_some((time_s, end_s))
        })
    };
    let extend = move |_| {
        session.edit(|s| {
            let limits = limits::duration_s(s.controller.sampling_time_s);
            s.experiment.duration_s = (AFTER_STEP * (time.read)(s, index)).clamp(limits.min, limits.max);
        });
    };
    let said = move |(time_s, end_s): (f64, f64)| {
        let style = lab.number_style();
        tr!(lab, experiment.after_end, time = style.fixed(time_s, 0), end = style.fixed(end_s, 0))
    };
    view! {
        <div class="timed">
            <ParamRow session control=size index />
            <div class="at">
                <span class="unit">{say!(lab, experiment.at)}</span>
                <ParamNumber session control=time index />
                <span class="unit">"s"</span>
            </div>
        </div>
        {move || late().map(|times| view! {
            <p class="remark warm" data-testid="after-end">{said(times)}</p>
            <button type="button" class="button small" data-testid="mend-after-end" disabled=lab.locks(locks::EXPERIMENT) on:click=extend>
                {say!(lab, mend.longer)}
            </button>
        })}
    }
}

/// What the first load acts on: an index of a pump, a valve or a tank, or nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LoadPlace {
    Nowhere,
    Pump(usize),
    Tank(usize),
    Inflow(usize),
    PumpGain(usize),
    Valve(usize),
    Outlet(usize),
}

impl LoadPlace {
    fn all() -> impl Iterator<Item = Self> {
        let of_pumps = (0..2).map(Self::Pump).chain((0..2).map(Self::PumpGain)).chain((0..2).map(Self::Valve));
        let of_tanks = (0..4).map(Self::Tank).chain((0..4).map(Self::Inflow)).chain((0..4).map(Self::Outlet));
        std::iter::once(Self::Nowhere).chain(of_pumps).chain(of_tanks)
    }

    /// Row of the size of such a load in the table of parameters.
    fn path(self) -> &'static str {
        match self {
            Self::Nowhere | Self::Pump(_) => "experiment.load_steps[].load.pump_flow.flow",
            Self::Tank(_) => "experiment.load_steps[].load.leak.area",
            Self::Inflow(_) => "experiment.load_steps[].load.tank_flow.flow",
            Self::PumpGain(_) => "experiment.load_steps[].load.pump_gain.change",
            Self::Valve(_) => "experiment.load_steps[].load.valve.change",
            Self::Outlet(_) => "experiment.load_steps[].load.outlet.change",
        }
    }

    fn shown_unit(self) -> ShownUnit {
        match self {
            Self::Nowhere | Self::Pump(_) | Self::Inflow(_) => ShownUnit::FLOW,
            Self::Tank(_) => ShownUnit::SMALL_AREA,
            Self::PumpGain(_) | Self::Valve(_) | Self::Outlet(_) => ShownUnit::PER_CENT,
        }
    }

    /// Least and largest size of the slider, in the shown unit.
    fn travel(self) -> (f64, f64) {
        match self {
            Self::Nowhere | Self::Pump(_) | Self::Inflow(_) => (-5.0, 5.0),
            Self::Tank(_) => (0.0, 10.0),
            Self::PumpGain(_) | Self::Valve(_) | Self::Outlet(_) => (-100.0, 100.0),
        }
    }

    fn of(setup: &Setup) -> Self {
        match first_load(&setup.experiment) {
            None => Self::Nowhere,
            Some(Load::PumpFlow { pump, .. }) => Self::Pump(pump),
            Some(Load::Leak { tank, .. }) => Self::Tank(tank),
            Some(Load::TankFlow { tank, .. }) => Self::Inflow(tank),
            Some(Load::PumpGain { pump, .. }) => Self::PumpGain(pump),
            Some(Load::Valve { valve, .. }) => Self::Valve(valve),
            Some(Load::Outlet { tank, .. }) => Self::Outlet(tank),
        }
    }

    /// A load that begins there.
    fn load(self) -> Option<Load> {
        match self {
            Self::Nowhere => None,
            Self::Pump(pump) => Some(Load::PumpFlow { pump, flow: FIRST_LOAD_FLOW }),
            Self::Tank(tank) => Some(Load::Leak { tank, area: FIRST_LEAK_AREA }),
            Self::Inflow(tank) => Some(Load::TankFlow { tank, flow: FIRST_LOAD_FLOW }),
            Self::PumpGain(pump) => Some(Load::PumpGain { pump, change: FIRST_LOAD_SHARE }),
            Self::Valve(valve) => Some(Load::Valve { valve, change: FIRST_LOAD_SHARE }),
            Self::Outlet(tank) => Some(Load::Outlet { tank, change: FIRST_LOAD_SHARE }),
        }
    }

    fn choice(self, lab: Lab) -> Choice<Self> {
        match self {
            Self::Nowhere => Choice::new(self, "none", tr!(lab, experiment.load_none)),
            Self::Pump(k) => Choice::new(self, format!("pump{k}"), tr!(lab, experiment.load_pump, pump = k + 1)),
            Self::Tank(k) => Choice::new(self, format!("leak{k}"), tr!(lab, experiment.load_leak, tank = k + 1)),
            Self::Inflow(k) => Choice::new(self, format!("inflow{k}"), tr!(lab, experiment.load_inflow, tank = k + 1)),
            Self::PumpGain(k) => Choice::new(self, format!("gain{k}"), tr!(lab, experiment.load_gain, pump = k + 1)),
            Self::Valve(k) => Choice::new(self, format!("valve{k}"), tr!(lab, experiment.load_valve, valve = k + 1)),
            Self::Outlet(k) => Choice::new(self, format!("outlet{k}"), tr!(lab, experiment.load_outlet, tank = k + 1)),
        }
    }
}

/// Kind, size and time of the first load.
#[component]
fn LoadControls() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let present = session.part(|s| !s.experiment.load_steps.is_empty());
    let choose = move |place: LoadPlace| {
        session.edit(|s| {
            let begin = (FIRST_LOAD_AT * s.experiment.duration_s).round();
            let steps = &mut s.experiment.load_steps;
            match (place.load(), steps.is_empty()) {
                (None, false) => drop(steps.remove(0)),
                (None, true) => {}
                (Some(load), true) => steps.push(LoadStep { time_s: begin, load }),
                (Some(load), false) => steps[0].load = load,
            }
        });
    };
    view! {
        <div class="row load">
            <label for="load-kind">{say!(lab, experiment.load)}</label>
            <Select
                id="load-kind"
                labelled="load-kind"
                choices=Signal::derive(move || LoadPlace::all().map(|place| place.choice(lab)).collect::<Vec<_>>())
                chosen=session.part(LoadPlace::of)
                on_choose=choose
                disabled=lab.locks(locks::EXPERIMENT)
            />
        </div>
        {move || present.get().then(|| view! { <Timed size=&LOAD time=&LOAD_TIME /> })}
    }
}

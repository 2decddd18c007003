//! The loop: which one it is, its drawing with all signals, where it starts and what it is like there.

use leptos::prelude::*;
use quadtank::literature::LevelPresetId;
use quadtank::literature::andreis::PublishedDisturbance;
use quadtank::study::level_loop::{LevelLoopSetup, LevelPlantSpec, published_setup};
use quadtank_scenario::Limits;

use super::drawing::LoopDrawing;
use super::element::ElementPanel;
use super::flags::{locks, panels};
use super::mends;
use super::session::{Session, load, set_cursor, use_session};
use crate::controls::{ParamControl, ParamRow};
use crate::errors::of_level_error;
use crate::lab::Lab;
use crate::mends::MendButton;
use crate::shown::ShownUnit;
use crate::texts::{say, terms, tr};
use crate::widgets::{Card, Choice, Playback, Scale, Select, Sentence, Text, TimeBar, shown_times};

/// Litres per second.
pub const LITRES: ShownUnit = ShownUnit { name: "L/s", per_unit: 1e3 };
/// Centimetres.
pub const CENTIMETRES: ShownUnit = ShownUnit { name: "cm", per_unit: 100.0 };

/// Levels of the slider, as shares of the height.
const LEVELS: (f64, f64) = (0.02, 0.98);

const LEVEL: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("level-start", "level-start-number"); 2],
    label: |_, _| "h₀".to_owned(),
    name: |lab, _| tr!(lab, level.start_level),
    path: |_, _| "experiment.level",
    read: |s, _| s.experiment.level,
    write: |s, _, level| s.experiment.level = level,
    within: |s, _| Limits::new(0.0, s.plant().tank.height),
    travel: Some(|s| {
        let height = s.plant().tank.height;
        (100.0 * LEVELS.0 * height, 100.0 * LEVELS.1 * height)
    }),
    scale: Some(Scale::Linear(0.5)),
    digits: Some(1),
    shown_unit: Some(|_| CENTIMETRES),
    ..ParamControl::locked_by(locks::EXPERIMENT)
};
const INFLOW: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("level-inflow", "level-inflow-number"); 2],
    label: |_, _| "q₀".to_owned(),
    name: |lab, _| tr!(lab, level.start_inflow),
    path: |_, _| "experiment.inflow",
    read: |s, _| s.experiment.inflow,
    write: |s, _, inflow| s.experiment.inflow = inflow,
    within: |_, _| Limits::NONE,
    // What the open valve carries at that level, or what the open outlet does.
    travel: Some(|s| (0.0, 1e3 * s.plant().flows(s.experiment.level, 1.0)[1])),
    scale: Some(Scale::Linear(0.01)),
    digits: Some(2),
    shown_unit: Some(|_| LITRES),
    ..LEVEL
};

/// The words of the card that explain themselves.
const TERMS: &[Text] =
    &[terms::transmitter, terms::converter, terms::actuator, terms::characteristic, terms::resistance];

/// The loop.
#[component]
pub fn ProcessCard(
    /// Whether it can be started elsewhere.
    with_start: bool,
) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let events = session.part(|s| {
        let steps = s.experiment.set_point_steps.iter().map(|step| step.time_s);
        shown_times(steps.chain([s.experiment.disturbance.from_s]), s.experiment.duration_s)
    });
    let on_move = Callback::new(move |time| set_cursor(session, time));
    let playback = Playback::new(session.own.cursor.into(), on_move, events);
    view! {
        <Card name="process" panel=panels::PROCESS title=say!(lab, level.loop_title) terms=TERMS beside=|| view! { <PresetSelect /> }>
            <LoopDrawing />
            <TimeBar playback id="level-play" lab />
            <ElementPanel />
            {with_start.then(|| view! { <Start /> })}
        </Card>
    }
}

/// Where the experiment starts, and what the plant is like there.
#[component]
fn Start() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let found = Memo::new(move |_| point(session));
    view! {
        <h3>{say!(lab, level.operating_point)}</h3>
        <ParamRow session control=&INFLOW />
        <ParamRow session control=&LEVEL />
        <Sentence
            id="level-point"
            warm=Signal::derive(move || !found.get().0)
            text=Signal::derive(move || found.get().1)
        />
        <MendButton session id="mend-start" offer=mends::of_start />
    }
}

/// What the plant is like around the rest, and whether it can rest there.
fn point(session: Session) -> (bool, String) {
    let lab = session.lab;
    let style = lab.number_style();
    let number = |value: f64| style.significant(value, 3);
    session.throttled.plant.with(|plant| match plant.as_ref() {
        Err(error) => (false, tr!(lab, level.no_rest, reason = of_level_error(lab, error))),
        Ok(plant) => {
            let gains = plant.gains;
            let slope = number(gains.slope_gain());
            let text = match (gains.process_gain(), gains.time_constant(), gains.resistance) {
                (Some(gain), Some(time), Some(resistance)) => tr!(
                    lab,
                    level.point,
                    gain = number(gain),
                    time = number(time),
                    resistance = number(resistance),
                    slope = slope
                ),
                _ => tr!(lab, level.point_integrating, slope = slope),
            };
            (true, text)
        }
    })
}

/// The published loops, and one's own.
#[component]
fn PresetSelect() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let chosen = session.part(|s| match s.plant {
        LevelPlantSpec::Preset(id) => Some(id),
        LevelPlantSpec::Parameters(_) => None,
    });
    let choices = Signal::derive(move || {
        let own = chosen.get().is_none().then(|| Choice::new(None, "own", tr!(lab, level.own_plant)));
        let known = LevelPresetId::ALL.into_iter().map(|id| Choice::new(Some(id), preset_id(id), preset_name(lab, id)));
        known.chain(own).collect::<Vec<_>>()
    });
    let choose = move |id: Option<LevelPresetId>| {
        if let Some(id) = id {
            load(session, published_setup(id, PublishedDisturbance::SineL));
        }
    };
    view! {
        <Select
            id="level-preset"
            name=say!(lab, level.loop_title)
            choices
            chosen
            on_choose=choose
            disabled=lab.locks(locks::PLANT)
        />
    }
}

const fn preset_id(id: LevelPresetId) -> &'static str {
    match id {
        LevelPresetId::Andreis => "andreis",
        LevelPresetId::AndreisUncertain => "andreis-uncertain",
        LevelPresetId::LectureSlides => "lecture-slides",
    }
}

fn preset_name(lab: Lab, id: LevelPresetId) -> String {
    match id {
        LevelPresetId::Andreis => tr!(lab, level.preset_andreis),
        LevelPresetId::AndreisUncertain => tr!(lab, level.preset_uncertain),
        LevelPresetId::LectureSlides => tr!(lab, level.preset_slides),
    }
}

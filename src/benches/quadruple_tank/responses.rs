//! The step responses: levels and pump voltages, with cursor, zoom, pinned runs, metrics and a data table.

use leptos::prelude::*;

use super::flags::{locks, panels};
use super::frequency::FrequencyFold;
use super::mends;
use super::metrics::{MetricsTable, why};
use super::moment::{RigState, use_moment};
use super::pictures;
use super::pins;
use super::record_view::RecordFold;
use super::session::{Session, use_session};
use super::set_points::SetPoints;
use crate::errors::of_study_error;
use crate::mends::MendButton;
use crate::pinned::{PinButtons, PinnedSetups};
use crate::shown::{length_digits, to_shown, unit_name};
use crate::texts::{say, terms, tr};
use crate::widgets::{
    Card, ChartCanvas, ChartMenu, DataTable, Readout, Sentence, Text, TimeAxis, TimeSurface, ZoomButtons, unmarked,
};
use quadtank::control::LoopMode;
use quadtank::sim::{EventKind, LoopMetrics, NoResponse, Settling};
use quadtank::study::quadruple_tank::{Run, shown_until_s};
use quadtank::study::{StudyError, StudyErrorKind};
use quadtank_figure::Frame;
use quadtank_scenario::Scenario;

/// The shortest stretch of time that can be shown (s).
const SHORTEST_S: f64 = 5.0;

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::reference, terms::rise, terms::overshoot, terms::costs, terms::linear];

/// The step responses.
#[component]
pub fn ResponsesCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = pictures::responses(session);
    let (for_menu, for_table) = (picture.clone(), picture.clone());
    let axis = time_axis(session);
    let moment = use_moment();
    let has_cursor = Memo::new(move |_| session.document.with(|s| s.view.cursor_s.is_some()));
    let at_cursor = move || moment.get().filter(|_| has_cursor.get());
    let title = say!(lab, responses.title);
    let sentence = Signal::derive(move || sentence(session));
    let beside = move || {
        view! {
            <Toolbar axis />
            <ChartMenu picture=for_menu file="responses" title />
        }
    };
    view! {
        <Card name="responses" panel=panels::RESPONSES title terms=TERMS beside>
            <PinnedSetups session id="pinned" text=pins::text restore=pins::restore />
            <div class="charts">
                <div class="chart">
                    <ChartCanvas
                        picture
                        frames
                        summary=say!(lab, responses.summary, sentence = unmarked(&sentence.get()))
                        name="responses"
                        steady=true
                    />
                    <TimeSurface
                        axis
                        frames
                        label=say!(lab, responses.cursor)
                        spoken=Signal::derive(move || at_cursor().map_or_else(String::new, |m| spoken(session, &m)))
                        readout=Signal::derive(move || at_cursor().map(|m| readout(session, &m)))
                        id="responses-surface"
                    />
                    <SetPoints frames />
                </div>
            </div>
            <div class="mended">
                <Sentence id="responses-sentence" text=sentence status=true />
                <MendButton session id="mend-run" offer=mends::of_run />
            </div>
            <div class="folded">
                <details class="more" data-testid="metrics-fold">
                    <summary>{say!(lab, responses.figures)}</summary>
                    <MetricsTable />
                </details>
                <FrequencyFold />
                <DataTable picture=for_table id="data-table" />
                {(!lab.flags.with_value(|flags| flags.embed)).then(|| view! { <RecordFold /> })}
            </div>
        </Card>
    }
}

#[component]
fn Toolbar(axis: TimeAxis) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let linear = move || session.document.with(|s| !s.view.hide_linear);
    view! {
        <div class="toolbar">
            <PinButtons session ids=("pin", "unpin") max=Scenario::MAX_PINNED />
            <button
                type="button"
                class="button small"
                data-testid="linear"
                aria-pressed=move || linear().to_string()
                on:click=move |_| session.document.update(|s| s.view.hide_linear = !s.view.hide_linear)
            >
                {say!(lab, responses.hide_linear)}
            </button>
            <ZoomButtons axis ids=["zoom-in", "zoom-out", "zoom-reset"] />
            <button
                type="button"
                class="button small"
                data-testid="zoom-fit"
                title=say!(lab, responses.fit_name)
                on:click=move |_| fit(session, axis)
            >
                {say!(lab, responses.fit)}
            </button>
        </div>
    }
}

/// Shows the run until all that steps has settled.
fn fit(session: Session, axis: TimeAxis) {
    let until_s = session.charts.run.with_untracked(|run| {
        let experiment = session.document.with_untracked(|s| s.setup.experiment.clone());
        run.as_ref().as_ref().ok().map(|run| shown_until_s(&experiment, run))
    });
    let (_, end_s) = axis.whole.get_untracked();
    axis.on_show.run(until_s.filter(|until_s| *until_s < end_s).map(|until_s| (0.0, until_s)));
}

/// The time of the run; zooming goes about the first step in sight.
fn time_axis(session: Session) -> TimeAxis {
    let window = move || session.document.with(|s| s.shown_time_s().unwrap_or((0.0, s.setup.experiment.duration_s)));
    let first_step = move || {
        let (from, to) = window();
        session.document.with(|s| {
            let times = s.setup.experiment.set_point_steps.iter().map(|step| step.time_s);
            times.filter(|t| (from..=to).contains(t)).reduce(f64::min)
        })
    };
    TimeAxis {
        whole: session.part(|s| (0.0, s.experiment.duration_s)),
        window: Signal::derive(window),
        cursor: Memo::new(move |_| session.document.with(|s| s.view.cursor_s)).into(),
        on_cursor: Callback::new(move |time| session.document.update(|s| s.view.cursor_s = time)),
        on_show: Callback::new(move |stretch: Option<(f64, f64)>| {
            session.document.update(|s| s.view.zoom_s = stretch.map(Into::into));
        }),
        about: Signal::derive(first_step),
        shortest: Signal::stored(SHORTEST_S),
    }
}

/// A moment as it is shown at the cursor: time, both levels without their unit, both pump voltages.
fn numbers(session: Session, m: &RigState) -> (String, [String; 2], [String; 2]) {
    let lab = session.lab;
    let style = lab.number_style();
    let unit = session.own.unit.get();
    let level = |k: usize| style.fixed(to_shown(m.levels[k], unit), length_digits(unit));
    let pump = |k: usize| style.fixed(m.pump_voltage[k], 2);
    (style.fixed(m.time_s.unwrap_or(0.0), 0), [level(0), level(1)], [pump(0), pump(1)])
}

fn readout(session: Session, m: &RigState) -> Readout {
    let (time, [h1, h2], [v1, v2]) = numbers(session, m);
    let u = unit_name(session.own.unit.get());
    Readout {
        time: format!("t = {time} s"),
        pairs: vec![[format!("h₁ {h1} {u}"), format!("h₂ {h2} {u}")], [format!("v₁ {v1} V"), format!("v₂ {v2} V")]],
    }
}

fn spoken(session: Session, m: &RigState) -> String {
    let (time, [h1, h2], [v1, v2]) = numbers(session, m);
    let u = unit_name(session.own.unit.get());
    format!("t = {time} s: h₁ {h1} {u}, h₂ {h2} {u}, v₁ {v1} V, v₂ {v2} V")
}

/// What the run says, in words: how each stepped level did, then what went wrong first.
pub fn sentence(session: Session) -> String {
    let lab = session.lab;
    session.throttled.run.with(|outcome| {
        let run = match outcome.as_ref() {
            Ok(run) => run,
            Err(error @ StudyError { fault: StudyErrorKind::TooMuchWork { .. }, .. }) => {
                return of_study_error(lab, session.own.unit.get(), error);
            }
            Err(_) => return tr!(lab, responses.none),
        };
        let mut parts = of_steps(session, run);
        parts.extend(run.nonlinear.events.iter().take(MAX_EVENTS).map(|event| {
            let time = lab.number_style().fixed(event.time_s, 0);
            match event.kind {
                EventKind::Overflow { tank } => {
                    tr!(lab, responses.event_overflow, tank = tank + 1, time = time)
                }
                EventKind::Empty { tank } => tr!(lab, responses.event_empty, tank = tank + 1, time = time),
                EventKind::Saturated { pump } => {
                    tr!(lab, responses.event_saturated, pump = pump + 1, time = time)
                }
            }
        }));
        parts.join(" ")
    })
}

/// How each level answered its step, or why that is not said.
fn of_steps(session: Session, run: &Run) -> Vec<String> {
    let lab = session.lab;
    let reasons = run.metrics.map(|metrics| metrics.no_response);
    // What holds for the whole run is said once.
    let of_run = |reason: &NoResponse| {
        use NoResponse::{MarginalLoop, StartOverflows, TooLongToJudge, UnstableLoop};
        matches!(reason, UnstableLoop | MarginalLoop | StartOverflows | TooLongToJudge)
    };
    if let Some(reason) = reasons.into_iter().flatten().find(of_run) {
        return vec![why(session, 0, reason)];
    }
    let has_load = session.throttled.setup.with(|s| !s.experiment.load_steps.is_empty());
    let is_manual =
        session.throttled.setup.with(|s| s.controller.loops.iter().all(|l| !matches!(l.mode, LoopMode::Automatic)));
    let is_by_hand = session.throttled.setup.with(|s| (0..2).all(|pump| s.experiment.is_by_hand(pump)));
    if reasons == [Some(NoResponse::NoStep); 2] && is_by_hand {
        return vec![tr!(lab, responses.sentence_by_hand)];
    }
    if reasons == [Some(NoResponse::NoStep); 2] && is_manual {
        return vec![tr!(lab, responses.sentence_manual)];
    }
    if reasons == [Some(NoResponse::NoStep); 2] {
        return vec![match (has_load, lab.locks(locks::EXPERIMENT)) {
            (true, _) => tr!(lab, responses.load_alone),
            (false, false) => tr!(lab, responses.sentence_still),
            (false, true) => tr!(lab, responses.sentence_still_locked),
        }];
    }
    let of_level = |(k, m): (usize, &LoopMetrics)| match m.no_response {
        None => of_metrics(session, k, m),
        Some(NoResponse::NoStep) => None,
        Some(reason) => Some(why(session, k, reason)),
    };
    let mut parts: Vec<String> = run.metrics.iter().enumerate().filter_map(of_level).collect();
    if run.judged_without_noise && reasons.contains(&None) {
        parts.push(tr!(lab, responses.without_noise));
    }
    if has_load || session.throttled.setup.with(|s| s.experiment.measurement.quantised) {
        parts.push(tr!(lab, responses.disturbed));
    }
    parts
}

/// Most events that the sentence tells.
const MAX_EVENTS: usize = 4;

fn of_metrics(session: Session, index: usize, metrics: &LoopMetrics) -> Option<String> {
    let lab = session.lab;
    let style = lab.number_style();
    let unit = session.own.unit.get();
    let window_s = metrics.window_s?;
    let window = style.significant(window_s, 3);
    let cross = style.fixed(to_shown(metrics.other_peak, unit), length_digits(unit));
    let (level, other) = (index + 1, 2 - index);
    Some(match metrics.settling_2_percent? {
        Settling::After { time_s } => {
            // As many digits as in the table below.
            let percent = 100.0 * metrics.overshoot.unwrap_or(0.0);
            let overshoot = if percent < 0.05 {
                tr!(lab, responses.without_overshoot)
            } else {
                let share = format!("{}\u{a0}%", style.fixed(percent, 1));
                tr!(lab, responses.with_overshoot, share = share)
            };
            let time = style.significant(time_s, 3);
            // Where it is over so soon, what comes later may be worse.
            let is_short = window_s < 2.0 * time_s;
            let watched = if is_short { tr!(lab, responses.watched, window = window) } else { String::new() };
            tr!(
                lab,
                responses.sentence_settles,
                level = level,
                time = time,
                watched = watched,
                overshoot = overshoot,
                other = other,
                cross = cross,
                unit = unit_name(unit)
            )
        }
        Settling::Never => tr!(
            lab,
            responses.sentence_never,
            level = level,
            window = window,
            other = other,
            cross = cross,
            unit = unit_name(unit)
        ),
    })
}

//! The run: level, flows and controller output over time, with what it shows.

use leptos::prelude::*;
use quadtank::sim::level::LevelController;
use quadtank::study::level_loop::LevelLoopSetup;
use quadtank_figure::Frame;
use quadtank_scenario::level_loop::LevelLoopScenario;

use super::flags::panels;
use super::mends;
use super::pictures::{self, output_unit};
use super::sentences;
use super::session::{Session, set_cursor, shown, use_session};
use crate::mends::MendButton;
use crate::pinned::{PinButtons, PinnedSetups};
use crate::texts::{say, terms, tr};
use crate::widgets::{
    Card, ChartCanvas, ChartMenu, DataTable, Figures, Readout, Row, TableContent, Text, TimeAxis, TimeSurface, Verdict,
    ZoomButtons, marked, unmarked,
};

/// The shortest stretch of time that can be shown, as a share of the run.
const SHORTEST: f64 = 0.01;

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::tight, terms::averaging, terms::variance, terms::level_costs];

/// The run with its sentence and its figures.
#[component]
pub fn CourseCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let axis = time_axis(session);
    let picture = pictures::run(session, axis.window);
    let (for_menu, for_table) = (picture.clone(), picture.clone());
    let title = say!(lab, level.course);
    // Read in three places, worked out once.
    let found = Memo::new(move |_| sentences::of_run(session));
    let readout = Signal::derive(move || session.own.cursor.get().and_then(|_| readout(session)));
    let spoken = Signal::derive(move || readout.get().map_or_else(String::new, |readout| readout.spoken()));
    let beside = move || {
        view! {
            <div class="toolbar">
                <PinButtons session ids=("level-pin", "level-unpin") max=LevelLoopScenario::MAX_PINNED />
                <ZoomButtons axis ids=["level-zoom-in", "level-zoom-out", "level-zoom-reset"] />
            </div>
            <ChartMenu picture=for_menu file="level-loop" title />
        }
    };
    view! {
        <Card name="course" panel=panels::RESPONSES title terms=TERMS beside>
            <div class="mended">
                <Verdict id="level-verdict" warm=Signal::derive(move || !found.get().0)>
                    {move || marked(&found.get().1)}
                </Verdict>
                <MendButton session id="mend-run" offer=mends::of_run />
            </div>
            <div class="chart">
                <ChartCanvas picture frames summary=Signal::derive(move || unmarked(&found.get().1)) name="level-course" steady=true />
                <TimeSurface axis frames label=say!(lab, responses.cursor) spoken readout id="level-surface" />
            </div>
            <div class="folded">
                <PinnedSetups session id="level-pinned" text=pinned_text restore />
                <details class="more">
                    <summary data-testid="level-figures-fold">{say!(lab, responses.figures)}</summary>
                    <Figures name="level-figures" caption=say!(lab, level.figures)>{move || figures(session)}</Figures>
                    <p class="remark">{move || marked(&sentences::of_step(session))}</p>
                </details>
                <p class="remark" data-testid="level-pinned-note">{move || without_run(session)}</p>
                <DataTable picture=for_table id="level-table" />
            </div>
        </Card>
    }
}

fn time_axis(session: Session) -> TimeAxis {
    let end = session.part(|s| s.experiment.duration_s);
    let on_cursor = Callback::new(move |time| set_cursor(session, time));
    let shortest = Signal::derive(move || SHORTEST * end.get());
    TimeAxis::of_run(end, session.own.cursor.into(), on_cursor, shortest)
}

/// The values at the shown moment.
fn readout(session: Session) -> Option<Readout> {
    let (time, plant, signals) = shown(session)?;
    let style = session.lab.number_style();
    let litres = |flow: f64| format!("{} L/s", style.fixed(1000.0 * flow, 2));
    Some(Readout {
        time: format!("t = {} s", style.significant(time, 4)),
        pairs: vec![
            [format!("h {} cm", style.fixed(100.0 * signals.level, 2)), format!("q_out {}", litres(signals.outflow))],
            [
                format!("m {} {}", style.fixed(signals.output, 3), output_unit(&plant)),
                format!("q_in {}", litres(signals.inflow)),
            ],
        ],
    })
}

/// Controller of a setup in a few characters.
pub fn controller_text(session: Session, setup: &LevelLoopSetup) -> String {
    let lab = session.lab;
    let number = |value: f64| lab.number_style().significant(value, 3);
    match &setup.controller {
        LevelController::Manual { .. } => tr!(lab, level.controller_off),
        LevelController::Pi { gain, integral_time_s, .. } => {
            format!("PI · Kp {} · Ti {} s", number(*gain), number(*integral_time_s))
        }
        LevelController::Pid { proportional, integral, derivative, .. } => {
            let (i, d) = (number(60.0 * integral), number(derivative / 60.0));
            format!("PID · P {} · I {i}/min · D {d} min", number(*proportional))
        }
        LevelController::Sampled { settings, sampling_time_s } => {
            let (gain, time) = (number(settings.gain), number(settings.integral_time_s));
            format!("PI · Kp {gain} · Ti {time} s · Ts {} s", number(*sampling_time_s))
        }
    }
}

fn pinned_text(session: Session, pinned: &LevelLoopSetup) -> String {
    controller_text(session, pinned)
}

/// Takes the controller of a pinned loop up in the present experiment.
fn restore(present: &mut LevelLoopSetup, pinned: &LevelLoopSetup) {
    *present = pinned.in_experiment_of(present);
}

/// Statistics of level and outflow, of the run and of the pinned ones.
fn figures(session: Session) -> impl IntoView {
    let lab = session.lab;
    let style = lab.number_style();
    let columns = vec![
        tr!(lab, responses.run),
        tr!(lab, level.column_least),
        tr!(lab, level.column_most),
        tr!(lab, level.column_mean),
        tr!(lab, level.column_variance),
        "IAE (cm s)".to_owned(),
        "ISE (cm² s)".to_owned(),
        "ITAE (cm s²)".to_owned(),
        tr!(lab, level.column_moves),
    ];
    let rows_of = |name: &str, figures: &quadtank::sim::level::LevelFigures| {
        let level =
            [figures.level.minimum, figures.level.maximum, figures.level.mean].map(|v| style.fixed(100.0 * v, 2));
        let outflow = [figures.outflow.minimum, figures.outflow.maximum, figures.outflow.mean]
            .map(|v| style.fixed(1000.0 * v, 2));
        let costs = [100.0 * figures.iae, 1e4 * figures.ise, 100.0 * figures.itae, figures.output_moves];
        let mut first = level.to_vec();
        first.push(variance_text(session, figures.level.variance));
        first.extend(costs.map(|value| style.significant(value, 4)));
        let mut second = outflow.to_vec();
        second.push(variance_text(session, figures.outflow.variance));
        second.extend(std::iter::repeat_n(String::new(), 4));
        [
            view! { <Row class="loop1" name=format!("h (cm){name}") figures=first /> }.into_any(),
            view! { <Row class="loop2" name=format!("q_out (L/s){name}") figures=second /> }.into_any(),
        ]
    };
    let own = session.throttled.with_answer(|answer| rows_of("", &answer.figures));
    let pinned = session.throttled.pinned.get();
    let pinned = pinned.iter().enumerate().filter_map(|(place, pinned)| {
        let answer = pinned.result.as_ref().as_ref().ok()?;
        Some(rows_of(&format!(" · {}", place + 1), &answer.figures))
    });
    let rows = own.into_iter().chain(pinned).flatten().collect();
    view! { <TableContent caption=tr!(lab, level.figures) columns rows /> }
}

fn variance_text(session: Session, value: f64) -> String {
    sentences::variance(session.lab, value)
}

/// Which pinned loops have no run in the present experiment.
fn without_run(session: Session) -> String {
    let lab = session.lab;
    let pinned = session.throttled.pinned.get();
    let missing = pinned.iter().enumerate().filter(|(_, pinned)| pinned.result.is_err());
    missing.map(|(place, _)| tr!(lab, responses.pinned_none, run = place + 1)).collect::<Vec<_>>().join(" ")
}

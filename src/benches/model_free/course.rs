//! The run: what is controlled, what that does to the upper tanks, and the estimate of the law.

use leptos::prelude::*;

use super::flags::panels;
use super::mends;
use super::pictures;
use super::sentences::{self, in_cm};
use super::session::{Session, set_cursor, shown, use_session};
use crate::errors::of_no_response;
use crate::mends::MendButton;
use crate::texts::{say, terms, tr};
use crate::widgets::{
    Card, ChartCanvas, ChartMenu, DataTable, Figure, Figures, Readout, ReasonedRow, Row, Sentence, TableContent, Text,
    TimeAxis, TimeSurface, Verdict, ZoomButtons, marked, unmarked,
};
use quadtank::literature::DisplayUnit;
use quadtank::sim::{NoResponse, TrackingMetrics};
use quadtank_figure::Frame;

/// The shortest stretch of time that can be shown (s).
const SHORTEST_S: f64 = 5.0;

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[terms::lost, terms::estimate, terms::costs];

/// The course with its sentence and its figures.
#[component]
pub fn CourseCard(
    /// Whether its figures are folded away.
    folded: bool,
) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let axis = time_axis(session);
    let picture = pictures::course(session, axis.window);
    let (for_menu, for_table) = (picture.clone(), picture.clone());
    let title = say!(lab, free.course);
    let figures = move || view! { <RunFigures /> <DataTable picture=for_table id="free-table" /> };
    // Read in three places, worked out once.
    let found = Memo::new(move |_| sentences::of_run(session));
    let readout = Signal::derive(move || session.own.cursor.get().and_then(|_| readout(session)));
    let spoken = Signal::derive(move || readout.get().map_or_else(String::new, |readout| readout.spoken()));
    let beside = move || {
        view! {
            <div class="toolbar">
                <ZoomButtons axis ids=["free-zoom-in", "free-zoom-out", "free-zoom-reset"] />
            </div>
            <ChartMenu picture=for_menu file="model-free" title />
        }
    };
    view! {
        <Card name="course" panel=panels::RESPONSES title terms=TERMS beside>
            <div class="mended">
                <Verdict id="free-verdict" warm=Signal::derive(move || !found.get().0)>
                    {move || marked(&found.get().1)}
                </Verdict>
                <MendButton session id="mend-free" offer=mends::of_run />
            </div>
            <div class="chart">
                <ChartCanvas
                    picture
                    frames
                    summary=Signal::derive(move || unmarked(&found.get().1))
                    name="free-course"
                    steady=true
                />
                <TimeSurface axis frames label=say!(lab, responses.cursor) spoken readout id="free-surface" />
            </div>
            {if folded {
                view! {
                    <details class="more">
                        <summary data-testid="free-fold">{say!(lab, responses.figures)}</summary>
                        {figures()}
                    </details>
                }
                .into_any()
            } else {
                figures().into_any()
            }}
        </Card>
    }
}

/// The figures of the run, and what they are of.
#[component]
fn RunFigures() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let (of_step, of_run) = (say!(lab, free.step_figures), say!(lab, responses.run_costs));
    view! {
        <h3>{of_step}</h3>
        <Figures name="free-figures" caption=of_step>{move || step_table(session)}</Figures>
        <h3>{of_run}</h3>
        <Figures name="free-costs" caption=of_run>{move || cost_table(session)}</Figures>
        <p class="remark" data-testid="free-note">{move || note(session)}</p>
        <Sentence id="free-comparison" text=Signal::derive(move || sentences::of_comparison(session)) />
    }
}

fn time_axis(session: Session) -> TimeAxis {
    let end = session.part(|s| s.experiment.duration_s);
    let on_cursor = Callback::new(move |time| set_cursor(session, time));
    TimeAxis::of_run(end, session.own.cursor.into(), on_cursor, Signal::stored(SHORTEST_S))
}

/// The values at the shown moment.
fn readout(session: Session) -> Option<Readout> {
    let shown = shown(session)?;
    let style = session.lab.number_style();
    let pair = |symbols: [&str; 2], values: [String; 2]| [0, 1].map(|k| format!("{} {}", symbols[k], values[k]));
    let [h1, h2, h3, h4] = shown.state.levels.map(|level| format!("{} cm", style.fixed(in_cm(level), 2)));
    let mut pairs = vec![
        pair(["h₁", "h₂"], [h1, h2]),
        pair(["h₃", "h₄"], [h3, h4]),
        pair(["v₁", "v₂"], shown.state.pump_voltage.map(|v| format!("{} V", style.fixed(v, 2)))),
        pair(["γ₁", "γ₂"], shown.plant.valves.map(|gamma| style.fixed(gamma, 2))),
    ];
    if let Some(phi) = session.throttled.with_answer(|answer| answer.run.phi_at(shown.time_s)).flatten() {
        // The unit once: the row has to fit on a phone.
        let in_row = |[first, second]: [f64; 2]| {
            [style.fixed(in_cm(first), 3), format!("{} cm/s", style.fixed(in_cm(second), 3))]
        };
        let [estimates, true_values] = phi.map(in_row);
        pairs.extend([pair(["φ̂₁", "φ̂₂"], estimates), pair(["φ₁", "φ₂"], true_values)]);
    }
    Some(Readout { time: format!("t = {} s", style.fixed(shown.time_s, 0)), pairs })
}

/// How each level answered its last step.
fn step_table(session: Session) -> impl IntoView {
    let lab = session.lab;
    let columns = vec![
        tr!(lab, responses.run),
        tr!(lab, responses.overshoot),
        tr!(lab, responses.settling_2),
        tr!(lab, free.lost),
    ];
    let row = |name: String, k: usize, figures: &TrackingMetrics| {
        let figures = figures_of_step(session, k, figures);
        view! { <ReasonedRow class=["loop1", "loop2"][k] name figures /> }.into_any()
    };
    view! { <TableContent caption=tr!(lab, free.step_figures) columns rows=rows(session, row) /> }
}

/// What the whole run cost.
fn cost_table(session: Session) -> impl IntoView {
    let lab = session.lab;
    let unit = "cm";
    let columns = vec![
        tr!(lab, responses.run),
        tr!(lab, responses.iae, unit = unit),
        tr!(lab, responses.ise, unit = unit),
        tr!(lab, responses.variation),
        tr!(lab, responses.saturated),
    ];
    let row = |name: String, k: usize, figures: &TrackingMetrics| {
        view! { <Row class=["loop1", "loop2"][k] name figures=costs_of_run(session, figures) /> }.into_any()
    };
    view! { <TableContent caption=tr!(lab, responses.run_costs) columns rows=rows(session, row) /> }
}

/// A row for each loop of the law, those of the comparison below them.
fn rows(session: Session, row: impl Fn(String, usize, &TrackingMetrics) -> AnyView) -> Vec<AnyView> {
    let lab = session.lab;
    let rows = session.throttled.with_answer(|answer| {
        let law = answer.figures.iter().enumerate();
        let law = law.map(|(k, figures)| row(tr!(lab, responses.row, number = k + 1), k, figures));
        let pi = answer.comparison.iter().flat_map(|(_, figures)| figures.iter().enumerate());
        let pi = pi.map(|(k, figures)| row(tr!(lab, free.row_pi, number = k + 1), k, figures));
        law.chain(pi).collect::<Vec<_>>()
    });
    rows.unwrap_or_default()
}

fn figures_of_step(session: Session, index: usize, figures: &TrackingMetrics) -> Vec<Figure> {
    let lab = session.lab;
    let style = lab.number_style();
    let [overshoot, settling] = match figures.no_response {
        Some(reason) => [0, 1].map(|_| Figure::None(why(session, index, reason))),
        None => [
            Figure::Shown(format!("{}\u{a0}%", style.fixed(100.0 * figures.overshoot.unwrap_or_default(), 1))),
            match figures.settling_s {
                Some(time_s) => Figure::Shown(style.fixed(time_s, 0)),
                None => Figure::None(tr!(lab, free.not_settled, level = index + 1)),
            },
        ],
    };
    let lost = match figures.lost_at_s {
        Some(time_s) => Figure::Shown(style.fixed(time_s, 0)),
        None => Figure::None(tr!(lab, free.not_lost, level = index + 1)),
    };
    vec![overshoot, settling, lost]
}

fn costs_of_run(session: Session, figures: &TrackingMetrics) -> [String; 4] {
    let style = session.lab.number_style();
    [
        style.fixed(in_cm(figures.iae), 1),
        style.fixed(in_cm(in_cm(figures.ise)), 1),
        style.fixed(figures.total_variation, 1),
        style.fixed(figures.saturated_s, 0),
    ]
}

/// Why a level (index) has no step-response figures.
fn why(session: Session, index: usize, reason: NoResponse) -> String {
    let lab = session.lab;
    match reason {
        NoResponse::UnstableLoop => tr!(lab, free.why_unstable),
        _ => of_no_response(lab, DisplayUnit::Cm, index, reason),
    }
}

/// What the figures of the step are of, and which steps come too late.
fn note(session: Session) -> String {
    let lab = session.lab;
    let parts = session.throttled.with_answer(|answer| {
        let judged = answer.judged_without_noise.then(|| tr!(lab, responses.without_noise));
        let reasons = answer.figures.iter().enumerate().filter_map(|(k, figures)| Some((k, figures.no_response?)));
        // Others are said of the run or of the loop already.
        let said = reasons.filter(|(_, reason)| {
            use NoResponse::{NotAtRest, StepAfterEnd, TooLongToJudge};
            matches!(reason, StepAfterEnd { .. } | NotAtRest { .. } | TooLongToJudge)
        });
        judged.into_iter().chain(said.map(|(k, reason)| why(session, k, reason))).collect::<Vec<_>>()
    });
    parts.unwrap_or_default().join(" ")
}

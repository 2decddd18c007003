//! The run: what is controlled, what that does to the upper tanks, and what the law believes.

use leptos::prelude::*;

use super::pictures;
use super::sentences::{self, in_cm};
use super::session::Session;
use crate::texts::{say, tr};
use crate::widgets::html::{element, escape, headings, rich, row};
use crate::widgets::{
    ChartCanvas, ChartMenu, DataTable, TimeAxis, TimeSurface, ZoomButtons, card as card_of, figures, sentence, verdict,
};
use quadtank::sim::TrackingFigures;
use quadtank_figure::Frame;

/// The shortest stretch of time that can be shown (s).
const SHORTEST_S: f64 = 5.0;

/// The course with its sentence and its figures.
pub fn card(session: Session) -> AnyView {
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let axis = time_axis(session);
    let picture = pictures::course(session, axis.window);
    let title = say!(lab, free.course);
    let summary = Signal::derive(move || sentences::of_run(session).1.replace("**", ""));
    let html = Signal::derive(move || rich(&sentences::of_run(session).1));
    let readout = Signal::derive(move || if session.cursor.get().is_some() { readout(session) } else { String::new() });
    let spoken = Signal::derive(move || plain(&readout.get()));
    let beside = view! {
        <div class="toolbar">
            <ZoomButtons axis ids=["free-zoom-in", "free-zoom-out", "free-zoom-reset"] />
        </div>
        <ChartMenu picture=picture.clone() file="model-free" title />
    };
    let charts = view! {
        <div class="chart">
            <ChartCanvas picture=picture.clone() frames summary name="free-course" />
            <TimeSurface axis frames label=say!(lab, responses.cursor) spoken readout id="free-surface" />
        </div>
    };
    let content = vec![
        verdict("free-verdict".to_owned(), Signal::derive(move || !sentences::of_run(session).0), html),
        charts.into_any(),
        figures("free-figures", say!(lab, responses.metrics), Signal::derive(move || table(session))),
        sentence("free-comparison", Signal::derive(move || sentences::of_comparison(session))),
        view! { <DataTable picture id="free-table" /> }.into_any(),
    ];
    card_of("course", title, vec![beside.into_any()], content)
}

fn time_axis(session: Session) -> TimeAxis {
    let end = session.part(|s| s.experiment.duration_s);
    let shown = RwSignal::new(None::<(f64, f64)>);
    // A stretch of a longer run may lie beyond the end of this one.
    let window = move || shown.get().filter(|(_, to)| *to <= end.get()).unwrap_or((0.0, end.get()));
    TimeAxis {
        whole: Signal::derive(move || (0.0, end.get())),
        window: Signal::derive(window),
        cursor: session.cursor,
        on_cursor: Callback::new(move |time| session.set_cursor(time)),
        on_show: Callback::new(move |stretch| shown.set(stretch)),
        about: Signal::stored(None),
        shortest: SHORTEST_S,
    }
}

/// The values at the shown moment as HTML.
fn readout(session: Session) -> String {
    let Some(shown) = session.shown() else { return String::new() };
    let style = session.lab.number_style();
    let pair = |symbols: [&str; 2], values: [String; 2]| {
        let one = |k: usize| {
            element("span", ["class=\"loop1\"", "class=\"loop2\""][k], &format!("{} {}", symbols[k], values[k]))
        };
        element("div", "", &format!("{} · {}", one(0), one(1)))
    };
    let [h1, h2, h3, h4] = shown.state.levels.map(|level| format!("{} cm", style.fixed(in_cm(level), 2)));
    let head = element("div", "", &format!("t = {} s", style.fixed(shown.time_s, 0)));
    let pumps = shown.state.pump_voltage.map(|v| format!("{} V", style.fixed(v, 2)));
    let valves = shown.plant.valves.map(|gamma| style.fixed(gamma, 2));
    let phi = session.words.with_answer(|answer| answer.run.phi_at(shown.time_s)).flatten().map(|phi| {
        // The unit once: the row has to fit on a phone.
        let in_row = |[first, second]: [f64; 2]| {
            [style.fixed(in_cm(first), 3), format!("{} cm/s", style.fixed(in_cm(second), 3))]
        };
        let [estimates, true_values] = phi.map(in_row);
        pair(["φ̂₁", "φ̂₂"], estimates) + &pair(["φ₁", "φ₂"], true_values)
    });
    head + &pair(["h₁", "h₂"], [h1, h2])
        + &pair(["h₃", "h₄"], [h3, h4])
        + &pair(["v₁", "v₂"], pumps)
        + &pair(["γ₁", "γ₂"], valves)
        + &phi.unwrap_or_default()
}

/// The words of a piece of HTML.
fn plain(html: &str) -> String {
    html.split('<').filter_map(|part| part.split_once('>')).map(|(_, words)| words).collect::<Vec<_>>().join(" ")
}

/// How the loops did, those of the comparison below them.
fn table(session: Session) -> String {
    let lab = session.lab;
    let unit = "cm";
    let names = [
        tr!(lab, responses.run).to_owned(),
        tr!(lab, responses.iae, unit = unit).to_string(),
        tr!(lab, responses.ise, unit = unit).to_string(),
        tr!(lab, responses.overshoot).to_owned(),
        tr!(lab, responses.settling_2).to_owned(),
        tr!(lab, responses.variation).to_owned(),
        tr!(lab, responses.saturated).to_owned(),
        tr!(lab, free.lost).to_owned(),
    ];
    let caption = element("caption", "class=\"visually-hidden\"", &escape(tr!(lab, responses.metrics)));
    let rows = session.words.with_answer(|answer| {
        let of = |figures: &[TrackingFigures; 2], name: fn(Session, usize) -> String| -> String {
            (0..2)
                .map(|k| row(["loop1", "loop2"][k], &name(session, k + 1), &figures_of(session, &figures[k])))
                .collect()
        };
        let law = of(&answer.figures, |session, level| tr!(session.lab, responses.row, number = level).to_string());
        let pi = answer.comparison.as_ref().map(|(_, figures)| {
            of(figures, |session, level| tr!(session.lab, free.row_pi, number = level).to_string())
        });
        law + &pi.unwrap_or_default()
    });
    caption + &element("thead", "", &headings(&names)) + &element("tbody", "", &rows.unwrap_or_default())
}

fn figures_of(session: Session, figures: &TrackingFigures) -> [String; 7] {
    let style = session.lab.number_style();
    let never = || "–".to_owned();
    [
        style.fixed(in_cm(figures.iae), 1),
        style.fixed(in_cm(in_cm(figures.ise)), 1),
        figures.overshoot.map_or_else(never, |share| format!("{}\u{a0}%", style.fixed(100.0 * share, 1))),
        figures.settling_s.map_or_else(never, |time| style.fixed(time, 0)),
        style.fixed(figures.total_variation, 1),
        style.fixed(figures.saturated_s, 0),
        figures.lost_at_s.map_or_else(never, |time| style.fixed(time, 0)),
    ]
}

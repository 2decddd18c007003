//! The map of the cost over gain and integral time, and the searches in it.

use leptos::prelude::*;
use quadtank::study::level_loop::{LevelLoopSetup, PiTuning};
use quadtank::tuning::{CostMeasure, VIOLATION};
use quadtank_figure::Frame;

use super::errors;
use super::exploration::{Method, Work, start_map, start_search};
use super::flags::{locks, panels};
use super::pictures::{self, Shown};
use super::sentences::variance;
use super::session::{Session, use_session};
use crate::controls::{ParamControl, ParamRow, Switch};
use crate::lab::Lab;
use crate::shown::ShownUnit;
use crate::texts::{say, symbol, terms, tr};
use crate::widgets::{Card, ChartCanvas, ChartMenu, Sentence, Text, Tick};

/// Largest sensitivity peak that a search may be held to.
const PEAK: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "search-peak"); 2],
    label: |_, _| "Ms ≤".to_owned(),
    name: |lab, _| tr!(lab, level.largest_peak),
    path: |_, _| "search.largest_sensitivity",
    read: |s, _| s.search.largest_sensitivity.unwrap_or(USUAL_PEAK),
    write: |s, _, peak| s.search.largest_sensitivity = Some(peak),
    digits: Some(2),
    matters: Some(|s| s.search.largest_sensitivity.is_some()),
    ..ParamControl::locked_by(locks::OBJECTIVE)
};
const PENALTY: ParamControl<LevelLoopSetup> = ParamControl {
    ids: [("", "search-penalty"); 2],
    label: |_, _| "ρ".to_owned(),
    name: |lab, _| tr!(lab, level.move_penalty),
    path: |_, _| "search.move_penalty",
    read: |s, _| s.search.move_penalty,
    write: |s, _, penalty| s.search.move_penalty = penalty,
    matters: None,
    digits: None,
    shown_unit: Some(|_| ShownUnit::called("")),
    ..PEAK
};

/// A sensitivity peak that is often asked for.
const USUAL_PEAK: f64 = 1.7;

/// The words of the card that explain themselves.
const TERMS: &[Text] = &[
    terms::cost_map,
    terms::search_box,
    terms::move_penalty,
    terms::gradient,
    terms::simplex,
    terms::genetic,
    terms::peak,
];

/// The map and the searches.
#[component]
pub fn MapCard() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let frames = RwSignal::new(Vec::<Frame>::new());
    let exploration = session.own.exploration;
    let map = Memo::new(move |_| exploration.map_of(&session.throttled.setup.get()).map(Shown));
    let search = Memo::new(move |_| exploration.search_of(&session.throttled.setup.get()).map(Shown));
    let picture = pictures::cost_map(session, map, search);
    let for_menu = picture.clone();
    let title = say!(lab, level.map_title);
    let summary = Signal::derive(move || sentence(session, map.get(), search.get()));
    let best = move || search.get().and_then(|search| search.0.value.search.best());
    let take_best = move |_| {
        if let Some(best) = untrack(best) {
            let [gain, integral_time_s] = best.point;
            session.edit(|s| s.set_pi_tuning(PiTuning { gain, integral_time_s }));
        }
    };
    let make_reference = move |_| {
        if let Some(best) = untrack(best) {
            let [gain, integral_time_s] = best.point;
            session.edit(|s| s.reference = PiTuning { gain, integral_time_s });
        }
    };
    view! {
        <Card name="map" panel=panels::MAP title terms=TERMS beside=move || view! { <ChartMenu picture=for_menu file="cost-map" title /> }>
            <MeasureSwitch />
            <Constraints />
            <div class="toolbar">
                <Start work=Work::Map id="map-start" text=say!(lab, level.compute_map) />
                <Start work=Work::Search(Method::Gradient) id="search-gradient" text=say!(lab, level.method_gradient) />
                <Start work=Work::Search(Method::NelderMead) id="search-simplex" text=say!(lab, level.simplex) />
                <Start work=Work::Search(Method::Genetic) id="search-genetic" text=say!(lab, level.method_genetic) />
                <Progress />
            </div>
            <div class="chart square"><ChartCanvas picture frames summary name="cost-map-chart" /></div>
            <Sentence id="map-sentence" text=summary status=true />
            <div class="toolbar" hidden=move || best().is_none()>
                <button type="button" class="button small" data-testid="search-take" disabled=lab.locks(locks::GAINS) on:click=take_best>
                    {say!(lab, level.take_best)}
                </button>
                <button type="button" class="button small" data-testid="search-reference" disabled=lab.locks(locks::GAINS) on:click=make_reference>
                    {say!(lab, level.best_as_reference)}
                </button>
            </div>
        </Card>
    }
}

/// What is made small.
#[component]
fn MeasureSwitch() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    view! {
        <Switch
            session
            label=say!(lab, level.cost)
            choices=vec![
                (CostMeasure::LevelVariance, "cost-level", say!(lab, level.cost_level)),
                (CostMeasure::OutflowVariance, "cost-outflow", say!(lab, level.cost_outflow)),
                (CostMeasure::Iae, "cost-iae", symbol("IAE")),
                (CostMeasure::Ise, "cost-ise", symbol("ISE")),
                (CostMeasure::Itae, "cost-itae", symbol("ITAE")),
            ]
            read=|s| s.search.measure
            write=|s, measure| s.search.measure = measure
            lock=locks::OBJECTIVE
        />
    }
}

/// Constraints of the cost.
#[component]
fn Constraints() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let lock = lab.locks(locks::OBJECTIVE);
    view! {
        <div class="toolbar">
            <Tick
                id="search-robust"
                text=say!(lab, level.keep_robust)
                ticked=lab.throttled(session.part(|s| s.search.largest_sensitivity.is_some()))
                disabled=lock
                on_tick=move |on: bool| {
                    session.edit(|s| s.search.largest_sensitivity = on.then_some(USUAL_PEAK));
                }
            />
            <ParamRow session control=&PEAK />
            <Tick
                id="search-band"
                text=say!(lab, level.keep_band)
                ticked=lab.throttled(session.part(|s| s.search.keep_band))
                disabled=lock
                on_tick=move |on: bool| session.edit(|s| s.search.keep_band = on)
            />
            <ParamRow session control=&PENALTY />
        </div>
    }
}

/// Starts a computation; while it runs, the same button ends it.
#[component]
fn Start(work: Work, id: &'static str, #[prop(into)] text: Signal<String>) -> impl IntoView {
    let session = use_session();
    let exploration = session.own.exploration;
    let runs = move || exploration.work.get() == Some(work);
    let press = move |_| match (untrack(runs), work) {
        (true, _) => exploration.cancel(),
        (false, Work::Map) => start_map(session),
        (false, Work::Search(method)) => start_search(session, method),
    };
    view! {
        <button type="button" class="button small" data-testid=id aria-pressed=move || runs().to_string() on:click=press>
            {text}
        </button>
    }
}

/// How far the computation is, and a way to end it.
#[component]
fn Progress() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let exploration = session.own.exploration;
    let is_idle = move || exploration.work.get().is_none();
    let share = move || match exploration.work.get() {
        Some(Work::Map) => exploration.map.with(|map| map.as_ref().map(|map| map.value.progress())),
        _ => None,
    };
    view! {
        <progress hidden=is_idle value=share aria-label=say!(lab, level.progress)></progress>
        <button
            type="button"
            class="button small"
            data-testid="work-cancel"
            hidden=is_idle
            on:click=move |_| exploration.cancel()
        >
            {say!(lab, level.cancel)}
        </button>
    }
}

/// What the map and the search have shown, and how long they took here and in the source.
fn sentence(
    session: Session,
    map: Option<Shown<quadtank::study::level_loop::ContourMap>>,
    search: Option<Shown<super::exploration::Searched>>,
) -> String {
    let lab = session.lab;
    let style = lab.number_style();
    if let Some(error) = session.own.exploration.refusal.get() {
        return tr!(lab, level.no_map, reason = errors::of_run(lab, &error));
    }
    let seconds = |ms: f64| style.significant(ms / 1000.0, 2);
    let setting = |value: f64| style.significant(value, 3);
    let mut parts = Vec::new();
    if let Some(Shown(map)) = map
        && map.value.progress() >= 1.0
        && let Some((cell, cost)) = map.value.best()
    {
        let [gain, time] = map.value.settings_of(cell);
        let [columns, rows] = map.value.size();
        parts.push(tr!(
            lab,
            level.map_found,
            cells = columns * rows,
            seconds = seconds(map.took_ms),
            gain = setting(gain),
            time = setting(time),
            cost = cost_text(lab, &map.setup, cost)
        ));
    }
    if let Some(Shown(found)) = search
        && let Some(best) = found.value.search.best()
    {
        let [gain, time] = best.point;
        let text = tr!(
            lab,
            level.search_found,
            method = method_text(lab, found.value.method),
            runs = found.value.search.evaluations(),
            seconds = seconds(found.took_ms),
            gain = setting(gain),
            time = setting(time),
            cost = cost_text(lab, &found.setup, best.cost)
        );
        parts.push(text);
        let at_bound = found.setup.search.at_bounds(best.point);
        if at_bound[0] {
            parts.push(tr!(lab, level.gain_at_bound));
        }
        if at_bound[1] {
            parts.push(tr!(lab, level.time_at_bound));
        }
    }
    if parts.is_empty() { tr!(lab, level.map_idle) } else { parts.join(" ") }
}

/// A cost with its unit; without one where moves of the output are part of it. That of a violated constraint is no cost.
fn cost_text(lab: Lab, setup: &LevelLoopSetup, cost: f64) -> String {
    if cost >= VIOLATION {
        return tr!(lab, level.no_cost);
    }
    let number = |value: f64| lab.number_style().significant(value, 5);
    if setup.search.move_penalty > 0.0 {
        return number(cost);
    }
    match setup.search.measure {
        CostMeasure::LevelVariance => format!("{} m²", variance(lab, cost)),
        CostMeasure::OutflowVariance => format!("{} (m³/s)²", variance(lab, cost)),
        CostMeasure::Iae => format!("{} cm s", number(100.0 * cost)),
        CostMeasure::Ise => format!("{} cm² s", number(1e4 * cost)),
        CostMeasure::Itae => format!("{} cm s²", number(100.0 * cost)),
    }
}

/// The name of a method of search, and how long the source needed for it where it says so.
fn method_text(lab: Lab, method: Method) -> String {
    match method {
        Method::Gradient => tr!(lab, level.gradient_long),
        Method::NelderMead => tr!(lab, level.simplex),
        Method::Genetic => tr!(lab, level.genetic_long),
    }
}

//! Parameters of the rig from the record that is open.

use gloo_timers::future::TimeoutFuture;
use leptos::prelude::*;
use quadtank_record::{Estimate, Fit, FitReport, Parameter, RecordError};
use quadtank_scenario::Scenario;

use super::flags::locks;
use super::record::OpenRecord;
use super::record_view::why;
use super::session::{Session, use_session};
use crate::lab::Lab;
use crate::shown::{to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Cells, Figures, TableContent, Tick};

/// Parameters that are free when nothing has been chosen yet: those that a laboratory rarely knows.
const FIRST: [Parameter; 4] =
    [Parameter::Valve(0), Parameter::Valve(1), Parameter::PumpGain(0), Parameter::PumpGain(1)];

/// A fit as the page shows it.
#[derive(Clone)]
struct Shown {
    /// What has been found, in the document of the time when it began.
    fit: Fit,
    before: Scenario,
    rounds: usize,
    /// Whether it was stopped by hand.
    stopped: bool,
}

impl Shown {
    fn runs(&self) -> bool {
        !self.fit.is_over() && !self.stopped
    }
}

/// Choice of the parameters, the search, and what it found.
#[component]
pub fn FitControls() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let chosen = RwSignal::new(FIRST.to_vec());
    let shown = RwSignal::new_local(None::<Shown>);
    let refused = RwSignal::new(None::<RecordError>);
    let runs = Memo::new(move |_| shown.with(|shown| shown.as_ref().is_some_and(Shown::runs)));
    let start = move |_| {
        let record = session.own.record.get_untracked().and_then(|opened| opened.found.ok());
        let (Some(record), before) = (record, session.document.get_untracked()) else { return };
        match Fit::new(&before.setup, &record, &chosen.get_untracked()) {
            Ok(fit) => {
                refused.set(None);
                shown.set(Some(Shown { fit, before, rounds: 0, stopped: false }));
                search(shown);
            }
            Err(error) => refused.set(Some(error)),
        }
    };
    let stop = move |_| {
        shown.update(|shown| {
            if let Some(shown) = shown {
                shown.stopped = true;
            }
        });
    };
    let is_over = Memo::new(move |_| shown.with(|shown| shown.as_ref().is_some_and(|shown| !shown.runs())));
    let running = move || {
        shown.with(|shown| {
            let shown = shown.as_ref().filter(|shown| shown.runs())?;
            Some(tr!(lab, record.fit_running, round = shown.rounds, rmse = length(session, shown.fit.rmse())))
        })
    };
    view! {
        <details class="more fit" data-testid="fit-fold">
            <summary>{say!(lab, record.fit_title)}</summary>
            <p class="remark">{say!(lab, record.fit_about)}</p>
            <p class="remark" hidden=move || unrecorded(session).is_empty() data-testid="fit-unrecorded">
                {move || tr!(lab, record.begins_at_rest, tanks = unrecorded(session).join(", "))}
            </p>
            <div class="parameters" role="group" aria-label=say!(lab, record.fit_title)>
                {Parameter::ALL.map(|parameter| view! { <ParameterTick parameter chosen /> }).collect_view()}
            </div>
            <p class="links">
                <button type="button" class="button small strong" data-testid="fit-start" disabled=runs on:click=start>{say!(lab, record.fit_button)}</button>
                <button type="button" class="button small" data-testid="fit-stop" hidden=move || !runs.get() on:click=stop>{say!(lab, record.fit_stop)}</button>
                <span class="remark" role="status" class:warm=move || refused.with(Option::is_some)>
                    {move || refused.with(|error| error.as_ref().map(|error| why(lab, error))).or_else(running)}
                </span>
            </p>
            {move || is_over.get().then(|| shown.get_untracked()).flatten().map(|shown| found(session, &shown))}
        </details>
    }
}

/// Numbers of the tanks whose levels the record that is open has not.
fn unrecorded(session: Session) -> Vec<String> {
    session.own.record.with(|opened| {
        let record = opened.as_ref().and_then(OpenRecord::record);
        let columns = record.into_iter().flat_map(|record| record.levels.iter().enumerate());
        columns.filter(|(_, column)| column.is_empty()).map(|(tank, _)| (tank + 1).to_string()).collect()
    })
}

#[component]
fn ParameterTick(parameter: Parameter, chosen: RwSignal<Vec<Parameter>>) -> impl IntoView {
    let lab = use_session().lab;
    view! {
        <Tick
            id=tick_id(parameter)
            text=Signal::derive(move || name(lab, parameter))
            ticked=Signal::derive(move || chosen.with(|chosen| chosen.contains(&parameter)))
            disabled=false
            on_tick=move |on| chosen.update(|chosen| {
                chosen.retain(|other| *other != parameter);
                if on {
                    chosen.push(parameter);
                }
            })
        />
    }
}

/// Names for tests.
const fn tick_id(parameter: Parameter) -> &'static str {
    match parameter {
        Parameter::Valve(0) => "fit-gamma1",
        Parameter::Valve(_) => "fit-gamma2",
        Parameter::PumpGain(0) => "fit-k1",
        Parameter::PumpGain(_) => "fit-k2",
        Parameter::OutletArea(0) => "fit-a1",
        Parameter::OutletArea(1) => "fit-a2",
        Parameter::OutletArea(2) => "fit-a3",
        Parameter::OutletArea(_) => "fit-a4",
        Parameter::LevelOffset(0) => "fit-offset1",
        Parameter::LevelOffset(_) => "fit-offset2",
        Parameter::PumpDelay(0) => "fit-delay1",
        Parameter::PumpDelay(_) => "fit-delay2",
        Parameter::StartLevel(0) => "fit-start1",
        Parameter::StartLevel(1) => "fit-start2",
        Parameter::StartLevel(2) => "fit-start3",
        Parameter::StartLevel(_) => "fit-start4",
    }
}

/// Lets the solver go on round by round; between two rounds the page can be used.
fn search(shown: RwSignal<Option<Shown>, LocalStorage>) {
    leptos::task::spawn_local(async move {
        loop {
            // Nothing is left to search for where the card is gone.
            let Some(mut now) = shown.try_get_untracked().flatten().filter(Shown::runs) else { return };
            now.fit.advance();
            now.rounds += 1;
            TimeoutFuture::new(0).await;
            let stopped = shown.try_with_untracked(|last| last.as_ref().is_none_or(|last| last.stopped));
            let Some(stopped) = stopped else { return };
            now.stopped = stopped;
            if shown.try_set(Some(now)).is_some() {
                return;
            }
        }
    });
}

/// What was found, and a button that puts it on the rig.
fn found(session: Session, shown: &Shown) -> impl IntoView + use<> {
    let lab = session.lab;
    let (report, rig) = (shown.fit.report(), shown.before.setup.plant());
    let first = shown.fit.levels_before();
    let rows = {
        let report = report.clone();
        move || {
            let row = |estimate: &Estimate| {
                let before = value(session, estimate.parameter, estimate.parameter.of(&rig, &first));
                let bound =
                    if estimate.is_at_bound { format!(" ({})", tr!(lab, record.fit_bound)) } else { String::new() };
                let after = format!("{}{bound}", value(session, estimate.parameter, estimate.value));
                let error = estimate
                    .standard_error
                    .map_or_else(|| "–".to_owned(), |error| value(session, estimate.parameter, error));
                let texts = vec![before, after, error];
                view! { <tr><th scope="row">{name(lab, estimate.parameter)}</th><Cells texts /></tr> }.into_any()
            };
            report.estimates.iter().map(row).collect::<Vec<_>>()
        }
    };
    let heads = move || {
        vec![
            tr!(lab, record.fit_parameter),
            tr!(lab, record.fit_before),
            tr!(lab, record.fit_after),
            tr!(lab, record.fit_error),
        ]
    };
    let told = Signal::derive(move || told(session, &report));
    let fit = shown.fit.clone();
    let taken = RwSignal::new(false);
    let take = move |_| {
        session.edit(|present| *present = fit.setup(present));
        taken.set(true);
    };
    view! {
        <p role="status" data-testid="fit-told">{told}</p>
        <Figures name="fit-table" caption=say!(lab, record.fit_title)>
            {move || view! { <TableContent caption=tr!(lab, record.fit_title) columns=heads() rows=rows() /> }}
        </Figures>
        <p class="remark">{say!(lab, record.fit_error_hint)}</p>
        <p class="links">
            <button type="button" class="button small strong" data-testid="fit-take" disabled=lab.locks(locks::PRESET) on:click=take>{say!(lab, record.fit_take)}</button>
            <span class="remark" role="status">{move || taken.get().then(|| tr!(lab, record.fit_taken))}</span>
        </p>
    }
}

/// How much better the simulation has become, and what the record does not tell.
fn told(session: Session, report: &FitReport) -> String {
    let lab = session.lab;
    let [before, after] = report.rmse.map(|rmse| length(session, rmse));
    let name_of = |index: usize| name(lab, report.estimates[index].parameter);
    let mut parts = vec![tr!(lab, record.fit_done, values = report.values, before = before, after = after)];
    parts.extend((!report.converged).then(|| tr!(lab, record.fit_unfinished)));
    if report.correlation.is_none() {
        parts.push(tr!(lab, record.fit_singular));
    } else {
        parts.extend(
            report
                .alike
                .iter()
                .map(|&[one, other]| tr!(lab, record.fit_alike, one = name_of(one), other = name_of(other))),
        );
        let vague: Vec<String> = report.vague.iter().map(|&index| name_of(index)).collect();
        parts.extend((!vague.is_empty()).then(|| tr!(lab, record.fit_vague, names = vague.join(", "))));
    }
    parts.join(" ")
}

fn length(session: Session, metres: f64) -> String {
    let unit = session.own.unit.get();
    format!("{}\u{a0}{}", session.lab.number_style().significant(to_shown(metres, unit), 3), unit_name(unit))
}

/// A value of a parameter as the page shows it: flows in cm³/s, areas in cm².
fn value(session: Session, parameter: Parameter, value: f64) -> String {
    let style = session.lab.number_style();
    match parameter {
        Parameter::Valve(_) => style.significant(value, 3),
        Parameter::PumpGain(_) => format!("{}\u{a0}cm³/(s\u{a0}V)", style.significant(1e6 * value, 4)),
        Parameter::OutletArea(_) => format!("{}\u{a0}cm²", style.significant(1e4 * value, 4)),
        Parameter::LevelOffset(_) | Parameter::StartLevel(_) => length(session, value),
        Parameter::PumpDelay(_) => format!("{}\u{a0}s", style.significant(value, 3)),
    }
}

fn name(lab: Lab, parameter: Parameter) -> String {
    match parameter {
        Parameter::Valve(index) => tr!(lab, record.p_gamma, number = index + 1),
        Parameter::PumpGain(index) => tr!(lab, record.p_k, number = index + 1),
        Parameter::OutletArea(index) => tr!(lab, record.p_a, number = index + 1),
        Parameter::LevelOffset(index) => tr!(lab, record.p_offset, number = index + 1),
        Parameter::PumpDelay(index) => tr!(lab, record.p_delay, number = index + 1),
        Parameter::StartLevel(index) => tr!(lab, record.p_start, number = index + 1),
    }
}

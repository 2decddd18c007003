//! Parameters of the rig from the record that is open.

use leptos::prelude::*;
use quadtank::study::quadruple_tank::Setup;
use quadtank_record::{Fit, Parameter, RecordError};

use super::fit_bounds::{Bounds, BoundsFold, sought};
use super::fit_found::{length, name, result};
use super::record::OpenRecord;
use super::record_errors::why;
use super::session::{Session, use_session};
use crate::slices::Slices;
use crate::texts::{say, tr};
use crate::widgets::Tick;

/// Parameters that are free when nothing has been chosen yet: those that a laboratory rarely knows.
const FIRST: [Parameter; 4] =
    [Parameter::Valve(0), Parameter::Valve(1), Parameter::PumpGain(0), Parameter::PumpGain(1)];

/// A fit that is over or was stopped.
#[derive(Clone)]
pub struct Found {
    /// The estimates.
    pub fit: Fit,
    /// The setup when it began.
    pub before: Setup,
}

/// A search as the page follows it. A handle: copying it copies nothing.
#[derive(Clone, Copy)]
struct Search {
    /// Rounds so far and the root mean square of the differences (m), while it runs.
    progress: RwSignal<Option<(usize, f64)>>,
    /// Result of the last fit.
    found: RwSignal<Option<Found>, LocalStorage>,
    under_way: StoredValue<Option<Found>, LocalStorage>,
    slices: StoredValue<Option<Slices>, LocalStorage>,
}

impl Search {
    fn new() -> Self {
        Self {
            progress: RwSignal::new(None),
            found: RwSignal::new_local(None),
            under_way: StoredValue::new_local(None),
            slices: StoredValue::new_local(None),
        }
    }

    /// Lets a fit go on until it is over; between two rounds the page can be used. One that runs is given up.
    fn start(self, fit: Fit, before: Setup) {
        self.slices.set_value(None);
        self.found.set(None);
        self.progress.set(Some((0, fit.rmse())));
        self.under_way.set_value(Some(Found { fit, before }));
        let step = move || {
            let advance = |under_way: &mut Option<Found>| {
                under_way.as_mut().is_some_and(|Found { fit, .. }| {
                    fit.advance();
                    !fit.is_over()
                })
            };
            self.under_way.try_update_value(advance).unwrap_or(false)
        };
        let after_slice = move |is_last: bool| {
            if is_last {
                return self.end();
            }
            let rmse = self.under_way.try_with_value(|under_way| under_way.as_ref().map(|found| found.fit.rmse()));
            // Nobody follows it where the card is gone.
            self.progress.try_update(|progress| {
                *progress = progress.zip(rmse.flatten()).map(|((rounds, _), rmse)| (rounds + 1, rmse));
            });
        };
        self.slices.set_value(Some(Slices::start(step, after_slice)));
    }

    /// Ends the search where it stands.
    fn stop(self) {
        self.slices.set_value(None);
        self.end();
    }

    fn end(self) {
        self.progress.try_set(None);
        if let Some(found) = self.under_way.try_update_value(Option::take).flatten() {
            self.found.try_set(Some(found));
        }
    }
}

/// Choice of the parameters, the search, and what it found.
#[component]
pub fn FitControls() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let chosen = RwSignal::new(FIRST.to_vec());
    let bounds = RwSignal::new(Bounds::default());
    let search = Search::new();
    let refused = RwSignal::new(None::<RecordError>);
    let runs = Memo::new(move |_| search.progress.with(Option::is_some));
    let start = move |_| {
        let record = session.own.record.get_untracked().and_then(|opened| opened.found.ok());
        let (Some(record), before) = (record, session.document.with_untracked(|document| document.setup.clone()))
        else {
            return;
        };
        let sought = bounds.with_untracked(|bounds| sought(&before, &record, &chosen.get_untracked(), bounds));
        match Fit::within(&before, &record, &sought) {
            Ok(fit) => {
                refused.set(None);
                search.start(fit, before);
            }
            Err(error) => refused.set(Some(error)),
        }
    };
    let running = move || {
        let (rounds, rmse) = search.progress.get()?;
        Some(tr!(lab, record.fit_running, round = rounds, rmse = length(session, rmse)))
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
            <BoundsFold chosen bounds />
            <p class="links">
                <button type="button" class="button small strong" data-testid="fit-start" disabled=runs on:click=start>{say!(lab, record.fit_button)}</button>
                <button type="button" class="button small" data-testid="fit-stop" hidden=move || !runs.get() on:click=move |_| search.stop()>{say!(lab, record.fit_stop)}</button>
                <span class="remark" role="status" class:warm=move || refused.with(Option::is_some)>
                    {move || refused.with(|error| error.as_ref().map(|error| why(lab, error))).or_else(running)}
                </span>
            </p>
            {move || search.found.get().map(|found| result(session, &found))}
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

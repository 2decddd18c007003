//! Starting values and bounds of a fit.

use std::collections::HashMap;

use leptos::prelude::*;
use quadtank::study::quadruple_tank::Setup;
use quadtank_record::{Parameter, Record, Sought, levels_at_start};

use super::fit_found::{name, value};
use super::record::OpenRecord;
use super::session::{Session, use_session};
use crate::shown::per_metre;
use crate::texts::{say, tr};
use crate::widgets::{Folded, NumberField, Scale, TableContent};

/// Bounds that were typed, which replace the default ones.
pub type Bounds = HashMap<Parameter, [f64; 2]>;

/// Parameters to estimate for the rig of a setup: they start at its values, within the typed bounds or else the default ones.
pub fn sought(setup: &Setup, record: &Record, chosen: &[Parameter], bounds: &Bounds) -> Vec<Sought> {
    let (rig, first) = (setup.plant(), levels_at_start(setup, record));
    let of = |&parameter: &Parameter| {
        let usual = Sought::usual(parameter, &rig, &first);
        Sought { bounds: bounds.get(&parameter).copied().unwrap_or(usual.bounds), ..usual }
    };
    chosen.iter().map(of).collect()
}

/// A row for each chosen parameter.
#[component]
pub fn BoundsFold(chosen: RwSignal<Vec<Parameter>>, bounds: RwSignal<Bounds>) -> impl IntoView {
    let lab = use_session().lab;
    let content = move || {
        let columns = vec![
            tr!(lab, record.fit_parameter),
            tr!(lab, record.fit_start),
            tr!(lab, record.fit_low),
            tr!(lab, record.fit_high),
        ];
        let row = |parameter| view! { <BoundsRow parameter bounds /> }.into_any();
        let rows = chosen.get().into_iter().map(row).collect::<Vec<_>>();
        view! { <TableContent caption=tr!(lab, record.fit_bounds) columns rows /> }
    };
    view! { <Folded id="fit-bounds" summary=say!(lab, record.fit_bounds) caption=say!(lab, record.fit_bounds) content /> }
}

#[component]
fn BoundsRow(parameter: Parameter, bounds: RwSignal<Bounds>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let found = Memo::new(move |_| {
        session.own.record.with(|opened| {
            let record = opened.as_ref().and_then(OpenRecord::record)?;
            let of = |setup: &Setup| bounds.with(|bounds| sought(setup, record, &[parameter], bounds)).first().copied();
            session.read(of)
        })
    });
    let allowed = Memo::new(move |_| session.read(|setup| parameter.allowed(&setup.plant())));
    let scale = move || per_shown(session, parameter);
    let bound =
        move |end: usize| Signal::derive(move || found.get().map_or(0.0, |sought| sought.bounds[end]) * scale());
    let set = move |end: usize| {
        move |shown: f64| {
            let Some(mut ends) = found.get_untracked().map(|sought| sought.bounds) else { return };
            ends[end] = shown / untrack(scale);
            bounds.update(|bounds| {
                bounds.insert(parameter, ends);
            });
        }
    };
    let limits = Signal::derive(move || (allowed.get().min * scale(), allowed.get().max * scale()));
    let step =
        Signal::derive(move || Scale::Linear(0.01 * found.get().map_or(1.0, |sought| sought.bounds[1]) * scale()));
    let low_name = Signal::derive(move || tr!(lab, record.fit_low_of, name = name(lab, parameter)));
    let high_name = Signal::derive(move || tr!(lab, record.fit_high_of, name = name(lab, parameter)));
    let field = move |end: usize, id: &'static str, name: Signal<String>| {
        view! {
            <NumberField
                id
                name
                value=bound(end)
                on_change=set(end)
                limits
                scale=step
                digits=Signal::stored(None)
                disabled=false
            />
        }
    };
    view! {
        <tr>
            <th scope="row">{move || name(lab, parameter)}</th>
            <td>{move || found.get().map(|sought| value(session, parameter, sought.start))}</td>
            <td>{field(0, "fit-low", low_name)}</td>
            <td>{field(1, "fit-high", high_name)}</td>
        </tr>
    }
}

/// Factor from the unit of a parameter in the core to the unit in which [`value`] shows it.
fn per_shown(session: Session, parameter: Parameter) -> f64 {
    match parameter {
        Parameter::Valve(_) | Parameter::PumpDelay(_) => 1.0,
        Parameter::PumpGain(_) => 1e6,
        Parameter::OutletArea(_) => 1e4,
        Parameter::LevelOffset(_) | Parameter::StartLevel(_) => per_metre(session.own.unit.get()),
    }
}

//! A measured record over the responses: the file, what its columns are, and how well the simulation agrees with it.

use std::sync::Arc;

use leptos::html::Input;
use leptos::prelude::*;
use quadtank_figure::Frame;
use quadtank_record::{
    Agreement, ColumnMeaning, MAX_BYTES, NamedUnit, RecordError, Signal as Recorded, Unit, agreement, replay,
};

use super::fit_view::FitControls;
use super::flags::locks;
use super::pictures::residuals;
use super::record::OpenRecord;
use super::record_errors::why;
use super::session::{Session, use_session};
use crate::lab::Lab;
use crate::share::read_file;
use crate::shown::{to_shown, unit_name};
use crate::texts::{say, tr};
use crate::widgets::{Cells, ChartCanvas, Choice, DataTable, Figures, Select, TableContent, is_open};

/// The record, folded away until it is wanted.
#[component]
pub fn RecordFold() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let opened = session.own.record;
    let has_file = Memo::new(move |_| opened.with(Option::is_some));
    view! {
        <details class="more record" data-testid="record-fold">
            <summary>{say!(lab, record.title)}</summary>
            <p class="remark">{say!(lab, record.about)}</p>
            <FileButtons />
            {move || has_file.get().then(|| view! { <OpenFile /> })}
        </details>
    }
}

#[component]
fn FileButtons() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let opened = session.own.record;
    let picker = NodeRef::<Input>::new();
    let on_file = move |_| {
        let Some(input) = picker.get_untracked() else { return };
        if let Some(file) = input.files().and_then(|files| files.get(0)) {
            open(session, &file);
        }
        // The same file can then be opened again.
        input.set_value("");
    };
    view! {
        <p class="links">
            <button type="button" class="button small" data-testid="record-open" on:click=move |_| if let Some(input) = picker.get_untracked() { input.click() }>
                {say!(lab, record.open)}
            </button>
            <button type="button" class="button small" data-testid="record-close" hidden=move || opened.with(Option::is_none) on:click=move |_| opened.set(None)>
                {say!(lab, record.close)}
            </button>
            <input
                type="file"
                accept=".csv,.tsv,.txt,.dat,text/csv,text/tab-separated-values,text/plain"
                hidden
                node_ref=picker
                data-testid="record-input"
                on:change=on_file
            />
        </p>
    }
}

/// Reads a file. A huge one is refused before it is read.
fn open(session: Session, file: &web_sys::File) {
    let (name, opened) = (file.name(), session.own.record);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "sizes of files are whole and not negative"
    )]
    let bytes = file.size() as usize;
    if bytes > MAX_BYTES {
        return opened.set(Some(OpenRecord::refused(name, RecordError::TooLarge { bytes, max: MAX_BYTES })));
    }
    let sensor_gain = session.document.with_untracked(|document| document.setup.plant.rig().sensor.gain);
    read_file(session.lab, file, MAX_BYTES, move |bytes| opened.set(Some(OpenRecord::read(name, &bytes, sensor_gain))));
}

/// What is known of the file that is open.
#[component]
fn OpenFile() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let opened = session.own.record;
    let told = move || {
        opened.with(|opened| {
            let opened = opened.as_ref()?;
            let style = lab.number_style();
            Some(match &opened.found {
                Ok(record) => {
                    let rows = style.fixed(record.time_s.len() as f64, 0);
                    let duration = style.significant(record.duration_s(), 4);
                    let mut parts = vec![tr!(lab, record.file, name = &opened.name, rows = rows, duration = duration)];
                    parts.extend((record.missing > 0).then(|| tr!(lab, record.missing, count = record.missing)));
                    parts.extend((record.repeated > 0).then(|| tr!(lab, record.repeated, count = record.repeated)));
                    (false, parts.join(" "))
                }
                Err(error) => (true, format!("{}: {}", opened.name, why(lab, error))),
            })
        })
    };
    let is_record =
        Memo::new(move |_| opened.with(|opened| opened.as_ref().is_some_and(|opened| opened.found.is_ok())));
    view! {
        <p role="status" data-testid="record-told" class:warm=move || told().is_some_and(|(warm, _)| warm)>
            {move || told().map(|(_, text)| text)}
        </p>
        <AssumedUnits />
        <Columns />
        {move || is_record.get().then(|| view! { <AgreementTable /><ResidualPlot /><RunButton /><FitControls /> })}
    }
}

/// Columns without a known unit, and the unit that was assumed for each.
#[component]
fn AssumedUnits() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let told = move || {
        session.own.record.with(|opened| {
            let opened = opened.as_ref()?;
            let table = opened.table.as_ref()?;
            let (none, unknown): (Vec<_>, Vec<_>) =
                opened.assumed().into_iter().partition(|(_, named)| *named == NamedUnit::None);
            let of_column = |(index, _): &(usize, NamedUnit)| {
                let unit = opened.mapping.0[*index].map(|meaning| unit_text(lab, meaning.unit)).unwrap_or_default();
                format!("{} → {unit}", column_name(&table.columns[*index].name, *index))
            };
            let listed = |columns: &[(usize, NamedUnit)]| columns.iter().map(of_column).collect::<Vec<_>>().join(", ");
            let mut parts = Vec::new();
            parts.extend((!unknown.is_empty()).then(|| tr!(lab, record.units_unknown, columns = listed(&unknown))));
            parts.extend((!none.is_empty()).then(|| tr!(lab, record.units_assumed, columns = listed(&none))));
            (!parts.is_empty()).then(|| parts.join(" "))
        })
    };
    let told = Memo::new(move |_| told());
    view! {
        <p class="remark warm" role="status" data-testid="record-units" hidden=move || told.with(Option::is_none)>{move || told.get()}</p>
    }
}

/// The name of a column, or its number where it has none.
fn column_name(name: &str, index: usize) -> String {
    if name.is_empty() { (index + 1).to_string() } else { name.to_owned() }
}

/// What each column is, to be chosen.
#[component]
fn Columns() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let opened = session.own.record;
    let table =
        Memo::new(move |_| ByPointer(opened.with(|opened| opened.as_ref().and_then(|opened| opened.table.clone()))));
    let rows = move || {
        let ByPointer(table) = table.get();
        let columns = table.iter().flat_map(|table| table.columns.iter().enumerate());
        columns
            .map(|(index, column)| {
                let name = column_name(&column.name, index);
                let first = column.values.iter().copied().find(|value| !value.is_nan());
                view! { <ColumnRow index name first /> }.into_any()
            })
            .collect::<Vec<_>>()
    };
    let heads =
        move || vec![tr!(lab, record.column), tr!(lab, record.first), tr!(lab, record.meaning), tr!(lab, record.unit)];
    view! {
        <div hidden=move || table.get().0.is_none()>
            <Figures name="record-columns" caption=say!(lab, record.columns)>
                {move || view! { <TableContent caption=tr!(lab, record.columns) columns=heads() rows=rows() /> }}
            </Figures>
        </div>
    }
}

/// A table that is the same as long as it is the same file.
#[derive(Clone)]
struct ByPointer(Option<Arc<quadtank_record::Table>>);

impl PartialEq for ByPointer {
    fn eq(&self, other: &Self) -> bool {
        self.0.as_ref().map(Arc::as_ptr) == other.0.as_ref().map(Arc::as_ptr)
    }
}

#[component]
fn ColumnRow(index: usize, name: String, first: Option<f64>) -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let opened = session.own.record;
    let meaning = Signal::derive(move || {
        opened.with(|opened| opened.as_ref().and_then(|o| o.mapping.0.get(index).copied().flatten()))
    });
    let named = name.clone();
    let set = move |meaning: Option<ColumnMeaning>| {
        opened.update(|opened| {
            if let Some(opened) = opened {
                opened.set_meaning(index, meaning);
            }
        });
    };
    let choose_signal = move |signal: Option<Recorded>| {
        let unit = |signal: Recorded| {
            let kept = meaning.get_untracked().map(|meaning| meaning.unit).filter(|unit| signal.units().contains(unit));
            kept.unwrap_or_else(|| NamedUnit::of(&named, signal).or_usual(signal))
        };
        set(signal.map(|signal| ColumnMeaning { signal, unit: unit(signal) }));
    };
    let choose_unit = move |unit: Unit| {
        opened.update(|opened| {
            if let Some(opened) = opened {
                opened.set_unit(index, unit);
            }
        });
    };
    let signals = Signal::derive(move || {
        let none = Choice::new(None, "none", tr!(lab, record.left_out));
        let all =
            Recorded::ALL.into_iter().map(|signal| Choice::new(Some(signal), signal.name(), signal_name(lab, signal)));
        std::iter::once(none).chain(all).collect::<Vec<_>>()
    });
    let units = Signal::derive(move || {
        let units = meaning.get().map_or(&[][..], |meaning| meaning.signal.units());
        units.iter().map(|&unit| Choice::new(unit, format!("{unit:?}"), unit_text(lab, unit))).collect::<Vec<_>>()
    });
    let spoken = name.clone();
    let spoken_unit = name.clone();
    view! {
        <tr>
            <th scope="row">{name}</th>
            <td>{move || first.map(|value| lab.number_style().significant(value, 4))}</td>
            <td>
                <Select
                    id="record-signal"
                    name=Signal::derive(move || tr!(lab, record.meaning_of, column = &spoken))
                    choices=signals
                    chosen=Signal::derive(move || meaning.get().map(|meaning| meaning.signal))
                    on_choose=choose_signal
                    disabled=false
                />
            </td>
            <td hidden=move || meaning.get().is_none()>
                <Select
                    id="record-unit"
                    name=Signal::derive(move || tr!(lab, record.unit_of, column = &spoken_unit))
                    choices=units
                    chosen=Signal::derive(move || meaning.get().map_or(Unit::Second, |meaning| meaning.unit))
                    on_choose=choose_unit
                    disabled=false
                />
            </td>
        </tr>
    }
}

/// How well the simulation agrees with the record.
#[component]
fn AgreementTable() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let opened = session.own.record;
    let rows = move || {
        let opened = opened.get();
        let run = session.throttled.run.get();
        let (Some(record), Ok(run)) = (opened.as_ref().and_then(OpenRecord::record), run.as_ref()) else {
            return Vec::new();
        };
        let found = agreement(record, &run.nonlinear);
        let unit = session.own.unit.get();
        let levels =
            found.levels.into_iter().enumerate().filter_map(|(tank, found)| Some((Recorded::Level(tank), found?)));
        let pumps = found
            .pump_voltage
            .into_iter()
            .enumerate()
            .filter_map(|(pump, found)| Some((Recorded::PumpVoltage(pump), found?)));
        let shown = |signal: Recorded, value: f64| match signal {
            Recorded::PumpVoltage(_) => format!("{}\u{a0}V", lab.number_style().significant(value, 3)),
            _ => format!("{}\u{a0}{}", lab.number_style().significant(to_shown(value, unit), 3), unit_name(unit)),
        };
        let row = |(signal, found): (Recorded, Agreement)| {
            let fit = found
                .fit_percent
                .map_or_else(|| tr!(lab, record.still), |fit| format!("{}\u{a0}%", lab.number_style().fixed(fit, 1)));
            let texts = vec![shown(signal, found.rmse), shown(signal, found.largest), fit];
            view! { <tr><th scope="row">{signal_name(lab, signal)}</th><Cells texts /></tr> }.into_any()
        };
        levels.chain(pumps).map(row).collect::<Vec<_>>()
    };
    let heads =
        move || vec![tr!(lab, record.signal), tr!(lab, record.rmse), tr!(lab, record.largest), tr!(lab, record.fit)];
    view! {
        <Figures name="record-figures" caption=say!(lab, record.figures)>
            {move || view! { <TableContent caption=tr!(lab, record.figures) columns=heads() rows=rows() /> }}
        </Figures>
        <p class="remark">{say!(lab, record.fit_hint)}</p>
    }
}

/// What the simulation leaves of the record, folded away.
#[component]
fn ResidualPlot() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let open = RwSignal::new(false);
    let frames = RwSignal::new(Vec::<Frame>::new());
    let picture = residuals(session);
    let chart = move || {
        let (picture, for_table) = (picture.clone(), picture.clone());
        view! {
            <div class="chart"><ChartCanvas picture frames summary=say!(lab, record.residuals) name="residual-chart" /></div>
            <p class="remark">{say!(lab, record.residuals_hint)}</p>
            <DataTable picture=for_table id="residual-table" />
        }
    };
    view! {
        <details class="more" on:toggle=move |event| open.set(is_open(&event))>
            <summary data-testid="residuals">{say!(lab, record.residuals)}</summary>
            {move || open.get().then(chart.clone())}
        </details>
    }
}

/// Makes the experiment of the bench that of the record.
#[component]
fn RunButton() -> impl IntoView {
    let session = use_session();
    let lab = session.lab;
    let refused = RwSignal::new(None::<RecordError>);
    let done = RwSignal::new(false);
    let run = move |_| {
        let found = session.own.record.get_untracked().and_then(|opened| opened.found.ok());
        let Some(record) = found else { return };
        match session.document.with_untracked(|document| replay(&record, &document.setup)) {
            Ok(setup) => {
                session.edit(|present| *present = setup);
                refused.set(None);
                done.set(true);
            }
            Err(error) => refused.set(Some(error)),
        }
    };
    let told = move || match refused.get() {
        Some(error) => why(lab, &error),
        None if done.get() => tr!(lab, record.run_done),
        None => tr!(lab, record.run_hint),
    };
    view! {
        <p class="links">
            <button type="button" class="button small strong" data-testid="record-run" disabled=lab.locks(locks::EXPERIMENT) on:click=run>
                {say!(lab, record.run)}
            </button>
            <span class="remark" role="status" class:warm=move || refused.with(Option::is_some)>{told}</span>
        </p>
    }
}

/// Name of a signal on the page.
pub fn signal_name(lab: Lab, signal: Recorded) -> String {
    match signal {
        Recorded::Time => tr!(lab, record.time),
        Recorded::Level(tank) => tr!(lab, record.level, number = tank + 1),
        Recorded::Reference(level) => tr!(lab, record.reference, number = level + 1),
        Recorded::PumpVoltage(pump) => tr!(lab, record.pump, number = pump + 1),
        Recorded::Inflow(tank) => tr!(lab, record.inflow, number = tank + 1),
    }
}

fn unit_text(lab: Lab, unit: Unit) -> String {
    if unit == Unit::SensorVolt { tr!(lab, record.sensor_volt) } else { unit.symbol().to_owned() }
}

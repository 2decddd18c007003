//! A measured record beside a run of the quadruple tank, and the rig fitted to it.

use std::path::{Path, PathBuf};

use clap::Args;
use quadtank::sim::Trajectory;
use quadtank::study::quadruple_tank::{Setup, run};
use quadtank_record::{
    ColumnMeaning, Fit, FitReport, MAX_BYTES, Mapping, NamedUnit, Parameter, Record, RecordAgreement, RecordError,
    Signal, Sought, Table, Unit, agreement, levels_at_start, replay,
};
use quadtank_scenario::{Document, Scenario, ScenarioError, to_json};
use serde::Serialize;
use thiserror::Error;

use super::files::{bytes_of, file_name, print_json, write_file};
use super::message::tell;
use super::{Failure, Source, document_of, told};

/// A scenario and a record.
#[derive(Args)]
pub struct RecordOptions {
    #[command(flatten)]
    source: Source,
    /// Record: CSV or TSV with names of columns such as `t (s)`, `h1 (cm)`, `u1 (V)`
    record: PathBuf,
    /// What a column is, by its number from 1, and its unit, if its name does not say: `2=level1:mm`, `3=none`; may be repeated
    #[arg(long = "column", value_name = "N=SIGNAL[:UNIT]", value_parser = column_of)]
    columns: Vec<(usize, Option<Said>)>,
    /// Compare with the experiment of the scenario, not with that of the record
    #[arg(long)]
    own_experiment: bool,
    /// Fit this parameter of the rig to the record; may be repeated: gamma1, gamma2, k1, k2, a1 to a4 (of the outlets, at their
    /// loss coefficients), offset1, offset2, delay1, delay2 (of the hoses), start1 to start4 (levels at the beginning). Where the
    /// search begins and its bounds may follow, in SI: `gamma1=0.6:0.3..0.9`
    #[arg(long = "fit", value_name = "PARAMETER[=START][:LOW..HIGH]", conflicts_with = "own_experiment", value_parser = chosen_of)]
    parameters: Vec<Chosen>,
    /// Write the scenario that was compared, with the fitted rig
    #[arg(long, value_name = "OUT")]
    scenario: Option<PathBuf>,
}

/// Signal of a column, and its unit where one is given.
type Said = (Signal, Option<Unit>);

/// Why there is no report.
#[derive(Debug, Error)]
pub enum RecordFault {
    #[error("{file}: {error}")]
    Record { file: String, error: RecordError },
    #[error("{file}: there is no column {column}; it has {count}")]
    NoColumn { file: String, column: usize, count: usize },
    #[error(
        "{file}: column {column} `{name}` is in `{unit}`, which is not known here; say `--column {column}={}:UNIT` with one of {}",
        signal.name(),
        units_of(*signal)
    )]
    UnknownUnit { file: String, column: usize, name: String, unit: String, signal: Signal },
    #[error("a record is held against a run of the quadruple tank, version 1")]
    OtherBench,
}

/// What is printed.
#[derive(Serialize)]
struct Report {
    columns: Vec<ColumnReport>,
    rows: usize,
    duration_s: f64,
    /// Cells that are holes, and rows that repeat a time: neither is compared.
    missing: usize,
    repeated: usize,
    agreement: RecordAgreement,
    #[serde(skip_serializing_if = "Option::is_none")]
    fit: Option<FitReport>,
}

#[derive(Serialize)]
struct ColumnReport {
    name: String,
    meaning: Option<ColumnMeaning>,
    /// Whether the default unit was assumed because neither the column name nor `--column` gives one.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    unit_assumed: bool,
}

/// A parameter to fit, with its starting value and bounds where they are given.
#[derive(Clone, Copy)]
struct Chosen {
    parameter: Parameter,
    start: Option<f64>,
    bounds: Option<[f64; 2]>,
}

/// `gamma1=0.6:0.3..0.9`
fn chosen_of(text: &str) -> Result<Chosen, String> {
    let (head, bounds) = text.split_once(':').map_or((text, None), |(head, bounds)| (head, Some(bounds)));
    let (name, start) = head.split_once('=').map_or((head, None), |(name, start)| (name, Some(start)));
    let known = || Parameter::ALL.map(Parameter::name).join(", ");
    let parameter = Parameter::of_name(name).ok_or_else(|| format!("it is one of {}", known()))?;
    let number = |text: &str| text.parse::<f64>().map_err(|_| format!("`{text}` is not a number"));
    let range = |text: &str| {
        let (low, high) = text.split_once("..").ok_or_else(|| format!("`{text}` are no bounds, such as 0.3..0.9"))?;
        Ok::<_, String>([number(low)?, number(high)?])
    };
    Ok(Chosen { parameter, start: start.map(number).transpose()?, bounds: bounds.map(range).transpose()? })
}

/// `2=level1:mm`
fn column_of(text: &str) -> Result<(usize, Option<Said>), String> {
    const HOW: &str = "a number of a column from 1, =, and time, level1 to level4, reference1, reference2, pump1, pump2, inflow1 to inflow4 or none, \
                       with : and a unit if need be";
    let (column, meaning) = text.split_once('=').ok_or(HOW)?;
    let column = column.parse().ok().filter(|&column| column > 0).ok_or(HOW)?;
    let (signal, unit) = meaning.split_once(':').map_or((meaning, None), |(signal, unit)| (signal, Some(unit)));
    if signal == "none" {
        return Ok((column, None));
    }
    let signal = Signal::ALL.into_iter().find(|known| known.name() == signal).ok_or(HOW)?;
    let known = |symbol: &str| {
        let found = signal.units().iter().copied().find(|unit| unit.name() == symbol);
        found.ok_or_else(|| format!("the units of {} are {}", signal.name(), units_of(signal)))
    };
    Ok((column, Some((signal, unit.map(known).transpose()?))))
}

fn units_of(signal: Signal) -> String {
    signal.units().iter().map(|unit| unit.name()).collect::<Vec<_>>().join(", ")
}

/// Reads both, compares, fits, and prints what was found.
pub fn execute(options: &RecordOptions) -> Result<(), Failure> {
    let Document::Quadruple(mut scenario) = document_of(&options.source)? else {
        return Err(RecordFault::OtherBench.into());
    };
    let Read { table, mapping, assumed } = table_of(options)?;
    tell_assumed(&table, &mapping, &assumed);
    let wrong = |error| RecordFault::Record { file: file_name(&options.record), error };
    let record = Record::of(&table, &mapping, scenario.setup.plant().sensor.gain).map_err(wrong)?;
    let mut found = None;
    if !options.own_experiment {
        scenario.setup = replay(&record, &scenario.setup).map_err(wrong)?;
    }
    if !options.parameters.is_empty() {
        let fit = fitted(&scenario.setup, &record, &options.parameters).map_err(wrong)?;
        scenario.setup = fit.setup(&scenario.setup);
        found = Some(fit.report());
    }
    let run = nonlinear(&options.source.file, &scenario.setup)?;
    if let Some(out) = &options.scenario {
        write_file(out, told(out, to_json(&Scenario { pinned: Vec::new(), ..scenario.clone() }))? + "\n")?;
    }
    print_json(&Report {
        columns: table
            .columns
            .into_iter()
            .zip(mapping.0)
            .enumerate()
            .map(|(index, (column, meaning))| ColumnReport {
                name: column.name,
                meaning,
                unit_assumed: assumed.contains(&index),
            })
            .collect(),
        rows: record.time_s.len(),
        duration_s: record.duration_s(),
        missing: record.missing,
        repeated: record.repeated,
        agreement: agreement(&record, &run),
        fit: found,
    })
}

/// Reads the table of a record, maps its columns to signals, and lists the columns without a unit, for which a default was assumed.
struct Read {
    table: Table,
    mapping: Mapping,
    assumed: Vec<usize>,
}

fn table_of(options: &RecordOptions) -> Result<Read, Failure> {
    let file = file_name(&options.record);
    let table = Table::read(&bytes_of(&options.record, MAX_BYTES)?)
        .map_err(|error| RecordFault::Record { file: file.clone(), error })?;
    let mut said: Vec<Option<Said>> = Mapping::guess(&table).0.iter().map(|m| m.map(|m| (m.signal, None))).collect();
    for &(column, meaning) in &options.columns {
        let count = table.columns.len();
        let place = said.get_mut(column - 1).ok_or(RecordFault::NoColumn { file: file.clone(), column, count })?;
        *place = meaning;
    }
    let (mut mapping, mut assumed) = (Mapping::empty(table.columns.len()), Vec::new());
    for (index, said) in said.into_iter().enumerate() {
        let Some((signal, unit)) = said else { continue };
        let name = &table.columns[index].name;
        let named = unit.map_or_else(|| NamedUnit::of(name, signal), NamedUnit::Known);
        match &named {
            NamedUnit::Known(_) => {}
            NamedUnit::None => assumed.push(index),
            NamedUnit::Unknown(unit) => {
                let (name, unit) = (name.clone(), unit.clone());
                return Err(RecordFault::UnknownUnit { file, column: index + 1, name, unit, signal }.into());
            }
        }
        mapping.0[index] = Some(ColumnMeaning { signal, unit: named.or_usual(signal) });
    }
    Ok(Read { table, mapping, assumed })
}

/// Lists on standard error the columns for which a default unit was assumed.
fn tell_assumed(table: &Table, mapping: &Mapping, assumed: &[usize]) {
    let of_column = |&index: &usize| {
        let unit = mapping.0[index].map_or("", |meaning| meaning.unit.name());
        format!("column {} `{}` is read in {unit}", index + 1, table.columns[index].name)
    };
    if !assumed.is_empty() {
        let all = assumed.iter().map(of_column).collect::<Vec<_>>().join(", ");
        tell(format!("no unit is named: {all}; say another with --column N=SIGNAL:UNIT"));
    }
}

fn fitted(setup: &Setup, record: &Record, chosen: &[Chosen]) -> Result<Fit, RecordError> {
    let (rig, first) = (setup.plant(), levels_at_start(setup, record));
    let sought = |chosen: &Chosen| {
        let usual = Sought::usual(chosen.parameter, &rig, &first);
        Sought { start: chosen.start.unwrap_or(usual.start), bounds: chosen.bounds.unwrap_or(usual.bounds), ..usual }
    };
    let mut fit = Fit::within(setup, record, &chosen.iter().map(sought).collect::<Vec<_>>())?;
    while !fit.is_over() {
        fit.advance();
    }
    Ok(fit)
}

fn nonlinear(file: &Path, setup: &Setup) -> Result<Trajectory, Failure> {
    let found = run(setup).map_err(|error| ScenarioError::Study { setup: "setup", error });
    Ok(told(file, found)?.nonlinear)
}

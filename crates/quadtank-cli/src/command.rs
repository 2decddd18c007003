use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Args, Parser, Subcommand, ValueEnum};
use quadtank::literature::PresetId;
use quadtank::literature::campestrini::PublishedCase;
use quadtank::study::level_loop::LevelLoopSetup;
use quadtank::study::model_free::ModelFreeSetup;
use quadtank::study::quadruple_tank::setup_of;
use quadtank::study::relay_tuning::TuningSetup;
use quadtank_scenario::level_loop::LevelLoopScenario;
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{
    BenchDocument, DOCUMENT_LIMIT, Document, Scenario, ScenarioError, check_length, document_from_bytes,
    level_loop_cases, model_free_cases, schema_of, to_json,
};
use serde::Serialize;
use serde_json::Value;
use thiserror::Error;

mod andreis;
mod answers;
mod level_loop;
mod level_plot;
mod message;
mod model_free;
mod plot;
mod quantities;
mod report;
mod tune;

use andreis::TableNumber;
use answers::{Answers, Drawing, Fault};
use level_loop::SearchOptions;

/// The quadruple-tank laboratory without a screen.
///
/// Units are SI: levels in m, flows in m³/s, times in s, poles and zeros in 1/s. A file is JSON in UTF-8 or UTF-16. Coefficients
/// of transfer functions (elements of a relay-tuning session) are by rising powers of s: [1, 10] is 1 + 10 s. Exit status: 0 when
/// all went well, 1 when a file cannot be read or written, 2 for a broken scenario or a wrong command; messages, and warnings of
/// what may not be meant, are single lines on standard error.
#[derive(Parser)]
#[command(name = "quadtank", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Print what linear theory says about a scenario, as JSON
    ///
    /// Of a relay-tuning session (version 2): steady-state gain, relative gain, critical curve. The coefficients of its elements
    /// are by rising powers of s: [1, 10] is 1 + 10 s. Of a level loop (version 4): signals at rest, linear model, ultimate point,
    /// margins, step test, and what rules suggest.
    Analyse {
        #[command(flatten)]
        source: Source,
        /// Print only this quantity, such as `zero.rightmost`; may be repeated. `quadtank quantities` lists them
        ///
        /// The answer is a JSON object of numbers in SI, null where a quantity does not exist.
        #[arg(long, value_name = "NAME")]
        only: Vec<String>,
    },
    /// Run the experiment of a scenario on the nonlinear plant and on its linear model
    ///
    /// Of a level loop (version 4) on the plant with all its instruments: json has figures of level and outflow, the answer to a
    /// step, valve travel, indices against the reference, the Harris index, and what is to be said about the run.
    Simulate {
        #[command(flatten)]
        source: Source,
        /// csv: trajectories; json: trajectories, events and metrics
        #[arg(long, value_enum, default_value_t = Format::Csv)]
        format: Format,
    },
    /// Draw a chart of a scenario
    Plot {
        #[command(flatten)]
        source: Source,
        /// File to write, or - for standard output
        #[arg(long, value_name = "OUT")]
        svg: PathBuf,
        /// What to draw of a run of the quadruple tank (version 1)
        #[arg(long, value_enum, default_value_t = plot::Chart::Responses)]
        chart: plot::Chart,
        /// What to draw of a relay-tuning session (version 2)
        #[arg(long, value_enum, default_value_t = tune::Picture::Loci)]
        picture: tune::Picture,
        /// What to draw of a level loop (version 4)
        #[arg(long, value_enum, default_value_t = level_plot::LevelPicture::Run)]
        level_picture: level_plot::LevelPicture,
        /// Colours
        #[arg(long, value_enum, default_value_t = plot::Colours::Light)]
        theme: plot::Colours,
    },
    /// List the published rigs, or print the scenario of one
    Presets {
        /// Name of a rig
        #[arg(value_parser = preset_parser())]
        name: Option<PresetId>,
    },
    /// Run the relay test and the design of a relay-tuning session (version 2), or search for settings of a level loop (version 4)
    ///
    /// The coefficients of its elements are by rising powers of s: [1, 10] is 1 + 10 s. What it compares its response with is in
    /// the report too. Of a level loop the report has the best settings with their cost, the path of the search, what rules
    /// suggest, and the trade-off between level and outflow.
    Tune {
        #[command(flatten)]
        source: Source,
        #[command(flatten)]
        search: SearchOptions,
        /// json: readings, both roots, stability and margins, or what a search finds; csv: the record of the relay test, or the path
        /// of the search
        #[arg(long, value_enum, default_value_t = Format::Json)]
        format: Format,
    },
    /// List the published cases of Campestrini (2006), Junqueira et al., Andreis (2017) and of lecture slides on a level tank, or
    /// print the scenario of one
    Cases {
        /// Name of a case
        #[arg(value_parser = case_of)]
        name: Option<Case>,
        /// A table of Andreis (2017), 5.1 to 5.6, 5.9, 5.10, 5.12, 5.13, 5.17 or 5.18: every printed number beside the computed one
        #[arg(long, value_name = "NUMBER", conflicts_with = "name", value_parser = andreis::table_of)]
        table: Option<TableNumber>,
    },
    /// List the quantities of each bench with units and descriptions, as Markdown
    Quantities {
        /// Version of the document: 1 for the quadruple tank, 2 for relay tuning, 3 for model-free control, 4 for a level loop
        #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4))]
        version: Option<u32>,
    },
    /// Print the JSON Schema of the scenario, or of what a command reports about it
    Schema {
        /// Version of the document: 1 for the quadruple tank, 2 for relay tuning, 3 for model-free control, 4 for a level loop
        #[arg(
            long,
            default_value_t = Scenario::VERSION,
            default_value_if("report", "tune", "2"),
            value_parser = clap::value_parser!(u32).range(1..=4)
        )]
        version: u32,
        /// The JSON that this command prints, in place of the scenario
        #[arg(long, value_enum, value_name = "COMMAND")]
        report: Option<report::Report>,
    },
}

/// The document that a command is about.
#[derive(Args)]
struct Source {
    /// Scenario file (JSON), or - for standard input
    file: PathBuf,
    /// Set a value of the document before anything is computed, such as `setup.controller.loops[0].gain=2`; may be repeated
    ///
    /// The value is JSON, or the name of a choice. It is refused like one of the file.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = setting_of)]
    settings: Vec<(String, Value)>,
}

fn setting_of(setting: &str) -> Result<(String, Value), &'static str> {
    let (path, value) = setting.split_once('=').ok_or("a path, =, and a value")?;
    let value = serde_json::from_str(value).unwrap_or_else(|_| Value::from(value));
    Ok((path.to_owned(), value))
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Csv,
    Json,
}

fn preset_parser() -> impl TypedValueParser<Value = PresetId> {
    PossibleValuesParser::new(PresetId::ALL.map(PresetId::name))
        .try_map(|name| PresetId::from_name(&name).ok_or("unknown rig"))
}

/// A published case of any kind.
#[derive(Clone, Debug)]
enum Case {
    Tuning(PublishedCase),
    ModelFree(Box<ModelFreeSetup>),
    LevelLoop(Box<LevelLoopSetup>),
}

fn case_of(name: &str) -> Result<Case, &'static str> {
    let model_free = || model_free_cases().find(|(known, ..)| known == name);
    let level_loop = || level_loop_cases().find(|(known, ..)| known == name);
    PublishedCase::from_name(name)
        .map(Case::Tuning)
        .or_else(|| {
            model_free().map(|(_, valves, run)| Case::ModelFree(Box::new(ModelFreeSetup::published(valves, run))))
        })
        .or_else(|| level_loop().map(|(.., setup)| Case::LevelLoop(Box::new(setup))))
        .ok_or("unknown case; `quadtank cases` lists them")
}

/// Why a command was not carried out.
#[derive(Debug, Error)]
enum Failure {
    #[error("{file}: {fault}")]
    Document { file: String, fault: Fault },
    #[error(
        "schema: tune reports on relay-tuning sessions and level loops, versions 2 and 4; this is version {version}"
    )]
    NoReport { version: u32 },
    #[error("{file}: {error}")]
    File { file: String, error: io::Error },
}

impl Failure {
    fn exit_code(&self) -> ExitCode {
        match self {
            Self::File { .. } => ExitCode::from(1),
            _ => ExitCode::from(2),
        }
    }
}

/// Reads the arguments and does what they say.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return wrong_command(&error),
    };
    match execute(cli.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            message::tell(&failure);
            failure.exit_code()
        }
    }
}

/// Prints the requested help, or one line that names the error in the arguments.
fn wrong_command(error: &clap::Error) -> ExitCode {
    if matches!(
        error.kind(),
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand
    ) {
        error.exit();
    }
    let text = error.to_string();
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    message::tell(lines.join("; ").trim_start_matches("error: "));
    ExitCode::from(2)
}

fn execute(command: Command) -> Result<(), Failure> {
    match command {
        Command::Analyse { source, only } if only.is_empty() => print(&answer(&source, |document| document.analyse())?),
        Command::Analyse { source, only } => {
            let document = document_of(&source)?;
            print(&told(&source.file, quantities::only(&document, &only))?)
        }
        Command::Quantities { version } => print(&quantities::list(version)),
        Command::Simulate { source, format } => print(&answer(&source, |document| document.simulate(format))?),
        Command::Tune { source, search, format } => print(&answer(&source, |document| document.tune(format, &search))?),
        Command::Plot { source, svg, chart, picture, level_picture, theme } => {
            let drawing = Drawing { chart, picture, level_picture, style: theme.style() };
            let drawing = answer(&source, |document| document.plot(&drawing))?;
            if is_standard_stream(&svg) { print(&drawing) } else { write_file(&svg, &drawing) }
        }
        Command::Cases { table: Some(table), .. } => print(&told(Path::new("this table"), andreis::table(table))?),
        Command::Cases { name: None, .. } => print(&list_of_cases()),
        Command::Cases { name: Some(Case::Tuning(case)), .. } => {
            print_document(&case.name(), to_json(&TuningScenario::from(TuningSetup::published(case))))
        }
        Command::Cases { name: Some(Case::ModelFree(setup)), .. } => {
            print_document("this case", to_json(&ModelFreeScenario::from(*setup)))
        }
        Command::Cases { name: Some(Case::LevelLoop(setup)), .. } => {
            print_document("this case", to_json(&LevelLoopScenario::from(*setup)))
        }
        Command::Presets { name: None } => print(&list_of_presets()),
        Command::Presets { name: Some(id) } => print_document(id.name(), to_json(&Scenario::from(setup_of(id)))),
        Command::Schema { version, report: None } => print_json(&schema_of(version)),
        Command::Schema { version, report: Some(report) } => {
            print_json(&report.schema(version).ok_or(Failure::NoReport { version })?)
        }
    }
}

/// Reads a document and asks it. What it may not have been meant to say is printed as warnings.
fn answer(source: &Source, ask: impl Fn(&dyn Answers) -> Result<String, Fault>) -> Result<String, Failure> {
    let file = &source.file;
    let document = document_of(source)?;
    let document = answers::of(&document);
    let answer = told(file, ask(document))?;
    for warning in document.warnings() {
        message::tell(format!("{}: warning: {warning}", file_name(file)));
    }
    Ok(answer)
}

/// A document with the values that are set.
fn document_of(source: &Source) -> Result<Document, Failure> {
    let read = document(&source.file)?;
    if source.settings.is_empty() { Ok(read) } else { told(&source.file, read.with_values(&source.settings)) }
}

fn told<T>(file: &Path, result: Result<T, impl Into<Fault>>) -> Result<T, Failure> {
    result.map_err(|fault| Failure::Document { file: file_name(file), fault: fault.into() })
}

/// Reads a document from a file or from standard input. A file that is too long is refused by its size; of what has no size,
/// such as a pipe, not more is read than a document may have, and a byte that tells that there is more.
fn document(file: &Path) -> Result<Document, Failure> {
    let failed = |error| Failure::File { file: file_name(file), error };
    let mut bytes = Vec::new();
    let limit = DOCUMENT_LIMIT as u64 + 1;
    if is_standard_stream(file) {
        io::stdin().lock().take(limit).read_to_end(&mut bytes).map_err(failed)?;
    } else {
        let opened = File::open(file).map_err(failed)?;
        let length = opened.metadata().map_err(failed)?.len();
        told(file, check_length(usize::try_from(length).unwrap_or(usize::MAX)))?;
        opened.take(limit).read_to_end(&mut bytes).map_err(failed)?;
    }
    told(file, document_from_bytes(&bytes))
}

/// Writes to standard output. A reader that has seen enough (`quadtank … | head`) is no failure.
fn print(text: &str) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(cannot_print(error)),
        _ => Ok(()),
    }
}

fn cannot_print(error: io::Error) -> Failure {
    Failure::File { file: "standard output".to_owned(), error }
}

fn write_file(file: &Path, text: &str) -> Result<(), Failure> {
    std::fs::write(file, text).map_err(|error| Failure::File { file: file_name(file), error })
}

fn is_standard_stream(file: &Path) -> bool {
    file.as_os_str() == "-"
}

fn file_name(file: &Path) -> String {
    if is_standard_stream(file) { "standard input".to_owned() } else { file.display().to_string() }
}

fn print_json<T: Serialize>(value: &T) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|error| cannot_print(error.into()))?;
    print(&(text + "\n"))
}

fn print_document(name: &str, text: Result<String, ScenarioError>) -> Result<(), Failure> {
    print(&(told(Path::new(name), text)? + "\n"))
}

fn list_of_presets() -> String {
    PresetId::ALL.map(PresetId::preset).iter().fold(String::new(), |mut list, preset| {
        let [gamma_1, gamma_2] = preset.plant.valves;
        let name = preset.id.name();
        // Writing to a String cannot fail.
        let _ = writeln!(list, "{name:<33} γ = {gamma_1:.2}, {gamma_2:.2}   {}, {}", preset.source, preset.table);
        list
    })
}

fn list_of_cases() -> String {
    let tuning = PublishedCase::all().fold(String::new(), |mut list, case| {
        let place = match case.table {
            0 => "§6.4, solvents column".to_owned(),
            88 => "eq. 88".to_owned(),
            table => format!("Table {table}, row {}", case.row),
        };
        // Writing to a String cannot fail.
        let _ = writeln!(list, "{:<16} Campestrini (2006), {place}", case.name());
        list
    });
    let both = model_free_cases().fold(tuning, |mut list, (name, valves, experiment)| {
        let _ = writeln!(list, "{name:<16} Junqueira, Neves and Angelico, case {valves:?}, experiment {experiment:?}");
        list
    });
    level_loop_cases().fold(both, |mut list, (name, place, _)| {
        let _ = writeln!(list, "{name:<24} {place}");
        list
    })
}

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Args, Parser, Subcommand, ValueEnum};
use quadtank::literature::PresetId;
use quadtank::study::quadruple_tank::setup_of;
use quadtank::study::relay_tuning::TuningSetup;
use quadtank_drawing::{Drawing, HomePicture, LevelPicture, SessionPicture, Theme, draw};
use quadtank_export::{ExportError, Language, export, latex};
use quadtank_lesson::lesson_schema;
use quadtank_scenario::level_loop::LevelLoopScenario;
use quadtank_scenario::model_free::ModelFreeScenario;
use quadtank_scenario::tuning::TuningScenario;
use quadtank_scenario::{
    BenchDocument, DOCUMENT_LIMIT, Document, Scenario, ScenarioError, document_from_bytes, schema_of, to_json,
};
use serde_json::Value;
use thiserror::Error;

mod andreis;
mod answers;
mod check;
mod elements;
mod files;
mod level_loop;
mod mark;
mod message;
mod published;
mod quantities;
mod record;
mod report;
mod scorm;
mod table;

use andreis::TableNumber;
use answers::Fault;
use check::{CheckFault, CheckOptions};
use elements::ElementsFault;
use files::{bytes_of, file_name, is_standard_stream, print, print_json, write_file};
use level_loop::SearchOptions;
use published::{Case, case_of, list_of_cases, list_of_presets, preset_parser};
use record::{RecordFault, RecordOptions};
use scorm::{ScormFault, ScormOptions};
use table::TableOptions;

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
        #[command(flatten)]
        table: TableOptions,
    },
    /// Hold a run of the quadruple tank against a measured record, or fit the rig to it
    ///
    /// The run does what the record did: it begins at its first levels, lasts as long, and its pumps follow the recorded voltages, or
    /// its references the recorded ones where no pump was recorded. The answer is JSON: RMSE, largest difference and fit in percent of
    /// each signal, and fitted parameters with standard errors and correlation.
    Record(RecordOptions),
    /// Draw a chart of a scenario
    Plot {
        #[command(flatten)]
        source: Source,
        /// File to write, or - for standard output
        #[arg(long, value_name = "OUT")]
        svg: PathBuf,
        /// What to draw of a run of the quadruple tank (version 1)
        #[arg(long, value_enum, default_value_t = HomePicture::Responses)]
        chart: HomePicture,
        /// What to draw of a relay-tuning session (version 2)
        #[arg(long, value_enum, default_value_t = SessionPicture::Loci)]
        picture: SessionPicture,
        /// What to draw of a level loop (version 4)
        #[arg(long, value_enum, default_value_t = LevelPicture::Run)]
        level_picture: LevelPicture,
        /// Colours
        #[arg(long, value_enum, default_value_t = Theme::Light)]
        theme: Theme,
    },
    /// Print the experiment of the quadruple tank (version 1) as a script in another language, or its model as LaTeX
    ///
    /// The script needs nothing of this program: parameters, linear analysis, the nonlinear closed loop, and the figures that this
    /// program finds, which it holds its own against. Noise is left out. LaTeX has the linear model, zeros, relative gains and the
    /// laws of the loops with their numbers; it needs amsmath alone.
    Export {
        #[command(flatten)]
        source: Source,
        /// The language
        #[arg(long = "as", value_enum, value_name = "LANGUAGE")]
        language: ExportLanguage,
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
        #[command(flatten)]
        table: TableOptions,
    },
    /// List the published cases of Campestrini (2006), Junqueira et al., Andreis (2017), of lecture slides on a level tank, and
    /// controllers published for the column of Wood and Berry, or print the scenario of one
    Cases {
        /// Name of a case
        #[arg(value_parser = case_of)]
        name: Option<Case>,
        /// A table of Andreis (2017), 5.1 to 5.18: every printed number beside the computed one
        #[arg(long, value_name = "NUMBER", conflicts_with = "name", value_parser = andreis::table_of)]
        table: Option<TableNumber>,
    },
    /// Print a relay-tuning session (version 2) on the plant that lines of MATLAB or python-control define
    ///
    /// Understood are assignments, `s = tf('s')` and formulas in s, `tf(numerator, denominator)` with falling powers of s,
    /// `zpk(zeros, poles, gain)`, matrices `[g11, g12; g21, g22]`, lines `G(1,2) = …`, and the options and properties `InputDelay`,
    /// `OutputDelay` and `IODelay`. The last plant with two inputs and two outputs counts.
    Elements {
        /// Script, or - for standard input
        file: PathBuf,
    },
    /// List the quantities of each bench with units and descriptions, as Markdown
    Quantities {
        /// Version of the document: 1 for the quadruple tank, 2 for relay tuning, 3 for model-free control, 4 for a level loop
        #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4))]
        version: Option<u32>,
    },
    /// Audit lessons, mark an answer to a task of one, or read the code of a report
    ///
    /// `--all` audits: a line on standard error for each fault, with its place, and a line on standard output for a lesson without
    /// faults. `--task ID` marks the answer on standard input: {"choice": 0}, {"number": 0.0248}, {"order": [0, 2, 1]},
    /// {"text": "…"}, or a document of the bench where a goal is to be reached. `--report CODE` prints what a code holds.
    Check(CheckOptions),
    /// Pack a lesson for a learning management system (SCORM 1.2)
    ///
    /// The zip has the laboratory with the lesson in it, and a manifest. A system calls the lesson passed from 60 points of 100.
    Scorm(ScormOptions),
    /// Print the JSON Schema of the scenario, of what a command reports about it, or of a lesson
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
        /// The lesson, in place of the scenario
        #[arg(long, conflicts_with_all = ["version", "report"])]
        lesson: bool,
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

/// The language of an export.
#[derive(Clone, Copy, ValueEnum)]
enum ExportLanguage {
    /// Python with numpy, scipy and python-control
    Python,
    /// MATLAB with the Control System Toolbox, or GNU Octave with the package control
    Octave,
    /// Julia with the package `ControlSystems`; unlike the others not checked
    Julia,
    /// Linear model and controller as LaTeX
    Latex,
}

impl ExportLanguage {
    fn write(self, scenario: &Scenario) -> Result<String, ExportError> {
        match self {
            Self::Python => export(scenario, Language::Python),
            Self::Octave => export(scenario, Language::Octave),
            Self::Julia => export(scenario, Language::Julia),
            Self::Latex => latex(scenario),
        }
    }
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
    #[error("{0}")]
    Check(#[from] CheckFault),
    #[error("{0}")]
    Record(#[from] RecordFault),
    #[error("{0}")]
    Elements(#[from] ElementsFault),
    #[error("{0}")]
    Scorm(#[from] ScormFault),
    /// The faults of lessons, each of which is told by then.
    #[error("the lesson has faults")]
    Faults,
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
            if !matches!(failure, Failure::Faults) {
                message::tell(&failure);
            }
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
        Command::Analyse { source, only } if only.is_empty() => {
            print(&answer(&source, |document| Ok(document.analysis_json()?))?)
        }
        Command::Analyse { source, only } => {
            let document = document_of(&source)?;
            print(&told(&source.file, quantities::only(&document, &only))?)
        }
        Command::Quantities { version } => print(&quantities::list(version)),
        Command::Simulate { source, format, table } => {
            print(&answer(&source, |document| Ok(answers::simulate(document, format, table.style()?)?))?)
        }
        Command::Tune { source, search, format, table } => {
            print(&answer(&source, |document| Ok(answers::tune(document, format, &search.into(), table.style()?)?))?)
        }
        Command::Plot { source, svg, chart, picture, level_picture, theme } => {
            let drawing = Drawing { home: chart, session: picture, level: level_picture, theme };
            let drawing = answer(&source, |document| Ok(draw(document, &drawing)?))?;
            if is_standard_stream(&svg) { print(&drawing) } else { write_file(&svg, &drawing) }
        }
        Command::Export { source, language } => {
            print(&answer(&source, |document| answers::exported(document, |scenario| language.write(scenario)))?)
        }
        Command::Cases { table: Some(table), .. } => print(&told(Path::new("this table"), andreis::table(table))?),
        Command::Cases { name: None, .. } => print(&list_of_cases()),
        Command::Cases { name: Some(Case::Tuning(case)), .. } => {
            print_document(&case.name(), to_json(&TuningScenario::from(TuningSetup::published(case))))
        }
        Command::Cases { name: Some(Case::Controllers(controllers)), .. } => {
            print_document(controllers.name(), to_json(&TuningScenario::from(TuningSetup::with_published(controllers))))
        }
        Command::Cases { name: Some(Case::ModelFree(setup)), .. } => {
            print_document("this case", to_json(&ModelFreeScenario::from(*setup)))
        }
        Command::Cases { name: Some(Case::LevelLoop(setup)), .. } => {
            print_document("this case", to_json(&LevelLoopScenario::from(*setup)))
        }
        Command::Presets { name: None } => print(&list_of_presets()),
        Command::Presets { name: Some(id) } => print_document(id.name(), to_json(&Scenario::from(setup_of(id)))),
        Command::Elements { file } => elements::execute(&file),
        Command::Check(options) => check::run(&options),
        Command::Record(options) => record::execute(&options),
        Command::Scorm(options) => scorm::run(&options),
        Command::Schema { lesson: true, .. } => print_json(&lesson_schema()),
        Command::Schema { version, report: None, .. } => print_json(&schema_of(version)),
        Command::Schema { version, report: Some(report), .. } => {
            print_json(&report.schema(version).ok_or(Failure::NoReport { version })?)
        }
    }
}

/// Reads a document and asks it. What it may not have been meant to say is printed as warnings.
fn answer(source: &Source, ask: impl Fn(&Document) -> Result<String, Fault>) -> Result<String, Failure> {
    let file = &source.file;
    let document = document_of(source)?;
    let answer = told(file, ask(&document))?;
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

/// Reads a document from a file or from standard input.
fn document(file: &Path) -> Result<Document, Failure> {
    told(file, document_from_bytes(&bytes_of(file, DOCUMENT_LIMIT)?))
}

fn print_document(name: &str, text: Result<String, ScenarioError>) -> Result<(), Failure> {
    print(&(told(Path::new(name), text)? + "\n"))
}

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Read, Write as _};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, Subcommand, ValueEnum};
use quadtank::plant::PresetId;
use quadtank::scenario::{
    AnalysisReport, DOCUMENT_LIMIT, Scenario, ScenarioError, Setup, analyse, from_json, run, setup_of, to_json,
};
use serde::Serialize;
use thiserror::Error;

mod plot;

/// The quadruple-tank laboratory without a screen.
///
/// Units are SI: levels in m, flows in m³/s, times in s, poles and zeros in 1/s. Exit status: 0 when all went well, 1 when
/// a file cannot be read or written, 2 for a broken scenario or a wrong command.
#[derive(Parser)]
#[command(name = "quadtank", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Print what linear theory says about a scenario, as JSON
    Analyse {
        /// Scenario file (JSON), or - for standard input
        file: PathBuf,
    },
    /// Run the experiment of a scenario on the nonlinear plant and on its linear model
    Simulate {
        /// Scenario file (JSON), or - for standard input
        file: PathBuf,
        /// csv: trajectories; json: trajectories, events and metrics
        #[arg(long, value_enum, default_value_t = Format::Csv)]
        format: Format,
    },
    /// Draw a chart of a scenario
    Plot {
        /// Scenario file (JSON), or - for standard input
        file: PathBuf,
        /// File to write, or - for standard output
        #[arg(long, value_name = "OUT")]
        svg: PathBuf,
        /// What to draw
        #[arg(long, value_enum, default_value_t = plot::Chart::Responses)]
        chart: plot::Chart,
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
    /// Print the JSON Schema of the scenario
    Schema,
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

/// Why a command was not carried out.
#[derive(Debug, Error)]
enum Failure {
    #[error("{file}: {error}")]
    Scenario { file: String, error: ScenarioError },
    #[error("{file}: not UTF-8 text, so not JSON")]
    NotText { file: String },
    #[error("{file}: {error}")]
    File { file: String, error: io::Error },
}

impl Failure {
    fn exit_code(&self) -> ExitCode {
        match self {
            Self::Scenario { .. } | Self::NotText { .. } => ExitCode::from(2),
            Self::File { .. } => ExitCode::from(1),
        }
    }
}

/// Reads the arguments and does what they say.
pub fn main() -> ExitCode {
    match execute(Cli::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // Nobody is left to be told when standard error is closed too.
            let _ = writeln!(io::stderr(), "quadtank: {failure}");
            failure.exit_code()
        }
    }
}

fn execute(command: Command) -> Result<(), Failure> {
    match command {
        Command::Analyse { file } => {
            let analysis = compute(&file, analyse)?;
            print_json(&AnalysisReport::from(&analysis))
        }
        Command::Simulate { file, format } => {
            let run = compute(&file, run)?;
            match format {
                Format::Csv => print(&run.to_csv()),
                Format::Json => print_json(&run),
            }
        }
        Command::Plot { file, svg, chart, theme } => {
            let drawing = compute(&file, |setup| plot::svg(setup, chart, theme))?;
            if is_standard_stream(&svg) { print(&drawing) } else { write_file(&svg, &drawing) }
        }
        Command::Presets { name: None } => print(&list_of_presets()),
        Command::Presets { name: Some(id) } => {
            let scenario = Scenario::from(setup_of(id));
            let text = to_json(&scenario).map_err(|error| Failure::Scenario { file: id.name().to_owned(), error })?;
            print(&(text + "\n"))
        }
        Command::Schema => print_json(&schemars::schema_for!(Scenario)),
    }
}

/// Reads a scenario and asks something about its setup.
fn compute<T>(file: &Path, ask: impl Fn(&Setup) -> Result<T, ScenarioError>) -> Result<T, Failure> {
    let text = read(file)?;
    from_json(&text)
        .and_then(|scenario| ask(&scenario.setup))
        .map_err(|error| Failure::Scenario { file: file_name(file), error })
}

/// Reads a file or standard input, but not much more than a scenario may have.
fn read(file: &Path) -> Result<String, Failure> {
    let mut bytes = Vec::new();
    let limit = DOCUMENT_LIMIT as u64 + 1;
    let result = if is_standard_stream(file) {
        io::stdin().lock().take(limit).read_to_end(&mut bytes)
    } else {
        File::open(file).and_then(|opened| opened.take(limit).read_to_end(&mut bytes))
    };
    result.map_err(|error| Failure::File { file: file_name(file), error })?;
    String::from_utf8(bytes).map_err(|_| Failure::NotText { file: file_name(file) })
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

fn list_of_presets() -> String {
    PresetId::ALL.map(PresetId::preset).iter().fold(String::new(), |mut list, preset| {
        let [gamma_1, gamma_2] = preset.plant.valves;
        let name = preset.id.name();
        // Writing to a String cannot fail.
        let _ = writeln!(list, "{name:<33} γ = {gamma_1:.2}, {gamma_2:.2}   {}, {}", preset.source, preset.table);
        list
    })
}

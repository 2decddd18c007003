//! Lessons without a screen: audits, marks and reports.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use quadtank_lesson::{
    Fault as LessonFault, FaultKind, LESSON_IDS, LESSON_LIMIT, Lesson, NAMED_FORMULAS, Named, Report, ReportError,
    StartError, TERMS, Tongue, audit, bench_names, built_in, read_lesson, solutions,
};
use quadtank_scenario::quantities_of;
use thiserror::Error;

use super::files::{bytes_of, file_name, print, print_json};
use super::quantities::{near, suggested_quantities, suggestion};
use super::{Failure, mark, message, told};

/// What is checked.
#[derive(Args)]
pub struct CheckOptions {
    /// Lesson files (JSON), - for standard input, or ids of lessons of the laboratory
    #[arg(conflicts_with = "report", required_unless_present_any = ["report", "all"])]
    pub files: Vec<PathBuf>,
    /// Audit the lessons, without files those of the laboratory: everything that an author has to mend, a line for each fault
    #[arg(long, conflicts_with_all = ["report", "step", "task", "document"])]
    all: bool,
    /// Print the solutions of the lesson
    #[arg(long, conflicts_with_all = ["all", "report", "step", "task", "document"])]
    solutions: bool,
    /// The step of the task, from 1
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub step: Option<u32>,
    /// The task to which standard input has an answer
    #[arg(long, value_name = "ID")]
    pub task: Option<String>,
    /// The student: what the numbers follow from that differ from student to student
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u32,
    /// The bench as the student has it, where a number is to be read from it (`"of": "present"`)
    #[arg(long, value_name = "FILE")]
    pub document: Option<PathBuf>,
    /// Language of the feedback
    #[arg(long, default_value = "en", value_parser = PossibleValuesParser::new(Tongue::ALL.map(Tongue::tag)))]
    pub lang: String,
    /// Print the report that a code holds
    #[arg(long, value_name = "CODE", conflicts_with_all = ["step", "task", "document"])]
    report: Option<String>,
}

/// Why nothing is marked.
#[derive(Debug, Error)]
pub enum CheckFault {
    #[error("say which: --task ID marks an answer to it, --all audits the lesson")]
    NoTask,
    #[error("one lesson is marked at a time; --all audits several")]
    SeveralFiles,
    #[error("there is no step {step}; the lesson has {count}")]
    NoStep { step: u32, count: usize },
    #[error("step {step} has no task `{task}`; it has {}", listed(known))]
    NotInStep { step: u32, task: String, known: Vec<String> },
    #[error("there is no task `{task}`; the lesson has {}", listed(known))]
    UnknownTask { task: String, known: Vec<String> },
    #[error("step {step} has several tasks or none: name one with --task; it has {}", listed(known))]
    WhichTask { step: u32, known: Vec<String> },
    #[error("the answer to task `{task}` is {expected}")]
    Answer { task: String, expected: &'static str },
    #[error("this is a document of the bench {found}; the lesson is about {expected}")]
    OtherBench { found: &'static str, expected: String },
    #[error("the state of task `{task}` cannot be made: {error}")]
    State { task: String, error: StartError },
    #[error("the solutions cannot be found: {0}")]
    Solutions(StartError),
    #[error("--report: {0}")]
    Report(#[from] ReportError),
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

/// Does what the options say.
pub fn run(options: &CheckOptions) -> Result<(), Failure> {
    match (&options.report, options.all) {
        (Some(code), _) => report(code),
        (None, true) => audit_all(&options.files),
        (None, false) if options.solutions => print_solutions(options),
        (None, false) => mark::run(options),
    }
}

fn print_solutions(options: &CheckOptions) -> Result<(), Failure> {
    let [file] = options.files.as_slice() else { return Err(CheckFault::SeveralFiles.into()) };
    let found = solutions(&lesson_of(file)?, options.seed).map_err(CheckFault::Solutions)?;
    print_json(&found)
}

fn report(code: &str) -> Result<(), Failure> {
    let report = Report::from_code(code).map_err(CheckFault::from)?;
    print_json(&report)?;
    message::tell("a code proves nothing: whoever wants to can make one, with any name and any points");
    Ok(())
}

/// The lesson of a file, or that of the laboratory with this id.
pub fn lesson_of(file: &Path) -> Result<Lesson, Failure> {
    match file.to_str().and_then(built_in) {
        Some(text) => told(file, read_lesson(text.as_bytes())),
        None => told(file, read_lesson(&bytes_of(file, LESSON_LIMIT)?)),
    }
}

/// Audits the lessons of files; without files those of the laboratory.
fn audit_all(files: &[PathBuf]) -> Result<(), Failure> {
    let known = LESSON_IDS.map(PathBuf::from);
    let files = if files.is_empty() { known.as_slice() } else { files };
    let mut lessons = Vec::new();
    let mut is_faultless = true;
    for file in files {
        match lesson_of(file) {
            Ok(lesson) => lessons.push((file_name(file), lesson)),
            Err(fault @ Failure::Document { .. }) => {
                is_faultless = false;
                message::list(fault);
            }
            Err(failure) => return Err(failure),
        }
    }
    let ids: Vec<&str> = LESSON_IDS.into_iter().chain(lessons.iter().map(|(_, lesson)| lesson.id.as_str())).collect();
    for (name, lesson) in &lessons {
        let faults = audit(lesson, &TERMS, &ids);
        for fault in &faults {
            message::list(format!("{name}: {fault}{}", help(lesson, &ids, fault)));
        }
        if faults.is_empty() {
            print(&format!("{name}: {}\n", summary(lesson)))?;
        } else {
            is_faultless = false;
        }
    }
    if is_faultless { Ok(()) } else { Err(Failure::Faults) }
}

/// Names that are like one that is unknown.
fn help(lesson: &Lesson, lessons: &[&str], fault: &LessonFault) -> String {
    let FaultKind::Unknown { what, name, .. } = &fault.kind else { return String::new() };
    let formulas = || NAMED_FORMULAS.map(|(name, _)| name);
    match what {
        Named::Quantity => {
            let rows = bench_names(&lesson.bench).map_or_else(Vec::new, |bench| quantities_of(bench.version));
            suggested_quantities(&near(name, rows.iter().map(|row| row.name)))
        }
        Named::Word => suggestion(&near(name, TERMS)).unwrap_or_default(),
        Named::Lesson => suggestion(&near(name, lessons.iter().copied())).unwrap_or_default(),
        Named::Formula => {
            suggestion(&near(name, formulas())).unwrap_or_else(|| format!("; there are {}", formulas().join(", ")))
        }
        Named::Bench | Named::Card | Named::Controls => String::new(),
    }
}

fn summary(lesson: &Lesson) -> String {
    let languages: Vec<&str> = lesson.languages.iter().map(|tongue| tongue.tag()).collect();
    format!("{} steps, {} points, {}", lesson.steps.len(), lesson.points(), languages.join(", "))
}

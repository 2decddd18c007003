//! A lesson as a package for learning management systems.

use std::path::PathBuf;

use clap::Args;
use quadtank_lesson::{LESSON_IDS, TERMS, audit, scorm_package};
use thiserror::Error;

use super::check::lesson_of;
use super::files::{bytes_of, file_name, is_standard_stream, print_bytes, write_file};
use super::{Failure, message};

/// Longest page that is read (bytes): several times the laboratory.
const PAGE_LIMIT: usize = 64 * 1024 * 1024;

/// What goes into the package.
#[derive(Args)]
pub struct ScormOptions {
    /// Lesson file (JSON), - for standard input, or the id of a lesson of the laboratory
    lesson: PathBuf,
    /// File to write, or - for standard output
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// The laboratory as one file: `dist/quadtank.html`, also in the File menu of the page
    #[arg(long, value_name = "FILE")]
    site: PathBuf,
}

/// Why there is no package.
#[derive(Debug, Error)]
pub enum ScormFault {
    #[error("{file}: {error}")]
    Package { file: String, error: quadtank_lesson::PackageError },
    #[error("{file}: not UTF-8 text, so no page")]
    NotText { file: String },
}

/// Writes the package of a lesson.
pub fn run(options: &ScormOptions) -> Result<(), Failure> {
    let lesson = lesson_of(&options.lesson)?;
    let site = || file_name(&options.site);
    let page = String::from_utf8(bytes_of(&options.site, PAGE_LIMIT)?);
    let page = page.map_err(|_| ScormFault::NotText { file: site() })?;
    let package = scorm_package(&page, &lesson).map_err(|error| ScormFault::Package { file: site(), error })?;
    let ids: Vec<&str> = LESSON_IDS.into_iter().chain([lesson.id.as_str()]).collect();
    if !audit(&lesson, &TERMS, &ids).is_empty() {
        let name = file_name(&options.lesson);
        message::tell(format!("{name}: warning: the lesson has faults, which `quadtank check --all` names"));
    }
    if is_standard_stream(&options.output) { print_bytes(&package) } else { write_file(&options.output, &package) }
}

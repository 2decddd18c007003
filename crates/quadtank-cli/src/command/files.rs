//! Files, standard input and standard output.

use std::fs::File;
use std::io::{self, Read, Write as _};
use std::path::Path;

use quadtank_scenario::ScenarioError;
use serde::Serialize;

use super::{Failure, told};

/// The bytes of a file or of standard input. A file that is longer than `limit` is refused by its size; of what has no size,
/// such as a pipe, not more is read than may be there, and a byte that tells that there is more.
pub fn bytes_of(file: &Path, limit: usize) -> Result<Vec<u8>, Failure> {
    let failed = |error| Failure::File { file: file_name(file), error };
    let mut bytes = Vec::new();
    let most = limit as u64 + 1;
    if is_standard_stream(file) {
        io::stdin().lock().take(most).read_to_end(&mut bytes).map_err(failed)?;
    } else {
        let opened = File::open(file).map_err(failed)?;
        let length = usize::try_from(opened.metadata().map_err(failed)?.len()).unwrap_or(usize::MAX);
        if length > limit {
            return told(file, Err(ScenarioError::TooLong { length, max: limit }));
        }
        opened.take(most).read_to_end(&mut bytes).map_err(failed)?;
    }
    Ok(bytes)
}

/// Writes to standard output. A reader that has seen enough (`quadtank … | head`) is no failure.
pub fn print(text: &str) -> Result<(), Failure> {
    print_bytes(text.as_bytes())
}

/// The same of what is no text.
pub fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    match output.write_all(bytes).and_then(|()| output.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(cannot_print(error)),
        _ => Ok(()),
    }
}

fn cannot_print(error: io::Error) -> Failure {
    Failure::File { file: "standard output".to_owned(), error }
}

pub fn write_file(file: &Path, content: impl AsRef<[u8]>) -> Result<(), Failure> {
    std::fs::write(file, content).map_err(|error| Failure::File { file: file_name(file), error })
}

pub fn is_standard_stream(file: &Path) -> bool {
    file.as_os_str() == "-"
}

pub fn file_name(file: &Path) -> String {
    if is_standard_stream(file) { "standard input".to_owned() } else { file.display().to_string() }
}

pub fn print_json<T: Serialize>(value: &T) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|error| cannot_print(error.into()))?;
    print(&(text + "\n"))
}

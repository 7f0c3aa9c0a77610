//! Rows of text as a CSV file.

use std::fs::File;
use std::io;
use std::path::Path;

use crate::failure::Failure;

/// A CSV file that is written row by row; a file that was there is replaced.
pub struct CsvFile<'path> {
    path: &'path Path,
    writer: csv::Writer<File>,
}

impl<'path> CsvFile<'path> {
    /// An empty file.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn create(path: &'path Path) -> Result<Self, Failure> {
        let writer = csv::Writer::from_path(path).map_err(|error| Failure::file(path, &of_csv(error)))?;
        Ok(Self { path, writer })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write<T: AsRef<[u8]>>(&mut self, row: impl IntoIterator<Item = T>) -> Result<(), Failure> {
        self.writer
            .write_record(row)
            .map_err(|error| Failure::file(self.path, &of_csv(error)))
    }

    /// Hands all rows to the operating system, so that nothing is lost by what comes next.
    ///
    /// # Errors
    /// They cannot be written.
    pub fn flush(&mut self) -> Result<(), Failure> {
        self.writer.flush().map_err(|error| Failure::file(self.path, &error))
    }
}

/// Refuses a file that cannot be written. One that is there keeps what it holds, and one that is not there is not left behind.
///
/// # Errors
/// It cannot be written.
pub fn check(path: &Path) -> Result<(), Failure> {
    let was_there = path.exists();
    let opened = File::options().append(true).create(true).open(path).map(drop);
    let tried = match was_there {
        true => opened,
        false => opened.and_then(|()| std::fs::remove_file(path)),
    };
    tried.map_err(|error| Failure::file(path, &error))
}

/// The failure of the file, with its kind.
fn of_csv(error: csv::Error) -> io::Error {
    let text = error.to_string();
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        _ => io::Error::other(text),
    }
}

//! Rows of text as CSV, into a file or to standard output.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use jostle::scene::Value;

use super::{Column, Table};
use crate::failure::Failure;

/// CSV that is written row by row: each is handed to the operating system at once, so that nothing is lost by what comes next.
pub struct CsvTable {
    place: Place,
    rows: u64,
    /// The last row of numbers.
    text: String,
}

enum Place {
    File { path: PathBuf, file: File },
    StandardOutput,
}

impl CsvTable {
    /// A file with the names of the columns; a file that was there is replaced.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn create(path: &Path, columns: &[Column]) -> Result<Self, Failure> {
        Self::with_header(path, columns.iter().map(|column| column.name.as_str()))
    }

    /// A file with these names as its first line; a file that was there is replaced.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn with_header<'a>(path: &Path, names: impl Iterator<Item = &'a str>) -> Result<Self, Failure> {
        let file = File::create(path).map_err(|error| Failure::file(path, &error))?;
        let path = path.into();
        Self::started(Place::File { path, file }, names)
    }

    /// Standard output, with the names of the columns.
    ///
    /// # Errors
    /// It takes nothing.
    pub fn to_standard_output(columns: &[Column]) -> Result<Self, Failure> {
        Self::started(Place::StandardOutput, columns.iter().map(|column| column.name.as_str()))
    }

    fn started<'a>(place: Place, names: impl Iterator<Item = &'a str>) -> Result<Self, Failure> {
        let mut table = Self {
            place,
            rows: 0,
            text: String::new(),
        };
        table.line(names)?;
        Ok(table)
    }

    /// Adds a row of texts. If it does not fit, the file is left with the rows before it.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn record<T: AsRef<[u8]>>(&mut self, row: impl IntoIterator<Item = T>) -> Result<(), Failure> {
        self.line(row)?;
        self.rows += 1;
        Ok(())
    }

    fn line<T: AsRef<[u8]>>(&mut self, row: impl IntoIterator<Item = T>) -> Result<(), Failure> {
        let mut line = csv::Writer::from_writer(Vec::new());
        let made = line.write_record(row).map_err(io::Error::other);
        let line = made.and_then(|()| line.into_inner().map_err(|error| io::Error::other(error.to_string())));
        match (line, &self.place) {
            (Ok(line), _) => self.place.append(&line),
            (Err(error), Place::File { path, .. }) => Err(Failure::file(path, &error)),
            (Err(error), Place::StandardOutput) => Err(Failure::standard_output(error)),
        }
    }
}

impl Place {
    fn append(&mut self, line: &[u8]) -> Result<(), Failure> {
        match self {
            Self::StandardOutput => {
                let mut output = io::stdout().lock();
                let written = output.write_all(line).and_then(|()| output.flush());
                written.map_err(Failure::standard_output)
            }
            Self::File { path, file } => write_whole(file, line).map_err(|error| Failure::file(path, &error)),
        }
    }
}

/// Appends all bytes or, where the file allows it, none.
pub fn write_whole(file: &mut File, bytes: &[u8]) -> io::Result<()> {
    let before = file.stream_position();
    file.write_all(bytes).inspect_err(|_| {
        // A device or a pipe cannot be cut; that it was not is no second failure to tell of.
        let _ = before.and_then(|before| file.set_len(before).and_then(|()| file.seek(SeekFrom::Start(before))));
    })
}

impl Table for CsvTable {
    fn write(&mut self, row: &[Value]) -> Result<(), Failure> {
        self.text.clear();
        for (index, value) in row.iter().enumerate() {
            // Formatting into a string cannot fail, and numbers need no quotes.
            let comma = if index == 0 { "" } else { "," };
            let _ = write!(self.text, "{comma}{value}");
        }
        self.text.push('\n');
        self.place.append(self.text.as_bytes())?;
        self.rows += 1;
        Ok(())
    }

    fn finish(&mut self) -> Result<(), Failure> {
        Ok(())
    }

    fn whole_rows(&self) -> u64 {
        self.rows
    }
}

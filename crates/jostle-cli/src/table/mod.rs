//! A table in a file: columns with names and units, rows of numbers, in one of several formats.
//!
//! Guarantees: memory does not grow with the rows; what was told to be whole can be read, whatever stopped the writing. Not
//! here: which format a name means (`output_file`), what the rows of a run are (`samples`).

mod csv_table;
mod held_rows;
mod netcdf_table;
mod parquet_table;
mod reserved_file;

use std::path::Path;

pub use csv_table::{CsvTable, write_whole};
use jostle::scene::{Kind, Unit, Value, Variable};
pub use netcdf_table::Coordinate;
use netcdf_table::NetCdfTable;
use parquet_table::ParquetTable;

use crate::failure::Failure;
use crate::output_file::Format;

/// What is known of a column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Such as `disk.angle[3]`.
    pub name: String,
    /// Of its numbers; `1` for pure numbers.
    pub unit: &'static str,
    /// One sentence.
    pub description: String,
    /// What it holds.
    pub content: Content,
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Content {
    /// Reals.
    Real,
    /// Whole numbers that fit 32 bits.
    Integer,
    /// Whole numbers of 64 bits.
    Long,
}

impl Column {
    /// A column of reals.
    pub fn real(name: &str, unit: Unit, description: &str) -> Self {
        Self {
            name: name.into(),
            unit: unit.name,
            description: description.into(),
            content: Content::Real,
        }
    }

    /// A column of whole numbers that fit 32 bits.
    pub fn integer(name: &str, description: &str) -> Self {
        Self {
            name: name.into(),
            unit: Unit::ONE.name,
            description: description.into(),
            content: Content::Integer,
        }
    }

    /// The column of a variable.
    pub fn of(variable: &Variable) -> Self {
        let content = match &variable.kind {
            Kind::Real(_) | Kind::Single(_) => Content::Real,
            Kind::Long { .. } | Kind::Sized { .. } => Content::Long,
            Kind::Integer { .. } | Kind::Enumeration { .. } | Kind::Boolean { .. } => Content::Integer,
            // Their lengths: no scene has any.
            Kind::Text { .. } | Kind::Binary { .. } => Content::Long,
        };
        Self {
            name: variable.name.clone(),
            unit: variable.kind.unit().name,
            description: variable.description.clone(),
            content,
        }
    }
}

/// What made a table: a name, a value and its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fact {
    /// Such as `scene` or `drive.amplitude`.
    pub name: String,
    /// The value.
    pub value: FactValue,
    /// Of the value; empty for texts.
    pub unit: &'static str,
}

/// The value of a fact.
#[derive(Debug, Clone, PartialEq)]
pub enum FactValue {
    /// A word.
    Text(String),
    /// A number.
    Number(Value),
    /// An option by its number and name.
    Option(i64, &'static str),
}

impl FactValue {
    /// As a text: an option by its name, a number so that it reads back as the same bits.
    pub fn text(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number(value) => value.to_string(),
            Self::Option(_, name) => (*name).into(),
        }
    }
}

/// A file that takes rows.
pub trait Table {
    /// Adds a row, of as many values as there are columns.
    ///
    /// # Errors
    /// It cannot be written. Call [`finish`](Self::finish) then: the rows before it may be saved.
    fn write(&mut self, row: &[Value]) -> Result<(), Failure>;

    /// Completes the file, so that a reader finds all rows written; no more can be added.
    ///
    /// # Errors
    /// It cannot be written.
    fn finish(&mut self) -> Result<(), Failure>;

    /// Rows that a reader finds in the file as it is now.
    fn whole_rows(&self) -> u64;
}

/// A new table of the format; a file that was there is replaced.
///
/// `fixed` is for NetCDF alone.
///
/// # Errors
/// The file cannot be made.
pub fn create(
    format: Format,
    path: &Path,
    columns: &[Column],
    facts: &[Fact],
    fixed: &[Coordinate],
) -> Result<Box<dyn Table>, Failure> {
    Ok(match format {
        Format::Csv => Box::new(CsvTable::create(path, columns)?),
        Format::StandardOutput => Box::new(CsvTable::to_standard_output(columns)?),
        Format::Parquet => Box::new(ParquetTable::create(path, columns, facts)?),
        Format::NetCdf => Box::new(NetCdfTable::create(path, columns, facts, fixed)?),
    })
}

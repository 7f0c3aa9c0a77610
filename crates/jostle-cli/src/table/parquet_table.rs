//! Rows as a Parquet file: one column of doubles or of whole numbers a variable, in groups of rows.
//!
//! A group is held in memory until it is full. The footer, without which nobody can read the file, comes last: room for it is
//! reserved before each group, so that a full disk costs the rows of the last group and not the file.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use jostle::scene::Value;
use parquet::basic::{Compression, Repetition, Type as Physical};
use parquet::data_type::{DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::reserved_file::ReservedFile;
use super::{Column, Content, Fact, Table};
use crate::failure::Failure;

/// Bytes of rows that are held at least before they are written: small tables have groups of this size.
const LEAST_HELD: u64 = 1 << 20;

/// Bytes of rows that are held at most.
const MOST_HELD: u64 = 1 << 26;

/// Bytes of the footer, in memory, that a column costs in each group.
const FOOTER_OF_A_COLUMN: u64 = 500;

/// Bytes of the footer in the file beside the names and texts, for a column in a group.
const ENTRY: u64 = 160;

/// A Parquet file that is written in groups of rows.
pub struct ParquetTable {
    path: PathBuf,
    writer: SerializedFileWriter<ReservedFile>,
    held: Vec<Held>,
    /// Rows in `held`.
    held_rows: u64,
    /// Rows of a group.
    group: u64,
    /// Groups written.
    groups: u64,
    /// Bytes of names and texts in the footer: those of the schema, and those of each group.
    texts: [u64; 2],
    /// Rows in the groups written.
    rows: u64,
    /// What a reader finds.
    readable: u64,
}

enum Held {
    Reals(Vec<f64>),
    Integers(Vec<i64>),
}

impl ParquetTable {
    /// An empty file; a file that was there is replaced. The facts, units and descriptions become its metadata.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn create(path: &Path, columns: &[Column], facts: &[Fact], rows: u64) -> Result<Self, Failure> {
        let metadata = key_values(columns, facts);
        let text = |pair: &KeyValue| pair.key.len() + pair.value.as_ref().map_or(0, String::len) + 32;
        let names: usize = columns.iter().map(|column| column.name.len()).sum();
        let texts = [metadata.iter().map(text).sum::<usize>() + names, names].map(|bytes| bytes as u64);
        let properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_dictionary_enabled(false)
            .set_statistics_enabled(EnabledStatistics::None)
            .set_offset_index_disabled(true)
            .set_created_by(format!("jostle {}", env!("CARGO_PKG_VERSION")))
            .set_key_value_metadata(Some(metadata))
            .build();
        let made = ReservedFile::create(path).and_then(|file| {
            let schema = schema(columns).map_err(of_parquet)?;
            SerializedFileWriter::new(file, Arc::new(schema), Arc::new(properties)).map_err(of_parquet)
        });
        let mut table = Self {
            path: path.into(),
            writer: made.map_err(|error| Failure::file(path, &error))?,
            held: columns.iter().map(Held::of).collect(),
            held_rows: 0,
            group: rows_of_a_group(columns.len() as u64, rows),
            groups: 0,
            texts,
            rows: 0,
            readable: 0,
        };
        let footer = table.footer(0);
        table.reserve(footer)?;
        Ok(table)
    }

    /// Most bytes of the footer after so many groups.
    fn footer(&self, groups: u64) -> u64 {
        let columns = self.held.len() as u64;
        let [schema, of_a_group] = self.texts;
        4096 + schema + 64 * columns + groups * (64 + of_a_group + ENTRY * columns)
    }

    fn reserve(&mut self, bytes: u64) -> Result<(), Failure> {
        let reserved = self.writer.inner_mut().reserve(bytes);
        reserved.map_err(|error| Failure::file(&self.path, &error))
    }

    /// Writes what is held as a group.
    fn write_group(&mut self) -> Result<(), Failure> {
        let columns = self.held.len() as u64;
        // What Snappy makes of noise is longer than the noise, by up to a sixth; pages have a head.
        let group = columns * (self.held_rows * 8 * 7 / 6 + 512);
        self.reserve(group + self.footer(self.groups + 1))?;
        let written = self.writer.next_row_group().and_then(|mut group| {
            for held in &mut self.held {
                held.write_into(&mut group)?;
            }
            group.close()
        });
        written.map_err(|error| Failure::file(&self.path, &of_parquet(error)))?;
        self.groups += 1;
        self.rows += self.held_rows;
        self.held_rows = 0;
        Ok(())
    }

    /// Writes the footer.
    fn close(&mut self) -> io::Result<()> {
        self.writer.finish().map_err(of_parquet)?;
        self.writer.inner_mut().cut()
    }
}

impl Table for ParquetTable {
    fn write(&mut self, row: &[Value]) -> Result<(), Failure> {
        for (held, value) in self.held.iter_mut().zip(row) {
            match (held, *value) {
                (Held::Reals(reals), Value::Real(real)) => reals.push(real),
                (Held::Reals(reals), Value::Integer(integer)) => reals.push(integer as f64),
                (Held::Integers(integers), Value::Integer(integer)) => integers.push(integer),
                (Held::Integers(integers), Value::Real(real)) => integers.push(real as i64),
            }
        }
        self.held_rows += 1;
        if self.held_rows < self.group {
            return Ok(());
        }
        self.write_group()
    }

    fn finish(&mut self) -> Result<(), Failure> {
        let grouped = match self.held_rows {
            0 => Ok(()),
            _ => self.write_group(),
        };
        self.held.iter_mut().for_each(Held::free);
        self.held_rows = 0;
        let closed = self.close().map_err(|error| Failure::file(&self.path, &error));
        if closed.is_ok() {
            self.readable = self.rows;
        }
        grouped.and(closed)
    }

    fn whole_rows(&self) -> u64 {
        self.readable
    }
}

impl Held {
    fn of(column: &Column) -> Self {
        match column.content {
            Content::Real => Self::Reals(Vec::new()),
            Content::Integer | Content::Long => Self::Integers(Vec::new()),
        }
    }

    fn write_into(&mut self, group: &mut SerializedRowGroupWriter<'_, ReservedFile>) -> Result<(), ParquetError> {
        let missing = || ParquetError::General("a column too many".into());
        let mut column = group.next_column()?.ok_or_else(missing)?;
        match self {
            Self::Reals(reals) => {
                column.typed::<DoubleType>().write_batch(reals, None, None)?;
                reals.clear();
            }
            Self::Integers(integers) => {
                column.typed::<Int64Type>().write_batch(integers, None, None)?;
                integers.clear();
            }
        }
        column.close()
    }

    fn free(&mut self) {
        match self {
            Self::Reals(reals) => *reals = Vec::new(),
            Self::Integers(integers) => *integers = Vec::new(),
        }
    }
}

/// Rows that are held: as many as make them and the footer of `rows` rows together smallest.
fn rows_of_a_group(columns: u64, rows: u64) -> u64 {
    let row = 8 * columns;
    let balanced = (rows.saturating_mul(FOOTER_OF_A_COLUMN) / 8).isqrt();
    balanced.clamp((LEAST_HELD / row).max(1), (MOST_HELD / row).max(1))
}

fn schema(columns: &[Column]) -> Result<Type, ParquetError> {
    let field = |column: &Column| {
        let physical = match column.content {
            Content::Real => Physical::DOUBLE,
            Content::Integer | Content::Long => Physical::INT64,
        };
        let field = Type::primitive_type_builder(&column.name, physical).with_repetition(Repetition::REQUIRED);
        field.build().map(Arc::new)
    };
    let fields: Result<Vec<_>, _> = columns.iter().map(field).collect();
    Type::group_type_builder("schema").with_fields(fields?).build()
}

/// Each fact under its name, and `units/NAME` and `long_name/NAME` of each column and fact.
fn key_values(columns: &[Column], facts: &[Fact]) -> Vec<KeyValue> {
    let mut pairs: Vec<KeyValue> = Vec::new();
    for fact in facts {
        pairs.push(KeyValue::new(fact.name.clone(), fact.value.text()));
        if !fact.unit.is_empty() {
            pairs.push(KeyValue::new(format!("units/{}", fact.name), fact.unit.to_string()));
        }
    }
    for column in columns {
        pairs.push(KeyValue::new(format!("units/{}", column.name), column.unit.to_string()));
        pairs.push(KeyValue::new(
            format!("long_name/{}", column.name),
            column.description.clone(),
        ));
    }
    pairs
}

/// The failure of the file, with its kind.
fn of_parquet(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(inner) => match inner.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(other) => io::Error::other(other),
        },
        other => io::Error::other(other),
    }
}

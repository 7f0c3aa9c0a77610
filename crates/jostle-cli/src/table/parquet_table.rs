//! Rows as a Parquet file: one column of doubles or of whole numbers a variable, in groups of rows.
//!
//! A group is held until it is full: narrow tables in memory, wide ones in a temporary file, since each column of each group
//! costs memory for the footer, and groups must be long. The footer, without which nobody can read the file, comes last. Room
//! for it and for the rows held is reserved in the file as they come, so that a full disk costs none of them.

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

use super::held_rows::HeldRows;
use super::reserved_file::ReservedFile;
use super::{Column, Content, Fact, Table};
use crate::failure::Failure;

/// Bytes of a group that is held in memory.
const IN_MEMORY: usize = 1 << 22;

/// Rows of a group at least. What does not fit into memory then is held in a file.
const LEAST_ROWS: usize = 4096;

/// Rows of a group that is held in a file. The footer of a column in a group takes 0.75 kB of memory: 1 % of its numbers.
const ROWS_IN_FILE: usize = 8192;

/// Bytes of numbers that are turned from rows into columns at once.
const BLOCK: usize = 1 << 24;

/// Bytes for which room is reserved at once.
const RESERVED: usize = 1 << 20;

/// Bytes of the footer in the file beside the names and texts, for a column in a group.
const ENTRY: u64 = 160;

/// A Parquet file that is written in groups of rows.
pub struct ParquetTable {
    path: PathBuf,
    writer: SerializedFileWriter<ReservedFile>,
    contents: Vec<Content>,
    held: HeldRows,
    /// Rows of a group.
    group: usize,
    /// Rows of this group for which there is room.
    room: usize,
    /// Groups written.
    groups: u64,
    /// Bytes of names and texts in the footer: those of the schema, and those of each group.
    texts: [u64; 2],
    /// Rows in the groups written.
    rows: u64,
    /// What a reader finds.
    readable: u64,
}

impl ParquetTable {
    /// An empty file; a file that was there is replaced. The facts, units and descriptions become its metadata.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn create(path: &Path, columns: &[Column], facts: &[Fact]) -> Result<Self, Failure> {
        let in_memory = IN_MEMORY / (8 * columns.len());
        let (group, held) = match in_memory >= LEAST_ROWS {
            true => (in_memory, Ok(HeldRows::in_memory(columns.len()))),
            false => (ROWS_IN_FILE, HeldRows::in_file(columns.len(), folder_of(path))),
        };
        let held = held.map_err(|error| Failure::file(path, &error))?;
        Self::in_groups(path, columns, facts, group, held)
    }

    fn in_groups(
        path: &Path,
        columns: &[Column],
        facts: &[Fact],
        group: usize,
        held: HeldRows,
    ) -> Result<Self, Failure> {
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
            contents: columns.iter().map(|column| column.content).collect(),
            held,
            group,
            room: 0,
            groups: 0,
            texts,
            rows: 0,
            readable: 0,
        };
        table.make_room(0)?;
        Ok(table)
    }

    /// Most bytes of the footer after so many groups.
    fn footer(&self, groups: u64) -> u64 {
        let columns = self.contents.len() as u64;
        let [schema, of_a_group] = self.texts;
        4096 + schema + 64 * columns + groups * (64 + of_a_group + ENTRY * columns)
    }

    /// Reserves room for a group of so many rows, and for the footer.
    fn make_room(&mut self, rows: usize) -> Result<(), Failure> {
        let (rows, columns) = (rows as u64, self.contents.len() as u64);
        // What Snappy makes of noise is longer than the noise, by up to a sixth; pages have a head.
        let group = columns * (rows * 8 * 7 / 6 + 512);
        let needed = group + self.footer(self.groups + 1);
        let reserved = self.writer.inner_mut().reserve(needed);
        reserved.map_err(|error| Failure::file(&self.path, &error))?;
        self.room = rows as usize;
        Ok(())
    }

    /// Writes what is held as a group.
    fn write_group(&mut self) -> Result<(), Failure> {
        let rows = self.held.rows();
        let width = (BLOCK / (8 * rows)).max(1);
        let (contents, held) = (&self.contents, &mut self.held);
        let written = self.writer.next_row_group().and_then(|mut group| {
            for first in (0..contents.len()).step_by(width) {
                let columns = first..(first + width).min(contents.len());
                let block = held.block(&columns)?;
                for (index, content) in contents[columns.clone()].iter().enumerate() {
                    let numbers = block.iter().skip(index).step_by(columns.len()).copied();
                    write_column(&mut group, *content, numbers)?;
                }
            }
            group.close()
        });
        written.map_err(|error| Failure::file(&self.path, &of_parquet(error)))?;
        self.groups += 1;
        self.rows += rows as u64;
        self.held.clear();
        self.room = 0;
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
        if self.held.rows() == self.room {
            let more = (RESERVED / (8 * self.contents.len())).max(1);
            self.make_room((self.room + more).min(self.group))?;
        }
        let numbers = row
            .iter()
            .zip(&self.contents)
            .map(|(value, content)| bits(*value, *content));
        let held = self.held.push(numbers);
        held.map_err(|error| Failure::file(&self.path, &error))?;
        if self.held.rows() < self.group {
            return Ok(());
        }
        self.write_group()
    }

    fn finish(&mut self) -> Result<(), Failure> {
        let grouped = match self.held.rows() {
            0 => Ok(()),
            _ => self.write_group(),
        };
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

/// A number as it is held.
fn bits(value: Value, content: Content) -> u64 {
    match (content, value) {
        (Content::Real, Value::Real(real)) => real.to_bits(),
        (Content::Real, Value::Integer(integer)) => (integer as f64).to_bits(),
        (Content::Integer | Content::Long, Value::Integer(integer)) => integer.cast_unsigned(),
        (Content::Integer | Content::Long, Value::Real(real)) => (real as i64).cast_unsigned(),
    }
}

fn write_column(
    group: &mut SerializedRowGroupWriter<'_, ReservedFile>,
    content: Content,
    numbers: impl Iterator<Item = u64>,
) -> Result<(), ParquetError> {
    let missing = || ParquetError::General("a column too many".into());
    let mut column = group.next_column()?.ok_or_else(missing)?;
    match content {
        Content::Real => {
            let reals: Vec<f64> = numbers.map(f64::from_bits).collect();
            column.typed::<DoubleType>().write_batch(&reals, None, None)?;
        }
        Content::Integer | Content::Long => {
            let integers: Vec<i64> = numbers.map(u64::cast_signed).collect();
            column.typed::<Int64Type>().write_batch(&integers, None, None)?;
        }
    }
    column.close()
}

/// The folder of a file.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
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

#[cfg(test)]
mod tests {
    use jostle::scene::Unit;
    use parquet::file::reader::{FileReader, SerializedFileReader};
    use parquet::record::RowAccessor;

    use super::*;

    fn columns() -> Vec<Column> {
        vec![
            Column::real("time", Unit::SECOND, "Time"),
            Column::integer("count", "Count"),
            Column::real("x", Unit::METRE, "Place"),
        ]
    }

    fn row(number: i64) -> [Value; 3] {
        let real = number as f64;
        [Value::Real(0.1 * real), Value::Integer(-number), Value::Real(-real)]
    }

    #[test]
    fn groups_that_are_held_in_a_file_have_all_rows_in_order() {
        let path = std::env::temp_dir().join(format!("jostle-groups-{}.parquet", std::process::id()));
        let held = HeldRows::in_file(3, folder_of(&path)).unwrap();
        let mut table = ParquetTable::in_groups(&path, &columns(), &[], 4, held).unwrap();
        for number in 0..10 {
            table.write(&row(number)).unwrap();
        }
        assert_eq!(table.whole_rows(), 0); // no footer yet
        table.finish().unwrap();
        assert_eq!(table.whole_rows(), 10);
        let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
        let rows_of_groups: Vec<i64> = reader
            .metadata()
            .row_groups()
            .iter()
            .map(|group| group.num_rows())
            .collect();
        assert_eq!(rows_of_groups, [4, 4, 2]);
        for (number, found) in (0..).zip(reader.get_row_iter(None).unwrap()) {
            let found = found.unwrap();
            let values = [
                Value::Real(found.get_double(0).unwrap()),
                Value::Integer(found.get_long(1).unwrap()),
                Value::Real(found.get_double(2).unwrap()),
            ];
            assert_eq!(values, row(number));
        }
        std::fs::remove_file(path).unwrap();
    }
}

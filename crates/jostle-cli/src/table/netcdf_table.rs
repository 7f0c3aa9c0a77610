//! Rows as a NetCDF file: the dataset that the Python package makes of the same run.
//!
//! Dimensions are `time`, which grows, and one for what is numbered: `disk` for `disk.angle[1]`, `disk.angle[2]` and so on,
//! which are one variable `disk.angle`. The format is that of 64-bit offsets, version 2 of the classic one, which needs no
//! library in C and which every program for NetCDF reads.
//!
//! The crate `netcdf3` writes the head. The records behind it are the numbers of a row one after the other, big-endian, and
//! are written here: the crate keeps a list of all that it wrote, so that memory would grow. After each record the number of
//! records in the head is set, so that the file can be read at any time.

use std::cell::RefCell;
use std::fs::File;
use std::io::{self, Cursor, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use jostle::scene::Value;
use netcdf3::{DataSet, FileWriter, Version};

use super::csv_table::write_whole;
use super::{Column, Content, Fact, FactValue, Table};
use crate::failure::Failure;

/// The dimension that grows.
const TIME: &str = "time";

/// Where the number of records is in the head.
const RECORDS: u64 = 4;

/// A NetCDF file that is written record by record.
pub struct NetCdfTable {
    path: PathBuf,
    file: File,
    /// Position in a row, and content, of each number of a record.
    order: Vec<(usize, Content)>,
    record: Vec<u8>,
    rows: u32,
}

/// Numbers that do not change with time, one for each member of a dimension: `disk.radius[1]` and so on.
pub struct Coordinate {
    /// What is known of the first of them.
    pub column: Column,
    /// All of them.
    pub values: Vec<f64>,
}

/// Columns that differ in a number in brackets alone, as one variable.
struct Array {
    name: String,
    first: Column,
    /// Positions in a row.
    positions: Vec<usize>,
    numbered: bool,
}

impl NetCdfTable {
    /// An empty file; a file that was there is replaced. The first column is the time.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn create(path: &Path, columns: &[Column], facts: &[Fact], fixed: &[Coordinate]) -> Result<Self, Failure> {
        let failure = |error: io::Error| Failure::file(path, &error);
        let arrays = grouped(columns, facts);
        let head = head(&arrays, facts, fixed).map_err(failure)?;
        let mut file = File::create(path).map_err(failure)?;
        write_whole(&mut file, &head).map_err(failure)?;
        let order = arrays
            .iter()
            .flat_map(|array| array.positions.iter().map(|&position| (position, array.first.content)))
            .collect();
        Ok(Self {
            path: path.into(),
            file,
            order,
            record: Vec::new(),
            rows: 0,
        })
    }

    fn append(&mut self) -> io::Result<()> {
        write_whole(&mut self.file, &self.record)?;
        let end = self.file.stream_position()?;
        self.file.seek(SeekFrom::Start(RECORDS))?;
        self.file.write_all(&(self.rows + 1).to_be_bytes())?;
        self.file.seek(SeekFrom::Start(end))?;
        self.rows += 1;
        Ok(())
    }
}

impl Table for NetCdfTable {
    fn write(&mut self, row: &[Value]) -> Result<(), Failure> {
        self.record.clear();
        for &(position, content) in &self.order {
            match (content, row[position]) {
                (Content::Integer, Value::Integer(integer)) => {
                    let fits = i32::try_from(integer).unwrap_or(i32::MAX);
                    self.record.extend(fits.to_be_bytes());
                }
                (Content::Integer, Value::Real(real)) => self.record.extend((real as i32).to_be_bytes()),
                (_, Value::Integer(integer)) => self.record.extend((integer as f64).to_be_bytes()),
                (_, Value::Real(real)) => self.record.extend(real.to_be_bytes()),
            }
        }
        self.append().map_err(|error| Failure::file(&self.path, &error))
    }

    fn finish(&mut self) -> Result<(), Failure> {
        Ok(())
    }

    fn whole_rows(&self) -> u64 {
        self.rows.into()
    }
}

/// `disk` for `disk.angle`, `contact` for `contact.state`.
fn dimension(name: &str) -> &str {
    name.split('.').next().unwrap_or(name)
}

/// The columns as variables, in their order; `contact[1].state` and `contact[2].state` are elements of one, unless a parameter has
/// the name without numbers.
fn grouped(columns: &[Column], facts: &[Fact]) -> Vec<Array> {
    let mut arrays: Vec<Array> = Vec::new();
    for (position, column) in columns.iter().enumerate() {
        let base = without_number(&column.name);
        let is_taken = facts.iter().any(|fact| fact.name == base);
        let name = if is_taken { column.name.clone() } else { base };
        match arrays.iter_mut().rev().find(|array| array.name == name) {
            Some(array) => array.positions.push(position),
            None => arrays.push(Array {
                numbered: name != column.name,
                name,
                first: column.clone(),
                positions: vec![position],
            }),
        }
    }
    arrays
}

/// `disk.angle` for `disk.angle[3]`.
fn without_number(name: &str) -> String {
    match (name.find('['), name.find(']')) {
        (Some(open), Some(close)) if open < close => format!("{}{}", &name[..open], &name[close + 1..]),
        _ => name.into(),
    }
}

/// The head of the file with the numbers that do not change, and no record.
fn head(arrays: &[Array], facts: &[Fact], fixed: &[Coordinate]) -> io::Result<Vec<u8>> {
    let mut set = DataSet::new();
    define(&mut set, arrays, fixed)?;
    for fact in facts {
        add_fact(&mut set, fact)?;
    }
    let bytes = Bytes::default();
    let mut writer = FileWriter::open_seek_write("", Box::new(bytes.clone())).map_err(other)?;
    writer.set_def(&set, Version::Offset64Bit, 0).map_err(other)?;
    for (name, size) in dimensions(arrays) {
        let numbers: Vec<i32> = (1..=size as i32).collect();
        writer.write_var_i32(name, &numbers).map_err(other)?;
    }
    for coordinate in fixed {
        let name = without_number(&coordinate.column.name);
        writer.write_var_f64(&name, &coordinate.values).map_err(other)?;
    }
    writer.close().map_err(other)?;
    Ok(bytes.0.take().into_inner())
}

/// Names and sizes of the dimensions beside the time.
fn dimensions(arrays: &[Array]) -> Vec<(&str, usize)> {
    let mut found: Vec<(&str, usize)> = Vec::new();
    for array in arrays.iter().filter(|array| array.numbered) {
        let name = dimension(&array.name);
        if !found.iter().any(|(known, _)| *known == name) {
            found.push((name, array.positions.len()));
        }
    }
    found
}

fn define(set: &mut DataSet, arrays: &[Array], fixed: &[Coordinate]) -> io::Result<()> {
    set.set_unlimited_dim(TIME, 0).map_err(other)?;
    let dimensions = dimensions(arrays);
    for &(name, size) in &dimensions {
        set.add_fixed_dim(name, size).map_err(other)?;
        set.add_var_i32(name, &[name]).map_err(other)?;
        let told = format!("Number of the {name}");
        set.add_var_attr_string(name, "long_name", told).map_err(other)?;
    }
    for coordinate in fixed {
        let name = without_number(&coordinate.column.name);
        set.add_var_f64(&name, &[dimension(&name)]).map_err(other)?;
        label(set, &name, &coordinate.column)?;
    }
    for array in arrays {
        let own = dimension(&array.name);
        let shape = if array.numbered { vec![TIME, own] } else { vec![TIME] };
        match array.first.content {
            Content::Integer => set.add_var_i32(&array.name, &shape),
            Content::Real | Content::Long => set.add_var_f64(&array.name, &shape),
        }
        .map_err(other)?;
        label(set, &array.name, &array.first)?;
        let coordinates: Vec<String> = fixed
            .iter()
            .map(|coordinate| without_number(&coordinate.column.name))
            .filter(|name| array.numbered && dimension(name) == own)
            .collect();
        if !coordinates.is_empty() {
            let names = coordinates.join(" ");
            set.add_var_attr_string(&array.name, "coordinates", names)
                .map_err(other)?;
        }
        let known = dimensions.iter().find(|(name, _)| *name == own);
        if array.numbered && known.is_some_and(|(_, size)| *size != array.positions.len()) {
            return Err(io::Error::other(format!(
                "{} has another length than {own}",
                array.name
            )));
        }
    }
    Ok(())
}

fn label(set: &mut DataSet, name: &str, column: &Column) -> io::Result<()> {
    let description = column.description.replace("of disk 1", "of each disk");
    set.add_var_attr_string(name, "units", column.unit).map_err(other)?;
    set.add_var_attr_string(name, "long_name", description).map_err(other)
}

/// A fact as an attribute of the file. Whole numbers of more than 32 bits, which the format has not, become text.
fn add_fact(set: &mut DataSet, fact: &Fact) -> io::Result<()> {
    if fact.name.contains('[') {
        return Ok(()); // a coordinate
    }
    match &fact.value {
        FactValue::Number(Value::Real(real)) => set.add_global_attr_f64(&fact.name, vec![*real]),
        FactValue::Number(Value::Integer(integer)) => match i32::try_from(*integer) {
            Ok(small) => set.add_global_attr_i32(&fact.name, vec![small]),
            Err(_) => set.add_global_attr_string(&fact.name, integer.to_string()),
        },
        text => set.add_global_attr_string(&fact.name, text.text()),
    }
    .map_err(other)
}

fn other(error: impl std::fmt::Debug) -> io::Error {
    io::Error::other(format!("{error:?}"))
}

/// Bytes in memory that the crate writes to while we keep a hold of them.
#[derive(Debug, Clone, Default)]
struct Bytes(Rc<RefCell<Cursor<Vec<u8>>>>);

impl Write for Bytes {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for Bytes {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.0.borrow_mut().seek(position)
    }
}

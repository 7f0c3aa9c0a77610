//! FMU in, comparison with the reference trajectory inside it out: does this library compute here what it computed where
//! it was made?
//!
//! The library is loaded and driven through FMI 3.0, which it speaks whatever version the FMU is for. On the same
//! processor and C library all bits are equal. Elsewhere sines, exponentials and the like may differ in the last bit;
//! collisions amplify that. What is amplified more than [`TOLERANCE`] allows is no longer rounding.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use zip::ZipArchive;

use super::abi::importer::Library;
use super::reference;
use crate::error::{Error, Result};

/// Largest difference that passes, relative to the greater of a variable's nominal and its largest value in the table.
///
/// One unit in the last place of gravity, which touches every collision, grows to less than 1e-9 within the table in
/// every scene (`reference_trajectories_are_short` in tests/replay.rs), so that a thousand such slips still pass.
pub const TOLERANCE: f64 = 1e-6;

const MAKE_ANEW: &str = "Write the FMU anew with jostle fmu.";

/// What a replay saw.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Rows of the table.
    pub rows: usize,
    /// Values compared.
    pub values: usize,
    /// Values that differ in some bit.
    pub differing: usize,
    /// Greatest difference, relative as [`TOLERANCE`]; NaN or infinite where a value is.
    pub largest: f64,
    /// Where that was: variable and time \[s\].
    pub place: Option<(String, f64)>,
}

impl Report {
    /// Whether every difference is within [`TOLERANCE`].
    pub fn passes(&self) -> bool {
        self.largest <= TOLERANCE
    }
}

/// Runs the library in `fmu` along its reference trajectory.
///
/// # Errors
/// The file is no FMU of ours, has no library for this platform, or the library refuses a call.
pub fn replay(fmu: &Path) -> Result<Report> {
    let refused = |what: String| Error::file(fmu, what, MAKE_ANEW);
    let file = File::open(fmu).map_err(|error| Error::file(fmu, error, "Name an FMU that jostle wrote."))?;
    let mut archive = ZipArchive::new(file).map_err(|error| refused(error.to_string()))?;
    let mut member = |path: &str| {
        let mut bytes = Vec::new();
        let found = archive.by_name(path).map_err(|error| error.to_string());
        found
            .and_then(|mut entry| entry.read_to_end(&mut bytes).map_err(|error| error.to_string()))
            .map(|_| bytes)
            .map_err(|error| refused(format!("{path}: {error}")))
    };
    let description = Description::read(&String::from_utf8_lossy(&member("modelDescription.xml")?))
        .map_err(|error| refused(format!("modelDescription.xml: {error}")))?;
    let table = Recorded::read(&member(reference::PATH)?).map_err(refused)?;
    let platform = super::bundle::platform(description.version);
    let extension = std::env::consts::DLL_SUFFIX;
    let binary = member(&format!("binaries/{platform}/{}{extension}", description.identifier))?;
    compare(&description, &table, &binary)
}

fn compare(description: &Description, table: &Recorded, binary: &[u8]) -> Result<Report> {
    let columns: Vec<Column> = table.names[1..]
        .iter()
        .map(|name| description.column(name))
        .collect::<Result<_>>()?;
    let (inputs, outputs): (Vec<_>, Vec<_>) = (1..table.names.len()).partition(|index| columns[index - 1].input);
    let mut instance = Library::load(binary)?.instantiate(&description.token)?;
    instance.initialize(table.rows[0][0])?;
    let mut report = Report {
        rows: table.rows.len(),
        values: 0,
        differing: 0,
        largest: 0.0,
        place: None,
    };
    for (number, row) in table.rows.iter().enumerate() {
        for index in &inputs {
            instance.set(columns[index - 1].reference, row[*index])?;
        }
        let mut arrays = HashMap::new();
        for index in &outputs {
            let column = &columns[index - 1];
            let values = match arrays.entry(column.reference) {
                Entry::Occupied(read) => read.into_mut(),
                Entry::Vacant(unread) => unread.insert(instance.get(column.reference, column.span)?),
            };
            let found = values[column.offset];
            let scale = table.largest(*index).max(column.nominal);
            report.note(row[*index], found, scale, (&table.names[*index], row[0]));
        }
        if let Some(next) = table.rows.get(number + 1) {
            instance.step(row[0], next[0] - row[0], next[0])?;
        }
    }
    Ok(report)
}

impl Report {
    fn note(&mut self, expected: f64, found: f64, scale: f64, (name, time): (&str, f64)) {
        self.values += 1;
        if expected.to_bits() == found.to_bits() {
            return;
        }
        self.differing += 1;
        let difference = (found - expected).abs() / scale;
        if difference.is_nan() || difference > self.largest || self.place.is_none() {
            self.largest = difference;
            self.place = Some((name.into(), time));
        }
    }
}

/// The table of the FMU.
struct Recorded {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Recorded {
    fn read(bytes: &[u8]) -> std::result::Result<Self, String> {
        let mut reader = csv::Reader::from_reader(bytes);
        let header = reader.headers().map_err(|error| error.to_string())?;
        let names: Vec<String> = header.iter().map(String::from).collect();
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| error.to_string())?;
            let row: std::result::Result<Vec<f64>, _> = record.iter().map(str::parse).collect();
            rows.push(row.map_err(|error| format!("{}: {error}", reference::PATH))?);
        }
        if rows.is_empty() || names[0] != "time" {
            return Err(format!(
                "{} holds no trajectory: the scene refuses its start values",
                reference::PATH
            ));
        }
        Ok(Self { names, rows })
    }

    fn largest(&self, index: usize) -> f64 {
        self.rows.iter().map(|row| row[index].abs()).fold(0.0, f64::max)
    }
}

/// A column of the table as the library knows it.
struct Column {
    reference: u32,
    offset: usize,
    span: usize,
    nominal: f64,
    input: bool,
}

/// What a replay needs of a model description.
struct Description {
    version: super::Version,
    token: String,
    identifier: String,
    variables: HashMap<String, Described>,
}

#[derive(Default)]
struct Described {
    reference: u32,
    span: Option<usize>,
    nominal: Option<f64>,
    input: bool,
}

impl Description {
    fn read(text: &str) -> std::result::Result<Self, String> {
        let mut reader = Reader::from_str(text);
        let mut found = Self {
            version: super::Version::Three,
            token: String::new(),
            identifier: String::new(),
            variables: HashMap::new(),
        };
        let mut last = None;
        loop {
            match reader.read_event().map_err(|error| error.to_string())? {
                Event::Start(element) | Event::Empty(element) => found.note(&element, &mut last)?,
                Event::Eof => return Ok(found),
                _ => {}
            }
        }
    }

    fn note(&mut self, element: &BytesStart<'_>, last: &mut Option<String>) -> std::result::Result<(), String> {
        let mut attributes = HashMap::new();
        for attribute in element.attributes() {
            let attribute = attribute.map_err(|error| error.to_string())?;
            let value = attribute
                .normalized_value(quick_xml::XmlVersion::Implicit1_0)
                .map_err(|error| error.to_string())?;
            attributes.insert(attribute.key.as_ref().to_owned(), value.into_owned());
        }
        let get = |key: &str| attributes.get(key);
        let number = |key: &str| get(key).and_then(|value| value.parse::<f64>().ok());
        match element.name().as_ref() {
            "fmiModelDescription" => {
                self.token = get("guid").or(get("instantiationToken")).cloned().unwrap_or_default();
                if get("guid").is_some() {
                    self.version = super::Version::Two;
                }
            }
            "CoSimulation" => self.identifier = get("modelIdentifier").cloned().unwrap_or_default(),
            "Dimension" => {
                if let Some(entry) = last.as_ref().and_then(|name| self.variables.get_mut(name)) {
                    entry.span = number("start").map(|span| span as usize);
                }
            }
            _ => match (get("name"), number("valueReference")) {
                (Some(name), Some(reference)) => {
                    let entry = Described {
                        reference: reference as u32,
                        span: None,
                        nominal: number("nominal"),
                        input: get("causality").is_some_and(|causality| causality == "input"),
                    };
                    self.variables.insert(name.clone(), entry);
                    *last = Some(name.clone());
                }
                // FMI 2.0 has the rest in an element of its own.
                _ => {
                    if let Some(entry) = last.as_ref().and_then(|name| self.variables.get_mut(name)) {
                        entry.nominal = entry.nominal.or(number("nominal"));
                    }
                }
            },
        }
        Ok(())
    }

    /// The variable called `name`, or the array that it is an element of.
    fn column(&self, name: &str) -> Result<Column> {
        let unknown = || {
            Error::call(
                format!("{} names {name}, which modelDescription.xml does not", reference::PATH),
                MAKE_ANEW,
            )
        };
        let (entry, offset) = match (self.variables.get(name), name.rsplit_once('[')) {
            (Some(entry), _) => (entry, 0),
            (None, Some((stem, index))) => {
                let entry = self.variables.get(stem).ok_or_else(unknown)?;
                let index: usize = index.trim_end_matches(']').parse().map_err(|_| unknown())?;
                (entry, index.checked_sub(1).ok_or_else(unknown)?)
            }
            (None, None) => return Err(unknown()),
        };
        let span = entry.span.unwrap_or(1);
        if offset >= span {
            return Err(unknown());
        }
        Ok(Column {
            reference: entry.reference,
            offset,
            span,
            nominal: entry.nominal.unwrap_or(1.0),
            input: entry.input,
        })
    }
}

//! FMU in, comparison with the reference trajectory inside it out: does this library compute here what it computed where
//! it was made?
//!
//! The library is loaded and driven through FMI 3.0, which it speaks whatever version the FMU is for. On the same
//! processor and C library all bits are equal. Elsewhere sines, exponentials and the like may differ in the last bit;
//! what a model amplifies more than [`TOLERANCE`] allows is no longer rounding.

mod description;
mod trajectory;

use std::borrow::Cow;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fs::{self, File};
use std::io::{Read, Seek};
use std::path::Path;
use std::sync::Arc;

use fmi_component::{Error, Result};
use zip::ZipArchive;

use crate::importer::{Instance, Library, MAKE_ANEW};
use crate::platform::Platform;
use crate::reference;
use description::Column;
pub(crate) use description::Description;
use trajectory::Trajectory;

/// Largest difference that passes, relative to the greater of a variable's nominal and its largest value in the table.
///
/// Reference trajectories are short, so that a slip in the last place grows to far less within one.
pub const TOLERANCE: f64 = 1e-6;

/// What a replay saw.
#[derive(Debug, Clone, PartialEq)]
pub struct ReplayReport {
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

/// The inputs in a row of the table: each with its reference and its elements, which stand side by side.
fn inputs_of(row: &[f64], inputs: &[usize], columns: &[Column]) -> Vec<(u32, Vec<f64>)> {
    let mut list: Vec<(u32, Vec<f64>)> = Vec::new();
    for index in inputs {
        let (reference, value) = (columns[index - 1].reference, row[*index]);
        match list.last_mut() {
            Some((last, values)) if *last == reference => values.push(value),
            _ => list.push((reference, vec![value])),
        }
    }
    list
}

impl ReplayReport {
    /// Whether every difference is within [`TOLERANCE`].
    pub fn passes(&self) -> bool {
        self.largest <= TOLERANCE
    }

    /// One line: how much of `fmu` was compared, and how many values differ.
    pub fn summary(&self, fmu: &Path) -> String {
        format!(
            "{}: {} values at {} times, {} differ in some bit",
            fmu.display(),
            self.values,
            self.rows,
            self.differing
        )
    }

    /// One line on the greatest difference, if there is one.
    ///
    /// # Errors
    /// It is greater than `allowed`, relative as [`TOLERANCE`].
    pub fn judge(&self, fmu: &Path, allowed: f64) -> Result<Option<String>> {
        let Some((name, time)) = &self.place else {
            return Ok(None);
        };
        let largest = self.largest;
        let what = format!("{name} differs by {largest:e} of its size at t = {time} s");
        if largest <= allowed {
            let within = "that another rounding of sines and exponentials may make";
            return Ok(Some(match allowed == TOLERANCE {
                true => format!("{what}, within the {TOLERANCE:e} {within}"),
                false => format!("{what}, within the {allowed:e} that is allowed"),
            }));
        }
        let remedy = "Is it the FMU as it was made, on a processor that rounds as IEEE 754 says?";
        Err(Error::file(fmu, format!("{what}; allowed is {allowed:e}"), remedy))
    }
}

/// Runs the library in `fmu` along its reference trajectory.
///
/// # Errors
/// The file is no FMU of this crate, has no library for this platform, or the library refuses a call.
pub fn replay(fmu: &Path) -> Result<ReplayReport> {
    replay_file(fmu, None)
}

/// Runs the library in `fmu` along another trajectory, the CSV file `reference`: its first column is `time` \[s\], the inputs in a row are
/// set at its time, and every other column is compared with what the library has then.
///
/// # Errors
/// As of [`replay()`]; the file is no such table.
pub fn replay_against(fmu: &Path, reference: &Path) -> Result<ReplayReport> {
    let bytes = fs::read(reference).map_err(|error| Error::file(reference, error, "Name a CSV file."))?;
    replay_file(fmu, Some((reference.display().to_string(), bytes)))
}

fn replay_file(fmu: &Path, table: Option<(String, Vec<u8>)>) -> Result<ReplayReport> {
    let file = File::open(fmu).map_err(|error| Error::file(fmu, error, "Name an FMU."))?;
    let report = replay_archive(file, table).and_then(|report| {
        report.ok_or_else(|| Error::call("it holds no trajectory: the model refuses its start values", MAKE_ANEW))
    });
    report.map_err(|error| match error {
        Error::Call { what, remedy } => Error::file(fmu, what, remedy),
        other => other,
    })
}

/// As [`replay()`], of an FMU that need not be a file, and along the trajectory in `given`, which has a name, if there is one; none
/// where the model refuses its start values.
///
/// # Errors
/// As [`replay()`]. [`Error::Call`] is about the FMU and does not name it.
pub fn replay_archive(fmu: impl Read + Seek, given: Option<(String, Vec<u8>)>) -> Result<Option<ReplayReport>> {
    let refused = |what: String| Error::call(what, MAKE_ANEW);
    let mut archive = ZipArchive::new(fmu).map_err(|error| refused(error.to_string()))?;
    let held: Vec<String> = archive.file_names().flatten().map(Cow::into_owned).collect();
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
    let (table, bytes) = match given {
        Some(given) => given,
        None => {
            let table = held.iter().find(|path| reference::is_path(path)).cloned();
            let table = table.ok_or_else(|| refused("it holds no reference trajectory".into()))?;
            let bytes = member(&table)?;
            (table, bytes)
        }
    };
    let trajectory = Trajectory::read(&bytes).map_err(|error| refused(format!("{table}: {error}")))?;
    let binary = member(&binary_path(&description, &held)?)?;
    let unknown = |name: &str| refused(format!("{table} names {name}, which modelDescription.xml does not"));
    let column = |name: &String| description.column(name).ok_or_else(|| unknown(name));
    let columns = trajectory.names[1..].iter().map(column).collect::<Result<Vec<_>>>()?;
    let instance = Instance::new(Arc::new(Library::load(&binary)?), &description.token)?;
    if trajectory.rows.is_empty() {
        return Ok(None);
    }
    compare(instance, &trajectory, &columns).map(Some)
}

/// Where the library of this system is among the files `held` of an FMU.
fn binary_path(description: &Description, held: &[String]) -> Result<String> {
    let host = Platform::host().ok_or_else(|| {
        let what = "FMI has no folder for the library of this system";
        Error::call(
            what,
            "Replay it on x86-64 or 64-bit Arm, under Linux, Windows or macOS.",
        )
    })?;
    let folder = host.folder(description.version).ok_or_else(|| {
        let what = format!("FMI 2.0 has no folder for the library of this system, {host}");
        Error::call(what, "Name the FMU of FMI 3.0.")
    })?;
    let path = format!("binaries/{folder}/{}{}", description.identifier, host.suffix());
    if held.contains(&path) {
        return Ok(path);
    }
    let mut folders: Vec<&str> = held
        .iter()
        .filter_map(|path| path.strip_prefix("binaries/")?.split('/').next())
        .collect();
    folders.dedup();
    let found = if folders.is_empty() {
        "no library".into()
    } else {
        format!("libraries for {}", folders.join(", "))
    };
    Err(Error::call(
        format!("it holds {found}, but not {path}"),
        "Name an FMU with a library for this system, or add it by fmu-bundle merge.",
    ))
}

fn compare(mut instance: Instance, table: &Trajectory, columns: &[Column]) -> Result<ReplayReport> {
    let (inputs, outputs): (Vec<_>, Vec<_>) = (1..table.names.len()).partition(|index| columns[index - 1].input);
    let first = inputs_of(&table.rows[0], &inputs, columns);
    instance.enter_initialization(table.rows[0][0])?;
    for (reference, values) in first {
        instance.set(reference, &values)?;
    }
    instance.exit_initialization()?;
    let mut report = ReplayReport {
        rows: table.rows.len(),
        values: 0,
        differing: 0,
        largest: 0.0,
        place: None,
    };
    for (number, row) in table.rows.iter().enumerate() {
        for (reference, values) in inputs_of(row, &inputs, columns) {
            instance.set(reference, &values)?;
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

impl ReplayReport {
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

//! Component and library in, an `.fmu` file out. The same input gives the same bytes: fixed order, no date but that of the
//! component.
//!
//! What is inside, for a model of the package `mechanics`:
//! ```text
//! modelDescription.xml
//! binaries/linux64/<identifier>.so          FMI 2.0
//! binaries/x86_64-linux/<identifier>.so     FMI 3.0
//! documentation/index.html, documentation/licenses/
//! extra/mechanics/reference.csv             what it computes, for `replay`
//! extra/org.fmi-standard.fmi-ls-ref/        the same as an experiment, by the layered standard FMI-LS-REF
//! model.png                                 FMI 2.0: icon
//! terminalsAndIcons/                        terminals and icon
//! ```

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::io::{self, Cursor, ErrorKind, Write};
use std::path::{Path, PathBuf};

use fmi_component::{Error, Result, Version};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use crate::check::check_names;
use crate::component::{Component, Notices};
use crate::platform::platform;
use crate::replay::{TOLERANCE, replay_archive};
use crate::{documentation, model_description, reference, related_files, terminals};

/// The library that exports the model `identifier`, in the first of `folders` that holds it.
///
/// # Errors
/// None does.
pub fn find_library(identifier: &str, folders: &[&Path]) -> Result<PathBuf> {
    let name = format!("{DLL_PREFIX}{identifier}{DLL_SUFFIX}");
    let found = folders
        .iter()
        .map(|folder| folder.join(&name))
        .find(|path| path.is_file());
    found.ok_or_else(|| {
        let list: Vec<_> = folders.iter().map(|folder| folder.display().to_string()).collect();
        Error::file(
            Path::new(&name),
            format!("not found in {}", list.join(", ")),
            "Build it: cargo build --release --workspace; or put it there.",
        )
    })
}

/// Writes the FMU of `component` for `version` to `out`, with the binary `library`, which is loaded and run along the reference
/// trajectory: a library of another model, or of other sources, is refused. [`pack`] takes any bytes.
///
/// # Errors
/// The library cannot be read, is not that of `component`, or the FMU cannot be written. There is then no new file, and one
/// that was there is as before.
pub fn write(component: &Component, version: Version, library: &Path, out: &Path) -> Result<()> {
    if fs::metadata(out).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return Err(Error::file(out, "it is a device, no file", "Give the name of a file."));
    }
    let binary = fs::read(library).map_err(|error| cannot_read(library, &error))?;
    let bytes = pack(component, version, &binary)?;
    check_library(library, &bytes)?;
    // Beside the target and then renamed, so that nobody meets half an FMU.
    let partial = out.with_added_extension("part");
    fs::write(&partial, &bytes)
        .and_then(|()| fs::rename(&partial, out))
        .map_err(|error| {
            let _ = fs::remove_file(&partial);
            cannot_write(out, &error)
        })
}

/// Refuses the library in an FMU if it does not compute what this program does.
fn check_library(library: &Path, fmu: &[u8]) -> Result<()> {
    const BUILD_BOTH: &str =
        "Build the library and this program from the same sources: cargo build --release --workspace.";
    let foreign = |what: String| Error::file(library, what, BUILD_BOTH);
    let report = replay_archive(Cursor::new(fmu)).map_err(|error| match error {
        Error::Call { what, .. } => foreign(what),
        other => other,
    })?;
    let Some(report) = report.filter(|report| !report.passes()) else {
        return Ok(());
    };
    let (name, time) = report.place.unwrap_or_default();
    let largest = report.largest;
    Err(foreign(format!(
        "{name} at t = {time} s differs by {largest:.1e} of its size from what this program computes; allowed is {TOLERANCE:e}"
    )))
}

fn cannot_read(library: &Path, error: &io::Error) -> Error {
    let remedy = match error.kind() {
        ErrorKind::NotFound => "Build it: cargo build --release --workspace, or name the file where it is.",
        ErrorKind::PermissionDenied => "Allow reading it.",
        _ => "Name the file of the library.",
    };
    Error::file(library, error, remedy)
}

/// Why a file cannot be written, and what to do about it.
pub fn cannot_write(out: &Path, error: &io::Error) -> Error {
    let folder = match out.parent() {
        Some(parent) if parent != Path::new("") => parent.display().to_string(),
        _ => "the current folder".into(),
    };
    let (what, remedy) = match error.kind() {
        ErrorKind::NotFound => (
            format!("the folder {folder} does not exist"),
            "Create it, or choose another.",
        ),
        ErrorKind::NotADirectory => (format!("{folder} is not a folder"), "Choose a folder."),
        ErrorKind::IsADirectory => ("it is a folder".into(), "Give the name of a file."),
        ErrorKind::PermissionDenied => (
            format!("no permission to write to {folder}"),
            "Choose a folder that you may write to.",
        ),
        ErrorKind::ReadOnlyFilesystem => (
            format!("{folder} is on a disk that is read-only"),
            "Choose a folder on another.",
        ),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => (
            format!("no space left in {folder} ({error})"),
            "Make room, or choose a folder on another disk.",
        ),
        _ => (error.to_string(), "Choose another file or folder."),
    };
    Error::file(out, what, remedy)
}

/// The bytes of the FMU.
///
/// # Errors
/// Arrays in FMI 2.0, an array with the name of another variable, or the archive cannot be made.
pub fn pack(component: &Component, version: Version, binary: &[u8]) -> Result<Vec<u8>> {
    if component.arrays && version == Version::Two {
        return Err(Error::parameter(
            "version of FMI",
            "2.0",
            "3.0 for array variables, which FMI 2.0 does not have",
            "Write it for FMI 3.0, or with scalar variables.",
        ));
    }
    check_names(component.names())?;
    let failed = |error: &dyn ToString| Error::call(format!("the archive: {}", error.to_string()), "Try again.");
    let path = format!(
        "binaries/{}/{}{DLL_SUFFIX}",
        platform(version),
        component.info().identifier
    );
    let texts = files(component, version, binary)?;
    let texts = texts.iter().map(|(path, content)| (path, content.as_slice(), 0o644));
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, content, permissions) in texts.chain([(&path, binary, 0o755)]) {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .last_modified_time(DateTime::default())
            .unix_permissions(permissions);
        archive
            .start_file(path.as_str(), options)
            .map_err(|error| failed(&error))?;
        archive.write_all(content).map_err(|error| failed(&error))?;
    }
    Ok(archive.finish().map_err(|error| failed(&error))?.into_inner())
}

/// All files but the binary, each with its path.
fn files(component: &Component, version: Version, binary: &[u8]) -> Result<Vec<(String, Vec<u8>)>> {
    // First: a model that panics is told of by what every FMU has.
    let reference = reference::record(component)?;
    let mut list = vec![
        (
            "modelDescription.xml".into(),
            model_description::write(component, version).into_bytes(),
        ),
        (
            "documentation/index.html".into(),
            documentation::write(component, version, binary)?.into_bytes(),
        ),
    ];
    list.extend(licenses(&component.notices));
    let related = related_files::write(component, &reference)?;
    list.push((reference::path(component.info()), reference.into_bytes()));
    list.extend(related);
    if let Some(icon) = &component.icon {
        list.extend((version == Version::Two).then(|| ("model.png".into(), icon.png.clone())));
        list.push(("terminalsAndIcons/icon.png".into(), icon.png.clone()));
        let svg = icon.svg.iter().map(|text| text.clone().into_bytes());
        list.extend(svg.map(|text| ("terminalsAndIcons/icon.svg".into(), text)));
    }
    let terminals = terminals::write(component).map(String::into_bytes);
    list.extend(terminals.map(|text| ("terminalsAndIcons/terminalsAndIcons.xml".into(), text)));
    Ok(list)
}

/// The texts of `notices`, and the file `license.txt` that FMI asks for and that names them.
fn licenses(notices: &Notices) -> Vec<(String, Vec<u8>)> {
    let mut texts = notices.files.clone();
    if !notices.license.is_empty() {
        let names: Vec<&str> = notices.files.iter().map(|(name, _)| name.as_str()).collect();
        let beside = match names.as_slice() {
            [] => String::new(),
            names => format!("\nThe texts are beside this file: {}.\n", names.join(", ")),
        };
        let text = format!("SPDX-License-Identifier: {}\n{beside}", notices.license);
        texts.insert(0, ("license.txt".into(), text));
    }
    let file = |(name, text): (String, String)| (format!("documentation/licenses/{name}"), text.into_bytes());
    texts.into_iter().map(file).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_to_write_is_reported_with_its_remedy() {
        for (kind, what) in [
            (
                ErrorKind::NotFound,
                "the folder some/where does not exist. Create it, or choose another.",
            ),
            (
                ErrorKind::PermissionDenied,
                "no permission to write to some/where. Choose a folder",
            ),
            (
                ErrorKind::StorageFull,
                "no space left in some/where (no storage space). Make room",
            ),
            (ErrorKind::IsADirectory, "it is a folder. Give the name of a file."),
            (ErrorKind::ReadOnlyFilesystem, "read-only"),
        ] {
            let message = cannot_write(Path::new("some/where/a.fmu"), &kind.into()).to_string();
            assert!(
                message.starts_with("some/where/a.fmu: ") && message.contains(what),
                "{message}"
            );
        }
        let message = cannot_write(Path::new("a.fmu"), &ErrorKind::PermissionDenied.into()).to_string();
        assert!(message.contains("to write to the current folder"), "{message}");
    }
}

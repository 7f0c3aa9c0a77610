//! Component and libraries in, an `.fmu` file out. The same input gives the same bytes: fixed order, no date but that of the
//! component.
//!
//! What is inside, for a model of the package `mechanics`:
//! ```text
//! modelDescription.xml
//! binaries/linux64/<identifier>.so          FMI 2.0, and win64, darwin64
//! binaries/x86_64-linux/<identifier>.so     FMI 3.0, and aarch64-linux, x86_64-windows, ...
//! documentation/index.html, documentation/licenses/
//! extra/mechanics/reference.csv             what it computes, for `replay`
//! extra/org.fmi-standard.fmi-ls-ref/        the same as an experiment, by the layered standard FMI-LS-REF
//! model.png                                 FMI 2.0: icon
//! terminalsAndIcons/                        terminals and icon
//! ```

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::fs;
use std::io::{self, Cursor, ErrorKind};
use std::path::{Path, PathBuf};

use fmi_component::{Error, Result, Version};

use crate::archive::{self, Member};
use crate::component::{Component, Notices};
use crate::legal::check_names;
use crate::libraries::Libraries;
use crate::platform::Platform;
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

/// Writes the FMU of `component` for `version` to `out` with `libraries`. That of this system is loaded and run along the
/// reference trajectory: a library of another model, or of other sources, is refused. Those of other systems cannot be run here;
/// [`replay()`](crate::replay()) does that where they run. [`pack`] runs none.
///
/// The FMU has no library for the platforms that [`Libraries::left_out`] names.
///
/// # Errors
/// There is no library for this system among them, it is not that of `component`, or the FMU cannot be written. There is then no
/// new file, and one that was there is as before.
pub fn write(component: &Component, version: Version, libraries: &Libraries, out: &Path) -> Result<()> {
    write_file(out, &checked(component, version, libraries)?)
}

/// The bytes that [`write`] writes.
///
/// # Errors
/// As of [`write`], but for the file.
pub(crate) fn checked(component: &Component, version: Version, libraries: &Libraries) -> Result<Vec<u8>> {
    let library = Platform::host().and_then(|host| libraries.path(host)).ok_or_else(|| {
        let host = Platform::host().map_or("an unknown system", Platform::name);
        Error::call(
            format!("there is no library for this system, {host}, so that none can be run and compared"),
            "Add it, or write the FMU on one of the systems of its libraries.",
        )
    })?;
    let bytes = pack(component, version, libraries)?;
    check_library(library, &bytes)?;
    Ok(bytes)
}

/// Writes a file whole or not at all: beside the target and then renamed, so that nobody meets half an FMU.
///
/// # Errors
/// The file cannot be written; one that was there is as before.
pub(crate) fn write_file(out: &Path, bytes: &[u8]) -> Result<()> {
    if fs::metadata(out).is_ok_and(|found| !found.is_file() && !found.is_dir()) {
        return Err(Error::file(out, "it is a device, no file", "Give the name of a file."));
    }
    let partial = out.with_added_extension("part");
    fs::write(&partial, bytes)
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
    let report = replay_archive(Cursor::new(fmu), None).map_err(|error| match error {
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

/// Why a file cannot be written, and what to do about it.
pub fn cannot_write(out: &Path, error: &io::Error) -> Error {
    let folder = match out.parent() {
        Some(parent) if parent != Path::new("") => parent.display().to_string(),
        _ => "the current folder".into(),
    };
    let (what, remedy) = match error.kind() {
        ErrorKind::NotFound if !out.parent().is_some_and(Path::is_dir) => (
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

/// The bytes of the FMU, with those of `libraries` that an FMU of `version` has a folder for.
///
/// # Errors
/// Arrays in FMI 2.0, no library with a folder in this version, an array with the name of another variable, or the archive
/// cannot be made.
pub fn pack(component: &Component, version: Version, libraries: &Libraries) -> Result<Vec<u8>> {
    if component.arrays && version == Version::Two {
        return Err(Error::parameter(
            "version of FMI",
            "2.0",
            "3.0 for array variables, which FMI 2.0 does not have",
            "Write it for FMI 3.0, or with scalar variables.",
        ));
    }
    check_names(component.names())?;
    let binaries: Vec<_> = libraries
        .iter()
        .filter_map(|(platform, bytes)| Some((platform, platform.folder(version)?, bytes)))
        .collect();
    if binaries.is_empty() {
        let left_out: Vec<_> = libraries.left_out(version).into_iter().map(Platform::name).collect();
        let what = match left_out.join(", ").as_str() {
            "" => "an FMU needs a library, and there is none".into(),
            names => format!("FMI 2.0 has no folder for {names}, and there is no other library"),
        };
        return Err(Error::call(
            what,
            "Add a library for another system, or write it for FMI 3.0.",
        ));
    }
    let page = binaries.iter().map(|&(platform, _, bytes)| (platform, bytes));
    let mut members = files(component, version, &documentation::libraries(page))?;
    let identifier = &component.info().identifier;
    members.extend(binaries.iter().map(|(platform, folder, bytes)| Member {
        path: format!("binaries/{folder}/{identifier}{}", platform.suffix()),
        bytes: bytes.to_vec(),
    }));
    archive::write(&members)
}

/// All files but the libraries, which the documentation page lists by the text `libraries`.
fn files(component: &Component, version: Version, libraries: &str) -> Result<Vec<Member>> {
    // First: a model that panics is told of by what every FMU has.
    let reference = reference::record(component)?;
    let mut list: Vec<(String, Vec<u8>)> = vec![
        (
            "modelDescription.xml".into(),
            model_description::write(component, version).into_bytes(),
        ),
        (
            "documentation/index.html".into(),
            documentation::write(component, version, libraries)?.into_bytes(),
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
    Ok(list.into_iter().map(|(path, bytes)| Member { path, bytes }).collect())
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

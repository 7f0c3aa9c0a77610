//! The FMUs of one component for one or both versions of the standard: what they are called, and what is said of them.

use std::fs;
use std::path::{Path, PathBuf};

use fmi_component::{Error, Result, Version};

use crate::bundle::{cannot_write, write};
use crate::component::Component;
use crate::libraries::Libraries;

/// Writes the FMUs of `component` for `versions` and gives a line of text on each. `out` is the file if there is one version, or a folder, in
/// which they are called `IDENTIFIER.fmi2.fmu` and `IDENTIFIER.fmi3.fmu`; the present one for none. A folder that is missing is
/// made where `out` ends with a `/`.
///
/// # Errors
/// `out` is no folder and there are two versions; as of [`write()`].
pub fn write_versions(
    component: &Component,
    versions: &[Version],
    libraries: &Libraries,
    out: Option<&Path>,
) -> Result<Vec<String>> {
    let files = versions.iter().map(|version| place(component, *version, out));
    let files = files.collect::<Result<Vec<_>>>()?;
    if let ([first, _, ..], Some(out)) = (files.as_slice(), out)
        && first == out
    {
        return Err(Error::file(
            out,
            "it is no folder, and there is an FMU for each version of FMI",
            "Name a folder that is there, or choose one version.",
        ));
    }
    let mut lines = Vec::new();
    for (version, file) in versions.iter().zip(&files) {
        write(component, *version, libraries, file)?;
        lines.push(format!("{}: {}", file.display(), about(component, *version, libraries)));
    }
    Ok(lines)
}

fn place(component: &Component, version: Version, out: Option<&Path>) -> Result<PathBuf> {
    let suffix = match version {
        Version::Two => "fmi2",
        Version::Three => "fmi3",
    };
    let name = format!("{}.{suffix}.fmu", component.info().identifier);
    let Some(out) = out else { return Ok(name.into()) };
    let is_folder = out
        .as_os_str()
        .to_string_lossy()
        .ends_with(['/', std::path::MAIN_SEPARATOR]);
    if is_folder {
        fs::create_dir_all(out).map_err(|error| cannot_write(out, &error))?;
    }
    match is_folder || out.is_dir() {
        true => Ok(out.join(name)),
        false => Ok(out.into()),
    }
}

fn about(component: &Component, version: Version, libraries: &Libraries) -> String {
    let platforms = libraries.iter().map(|(platform, _)| platform);
    let (held, left): (Vec<_>, Vec<_>) = platforms.partition(|platform| platform.folder(version).is_some());
    let names = |list: Vec<crate::Platform>| {
        list.iter()
            .map(|platform| platform.name())
            .collect::<Vec<_>>()
            .join(", ")
    };
    let mut text = format!("FMI {} for {}", version.number(), names(held));
    if !left.is_empty() {
        text.push_str(&format!("; FMI 2.0 has no folder for {}", names(left)));
    }
    let variables = component.left_out(version);
    if !variables.is_empty() {
        text.push_str(&format!("; without {}, which are binary", variables.join(", ")));
    }
    text
}

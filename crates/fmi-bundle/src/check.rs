//! FMU in, its faults out: what no importer would take, and what its library does otherwise than its model description says.
//!
//! The files are checked as they are in the FMU: paths, structure of the XML by the grammars in this folder, names, ranges, references, folders and
//! headers of the libraries, files that others name. Then the library for this system is loaded: it tells what its model is, its start values
//! are read, and every parameter and input is varied to see which outputs change. [`replay()`](crate::replay()) compares what it computes.

mod binaries;
mod contents;
mod dependencies;
mod description;
mod findings;
mod grammar;
mod library;
mod names;
mod resources;

use std::path::Path;

use fmi_component::{Error, Result, Version};
use roxmltree::Document;

use crate::archive::Member;
use crate::platform::Platform;
use crate::reference;
use description::{Described, PATH};
pub use findings::{CheckReport, Fault};
use grammar::Grammar;

/// Checks the FMU in the file, or in the folder, `fmu`. Its library is run with the rights of this program.
///
/// # Errors
/// It cannot be read, or is neither an archive nor a folder. Whatever is wrong inside of it is in the report.
pub fn check(fmu: &Path) -> Result<CheckReport> {
    let mut report = CheckReport::default();
    let members = contents::read(fmu, &mut report)?;
    let Some(text) = members.iter().find(|member| member.path == PATH) else {
        report.fault(PATH, "it is missing", "Name an FMU.");
        return Ok(report);
    };
    match String::from_utf8(text.bytes.clone()) {
        Err(_) => report.fault(PATH, "it is not UTF-8", "Write it in UTF-8."),
        Ok(text) => match Document::parse(&text) {
            Err(error) => report.fault(PATH, error.to_string(), "Write it as XML."),
            Ok(document) => check_contents(&document, &members, &mut report),
        },
    }
    Ok(report)
}

fn check_contents(document: &Document<'_>, members: &[Member], report: &mut CheckReport) {
    let described = Described::read(document);
    let grammar = match described.version {
        Version::Two => include_str!("check/fmi2.txt"),
        Version::Three => include_str!("check/fmi3.txt"),
    };
    Grammar::read(grammar).check(document, PATH, "fmiModelDescription", report);
    names::check(&described, report);
    report.done.push(format!(
        "FMI {}: {} variables",
        described.version.number(),
        described.variables.len()
    ));
    let libraries = binaries::check(&described, members, report);
    let names: Vec<&str> = libraries.iter().map(|(platform, _)| platform.name()).collect();
    report.done.push(format!(
        "libraries for {}",
        if names.is_empty() {
            "no known system".into()
        } else {
            names.join(", ")
        }
    ));
    resources::check(&described, members, report);
    let host = Platform::host().and_then(|host| libraries.iter().find(|(platform, _)| *platform == host));
    match host {
        Some((_, member)) => check_library(&described, member, members, report),
        None => report
            .left_out
            .push("no library for this system: start values and dependencies are not compared".into()),
    }
}

fn check_library(described: &Described, member: &Member, members: &[Member], report: &mut CheckReport) {
    let place = &member.path;
    let component = match library::component(described, &member.bytes) {
        Ok(component) => component,
        Err(error) => return refused(place, error, report),
    };
    if !library::check_model(described, place, &component, report) {
        return;
    }
    let table = reference::path(component.info());
    if !members.iter().any(|member| member.path == table) {
        report.fault(
            &table,
            "it is missing: the trajectory that replay compares with",
            "Write the FMU anew.",
        );
    }
    match library::check_starts(described, &component, report) {
        Ok(count) => report
            .done
            .push(format!("start values: {count} compared with the library")),
        Err(error) => return refused(place, error, report),
    }
    match dependencies::check(described, &component, report) {
        Ok(line) => report.done.push(line),
        Err(error) => refused(place, error, report),
    }
    if !component.contains_panics() {
        let what = "it was built with panic = \"abort\": a panic of the model ends the importer's program";
        report.fault(place, what, "Build it with panic = \"unwind\".");
    }
}

fn refused(place: &str, error: Error, report: &mut CheckReport) {
    match error {
        Error::Call { what, remedy } => report.fault(place, what, remedy),
        other => report.fault(place, other.to_string().trim_end_matches('.'), "Write the FMU anew."),
    }
}

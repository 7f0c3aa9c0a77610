//! The files of an FMU besides description and libraries: those that others name are there, and what they say of variables is true.

use roxmltree::{Document, Node};

use super::description::Described;
use super::findings::CheckReport;
use super::grammar::{Grammar, place};
use crate::archive::Member;

const TERMINALS: &str = "terminalsAndIcons/terminalsAndIcons.xml";
const ADD: &str = "Add the file, or do not name it.";

/// Checks them.
pub fn check(described: &Described, members: &[Member], report: &mut CheckReport) {
    let holds = |path: &str| members.iter().any(|member| member.path == path);
    let any_in = |folder: &str| members.iter().any(|member| member.path.starts_with(folder));
    if any_in("documentation/") && !holds("documentation/index.html") {
        report.fault(
            "documentation/index.html",
            "it is missing: importers open it as the documentation",
            ADD,
        );
    }
    let licences = ["txt", "html"].map(|ending| format!("documentation/licenses/license.{ending}"));
    if any_in("documentation/licenses/") && !licences.iter().any(|path| holds(path)) {
        report.fault(&licences[0], "it is missing: the standard has the licence there", ADD);
    }
    for member in members.iter().filter(|member| is_xml(&member.path)) {
        let text = String::from_utf8_lossy(&member.bytes);
        match Document::parse(&text) {
            Err(error) => report.fault(&member.path, error.to_string(), "Write it as XML."),
            Ok(document) if member.path == TERMINALS => check_terminals(described, &document, &holds, report),
            Ok(document) => check_sources(member, &document, &holds, report),
        }
    }
}

fn is_xml(path: &str) -> bool {
    path != super::description::PATH && (path.ends_with(".xml") || path.ends_with(".exp"))
}

fn check_terminals(
    described: &Described,
    document: &Document<'_>,
    holds: &dyn Fn(&str) -> bool,
    report: &mut CheckReport,
) {
    Grammar::read(include_str!("terminals.txt")).check(document, TERMINALS, "fmiTerminalsAndIcons", report);
    for node in document.descendants().filter(Node::is_element) {
        if let Some(name) = node.attribute("variableName")
            && !described.variables.iter().any(|variable| variable.name() == name)
        {
            let what = format!("variableName = {name:?} is no variable of modelDescription.xml");
            report.fault(place(TERMINALS, node), what, "Name one.");
        }
        let icon = match node.tag_name().name() {
            "Icon" => Some("terminalsAndIcons/icon.png".to_string()),
            _ => node
                .attribute("iconBaseName")
                .map(|name| format!("terminalsAndIcons/{name}.png")),
        };
        if let Some(path) = icon.filter(|path| !holds(path)) {
            report.fault(
                place(TERMINALS, node),
                format!("it names {path}, which is missing"),
                ADD,
            );
        }
    }
}

/// Manifests and experiments of layered standards name files by `source`, from the folder that they are in.
fn check_sources(member: &Member, document: &Document<'_>, holds: &dyn Fn(&str) -> bool, report: &mut CheckReport) {
    for node in document.descendants().filter(Node::is_element) {
        let Some(source) = node.attribute("source").filter(|source| !source.contains("://")) else {
            continue;
        };
        let mut parts: Vec<&str> = member.path.split('/').collect();
        parts.pop();
        for part in source.split('/') {
            match part {
                ".." => _ = parts.pop(),
                "." => {}
                part => parts.push(part),
            }
        }
        let path = parts.join("/");
        if !holds(&path) {
            report.fault(
                place(&member.path, node),
                format!("it names {path}, which is missing"),
                ADD,
            );
        }
    }
}

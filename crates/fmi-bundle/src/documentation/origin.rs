//! Where the component comes from: version, what is new in it, contact, how it was built, licence.

use std::env::consts::{ARCH, OS};

use quick_xml::escape::escape;

use crate::component::Component;
use crate::reference;

/// The part of the page.
pub fn write(component: &Component, binary: &[u8]) -> String {
    let (info, origin) = (component.info(), &component.origin);
    let mut rows = vec![("Version", format!("{} {}", escape(info.package), escape(info.version)))];
    rows.extend(
        component
            .date
            .iter()
            .map(|date| ("Made", escape(date.as_str()).into_owned())),
    );
    let optional = [
        ("Authors", &origin.authors),
        ("Repository", &origin.repository),
        ("Contact", &origin.contact),
        ("Tools", &origin.tools),
    ];
    let given = optional.into_iter().filter(|(_, text)| !text.is_empty());
    rows.extend(given.map(|(name, text)| (name, linked(text))));
    rows.push((
        "Library",
        format!(
            "{} bytes, CRC-32 {:08x}, for {OS} on {ARCH}",
            binary.len(),
            crc32fast::hash(binary)
        ),
    ));
    rows.push(("Check", check(component)));
    if !component.notices.license.is_empty() {
        let licence = escape(component.notices.license.as_str());
        let copyright = escape(component.notices.copyright.as_str());
        rows.push((
            "Licence",
            format!("{licence}. {copyright}. The texts, and the notices of what is linked with its versions, are in the folder \
                     <code>licenses</code> beside this page."),
        ));
    }
    let rows: String = rows
        .iter()
        .map(|(name, text)| format!("<tr><th>{name}</th><td>{text}</td></tr>\n"))
        .collect();
    let changes = match origin.changes.as_str() {
        "" => String::new(),
        changes => format!("<details><summary>What is new in this version</summary>\n{changes}\n</details>\n"),
    };
    format!("<div class=\"wide\"><table>\n{rows}</table></div>\n{changes}")
}

/// `text`, a link where it is an address.
fn linked(text: &str) -> String {
    let shown = escape(text);
    match text.starts_with("https://") || text.starts_with("mailto:") {
        true => format!("<a href=\"{shown}\">{shown}</a>"),
        false => shown.into_owned(),
    }
}

fn check(component: &Component) -> String {
    let path = reference::path(component.info());
    let command = component.replay_command.as_ref().map(|command| {
        let command = escape(command.as_str());
        format!("; <code>{command}</code> runs the library and compares")
    });
    format!(
        "what it computes from its start values under oscillating inputs is in <code>{path}</code> of this FMU{}",
        command.unwrap_or_default()
    )
}

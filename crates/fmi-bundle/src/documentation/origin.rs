//! Where the component comes from: version, what is new in it, contact, how it was built, licence.

use quick_xml::escape::escape;

use crate::component::Component;
use crate::platform::Platform;
use crate::reference;

const BEGIN_LIBRARIES: &str = "<!-- libraries -->";
const END_LIBRARIES: &str = "<!-- end of libraries -->";
const BEGIN_DATE: &str = "<!-- date -->";
const END_DATE: &str = "<!-- end of date -->";

/// The part of the page; `libraries` is a text of [`libraries()`].
pub fn write(component: &Component, libraries: &str) -> String {
    let (info, origin) = (component.info(), &component.origin);
    let mut rows = vec![("Version", format!("{} {}", escape(info.package), escape(info.version)))];
    rows.extend(
        component
            .date
            .iter()
            .map(|date| ("Made", format!("{BEGIN_DATE}{}{END_DATE}", escape(date.as_str())))),
    );
    let optional = [
        ("Authors", &origin.authors),
        ("Repository", &origin.repository),
        ("Contact", &origin.contact),
        ("Tools", &origin.tools),
    ];
    let given = optional.into_iter().filter(|(_, text)| !text.is_empty());
    rows.extend(given.map(|(name, text)| (name, linked(text))));
    rows.push(("Libraries", libraries.into()));
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

/// The libraries in an FMU, a line each.
pub fn libraries<'a>(list: impl Iterator<Item = (Platform, &'a [u8])>) -> String {
    let line = |(platform, bytes): (Platform, &[u8])| {
        let (length, checksum) = (bytes.len(), crc32fast::hash(bytes));
        format!("{platform}: {length} bytes, CRC-32 {checksum:08x}")
    };
    let lines: Vec<String> = list.map(line).collect();
    format!("{BEGIN_LIBRARIES}{}{END_LIBRARIES}", lines.join("<br/>"))
}

/// `page` with other libraries; as it is where it has none.
pub fn with_libraries(page: &str, list: &str) -> String {
    replace_between(page, (BEGIN_LIBRARIES, END_LIBRARIES), list)
}

/// `page` without what differs between machines that made the same FMU: libraries and date.
pub fn without_build(page: &str) -> String {
    replace_between(&with_libraries(page, ""), (BEGIN_DATE, END_DATE), "")
}

/// `text` with the part from `begin` to `end`, both included, replaced.
fn replace_between(text: &str, (begin, end): (&str, &str), by: &str) -> String {
    let parts = text
        .split_once(begin)
        .and_then(|(head, rest)| Some((head, rest.split_once(end)?.1)));
    match parts {
        Some((head, tail)) => [head, by, tail].concat(),
        None => text.into(),
    }
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
        format!("; <code>{command}</code> runs the library of the system at hand and compares")
    });
    format!(
        "what it computes from its start values under oscillating inputs is in <code>{path}</code> of this FMU{}",
        command.unwrap_or_default()
    )
}

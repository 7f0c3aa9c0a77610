//! Component in, the documentation page inside the FMU out.

use std::env::consts::{ARCH, OS};

use fmi_component::{Causality, Kind, Value, Variable, Version, value_reference};
use quick_xml::escape::escape;

use crate::component::Component;
use crate::reference;

const STYLE: &str = "body { font-family: sans-serif; max-width: 60em; margin: 2em auto; line-height: 1.4 } \
                     table { border-collapse: collapse } \
                     th, td { border: 1px solid #bbb; padding: 0.2em 0.5em; text-align: left; vertical-align: top } \
                     th { background: #eee } td.number { text-align: right; white-space: nowrap } \
                     code { background: #f4f4f4 }";

/// The page: what it is, how to use it, its variables, its equations, its licence.
pub fn write(component: &Component, version: Version, binary: &[u8]) -> String {
    let info = component.info();
    let variant = info.variant.first().map(|(_, value)| format!(" ({value})"));
    let title = [info.name.into(), variant.unwrap_or_default()].concat();
    let standard = match version {
        Version::Two => "FMI 2.0",
        Version::Three => "FMI 3.0",
    };
    let variant = info.variant.iter().map(|(key, value)| format!(", {key}: {value}"));
    let structure = component
        .structure()
        .iter()
        .map(|(name, value)| format!(", {name}: {value}"));
    let choices: String = variant.chain(structure).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n<p>{description}</p>\n\
         <p>Co-simulation FMU for {standard}{choices}. Made by {tool}.</p>\n\
         <h2>Use</h2>\n{usage}<h2>Variables</h2>\n{tables}{equations}<h2>Build</h2>\n{build}{licence}</body>\n</html>\n",
        title = escape(title.as_str()),
        description = escape(info.description),
        choices = escape(choices.as_str()),
        tool = escape(component.tool().as_str()),
        usage = usage(info.step_size),
        tables = tables(component),
        equations = equations(info.equations),
        build = build(component, binary),
        licence = licence(component),
    )
}

fn equations(fragment: &str) -> String {
    match fragment {
        "" => String::new(),
        _ => format!("<h2>Equations</h2>\n{fragment}\n"),
    }
}

fn usage(step_size: f64) -> String {
    format!(
        "<ul>\n<li>Set parameters before initialisation ends; they are frozen from then on. A value out of range is \
         refused with its range.</li>\n\
         <li>Inputs may be set at every communication point. Outputs change in a step only.</li>\n\
         <li>Any communication step greater than zero will do; {step_size} s is suggested.</li>\n\
         <li>A step that cannot be done is discarded: time and state are those before the step, and a shorter step may \
         be tried at once. The log says why.</li>\n\
         <li>State can be saved, restored, serialised and read by another process; a run that continues from it gives \
         the same bits.</li>\n\
         <li>The same parameters and inputs give the same bits, in any number of instances and threads.</li>\n\
         </ul>\n"
    )
}

fn build(component: &Component, binary: &[u8]) -> String {
    let date: String = component.date.iter().map(|date| format!(", {date}")).collect();
    let (tool, length, checksum) = (component.tool(), binary.len(), crc32fast::hash(binary));
    let (tool, path) = (escape(tool.as_str()), reference::path(component.info()));
    let command = component.replay_command.as_ref().map(|command| {
        format!(
            ": <code>{}</code> runs the library and compares",
            escape(command.as_str())
        )
    });
    format!(
        "<p>{tool}{date}. The library has {length} bytes, CRC-32 {checksum:08x}; it was built for {OS} on {ARCH}. \
         What it computes from its default parameters is in <code>{path}</code> of this FMU{}.</p>\n",
        command.unwrap_or_default()
    )
}

fn licence(component: &Component) -> String {
    match component.notices.license.as_str() {
        "" => String::new(),
        license => format!(
            "<h2>Licence</h2>\n<p>{}; the texts are in <code>licenses</code> beside this page.</p>\n",
            escape(license)
        ),
    }
}

fn tables(component: &Component) -> String {
    let (variables, spans) = (component.table().variables(), component.spans());
    let groups = [
        ("Parameters", Causality::Parameter),
        ("Inputs", Causality::Input),
        ("Calculated parameters", Causality::CalculatedParameter),
        ("Outputs", Causality::Output),
    ];
    let mut text = String::new();
    for (title, causality) in groups {
        let is_listed = |position: &usize| variables[*position].causality == causality && spans[*position] > 0;
        let group: Vec<usize> = (0..variables.len()).filter(is_listed).collect();
        if group.is_empty() {
            continue;
        }
        text.push_str(&format!(
            "<h3>{title}</h3>\n<table>\n<tr><th>Name</th><th>Unit</th><th>Range</th><th>Start</th>\
             <th>Value reference</th><th>Description</th></tr>\n"
        ));
        for position in group {
            let name = match component.is_array(position) {
                true => format!("{} ({} elements)", component.name_at(position), spans[position]),
                false => component.name_at(position).into(),
            };
            text.push_str(&table_row(&name, position, &variables[position]));
        }
        text.push_str("</table>\n");
    }
    text
}

fn table_row(name: &str, position: usize, variable: &Variable) -> String {
    let (unit, range, start) = match &variable.kind {
        Kind::Real(quantity) => {
            let range = match (quantity.min.is_finite(), quantity.max.is_finite()) {
                (true, true) => format!("{} to {}", Value::Real(quantity.min), Value::Real(quantity.max)),
                (true, false) => format!("from {}", Value::Real(quantity.min)),
                (false, true) => format!("to {}", Value::Real(quantity.max)),
                (false, false) => String::new(),
            };
            (quantity.unit.name, range, variable.start().to_string())
        }
        Kind::Integer { range, start } | Kind::Long { range, start } => {
            ("", format!("{} to {}", range.start(), range.end()), start.to_string())
        }
        Kind::Enumeration { options, start, .. } => {
            let line = |(number, (name, description)): (i64, &(&str, &str))| {
                format!("{number} {}: {}", escape(*name), escape(*description))
            };
            let lines: Vec<String> = (1..).zip(*options).map(line).collect();
            ("", lines.join("<br>"), start.to_string())
        }
    };
    format!(
        "<tr><td><code>{}</code></td><td>{}</td><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>\
         <td>{}</td></tr>\n",
        escape(name),
        escape(unit),
        range,
        if variable.causality.is_settable() {
            start
        } else {
            String::new()
        },
        value_reference(position),
        escape(variable.description.as_str()),
    )
}

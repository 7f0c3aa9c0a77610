//! Card and variable table in, the documentation page inside the FMU out.

use std::env::consts::{ARCH, OS};

use quick_xml::escape::escape;

use super::bundle::Component;
use super::life_cycle::Version;
use super::model_description::LICENSE;
use super::reference::PATH;
use super::{arrays, value_reference};
use crate::scene::{Card, Causality, Kind, Variable};

const STYLE: &str = "body { font-family: sans-serif; max-width: 60em; margin: 2em auto; line-height: 1.4 } \
                     table { border-collapse: collapse } \
                     th, td { border: 1px solid #bbb; padding: 0.2em 0.5em; text-align: left; vertical-align: top } \
                     th { background: #eee } td.number { text-align: right; white-space: nowrap } \
                     code { background: #f4f4f4 }";

/// The page: what it is, how to use it, its variables, its equations, its licence.
pub fn write(component: &Component, version: Version, binary: &[u8]) -> String {
    let Component { card, choice, .. } = component;
    let title = format!("{} ({})", card.scene, card.engine);
    let standard = match version {
        Version::Two => "FMI 2.0",
        Version::Three => "FMI 3.0",
    };
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{title}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n<p>{description}</p>\n\
         <p>Co-simulation FMU for {standard}, {disks} disks, drive: {drive}. Made by jostle {tool}.</p>\n\
         <h2>Use</h2>\n{usage}<h2>Variables</h2>\n{tables}<h2>Equations</h2>\n{equations}\n\
         <h2>Build</h2>\n{build}<h2>Licence</h2>\n<p>{LICENSE}; the texts are in <code>licenses</code> beside this page.</p>\n\
         </body>\n</html>\n",
        title = escape(title.as_str()),
        description = escape(card.description),
        disks = choice.disks,
        drive = escape(card.drive),
        tool = env!("CARGO_PKG_VERSION"),
        usage = usage(card),
        tables = tables(component),
        equations = card.equations,
        build = build(component, binary),
    )
}

fn build(component: &Component, binary: &[u8]) -> String {
    let date = component.date.iter().map(|date| format!(", {date}"));
    let date: String = date.collect();
    let (version, length, checksum) = (env!("CARGO_PKG_VERSION"), binary.len(), crc32fast::hash(binary));
    format!(
        "<p>jostle {version}{date}. The library has {length} bytes, CRC-32 {checksum:08x}; it was built for any {ARCH} \
         processor on {OS}. What it computes from its default parameters is in <code>{PATH}</code> of this FMU: \
         <code>jostle replay FILE.fmu</code> runs the library and compares.</p>\n"
    )
}

fn usage(card: &Card) -> String {
    format!(
        "<ul>\n<li>Set parameters before initialisation ends; they are frozen from then on. A value out of range is \
         refused with its range.</li>\n\
         <li>Inputs may be set at every communication point. Outputs change in a step only.</li>\n\
         <li>Any communication step greater than zero will do; {} s is suggested.</li>\n\
         <li>A step that cannot be done is discarded: time and state are those before the step, and a shorter step may \
         be tried at once. The log says why.</li>\n\
         <li>State can be saved, restored, serialised and read by another process; a run that goes on from it gives \
         the same bits.</li>\n\
         <li>The same parameters, inputs and seed give the same bits, in any number of instances and threads.</li>\n\
         </ul>\n",
        card.step_size
    )
}

fn tables(component: &Component) -> String {
    let rows = &component.rows;
    let spans = if component.arrays {
        arrays::spans(rows)
    } else {
        vec![1; rows.len()]
    };
    let groups = [
        ("Parameters", Causality::Parameter),
        ("Inputs", Causality::Input),
        ("Calculated parameters", Causality::CalculatedParameter),
        ("Outputs", Causality::Output),
    ];
    let mut text = String::new();
    for (title, causality) in groups {
        let group: Vec<_> = rows
            .iter()
            .enumerate()
            .filter(|(position, row)| row.causality == causality && spans[*position] > 0)
            .collect();
        if group.is_empty() {
            continue;
        }
        text.push_str(&format!(
            "<h3>{title}</h3>\n<table>\n<tr><th>Name</th><th>Unit</th><th>Range</th><th>Start</th>\
             <th>Value reference</th><th>Description</th></tr>\n"
        ));
        for (position, row) in group {
            let name = match component.arrays && arrays::begins(row) {
                true => format!("{} ({} elements)", arrays::name(&row.name), spans[position]),
                false => row.name.clone(),
            };
            text.push_str(&table_row(&name, position, row));
        }
        text.push_str("</table>\n");
    }
    text
}

fn table_row(name: &str, position: usize, row: &Variable) -> String {
    let given = matches!(row.causality, Causality::Parameter | Causality::Input);
    let (unit, range, start) = match &row.kind {
        Kind::Real(quantity) => {
            let range = match (quantity.min.is_finite(), quantity.max.is_finite()) {
                (true, true) => format!("{} to {}", quantity.min, quantity.max),
                (true, false) => format!("from {}", quantity.min),
                (false, true) => format!("to {}", quantity.max),
                (false, false) => String::new(),
            };
            (quantity.unit.name(), range, quantity.start.to_string())
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
        if given { start } else { String::new() },
        value_reference(position),
        escape(row.description.as_str()),
    )
}

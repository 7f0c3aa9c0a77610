//! The tables of variables and of symbols.

use fmi_component::{Causality, Kind, Symbol, Value, Variable, value_reference};
use quick_xml::escape::escape;

use super::diagram::{Group, groups};
use crate::component::Component;

/// The tables of all variables, one for each causality; the elements of an array share a row.
pub fn variables(component: &Component) -> String {
    let tables = [
        ("Parameters", "parameters", Causality::Parameter),
        ("Inputs", "inputs", Causality::Input),
        ("Calculated parameters", "calculated", Causality::CalculatedParameter),
        ("Outputs", "outputs", Causality::Output),
    ];
    let mut text = String::new();
    for (title, id, causality) in tables {
        let groups = groups(component, causality);
        if groups.is_empty() {
            continue;
        }
        let settable = causality.is_settable();
        // What nobody has said anything of is no column.
        let shown = Shown {
            settable,
            tunes: groups.iter().any(|group| group.variable.tunable),
            recommends: groups.iter().any(|group| group.variable.recommended.is_some()),
        };
        let columns = [
            ("Name", true),
            ("Unit", true),
            ("Start", settable),
            ("Description", true),
            ("Range", settable),
            ("Changes while running", shown.tunes),
            ("Recommended", shown.recommends),
            ("Value reference", true),
        ];
        let head: String = columns
            .iter()
            .filter(|(_, is_shown)| *is_shown)
            .map(|(name, _)| format!("<th>{name}</th>"))
            .collect();
        text.push_str(&format!(
            "<h3 id=\"{id}\">{title}</h3>\n<div class=\"wide\"><table>\n<tr>{head}</tr>\n"
        ));
        for group in &groups {
            text.push_str(&row(component, group, shown));
        }
        text.push_str("</table></div>\n");
    }
    text
}

/// Columns that not every table has.
#[derive(Clone, Copy)]
struct Shown {
    settable: bool,
    tunes: bool,
    recommends: bool,
}

fn row(component: &Component, group: &Group, shown: Shown) -> String {
    let Shown {
        settable,
        tunes,
        recommends,
    } = shown;
    let variable = group.variable;
    let mut cells = format!(
        "<td><code>{}</code></td><td>{}</td>",
        escape(group.name.as_str()),
        escape(group.unit())
    );
    if settable {
        let elements = &component.table().variables()[group.first..group.first + group.count];
        let starts: Vec<String> = elements.iter().map(start).collect();
        let same = starts.iter().all(|start| *start == starts[0]);
        let text = if same { starts[0].clone() } else { starts.join(" ") };
        cells.push_str(&format!("<td class=\"number\">{text}</td>"));
    }
    let description = group.description();
    cells.push_str(&format!("<td class=\"text\">{}</td>", escape(description.as_str())));
    if settable {
        cells.push_str(&format!("<td class=\"range\">{}</td>", range(variable)));
    }
    if tunes {
        let answer = if variable.tunable { "between steps" } else { "" };
        cells.push_str(&format!("<td>{answer}</td>"));
    }
    if recommends {
        let recommended = variable.recommended.as_ref();
        let text = recommended.map(|recommended| {
            let (range, reason) = (recommended.text(), recommended.reason);
            format!("{}<br/><small>{}</small>", escape(range.as_str()), escape(reason))
        });
        cells.push_str(&format!("<td class=\"text\">{}</td>", text.unwrap_or_default()));
    }
    // The elements of an array that is bundled as one have the reference of the first.
    let last = match component.arrays {
        true => group.first,
        false => group.first + group.count - 1,
    };
    let references = match last == group.first {
        true => value_reference(group.first).to_string(),
        false => format!("{} to {}", value_reference(group.first), value_reference(last)),
    };
    format!("<tr>{cells}<td class=\"number\">{references}</td></tr>\n")
}

/// Seven digits, for the eye: the exact value is in the model description.
fn short(value: Value) -> Value {
    match value {
        Value::Real(real) => Value::Real(format!("{real:.6e}").parse().unwrap_or(real)),
        whole => whole,
    }
}

/// The start value, for the eye.
fn start(variable: &Variable) -> String {
    match &variable.kind {
        Kind::Text { start } => escape(&**start).into_owned(),
        Kind::Boolean { start } => start.to_string(),
        Kind::Binary { start, .. } => format!("{} bytes", start.len()),
        _ => short(variable.start()).to_string(),
    }
}

/// What is allowed.
fn range(variable: &Variable) -> String {
    let real = |end: f64| short(Value::Real(end));
    match &variable.kind {
        Kind::Real(quantity) | Kind::Single(quantity) => match (quantity.min.is_finite(), quantity.max.is_finite()) {
            (true, true) => format!("{} to {}", real(quantity.min), real(quantity.max)),
            (true, false) => format!("from {}", real(quantity.min)),
            (false, true) => format!("to {}", real(quantity.max)),
            (false, false) => "any".into(),
        },
        Kind::Integer { range, .. } | Kind::Long { range, .. } | Kind::Sized { range, .. } => {
            format!("{} to {}", range.start(), range.end())
        }
        Kind::Enumeration { options, .. } => {
            let line = |(number, (name, description)): (i64, &(&str, &str))| {
                format!("{number} {}: {}", escape(*name), escape(*description))
            };
            let lines: Vec<String> = (1..).zip(*options).map(line).collect();
            lines.join("<br/>")
        }
        Kind::Boolean { .. } => "true or false".into(),
        Kind::Text { .. } => "any text".into(),
        Kind::Binary { mime_type, .. } => format!("bytes, <code>{}</code>; FMI 3.0 only", escape(&**mime_type)),
    }
}

/// The table of the symbols of the equations; nothing for a model that explains none.
pub fn symbols(component: &Component) -> String {
    let table = component.table();
    let row = |symbol: &Symbol| {
        let position = table.position(symbol.variable);
        if !symbol.variable.is_empty() && position.is_none() {
            return None;
        }
        let unit = position.map(|position| &table.variables()[position].kind);
        let unit = match unit {
            Some(Kind::Real(quantity) | Kind::Single(quantity)) => quantity.unit.name,
            _ => "",
        };
        let name = match symbol.variable {
            "" => String::new(),
            name => format!("<code>{}</code>", escape(name.trim_end_matches("[1]"))),
        };
        Some(format!(
            "<tr><td>{}</td><td>{name}</td><td>{}</td><td>{}</td></tr>\n",
            symbol.symbol,
            escape(unit),
            symbol.meaning
        ))
    };
    let rows: String = component.info().sheet.symbols.iter().filter_map(row).collect();
    match rows.as_str() {
        "" => String::new(),
        rows => format!(
            "<h3>Symbols</h3>\n<div class=\"wide\"><table>\n<tr><th>Symbol</th><th>Variable</th><th>Unit</th>\
             <th>Meaning</th></tr>\n{rows}</table></div>\n"
        ),
    }
}

//! `ModelVariables`: one element per row, or per array of rows.

use std::io;

use super::super::life_cycle::Version;
use super::super::xml::{self, Attributes, Xml, number};
use super::super::{TIME_REFERENCE, arrays, value_reference};
use super::types::{of_unit, quantity_name};
use super::{Sheet, index};
use crate::scene::{Causality, Kind, Unit, Variable};

/// All variables, the time first.
pub fn write(xml: &mut Xml, sheet: &Sheet<'_>) -> io::Result<()> {
    let about_time = vec![
        ("name", "time".into()),
        ("valueReference", TIME_REFERENCE.to_string()),
        ("description", "Simulated time.".into()),
        ("causality", "independent".into()),
        ("variability", "continuous".into()),
    ];
    let unit = typed(Unit::Second);
    element(xml, sheet.version, about_time, ("Real", "Float64"), unit, 0)?;
    sheet
        .positions()
        .try_for_each(|position| variable(xml, sheet, position))
}

fn variable(xml: &mut Xml, sheet: &Sheet<'_>, position: usize) -> io::Result<()> {
    let row = &sheet.rows[position];
    let array = sheet.arrays && arrays::begins(row);
    let (name, description) = if array {
        (arrays::name(&row.name), row.description.replace("disk 1", "each disk"))
    } else {
        (row.name.as_str(), row.description.clone())
    };
    let mut about = vec![
        ("name", name.into()),
        ("valueReference", value_reference(position).to_string()),
        ("description", description),
        ("causality", causality(row.causality).into()),
        ("variability", variability(row).into()),
    ];
    about.extend(initial(row.causality).map(|initial| ("initial", initial.into())));
    let kinds = match row.kind {
        Kind::Real(_) => ("Real", "Float64"),
        Kind::Integer { .. } => ("Integer", "Int32"),
        Kind::Long { .. } => ("Integer", "Int64"),
        Kind::Enumeration { .. } => ("Enumeration", "Enumeration"),
    };
    let mut list = details(row, sheet.version);
    if let Some(integral) = sheet.integral(position) {
        let target = match sheet.version {
            Version::Two => index(integral).1,
            Version::Three => value_reference(integral).to_string(),
        };
        list.push(("derivative", target));
    }
    element(
        xml,
        sheet.version,
        about,
        kinds,
        list,
        if array { sheet.spans[position] } else { 0 },
    )
}

/// FMI 2.0 splits what FMI 3.0 writes in one element. `dimension` is 0 for a scalar.
fn element(
    xml: &mut Xml,
    version: Version,
    mut about: Attributes,
    kinds: (&str, &str),
    details: Attributes,
    dimension: usize,
) -> io::Result<()> {
    match version {
        Version::Two => xml::element(xml, "ScalarVariable", &about, |xml| xml::empty(xml, kinds.0, &details)),
        Version::Three => {
            about.extend(details);
            match dimension {
                0 => xml::empty(xml, kinds.1, &about),
                _ => xml::element(xml, kinds.1, &about, |xml| {
                    xml::empty(xml, "Dimension", &vec![("start", dimension.to_string())])
                }),
            }
        }
    }
}

fn typed(unit: Unit) -> Attributes {
    let declared = quantity_name(unit).map(|name| ("declaredType", name.into()));
    declared.into_iter().chain(of_unit(unit)).collect()
}

fn causality(causality: Causality) -> &'static str {
    match causality {
        Causality::Parameter => "parameter",
        Causality::CalculatedParameter => "calculatedParameter",
        Causality::Input => "input",
        Causality::Output => "output",
    }
}

fn variability(row: &Variable) -> &'static str {
    match (row.causality, &row.kind) {
        (Causality::Parameter | Causality::CalculatedParameter, _) => "fixed",
        (_, Kind::Real(_)) => "continuous",
        _ => "discrete",
    }
}

/// Inputs must not state it: theirs is always exact.
fn initial(causality: Causality) -> Option<&'static str> {
    match causality {
        Causality::Parameter => Some("exact"),
        Causality::CalculatedParameter | Causality::Output => Some("calculated"),
        Causality::Input => None,
    }
}

fn details(row: &Variable, version: Version) -> Attributes {
    let mut list = Attributes::new();
    let given = matches!(row.causality, Causality::Parameter | Causality::Input);
    match &row.kind {
        Kind::Real(quantity) => {
            list.extend(typed(quantity.unit));
            let ends = [("min", quantity.min), ("max", quantity.max)];
            list.extend(
                ends.into_iter()
                    .filter(|(_, end)| end.is_finite())
                    .map(|(name, end)| (name, number(end))),
            );
            list.push(("nominal", number(quantity.nominal)));
            list.extend(given.then(|| ("start", number(quantity.start))));
        }
        Kind::Integer { range, start } | Kind::Long { range, start } => {
            let narrow = |end: i64| match version {
                Version::Two => end.clamp(i64::from(i32::MIN), i64::from(i32::MAX)),
                Version::Three => end,
            };
            list.push(("min", narrow(*range.start()).to_string()));
            list.push(("max", narrow(*range.end()).to_string()));
            list.extend(given.then(|| ("start", narrow(*start).to_string())));
        }
        Kind::Enumeration {
            type_name,
            options,
            start,
        } => {
            list.push(("declaredType", (*type_name).into()));
            list.push(("min", "1".into()));
            list.push(("max", options.len().to_string()));
            list.extend(given.then(|| ("start", start.to_string())));
        }
    }
    list
}

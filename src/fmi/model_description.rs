//! Variable table in, `modelDescription.xml` out, for both versions of the standard.
//!
//! Guarantees: the start values are those of a new instance, the capability flags say what is there and no more, and the
//! same input gives the same bytes (hence no date). Outputs depend on no input at the same instant: they change in a step
//! only, so that an importer need not look for algebraic loops. When initialisation ends they may depend on everything,
//! which the standards say by leaving the dependencies out.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::io;

use super::bundle::Component;
use super::life_cycle::Version;
use super::xml::{self, Attributes, Xml};
use super::{LOG_CATEGORIES, TIME_REFERENCE, token, value_reference};
use crate::scene::{Card, Causality, Kind, Unit, Variable};

/// SPDX expression of the licence, as the model description states it.
pub const LICENSE: &str = env!("CARGO_PKG_LICENSE");

/// The model description of a component.
pub fn write(component: &Component, version: Version) -> String {
    let Component { card, rows, .. } = component;
    xml::document(|xml| {
        xml::element(xml, "fmiModelDescription", &root(component, version), |xml| {
            xml::empty(xml, "CoSimulation", &capabilities(component, version))?;
            xml::element(xml, "UnitDefinitions", &vec![], |xml| units(xml, rows))?;
            type_definitions(xml, rows, version)?;
            xml::element(xml, "LogCategories", &vec![], |xml| {
                LOG_CATEGORIES.iter().try_for_each(|(name, description)| {
                    let attributes = vec![("name", (*name).into()), ("description", (*description).into())];
                    xml::empty(xml, "Category", &attributes)
                })
            })?;
            xml::empty(xml, "DefaultExperiment", &experiment(card))?;
            xml::element(xml, "ModelVariables", &vec![], |xml| variables(xml, rows, version))?;
            xml::element(xml, "ModelStructure", &vec![], |xml| match version {
                Version::Two => structure_2(xml, rows),
                Version::Three => structure_3(xml, rows),
            })
        })
    })
}

fn root(component: &Component, version: Version) -> Attributes {
    let Component { card, choice, rows, .. } = component;
    let (number, token_name) = match version {
        Version::Two => ("2.0", "guid"),
        Version::Three => ("3.0", "instantiationToken"),
    };
    vec![
        ("fmiVersion", number.into()),
        ("modelName", format!("{} {}", card.scene, card.engine)),
        (token_name, token::write(card, *choice, rows)),
        ("description", card.description.into()),
        ("version", env!("CARGO_PKG_VERSION").into()),
        ("license", LICENSE.into()),
        ("generationTool", concat!("jostle ", env!("CARGO_PKG_VERSION")).into()),
        ("variableNamingConvention", "structured".into()),
    ]
}

/// Every flag is written, those that are the default too, so that a reader need not know the defaults.
fn capabilities(component: &Component, version: Version) -> Attributes {
    let events = if component.events { "true" } else { "false" };
    let flags: &[(&'static str, &str)] = match version {
        Version::Two => &[
            ("needsExecutionTool", "false"),
            ("canHandleVariableCommunicationStepSize", "true"),
            ("canInterpolateInputs", "false"),
            ("maxOutputDerivativeOrder", "0"),
            ("canRunAsynchronuously", "false"),
            ("canBeInstantiatedOnlyOncePerProcess", "false"),
            ("canNotUseMemoryManagementFunctions", "true"),
            ("canGetAndSetFMUstate", "true"),
            ("canSerializeFMUstate", "true"),
            ("providesDirectionalDerivative", "false"),
        ],
        Version::Three => &[
            ("needsExecutionTool", "false"),
            ("canBeInstantiatedOnlyOncePerProcess", "false"),
            ("canGetAndSetFMUState", "true"),
            ("canSerializeFMUState", "true"),
            ("providesDirectionalDerivatives", "false"),
            ("providesAdjointDerivatives", "false"),
            ("providesPerElementDependencies", "false"),
            ("canHandleVariableCommunicationStepSize", "true"),
            ("maxOutputDerivativeOrder", "0"),
            ("providesIntermediateUpdate", "false"),
            ("mightReturnEarlyFromDoStep", events),
            ("canReturnEarlyAfterIntermediateUpdate", "false"),
            ("hasEventMode", events),
            ("providesEvaluateDiscreteStates", "false"),
        ],
    };
    let mut attributes = vec![("modelIdentifier", component.card.identifier.into())];
    attributes.extend(flags.iter().map(|(name, value)| (*name, (*value).into())));
    attributes
}

fn experiment(card: &Card) -> Attributes {
    vec![
        ("startTime", number(0.0)),
        ("stopTime", number(card.stop_time)),
        ("stepSize", number(card.step_size)),
    ]
}

fn units(xml: &mut Xml, rows: &[Variable]) -> io::Result<()> {
    let used = rows.iter().filter_map(|row| match &row.kind {
        Kind::Real(quantity) => Some(quantity.unit),
        _ => None,
    });
    let used: BTreeSet<_> = used.chain([Unit::Second]).collect();
    used.into_iter().try_for_each(|unit| {
        xml::element(xml, "Unit", &vec![("name", unit.name().into())], |xml| {
            let (kilogram, metre, second, radian) = unit.exponents();
            let exponents = [("kg", kilogram), ("m", metre), ("s", second), ("rad", radian)];
            let exponents = exponents.into_iter().filter(|(_, exponent)| *exponent != 0);
            let exponents = exponents.map(|(name, exponent)| (name, exponent.to_string())).collect();
            xml::empty(xml, "BaseUnit", &exponents)?;
            display_unit(unit).map_or(Ok(()), |(name, factor)| {
                xml::empty(
                    xml,
                    "DisplayUnit",
                    &vec![("name", name.into()), ("factor", number(factor))],
                )
            })
        })
    })
}

/// The enumerations in use; the element must not be empty.
fn type_definitions(xml: &mut Xml, rows: &[Variable], version: Version) -> io::Result<()> {
    let used: BTreeMap<_, _> = rows
        .iter()
        .filter_map(|row| match row.kind {
            Kind::Enumeration { type_name, options, .. } => Some((type_name, options)),
            _ => None,
        })
        .collect();
    if used.is_empty() {
        return Ok(());
    }
    xml::element(xml, "TypeDefinitions", &vec![], |xml| {
        used.into_iter().try_for_each(|(name, options)| {
            let name = vec![("name", name.into())];
            match version {
                Version::Two => xml::element(xml, "SimpleType", &name, |xml| {
                    xml::element(xml, "Enumeration", &vec![], |xml| items(xml, options))
                }),
                Version::Three => xml::element(xml, "EnumerationType", &name, |xml| items(xml, options)),
            }
        })
    })
}

fn items(xml: &mut Xml, options: &[(&str, &str)]) -> io::Result<()> {
    (1..)
        .zip(options)
        .try_for_each(|(value, (name, description)): (i64, _)| {
            let attributes = vec![
                ("name", (*name).into()),
                ("value", value.to_string()),
                ("description", (*description).into()),
            ];
            xml::empty(xml, "Item", &attributes)
        })
}

/// Where people think in another unit: its name and the factor from the SI unit.
fn display_unit(unit: Unit) -> Option<(&'static str, f64)> {
    match unit {
        Unit::Radian => Some(("deg", 180.0 / PI)),
        Unit::RadianPerSecond => Some(("rpm", 30.0 / PI)),
        _ => None,
    }
}

/// Physical quantity, for importers that check connections.
fn quantity_name(unit: Unit) -> Option<&'static str> {
    Some(match unit {
        Unit::Metre => "Length",
        Unit::MetrePerSecond => "Velocity",
        Unit::MetrePerSecondSquared => "Acceleration",
        Unit::Radian => "Angle",
        Unit::RadianPerSecond => "AngularVelocity",
        Unit::Second => "Time",
        Unit::Hertz => "Frequency",
        Unit::Kilogram => "Mass",
        Unit::Newton => "Force",
        Unit::NewtonSecond => "Impulse",
        Unit::Joule => "Energy",
        Unit::NewtonMetre => "Torque",
        _ => return None,
    })
}

fn variables(xml: &mut Xml, rows: &[Variable], version: Version) -> io::Result<()> {
    let time = vec![("unit", Unit::Second.name().into()), ("quantity", "Time".into())];
    let about_time = vec![
        ("name", "time".into()),
        ("valueReference", TIME_REFERENCE.to_string()),
        ("description", "Simulated time.".into()),
        ("causality", "independent".into()),
        ("variability", "continuous".into()),
    ];
    variable(xml, version, about_time, ("Real", "Float64"), time)?;
    for (position, row) in rows.iter().enumerate() {
        let mut about = vec![
            ("name", row.name.clone()),
            ("valueReference", value_reference(position).to_string()),
            ("description", row.description.clone()),
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
        variable(xml, version, about, kinds, details(row, version))?;
    }
    Ok(())
}

/// FMI 2.0 splits what FMI 3.0 writes in one element.
fn variable(
    xml: &mut Xml,
    version: Version,
    mut about: Attributes,
    kinds: (&str, &str),
    details: Attributes,
) -> io::Result<()> {
    match version {
        Version::Two => xml::element(xml, "ScalarVariable", &about, |xml| xml::empty(xml, kinds.0, &details)),
        Version::Three => {
            about.extend(details);
            xml::empty(xml, kinds.1, &about)
        }
    }
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
            list.extend(quantity_name(quantity.unit).map(|name| ("quantity", name.into())));
            list.push(("unit", quantity.unit.name().into()));
            list.extend(display_unit(quantity.unit).map(|(name, _)| ("displayUnit", name.into())));
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

/// Positions of the rows that `wanted` accepts.
fn positions(rows: &[Variable], wanted: impl Fn(Causality) -> bool) -> impl Iterator<Item = usize> {
    rows.iter()
        .enumerate()
        .filter(move |(_, row)| wanted(row.causality))
        .map(|(position, _)| position)
}

fn is_output(causality: Causality) -> bool {
    causality == Causality::Output
}

fn is_computed(causality: Causality) -> bool {
    matches!(causality, Causality::Output | Causality::CalculatedParameter)
}

fn structure_2(xml: &mut Xml, rows: &[Variable]) -> io::Result<()> {
    // Counted from 1, and the time comes first.
    let index = |position: usize| ("index", (position + 2).to_string());
    xml::element(xml, "Outputs", &vec![], |xml| {
        positions(rows, is_output).try_for_each(|position| {
            xml::empty(xml, "Unknown", &vec![index(position), ("dependencies", String::new())])
        })
    })?;
    xml::element(xml, "InitialUnknowns", &vec![], |xml| {
        positions(rows, is_computed).try_for_each(|position| xml::empty(xml, "Unknown", &vec![index(position)]))
    })
}

fn structure_3(xml: &mut Xml, rows: &[Variable]) -> io::Result<()> {
    let reference = |position: usize| ("valueReference", value_reference(position).to_string());
    positions(rows, is_output).try_for_each(|position| {
        xml::empty(
            xml,
            "Output",
            &vec![reference(position), ("dependencies", String::new())],
        )
    })?;
    positions(rows, is_computed).try_for_each(|position| xml::empty(xml, "InitialUnknown", &vec![reference(position)]))
}

/// Shortest text that reads back as the same bits.
fn number(value: f64) -> String {
    format!("{value:?}")
}

//! Variable table in, `modelDescription.xml` out, for both versions of the standard.
//!
//! Guarantees: the start values are those of a new instance, the capability flags say what is there and no more, and the
//! same input gives the same bytes (the date is part of the input). Outputs depend on no input at the same instant: they
//! change in a step only, so that an importer need not look for algebraic loops. While the component is initialised they
//! depend on the parameters and inputs that the scene names, and on no others; a scene that names none leaves the list out,
//! which the standards read as all.

mod types;
mod variables;

use std::io;

use super::bundle::{Component, MIT};
use super::life_cycle::Version;
use super::xml::{self, Attributes, Xml, number};
use super::{LOG_CATEGORIES, TIME_REFERENCE, TOLERANCE, arrays, derivatives, value_reference};
use crate::scene::{Card, Causality, Kind, TIME, Table, Variable};

/// SPDX expression of the licence, as the model description states it.
pub const LICENSE: &str = env!("CARGO_PKG_LICENSE");

/// The model description of a component.
pub fn write(component: &Component, version: Version) -> String {
    let sheet = Sheet::new(component, version);
    let Component { card, rows, .. } = component;
    xml::document(|xml| {
        xml::element(xml, "fmiModelDescription", &root(component, version), |xml| {
            xml::empty(xml, "CoSimulation", &capabilities(&sheet, component))?;
            xml::element(xml, "UnitDefinitions", &vec![], |xml| types::units(xml, rows))?;
            xml::element(xml, "TypeDefinitions", &vec![], |xml| {
                types::type_definitions(xml, rows, version)
            })?;
            xml::element(xml, "LogCategories", &vec![], |xml| {
                LOG_CATEGORIES.iter().try_for_each(|(name, description)| {
                    let attributes = vec![("name", (*name).into()), ("description", (*description).into())];
                    xml::empty(xml, "Category", &attributes)
                })
            })?;
            xml::empty(xml, "DefaultExperiment", &experiment(card, rows))?;
            xml::element(xml, "ModelVariables", &vec![], |xml| variables::write(xml, &sheet))?;
            xml::element(xml, "ModelStructure", &vec![], |xml| match version {
                Version::Two => structure_2(xml, &sheet, component),
                Version::Three => structure_3(xml, &sheet, component),
            })
        })
    })
}

fn root(component: &Component, version: Version) -> Attributes {
    let (number, token_name) = match version {
        Version::Two => ("2.0", "guid"),
        Version::Three => ("3.0", "instantiationToken"),
    };
    let card = &component.card;
    let mut attributes = vec![
        ("fmiVersion", number.into()),
        ("modelName", format!("{} {}", card.scene, card.engine)),
        (token_name, component.token()),
        ("description", card.description.into()),
        ("version", env!("CARGO_PKG_VERSION").into()),
        ("copyright", copyright().into()),
        ("license", LICENSE.into()),
        ("generationTool", concat!("jostle ", env!("CARGO_PKG_VERSION")).into()),
    ];
    let date = component.date.iter();
    attributes.extend(date.map(|date| ("generationDateAndTime", date.clone())));
    attributes.push(("variableNamingConvention", "structured".into()));
    attributes
}

/// The line of the licence that says whose work it is.
fn copyright() -> &'static str {
    let mut lines = MIT.lines();
    lines.find(|line| line.starts_with("Copyright")).unwrap_or_default()
}

/// Every flag is written, those that are the default too, so that a reader need not know the defaults.
fn capabilities(sheet: &Sheet<'_>, component: &Component) -> Attributes {
    let offered = |causality| derivatives::any(&sheet.table, causality);
    let order = if offered(Causality::Output) { "1" } else { "0" };
    let interpolates = if offered(Causality::Input) { "true" } else { "false" };
    let events = if component.events { "true" } else { "false" };
    let flags: &[(&'static str, &str)] = match sheet.version {
        Version::Two => &[
            ("needsExecutionTool", "false"),
            ("canHandleVariableCommunicationStepSize", "true"),
            ("canInterpolateInputs", interpolates),
            ("maxOutputDerivativeOrder", order),
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
            ("maxOutputDerivativeOrder", order),
            ("providesIntermediateUpdate", events),
            ("mightReturnEarlyFromDoStep", events),
            ("canReturnEarlyAfterIntermediateUpdate", events),
            ("hasEventMode", events),
            ("providesEvaluateDiscreteStates", "false"),
        ],
    };
    let mut attributes = vec![("modelIdentifier", component.card.identifier.into())];
    attributes.extend(flags.iter().map(|(name, value)| (*name, (*value).into())));
    attributes
}

/// The tolerance is there where a scene has a parameter of that name, since an importer's tolerance goes to it.
fn experiment(card: &Card, rows: &[Variable]) -> Attributes {
    let tolerance = rows.iter().find_map(|row| match &row.kind {
        Kind::Real(quantity) if row.name == TOLERANCE => Some(("tolerance", number(quantity.start))),
        _ => None,
    });
    let times = [
        ("startTime", number(0.0)),
        ("stopTime", number(card.stop_time)),
        ("stepSize", number(card.step_size)),
    ];
    times.into_iter().chain(tolerance).collect()
}

/// What the parts of the description have in common.
struct Sheet<'a> {
    version: Version,
    rows: &'a [Variable],
    table: Table,
    arrays: bool,
    /// Elements of the variable at each position; 0 inside an array.
    spans: Vec<usize>,
    /// For each position the row of which it is the derivative.
    integrals: Vec<Option<usize>>,
}

impl<'a> Sheet<'a> {
    fn new(component: &'a Component, version: Version) -> Self {
        let rows = &component.rows;
        let table = Table::new(rows.clone());
        let spans = match component.arrays {
            true => arrays::spans(rows),
            false => vec![1; rows.len()],
        };
        let mut integrals = vec![None; rows.len()];
        for position in (0..rows.len()).filter(|position| rows[*position].causality == Causality::Output) {
            if let Some(derivative) = derivatives::of(&table, position) {
                integrals[derivative] = Some(position);
            }
        }
        Self {
            version,
            rows,
            table,
            arrays: component.arrays,
            spans,
            integrals,
        }
    }

    /// Positions at which a variable begins.
    fn positions(&self) -> impl Iterator<Item = usize> {
        (0..self.rows.len()).filter(|position| self.spans[*position] > 0)
    }

    /// Positions of the variables that `wanted` accepts.
    fn chosen(&self, wanted: impl Fn(Causality) -> bool) -> impl Iterator<Item = usize> {
        self.positions()
            .filter(move |position| wanted(self.rows[*position].causality))
    }

    fn integral(&self, position: usize) -> Option<usize> {
        self.integrals[position]
    }
}

fn is_output(causality: Causality) -> bool {
    causality == Causality::Output
}

fn is_computed(causality: Causality) -> bool {
    matches!(causality, Causality::Output | Causality::CalculatedParameter)
}

/// Index of a row in FMI 2.0: counted from 1, and the time comes first.
fn index(position: usize) -> (&'static str, String) {
    ("index", (position + 2).to_string())
}

/// The attribute `dependencies` of the row at `position` during initialisation, in the order that FMI 2.0 asks for; none
/// where the scene does not say. `known` is what a row is called by; the time is called `time`.
fn initial_dependencies(
    sheet: &Sheet<'_>,
    component: &Component,
    position: usize,
    known: impl Fn(usize) -> String,
    time: String,
) -> Attributes {
    let Some(names) = (component.initial_dependencies)(&sheet.rows[position].name) else {
        return Attributes::new();
    };
    let of_time = names.contains(&TIME).then_some(time);
    let mut positions: Vec<usize> = names.iter().filter_map(|name| sheet.table.position(name)).collect();
    positions.sort_unstable();
    positions.dedup();
    let all: Vec<String> = of_time.into_iter().chain(positions.into_iter().map(known)).collect();
    vec![("dependencies", all.join(" "))]
}

fn structure_2(xml: &mut Xml, sheet: &Sheet<'_>, component: &Component) -> io::Result<()> {
    xml::element(xml, "Outputs", &vec![], |xml| {
        sheet.chosen(is_output).try_for_each(|position| {
            xml::empty(xml, "Unknown", &vec![index(position), ("dependencies", String::new())])
        })
    })?;
    xml::element(xml, "InitialUnknowns", &vec![], |xml| {
        sheet.chosen(is_computed).try_for_each(|position| {
            let known = |position| index(position).1;
            let of = initial_dependencies(sheet, component, position, known, "1".into());
            xml::empty(xml, "Unknown", &[vec![index(position)], of].concat())
        })
    })
}

fn structure_3(xml: &mut Xml, sheet: &Sheet<'_>, component: &Component) -> io::Result<()> {
    let reference = |position: usize| ("valueReference", value_reference(position).to_string());
    sheet.chosen(is_output).try_for_each(|position| {
        xml::empty(
            xml,
            "Output",
            &vec![reference(position), ("dependencies", String::new())],
        )
    })?;
    sheet.chosen(is_computed).try_for_each(|position| {
        let known = |position| reference(position).1;
        let of = initial_dependencies(sheet, component, position, known, TIME_REFERENCE.to_string());
        xml::empty(xml, "InitialUnknown", &[vec![reference(position)], of].concat())
    })
}

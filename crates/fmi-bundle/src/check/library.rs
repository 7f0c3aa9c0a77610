//! A model description against the library beside it: token, variables, start values.

use std::sync::Arc;

use fmi_component::{Error, Kind, Result, Value, value_reference};
use roxmltree::Document;

use super::description::{Described, DescribedVariable};
use super::findings::CheckReport;
use super::grammar::real;
use crate::component::Component;
use crate::importer::{Instance, Library};
use crate::model_description;

const ONE_BUILD: &str = "Write the FMU anew with this library.";

/// The component of the library `bytes`, for the structural parameters in the token of the FMU.
///
/// # Errors
/// The library does not load, or tells no model.
pub fn component(described: &Described, bytes: &[u8]) -> Result<Component> {
    let library = Arc::new(Library::load(bytes)?);
    let model = library.describe("")?;
    let parts = described.token.split(':').filter_map(|part| part.split_once('='));
    let known = parts.filter(|(name, _)| model.info.structure.iter().any(|parameter| parameter.name == *name));
    let structure: Vec<_> = known
        .filter_map(|(name, number)| Some((name, number.parse().ok()?)))
        .collect();
    let mut component = Component::of_library(library, &structure)?;
    component.arrays = described.token.contains(":arrays:");
    Ok(component)
}

/// Checks that the FMU is one of `component`; whether its library takes the token.
pub fn check_model(described: &Described, place: &str, component: &Component, report: &mut CheckReport) -> bool {
    let (token, info) = (component.token(), component.info());
    if described.token != token {
        let what = format!(
            "it is the library of {} {} with the token {token:?}; modelDescription.xml has {:?}",
            info.name, info.version, described.token
        );
        report.fault(
            place,
            what,
            "Put the library of this model there, or write the FMU anew.",
        );
        return false;
    }
    if described.identifier != info.identifier {
        report.fault(
            place,
            format!(
                "its modelIdentifier is {}, that of modelDescription.xml is {}",
                info.identifier, described.identifier
            ),
            ONE_BUILD,
        );
    }
    let text = model_description::write(component, described.version);
    match Document::parse(&text) {
        Ok(document) => compare(described, &Described::read(&document), report),
        Err(error) => report.fault(place, error.to_string(), ONE_BUILD),
    }
    true
}

/// Variables that one of both lacks, and facts that differ. Start values are asked for at an instance.
fn compare(described: &Described, expected: &Described, report: &mut CheckReport) {
    for variable in &expected.variables {
        if !described.variables.iter().any(|other| other.name() == variable.name()) {
            report.fault(
                super::description::PATH,
                format!("it lacks the variable {:?} of its library", variable.name()),
                ONE_BUILD,
            );
        }
    }
    for (what, ours, theirs) in [
        ("unit", &described.units, &expected.units),
        ("type", &described.types, &expected.types),
    ] {
        for declared in ours {
            let twin = theirs.iter().find(|other| other.name == declared.name);
            if let Some(twin) = twin.filter(|twin| twin.facts != declared.facts) {
                let (name, facts) = (&declared.name, [&declared.facts, &twin.facts]);
                let what = format!(
                    "{what} {name} is declared as {:?}, in its library as {:?}",
                    facts[0], facts[1]
                );
                report.fault(&declared.place, what, ONE_BUILD);
            }
        }
    }
    for variable in &described.variables {
        let name = variable.name();
        let Some(expected) = expected.variables.iter().find(|other| other.name() == name) else {
            report.fault(
                &variable.place,
                format!("its library has no variable {name:?}"),
                ONE_BUILD,
            );
            continue;
        };
        let keys = [
            "valueReference",
            "causality",
            "variability",
            "initial",
            "unit",
            "declaredType",
            "min",
            "max",
            "derivative",
        ];
        let facts = keys.iter().map(|key| (*key, text(variable, key), text(expected, key)));
        let others = [
            ("type", variable.element.clone(), expected.element.clone()),
            (
                "dimensions",
                variable.dimensions.join(" "),
                expected.dimensions.join(" "),
            ),
        ];
        for (key, ours, theirs) in facts.chain(others).filter(|(_, ours, theirs)| !alike(ours, theirs)) {
            let shown = |text: String| if text.is_empty() { "nothing".into() } else { text };
            report.fault(
                &variable.place,
                format!(
                    "{key} of {name} is {}, in its library it is {}",
                    shown(ours),
                    shown(theirs)
                ),
                ONE_BUILD,
            );
        }
    }
}

fn text(variable: &DescribedVariable, key: &str) -> String {
    match key {
        "causality" => variable.causality().into(),
        "variability" => variable.variability().into(),
        "initial" => variable.initial().unwrap_or_default().into(),
        key => variable.get(key).unwrap_or_default().into(),
    }
}

/// Equal as texts or as numbers.
fn alike(ours: &str, theirs: &str) -> bool {
    ours == theirs
        || real(ours)
            .zip(real(theirs))
            .is_some_and(|(ours, theirs)| ours == theirs)
}

/// Compares the start values with those of a new instance; how many there were.
///
/// # Errors
/// The library makes no instance, or does not read a variable.
pub fn check_starts(described: &Described, component: &Component, report: &mut CheckReport) -> Result<usize> {
    let mut instance = component.instance(component.arrays)?;
    instance.enter_initialization(0.0)?;
    let (variables, spans) = (component.table().variables(), component.spans());
    let mut count = 0;
    for described in &described.variables {
        let Some(start) = &described.start else { continue };
        let position = described
            .reference()
            .and_then(|reference| (reference as usize).checked_sub(value_reference(0) as usize));
        let Some(position) = position.filter(|position| *position < variables.len()) else {
            continue;
        };
        let kind = &variables[position].kind;
        let held = held(&mut instance, kind, value_reference(position), spans[position].max(1));
        let held = held.map_err(|error| with_name(described.name(), error))?;
        count += 1;
        if !is_start(start, kind, &held) {
            let what = format!(
                "start = {start:?} of {} is not that of its library, {held:?}",
                described.name()
            );
            report.fault(
                &described.place,
                what,
                "Write the start value of the library, or write the FMU anew.",
            );
        }
    }
    Ok(count)
}

fn with_name(name: &str, error: Error) -> Error {
    match error {
        Error::Call { what, remedy } => Error::call(format!("{name}: {what}"), remedy),
        other => other,
    }
}

/// The value of a new instance as the XML would have it.
fn held(instance: &mut Instance, kind: &Kind, reference: u32, span: usize) -> Result<String> {
    match kind {
        Kind::Text { .. } => instance.text(reference),
        Kind::Binary { .. } => Ok(instance
            .bytes(reference)?
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect()),
        kind => {
            let values = instance.values(kind, reference, span)?;
            let texts = values.into_iter().map(|value| match (kind, value) {
                (Kind::Boolean { .. }, Value::Integer(value)) => (value != 0).to_string(),
                (_, Value::Real(real)) => format!("{real:?}"),
                (_, Value::Integer(integer)) => integer.to_string(),
            });
            Ok(texts.collect::<Vec<_>>().join(" "))
        }
    }
}

fn is_start(stated: &str, kind: &Kind, held: &str) -> bool {
    let boolean = |word: &str| match word {
        "1" => "true".to_string(),
        "0" => "false".to_string(),
        word => word.to_string(),
    };
    let single = |word: &str| real(word).map(|number| f64::from(number as f32));
    match kind {
        Kind::Text { .. } => stated == held,
        Kind::Binary { .. } => stated.eq_ignore_ascii_case(held),
        _ => {
            let (stated, held): (Vec<_>, Vec<_>) =
                (stated.split_whitespace().collect(), held.split_whitespace().collect());
            let same = |(one, other): (&&str, &&str)| match kind {
                Kind::Boolean { .. } => boolean(one) == boolean(other),
                Kind::Single(_) => single(one) == single(other),
                Kind::Real(_) => alike(one, other),
                // FMI 2.0 narrows whole numbers to 32 bits.
                _ => {
                    one == other
                        || other
                            .parse::<i64>()
                            .is_ok_and(|other| other.clamp(i32::MIN.into(), i32::MAX.into()).to_string() == **one)
                }
            };
            stated.len() == held.len() && stated.iter().zip(&held).all(same)
        }
    }
}

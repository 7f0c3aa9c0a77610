//! Every limit that a model description states: set alone, it works, or the refusal names what was set.

#![allow(clippy::unwrap_used)]

use fmi_component::{Error, Kind, Value};
use jostle::scene::catalogue::MODELS;
use jostle::scene::{ModelType, StructuralParameters, Variable};

/// Few, so that it is quick.
const DISKS: u32 = 3;

/// The smallest and the largest value that a variable takes.
fn limits(variable: &Variable) -> Vec<Value> {
    match &variable.kind {
        Kind::Real(quantity) => [quantity.min, quantity.max]
            .into_iter()
            .filter(|limit| limit.is_finite())
            .map(Value::Real)
            .collect(),
        Kind::Integer { range, .. } | Kind::Long { range, .. } => {
            vec![Value::Integer(*range.start()), Value::Integer(*range.end())]
        }
        Kind::Enumeration { options, .. } => (1..=options.len() as i64).map(Value::Integer).collect(),
        other => panic!("no scene has a variable of this kind: {other:?}"),
    }
}

/// What is wrong with one limit, if anything.
fn fault(model: &ModelType, position: usize, limit: Value) -> Option<String> {
    let info = (model.info)();
    let most = *info.structure[0].range.end();
    let structure = StructuralParameters::choose(&info, &[("disks", DISKS.min(most))]).unwrap();
    let mut simulation = (model.prepare)(structure);
    let variable = simulation.values().table().variables()[position].clone();
    let said = |what: &str, error: &Error| {
        let name = &variable.name;
        format!("{}: {name} = {limit} {what}: {error}", info.identifier)
    };
    if let Err(error) = simulation.set_at(position, limit) {
        return Some(said("is not taken", &error));
    }
    match simulation.start(0.0) {
        Ok(()) => None,
        Err(error) if error.to_string().contains(&variable.name) => None,
        Err(error) => Some(said("is refused with the blame elsewhere", &error)),
    }
}

#[test]
fn every_limit_works_alone_or_the_refusal_names_it() {
    let mut faults = Vec::new();
    for model in MODELS {
        let structure = StructuralParameters::defaults(&(model.info)());
        for (position, variable) in (model.variables)(&structure).iter().enumerate() {
            if variable.causality.is_settable() {
                let found = limits(variable)
                    .into_iter()
                    .filter_map(|limit| fault(model, position, limit));
                faults.extend(found);
            }
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

//! The model descriptions under `modelDescription/` are what the scenes generate, with three disks where a scene may have them.
//!
//! Regression test: it shows each change of an interface in the diff. To accept one:
//! `UPDATE_MODEL_DESCRIPTIONS=1 cargo test --test model_description`, and a line in the change log.

#![allow(clippy::unwrap_used)]

use std::path::Path;

use fmi_bundle::{Icon, Version, model_description};
use jostle::scene::catalogue::MODELS;

#[path = "support/fmus.rs"]
mod fmus;

#[test]
fn committed_model_descriptions_are_those_that_the_scenes_generate() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("modelDescription");
    let mut expected = Vec::new();
    for model in MODELS {
        let component = fmus::component(model, 3);
        for (version, suffix) in [(Version::Two, "fmi2"), (Version::Three, "fmi3")] {
            let name = format!("{}.{suffix}.xml", component.info().identifier);
            let generated = model_description::write(&component, version);
            if std::env::var_os("UPDATE_MODEL_DESCRIPTIONS").is_some() {
                std::fs::write(folder.join(&name), &generated).unwrap();
            }
            let kept = std::fs::read_to_string(folder.join(&name)).unwrap_or_default();
            assert!(
                kept == generated,
                "modelDescription/{name} is not what the scene generates; see the head of this test"
            );
            expected.push(name);
        }
    }
    for file in std::fs::read_dir(&folder).unwrap() {
        let name = file.unwrap().file_name().into_string().unwrap();
        assert!(expected.contains(&name), "modelDescription/{name} belongs to no scene");
    }
}

/// The papers take different values: whoever compares two scenes must be told.
#[test]
fn start_values_of_gravity_are_those_that_its_description_states() {
    for model in MODELS {
        let component = fmus::component(model, 3);
        let table = component.table();
        let gravity = &table.variables()[table.position("gravity").unwrap()];
        let (scene, start) = (component.info().name, gravity.start().to_string());
        let mut parts = gravity.description.split([',', ';']);
        let part = parts.find(|part| part.contains(scene)).unwrap();
        assert!(part.split_whitespace().any(|word| word == start), "{scene}: {start}");
    }
}

/// Values of an attribute in a part of an XML file.
fn values<'a>(part: &'a str, attribute: &str) -> Vec<&'a str> {
    let begin = format!(" {attribute}=\"");
    let places = part.split(&begin).skip(1);
    places.map(|place| place.split('"').next().unwrap()).collect()
}

/// The element called `name` of an XML file; empty where there is none.
fn element<'a>(text: &'a str, name: &str) -> &'a str {
    let (begin, end) = (text.find(&format!("<{name}>")), text.find(&format!("</{name}>")));
    begin.zip(end).map_or("", |(begin, end)| &text[begin..end])
}

/// What a model description mentions and does not have: units, types, and variables by reference or index.
fn missing(description: &str, version: Version) -> Vec<String> {
    let variables = element(description, "ModelVariables");
    let structure = element(description, "ModelStructure");
    let known: Vec<String> = match version {
        Version::Two => (1..=variables.matches("<ScalarVariable").count())
            .map(|index| index.to_string())
            .collect(),
        Version::Three => values(variables, "valueReference")
            .into_iter()
            .map(String::from)
            .collect(),
    };
    let index = match version {
        Version::Two => "index",
        Version::Three => "valueReference",
    };
    let (units, types) = (
        element(description, "UnitDefinitions"),
        element(description, "TypeDefinitions"),
    );
    assert!(!known.is_empty() && !structure.is_empty() && !units.is_empty() && !types.is_empty());
    let mut missing = Vec::new();
    let mut check = |what: &str, mentioned: Vec<&str>, there: &dyn Fn(&str) -> bool| {
        let absent = mentioned.into_iter().filter(|name| !there(name));
        missing.extend(absent.map(|name| format!("{what} {name}")));
    };
    let is_known = |name: &str| known.iter().any(|other| other == name);
    check("unit", values(variables, "unit"), &|name| {
        values(units, "name").contains(&name)
    });
    check("unit", values(types, "unit"), &|name| {
        values(units, "name").contains(&name)
    });
    check("type", values(variables, "declaredType"), &|name| {
        values(types, "name").contains(&name)
    });
    check("derivative", values(variables, "derivative"), &is_known);
    check("variable", values(structure, index), &is_known);
    let dependencies = values(structure, "dependencies").into_iter();
    check(
        "dependency",
        dependencies.flat_map(str::split_whitespace).collect(),
        &is_known,
    );
    missing
}

/// Every name and reference in every XML file of every FMU is of something that this FMU has, with any option.
#[test]
fn xml_files_mention_nothing_that_is_not_there() {
    let mut faults = Vec::new();
    for model in MODELS {
        for (disks, arrays) in [(1, false), (1, true), (2, true), (3, false), (3, true)] {
            let mut component = fmus::component(model, disks);
            component.arrays = arrays;
            component.icon = Some(Icon {
                png: b"PNG".to_vec(),
                svg: None,
            });
            let mut fault = |what: String| {
                faults.push(format!(
                    "{}, {disks} disks, arrays {arrays}: {what}",
                    component.info().identifier
                ));
            };
            let description = model_description::write(&component, Version::Three);
            let names = values(element(&description, "ModelVariables"), "name");
            let terminals = fmi_bundle::terminals::write(&component).unwrap_or_default();
            for name in values(&terminals, "variableName") {
                if !names.contains(&name) {
                    fault(format!("terminal member {name}"));
                }
            }
            missing(&description, Version::Three).into_iter().for_each(&mut fault);
            if !arrays {
                let description = model_description::write(&component, Version::Two);
                missing(&description, Version::Two).into_iter().for_each(&mut fault);
            }
        }
    }
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

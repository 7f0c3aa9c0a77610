//! The model descriptions under `modelDescription/` are what the scenes generate, with three disks where a scene may have them.
//!
//! Regression test: it shows each change of an interface in the diff. To accept one:
//! `UPDATE_MODEL_DESCRIPTIONS=1 cargo test --test model_description`, and a line in the change log.

#![allow(clippy::unwrap_used)]

use std::path::Path;

use fmi_bundle::{Version, model_description};
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

/// Every name that a file of an FMU mentions is a variable of that FMU, with arrays too.
#[test]
fn terminals_name_variables_that_exist() {
    for model in MODELS {
        for arrays in [false, true] {
            let mut component = fmus::component(model, 3);
            component.arrays = arrays;
            let description = model_description::write(&component, Version::Three);
            let Some(terminals) = fmi_bundle::terminals::write(&component) else {
                continue;
            };
            for name in terminals.split("variableName=\"").skip(1) {
                let name = name.split('"').next().unwrap();
                assert!(
                    description.contains(&format!(" name=\"{name}\"")),
                    "{}, arrays {arrays}: {name}",
                    component.info().identifier
                );
            }
        }
    }
}

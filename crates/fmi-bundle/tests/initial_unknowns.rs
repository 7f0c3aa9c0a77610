//! `InitialUnknowns` of the oscillators are what their outputs depend on.

#![allow(clippy::unwrap_used)]

#[path = "support/initial_unknowns.rs"]
mod initial_unknowns;

use std::sync::Arc;

use fmi_bundle::Component;
use fmi_component::{ModelType, StructuralParameters, TIME, Variable};
use initial_unknowns::{Trials, differences};
use oscillators::Oscillators;

const MODEL: ModelType = ModelType::of::<Oscillators>();
const TRIALS: Trials = Trials {
    points: 16,
    is_tried: |_, _, _| true,
    rounded: &[],
};

/// The oscillators with what their variables depend on.
fn variables(structure: &StructuralParameters) -> Vec<Variable> {
    let mut variables = (MODEL.variables)(structure);
    for variable in &mut variables {
        let names: &[&'static str] = match variable.name.as_str() {
            "natural.angle_rate" => &["spring.stiffness", "body.mass"],
            name if name.starts_with("body.position") => &["frame.position"],
            "steps" | "frame.reaction_force" => &[],
            _ => continue,
        };
        variable.dependencies = Some(Arc::from(names));
    }
    variables
}

#[test]
fn initial_dependencies_are_those_that_are_observed() {
    let model = ModelType { variables, ..MODEL };
    let wrong = differences(&Component::new(&model, &[]).unwrap(), &TRIALS);
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn a_list_with_too_much_or_too_little_is_found() {
    let model = ModelType {
        variables: |structure| {
            let mut variables = variables(structure);
            let rate = variables
                .iter_mut()
                .find(|variable| variable.name == "natural.angle_rate");
            rate.unwrap().dependencies = Some(Arc::from([TIME, "body.mass"]));
            variables
        },
        ..MODEL
    };
    let wrong = differences(&Component::new(&model, &[]).unwrap(), &TRIALS);
    assert_eq!(wrong.len(), 2, "{wrong:?}");
    for message in wrong {
        assert!(message.contains(r#"natural.angle_rate depends on {"spring.stiffness"} too, and never on {"time"}"#));
    }
}

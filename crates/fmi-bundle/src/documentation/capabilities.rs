//! What the component can do for an importer, in plain words: the capability flags of the model description.

use fmi_component::{Causality, LOG_CATEGORIES, TOLERANCE, Value, Version};
use quick_xml::escape::escape;

use crate::component::Component;

/// The part of the page.
pub fn write(component: &Component, version: Version) -> String {
    let mut list = vec![general(component, version), step(component), states(version).into()];
    list.push(derivatives(component, version));
    if version == Version::Three {
        list.push(events(component));
        list.push(inside_of_steps(component));
        list.push(array_variables(component).into());
    }
    let categories: Vec<String> = LOG_CATEGORIES
        .iter()
        .map(|(name, description)| format!("<code>{name}</code> ({})", escape(*description)))
        .collect();
    list.push(format!("<b>Log.</b> Categories: {}.", categories.join(", ")));
    let items: String = list.iter().map(|item| format!("<li>{item}</li>\n")).collect();
    format!("<ul>\n{items}</ul>\n")
}

fn general(component: &Component, version: Version) -> String {
    let standard = match version {
        Version::Two => "FMI 2.0",
        Version::Three => "FMI 3.0",
    };
    let tunable = match component.table().tunable() {
        [] => "",
        _ => {
            ", but for those that may change between steps (variability <code>tunable</code>), of which the next step takes over what was set"
        }
    };
    format!(
        "<b>Kind.</b> Co-simulation for {standard}. The solver is inside; no tool and no file is needed to run it. Any number of \
         instances in any number of threads, one call at a time for each. Parameters are frozen when initialisation ends{tunable}. A \
         value out of range is refused with its range."
    )
}

fn step(component: &Component) -> String {
    let info = component.info();
    let tolerance = match component.table().position(TOLERANCE) {
        Some(_) => format!(" A tolerance given by the importer stands for the parameter <code>{TOLERANCE}</code>."),
        None => String::new(),
    };
    format!(
        "<b>Step.</b> Any communication step above zero, and steps of different length. The default experiment has {} s with steps \
         of {} s.{tolerance} Inputs may be set at every communication point; outputs change in a step only, so that there is no \
         algebraic loop through the FMU. A step that cannot be done is discarded: time and state are those before it, the log \
         says why, and a shorter step may be tried at once.",
        Value::Real(info.stop_time),
        Value::Real(info.step_size)
    )
}

fn states(version: Version) -> &'static str {
    match version {
        Version::Two | Version::Three => {
            "<b>States.</b> Can be saved, restored and serialised, for another process too. A run that goes on from a state gives the \
             same bits. The same parameters and inputs give the same bits in every run."
        }
    }
}

fn derivatives(component: &Component, version: Version) -> String {
    let has = |causality| component.table().has_derivatives(causality);
    let outputs = match has(Causality::Output) {
        true => {
            "The first time derivatives of outputs that have one, such as the velocity of a position, can be asked for."
        }
        false => "No output has a time derivative that can be asked for.",
    };
    let inputs = match (has(Causality::Input), version) {
        (true, Version::Two) => " The rate of an input may be set by its variable or as input derivative.",
        (true, Version::Three) => " The rate of an input is an input of its own.",
        (false, _) => "",
    };
    format!("<b>Derivatives.</b> {outputs}{inputs} No directional derivatives: the model has jumps.")
}

fn events(component: &Component) -> String {
    let text = match component.has_events() {
        true => {
            "A step ends early at an event if the importer has event mode and allows early return. The event is handled by then; event \
             mode is for what the importer does about it."
        }
        false => "None that an importer has to handle: all that happens inside of a step is done there.",
    };
    format!("<b>Events.</b> {text}")
}

fn inside_of_steps(component: &Component) -> String {
    let text = match (component.has_events(), component.input_parts()) {
        (_, parts) if parts > 0 => {
            format!(
                "The callback comes after each of {parts} equal parts of a step and may set inputs, read all variables and end the step."
            )
        }
        (true, _) => "The callback comes at every event of a step; it may read all variables and end the step.".into(),
        (false, _) => "None.".into(),
    };
    format!("<b>Intermediate update.</b> {text}")
}

fn array_variables(component: &Component) -> &'static str {
    match component.arrays {
        true => "<b>Arrays.</b> Variables with an index are array variables.",
        false => "<b>Arrays.</b> None: each element is a scalar variable with its number in its name, counted from 1.",
    }
}

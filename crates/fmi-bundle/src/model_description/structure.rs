//! `ModelStructure`: which variables are outputs, and what computed ones depend on.

use std::io;

use fmi_component::{Causality, TIME, TIME_REFERENCE, Version, value_reference};

use super::Layout;
use crate::xml::{self, Attributes, Xml};

/// Outputs and initial unknowns.
pub fn write(xml: &mut Xml, layout: &Layout<'_>) -> io::Result<()> {
    match layout.version {
        Version::Two => {
            // The schema knows no empty lists. A model without outputs may still compute calculated parameters.
            if layout.positions().any(|position| is_output(layout, position)) {
                xml::element(xml, "Outputs", &vec![], |xml| outputs(xml, layout, "Unknown"))?;
            }
            if !layout.positions().any(|position| is_computed(layout, position)) {
                return Ok(());
            }
            xml::element(xml, "InitialUnknowns", &vec![], |xml| {
                initial_unknowns(xml, layout, "Unknown")
            })
        }
        Version::Three => {
            outputs(xml, layout, "Output")?;
            initial_unknowns(xml, layout, "InitialUnknown")
        }
    }
}

fn is_output(layout: &Layout<'_>, position: usize) -> bool {
    layout.variable(position).causality == Causality::Output
}

fn is_computed(layout: &Layout<'_>, position: usize) -> bool {
    !layout.variable(position).causality.is_settable()
}

fn outputs(xml: &mut Xml, layout: &Layout<'_>, element: &str) -> io::Result<()> {
    let mut outputs = layout.positions().filter(|position| is_output(layout, *position));
    outputs.try_for_each(|position| {
        let about = vec![reference(layout, position), ("dependencies", String::new())];
        xml::empty(xml, element, &about)
    })
}

fn initial_unknowns(xml: &mut Xml, layout: &Layout<'_>, element: &str) -> io::Result<()> {
    let mut computed = layout.positions().filter(|position| is_computed(layout, *position));
    computed.try_for_each(|position| {
        let about = [
            vec![reference(layout, position)],
            initial_dependencies(layout, position),
        ]
        .concat();
        xml::empty(xml, element, &about)
    })
}

/// The attribute `dependencies` of the variable at `position` during initialisation, in the order that FMI 2.0 asks for; none
/// where the model does not say.
fn initial_dependencies(layout: &Layout<'_>, position: usize) -> Attributes {
    let Some(names) = &layout.variable(position).dependencies else {
        return Attributes::new();
    };
    let time = match layout.version {
        Version::Two => "1".into(),
        Version::Three => TIME_REFERENCE.to_string(),
    };
    let of_time = names.contains(&TIME).then_some(time);
    let table = layout.component.table();
    let positions = names.iter().filter_map(|name| table.position(name));
    let mut positions: Vec<usize> = positions.filter(|position| layout.lists(*position)).collect();
    positions.sort_unstable();
    positions.dedup();
    let others = positions.into_iter().map(|position| reference(layout, position).1);
    let all: Vec<String> = of_time.into_iter().chain(others).collect();
    vec![("dependencies", all.join(" "))]
}

/// What the variable at `position` is called by.
fn reference(layout: &Layout<'_>, position: usize) -> (&'static str, String) {
    match layout.version {
        Version::Two => ("index", layout.index(position)),
        Version::Three => ("valueReference", value_reference(position).to_string()),
    }
}

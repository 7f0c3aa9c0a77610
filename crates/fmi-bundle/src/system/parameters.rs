//! The parameter set of an element: a file `.ssv`, and its values as XML.

use std::io;

use fmi_component::{Kind, Result, Value, Variable};

use super::structure::Element;
use crate::xml::{Xml, document, element, empty, number};

/// The file; the sets of all elements have the name `system`, by which some runners choose.
pub fn write(system: &str, of: &Element<'_>) -> Result<String> {
    let variables: Vec<_> = of
        .parameters
        .iter()
        .map(|(name, value)| Ok((of.variable(name)?, *value)))
        .collect::<Result<_>>()?;
    let set = vec![
        (
            "xmlns:ssv",
            "http://ssp-standard.org/SSP1/SystemStructureParameterValues".into(),
        ),
        ("xmlns:ssc", "http://ssp-standard.org/SSP1/SystemStructureCommon".into()),
        ("version", "1.0".into()),
        ("name", system.into()),
        ("generationTool", of.component.tool()),
    ];
    Ok(document(|xml| {
        element(xml, "ssv:ParameterSet", &set, |xml| {
            element(xml, "ssv:Parameters", &Vec::new(), |xml| {
                variables
                    .iter()
                    .try_for_each(|(variable, value)| parameter(xml, variable, *value))
            })
        })
    }))
}

fn parameter(xml: &mut Xml, variable: &Variable, value: Value) -> io::Result<()> {
    let about = vec![
        ("name", variable.name.clone()),
        ("description", variable.description.clone()),
    ];
    element(xml, "ssv:Parameter", &about, |xml| {
        let (kind, attributes) = match (&variable.kind, value) {
            (Kind::Real(quantity) | Kind::Single(quantity), value) => (
                "ssv:Real",
                vec![("value", number(value.to_f64())), ("unit", quantity.unit.name.into())],
            ),
            (Kind::Boolean { .. }, value) => ("ssv:Boolean", vec![("value", (value != Value::Integer(0)).to_string())]),
            (_, value) => ("ssv:Integer", vec![("value", value.to_string())]),
        };
        empty(xml, kind, &attributes)
    })
}

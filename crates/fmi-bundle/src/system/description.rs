//! `SystemStructure.ssd`: elements with connectors, connections, units and where all of it lies in a diagram.

use std::io;

use fmi_component::{Causality, Kind, Result, Unit, Variable};

use super::structure::{Connection, Element, HEIGHT, System, WIDTH};
use crate::xml::{Attributes, Xml, document, element, empty, number};

/// Room around the elements.
const MARGIN: f64 = 10.0;

/// A connector of an element with its height at the side of the element, 0 below and 1 above.
struct Connector<'system> {
    variable: &'system Variable,
    height: f64,
}

/// Connectors of an element: inputs on its left, outputs on its right, then parameters without a place.
fn connectors<'system>(system: &System<'_>, of: &'system Element<'_>) -> Vec<Connector<'system>> {
    let connected = |name: &str| {
        system
            .connections
            .iter()
            .any(|connection| connection.from == (of.name, name))
    };
    let is_parameter = |name: &str| of.parameters.iter().any(|(parameter, _)| *parameter == name);
    let listed = |variable: &&Variable| match variable.causality {
        Causality::Input => true,
        Causality::Output => connected(&variable.name) || of.outputs.contains(&variable.name.as_str()),
        Causality::Parameter => is_parameter(&variable.name),
        Causality::CalculatedParameter => false,
    };
    let known = |variable: &&Variable| type_of(variable).is_some();
    let all: Vec<&Variable> = of
        .component
        .table()
        .variables()
        .iter()
        .filter(listed)
        .filter(known)
        .collect();
    let place = |(position, variable): (usize, &&'system Variable)| {
        let same = |other: &&&Variable| other.causality == variable.causality;
        let (before, count) = (
            all[..position].iter().filter(same).count(),
            all.iter().filter(same).count(),
        );
        Connector {
            variable,
            height: 1.0 - (before as f64 + 1.0) / (count as f64 + 1.0),
        }
    };
    all.iter().enumerate().map(place).collect()
}

/// Element and attributes of the type; nothing for those that SSP 1.0 runners do not connect.
fn type_of(variable: &Variable) -> Option<(&'static str, Attributes)> {
    match &variable.kind {
        Kind::Real(quantity) | Kind::Single(quantity) => Some(("ssc:Real", vec![("unit", quantity.unit.name.into())])),
        Kind::Integer { .. } | Kind::Long { .. } | Kind::Sized { .. } => Some(("ssc:Integer", Vec::new())),
        Kind::Boolean { .. } => Some(("ssc:Boolean", Vec::new())),
        _ => None,
    }
}

/// The file.
pub fn write(system: &System<'_>) -> Result<String> {
    let paths = system.connections.iter().map(|connection| path(system, connection));
    let paths: Vec<_> = paths.collect::<Result<_>>()?;
    let root = vec![
        (
            "xmlns:ssd",
            "http://ssp-standard.org/SSP1/SystemStructureDescription".into(),
        ),
        ("xmlns:ssc", "http://ssp-standard.org/SSP1/SystemStructureCommon".into()),
        ("version", "1.0".into()),
        ("name", system.name.into()),
        (
            "generationTool",
            system
                .elements
                .first()
                .map(|element| element.component.tool())
                .unwrap_or_default(),
        ),
    ];
    Ok(document(|xml| {
        element(xml, "ssd:SystemStructureDescription", &root, |xml| {
            let about = vec![("name", system.name.into()), ("description", system.description.into())];
            element(xml, "ssd:System", &about, |xml| {
                element(xml, "ssd:Elements", &Vec::new(), |xml| {
                    system.elements.iter().try_for_each(|of| component(xml, system, of))
                })?;
                element(xml, "ssd:Connections", &Vec::new(), |xml| {
                    let mut both = system.connections.iter().zip(&paths);
                    both.try_for_each(|(connection, path)| link(xml, connection, path))
                })?;
                empty(xml, "ssd:SystemGeometry", &corners(bounds(system)))
            })?;
            units(xml, system)?;
            experiment(xml, system)
        })
    }))
}

fn component(xml: &mut Xml, system: &System<'_>, of: &Element<'_>) -> io::Result<()> {
    let about = vec![
        ("name", of.name.into()),
        ("description", of.component.info().description.into()),
        ("type", "application/x-fmu-sharedlibrary".into()),
        ("source", of.source()),
        ("implementation", "CoSimulation".into()),
    ];
    element(xml, "ssd:Component", &about, |xml| {
        element(xml, "ssd:Connectors", &Vec::new(), |xml| {
            connectors(system, of)
                .iter()
                .try_for_each(|connector| write_connector(xml, connector))
        })?;
        let (x, y) = of.place;
        empty(xml, "ssd:ElementGeometry", &corners([x, y, x + WIDTH, y + HEIGHT]))?;
        if of.parameters.is_empty() {
            return Ok(());
        }
        element(xml, "ssd:ParameterBindings", &Vec::new(), |xml| {
            empty(xml, "ssd:ParameterBinding", &vec![("source", of.parameter_source())])
        })
    })
}

fn write_connector(xml: &mut Xml, connector: &Connector<'_>) -> io::Result<()> {
    let variable = connector.variable;
    let (kind, x) = match variable.causality {
        Causality::Input => ("input", Some(0.0)),
        Causality::Output => ("output", Some(1.0)),
        _ => ("parameter", None),
    };
    let about = vec![
        ("name", variable.name.clone()),
        ("kind", kind.into()),
        ("description", variable.description.clone()),
    ];
    element(xml, "ssd:Connector", &about, |xml| {
        if let Some((of, attributes)) = type_of(variable) {
            empty(xml, of, &attributes)?;
        }
        let Some(x) = x else { return Ok(()) };
        empty(
            xml,
            "ssd:ConnectorGeometry",
            &vec![("x", number(x)), ("y", number(connector.height))],
        )
    })
}

/// Corners of the line of a connection in the diagram, without its ends: up or down half-way between the elements.
fn path(system: &System<'_>, connection: &Connection) -> Result<[(f64, f64); 2]> {
    let end = |(name, variable): (&str, &str)| {
        let of = system.element(name)?;
        let found = connectors(system, of)
            .into_iter()
            .find(|connector| connector.variable.name == variable);
        let height = found.map_or(0.5, |connector| connector.height);
        Ok::<_, fmi_component::Error>((of.place.0, of.place.1 + HEIGHT * height))
    };
    let ((from, first), (to, last)) = (end(connection.from)?, end(connection.to)?);
    let middle = 0.5 * (from + WIDTH + to);
    Ok([(middle, first), (middle, last)])
}

fn link(xml: &mut Xml, connection: &Connection, path: &[(f64, f64)]) -> io::Result<()> {
    let about = vec![
        ("startElement", connection.from.0.into()),
        ("startConnector", connection.from.1.into()),
        ("endElement", connection.to.0.into()),
        ("endConnector", connection.to.1.into()),
    ];
    let list = |pick: fn(&(f64, f64)) -> f64| {
        let numbers: Vec<String> = path.iter().map(|point| number(pick(point))).collect();
        numbers.join(" ")
    };
    let points = vec![("pointsX", list(|point| point.0)), ("pointsY", list(|point| point.1))];
    element(xml, "ssd:Connection", &about, |xml| {
        empty(xml, "ssd:ConnectionGeometry", &points)
    })
}

fn corners([x1, y1, x2, y2]: [f64; 4]) -> Attributes {
    vec![
        ("x1", number(x1)),
        ("y1", number(y1)),
        ("x2", number(x2)),
        ("y2", number(y2)),
    ]
}

fn bounds(system: &System<'_>) -> [f64; 4] {
    let places = || system.elements.iter().map(|element| element.place);
    [
        places().map(|place| place.0).fold(f64::INFINITY, f64::min) - MARGIN,
        places().map(|place| place.1).fold(f64::INFINITY, f64::min) - MARGIN,
        places().map(|place| place.0).fold(f64::NEG_INFINITY, f64::max) + WIDTH + MARGIN,
        places().map(|place| place.1).fold(f64::NEG_INFINITY, f64::max) + HEIGHT + MARGIN,
    ]
}

/// All units of the connectors, by name.
fn units(xml: &mut Xml, system: &System<'_>) -> io::Result<()> {
    let mut all: Vec<Unit> = Vec::new();
    for of in &system.elements {
        for connector in connectors(system, of) {
            if let Kind::Real(quantity) | Kind::Single(quantity) = &connector.variable.kind
                && !all.iter().any(|known| known.name == quantity.unit.name)
            {
                all.push(quantity.unit);
            }
        }
    }
    all.sort_by_key(|unit| unit.name);
    element(xml, "ssd:Units", &Vec::new(), |xml| {
        all.iter().try_for_each(|unit| {
            element(xml, "ssc:Unit", &vec![("name", unit.name.into())], |xml| {
                let exponents = Unit::BASE.into_iter().zip(unit.exponents);
                let written = exponents.filter(|(_, exponent)| *exponent != 0);
                empty(
                    xml,
                    "ssc:BaseUnit",
                    &written.map(|(base, exponent)| (base, exponent.to_string())).collect(),
                )
            })
        })
    })
}

/// Stop time, and the communication step for libcosim, which reads it from an annotation: SSP 1.0 has no place for it.
fn experiment(xml: &mut Xml, system: &System<'_>) -> io::Result<()> {
    let times = vec![("startTime", number(0.0)), ("stopTime", number(system.stop_time))];
    element(xml, "ssd:DefaultExperiment", &times, |xml| {
        element(xml, "ssd:Annotations", &Vec::new(), |xml| {
            // Its parser takes an attribute of osp:Algorithm for an algorithm: the namespace stands one level higher.
            let about = vec![
                ("type", "com.opensimulationplatform".into()),
                (
                    "xmlns:osp",
                    "http://opensimulationplatform.com/SSP/OSPAnnotations".into(),
                ),
            ];
            element(xml, "ssc:Annotation", &about, |xml| {
                element(xml, "osp:Algorithm", &Vec::new(), |xml| {
                    empty(
                        xml,
                        "osp:FixedStepAlgorithm",
                        &vec![("baseStepSize", number(system.step_size))],
                    )
                })
            })
        })
    })
}

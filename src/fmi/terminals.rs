//! Variable table in, `terminalsAndIcons/terminalsAndIcons.xml` of FMI 3.0 out: what belongs to one mechanical flange.
//!
//! Variables that share the prefix of an input (`base.` of `base.displacement`) make one terminal, named by the prefix.

use std::collections::BTreeSet;

use super::xml;
use crate::scene::{Causality, Variable};

/// The file; without inputs it states the icon alone.
pub fn write(rows: &[Variable]) -> String {
    let flanges: BTreeSet<&str> = rows
        .iter()
        .filter(|row| row.causality == Causality::Input)
        .filter_map(|row| Some(row.name.split_once('.')?.0))
        .collect();
    xml::document(|xml| {
        xml::element(
            xml,
            "fmiTerminalsAndIcons",
            &vec![("fmiVersion", "3.0".into())],
            |xml| {
                xml::element(xml, "GraphicalRepresentation", &vec![], |xml| {
                    let corners = || ["-100", "-100", "100", "100"].map(String::from);
                    let place: xml::Attributes = ["x1", "y1", "x2", "y2"].into_iter().zip(corners()).collect();
                    let mut system = place.clone();
                    system.push(("suggestedScalingFactorTo_mm", "0.1".into()));
                    xml::empty(xml, "CoordinateSystem", &system)?;
                    xml::empty(xml, "Icon", &place)
                })?;
                if flanges.is_empty() {
                    return Ok(());
                }
                xml::element(xml, "Terminals", &vec![], |xml| {
                    flanges.iter().try_for_each(|flange| terminal(xml, flange, rows))
                })
            },
        )
    })
}

fn terminal(xml: &mut xml::Xml, flange: &str, rows: &[Variable]) -> std::io::Result<()> {
    let about = vec![
        ("name", flange.into()),
        ("matchingRule", "bus".into()),
        (
            "description",
            format!("Mechanical flange: what is coupled at the {flange}."),
        ),
    ];
    xml::element(xml, "Terminal", &about, |xml| {
        for row in rows {
            let signal = matches!(row.causality, Causality::Input | Causality::Output);
            let member = row
                .name
                .split_once('.')
                .filter(|(prefix, _)| signal && *prefix == flange);
            if let Some((_, member)) = member {
                let attributes = vec![
                    ("variableName", row.name.clone()),
                    ("memberName", member.into()),
                    ("variableKind", "signal".into()),
                ];
                xml::empty(xml, "TerminalMemberVariable", &attributes)?;
            }
        }
        Ok(())
    })
}

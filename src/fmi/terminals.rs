//! Variable table in, `terminalsAndIcons/terminalsAndIcons.xml` of FMI 3.0 out: what belongs to one mechanical flange.
//!
//! An input that comes with its rate is one side of a flange: a motion, a torque. The variables that share its prefix (`base.`
//! of `base.displacement`) make one terminal, named by the prefix; without a prefix, such as `torque`, its name is the
//! terminal's. What a torque turns, the disk of such a scene, is the other side of its flange.

use std::collections::BTreeSet;

use super::{derivatives, xml};
use crate::scene::{Causality, Table, Variable};

/// Outputs of the disk that a torque turns, and what they are at its flange.
const TURNED: [(&str, &str); 2] = [
    ("disk.angle[1]", "angle"),
    ("disk.angular_velocity[1]", "angular_velocity"),
];

/// The file; without inputs it states the icon alone.
pub fn write(rows: &[Variable]) -> String {
    let table = Table::new(rows.to_vec());
    let flanges: BTreeSet<&str> = rows
        .iter()
        .enumerate()
        .filter(|(position, row)| row.causality == Causality::Input && derivatives::of(&table, *position).is_some())
        .map(|(_, row)| split(&row.name).0)
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
            let turned = TURNED.iter().find(|(name, _)| flange == "torque" && *name == row.name);
            let (prefix, member) = turned.map_or_else(|| split(&row.name), |(_, member)| (flange, *member));
            if signal && prefix == flange {
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

/// Terminal and member of it that a variable would be.
fn split(name: &str) -> (&str, &str) {
    name.split_once('.').unwrap_or((name, name))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Unit;

    #[test]
    fn flanges_are_those_of_the_inputs() {
        let input = |name: &str| Variable::input(name, Unit::One, 1.0, "");
        let output = |name: &str| Variable::output(name, Unit::One, 1.0, "");
        let text = write(&[
            input("base.displacement"),
            input("base.velocity"),
            input("torque"),
            input("torque.rate"),
            input("measure.mark"),
            output("base.reaction_force"),
            output("energy.lost"),
            output("disk.angle[1]"),
            output("disk.x[1]"),
        ]);
        assert_eq!(text.matches("<Terminal ").count(), 2);
        for (variable, member) in [
            ("base.displacement", "displacement"),
            ("base.reaction_force", "reaction_force"),
            ("torque", "torque"),
            ("torque.rate", "rate"),
            ("disk.angle[1]", "angle"),
        ] {
            let member = format!(r#"variableName="{variable}" memberName="{member}""#);
            assert!(text.contains(&member), "{text}");
        }
        assert!(
            !text.contains("disk.x")
                && !text.contains("energy")
                && !text.contains("measure")
                && !write(&[output("torque")]).contains("Terminals>")
        );
    }
}

//! Component in, `terminalsAndIcons/terminalsAndIcons.xml` out: which variables are coupled together, and the icon.
//!
//! One file for both versions of FMI: FMI 2.0.4 (section Terminals and Icons) takes the definition of FMI 3.0 as it is, and FMI 3.0 (2.4.9)
//! asks for the version of this definition in `fmiVersion`, not for that of the model description, where an older FMU has the file.
//!
//! The members of a terminal are what the variables say of themselves ([`TerminalMember`](fmi_component::TerminalMember)), by
//! the names that they have in this FMU: an array is a member where one of its elements is. A terminal without an input is left
//! out, since nothing can be connected to it.

use std::collections::BTreeMap;
use std::io;

use fmi_component::{Causality, Variable};

use crate::component::Component;
use crate::xml::{self, Attributes, Xml};

/// Name of a variable in the FMU and of the member that it is.
type Member<'a> = (&'a str, &'static str);

/// The file; none where there is neither an icon nor a terminal.
pub fn write(component: &Component) -> Option<String> {
    let terminals = terminals(component);
    if terminals.is_empty() && component.icon.is_none() {
        return None;
    }
    let version = vec![("fmiVersion", "3.0".into())];
    Some(xml::document(|xml| {
        xml::element(xml, "fmiTerminalsAndIcons", &version, |xml| {
            if component.icon.is_some() {
                xml::element(xml, "GraphicalRepresentation", &vec![], icon)?;
            }
            if terminals.is_empty() {
                return Ok(());
            }
            xml::element(xml, "Terminals", &vec![], |xml| {
                terminals
                    .iter()
                    .try_for_each(|(name, members)| terminal(xml, name, members))
            })
        })
    }))
}

/// The terminals by name, each with its members in the order of the variables.
fn terminals(component: &Component) -> BTreeMap<&'static str, Vec<Member<'_>>> {
    let variables = component.table().variables();
    let is_coupled = |wanted: &str| {
        let is_member = |variable: &Variable| variable.terminal.as_ref().is_some_and(|place| place.terminal == wanted);
        let mut inputs = variables
            .iter()
            .filter(|variable| variable.causality == Causality::Input);
        inputs.any(is_member)
    };
    let mut terminals = BTreeMap::<_, Vec<Member<'_>>>::new();
    let mut begin = 0;
    for (position, span) in component.spans().into_iter().enumerate() {
        if span > 0 {
            begin = position;
        }
        let Some(place) = &variables[position].terminal else {
            continue;
        };
        if is_coupled(place.terminal) {
            let members = terminals.entry(place.terminal).or_default();
            let name = component.name_at(begin);
            if members.iter().all(|(former, _)| *former != name) {
                members.push((name, place.member));
            }
        }
    }
    terminals
}

fn terminal(xml: &mut Xml, name: &str, members: &[Member<'_>]) -> io::Result<()> {
    let about = vec![
        ("name", name.into()),
        ("matchingRule", "bus".into()),
        ("description", format!("What is coupled at the {name}.")),
    ];
    xml::element(xml, "Terminal", &about, |xml| {
        members.iter().try_for_each(|(variable, member)| {
            let attributes = vec![
                ("variableName", (*variable).into()),
                ("memberName", (*member).into()),
                ("variableKind", "signal".into()),
            ];
            xml::empty(xml, "TerminalMemberVariable", &attributes)
        })
    })
}

fn icon(xml: &mut Xml) -> io::Result<()> {
    let corners = || ["-100", "-100", "100", "100"].map(String::from);
    let place: Attributes = ["x1", "y1", "x2", "y2"].into_iter().zip(corners()).collect();
    let mut system = place.clone();
    system.push(("suggestedScalingFactorTo_mm", "0.1".into()));
    xml::empty(xml, "CoordinateSystem", &system)?;
    xml::empty(xml, "Icon", &place)
}

#[cfg(test)]
mod tests {
    use fmi_component::{DataSheet, ModelInfo, ModelType, Row, Unit};

    use super::*;
    use crate::component::Icon;

    fn input(name: &str) -> Row<()> {
        Row::input(name, Unit::ONE, 1.0, "")
    }

    fn output(name: &str) -> Row<()> {
        Row::output(name, Unit::ONE, 1.0, "", |()| 0.0)
    }

    fn variables() -> Vec<Variable> {
        let rows = vec![
            input("base.displacement").in_terminal("base", "displacement"),
            input("torque").in_terminal("shaft", "torque"),
            input("measure.mark"),
            output("base.reaction_force").in_terminal("base", "reaction_force"),
            output("energy.lost").in_terminal("meter", "energy"),
            output("wheel.angle[1]").in_terminal("shaft", "angle"),
            output("wheel.angle[2]").in_terminal("shaft", "angle_of_the_other"),
            output("wheel.x[1]"),
        ];
        rows.into_iter().map(|row| row.variable).collect()
    }

    fn component() -> Component {
        let info = || ModelInfo {
            package: "mechanics",
            version: "1.0.0",
            name: "wheels",
            variant: vec![],
            identifier: "mechanics_wheels".into(),
            description: "",
            equations: "",
            structure: vec![],
            stop_time: 1.0,
            step_size: 0.1,
            sheet: DataSheet::EMPTY,
        };
        let model = ModelType {
            info,
            events: false,
            input_parts: 0,
            variables: |_| variables(),
            prepare: |_| unreachable!("nothing is simulated"),
        };
        Component::new(&model, &[]).unwrap()
    }

    fn members(text: &str) -> Vec<(&str, &str)> {
        let elements = text.split("variableName=\"").skip(1);
        elements
            .map(|element| {
                let parts: Vec<&str> = element.split('"').collect();
                (parts[0], parts[2])
            })
            .collect()
    }

    #[test]
    fn a_terminal_is_written_where_one_of_its_members_is_an_input() {
        let text = write(&component()).unwrap();
        assert!(!text.contains("Icon>") && !text.contains("meter"), "{text}");
        assert_eq!(text.matches("<Terminal ").count(), 2);
        let expected = [
            ("base.displacement", "displacement"),
            ("base.reaction_force", "reaction_force"),
            ("torque", "torque"),
            ("wheel.angle[1]", "angle"),
            ("wheel.angle[2]", "angle_of_the_other"),
        ];
        assert_eq!(members(&text), expected);
    }

    #[test]
    fn an_array_is_a_member_once_by_the_name_that_it_has_in_the_fmu() {
        let mut component = component();
        component.arrays = true;
        let text = write(&component).unwrap();
        assert_eq!(
            members(&text)[2..],
            [("torque", "torque"), ("wheel.angle", "angle")],
            "{text}"
        );
        let description = crate::model_description::write(&component, fmi_component::Version::Three);
        for (variable, _) in members(&text) {
            assert!(description.contains(&format!("name=\"{variable}\"")), "{variable}");
        }
    }

    #[test]
    fn without_terminals_there_is_a_file_for_the_icon_alone() {
        let mut component = component();
        component.icon = Some(Icon { png: vec![], svg: None });
        assert!(write(&component).unwrap().contains("<Icon "));
        let model = ModelType {
            variables: |_| vec![],
            ..*component.model().unwrap()
        };
        let mut plain = Component::new(&model, &[]).unwrap();
        assert_eq!(write(&plain), None);
        plain.icon = component.icon.clone();
        assert!(!write(&plain).unwrap().contains("Terminals>"));
    }
}

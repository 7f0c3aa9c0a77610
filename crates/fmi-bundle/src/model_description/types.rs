//! Units, display units, quantities and declared types of the variables in use.

use std::collections::BTreeMap;
use std::io;

use fmi_component::{Kind, Unit, Variable, Version};

use crate::xml::{self, Attributes, Xml, number};

/// Units of the variables and of time: those of [`Unit::MECHANICS`] in their order, then others in the order of their use.
fn used_units(variables: &[Variable]) -> Vec<Unit> {
    let mut used = vec![Unit::SECOND];
    for variable in variables {
        if let Kind::Real(quantity) = &variable.kind
            && !used.contains(&quantity.unit)
        {
            used.push(quantity.unit);
        }
    }
    used.sort_by_key(|unit| {
        Unit::MECHANICS
            .iter()
            .position(|known| known == unit)
            .unwrap_or(usize::MAX)
    });
    used
}

/// `UnitDefinitions`: units of one name are one, with the display units of all.
pub fn units(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    let used = used_units(variables);
    let first = |(number, unit): &(usize, &Unit)| used[..*number].iter().all(|former| former.name != unit.name);
    used.iter().enumerate().filter(first).try_for_each(|(_, unit)| {
        xml::element(xml, "Unit", &vec![("name", unit.name.into())], |xml| {
            let exponents = Unit::BASE.into_iter().zip(unit.exponents);
            let exponents = exponents.filter(|(_, exponent)| *exponent != 0);
            let exponents = exponents.map(|(name, exponent)| (name, exponent.to_string())).collect();
            xml::empty(xml, "BaseUnit", &exponents)?;
            let of_name = used.iter().filter(|other| other.name == unit.name);
            of_name.filter_map(|unit| unit.display).try_for_each(|(name, factor)| {
                let about = vec![("name", name.into()), ("factor", number(factor))];
                xml::empty(xml, "DisplayUnit", &about)
            })
        })
    })
}

/// Name of the declared type of quantities in this unit: that of the physical quantity, and for others than
/// [`Unit::MECHANICS`] the unit too, since a quantity may come in several.
pub fn declared_type(unit: Unit) -> Option<String> {
    let quantity = unit.quantity?;
    let shown = unit.display.map_or(unit.name, |(name, _)| name);
    Some(match Unit::MECHANICS.contains(&unit) {
        true => quantity.into(),
        false => format!("{quantity} in {shown}"),
    })
}

/// A type for each physical quantity and unit in use, and the enumerations in use.
pub fn type_definitions(xml: &mut Xml, variables: &[Variable], version: Version) -> io::Result<()> {
    for unit in used_units(variables) {
        if let Some(name) = declared_type(unit) {
            let about = vec![("name", name)];
            match version {
                Version::Two => xml::element(xml, "SimpleType", &about, |xml| xml::empty(xml, "Real", &of_unit(unit)))?,
                Version::Three => xml::empty(xml, "Float64Type", &[about, of_unit(unit)].concat())?,
            }
        }
    }
    let enumerations: BTreeMap<_, _> = variables
        .iter()
        .filter_map(|variable| match variable.kind {
            Kind::Enumeration { type_name, options, .. } => Some((type_name, options)),
            _ => None,
        })
        .collect();
    enumerations.into_iter().try_for_each(|(name, options)| {
        let name = vec![("name", name.into())];
        match version {
            Version::Two => xml::element(xml, "SimpleType", &name, |xml| {
                xml::element(xml, "Enumeration", &vec![], |xml| items(xml, options))
            }),
            Version::Three => xml::element(xml, "EnumerationType", &name, |xml| items(xml, options)),
        }
    })
}

/// Attributes that say what a unit measures; a variable repeats those of its type for importers that do not read that.
pub fn of_unit(unit: Unit) -> Attributes {
    let mut list = Attributes::new();
    list.extend(unit.quantity.map(|name| ("quantity", name.into())));
    list.push(("unit", unit.name.into()));
    list.extend(unit.display.map(|(name, _)| ("displayUnit", name.into())));
    list
}

fn items(xml: &mut Xml, options: &[(&str, &str)]) -> io::Result<()> {
    (1..)
        .zip(options)
        .try_for_each(|(value, (name, description)): (i64, _)| {
            let attributes = vec![
                ("name", (*name).into()),
                ("value", value.to_string()),
                ("description", (*description).into()),
            ];
            xml::empty(xml, "Item", &attributes)
        })
}

#[cfg(test)]
mod tests {
    use fmi_component::Row;

    use super::*;

    #[test]
    fn units_of_one_name_are_one_and_each_type_has_a_name_of_its_own() {
        let volt = Unit::new("V", [1, 2, -3, -1, 0, 0, 0, 0]).of("ElectricPotential");
        let units_used = [
            Unit::NEWTON,
            volt,
            Unit::METRE,
            Unit::METRE.shown_as("mm", 1e3),
            volt,
            Unit::new("u", [0; 8]),
        ];
        let row = |unit| Row::<()>::input("x", unit, 1.0, "").variable;
        let variables = units_used.map(row);
        let text = xml::document(|xml| {
            units(xml, &variables)?;
            type_definitions(xml, &variables, Version::Three)
        });
        let names: Vec<&str> = text
            .split(" name=\"")
            .skip(1)
            .map(|rest| rest.split('"').next().unwrap())
            .collect();
        let expected = ["m", "mm", "s", "N", "V", "u"].into_iter().chain([
            "Length",
            "Time",
            "Force",
            "ElectricPotential in V",
            "Length in mm",
        ]);
        assert_eq!(names, expected.collect::<Vec<_>>(), "{text}");
        assert!(text.contains(r#"<BaseUnit kg="1" m="2" s="-3" A="-1"/>"#), "{text}");
    }
}

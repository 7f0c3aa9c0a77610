//! Units, display units, quantities and declared types of the variables in use.

use std::collections::BTreeMap;
use std::io;

use fmi_component::{Causality, Kind, Quantity, Unit, Variable, Version};

use crate::xml::{self, Attributes, Xml, number};

/// Units of the variables and of time: those of [`Unit::MECHANICS`] in their order, then others in the order of their use.
fn used_units(variables: &[Variable]) -> Vec<Unit> {
    let mut used = vec![Unit::SECOND];
    for variable in variables {
        if let Some(quantity) = variable.kind.quantity()
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

/// Name of the declared type of FMI 2.0 for quantities in this unit: that of the physical quantity, and for others than
/// [`Unit::MECHANICS`] the unit too, since a quantity may come in several.
fn declared_type(unit: Unit) -> Option<String> {
    let quantity = unit.quantity?;
    Some(match Unit::MECHANICS.contains(&unit) {
        true => quantity.into(),
        false => format!("{quantity} in {}", shown(unit)),
    })
}

fn shown(unit: Unit) -> &'static str {
    unit.display.map_or(unit.name, |(name, _)| name)
}

/// What a real variable of FMI 3.0 shares with others of its declared type.
#[derive(Clone, Copy, PartialEq)]
pub struct RealType {
    unit: Unit,
    /// 1 is the value of the standard where none is written.
    nominal: f64,
    /// Of 32 bits.
    single: bool,
}

impl RealType {
    /// Of the time.
    pub const TIME: Self = Self {
        unit: Unit::SECOND,
        nominal: 1.0,
        single: false,
    };

    /// Of a variable. A parameter needs no nominal value: it does not change, and its start value says how large it is.
    pub fn of(variable: &Variable, quantity: &Quantity) -> Self {
        let nominal = match variable.causality {
            Causality::Parameter => 1.0,
            Causality::CalculatedParameter | Causality::Input | Causality::Output => quantity.nominal,
        };
        Self {
            unit: quantity.unit,
            nominal,
            single: matches!(variable.kind, Kind::Single(_)),
        }
    }

    /// Name of the type, which each variable of it refers to.
    pub fn name(self) -> String {
        let unit = match self.unit {
            unit if unit.name == Unit::ONE.name && unit.quantity.is_none() => "Number".into(),
            unit => declared_type(unit).unwrap_or_else(|| format!("Quantity in {}", shown(unit))),
        };
        let size = if self.single { ", 32 bits" } else { "" };
        match self.nominal {
            1.0 => format!("{unit}{size}"),
            nominal => format!("{unit}{size}, nominal {}", number(nominal)),
        }
    }

    fn attributes(self) -> Attributes {
        let mut list = vec![("name", self.name())];
        list.extend(of_unit(self.unit));
        list.extend((self.nominal != 1.0).then(|| ("nominal", number(self.nominal))));
        list
    }
}

/// The types in use, in the order of their units and then of their nominal values.
fn real_types(variables: &[Variable]) -> Vec<RealType> {
    let of_all = variables
        .iter()
        .filter_map(|variable| Some(RealType::of(variable, variable.kind.quantity()?)));
    let of_all: Vec<RealType> = [RealType::TIME].into_iter().chain(of_all).collect();
    let of_unit = |unit: Unit| {
        let mut types: Vec<RealType> = of_all.iter().filter(|each| each.unit == unit).copied().collect();
        // The plain type first.
        types.sort_by(|one, other| {
            let plain = (one.single, one.nominal != 1.0).cmp(&(other.single, other.nominal != 1.0));
            plain.then(one.nominal.total_cmp(&other.nominal))
        });
        types.dedup();
        types
    };
    used_units(variables).into_iter().flat_map(of_unit).collect()
}

/// A type for each physical quantity and unit in use, in FMI 3.0 for each nominal value too, and the enumerations in use.
pub fn type_definitions(xml: &mut Xml, variables: &[Variable], version: Version) -> io::Result<()> {
    match version {
        Version::Two => {
            for unit in used_units(variables) {
                if let Some(name) = declared_type(unit) {
                    xml::element(xml, "SimpleType", &vec![("name", name)], |xml| {
                        xml::empty(xml, "Real", &of_unit(unit))
                    })?;
                }
            }
        }
        Version::Three => {
            for each in real_types(variables) {
                let element = if each.single { "Float32Type" } else { "Float64Type" };
                xml::empty(xml, element, &each.attributes())?;
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

/// Attributes of a real variable that say what it measures. FMI 3.0 has them in the declared type alone: the standard takes them from
/// there, and readers such as the crate `fmi` refuse them beside it. In FMI 2.0, which they read, the variable repeats
/// them for importers that do not look at types.
pub fn typed(of: RealType, version: Version) -> Attributes {
    match version {
        Version::Two => {
            let declared = declared_type(of.unit).map(|name| ("declaredType", name));
            declared.into_iter().chain(of_unit(of.unit)).collect()
        }
        Version::Three => vec![("declaredType", of.name())],
    }
}

/// Attributes that say what a unit measures.
fn of_unit(unit: Unit) -> Attributes {
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
        let row = |unit, nominal| Row::<()>::input("x", unit, nominal, "").variable;
        let mut variables = units_used.map(|unit| row(unit, 1.0)).to_vec();
        variables.extend([row(Unit::METRE, 0.001), row(Unit::ONE, 1.0), row(Unit::METRE, 0.001)]);
        let text = xml::document(|xml| {
            units(xml, &variables)?;
            type_definitions(xml, &variables, Version::Three)
        });
        let names: Vec<&str> = text
            .split(" name=\"")
            .skip(1)
            .map(|rest| rest.split('"').next().unwrap())
            .collect();
        let expected = ["1", "m", "mm", "s", "N", "V", "u"].into_iter().chain([
            "Number",
            "Length",
            "Length, nominal 0.001",
            "Time",
            "Force",
            "ElectricPotential in V",
            "Length in mm",
            "Quantity in u",
        ]);
        assert_eq!(names, expected.collect::<Vec<_>>(), "{text}");
        assert!(text.contains(r#"<BaseUnit kg="1" m="2" s="-3" A="-1"/>"#), "{text}");
    }
}

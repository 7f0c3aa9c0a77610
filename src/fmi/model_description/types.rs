//! Units, display units, quantities and declared types of the variables in use.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::io;

use super::super::life_cycle::Version;
use super::super::xml::{self, Attributes, Xml, number};
use crate::scene::{Kind, Unit, Variable};

/// Units of the variables and of time.
pub fn used_units(rows: &[Variable]) -> BTreeSet<Unit> {
    let used = rows.iter().filter_map(|row| match &row.kind {
        Kind::Real(quantity) => Some(quantity.unit),
        _ => None,
    });
    used.chain([Unit::Second]).collect()
}

/// `UnitDefinitions`.
pub fn units(xml: &mut Xml, rows: &[Variable]) -> io::Result<()> {
    used_units(rows).into_iter().try_for_each(|unit| {
        xml::element(xml, "Unit", &vec![("name", unit.name().into())], |xml| {
            let (kilogram, metre, second, radian) = unit.exponents();
            let exponents = [("kg", kilogram), ("m", metre), ("s", second), ("rad", radian)];
            let exponents = exponents.into_iter().filter(|(_, exponent)| *exponent != 0);
            let exponents = exponents.map(|(name, exponent)| (name, exponent.to_string())).collect();
            xml::empty(xml, "BaseUnit", &exponents)?;
            display_unit(unit).map_or(Ok(()), |(name, factor)| {
                xml::empty(
                    xml,
                    "DisplayUnit",
                    &vec![("name", name.into()), ("factor", number(factor))],
                )
            })
        })
    })
}

/// A type for each physical quantity in use, named as the quantity, and the enumerations in use.
pub fn type_definitions(xml: &mut Xml, rows: &[Variable], version: Version) -> io::Result<()> {
    for unit in used_units(rows) {
        if let Some(name) = quantity_name(unit) {
            let about = vec![("name", name.into())];
            match version {
                Version::Two => xml::element(xml, "SimpleType", &about, |xml| xml::empty(xml, "Real", &of_unit(unit)))?,
                Version::Three => xml::empty(xml, "Float64Type", &[about, of_unit(unit)].concat())?,
            }
        }
    }
    let enumerations: BTreeMap<_, _> = rows
        .iter()
        .filter_map(|row| match row.kind {
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

/// Attributes that say what a unit measures; a variable repeats those of its type for importers that do not look there.
pub fn of_unit(unit: Unit) -> Attributes {
    let mut list = Attributes::new();
    list.extend(quantity_name(unit).map(|name| ("quantity", name.into())));
    list.push(("unit", unit.name().into()));
    list.extend(display_unit(unit).map(|(name, _)| ("displayUnit", name.into())));
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

/// Where people think in another unit: its name and the factor from the SI unit.
fn display_unit(unit: Unit) -> Option<(&'static str, f64)> {
    match unit {
        Unit::Radian => Some(("deg", 180.0 / PI)),
        Unit::RadianPerSecond => Some(("rpm", 30.0 / PI)),
        _ => None,
    }
}

/// Physical quantity and declared type, for importers that check connections. Names as in Modelica's SI library.
pub fn quantity_name(unit: Unit) -> Option<&'static str> {
    Some(match unit {
        Unit::Metre => "Length",
        Unit::MetrePerSecond => "Velocity",
        Unit::MetrePerSecondSquared => "Acceleration",
        Unit::Radian => "Angle",
        Unit::RadianPerSecond => "AngularVelocity",
        Unit::Second => "Time",
        Unit::Hertz => "Frequency",
        Unit::Kilogram => "Mass",
        Unit::KilogramPerSecond => "TranslationalDampingConstant",
        Unit::KilogramPerSquareMetre => "SurfaceDensity",
        Unit::Newton => "Force",
        Unit::NewtonPerMetre => "TranslationalSpringConstant",
        Unit::NewtonSecond => "Impulse",
        Unit::Joule => "Energy",
        Unit::Watt => "Power",
        Unit::NewtonMetre => "Torque",
        _ => return None,
    })
}

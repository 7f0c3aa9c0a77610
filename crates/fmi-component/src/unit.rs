//! Units of the variables: name, exponents of the SI base units, physical quantity and the unit in which people think.

use serde::{Deserialize, Serialize};

use crate::value::Value;

/// A unit with all that a model description says of it.
///
/// ```
/// use fmi_component::Unit;
///
/// const VOLT: Unit = Unit::new("V", [1, 2, -3, -1, 0, 0, 0, 0]).of("ElectricPotential");
/// assert_eq!(VOLT.name, "V");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Unit {
    /// Name as written in the model description.
    pub name: &'static str,
    /// Exponents of kg, m, s, A, K, mol, cd and rad.
    pub exponents: [i8; 8],
    /// Physical quantity, which is the name of the declared type too, for importers that check connections. Names as in
    /// Modelica's SI library.
    pub quantity: Option<&'static str>,
    /// Another unit in which people think, with the factor from this one: degrees for radians.
    pub display: Option<(&'static str, f64)>,
}

impl Unit {
    /// Names of the base units in the order of [`Unit::exponents`].
    pub const BASE: [&'static str; 8] = ["kg", "m", "s", "A", "K", "mol", "cd", "rad"];

    /// A unit without a quantity.
    pub const fn new(name: &'static str, exponents: [i8; 8]) -> Self {
        Self {
            name,
            exponents,
            quantity: None,
            display: None,
        }
    }

    /// The same unit as that of a physical quantity.
    #[must_use]
    pub const fn of(mut self, quantity: &'static str) -> Self {
        self.quantity = Some(quantity);
        self
    }

    /// The same unit, shown to people as `name`, which is `factor` times the number in this unit.
    #[must_use]
    pub const fn shown_as(mut self, name: &'static str, factor: f64) -> Self {
        self.display = Some((name, factor));
        self
    }

    /// `number` with its unit as a text, as short as that of a [`Value`]; the number alone where it is a pure number.
    pub fn format(&self, number: f64) -> String {
        let number = Value::Real(number);
        match self.name {
            "1" => number.to_string(),
            name => format!("{number} {name}"),
        }
    }
}

/// Units of mechanics. `const fn` arguments: exponents of kg, m, s and rad.
const fn mechanical(name: &'static str, kg: i8, m: i8, s: i8, rad: i8) -> Unit {
    Unit::new(name, [kg, m, s, 0, 0, 0, 0, rad])
}

#[allow(missing_docs)] // the names say it
impl Unit {
    pub const ONE: Self = mechanical("1", 0, 0, 0, 0);
    pub const METRE: Self = mechanical("m", 0, 1, 0, 0).of("Length");
    pub const METRE_PER_SECOND: Self = mechanical("m/s", 0, 1, -1, 0).of("Velocity");
    pub const METRE_PER_SECOND_SQUARED: Self = mechanical("m/s2", 0, 1, -2, 0).of("Acceleration");
    pub const RADIAN: Self = mechanical("rad", 0, 0, 0, 1)
        .of("Angle")
        .shown_as("deg", 180.0 / std::f64::consts::PI);
    pub const RADIAN_PER_SECOND: Self = mechanical("rad/s", 0, 0, -1, 1)
        .of("AngularVelocity")
        .shown_as("rpm", 30.0 / std::f64::consts::PI);
    pub const SECOND: Self = mechanical("s", 0, 0, 1, 0).of("Time");
    pub const HERTZ: Self = mechanical("Hz", 0, 0, -1, 0).of("Frequency");
    pub const KILOGRAM: Self = mechanical("kg", 1, 0, 0, 0).of("Mass");
    pub const KILOGRAM_PER_SECOND: Self = mechanical("kg/s", 1, 0, -1, 0).of("TranslationalDampingConstant");
    pub const KILOGRAM_PER_SQUARE_METRE: Self = mechanical("kg/m2", 1, -2, 0, 0).of("SurfaceDensity");
    pub const NEWTON: Self = mechanical("N", 1, 1, -2, 0).of("Force");
    pub const NEWTON_PER_METRE: Self = mechanical("N/m", 1, 0, -2, 0).of("TranslationalSpringConstant");
    pub const NEWTON_SECOND: Self = mechanical("N.s", 1, 1, -1, 0).of("Impulse");
    pub const JOULE: Self = mechanical("J", 1, 2, -2, 0).of("Energy");
    pub const WATT: Self = mechanical("W", 1, 2, -3, 0).of("Power");
    pub const NEWTON_METRE: Self = mechanical("N.m", 1, 2, -2, 0).of("Torque");
    pub const NEWTON_METRE_PER_SECOND: Self = mechanical("N.m/s", 1, 2, -3, 0);

    /// The units above in the order in which model descriptions list them.
    pub const MECHANICS: [Self; 18] = [
        Self::ONE,
        Self::METRE,
        Self::METRE_PER_SECOND,
        Self::METRE_PER_SECOND_SQUARED,
        Self::RADIAN,
        Self::RADIAN_PER_SECOND,
        Self::SECOND,
        Self::HERTZ,
        Self::KILOGRAM,
        Self::KILOGRAM_PER_SECOND,
        Self::KILOGRAM_PER_SQUARE_METRE,
        Self::NEWTON,
        Self::NEWTON_PER_METRE,
        Self::NEWTON_SECOND,
        Self::JOULE,
        Self::WATT,
        Self::NEWTON_METRE,
        Self::NEWTON_METRE_PER_SECOND,
    ];
}

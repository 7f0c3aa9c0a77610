//! Units of the variables: names and exponents of the SI base units.

/// Units in use, each with its exponents of the SI base units for the model description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)]
pub enum Unit {
    One,
    Metre,
    MetrePerSecond,
    MetrePerSecondSquared,
    Radian,
    RadianPerSecond,
    Second,
    Hertz,
    Kilogram,
    KilogramPerSecond,
    KilogramPerSquareMetre,
    Newton,
    NewtonPerMetre,
    NewtonSecond,
    Joule,
    Watt,
    NewtonMetre,
    NewtonMetrePerSecond,
}

impl Unit {
    /// Name as written in the model description.
    pub const fn name(self) -> &'static str {
        match self {
            Self::One => "1",
            Self::Metre => "m",
            Self::MetrePerSecond => "m/s",
            Self::MetrePerSecondSquared => "m/s2",
            Self::Radian => "rad",
            Self::RadianPerSecond => "rad/s",
            Self::Second => "s",
            Self::Hertz => "Hz",
            Self::Kilogram => "kg",
            Self::KilogramPerSecond => "kg/s",
            Self::KilogramPerSquareMetre => "kg/m2",
            Self::Newton => "N",
            Self::NewtonPerMetre => "N/m",
            Self::NewtonSecond => "N.s",
            Self::Joule => "J",
            Self::Watt => "W",
            Self::NewtonMetre => "N.m",
            Self::NewtonMetrePerSecond => "N.m/s",
        }
    }

    /// A number with its unit, as one says it: without one where there is none.
    pub(super) fn said_of(self, number: f64) -> String {
        match self {
            Self::One => number.to_string(),
            _ => format!("{number} {}", self.name()),
        }
    }

    /// Exponents of (kg, m, s, rad) in SI base units.
    pub const fn exponents(self) -> (i32, i32, i32, i32) {
        match self {
            Self::One => (0, 0, 0, 0),
            Self::Metre => (0, 1, 0, 0),
            Self::MetrePerSecond => (0, 1, -1, 0),
            Self::MetrePerSecondSquared => (0, 1, -2, 0),
            Self::Radian => (0, 0, 0, 1),
            Self::RadianPerSecond => (0, 0, -1, 1),
            Self::Second => (0, 0, 1, 0),
            Self::Hertz => (0, 0, -1, 0),
            Self::Kilogram => (1, 0, 0, 0),
            Self::KilogramPerSecond => (1, 0, -1, 0),
            Self::KilogramPerSquareMetre => (1, -2, 0, 0),
            Self::Newton => (1, 1, -2, 0),
            Self::NewtonPerMetre => (1, 0, -2, 0),
            Self::NewtonSecond => (1, 1, -1, 0),
            Self::Joule | Self::NewtonMetre => (1, 2, -2, 0),
            Self::Watt | Self::NewtonMetrePerSecond => (1, 2, -3, 0),
        }
    }
}

//! One row per variable: the single source of the XML, of get and set, of range checks and of the documentation page.
//!
//! A scene lists its rows once ([`super::Scene::variables`]); everything that shows, checks or stores a variable reads
//! the row. Values live apart from rows, in [`super::Values`], so that a rollback copies numbers only.

use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use super::units::Unit;
use crate::error::{Error, Result};

/// Who sets a variable, and when (FMI 2.0 section 2.2.7, FMI 3.0 section 2.4.7.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Causality {
    /// Set by the user before initialisation ends, frozen from then on.
    Parameter,
    /// Computed from the parameters when initialisation ends, constant from then on.
    CalculatedParameter,
    /// Set by the importer at every communication point.
    Input,
    /// Computed by the scene.
    Output,
}

/// What a variable holds.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// A continuous quantity in SI units.
    Real(Quantity),
    /// A whole number that fits 32 bits, such as a count of contacts.
    Integer {
        /// Allowed values.
        range: RangeInclusive<i64>,
        /// Start value.
        start: i64,
    },
    /// A whole number of 64 bits, such as a seed. FMI 2.0 has only 32 bits and narrows the range.
    Long {
        /// Allowed values.
        range: RangeInclusive<i64>,
        /// Start value.
        start: i64,
    },
    /// One of a few named options, held as its number: 1 is the first.
    Enumeration {
        /// Name of the type, such as `base_model`; variables of one type share it and the options.
        type_name: &'static str,
        /// Names of the options with one sentence each. No two names are equal.
        options: &'static [(&'static str, &'static str)],
        /// Start value.
        start: i64,
    },
}

/// Unit, range and start of a real variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Unit, one of [`Unit`].
    pub unit: Unit,
    /// Smallest allowed value, inclusive; `f64::NEG_INFINITY` for none.
    pub min: f64,
    /// Largest allowed value, inclusive; `f64::INFINITY` for none.
    pub max: f64,
    /// Size that a typical value has, for importers that scale tolerances.
    pub nominal: f64,
    /// Start value of parameters and inputs. Outputs ignore it: theirs is computed.
    pub start: f64,
}

/// One variable of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Structured name, such as `contact.friction` or `disk.angle[3]` (counted from 1).
    pub name: String,
    /// One sentence for the model description and the documentation page.
    pub description: String,
    /// Who sets it, and when.
    pub causality: Causality,
    /// What it holds.
    pub kind: Kind,
}

impl Variable {
    /// A fixed real parameter with its allowed range and default, which is its nominal value too, or 1 if it is zero.
    pub fn parameter(name: &str, unit: Unit, range: RangeInclusive<f64>, start: f64, description: &str) -> Self {
        let nominal = if start == 0.0 { 1.0 } else { start.abs() };
        let quantity = Quantity {
            unit,
            min: *range.start(),
            max: *range.end(),
            nominal,
            start,
        };
        Self {
            name: name.into(),
            description: description.into(),
            causality: Causality::Parameter,
            kind: Kind::Real(quantity),
        }
    }

    /// The same real with another nominal value: for parameters that start at zero, of which one cannot be read off.
    #[must_use]
    pub fn with_nominal(mut self, nominal: f64) -> Self {
        if let Kind::Real(quantity) = &mut self.kind {
            quantity.nominal = nominal;
        }
        self
    }

    /// A fixed parameter that is a whole number of 64 bits.
    pub fn long_parameter(name: &str, range: RangeInclusive<i64>, start: i64, description: &str) -> Self {
        Self {
            name: name.into(),
            description: description.into(),
            causality: Causality::Parameter,
            kind: Kind::Long { range, start },
        }
    }

    /// A fixed parameter that takes one of `options`, each a name and a sentence; `start` is a number, the first being 1.
    pub fn enumeration_parameter(
        name: &str,
        type_name: &'static str,
        options: &'static [(&'static str, &'static str)],
        start: i64,
        description: &str,
    ) -> Self {
        Self {
            name: name.into(),
            description: description.into(),
            causality: Causality::Parameter,
            kind: Kind::Enumeration {
                type_name,
                options,
                start,
            },
        }
    }

    /// A continuous input that starts at zero and may take any finite value.
    pub fn input(name: &str, unit: Unit, nominal: f64, description: &str) -> Self {
        Self::unbounded(name, unit, nominal, description, Causality::Input)
    }

    /// A continuous output.
    pub fn output(name: impl Into<String>, unit: Unit, nominal: f64, description: impl Into<String>) -> Self {
        Self::unbounded(name, unit, nominal, description, Causality::Output)
    }

    /// A real that is known when initialisation ends and stays.
    pub fn calculated(name: impl Into<String>, unit: Unit, nominal: f64, description: impl Into<String>) -> Self {
        Self::unbounded(name, unit, nominal, description, Causality::CalculatedParameter)
    }

    /// A whole number among the outputs, such as the contacts that are closed.
    pub fn count_output(name: impl Into<String>, description: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            description: description.into(),
            causality: Causality::Output,
            kind: Kind::Integer {
                range: 0..=i64::from(i32::MAX),
                start: 0,
            },
        }
    }

    /// One of `options` among the outputs, each a name and a sentence; the first has the number 1.
    pub fn enumeration_output(
        name: impl Into<String>,
        type_name: &'static str,
        options: &'static [(&'static str, &'static str)],
        description: impl Into<String>,
    ) -> Self {
        Self {
            name: name.into(),
            description: description.into(),
            causality: Causality::Output,
            kind: Kind::Enumeration {
                type_name,
                options,
                start: 1,
            },
        }
    }

    fn unbounded(
        name: impl Into<String>,
        unit: Unit,
        nominal: f64,
        description: impl Into<String>,
        causality: Causality,
    ) -> Self {
        let quantity = Quantity {
            unit,
            min: f64::NEG_INFINITY,
            max: f64::INFINITY,
            nominal,
            start: 0.0,
        };
        Self {
            name: name.into(),
            description: description.into(),
            causality,
            kind: Kind::Real(quantity),
        }
    }

    /// Start value as the table stores it.
    pub fn start(&self) -> Value {
        match &self.kind {
            Kind::Real(quantity) => Value::Real(quantity.start),
            Kind::Integer { start, .. } | Kind::Long { start, .. } | Kind::Enumeration { start, .. } => {
                Value::Integer(*start)
            }
        }
    }

    /// Value that `text` stands for; of an enumeration the name of an option or its number. The range is not checked.
    ///
    /// # Errors
    /// Text of another kind, with what is expected.
    pub fn read(&self, text: &str) -> Result<Value> {
        let value = match self.kind {
            Kind::Real(_) => text.parse().map(Value::Real).ok(),
            Kind::Integer { .. } | Kind::Long { .. } => text.parse().map(Value::Integer).ok(),
            Kind::Enumeration { options, .. } => {
                let by_name = (1..).zip(options).find(|(_, (name, _))| *name == text);
                let number = by_name.map(|(number, _)| number).or_else(|| text.parse().ok());
                number.map(Value::Integer)
            }
        };
        value.ok_or_else(|| {
            let digits = "Write it with digits, such as 2 or 1.5e-3.";
            let (allowed, remedy) = match self.kind {
                Kind::Real(_) => ("a number".into(), digits),
                Kind::Integer { .. } | Kind::Long { .. } => ("a whole number of 64 bits".into(), digits),
                Kind::Enumeration { options, .. } => {
                    let names: Vec<&str> = options.iter().map(|(name, _)| *name).collect();
                    (format!("one of: {}", names.join(", ")), "Give an option by its name.")
                }
            };
            Error::parameter(&self.name, text, allowed, remedy)
        })
    }

    /// Says whether `value` may be given to this variable, and if not, why and what to do.
    pub fn check(&self, value: Value) -> Result<()> {
        match (&self.kind, value) {
            (Kind::Real(quantity), Value::Real(real)) => {
                if real.is_finite() && (quantity.min..=quantity.max).contains(&real) {
                    return Ok(());
                }
                Err(Error::parameter(
                    &self.name,
                    quantity.unit.said_of(real),
                    format!("a finite number from {} to {}", quantity.min, quantity.max),
                    "Give a value in this range.",
                ))
            }
            (Kind::Integer { range, .. } | Kind::Long { range, .. }, Value::Integer(integer)) => {
                if range.contains(&integer) {
                    return Ok(());
                }
                Err(Error::parameter(
                    &self.name,
                    integer,
                    format!("a whole number from {} to {}", range.start(), range.end()),
                    "Give a value in this range.",
                ))
            }
            (Kind::Enumeration { options, .. }, Value::Integer(integer)) => {
                if (1..=options.len() as i64).contains(&integer) {
                    return Ok(());
                }
                let options = (1..)
                    .zip(options.iter())
                    .map(|(number, (name, _))| format!("{number} {name}"));
                let allowed = format!("one of: {}", options.collect::<Vec<_>>().join(", "));
                Err(Error::parameter(
                    &self.name,
                    integer,
                    allowed,
                    "Give the number of an option.",
                ))
            }
            (Kind::Real(_), Value::Integer(integer)) => Err(Error::parameter(
                &self.name,
                integer,
                "a real number",
                "Set it as a real variable.",
            )),
            (_, Value::Real(real)) => Err(Error::parameter(
                &self.name,
                real,
                "a whole number",
                "Set it as an integer variable.",
            )),
        }
    }
}

/// Tells a table of variables from any other: FNV-1a, 64 bits, over crate version, names, causalities, types, units, ranges and starts.
pub fn fingerprint(rows: &[Variable]) -> u64 {
    let mut text = String::from(env!("CARGO_PKG_VERSION"));
    for row in rows {
        text.push_str(&format!("\n{} {:?} {:?}", row.name, row.causality, row.kind));
    }
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// A value of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Value {
    /// Of a [`Kind::Real`].
    Real(f64),
    /// Of any other [`Kind`].
    Integer(i64),
}

impl From<f64> for Value {
    fn from(real: f64) -> Self {
        Self::Real(real)
    }
}

impl From<i64> for Value {
    fn from(integer: i64) -> Self {
        Self::Integer(integer)
    }
}

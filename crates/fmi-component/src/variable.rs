//! What is known of a variable: the single source of the XML, of get and set, of range checks and of the documentation page.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::kind::Kind;
use crate::recommended::Recommended;
use crate::value::Value;

/// Name of the independent variable of every component.
pub const TIME: &str = "time";

/// Who sets a variable, and when (FMI 2.0 section 2.2.7, FMI 3.0 section 2.4.7.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Causality {
    /// Set by the user before initialisation ends, frozen from then on unless it is [tunable](Variable::tunable).
    Parameter,
    /// Computed from the parameters when initialisation ends, constant from then on unless a tunable parameter changes.
    CalculatedParameter,
    /// Set by the importer at every communication point.
    Input,
    /// Computed by the model.
    Output,
}

impl Causality {
    /// Whether the user or the importer gives the value: the model computes it otherwise.
    pub const fn is_settable(self) -> bool {
        matches!(self, Self::Parameter | Self::Input)
    }

    /// One word for tables.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Parameter => "parameter",
            Self::CalculatedParameter => "calculated",
            Self::Input => "input",
            Self::Output => "output",
        }
    }
}

/// When the value of a variable may change (FMI 2.0 section 2.2.7, FMI 3.0 section 2.4.7.4): see [`Table::variability`](crate::Table::variability).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variability {
    /// Never, once initialisation has ended.
    Fixed,
    /// Between steps, when the importer sets a tunable parameter.
    Tunable,
    /// At events or between steps.
    Discrete,
    /// At any time.
    Continuous,
}

impl Variability {
    /// The word of both standards.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Tunable => "tunable",
            Self::Discrete => "discrete",
            Self::Continuous => "continuous",
        }
    }
}

/// A variable's place in a terminal: the connector that FMI 3.0 describes in `terminalsAndIcons.xml`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct TerminalMember {
    /// Name of the terminal, such as `shaft`.
    pub terminal: &'static str,
    /// Name of the variable inside of it, such as `displacement`.
    pub member: &'static str,
}

/// All that is known of a variable but how its value is read: see [`Row`](crate::Row).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(bound(deserialize = "'de: 'static"))] // texts stay where the bytes are
pub struct Variable {
    /// Structured name, such as `spring.stiffness` or `body.angle[3]` (counted from 1).
    pub name: String,
    /// One sentence for the model description and the documentation page.
    pub description: String,
    /// Who sets it, and when.
    pub causality: Causality,
    /// What it holds.
    pub kind: Kind,
    /// A parameter that may change between steps too: the model takes it over at the beginning of the next step
    /// ([`Model::tune`](crate::Model::tune)).
    pub tunable: bool,
    /// A fixed parameter that says how the model computes and changes no result: restoring a state leaves it as it is.
    pub outside_states: bool,
    /// An input or output that changes at events or between steps alone, although it is a real.
    pub discrete: bool,
    /// Parameters, inputs and [`TIME`] that a computed variable depends on while the component is initialised. `None` says that
    /// it may depend on all of them.
    pub dependencies: Option<Arc<[&'static str]>>,
    /// Name of the variable of the same causality that is the time derivative of this one.
    pub derivative: Option<String>,
    /// Terminal that it belongs to.
    pub terminal: Option<TerminalMember>,
    /// Range in which the model makes sense, of a parameter: outside of it the simulation warns. No part of the fingerprint.
    pub recommended: Option<Recommended>,
}

impl Variable {
    /// Causality as one or two words for tables: that of a tunable parameter says so.
    pub const fn role(&self) -> &'static str {
        match self.tunable {
            true => "tunable parameter",
            false => self.causality.word(),
        }
    }

    /// Start value as the table stores it.
    pub fn start(&self) -> Value {
        match &self.kind {
            Kind::Real(quantity) | Kind::Single(quantity) => Value::Real(quantity.start),
            Kind::Integer { start, .. }
            | Kind::Long { start, .. }
            | Kind::Sized { start, .. }
            | Kind::Enumeration { start, .. } => Value::Integer(*start),
            Kind::Boolean { start } => Value::Integer((*start).into()),
            Kind::Text { start } => Value::Integer(start.len() as i64),
            Kind::Binary { start, .. } => Value::Integer(start.len() as i64),
        }
    }

    /// `value` as a text with the unit of this variable; of an enumeration its number.
    pub fn text(&self, value: Value) -> String {
        match (&self.kind, value) {
            (Kind::Real(quantity) | Kind::Single(quantity), Value::Real(real)) => quantity.unit.format(real),
            (Kind::Boolean { .. }, Value::Integer(integer)) => (integer != 0).to_string(),
            (Kind::Text { .. } | Kind::Binary { .. }, Value::Integer(length)) => format!("{length} bytes"),
            _ => value.to_string(),
        }
    }

    /// Value that `text` stands for; of an enumeration the name of an option or its number. The range is not checked.
    ///
    /// # Errors
    /// Text of another kind, with what is expected; a text or binary variable, which is set as such.
    pub fn parse(&self, text: &str) -> Result<Value> {
        let value = match self.kind {
            Kind::Real(_) | Kind::Single(_) => text.parse().map(Value::Real).ok(),
            Kind::Integer { .. } | Kind::Long { .. } | Kind::Sized { .. } => text.parse().map(Value::Integer).ok(),
            Kind::Enumeration { options, .. } => {
                let by_name = (1..).zip(options).find(|(_, (name, _))| *name == text);
                let number = by_name.map(|(number, _)| number).or_else(|| text.parse().ok());
                number.map(Value::Integer)
            }
            Kind::Boolean { .. } => match text {
                "true" | "1" => Some(Value::Integer(1)),
                "false" | "0" => Some(Value::Integer(0)),
                _ => None,
            },
            Kind::Text { .. } | Kind::Binary { .. } => None,
        };
        value.ok_or_else(|| {
            let digits = match self.kind {
                Kind::Real(_) | Kind::Single(_) => "Write it with digits, such as 2 or 1.5e-3.",
                _ => "Write it with digits alone, such as 2.",
            };
            let (allowed, remedy) = match self.kind {
                Kind::Real(_) | Kind::Single(_) => ("a number".into(), digits),
                Kind::Integer { .. } | Kind::Long { .. } | Kind::Sized { .. } => {
                    ("a whole number of 64 bits".into(), digits)
                }
                Kind::Enumeration { options, .. } => {
                    let names: Vec<&str> = options.iter().map(|(name, _)| *name).collect();
                    (format!("one of: {}", names.join(", ")), "Give an option by its name.")
                }
                Kind::Boolean { .. } => ("true or false".into(), "Write one of these."),
                Kind::Text { .. } | Kind::Binary { .. } => ("no number".into(), AS_BYTES),
            };
            Error::parameter(&self.name, text, allowed, remedy)
        })
    }

    /// Says whether `value` may be given to this variable, and if not, why and what to do.
    ///
    /// # Errors
    /// Another type, not finite, or out of range.
    #[inline]
    pub fn check(&self, value: Value) -> Result<()> {
        match self.signal(value) {
            Some(_) => Ok(()),
            None => self.check_any(value),
        }
    }

    /// The real in `value`, if this is a real variable of 64 bits that may be given it: the path of signals, small enough to be part of
    /// each setter.
    #[inline]
    pub(crate) fn signal(&self, value: Value) -> Option<f64> {
        match (&self.kind, value) {
            (Kind::Real(quantity), Value::Real(real))
                if real.is_finite() && (quantity.min..=quantity.max).contains(&real) =>
            {
                Some(real)
            }
            _ => None,
        }
    }

    fn check_any(&self, value: Value) -> Result<()> {
        let fits = match (&self.kind, value) {
            (Kind::Real(quantity) | Kind::Single(quantity), Value::Real(real)) => {
                real.is_finite() && (quantity.min..=quantity.max).contains(&real)
            }
            (
                Kind::Integer { range, .. } | Kind::Long { range, .. } | Kind::Sized { range, .. },
                Value::Integer(integer),
            ) => range.contains(&integer),
            (Kind::Enumeration { options, .. }, Value::Integer(integer)) => {
                (1..=options.len() as i64).contains(&integer)
            }
            (Kind::Boolean { .. }, Value::Integer(integer)) => matches!(integer, 0 | 1),
            (Kind::Text { .. } | Kind::Binary { .. }, _) => false,
            (Kind::Real(_) | Kind::Single(_), Value::Integer(_)) | (_, Value::Real(_)) => false,
        };
        if fits { Ok(()) } else { Err(self.refusal(value)) }
    }

    /// Says whether `bytes` may be given to this variable, and if not, why and what to do.
    ///
    /// # Errors
    /// It is no text and no binary variable; a text that is not UTF-8 or holds a zero byte, which would end it in C.
    pub fn check_bytes(&self, bytes: &[u8]) -> Result<()> {
        let (what, allowed, remedy) = match &self.kind {
            Kind::Binary { .. } => return Ok(()),
            Kind::Text { .. } if std::str::from_utf8(bytes).is_err() => ("bytes", "UTF-8", "Encode the text so."),
            Kind::Text { .. } if bytes.contains(&0) => ("a text with a zero byte", "none", "Leave it out."),
            Kind::Text { .. } => return Ok(()),
            Kind::Boolean { .. } => ("a text", "true or false", "Set it as a boolean variable."),
            _ => ("a text", "a number", "Set it as a variable of its type."),
        };
        Err(Error::parameter(&self.name, what, allowed, remedy))
    }

    #[cold]
    fn refusal(&self, value: Value) -> Error {
        let in_range = "Give a value in this range.";
        let (value, allowed, remedy) = match (&self.kind, value) {
            (Kind::Real(quantity) | Kind::Single(quantity), Value::Real(real)) => {
                let bounds = [quantity.min, quantity.max];
                let allowed = match bounds.map(|bound| (bound.is_finite(), Value::Real(bound))) {
                    [(false, _), (false, _)] => "a finite number".into(),
                    [(true, low), (false, _)] => format!("a finite number, {low} or more"),
                    [(false, _), (true, high)] => format!("a finite number, {high} or less"),
                    [(_, low), (_, high)] => format!("a finite number from {low} to {high}"),
                };
                (quantity.unit.format(real), allowed, in_range)
            }
            (
                Kind::Integer { range, .. } | Kind::Long { range, .. } | Kind::Sized { range, .. },
                Value::Integer(integer),
            ) => {
                let allowed = format!("a whole number from {} to {}", range.start(), range.end());
                (integer.to_string(), allowed, in_range)
            }
            (Kind::Enumeration { options, .. }, Value::Integer(integer)) => {
                let options = (1..)
                    .zip(*options)
                    .map(|(number, (name, _))| format!("{number} {name}"));
                let allowed = format!("one of: {}", options.collect::<Vec<_>>().join(", "));
                (integer.to_string(), allowed, "Give the number of an option.")
            }
            (Kind::Boolean { .. }, _) => (
                value.to_string(),
                "true (1) or false (0)".into(),
                "Set it as a boolean variable.",
            ),
            (Kind::Text { .. }, _) => (value.to_string(), "a text".into(), AS_BYTES),
            (Kind::Binary { .. }, _) => (value.to_string(), "bytes".into(), AS_BYTES),
            (Kind::Real(_) | Kind::Single(_), Value::Integer(integer)) => (
                integer.to_string(),
                "a real number".into(),
                "Set it as a real variable.",
            ),
            (_, Value::Real(real)) => (
                Value::Real(real).to_string(),
                "a whole number".into(),
                "Set it as an integer variable.",
            ),
        };
        Error::parameter(&self.name, value, allowed, remedy)
    }
}

/// Remedy for numbers given to variables that hold none.
const AS_BYTES: &str = "Set it as a text or as bytes.";

/// Distinguishes a table of variables from any other: FNV-1a, 64 bits, over the model's version, names, causalities, types, units, ranges
/// start values and what is tunable.
pub fn fingerprint<'a>(version: &str, variables: impl IntoIterator<Item = &'a Variable>) -> u64 {
    let mut text = String::from(version);
    for variable in variables {
        text.push_str(&format!(
            "\n{} {:?} {:?}",
            variable.name, variable.causality, variable.kind
        ));
        if variable.tunable {
            text.push_str(" tunable");
        }
        if variable.discrete {
            text.push_str(" discrete");
        }
    }
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

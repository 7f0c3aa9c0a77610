//! What a variable holds: type, unit, range and start.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::leaked::leaked;
use crate::unit::Unit;

/// What a variable holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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
        #[serde(deserialize_with = "leaked")]
        options: &'static [(&'static str, &'static str)],
        /// Start value.
        start: i64,
    },
    /// True or false, held as 1 or 0.
    Boolean {
        /// Start value.
        start: bool,
    },
    /// A continuous quantity of 32 bits. FMI 2.0 has only 64 bits: values are rounded to 32.
    Single(Quantity),
    /// A whole number of another size. FMI 2.0 has only 32 bits with sign and narrows the range.
    Sized {
        /// Size and sign.
        size: WholeSize,
        /// Allowed values.
        range: RangeInclusive<i64>,
        /// Start value.
        start: i64,
    },
    /// A text in UTF-8 without zero bytes. As a [`Value`](crate::Value) it is its length in bytes.
    Text {
        /// Start value.
        start: Cow<'static, str>,
    },
    /// Any bytes. As a [`Value`](crate::Value) they are their number. FMI 2.0 has no such type: the variable is left out there.
    Binary {
        /// Start value.
        start: Cow<'static, [u8]>,
        /// What the bytes are, such as `image/png`; `application/octet-stream` if nothing is known.
        mime_type: Cow<'static, str>,
    },
}

/// Size and sign of a whole number that is neither an `Int32` nor an `Int64` of FMI 3.0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum WholeSize {
    /// `Int8`
    Int8,
    /// `UInt8`
    UInt8,
    /// `Int16`
    Int16,
    /// `UInt16`
    UInt16,
    /// `UInt32`
    UInt32,
    /// `UInt64`, up to 2^63 - 1: values are held with a sign.
    UInt64,
}

impl WholeSize {
    /// Name of the type in FMI 3.0.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Int8 => "Int8",
            Self::UInt8 => "UInt8",
            Self::Int16 => "Int16",
            Self::UInt16 => "UInt16",
            Self::UInt32 => "UInt32",
            Self::UInt64 => "UInt64",
        }
    }
}

impl Kind {
    /// One word for tables.
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Real(_) | Self::Single(_) => "real",
            Self::Integer { .. } | Self::Long { .. } | Self::Sized { .. } => "integer",
            Self::Enumeration { .. } => "option",
            Self::Boolean { .. } => "boolean",
            Self::Text { .. } => "text",
            Self::Binary { .. } => "binary",
        }
    }

    /// Unit of its numbers.
    pub const fn unit(&self) -> Unit {
        match self {
            Self::Real(quantity) | Self::Single(quantity) => quantity.unit,
            _ => Unit::ONE,
        }
    }

    /// Unit, range and start of a real of either size.
    pub const fn quantity(&self) -> Option<&Quantity> {
        match self {
            Self::Real(quantity) | Self::Single(quantity) => Some(quantity),
            _ => None,
        }
    }

    /// Range and start of a whole number of any size.
    pub const fn whole(&self) -> Option<(&RangeInclusive<i64>, i64)> {
        match self {
            Self::Integer { range, start } | Self::Long { range, start } | Self::Sized { range, start, .. } => {
                Some((range, *start))
            }
            _ => None,
        }
    }

    /// Start value of a text or of a binary variable as bytes; none of a number.
    pub fn start_bytes(&self) -> Option<&[u8]> {
        match self {
            Self::Text { start } => Some(start.as_bytes()),
            Self::Binary { start, .. } => Some(start),
            _ => None,
        }
    }

    /// Smallest and largest allowed value; infinite for none. Whole numbers beyond 2^53 are rounded. Of a text or binary variable
    /// that of its length.
    pub fn bounds(&self) -> [f64; 2] {
        match self {
            Self::Real(quantity) | Self::Single(quantity) => [quantity.min, quantity.max],
            Self::Integer { range, .. } | Self::Long { range, .. } | Self::Sized { range, .. } => {
                [*range.start() as f64, *range.end() as f64]
            }
            Self::Enumeration { options, .. } => [1.0, options.len() as f64],
            Self::Boolean { .. } => [0.0, 1.0],
            Self::Text { .. } | Self::Binary { .. } => [0.0, f64::INFINITY],
        }
    }

    /// Names of the options, none unless it is an enumeration; the first has the number 1.
    pub fn options(&self) -> impl Iterator<Item = &'static str> + use<> {
        let options = match *self {
            Self::Enumeration { options, .. } => options,
            _ => &[],
        };
        options.iter().map(|(name, _)| *name)
    }
}

/// Unit, range and start of a real variable.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(bound(deserialize = "'de: 'static"))] // texts stay where the bytes are
pub struct Quantity {
    /// Unit.
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

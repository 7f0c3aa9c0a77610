//! A value of a variable, as a number and as text.

use std::fmt;

use serde::{Deserialize, Serialize};

/// A value of a variable. Its text reads back as the same bits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Value {
    /// Of a [`Kind::Real`](crate::Kind::Real).
    Real(f64),
    /// Of any other [`Kind`](crate::Kind): true is 1 and false is 0, and a text or a binary variable is its length in bytes.
    Integer(i64),
}

impl Value {
    /// The value as a real number, for tables and statistics; whole numbers beyond 2^53 are rounded.
    pub fn to_f64(self) -> f64 {
        match self {
            Self::Real(real) => real,
            Self::Integer(integer) => integer as f64,
        }
    }
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

impl From<bool> for Value {
    fn from(boolean: bool) -> Self {
        Self::Integer(boolean.into())
    }
}

/// The shortest text; powers of ten where zeros would fill the line.
impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Integer(integer) => write!(formatter, "{integer}"),
            Self::Real(real) => {
                let plain = *real == 0.0 || !real.is_finite() || (1e-4..1e6).contains(&real.abs());
                match plain {
                    true => write!(formatter, "{real}"),
                    false => write!(formatter, "{real:e}"),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back_as_the_same_bits() {
        for value in [
            0.0,
            -0.0,
            0.1,
            1e-300,
            5e-324,
            9.8,
            1.0 / 3.0,
            -7.757e-5,
            1e12,
            f64::MAX,
            123456.789,
        ] {
            let text = Value::Real(value).to_string();
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
        }
    }
}

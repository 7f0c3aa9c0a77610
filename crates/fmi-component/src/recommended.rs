//! The range in which a model makes sense, narrower than the one that is allowed.
//!
//! A value outside of what is allowed is refused ([`Variable::check`](crate::Variable::check)). One outside of what is recommended
//! is computed as it is, and the simulation
//! warns of it ([`Simulation::warnings`](crate::Simulation::warnings)).

use std::fmt;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::unit::Unit;
use crate::value::Value;

/// How a quantity gets the real parameter of a name.
pub type RealOf<'a> = &'a dyn Fn(&str) -> f64;

/// A quantity that several parameters make together, such as the peak acceleration of a sine over gravity.
#[derive(Clone, Copy, Serialize, Deserialize)]
pub struct Derived {
    /// What it is, such as `peak acceleration over gravity`.
    pub name: &'static str,
    /// Its unit.
    pub unit: Unit,
    /// Its value; the argument gives the real parameter of a name. No number in a description that a library gave of itself.
    #[serde(skip, default = "unknown")]
    pub value: fn(RealOf) -> f64,
}

/// A function does not travel.
fn unknown() -> fn(RealOf) -> f64 {
    |_| f64::NAN
}

// The function belongs to the name: addresses of functions say nothing.
impl PartialEq for Derived {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.unit == other.unit
    }
}

impl fmt::Debug for Derived {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Derived({} in {})", self.name, self.unit.name)
    }
}

/// The recommended range of a parameter, or of a quantity that it has part in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recommended {
    /// The quantity; `None` for the parameter itself.
    pub of: Option<Derived>,
    /// The range; an end may be infinite.
    pub range: RangeInclusive<f64>,
    /// What is wrong outside of it, as the end of a sentence.
    pub reason: &'static str,
}

impl Recommended {
    /// The range with what it is of: `0 to 2`, or `peak acceleration over gravity: at least 1.1`.
    pub fn text(&self) -> String {
        match &self.of {
            None => self.ends(),
            Some(derived) if derived.unit == Unit::ONE => format!("{}: {}", derived.name, self.ends()),
            Some(derived) => format!("{}: {} {}", derived.name, self.ends(), derived.unit.name),
        }
    }

    /// What is to be said of the parameter `name`, whose value reads `text`, if it is outside; `real` gives any real parameter.
    pub fn warning(&self, name: &str, text: &str, real: RealOf) -> Option<String> {
        let value = match &self.of {
            None => real(name),
            Some(derived) => (derived.value)(real),
        };
        // A quotient of zeros is no number, and says nothing of the run.
        if value.is_nan() || self.range.contains(&value) {
            return None;
        }
        let what = match &self.of {
            None => format!("{name} = {text} is"),
            Some(derived) => {
                let value = derived.unit.format(three_digits(value));
                format!("{name} = {text} makes the {} {value},", derived.name)
            }
        };
        let ends = self.ends();
        Some(format!(
            "{what} outside of the recommended range ({ends}): {}",
            self.reason
        ))
    }

    fn ends(&self) -> String {
        let (start, end) = (Value::Real(*self.range.start()), Value::Real(*self.range.end()));
        match (self.range.start().is_finite(), self.range.end().is_finite()) {
            (true, true) => format!("{start} to {end}"),
            (true, false) => format!("at least {start}"),
            (false, true) => format!("at most {end}"),
            (false, false) => "any".into(),
        }
    }
}

/// As many digits as tell how far off a value is.
fn three_digits(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn real(name: &str) -> f64 {
        match name {
            "length" => 3.0,
            "width" => 0.5,
            _ => f64::NAN,
        }
    }

    fn of_itself(range: RangeInclusive<f64>) -> Recommended {
        Recommended {
            of: None,
            range,
            reason: "it bends.",
        }
    }

    #[test]
    fn a_value_inside_or_at_an_end_is_not_warned_of() {
        for range in [0.0..=3.0, 3.0..=4.0, 1.0..=f64::INFINITY] {
            assert_eq!(of_itself(range).warning("length", "3 m", &real), None);
        }
    }

    #[test]
    fn a_value_outside_is_named_with_range_and_reason() {
        let told = of_itself(0.0..=1.0).warning("length", "3 m", &real).unwrap();
        assert_eq!(
            told,
            "length = 3 m is outside of the recommended range (0 to 1): it bends."
        );
    }

    #[test]
    fn a_derived_quantity_is_judged_and_named() {
        let slenderness = Recommended {
            of: Some(Derived {
                name: "length over width",
                unit: Unit::ONE,
                value: |real| real("length") / real("width"),
            }),
            range: f64::NEG_INFINITY..=4.0,
            reason: "it bends.",
        };
        assert_eq!(slenderness.text(), "length over width: at most 4");
        assert_eq!(
            slenderness.warning("length", "3 m", &real).unwrap(),
            "length = 3 m makes the length over width 6, outside of the recommended range (at most 4): it bends."
        );
    }

    #[test]
    fn a_quantity_that_is_no_number_is_not_warned_of() {
        assert_eq!(of_itself(0.0..=1.0).warning("height", "nothing", &real), None);
    }
}

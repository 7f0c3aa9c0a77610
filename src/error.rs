//! What a law or a shape refuses: a parameter, its value, what is allowed, the remedy.
//!
//! Scenes turn it into an error of the component ([`fmi_component::Error`], which is [`crate::Error`]).

use thiserror::Error;

/// A parameter that physics cannot work with.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{name} = {value} is not allowed: {allowed}. {remedy}")]
pub struct Error {
    /// The variable's name as in the model description, such as `box.width`.
    pub name: String,
    /// The value that was given, as text.
    pub value: String,
    /// What is allowed, with numbers.
    pub allowed: String,
    /// What to do about it.
    pub remedy: String,
}

impl Error {
    /// The refusal of a parameter.
    pub fn parameter(
        name: impl Into<String>,
        value: impl ToString,
        allowed: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self {
            name: name.into(),
            value: value.to_string(),
            allowed: allowed.into(),
            remedy: remedy.into(),
        }
    }
}

/// A number in a message: its shortest text, which reads back as the same bits, with powers of ten where zeros would fill the
/// line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shortest(pub f64);

impl std::fmt::Display for Shortest {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self(number) = *self;
        match number == 0.0 || !number.is_finite() || (1e-4..1e6).contains(&number.abs()) {
            true => write!(formatter, "{number}"),
            false => write!(formatter, "{number:e}"),
        }
    }
}

/// Whether all numbers are finite, and so far from overflow that what is computed from them is finite too.
pub(crate) fn are_sane(numbers: impl IntoIterator<Item = f64>) -> bool {
    numbers.into_iter().all(|number| number.abs() < 1e100)
}

/// Result of anything that can refuse a parameter.
pub type Result<T> = std::result::Result<T, Error>;

//! What a check found: faults, each with its place, and what could not be checked.

use std::fmt;

/// A fault of an FMU.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// File in the FMU, with the line where that is known, such as `modelDescription.xml:12`.
    pub place: String,
    /// The thing, its value, and what is allowed.
    pub what: String,
    /// What to do about it.
    pub remedy: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}. {}", self.place, self.what, self.remedy)
    }
}

/// What a check of an FMU found.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CheckReport {
    /// Faults in the order in which they were found; none in an FMU that passes.
    pub faults: Vec<Fault>,
    /// What was compared, a line each.
    pub done: Vec<String>,
    /// What could not be, and why, a line each.
    pub left_out: Vec<String>,
}

impl CheckReport {
    /// Notes a fault.
    pub(super) fn fault(&mut self, place: impl Into<String>, what: impl Into<String>, remedy: impl Into<String>) {
        self.faults.push(Fault {
            place: place.into(),
            what: what.into(),
            remedy: remedy.into(),
        });
    }
}

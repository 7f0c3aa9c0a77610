//! What can go wrong, said so that the reader can mend it: the thing, its value, what is allowed, the remedy.

use thiserror::Error;

use crate::unit::Unit;

/// Every refusal of the library. Nothing is silently repaired.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Error {
    /// A parameter outside what the model can do; known before anything runs.
    #[error("{name} = {value} is not allowed: {allowed}. {remedy}")]
    Parameter {
        /// The variable's name as in the model description, such as `spring.stiffness`.
        name: String,
        /// The value that was given, as text.
        value: String,
        /// What is allowed, with numbers.
        allowed: String,
        /// What to do about it.
        remedy: String,
    },
    /// A step that cannot be done. The state is the one before the step, so that the caller may retry.
    #[error("{model}: step refused at t = {}: {what}. {remedy}", Unit::SECOND.format(*.time))]
    Step {
        /// The model's name.
        model: &'static str,
        /// Simulated time at which the trouble showed \[s\].
        time: f64,
        /// What happened, with numbers.
        what: String,
        /// What to do about it.
        remedy: String,
    },
    /// Saved state that is not ours, is damaged, or belongs to other parameters.
    #[error("state refused: {what}. {remedy}")]
    State {
        /// What is wrong with it.
        what: String,
        /// What to do about it.
        remedy: String,
    },
    /// A file that cannot be read or written.
    #[error("{path}: {what}. {remedy}")]
    File {
        /// The file.
        path: String,
        /// What went wrong.
        what: String,
        /// What to do about it.
        remedy: String,
    },
    /// A call that the boundary cannot accept: out of order, wrong length, unknown variable, unsupported function.
    /// Nothing has changed.
    #[error("{what}. {remedy}")]
    Call {
        /// What was asked, in which phase, and why it is refused.
        what: String,
        /// What to do about it.
        remedy: String,
    },
}

impl Error {
    /// Builds [`Error::Parameter`].
    pub fn parameter(
        name: impl Into<String>,
        value: impl ToString,
        allowed: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self::Parameter {
            name: name.into(),
            value: value.to_string(),
            allowed: allowed.into(),
            remedy: remedy.into(),
        }
    }

    /// Builds [`Error::File`].
    pub fn file(path: &std::path::Path, what: impl ToString, remedy: impl Into<String>) -> Self {
        Self::File {
            path: path.display().to_string(),
            what: what.to_string(),
            remedy: remedy.into(),
        }
    }

    /// Builds [`Error::Call`].
    pub fn call(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::Call {
            what: what.into(),
            remedy: remedy.into(),
        }
    }

    /// Builds the [`Error::Step`] of a call that asks for more than a call may.
    pub fn too_much_work(model: &'static str, time: f64, asked: impl Into<String>) -> Self {
        Self::Step {
            model,
            time,
            what: format!("the step asks for {}, more than one call may do", asked.into()),
            remedy: "Take shorter communication steps.".into(),
        }
    }

    /// Builds [`Error::State`].
    pub fn state(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::State {
            what: what.into(),
            remedy: remedy.into(),
        }
    }
}

/// Result of anything that can be refused.
pub type Result<T> = std::result::Result<T, Error>;

//! Log messages to the importer: its own environment, only categories that the model description declares.

use std::ffi::{CStr, CString, c_int};

use super::types::{Fmi2Log, Fmi3Log, Opaque, Status};
use crate::error::{Error, Result};
use crate::standard::LOG_CATEGORIES;

/// What a message is about; the discriminant is the index in [`LOG_CATEGORIES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Category {
    /// A refused call.
    Error,
    /// A refused step.
    Discard,
    /// Something doubtful.
    Warning,
    /// Life cycle.
    Events,
}

/// The importer's callback with the environment that it wants back.
pub enum Callback {
    /// FMI 2.0: with the instance's name and a format string.
    Two {
        /// Callback; an importer may leave it out.
        log: Option<Fmi2Log>,
        /// `componentEnvironment`, handed back untouched.
        environment: Opaque,
        /// Name of the instance.
        name: CString,
    },
    /// FMI 3.0: with a plain message.
    Three {
        /// Callback; an importer may leave it out.
        log: Option<Fmi3Log>,
        /// `instanceEnvironment`, handed back untouched.
        environment: Opaque,
    },
}

/// Sends messages of the categories that are switched on.
pub struct Logger {
    callback: Callback,
    on: [bool; LOG_CATEGORIES.len()],
}

impl Logger {
    /// `logging_on` is about debugging only: errors and discarded steps are logged in any case, since a status alone does not
    /// say what to do. FMI 2.0 has it so, and so has FMI 3.0 on its main branch; 3.0.2 leaves it open.
    pub fn new(callback: Callback, logging_on: bool) -> Self {
        let mut on = [true; LOG_CATEGORIES.len()];
        on[Category::Events as usize] = logging_on;
        Self { callback, on }
    }

    /// Says why no instance was made, whatever is switched on: both standards ask for it.
    pub fn refuse(&mut self, message: &str) {
        self.on[Category::Error as usize] = true;
        self.log(Status::Error, Category::Error, message);
    }

    /// Leaves the named categories on and no other; all if none is named. Switches all off if not `on`.
    ///
    /// # Errors
    /// A category that the model description does not declare; nothing is switched then.
    pub fn switch(&mut self, on: bool, names: &[String]) -> Result<()> {
        let mut chosen = [names.is_empty(); LOG_CATEGORIES.len()];
        for name in names {
            let Some(index) = LOG_CATEGORIES.iter().position(|(known, _)| known == name) else {
                let declared: Vec<_> = LOG_CATEGORIES.iter().map(|(known, _)| *known).collect();
                return Err(Error::call(
                    format!("the log category {name:?} is unknown"),
                    format!("Declared are: {}.", declared.join(", ")),
                ));
            };
            chosen[index] = true;
        }
        self.on = chosen.map(|chosen| chosen && on);
        Ok(())
    }

    /// Whether messages of a category are sent.
    pub fn is_on(&self, category: Category) -> bool {
        self.on[category as usize]
    }

    /// Sends `message` if its category is on.
    pub fn log(&self, status: Status, category: Category, message: &str) {
        const NAMES: [&CStr; LOG_CATEGORIES.len()] = [
            c"logStatusError",
            c"logStatusDiscard",
            c"logStatusWarning",
            c"logEvents",
        ];
        if !self.on[category as usize] {
            return;
        }
        let category = NAMES[category as usize].as_ptr();
        let clean = |message: String| {
            // A number sign would start a reference to a variable.
            CString::new(message.replace('\0', " ").replace('#', "##")).unwrap_or_default()
        };
        match &self.callback {
            Callback::Two {
                log: Some(log),
                environment,
                name,
            } => {
                // The message is a printf format by the standard, but not every importer expands it: with its percent
                // signs doubled and no further argument it is safe in both.
                let message = clean(message.replace('%', "%%"));
                // SAFETY: the importer's own callback with its own environment; the strings outlive the call and the
                // format takes no argument.
                unsafe { log(*environment, name.as_ptr(), status as c_int, category, message.as_ptr()) }
            }
            Callback::Three {
                log: Some(log),
                environment,
            } => {
                let message = clean(message.into());
                // SAFETY: the importer's own callback with its own environment; the strings outlive the call.
                unsafe { log(*environment, status as c_int, category, message.as_ptr()) }
            }
            Callback::Two { log: None, .. } | Callback::Three { log: None, .. } => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn categories_are_those_declared() {
        assert_eq!(LOG_CATEGORIES[Category::Error as usize].0, "logStatusError");
        assert_eq!(LOG_CATEGORIES[Category::Discard as usize].0, "logStatusDiscard");
        assert_eq!(LOG_CATEGORIES[Category::Warning as usize].0, "logStatusWarning");
        assert_eq!(LOG_CATEGORIES[Category::Events as usize].0, "logEvents");
    }
}

//! Names and numbers that a component and its model description share.

/// Value reference of the variable at `position`; 0 is the independent variable `time`.
pub const fn value_reference(position: usize) -> u32 {
    position as u32 + 1
}

/// Value reference of the independent variable `time`.
pub const TIME_REFERENCE: u32 = 0;

/// Parameter to which an importer's relative tolerance goes, where a model has it.
pub const TOLERANCE: &str = "tolerance";

/// Categories of log messages, as declared in the model description: name and description.
pub const LOG_CATEGORIES: [(&str, &str); 4] = [
    (
        "logStatusError",
        "Calls that were refused, with the reason and the remedy",
    ),
    (
        "logStatusDiscard",
        "Steps that could not be done; the state is the one before the step",
    ),
    ("logEvents", "Life cycle: instantiated, initialised, terminated, reset"),
    (
        "logStatusWarning",
        "What is doubtful about the parameters, such as a seed that decides nothing",
    ),
];

//! Refusals of a simulation, as the user should read them.

use crate::error::Error;
use crate::info::ModelInfo;
use crate::values::Values;

/// Parameters that are named at most where another is to blame.
const MOST_NAMED: usize = 6;

/// Name and variant of a model: `packing, engine event-driven, drive sine`.
pub fn named(info: &ModelInfo) -> String {
    let variant = info.variant.iter().map(|(key, value)| format!(", {key} {value}"));
    info.name.to_string() + &variant.collect::<String>()
}

/// The refusal of a parameter that nobody has set, with what was set: of two values that do not go together the model names one,
/// and the user may have given the other.
#[cold]
pub fn name_what_was_set(error: Error, values: &Values) -> Error {
    let Error::Parameter {
        name,
        value,
        allowed,
        remedy,
    } = error
    else {
        return error;
    };
    let given = values.table().settable().iter().zip(values.as_slice());
    let set: Vec<_> = given.filter(|(variable, value)| variable.start() != **value).collect();
    let is_set = set.iter().any(|(variable, _)| variable.name == name);
    let texts = set.iter().take(MOST_NAMED);
    let texts: Vec<_> = texts
        .map(|(variable, value)| format!("{} = {}", variable.name, variable.text(**value)))
        .collect();
    let remedy = match is_set || texts.is_empty() {
        true => remedy,
        false => format!("{remedy} {name} was not set, but {}.", texts.join(", ")),
    };
    Error::Parameter {
        name,
        value,
        allowed,
        remedy,
    }
}

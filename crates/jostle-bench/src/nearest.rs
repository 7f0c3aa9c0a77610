//! Refusal of a name that nothing has, with the one that may have been meant.

use jostle::Error;

/// Likeness of Jaro and Winkler from which on a name is proposed.
const ALIKE: f64 = 0.8;

/// The refusal of the value `given` of `option`, which must be one of the `known` names.
pub fn unknown(option: &str, given: &str, known: &[&str]) -> Error {
    let likeness = |name: &&&str| strsim::jaro_winkler(&given.to_lowercase(), name);
    let near = known.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let question = near
        .filter(|name| likeness(name) >= ALIKE)
        .map(|name| format!("Did you mean {name}? "));
    let remedy = question.unwrap_or_default() + "Name one of these.";
    Error::parameter(option, given, format!("one of: {}", known.join(", ")), remedy)
}

//! The known name that is most like a wrong one.

use jostle::Error;

/// Likeness of Jaro and Winkler from which on a name is proposed.
const ALIKE: f64 = 0.8;

/// The most similar of the `known` names, if one is similar; a part between dots counts as the whole.
pub fn nearest<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let given = given.to_lowercase();
    let likeness = |name: &str| {
        let parts = name.split('.').map(|part| 0.99 * strsim::jaro_winkler(&given, part));
        parts.fold(strsim::jaro_winkler(&given, name), f64::max)
    };
    let scored = known.into_iter().map(|name| (likeness(name), name));
    let best = scored.reduce(|best, next| if next.0 > best.0 { next } else { best })?;
    (best.0 >= ALIKE).then_some(best.1)
}

/// `error` with a question before its remedy, if a known name is similar to the value that it refuses.
pub fn did_you_mean<'a>(error: Error, known: impl IntoIterator<Item = &'a str>) -> Error {
    match error {
        Error::Parameter {
            name,
            value,
            allowed,
            remedy,
        } => {
            let question = nearest(&value, known).map(|near| format!("Did you mean {near}? "));
            let remedy = question.unwrap_or_default() + &remedy;
            Error::parameter(name, value, allowed, remedy)
        }
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_keyboard_finds_its_name_and_nonsense_finds_none() {
        let known = ["contact.friction", "contact.normal_stiffness", "disk.radius", "seed"];
        let found = |given| nearest(given, known);
        assert_eq!(found("contact.frictoin"), Some("contact.friction"));
        assert_eq!(found("Friction"), Some("contact.friction"));
        assert_eq!(found("sed"), Some("seed"));
        assert_eq!(found("disk.radii"), Some("disk.radius"));
        assert_eq!(found("zzz"), None);
        assert_eq!(found(""), None);
    }
}

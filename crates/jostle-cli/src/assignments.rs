//! `--set name=value`: text in, checked values of a simulation out.

use jostle::scene::DynSimulation;
use jostle::{Error, Result};

use crate::nearest::did_you_mean;

/// Sets these parameters and inputs of a simulation that has not started.
///
/// # Errors
/// Text that is no assignment, a name that the scene has not, that cannot be set or that comes twice, a value out of range.
pub fn assign(simulation: &mut dyn DynSimulation, assignments: &[String]) -> Result<()> {
    let pairs = split(assignments, "NAME=VALUE", "contact.friction=0.2")?;
    pairs
        .into_iter()
        .try_for_each(|(name, text)| assign_one(simulation, name, text))
}

/// Name and text of each assignment.
///
/// # Errors
/// Text that is not of the `form`, or two assignments to one name.
pub fn split<'a>(assignments: &'a [String], form: &str, example: &str) -> Result<Vec<(&'a str, &'a str)>> {
    let mut pairs: Vec<(&str, &str)> = Vec::new();
    for assignment in assignments {
        let (name, text) = assignment.split_once('=').ok_or_else(|| {
            let remedy = format!("Write it as in --set {example}.");
            Error::parameter("--set", assignment, form, remedy)
        })?;
        let (name, text) = (name.trim(), text.trim());
        if let Some((_, earlier)) = pairs.iter().find(|(known, _)| *known == name) {
            let allowed = format!("one value for each name, and {name} = {earlier} is set before");
            return Err(Error::parameter(
                "--set",
                assignment,
                allowed,
                "Leave one of the two out.",
            ));
        }
        pairs.push((name, text));
    }
    Ok(pairs)
}

fn assign_one(simulation: &mut dyn DynSimulation, name: &str, text: &str) -> Result<()> {
    let refused = |remedy: &str| Error::parameter("--set", name, "a parameter or input of this scene", remedy);
    let table = simulation.values().table();
    let Some(position) = table.position(name) else {
        let error = refused("List the names with: jostle describe SCENE, with the same --drive.");
        let settable = table.variables().iter().filter(|known| known.causality.is_settable());
        return Err(did_you_mean(error, settable.map(|known| known.name.as_str())));
    };
    let variable = &table.variables()[position];
    if !variable.causality.is_settable() {
        return Err(refused("The scene computes it; set a parameter instead."));
    }
    let value = variable
        .parse(text)
        .map_err(|error| did_you_mean(error, variable.kind.options()))?;
    simulation.set_at(position, value)
}

#[cfg(test)]
mod tests {
    use jostle::scene::Values;

    use super::*;
    use crate::clock;

    fn set(assignments: &[&str]) -> Result<Values> {
        let assignments: Vec<String> = assignments.iter().map(|text| text.to_string()).collect();
        let mut clock = clock::prepare(2);
        assign(&mut clock, &assignments).map(|()| clock.values().clone())
    }

    #[test]
    fn spaces_around_name_and_value_do_not_count() {
        let values = set(&["rate = 2.5", "seed=7"]).unwrap();
        assert_eq!((values.real("rate"), values.integer("seed")), (2.5, 7));
    }

    #[test]
    fn a_name_that_is_set_twice_is_refused_with_both_values() {
        let message = set(&["rate=2", "seed=7", "rate = 3"]).unwrap_err().to_string();
        assert!(message.starts_with("--set = rate = 3 is not allowed"), "{message}");
        assert!(message.contains("rate = 2 is set before"), "{message}");
    }

    #[test]
    fn options_go_by_name_or_number() {
        assert_eq!(set(&["sense=back"]).unwrap().integer("sense"), 2);
        assert_eq!(set(&["sense=1"]).unwrap().integer("sense"), 1);
    }

    #[test]
    fn each_wrong_assignment_has_its_own_message() {
        let message_of = |text| set(&[text]).unwrap_err().to_string();
        assert!(message_of("rate").starts_with("--set = rate is not allowed: NAME=VALUE"));
        assert!(message_of("rat=1").contains("a parameter or input of this scene. Did you mean rate? List"));
        assert!(!message_of("zzz=1").contains("Did you mean"));
        assert!(message_of("sense=bakc").contains("Did you mean back? Give an option"));
        assert!(message_of("angle[1]=1").contains("The scene computes it"));
        assert!(message_of("rate=fast").starts_with("rate = fast is not allowed: a number"));
        assert!(message_of("seed=1.5").starts_with("seed = 1.5 is not allowed: a whole number"));
        assert!(message_of("sense=up").starts_with("sense = up is not allowed: one of: ahead, back"));
        assert!(message_of("sense=3").contains("one of: 1 ahead, 2 back"));
        assert!(message_of("rate=-1").contains("from 0 to 10"));
        assert!(message_of("rate=NaN").contains("from 0 to 10"));
    }
}

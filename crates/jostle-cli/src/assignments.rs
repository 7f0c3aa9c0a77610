//! `--set name=value`: text in, checked values of a simulation out.

use jostle::scene::DynSimulation;
use jostle::{Error, Result};

/// Sets these parameters and inputs of a simulation that has not started; of several to one name the last counts.
///
/// # Errors
/// Text that is no assignment, a name that the scene has not or that cannot be set, a value out of range.
pub fn assign(simulation: &mut dyn DynSimulation, assignments: &[String]) -> Result<()> {
    assignments.iter().try_for_each(|assignment| {
        let (name, text) = assignment.split_once('=').ok_or_else(|| {
            let remedy = "Write it as in --set contact.friction=0.2.";
            Error::parameter("--set", assignment, "NAME=VALUE", remedy)
        })?;
        assign_one(simulation, name.trim(), text.trim())
    })
}

fn assign_one(simulation: &mut dyn DynSimulation, name: &str, text: &str) -> Result<()> {
    let refused = |remedy: &str| {
        Err(Error::parameter(
            "--set",
            name,
            "a parameter or input of this scene",
            remedy,
        ))
    };
    let table = simulation.values().table();
    let Some(position) = table.position(name) else {
        return refused("List the names with: jostle describe SCENE, with the same --drive.");
    };
    let variable = &table.variables()[position];
    if !variable.causality.is_settable() {
        return refused("The scene computes it; set a parameter instead.");
    }
    let value = variable.parse(text)?;
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
    fn the_last_assignment_counts() {
        let values = set(&["rate = 2.5", "seed=7", "rate=3"]).unwrap();
        assert_eq!((values.real("rate"), values.integer("seed")), (3.0, 7));
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
        assert!(message_of("rat=1").contains("a parameter or input"));
        assert!(message_of("angle[1]=1").contains("The scene computes it"));
        assert!(message_of("rate=fast").starts_with("rate = fast is not allowed: a number"));
        assert!(message_of("seed=1.5").starts_with("seed = 1.5 is not allowed: a whole number"));
        assert!(message_of("sense=up").starts_with("sense = up is not allowed: one of: ahead, back"));
        assert!(message_of("sense=3").contains("one of: 1 ahead, 2 back"));
        assert!(message_of("rate=-1").contains("from 0 to 10"));
        assert!(message_of("rate=NaN").contains("from 0 to 10"));
    }
}

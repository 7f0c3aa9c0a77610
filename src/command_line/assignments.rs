//! `--set name=value`: text in, checked values of a scene out.

use std::sync::Arc;

use jostle::scene::{Causality, Choice, Scene, Table, Values};
use jostle::{Error, Result};

/// Start values of the scene with these assignments on top; of several to one name the last counts.
///
/// # Errors
/// Text that is no assignment, a name that the scene has not or that cannot be set, a value out of range.
pub fn values<S: Scene>(choice: Choice, assignments: &[String]) -> Result<Values> {
    let mut values = Values::new(Arc::new(Table::new(S::variables(choice))));
    for assignment in assignments {
        let Some((name, text)) = assignment.split_once('=') else {
            let remedy = "Write it as in --set contact.friction=0.2.";
            return Err(Error::parameter("--set", assignment, "NAME=VALUE", remedy));
        };
        assign(&mut values, name.trim(), text.trim())?;
    }
    Ok(values)
}

fn assign(values: &mut Values, name: &str, text: &str) -> Result<()> {
    let table = Arc::clone(values.table());
    let Some(position) = table.position(name) else {
        let remedy = "List the names with: jostle describe SCENE, with the same --drive.";
        return Err(Error::parameter(
            "--set",
            name,
            "a parameter or input of this scene",
            remedy,
        ));
    };
    let row = &table.rows()[position];
    if !matches!(row.causality, Causality::Parameter | Causality::Input) {
        let remedy = "The scene computes it; set a parameter instead.";
        return Err(Error::parameter(
            "--set",
            name,
            "a parameter or input of this scene",
            remedy,
        ));
    }
    let value = row.read(text)?;
    values.set(position, value)
}

#[cfg(test)]
mod tests {
    use super::super::test_scene::Clock;
    use super::*;

    fn set(assignments: &[&str]) -> Result<Values> {
        let assignments: Vec<String> = assignments.iter().map(|text| text.to_string()).collect();
        values::<Clock>(Choice { disks: 2 }, &assignments)
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
    fn wrong_assignments_are_told_apart() {
        let told = |text| set(&[text]).unwrap_err().to_string();
        assert!(told("rate").starts_with("--set = rate is not allowed: NAME=VALUE"));
        assert!(told("rat=1").contains("a parameter or input"));
        assert!(told("angle[1]=1").contains("The scene computes it"));
        assert!(told("rate=fast").starts_with("rate = fast is not allowed: a number"));
        assert!(told("seed=1.5").starts_with("seed = 1.5 is not allowed: a whole number"));
        assert!(told("sense=up").starts_with("sense = up is not allowed: one of: ahead, back"));
        assert!(told("sense=3").contains("one of: 1 ahead, 2 back"));
        assert!(told("rate=-1").contains("from 0 to 10"));
        assert!(told("rate=NaN").contains("from 0 to 10"));
    }
}

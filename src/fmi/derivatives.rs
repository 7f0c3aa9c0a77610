//! Which variable is the rate of change of which: the pairs behind output derivatives, input derivatives and the
//! attribute `derivative` of the model description.
//!
//! A pair is told by its names and has one causality: the input `base.velocity` is no derivative of the output
//! `base.position`, since it belongs to the beginning of the next step.

use crate::scene::{Causality, Table, Variable};

/// Last part of a name and that of its derivative. Besides, `torque.rate` is that of `torque`, whatever the name.
const PAIRS: [(&str, &str); 3] = [
    ("angle", "angular_velocity"),
    ("position", "velocity"),
    ("displacement", "velocity"),
];

/// Position of the row that is the time derivative of the row at `position`.
pub fn of(table: &Table, position: usize) -> Option<usize> {
    let row = table.rows().get(position)?;
    let (stem, index) = row.name.split_at(row.name.find('[').unwrap_or(row.name.len()));
    let derivative = match PAIRS.iter().find(|(name, _)| ends_with_part(stem, name)) {
        Some((_, rate)) => {
            let prefix = stem.trim_end_matches(|letter| letter != '.');
            table.position(&format!("{prefix}{rate}{index}"))?
        }
        None => table.position(&format!("{stem}.rate{index}"))?,
    };
    (table.rows()[derivative].causality == row.causality).then_some(derivative)
}

/// Whether any row of this causality has a derivative: the highest order offered is then 1, else 0.
pub fn any(table: &Table, causality: Causality) -> bool {
    let wanted = |row: &Variable| row.causality == causality;
    (0..table.rows().len()).any(|position| wanted(&table.rows()[position]) && of(table, position).is_some())
}

fn ends_with_part(name: &str, part: &str) -> bool {
    name.strip_suffix(part)
        .is_some_and(|rest| rest.is_empty() || rest.ends_with('.'))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Unit;

    #[test]
    fn pairs_are_of_one_causality_and_one_index() {
        let output = |name: &str| Variable::output(name, Unit::One, 1.0, "");
        let input = |name: &str| Variable::input(name, Unit::One, 1.0, "");
        let table = Table::new(vec![
            input("base.displacement"),
            input("base.velocity"),
            output("base.position"),
            output("disk.angle[1]"),
            output("disk.angle[2]"),
            output("disk.angular_velocity[2]"),
            output("rectangle"),
            output("angular_velocity"),
            input("torque"),
            input("torque.rate"),
        ]);
        let found: Vec<_> = (0..table.rows().len()).map(|position| of(&table, position)).collect();
        assert_eq!(
            found,
            [Some(1), None, None, None, Some(5), None, None, None, Some(9), None]
        );
        assert!(any(&table, Causality::Input) && any(&table, Causality::Output));
        assert!(!any(&table, Causality::Parameter));
    }
}

//! Rows `name[1]`, `name[2]`, ... or `name[1,1]`, `name[1,2]`, ... as one array variable of FMI 3.0, where the FMU was bundled so.
//!
//! The array has the value reference of its first element; the references of the others are not used. What the importer sets is put together
//! where the elements are reals that differ in nothing but their start values.

use crate::kind::Kind;
use crate::variable::Variable;

/// For each row how many elements the variable has that begins there: 1 for a scalar, 0 inside an array.
pub fn spans(rows: &[Variable]) -> Vec<usize> {
    let mut spans = vec![1; rows.len()];
    let mut first = 0;
    while first < rows.len() {
        let length = dimensions(&rows[first..]).map_or(1, |lengths| lengths.iter().product());
        spans[first..first + length].fill(0);
        spans[first] = length;
        first += length;
    }
    spans
}

/// Name of the array that begins with the row called `first`.
pub fn name(first: &str) -> &str {
    let stem = FIRST.iter().find_map(|ending| first.strip_suffix(ending));
    stem.unwrap_or(first)
}

/// Indices of the first element of an array with one and with two dimensions.
const FIRST: [&str; 2] = ["[1]", "[1,1]"];

/// Whether `row` is the first element of an array.
pub fn begins(row: &Variable) -> bool {
    let joins = !row.causality.is_settable() || matches!(row.kind, Kind::Real(_));
    joins && FIRST.iter().any(|ending| row.name.ends_with(ending))
}

/// Lengths of the array that begins with the first of `rows`, the outermost first; none if a scalar does. An array is as long as its elements
/// follow one another, row by row.
pub fn dimensions(rows: &[Variable]) -> Option<Vec<usize>> {
    let first = rows.first().filter(|row| begins(row))?;
    let stem = name(&first.name);
    let has = |position: usize, index: &str| {
        let row = rows.get(position);
        row.is_some_and(|row| row.name == format!("{stem}[{index}]") && is_alike(first, row))
    };
    if first.name.ends_with(FIRST[0]) {
        let count = (0..).take_while(|at| has(*at, &(at + 1).to_string())).count();
        return Some(vec![count]);
    }
    let columns = (0..).take_while(|at| has(*at, &format!("1,{}", at + 1))).count();
    let whole_row = |row: &usize| {
        let mut columns = (0..columns).map(|column| (row * columns + column, format!("{},{}", row + 1, column + 1)));
        columns.all(|(at, index)| has(at, &index))
    };
    let lines = (0..).take_while(whole_row).count();
    Some(vec![lines, columns])
}

/// Whether two rows can be elements of one array.
fn is_alike(first: &Variable, row: &Variable) -> bool {
    if !first.causality.is_settable() {
        return row.causality == first.causality;
    }
    let (Kind::Real(one), Kind::Real(other)) = (&first.kind, &row.kind) else {
        return false;
    };
    let other = crate::kind::Quantity {
        start: one.start,
        nominal: one.nominal,
        ..other.clone()
    };
    (row.causality, row.tunable, row.discrete) == (first.causality, first.tunable, first.discrete) && *one == other
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Row, Unit};

    #[test]
    fn runs_of_indices_are_arrays() {
        let output = |name: &str| Row::<()>::output(name, Unit::ONE, 1.0, "", |()| 0.0).variable;
        let parameter =
            |name: &str, end: f64, start: f64| Row::<()>::parameter(name, Unit::ONE, 0.0..=end, start, "").variable;
        let mut rows = vec![parameter("a[1]", 1.0, 0.5), parameter("a[2]", 1.0, 0.7)];
        rows.extend([parameter("b[1]", 1.0, 0.5), parameter("b[2]", 2.0, 0.5)]);
        rows.extend(["m[1,1]", "m[1,2]", "m[2,1]", "m[2,2]", "m[3,1]"].map(|name| parameter(name, 1.0, 0.5)));
        rows.extend(["x[1]", "x[2]", "x[3]", "y[1]", "z", "w[2]"].map(output));
        assert_eq!(
            spans(&rows),
            [2, 0, 1, 1, 4, 0, 0, 0, 1, 3, 0, 0, 1, 1, 1],
            "other ranges are other arrays"
        );
        assert_eq!(dimensions(&rows[4..]), Some(vec![2, 2]));
        assert_eq!((dimensions(&rows[9..]), dimensions(&rows[13..])), (Some(vec![3]), None));
        assert_eq!((name("x[1]"), name("m[1,1]"), name("z")), ("x", "m", "z"));
    }
}

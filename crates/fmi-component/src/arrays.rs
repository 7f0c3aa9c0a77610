//! Rows `name[1]`, `name[2]`, ... as one array variable of FMI 3.0, where the FMU was bundled so.
//!
//! The array has the value reference of its first element; the references of the others are not used. Only what the model
//! computes is put together: what an importer sets stays scalar.

use crate::variable::{Causality, Variable};

/// For each row how many elements the variable has that begins there: 1 for a scalar, 0 inside an array.
pub fn spans(rows: &[Variable]) -> Vec<usize> {
    let mut spans = vec![1; rows.len()];
    let mut first = 0;
    while first < rows.len() {
        let length = length(&rows[first..]);
        spans[first..first + length].fill(0);
        spans[first] = length;
        first += length;
    }
    spans
}

/// Name of the array that begins with the row called `first`.
pub fn name(first: &str) -> &str {
    first.strip_suffix("[1]").unwrap_or(first)
}

/// Whether `row` is the first element of an array.
pub fn begins(row: &Variable) -> bool {
    let computed = matches!(row.causality, Causality::Output | Causality::CalculatedParameter);
    computed && row.name.ends_with("[1]")
}

/// Elements of the variable that begins with the first of `rows`; a scalar has one.
fn length(rows: &[Variable]) -> usize {
    if !begins(&rows[0]) {
        return 1;
    }
    let stem = name(&rows[0].name);
    let indices = rows.iter().zip(1..);
    indices
        .take_while(|(row, index): &(_, u32)| row.name == format!("{stem}[{index}]"))
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Row, Unit};

    #[test]
    fn runs_of_indices_are_arrays() {
        let output = |name: &str| Row::<()>::output(name, Unit::ONE, 1.0, "", |()| 0.0).variable;
        let parameter = |name: &str| Row::<()>::parameter(name, Unit::ONE, 0.0..=1.0, 0.5, "").variable;
        let rows = ["a[1]", "a[2]"].map(parameter).into_iter();
        let rows: Vec<_> = rows
            .chain(["x[1]", "x[2]", "x[3]", "y[1]", "z", "w[2]"].map(output))
            .collect();
        assert_eq!(spans(&rows), [1, 1, 3, 0, 0, 1, 1, 1]);
        assert_eq!((name("x[1]"), name("z")), ("x", "z"));
    }
}

//! Numbers and tables as text.

use jostle::scene::Value;

/// Shortest text that reads back as the same bits.
pub fn number(value: f64) -> String {
    Value::Real(value).to_string()
}

/// Rows with aligned columns, two spaces apart; the last column runs free.
pub fn table(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter()
            .filter_map(|row| row.get(column))
            .map(|cell| cell.chars().count())
            .max()
    };
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let mut text = String::new();
    for row in rows {
        let padded: Vec<String> = row
            .iter()
            .zip(&widths)
            .map(|(cell, &width)| format!("{cell:width$}"))
            .collect();
        text.push_str(padded.join("  ").trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_of_a_table_are_aligned() {
        let row = |cells: [&str; 3]| cells.map(String::from).to_vec();
        assert_eq!(
            table(&[row(["a", "long", "x"]), row(["word", "b", ""])]),
            "a     long  x\nword  b\n"
        );
    }
}

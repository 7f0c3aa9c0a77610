//! Numbers and tables as text.

use jostle::scene::Value;

/// Shortest text that reads back as the same bits; powers of ten where zeros would fill the line.
pub fn number(value: f64) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-4..1e6).contains(&value.abs());
    if plain {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Text of a value of a variable.
pub fn value(value: Value) -> String {
    match value {
        Value::Real(real) => number(real),
        Value::Integer(integer) => integer.to_string(),
    }
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
    fn numbers_read_back_as_the_same_bits() {
        for value in [
            0.0,
            -0.0,
            0.1,
            1e-300,
            5e-324,
            9.8,
            1.0 / 3.0,
            -7.757e-5,
            1e12,
            f64::MAX,
            123456.789,
        ] {
            assert_eq!(
                number(value).parse::<f64>().unwrap().to_bits(),
                value.to_bits(),
                "{}",
                number(value)
            );
        }
    }

    #[test]
    fn columns_of_a_table_are_aligned() {
        let row = |cells: [&str; 3]| cells.map(String::from).to_vec();
        assert_eq!(
            table(&[row(["a", "long", "x"]), row(["word", "b", ""])]),
            "a     long  x\nword  b\n"
        );
    }
}

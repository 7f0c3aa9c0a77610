//! CPU time after which a case ends, as it is given on the command line.

/// CPU seconds above 0; infinite for no end.
pub fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 => Ok(number),
        _ => Err("give CPU seconds above 0, such as 1; inf for no end".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_is_a_time_above_zero() {
        for wrong in ["0", "-1", "NaN", "soon"] {
            assert!(positive(wrong).is_err(), "{wrong}");
        }
        assert_eq!(positive("inf"), Ok(f64::INFINITY));
    }
}

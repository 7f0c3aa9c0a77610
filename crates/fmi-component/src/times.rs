//! Which times are simulated.

use crate::error::{Error, Result};
use crate::unit::Unit;

/// Farthest time from zero \[s\], three hundred years. Doubles are 2e-6 s apart there; farther away the phase of an
/// oscillation loses its meaning, and the sine of an infinite phase is not a number.
pub const FARTHEST_TIME: f64 = 1e10;

/// Whether models can be at `time` \[s\].
#[inline]
pub fn is_simulated(time: f64) -> bool {
    time.abs() <= FARTHEST_TIME
}

/// Refuses a time \[s\] that is no number or too far from zero.
///
/// # Errors
/// It is; `name` says which time.
#[inline]
pub fn check_time(name: &str, time: f64) -> Result<()> {
    match is_simulated(time) {
        true => Ok(()),
        false => Err(not_simulated(name, time)),
    }
}

#[cold]
fn not_simulated(name: &str, time: f64) -> Error {
    Error::parameter(
        name,
        Unit::SECOND.format(time),
        format!("from -{FARTHEST_TIME:e} to {FARTHEST_TIME:e} s, where times are 2e-6 s apart in double precision"),
        "Count the time from nearer to the run.",
    )
}

/// Refuses a start time \[s\] as [`check_time`] does, and the farthest time itself: no step leads on from there.
///
/// # Errors
/// As [`check_time`].
pub fn check_start(time: f64) -> Result<()> {
    check_time("start time", time)?;
    if time < FARTHEST_TIME {
        return Ok(());
    }
    Err(Error::parameter(
        "start time",
        Unit::SECOND.format(time),
        format!("before {FARTHEST_TIME:e} s, where simulated time ends"),
        "Count the time from nearer to the run.",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_times_are_refused() {
        assert!([0.0, -1e10, 1e10].into_iter().all(is_simulated));
        assert!(
            ![f64::NAN, f64::INFINITY, -1.1e10, f64::MAX]
                .into_iter()
                .any(is_simulated)
        );
        assert!(check_start(-1e10).is_ok() && check_start(1e10_f64.next_down()).is_ok());
        let refusal = check_start(1e10).map_err(|error| error.to_string());
        assert!(refusal.is_err_and(|text| text.starts_with("start time = 1e10 s") && text.contains("before")));
        let message = check_time("start time", 1e300).map_err(|error| error.to_string());
        assert!(message.is_err_and(|text| text.starts_with("start time = ") && text.contains("1e10 s")));
    }
}

//! Sampling instants start + k / rate of a sensor: how many of them a step holds.

use fmi_component::{Error, Result, Step};

/// Communication points carry the importer's rounding: an instant that is this part of a period before one is at it.
const TOLERANCE: f64 = 1e-6;
/// Instants of one step: some tenths of a second of work.
const MOST: f64 = 1e6;

/// Number of instants from the start up to the end of `step`, the end itself not counted: it is the beginning of the next step.
///
/// # Errors
/// More instants in the step than one call may do.
pub fn before_end(step: &Step, rate: f64, model: &'static str) -> Result<u64> {
    let start = step.start_of_simulation();
    let asked = step.size() * rate;
    let all = ((step.end() - start) * rate - TOLERANCE).ceil();
    if !(asked <= MOST && all <= (1_u64 << 53) as f64) {
        return Err(Error::too_much_work(model, step.begin(), format!("{asked:e} samples")));
    }
    Ok(all.max(0.0) as u64)
}

//! What inputs have in common that are extrapolated: the parameter that fixes the degree, and the warning of rates that
//! contradict.

use crate::drive::{Contradiction, Degree, InputHistory};
use crate::scene::{Row, Values, Warning};

/// Highest degree.
const HIGHEST: i64 = 5;
/// Lets the degree be chosen by the errors of past predictions.
const AUTOMATIC: i64 = -1;

/// Row of the parameter `name`, the degree of the polynomials through `inputs`.
pub fn degree_parameter<M>(name: &str, inputs: &str) -> Row<M> {
    let description = format!(
        "Degree of the polynomial that extrapolates {inputs} over a step: -1 the one that would have predicted the last values \
         well, 0 holds the values, 1 is linear, up to {HIGHEST}"
    );
    Row::long_parameter(name, AUTOMATIC..=HIGHEST, AUTOMATIC, &description)
}

/// The degree that the parameter `name` says.
pub fn degree(name: &str, values: &Values) -> Degree {
    match u8::try_from(values.integer(name)) {
        Ok(degree) => Degree::AtMost(degree),
        Err(_) => Degree::Automatic,
    }
}

/// What to say of rates that contradict, unless it was `told` before; `names` are those of a quantity and its rates.
pub fn warning(history: &InputHistory, names: [&'static str; 3], told: &[&'static str]) -> Option<Warning> {
    let Contradiction {
        rate,
        time,
        given,
        found,
    } = history.contradiction()?;
    let (quantity, rate) = (names[rate - 1], names[rate]);
    (!told.contains(&rate)).then(|| Warning {
        topic: rate,
        text: format!(
            "{rate} is not the rate of {quantity}: at t = {time:e} s it is {given:e}, and {quantity} has changed by {found:e} per \
             second (SI units). Connect the rate of {quantity}, or leave {rate} unset."
        ),
    })
}

//! Parameters outside of the ranges in which a model makes sense.

use crate::model::Warning;
use crate::value::Value;
use crate::values::Values;
use crate::variable::Causality;

/// Topic of these warnings at the start, where all of them are known at once. Of a parameter that goes outside later the reason is the
/// topic, so that each is told once.
const TOPIC: &str = "recommended range";

/// A warning for each parameter outside of its recommended range.
pub fn warnings(values: &Values) -> Vec<Warning> {
    let mut warnings = by_reason(values);
    warnings.iter_mut().for_each(|warning| warning.topic = TOPIC);
    warnings
}

/// A warning for each parameter that is outside with the values of `now` and is not told of, with these same words, by those of the start.
pub fn since(start: &Values, now: &Values) -> Vec<Warning> {
    let told = by_reason(start);
    let mut warnings = by_reason(now);
    warnings.retain(|warning| !told.contains(warning));
    warnings
}

fn by_reason(values: &Values) -> Vec<Warning> {
    let table = values.table();
    let real = |name: &str| match table.position(name).and_then(|position| values.get(position)) {
        Some(Value::Real(real)) => real,
        Some(Value::Integer(integer)) => integer as f64,
        None => f64::NAN,
    };
    let parameters = table
        .settable()
        .iter()
        .filter(|variable| variable.causality == Causality::Parameter);
    let texts = parameters.filter_map(|variable| {
        let value = values.get(table.position(&variable.name)?)?;
        let recommended = variable.recommended.as_ref()?;
        let text = recommended.warning(&variable.name, &variable.text(value), &real)?;
        Some(Warning {
            topic: recommended.reason,
            text,
        })
    });
    texts.collect()
}

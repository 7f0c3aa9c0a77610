//! Parameters outside of the ranges in which a model makes sense.

use crate::model::Warning;
use crate::value::Value;
use crate::values::Values;
use crate::variable::Causality;

/// Topic of these warnings: parameters are frozen, so that all of them are known at once.
const TOPIC: &str = "recommended range";

/// A warning for each parameter outside of its recommended range.
pub fn warnings(values: &Values) -> Vec<Warning> {
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
        recommended.warning(&variable.name, &variable.text(value), &real)
    });
    texts.map(|text| Warning { topic: TOPIC, text }).collect()
}

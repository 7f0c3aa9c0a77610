//! What there is, as plain tuples: scenes, and the variables of a scene.

use jostle::scene::catalogue::{MODELS, Names};
use jostle::scene::{Kind, Recommended, Value, Variable};
use pyo3::prelude::*;

/// Scene, engine, drive, description and allowed numbers of disks of everything that can be simulated.
#[pyfunction]
pub fn scenes() -> Vec<(&'static str, &'static str, &'static str, String, u32, u32)> {
    let row = |info: jostle::scene::ModelInfo| {
        let (names, disks) = (Names::from(&info), &info.structure[0].range);
        (
            names.scene,
            names.engine,
            names.drive,
            info.description.to_string(),
            *disks.start(),
            *disks.end(),
        )
    };
    MODELS.iter().map(|model| row((model.info)())).collect()
}

/// Name, causality, kind, unit, smallest, largest and start value, options, description, recommended range and its reason, whether it is tunable.
pub type Row = (
    String,
    &'static str,
    &'static str,
    &'static str,
    f64,
    f64,
    f64,
    Vec<&'static str>,
    String,
    String,
    &'static str,
    bool,
);

/// A variable as a tuple.
pub fn row(variable: &Variable) -> Row {
    let kind = &variable.kind;
    let [min, max] = kind.bounds();
    let start = if variable.causality.is_settable() {
        variable.start().to_f64()
    } else {
        f64::NAN
    };
    let recommended = variable.recommended.as_ref();
    (
        variable.name.clone(),
        variable.causality.word(),
        kind.word(),
        kind.unit().name,
        min,
        max,
        start,
        kind.options().collect(),
        variable.description.clone(),
        recommended.map_or_else(String::new, Recommended::text),
        recommended.map_or("", |recommended| recommended.reason),
        variable.tunable,
    )
}

/// The value of a variable that a Python object stands for: a number, or a text as on the command line.
///
/// # Errors
/// An object of another kind, said as the command line says it.
pub fn value(variable: &Variable, given: &Bound<'_, PyAny>) -> jostle::Result<Value> {
    let found = match variable.kind {
        Kind::Real(_) | Kind::Single(_) => given.extract().map(Value::Real).ok(),
        _ => given.extract().map(Value::Integer).ok(),
    };
    match found {
        Some(value) => Ok(value),
        None => variable.parse(&given.str().map(|text| text.to_string()).unwrap_or_default()),
    }
}

//! Whether importers will read what a model says of itself: names, texts, ranges, default experiment.
//!
//! Source: FMI 2.0 sections 2.2.1, 2.2.7 and 2.2.9; FMI 3.0 sections 2.4.1 and 2.4.7.

use fmi_component::{Error, Kind, ModelInfo, Result, TIME, Value, Variable};

/// Checks what the files of an FMU are made from.
///
/// # Errors
/// The first text or number that no importer would take, by name.
pub fn check(info: &ModelInfo, variables: &[Variable]) -> Result<()> {
    check_identifier(&info.identifier)?;
    check_package(info.package)?;
    check_text("name of the model", info.name)?;
    check_text("version of the model", info.version)?;
    check_text("description of the model", info.description)?;
    check_duration("stop time of the default experiment", info.stop_time)?;
    check_duration("step size of the default experiment", info.step_size)?;
    variables.iter().try_for_each(check_variable)
}

/// It is part of file names and of C names.
fn check_identifier(identifier: &str) -> Result<()> {
    match is_identifier(identifier) {
        true => Ok(()),
        false => Err(Error::parameter(
            "identifier of the model",
            format!("{identifier:?}"),
            "a C identifier: letters, digits and underscores, no digit first",
            "Name the model by one, such as mechanics_pendulum.",
        )),
    }
}

/// Whether this is an identifier of C.
pub fn is_identifier(text: &str) -> bool {
    let is_letter = |byte: u8| byte.is_ascii_alphabetic() || byte == b'_';
    text.bytes().all(|byte| is_letter(byte) || byte.is_ascii_digit()) && text.bytes().next().is_some_and(is_letter)
}

/// It is the name of a folder.
fn check_package(package: &str) -> Result<()> {
    let fits = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'-';
    if !package.is_empty() && package.bytes().all(fits) {
        return Ok(());
    }
    Err(Error::parameter(
        "package of the model",
        format!("{package:?}"),
        "letters, digits, underscores and hyphens",
        "Give the name of the package.",
    ))
}

/// XML 1.0 has no control characters but tabulators and ends of lines.
fn check_text(what: &str, text: &str) -> Result<()> {
    let is_bad = |letter: char| letter.is_control() && !matches!(letter, '\t' | '\n' | '\r');
    if !text.contains(is_bad) {
        return Ok(());
    }
    Err(Error::parameter(
        what,
        format!("{text:?}"),
        "text without control characters",
        "Write it without.",
    ))
}

fn check_duration(what: &str, seconds: f64) -> Result<()> {
    if seconds.is_finite() && seconds > 0.0 {
        return Ok(());
    }
    Err(Error::parameter(
        what,
        format!("{seconds} s"),
        "finite and greater than 0",
        "Give a time that shows what the model does.",
    ))
}

fn check_variable(variable: &Variable) -> Result<()> {
    let name = &variable.name;
    if name.is_empty() || name == TIME || name.contains(char::is_control) {
        return Err(Error::parameter(
            "name of a variable",
            format!("{name:?}"),
            format!("text without control characters, not empty, other than {TIME:?}"),
            "Rename the variable.",
        ));
    }
    check_text(&format!("description of {name}"), &variable.description)?;
    if let Some(quantity) = variable.kind.quantity() {
        let (min, max, nominal) = (quantity.min, quantity.max, quantity.nominal);
        if min.is_nan() || max.is_nan() || min > max {
            return Err(Error::parameter(
                format!("range of {name}"),
                format!("from {} to {}", Value::Real(min), Value::Real(max)),
                "from a number to one that is not smaller",
                "Give the smallest allowed value first.",
            ));
        }
        if !(nominal.is_finite() && nominal > 0.0) {
            return Err(Error::parameter(
                format!("nominal value of {name}"),
                nominal,
                "finite and greater than 0",
                "Give the size of a typical value.",
            ));
        }
    }
    if let Some(bytes) = variable.kind.start_bytes() {
        check_start(variable, bytes)?;
        return variable.check_bytes(bytes);
    }
    match variable.causality.is_settable() {
        true => variable.check(variable.start()),
        false => Ok(()),
    }
}

/// The start value of a text stands in an attribute of the XML.
fn check_start(variable: &Variable, bytes: &[u8]) -> Result<()> {
    match &variable.kind {
        Kind::Text { start } => check_text(&format!("start value of {}", variable.name), start),
        Kind::Binary { mime_type, .. } => check_text(&format!("MIME type of {}", variable.name), mime_type),
        _ => variable.check_bytes(bytes),
    }
}

/// Checks that an array does not get the name of another variable of the FMU.
///
/// # Errors
/// Two variables of one name.
pub fn check_names<'a>(names: impl Iterator<Item = &'a str>) -> Result<()> {
    let mut known = std::collections::HashSet::new();
    for name in names {
        if !known.insert(name) {
            return Err(Error::parameter(
                "arrays",
                name,
                "one variable of each name",
                "Rename the scalar variable, or bundle without arrays.",
            ));
        }
    }
    Ok(())
}

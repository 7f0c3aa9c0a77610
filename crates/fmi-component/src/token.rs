//! Instantiation token (FMI 3.0) and GUID (FMI 2.0): which model and structure a library is to run, and a fingerprint.
//!
//! The structural parameters that were chosen when an FMU was bundled travel in the token, so that no resource file has to be
//! found and read. The fingerprint of the variables exposes a model description that belongs to another library.
//!
//! ```text
//! mechanics:chain:input:bodies=60:1f0c3a5be2d49768
//! mechanics:chain:input:bodies=60:arrays:1f0c3a5be2d49768    variables with an index are arrays
//! ```

use crate::dynamic::ModelType;
use crate::error::{Error, Result};
use crate::info::ModelInfo;
use crate::structure::StructuralParameters;
use crate::variable::{Variable, fingerprint};

/// What a token stands for.
#[derive(Debug, Clone, PartialEq)]
pub struct Contents {
    /// Structural parameters chosen when the FMU was bundled.
    pub structure: StructuralParameters,
    /// Computed variables with an index are arrays (FMI 3.0), see [`crate::arrays`].
    pub arrays: bool,
}

/// Token of a model with this structure.
pub fn write(info: &ModelInfo, structure: &StructuralParameters, variables: &[Variable], arrays: bool) -> String {
    let chosen: String = structure
        .iter()
        .map(|(name, value)| format!("{name}={value}:"))
        .collect();
    let layout = if arrays { "arrays:" } else { "" };
    let table = fingerprint(info.version, variables);
    format!("{}{chosen}{layout}{table:016x}", prefix(info))
}

/// What `token` stands for.
///
/// # Errors
/// The token is of another model or of a library with other variables.
pub fn read(model: &ModelType, token: &str) -> Result<Contents> {
    let info = (model.info)();
    let refused = |expected: String| {
        Error::call(
            format!("the instantiation token is {token:?}, this library expects {expected:?}"),
            "Take modelDescription.xml and the binary from the same FMU.",
        )
    };
    let shape = || {
        let chosen: String = info
            .structure
            .iter()
            .map(|parameter| format!("{}=N:", parameter.name))
            .collect();
        format!("{}{chosen}...", prefix(&info))
    };
    let rest = token.strip_prefix(&prefix(&info)).ok_or_else(|| refused(shape()))?;
    let mut parts = rest.split(':');
    let mut chosen = Vec::new();
    for parameter in &info.structure {
        let value = parts
            .next()
            .and_then(|part| part.strip_prefix(parameter.name)?.strip_prefix('=')?.parse().ok());
        chosen.push((parameter.name, value.ok_or_else(|| refused(shape()))?));
    }
    let structure = StructuralParameters::choose(&info, &chosen).map_err(|_| refused(shape()))?;
    let arrays = parts.next() == Some("arrays");
    let expected = write(&info, &structure, &(model.variables)(&structure), arrays);
    match token == expected {
        true => Ok(Contents { structure, arrays }),
        false => Err(refused(expected)),
    }
}

fn prefix(info: &ModelInfo) -> String {
    let variant: String = info.variant.iter().map(|(_, value)| format!("{value}:")).collect();
    format!("{}:{}:{variant}", info.package, info.name)
}

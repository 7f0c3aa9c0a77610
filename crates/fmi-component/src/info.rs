//! Static facts of a model: names, default experiment, and the whole numbers that decide which variables it has.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::sheet::DataSheet;

/// Static facts of a model, for the model description and the documentation page.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModelInfo {
    /// Name of the package that the model belongs to, such as `env!("CARGO_PKG_NAME")`.
    pub package: &'static str,
    /// Version of the package, such as `env!("CARGO_PKG_VERSION")`.
    pub version: &'static str,
    /// Model, such as `pendulum`.
    pub name: &'static str,
    /// What distinguishes models of one name, as pairs of key and value: `("engine", "event-driven")`. Empty for most.
    pub variant: Vec<(&'static str, &'static str)>,
    /// Model identifier of FMI: file name and C identifier at once, such as `mechanics_pendulum`.
    pub identifier: Cow<'static, str>,
    /// One sentence.
    pub description: &'static str,
    /// HTML fragment with the equations and their sources, for the documentation page.
    pub equations: &'static str,
    /// Structural parameters.
    pub structure: Vec<StructuralParameter>,
    /// Default experiment: stop time \[s\].
    pub stop_time: f64,
    /// Default experiment: communication step \[s\].
    pub step_size: f64,
    /// What the documentation page says besides.
    pub sheet: DataSheet,
}

impl ModelInfo {
    /// A model without variants and structural parameters that is a package of its own; `name` is its identifier too.
    pub const fn new(name: &'static str, version: &'static str, description: &'static str) -> Self {
        Self {
            package: name,
            version,
            name,
            variant: Vec::new(),
            identifier: Cow::Borrowed(name),
            description,
            equations: "",
            structure: Vec::new(),
            stop_time: 1.0,
            step_size: 0.01,
            sheet: DataSheet::EMPTY,
        }
    }

    /// Value of the variant's `key`, if the model has it.
    pub fn variant_of(&self, key: &str) -> Option<&'static str> {
        self.variant
            .iter()
            .find(|(known, _)| *known == key)
            .map(|(_, value)| *value)
    }
}

/// A structural parameter of a model with its range.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StructuralParameter {
    /// Name, such as `bodies`.
    pub name: &'static str,
    /// One sentence.
    pub description: &'static str,
    /// Allowed values.
    pub range: RangeInclusive<u32>,
    /// Value where none is chosen.
    pub default: u32,
}

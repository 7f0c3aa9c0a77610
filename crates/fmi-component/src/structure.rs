//! Structural parameters: whole numbers that decide which variables a model has, such as a number of bodies.

use crate::error::{Error, Result};
use crate::info::ModelInfo;

/// The chosen value of each structural parameter, in the order of [`ModelInfo::structure`]. Fixed when a component is bundled.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct StructuralParameters {
    values: Vec<(&'static str, u32)>,
}

impl StructuralParameters {
    /// Defaults of a model.
    pub fn defaults(info: &ModelInfo) -> Self {
        let values = info
            .structure
            .iter()
            .map(|parameter| (parameter.name, parameter.default));
        Self {
            values: values.collect(),
        }
    }

    /// Defaults of a model but for those that are `chosen` by name.
    ///
    /// # Errors
    /// A name that the model does not have, or a value out of range.
    pub fn choose(info: &ModelInfo, chosen: &[(&str, u32)]) -> Result<Self> {
        let mut structure = Self::defaults(info);
        for &(name, value) in chosen {
            let Some(index) = info.structure.iter().position(|parameter| parameter.name == name) else {
                let known: Vec<_> = info.structure.iter().map(|parameter| parameter.name).collect();
                return Err(Error::parameter(
                    "structural parameter",
                    name,
                    format!("one of the model {}: {}", info.name, known.join(", ")),
                    "Name one of these.",
                ));
            };
            let range = &info.structure[index].range;
            if !range.contains(&value) {
                return Err(Error::parameter(
                    format!("number of {name}"),
                    value,
                    format!("{} to {}", range.start(), range.end()),
                    "Give a number in this range.",
                ));
            }
            structure.values[index].1 = value;
        }
        Ok(structure)
    }

    /// Value of the parameter called `name`. A name that the model does not list is a defect of the model and panics.
    pub fn get(&self, name: &str) -> u32 {
        match self.values.iter().find(|(known, _)| *known == name) {
            Some((_, value)) => *value,
            None => panic!("the model lists no structural parameter {name}"),
        }
    }

    /// Names and values.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, u32)> {
        self.values.iter().copied()
    }
}

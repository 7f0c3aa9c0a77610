//! The variables of a model with an index by name.

use std::collections::HashMap;

use crate::error::Error;
use crate::variable::{Causality, Variable};

/// The variables of a model. Made once per component, shared and never changed.
pub struct Table {
    variables: Vec<Variable>,
    /// Parameters and inputs, which come first.
    settable: usize,
    by_name: HashMap<String, usize>,
    /// Position of the derivative of the variable at each position.
    derivatives: HashMap<usize, usize>,
}

impl std::fmt::Debug for Table {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "Table of {} variables", self.variables.len())
    }
}

impl Table {
    /// Indexes the variables. Two of one name, a computed one before a parameter or input, and a derivative that does not
    /// exist or has another causality are defects of the model and panic.
    pub fn new(variables: Vec<Variable>) -> Self {
        let mut by_name = HashMap::with_capacity(variables.len());
        for (position, variable) in variables.iter().enumerate() {
            let earlier = by_name.insert(variable.name.clone(), position);
            assert!(earlier.is_none(), "two variables are named {}", variable.name);
        }
        let settable = variables
            .iter()
            .take_while(|variable| variable.causality.is_settable())
            .count();
        let late = variables[settable..]
            .iter()
            .find(|variable| variable.causality.is_settable());
        assert!(
            late.is_none(),
            "{late:?} comes after a variable that the model computes"
        );
        let mut derivatives = HashMap::new();
        for (position, variable) in variables.iter().enumerate() {
            let Some(name) = &variable.derivative else { continue };
            let derivative = by_name.get(name).copied();
            let fits = |at: usize| variables[at].causality == variable.causality;
            match derivative.filter(|at| fits(*at)) {
                Some(derivative) => derivatives.insert(position, derivative),
                None => panic!(
                    "{name}, the derivative of {}, is no variable of the same causality",
                    variable.name
                ),
            };
        }
        Self {
            variables,
            settable,
            by_name,
            derivatives,
        }
    }

    /// All variables, in the order of their value references.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// Parameters and inputs, which come first.
    pub fn settable(&self) -> &[Variable] {
        &self.variables[..self.settable]
    }

    /// Position of the variable called `name`.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    /// The refusal of a position at which there is no variable.
    #[cold]
    pub(crate) fn no_variable(&self, position: usize) -> Error {
        Error::parameter(
            "position of a variable",
            position,
            format!("0 to {}", self.variables.len().saturating_sub(1)),
            "Take positions from this same model.",
        )
    }

    /// Position of the time derivative of the variable at `position`.
    pub fn derivative(&self, position: usize) -> Option<usize> {
        self.derivatives.get(&position).copied()
    }

    /// Whether any variable of this causality has a derivative: the highest order offered is then 1, else 0.
    pub fn has_derivatives(&self, causality: Causality) -> bool {
        let of_causality = |position: &usize| self.variables[*position].causality == causality;
        self.derivatives.keys().any(of_causality)
    }
}

//! The variables of a model with an index by name.

use std::collections::HashMap;

use crate::error::{Error, Result};
use crate::kind::Kind;
use crate::variable::{Causality, Variability, Variable};

/// The variables of a model. Made once per component, shared and never changed.
pub struct Table {
    variables: Vec<Variable>,
    /// Parameters and inputs, which come first.
    settable: usize,
    /// Positions of the tunable parameters.
    tunable: Vec<usize>,
    by_name: HashMap<String, usize>,
    /// Positions of the parameters and inputs that are texts or binary.
    bytes: Vec<usize>,
    /// Position of the derivative of the variable at each position.
    derivatives: HashMap<usize, usize>,
}

impl std::fmt::Debug for Table {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "Table of {} variables", self.variables.len())
    }
}

impl Table {
    /// Indexes the variables. What [`Table::try_new`] refuses is a defect of the model and panics.
    pub fn new(variables: Vec<Variable>) -> Self {
        Self::try_new(variables).unwrap_or_else(|defect| panic!("{defect}"))
    }

    /// Indexes the variables.
    ///
    /// # Errors
    /// Two variables of one name, a computed one before a parameter or input, a tunable one that is no parameter, or a derivative
    /// that does not exist or has another causality.
    pub fn try_new(variables: Vec<Variable>) -> Result<Self> {
        let defect = |what: String| Err(Error::call(what, "Mend the variables of the model."));
        let mut by_name = HashMap::with_capacity(variables.len());
        for (position, variable) in variables.iter().enumerate() {
            if by_name.insert(variable.name.clone(), position).is_some() {
                return defect(format!("two variables are named {}", variable.name));
            }
        }
        let is_settable = |variable: &&Variable| variable.causality.is_settable();
        let settable = variables.iter().take_while(is_settable).count();
        if let Some(late) = variables[settable..].iter().find(is_settable) {
            let what = format!("{} comes after a variable that the model computes", late.name);
            return defect(what);
        }
        if let Some(other) =
            (variables.iter()).find(|variable| variable.tunable && variable.causality != Causality::Parameter)
        {
            return defect(format!("{} is tunable, but no parameter", other.name));
        }
        let bytes = |variable: &&Variable| variable.tunable && variable.kind.start_bytes().is_some();
        if let Some(other) = variables.iter().find(bytes) {
            return defect(format!("{} is tunable, but no number", other.name));
        }
        let tunable = (0..settable).filter(|position| variables[*position].tunable).collect();
        let mut derivatives = HashMap::new();
        for (position, variable) in variables.iter().enumerate() {
            let Some(name) = &variable.derivative else { continue };
            let fits = |at: &usize| variables[*at].causality == variable.causality;
            let Some(derivative) = by_name.get(name).copied().filter(fits) else {
                return defect(format!(
                    "{name}, the derivative of {}, is no variable of the same causality",
                    variable.name
                ));
            };
            derivatives.insert(position, derivative);
        }
        let holds_bytes = |position: &usize| variables[*position].kind.start_bytes().is_some();
        Ok(Self {
            bytes: (0..settable).filter(holds_bytes).collect(),
            variables,
            settable,
            tunable,
            by_name,
            derivatives,
        })
    }

    /// All variables, in the order of their value references.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// Parameters and inputs, which come first.
    pub fn settable(&self) -> &[Variable] {
        &self.variables[..self.settable]
    }

    /// Positions of the tunable parameters.
    pub fn tunable(&self) -> &[usize] {
        &self.tunable
    }

    /// When the value of the variable at `position` may change. A calculated parameter is tunable if it may depend on a tunable one.
    ///
    /// # Panics
    /// There is no variable at `position`.
    pub fn variability(&self, position: usize) -> Variability {
        let variable = &self.variables[position];
        let tunable = match (variable.causality, &variable.dependencies) {
            (Causality::Parameter, _) => variable.tunable,
            (Causality::CalculatedParameter, None) => !self.tunable.is_empty(),
            (Causality::CalculatedParameter, Some(names)) => {
                let named = |position: &usize| names.contains(&self.variables[*position].name.as_str());
                self.tunable.iter().any(named)
            }
            (Causality::Input | Causality::Output, _) => {
                return match variable.kind {
                    _ if variable.discrete => Variability::Discrete,
                    Kind::Real(_) | Kind::Single(_) => Variability::Continuous,
                    _ => Variability::Discrete,
                };
            }
        };
        if tunable {
            Variability::Tunable
        } else {
            Variability::Fixed
        }
    }

    /// Positions of the parameters and inputs that are texts or binary, in their order.
    pub(crate) fn bytes(&self) -> &[usize] {
        &self.bytes
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

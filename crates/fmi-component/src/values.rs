//! The values of parameters and inputs. What a model computes is read from the model.
//!
//! A model never sees the real -0.0: it is stored as 0.0, the same number. A model that divides by a parameter would else tell
//! the two apart, and take a damping of -0.0 for a time of minus infinity.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::table::Table;
use crate::value::Value;
use crate::variable::Causality;

/// The present value of every parameter and input of a [`Table`].
#[derive(Debug, Clone)]
pub struct Values {
    table: Arc<Table>,
    values: Vec<Value>,
}

impl PartialEq for Values {
    fn eq(&self, other: &Self) -> bool {
        self.values == other.values
    }
}

impl Values {
    /// Start values.
    pub fn new(table: Arc<Table>) -> Self {
        let values = table
            .settable()
            .iter()
            .map(|variable| stored(variable.start()))
            .collect();
        Self { table, values }
    }

    /// The variables that these values belong to.
    pub fn table(&self) -> &Arc<Table> {
        &self.table
    }

    /// All values in the order of the parameters and inputs.
    pub fn as_slice(&self) -> &[Value] {
        &self.values
    }

    /// Value of the parameter or input at `position`.
    pub fn get(&self, position: usize) -> Option<Value> {
        self.values.get(position).copied()
    }

    /// Stores a value at `position` after checking its type and range.
    ///
    /// # Errors
    /// No parameter or input there, another type, or out of range.
    pub fn set(&mut self, position: usize, value: Value) -> Result<()> {
        let Some(variable) = self.table.settable().get(position) else {
            return Err(match self.table.variables().get(position) {
                Some(computed) => Error::call(
                    format!("{} is computed by the model", computed.name),
                    "Set a parameter or an input instead.",
                ),
                None => self.table.no_variable(position),
            });
        };
        variable.check(value)?;
        self.values[position] = stored(value);
        Ok(())
    }

    /// Puts back all values as [`Values::as_slice`] gave them.
    ///
    /// # Errors
    /// Another number of values, another type, or out of range. Nothing is stored then.
    pub fn put_back(&mut self, values: &[Value]) -> Result<()> {
        self.check_all(values)?;
        for (own, value) in self.values.iter_mut().zip(values) {
            *own = stored(*value);
        }
        Ok(())
    }

    /// Says whether [`Values::put_back`] would accept `values`.
    ///
    /// # Errors
    /// As [`Values::put_back`].
    pub fn check_all(&self, values: &[Value]) -> Result<()> {
        if values.len() != self.values.len() {
            return Err(Error::state(
                format!("it holds {} values, this model has {}", values.len(), self.values.len()),
                "Save and restore with the same model.",
            ));
        }
        let pairs = self.table.settable().iter().zip(values);
        pairs
            .into_iter()
            .try_for_each(|(variable, value)| variable.check(*value))
    }

    /// Whether all parameters but the tunable ones are the same, as they would be stored.
    pub fn same_fixed_parameters(&self, others: &[Value]) -> bool {
        let pairs = self.values.iter().zip(others);
        self.table
            .settable()
            .iter()
            .zip(pairs)
            .filter(|(variable, _)| variable.causality == Causality::Parameter && !variable.tunable)
            .all(|(_, (one, other))| one == other)
    }

    /// Values of the tunable parameters, in the order of [`Table::tunable`].
    pub fn tunable(&self) -> Vec<Value> {
        self.table
            .tunable()
            .iter()
            .map(|position| self.values[*position])
            .collect()
    }

    /// Other values of the same variables, as many.
    pub(crate) fn with_all(&self, others: &[Value]) -> Self {
        Self {
            table: Arc::clone(&self.table),
            values: others.iter().copied().map(stored).collect(),
        }
    }

    /// The same values but for the tunable parameters.
    pub(crate) fn with_tunable(&self, tunable: &[Value]) -> Self {
        let mut values = self.clone();
        for (position, value) in self.table.tunable().iter().zip(tunable) {
            values.values[*position] = stored(*value);
        }
        values
    }

    /// The real called `name`. A name that the model does not list is a defect of the model and panics.
    pub fn real(&self, name: &str) -> f64 {
        match self.by_name(name) {
            Some(Value::Real(real)) => real,
            other => panic!("the model has no real parameter or input {name} (found {other:?})"),
        }
    }

    /// The whole number called `name`. A name that the model does not list is a defect of the model and panics.
    pub fn integer(&self, name: &str) -> i64 {
        match self.by_name(name) {
            Some(Value::Integer(integer)) => integer,
            other => panic!("the model has no integer parameter or input {name} (found {other:?})"),
        }
    }

    fn by_name(&self, name: &str) -> Option<Value> {
        self.table.position(name).and_then(|position| self.get(position))
    }
}

/// The value as it is kept: zero has no sign, since -0.0 + 0.0 is 0.0. All other numbers stay as they are.
fn stored(value: Value) -> Value {
    match value {
        Value::Real(real) => Value::Real(real + 0.0),
        integer => integer,
    }
}

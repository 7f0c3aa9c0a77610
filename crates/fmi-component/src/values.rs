//! The values of parameters and inputs. What a model computes is read from the model.
//!
//! A model never sees the real -0.0: it is stored as 0.0, the same number. A model that divides by a parameter would else tell
//! the two apart, and take a damping of -0.0 for a time of minus infinity.

use std::sync::Arc;

use crate::error::{Error, Result};
use crate::kind::Kind;
use crate::table::Table;
use crate::value::Value;
use crate::variable::{Causality, Variable};

/// The present value of every parameter and input of a [`Table`].
#[derive(Debug, Clone)]
pub struct Values {
    table: Arc<Table>,
    values: Vec<Value>,
    /// Contents of the texts and binary variables, in the order of [`Table::bytes`]; their lengths are among the values.
    bytes: Vec<Vec<u8>>,
}

impl PartialEq for Values {
    fn eq(&self, other: &Self) -> bool {
        self.values == other.values && self.bytes == other.bytes
    }
}

impl Values {
    /// Start values.
    pub fn new(table: Arc<Table>) -> Self {
        let values = table
            .settable()
            .iter()
            .map(|variable| stored(&variable.kind, variable.start()))
            .collect();
        let starts = table
            .settable()
            .iter()
            .filter_map(|variable| variable.kind.start_bytes());
        let bytes = starts.map(<[u8]>::to_vec).collect();
        Self { table, values, bytes }
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

    /// Contents of the texts and binary variables among the parameters and inputs, in their order.
    pub fn all_bytes(&self) -> &[Vec<u8>] {
        &self.bytes
    }

    /// Contents of the text or binary parameter or input at `position`.
    pub fn bytes(&self, position: usize) -> Option<&[u8]> {
        let index = self.table.bytes().binary_search(&position).ok()?;
        self.bytes.get(index).map(Vec::as_slice)
    }

    /// Stores the contents of the text or binary parameter or input at `position`.
    ///
    /// # Errors
    /// No parameter or input there, another type, or a text that is not UTF-8 or holds a zero byte.
    pub fn set_bytes(&mut self, position: usize, bytes: &[u8]) -> Result<()> {
        let Some(variable) = self.table.settable().get(position) else {
            return Err(self.not_settable(position));
        };
        variable.check_bytes(bytes)?;
        let Ok(index) = self.table.bytes().binary_search(&position) else {
            return Err(self.table.no_variable(position));
        };
        self.bytes[index].clear();
        self.bytes[index].extend_from_slice(bytes);
        self.values[position] = Value::Integer(bytes.len() as i64);
        Ok(())
    }

    /// Stores a value at `position` after checking its type and range.
    ///
    /// # Errors
    /// No parameter or input there, another type, or out of range.
    pub fn set(&mut self, position: usize, value: Value) -> Result<()> {
        let Some(variable) = self.table.settable().get(position) else {
            return Err(self.not_settable(position));
        };
        self.values[position] = match variable.signal(value) {
            Some(real) => Value::Real(real + 0.0), // as `stored` has it
            None => {
                variable.check(value)?;
                stored(&variable.kind, value)
            }
        };
        Ok(())
    }

    #[cold]
    fn not_settable(&self, position: usize) -> Error {
        match self.table.variables().get(position) {
            Some(computed) => Error::call(
                format!("{} is computed by the model", computed.name),
                "Set a parameter or an input instead.",
            ),
            None => self.table.no_variable(position),
        }
    }

    /// As [`Values::put_back`], for values of this same table that were checked.
    pub(crate) fn take_over(&mut self, values: &[Value], bytes: &[Vec<u8>]) {
        for ((own, value), variable) in self.values.iter_mut().zip(values).zip(self.table.settable()) {
            *own = stored(&variable.kind, *value);
        }
        self.bytes.clone_from_slice(bytes);
    }

    /// Sets inputs from position `first` on, all of them reals of 64 bits, to values that were checked.
    #[inline]
    pub(crate) fn set_signals(&mut self, first: usize, reals: &[f64]) {
        for (own, real) in self.values.iter_mut().skip(first).zip(reals) {
            *own = Value::Real(real + 0.0); // as `stored` has it
        }
    }

    /// Puts back all values as [`Values::as_slice`] and [`Values::all_bytes`] gave them.
    ///
    /// # Errors
    /// Another number of values, another type, or out of range. Nothing is stored then.
    pub fn put_back(&mut self, values: &[Value], bytes: &[Vec<u8>]) -> Result<()> {
        self.check_all(values, bytes)?;
        self.take_over(values, bytes);
        Ok(())
    }

    /// Says whether [`Values::put_back`] would accept `values`.
    ///
    /// # Errors
    /// As [`Values::put_back`].
    pub fn check_all(&self, values: &[Value], bytes: &[Vec<u8>]) -> Result<()> {
        let [found, own] = [(values.len(), bytes.len()), (self.values.len(), self.bytes.len())];
        if found != own {
            return Err(Error::state(
                format!(
                    "it holds {} values and {} texts, this model has {} and {}",
                    found.0, found.1, own.0, own.1
                ),
                "Save and restore with the same model.",
            ));
        }
        let mut bytes = bytes.iter();
        for (variable, value) in self.table.settable().iter().zip(values) {
            match variable.kind.start_bytes().and_then(|_| bytes.next()) {
                None => variable.check(*value)?,
                Some(bytes) => {
                    variable.check_bytes(bytes)?;
                    if *value != Value::Integer(bytes.len() as i64) {
                        return Err(Error::state(
                            format!("{} has {} bytes in it and says {value}", variable.name, bytes.len()),
                            "Pass a state that saving gave.",
                        ));
                    }
                }
            }
        }
        Ok(())
    }

    /// Whether all parameters but the tunable ones are the same, as they would be stored.
    pub fn same_fixed_parameters(&self, others: &[Value], bytes: &[Vec<u8>]) -> bool {
        let is_fixed = |variable: &Variable| variable.causality == Causality::Parameter && !variable.tunable;
        let pairs = self.values.iter().zip(others);
        let numbers = self.table.settable().iter().zip(pairs);
        let contents = self.table.bytes().iter().zip(self.bytes.iter().zip(bytes));
        numbers
            .filter(|(variable, _)| is_fixed(variable))
            .all(|(_, (one, other))| one == other)
            && contents
                .filter(|(position, _)| is_fixed(&self.table.settable()[**position]))
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

    /// Other values of the same variables, as many, and contents of texts and binary variables.
    pub(crate) fn with_all(&self, others: &[Value], bytes: &[Vec<u8>]) -> Self {
        let pairs = self.table.settable().iter().zip(others);
        Self {
            table: Arc::clone(&self.table),
            values: pairs.map(|(variable, value)| stored(&variable.kind, *value)).collect(),
            bytes: bytes.to_vec(),
        }
    }

    /// The same values but for the tunable parameters.
    pub(crate) fn with_tunable(&self, tunable: &[Value]) -> Self {
        let mut values = self.clone();
        for (position, value) in self.table.tunable().iter().zip(tunable) {
            let kind = &values.table.settable()[*position].kind;
            values.values[*position] = stored(kind, *value);
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

    /// The boolean called `name`. A name that the model does not list is a defect of the model and panics.
    pub fn boolean(&self, name: &str) -> bool {
        self.integer(name) != 0
    }

    /// The text called `name`. A name that the model does not list is a defect of the model and panics.
    pub fn text(&self, name: &str) -> &str {
        match std::str::from_utf8(self.binary(name)) {
            Ok(text) => text,
            Err(error) => panic!("the parameter or input {name} of the model is no text: {error}"),
        }
    }

    /// The bytes of the text or binary variable called `name`. A name that the model does not list is a defect of the model and panics.
    pub fn binary(&self, name: &str) -> &[u8] {
        let position = self.table.position(name);
        match position.and_then(|position| self.bytes(position)) {
            Some(bytes) => bytes,
            None => panic!("the model has no text or binary parameter or input {name}"),
        }
    }

    fn by_name(&self, name: &str) -> Option<Value> {
        self.table.position(name).and_then(|position| self.get(position))
    }
}

/// The value as it is kept: zero has no sign, since -0.0 + 0.0 is 0.0, and a real of 32 bits is rounded to them. All others stay as
/// they are.
fn stored(kind: &Kind, value: Value) -> Value {
    match (value, kind) {
        (Value::Real(real), Kind::Single(_)) => Value::Real(f64::from(real as f32) + 0.0),
        (Value::Real(real), _) => Value::Real(real + 0.0),
        (integer, _) => integer,
    }
}

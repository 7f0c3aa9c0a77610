//! Rows with an index by name, the value of each, and the writer of those that are computed.

use std::collections::HashMap;
use std::sync::Arc;

use crate::error::{Error, Result};

use super::variables::{Causality, Kind, Value, Variable};

/// The rows of a scene with an index by name. Made once per instance, shared and never changed.
pub struct Table {
    rows: Vec<Variable>,
    by_name: HashMap<String, usize>,
}

impl std::fmt::Debug for Table {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "Table of {} variables", self.rows.len())
    }
}

impl Table {
    /// Indexes the rows. Two rows of one name are a defect of the scene and panic.
    pub fn new(rows: Vec<Variable>) -> Self {
        let mut by_name = HashMap::with_capacity(rows.len());
        for (index, row) in rows.iter().enumerate() {
            let earlier = by_name.insert(row.name.clone(), index);
            assert!(earlier.is_none(), "two variables are named {}", row.name);
        }
        Self { rows, by_name }
    }

    /// All rows, in the order of their value references.
    pub fn rows(&self) -> &[Variable] {
        &self.rows
    }

    /// Position of the row called `name`.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }
}

/// The present value of every row of a [`Table`].
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
        let values = table.rows().iter().map(Variable::start).collect();
        Self { table, values }
    }

    /// The rows that these values belong to.
    pub fn table(&self) -> &Arc<Table> {
        &self.table
    }

    /// All values in the order of the rows.
    pub fn as_slice(&self) -> &[Value] {
        &self.values
    }

    /// Value of the row at `position`.
    pub fn get(&self, position: usize) -> Option<Value> {
        self.values.get(position).copied()
    }

    /// Stores a value at `position` after checking it against the row's kind and range.
    pub fn set(&mut self, position: usize, value: Value) -> Result<()> {
        let Some(row) = self.table.rows().get(position) else {
            return Err(Error::parameter(
                "value reference",
                position,
                format!("0 to {}", self.values.len().saturating_sub(1)),
                "Take the value references from the model description.",
            ));
        };
        row.check(value)?;
        self.values[position] = value;
        Ok(())
    }

    /// Puts back all values as [`Values::as_slice`] gave them, the computed ones too.
    ///
    /// # Errors
    /// Another number of values, another kind, or a parameter or input outside its range. Nothing is stored then.
    pub fn put_back(&mut self, values: &[Value]) -> Result<()> {
        self.check_all(values)?;
        self.values.copy_from_slice(values);
        Ok(())
    }

    /// Says whether [`Values::put_back`] would accept `values`.
    pub fn check_all(&self, values: &[Value]) -> Result<()> {
        if values.len() != self.values.len() {
            return Err(Error::state(
                format!("it holds {} values, this scene has {}", values.len(), self.values.len()),
                "Save and restore with the same FMU.",
            ));
        }
        for (row, value) in self.table.rows().iter().zip(values) {
            let given = matches!(row.causality, Causality::Parameter | Causality::Input);
            match (&row.kind, value) {
                _ if given => row.check(*value)?,
                (Kind::Real(_), Value::Real(_)) => {}
                (Kind::Integer { .. } | Kind::Long { .. } | Kind::Enumeration { .. }, Value::Integer(_)) => {}
                (Kind::Real(_), Value::Integer(_)) | (_, Value::Real(_)) => {
                    return Err(Error::state(
                        format!("{} has another type there", row.name),
                        "Save it anew.",
                    ));
                }
            }
        }
        Ok(())
    }

    /// Whether all parameters are the same, bit by bit, since a scene may tell 0.0 from -0.0.
    pub fn same_parameters(&self, others: &Values) -> bool {
        let bits = |value: &Value| match value {
            Value::Real(real) => real.to_bits(),
            Value::Integer(integer) => *integer as u64,
        };
        let pairs = self.values.iter().zip(&others.values);
        self.table
            .rows()
            .iter()
            .zip(pairs)
            .filter(|(row, _)| row.causality == Causality::Parameter)
            .all(|(_, (one, other))| bits(one) == bits(other))
    }

    /// Stores a value by name after checking it.
    pub fn set_by_name(&mut self, name: &str, value: Value) -> Result<()> {
        let Some(position) = self.table.position(name) else {
            return Err(Error::parameter(
                "variable",
                name,
                "a variable of this scene",
                "List them: jostle describe.",
            ));
        };
        self.set(position, value)
    }

    /// The real called `name`. A name that the scene does not list is a defect of the scene and panics.
    pub fn real(&self, name: &str) -> f64 {
        match self.table.position(name).map(|position| self.values[position]) {
            Some(Value::Real(real)) => real,
            other => panic!("the scene has no real variable {name} (found {other:?})"),
        }
    }

    /// The whole number called `name`. A name that the scene does not list is a defect of the scene and panics.
    pub fn integer(&self, name: &str) -> i64 {
        match self.table.position(name).map(|position| self.values[position]) {
            Some(Value::Integer(integer)) => integer,
            other => panic!("the scene has no integer variable {name} (found {other:?})"),
        }
    }

    /// Starts writing outputs and calculated parameters, in the order of the rows.
    pub fn writer(&mut self) -> OutputWriter<'_> {
        OutputWriter {
            rows: self.table.rows(),
            values: &mut self.values,
            next: 0,
        }
    }
}

/// Writes computed rows one after the other; debug builds check that name and order are those of the table.
pub struct OutputWriter<'values> {
    rows: &'values [Variable],
    values: &'values mut [Value],
    next: usize,
}

impl OutputWriter<'_> {
    /// Next computed row is the real called `name`.
    pub fn real(&mut self, name: &str, value: f64) {
        self.put(|row| row == name, Value::Real(value));
    }

    /// Next computed row is the whole number called `name`.
    pub fn integer(&mut self, name: &str, value: i64) {
        self.put(|row| row == name, Value::Integer(value));
    }

    /// Next computed rows are the reals `name[1]`, `name[2]`, ...
    pub fn reals(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        for value in values {
            self.put(|row| row.starts_with(name) && row.ends_with(']'), Value::Real(value));
        }
    }

    /// Every computed row must have been written; checked in debug builds.
    pub fn finish(mut self) {
        self.skip_given();
        debug_assert_eq!(self.next, self.rows.len(), "the scene left outputs unwritten");
    }

    fn skip_given(&mut self) {
        let given = |row: &Variable| matches!(row.causality, Causality::Parameter | Causality::Input);
        while self.rows.get(self.next).is_some_and(given) {
            self.next += 1;
        }
    }

    fn put(&mut self, expected: impl Fn(&str) -> bool, value: Value) {
        self.skip_given();
        debug_assert!(
            expected(&self.rows[self.next].name),
            "row {} is not next",
            self.rows[self.next].name
        );
        self.values[self.next] = value;
        self.next += 1;
    }
}

//! A run of a model from its start values, whether the model is linked with this program or in a library: the same calls give
//! the same numbers and the same texts.

use std::sync::Arc;

use fmi_component::handle::DEFECT;
use fmi_component::{DynSimulation, Error, Kind, Result, Table, Value, value_reference};

use crate::importer::Instance;

/// Remedy for a model that panics.
pub const MEND: &str = "The model has to be mended.";

/// What a model answers to a start or a step: why it refuses, if it does.
pub type Answer = Option<String>;

/// A run. Times in \[s\].
pub trait Run {
    /// Time reached.
    fn time(&self) -> f64;

    /// Sets the real at `position` of the table.
    ///
    /// # Errors
    /// The value is refused.
    fn set(&mut self, position: usize, value: f64) -> Result<()>;

    /// The number at `position` as of now, once the run has started.
    ///
    /// # Errors
    /// No such number.
    fn value(&mut self, position: usize) -> Result<Value>;

    /// Starts the model.
    ///
    /// # Errors
    /// The model panics.
    fn start(&mut self, time: f64) -> Result<Answer>;

    /// Advances to `time`.
    ///
    /// # Errors
    /// The model panics.
    fn advance_to(&mut self, time: f64) -> Result<Answer>;
}

/// A run of a model that is linked with this program. A panic is one of this program too.
pub struct Linked(pub Box<dyn DynSimulation>);

impl Run for Linked {
    fn time(&self) -> f64 {
        self.0.time()
    }

    fn set(&mut self, position: usize, value: f64) -> Result<()> {
        self.0.set_at(position, Value::Real(value))
    }

    fn value(&mut self, position: usize) -> Result<Value> {
        self.0.value(position)
    }

    fn start(&mut self, time: f64) -> Result<Answer> {
        Ok(self.0.start(time).err().map(|error| error.to_string()))
    }

    fn advance_to(&mut self, time: f64) -> Result<Answer> {
        Ok(self.0.advance_to(time).err().map(|error| error.to_string()))
    }
}

/// A run of the model in a library. Its scalars are variables, whatever the FMU makes of them.
pub struct Loaded {
    /// The instance, made and no more.
    pub instance: Instance,
    /// Variables of the model.
    pub table: Arc<Table>,
    /// Time reached.
    pub time: f64,
}

impl Loaded {
    fn kind(&self, position: usize) -> &Kind {
        &self.table.variables()[position].kind
    }

    /// What the model says to a call that came back with `done`.
    fn answer(&self, done: Result<()>) -> Result<Answer> {
        let Err(error) = done else { return Ok(None) };
        let said = self.instance.last_message();
        match said.strip_suffix(". This instance has failed") {
            Some(panic) if panic.starts_with(DEFECT) => Err(Error::call(panic, MEND)),
            _ if said.is_empty() => Err(error),
            _ => Ok(Some(said)),
        }
    }
}

impl Run for Loaded {
    fn time(&self) -> f64 {
        self.time
    }

    fn set(&mut self, position: usize, value: f64) -> Result<()> {
        self.instance.set(value_reference(position), &[value])
    }

    fn value(&mut self, position: usize) -> Result<Value> {
        let kind = self.kind(position).clone();
        let values = self.instance.values(&kind, value_reference(position), 1)?;
        Ok(values[0])
    }

    fn start(&mut self, time: f64) -> Result<Answer> {
        self.time = time;
        let entered = self.instance.enter_initialization(time);
        let started = entered.and_then(|()| self.instance.exit_initialization());
        self.answer(started)
    }

    fn advance_to(&mut self, time: f64) -> Result<Answer> {
        let done = self.instance.step(self.time, time - self.time, time);
        let answer = self.answer(done)?;
        if answer.is_none() {
            self.time = time;
        }
        Ok(answer)
    }
}

//! Booleans, texts and binary variables of a simulation.

use super::{Hold, Simulation};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::row::Read;

impl<M: Model> Simulation<M> {
    /// Sets a text or binary input, or such a parameter before the start: see [`Simulation::set`].
    ///
    /// # Errors
    /// As [`Simulation::set`]; a text that is not UTF-8 or holds a zero byte.
    pub fn set_bytes(&mut self, name: &str, bytes: impl AsRef<[u8]>) -> Result<()> {
        self.set_bytes_at(self.position(name)?, bytes.as_ref())
    }

    /// [`Simulation::set_bytes`] without the search.
    ///
    /// # Errors
    /// As [`Simulation::set_bytes`].
    pub fn set_bytes_at(&mut self, position: usize, bytes: &[u8]) -> Result<()> {
        match self.hold(position) {
            // Texts are not tunable.
            Hold::Free => self.values.set_bytes(position, bytes),
            Hold::Tunable | Hold::Frozen => Err(self.frozen(position)),
        }
    }

    /// The boolean called `name`, as of now.
    ///
    /// # Errors
    /// As [`Simulation::integer`].
    pub fn boolean(&self, name: &str) -> Result<bool> {
        self.integer(name).map(|integer| integer != 0)
    }

    /// The text called `name`, as of now.
    ///
    /// # Errors
    /// The model has no such variable, or it holds numbers or bytes that are no text.
    pub fn text(&self, name: &str) -> Result<&str> {
        let bytes = self.bytes(self.position(name)?)?;
        std::str::from_utf8(bytes).map_err(|_| Error::call(format!("{name} is no text"), "Read it as bytes."))
    }

    /// Contents of the text or binary variable at `position`, as of now.
    ///
    /// # Errors
    /// No variable there, one that holds numbers, or a computed one before the start.
    pub fn bytes(&self, position: usize) -> Result<&[u8]> {
        if let Some(bytes) = self.values.bytes(position) {
            return Ok(bytes);
        }
        let computed = position.checked_sub(self.values.as_slice().len());
        match (&self.model, computed.and_then(|computed| self.reads.get(computed))) {
            (Some(model), Some(Read::Bytes(read))) => Ok(read(model)),
            (None, Some(Read::Bytes(_))) => Err(self.no_value(position)),
            _ => Err(match self.variables().get(position) {
                Some(variable) => Error::call(format!("{} is no text", variable.name), "Read it as a number."),
                None => self.table().no_variable(position),
            }),
        }
    }
}

//! Texts and binary variables of an instance by value reference.

use super::Instance;
use super::access::Access;
use crate::error::Result;

impl Instance {
    /// Contents of the text or binary variable behind `reference`.
    ///
    /// # Errors
    /// As [`Instance::get`].
    pub fn get_bytes(&mut self, reference: u32, access: Access) -> Result<&[u8]> {
        let position = self.position(reference, access)?;
        self.check_readable(position)?;
        self.simulation.bytes(position)
    }

    /// Stores the contents of texts or binary variables or, if one of them is refused, none.
    ///
    /// # Errors
    /// As [`Instance::set`]; a text that holds a zero byte.
    pub fn set_bytes(&mut self, references: &[u32], access: Access, contents: &[&[u8]]) -> Result<()> {
        for (reference, bytes) in references.iter().zip(contents) {
            let variable = &self.table.variables()[self.position(*reference, access)?];
            self.check_settable(variable)?;
            variable.check_bytes(bytes)?;
        }
        self.forget_model(references.len());
        for (reference, bytes) in references.iter().zip(contents) {
            let position = self.position(*reference, access)?;
            self.simulation.set_bytes_at(position, bytes)?;
        }
        Ok(())
    }
}

//! Lists whose length changes with time, such as contacts: what a model can tell besides its variables.
//!
//! FMI has no variables of that kind, so no importer sees them. Programs that hold a
//! [`DynSimulation`](crate::DynSimulation) ask for a list by its name.

use crate::unit::Unit;

/// A column of a list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Column {
    /// Name.
    pub name: &'static str,
    /// Unit of its numbers.
    pub unit: Unit,
    /// What it is.
    pub description: &'static str,
}

/// What is known of a list without a model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListInfo {
    /// Name.
    pub name: &'static str,
    /// What a row of it is.
    pub description: &'static str,
    /// Its columns, in the order of the numbers of a row.
    pub columns: &'static [Column],
}

/// A list of a model `M`, and how it is read.
pub struct Listing<M> {
    /// All but how it is read.
    pub info: ListInfo,
    /// Appends the rows as of now, a number for each column.
    pub read: fn(&M, &mut Vec<f64>),
}

impl<M> std::fmt::Debug for Listing<M> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.info.fmt(formatter)
    }
}

/// The rows of a list at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Listed {
    /// Columns and meaning.
    pub info: ListInfo,
    /// Row after row: as many numbers as rows times columns.
    pub numbers: Vec<f64>,
}

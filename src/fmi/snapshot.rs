//! Saved states of an instance: everything that a step, a set or a change of phase can alter, and its bytes.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::life_cycle::Phase;
use crate::error::Result;
use crate::saved_bytes;
use crate::scene::Value;

/// Times of an instance \[s\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Start of the simulation.
    pub start: f64,
    /// Present communication point.
    pub now: f64,
    /// End of the simulation, if the importer gave one.
    pub stop: Option<f64>,
}

/// Saved state of an instance whose scene saves a `State`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot<State> {
    pub(super) phase: Phase,
    pub(super) clock: Clock,
    pub(super) values: Vec<Value>,
    pub(super) scene: Option<State>,
}

impl<State: Serialize + DeserializeOwned> Snapshot<State> {
    /// Bytes for another process or a later day, of the same FMU: the token must match.
    ///
    /// # Errors
    /// The scene's state cannot be written.
    pub fn to_bytes(&self, token: &str) -> Result<Vec<u8>> {
        saved_bytes::write(self, token)
    }

    /// Reads what [`Snapshot::to_bytes`] wrote for the same token.
    ///
    /// # Errors
    /// [`Error::State`](crate::Error::State) that says what is wrong with the bytes.
    pub fn from_bytes(bytes: &[u8], token: &str) -> Result<Self> {
        saved_bytes::read(bytes, token)
    }
}

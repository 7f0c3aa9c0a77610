//! Saved states: everything that a step, a set or a change of phase can alter, and its bytes.
//!
//! Bytes: magic (8), format version (4), length of the token (4), token, length of the payload (8), payload (postcard),
//! CRC-32 of all that precedes (4); little endian. They hold no pointers and may be read by another process, but only by
//! the same FMU: the token must match. Truncated, altered or foreign bytes are refused.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::life_cycle::Phase;
use crate::error::{Error, Result};
use crate::scene::Value;

const MAGIC: [u8; 8] = *b"JOSTLEST";
const FORMAT: u32 = 1;

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
    /// Bytes for another process or a later day.
    ///
    /// # Errors
    /// The scene's state cannot be written.
    pub fn to_bytes(&self, token: &str) -> Result<Vec<u8>> {
        let payload = postcard::to_stdvec(self)
            .map_err(|error| Error::state(format!("it cannot be written ({error})"), "Please report this defect."))?;
        let mut bytes = Vec::with_capacity(MAGIC.len() + 4 + 4 + token.len() + 8 + payload.len() + 4);
        bytes.extend(MAGIC);
        bytes.extend(FORMAT.to_le_bytes());
        bytes.extend((token.len() as u32).to_le_bytes());
        bytes.extend(token.as_bytes());
        bytes.extend((payload.len() as u64).to_le_bytes());
        bytes.extend(payload);
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        Ok(bytes)
    }

    /// Reads what [`Snapshot::to_bytes`] wrote for the same token.
    ///
    /// # Errors
    /// [`Error::State`] that says what is wrong with the bytes.
    pub fn from_bytes(bytes: &[u8], token: &str) -> Result<Self> {
        let mut reader = Reader { rest: bytes };
        if reader.take(MAGIC.len())? != MAGIC {
            return Err(Error::state(
                "these bytes were not written by jostle",
                "Pass the bytes that serialising gave.",
            ));
        }
        let format = u32::from_le_bytes(reader.array()?);
        if format != FORMAT {
            return Err(Error::state(
                format!("format version {format}, this library reads version {FORMAT}"),
                "Restore it with the FMU that wrote it.",
            ));
        }
        let length = u32::from_le_bytes(reader.array()?) as usize;
        let written_for = reader.take(length)?;
        if written_for != token.as_bytes() {
            return Err(Error::state(
                format!(
                    "it was written by the FMU {:?}, this is {token:?}",
                    String::from_utf8_lossy(written_for)
                ),
                "Restore it with the FMU that wrote it.",
            ));
        }
        let length = usize::try_from(u64::from_le_bytes(reader.array()?)).map_err(|_| truncated())?;
        let payload = reader.take(length)?;
        let covered = bytes.len() - reader.rest.len();
        let checksum = u32::from_le_bytes(reader.array()?);
        if !reader.rest.is_empty() || checksum != crc32fast::hash(&bytes[..covered]) {
            return Err(damaged("checksum or length do not fit"));
        }
        let (snapshot, rest): (Self, _) =
            postcard::take_from_bytes(payload).map_err(|error| damaged(&error.to_string()))?;
        if rest.is_empty() {
            Ok(snapshot)
        } else {
            Err(damaged("it is too long"))
        }
    }
}

struct Reader<'bytes> {
    rest: &'bytes [u8],
}

impl<'bytes> Reader<'bytes> {
    fn take(&mut self, count: usize) -> Result<&'bytes [u8]> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or_else(truncated)?;
        self.rest = rest;
        Ok(taken)
    }

    fn array<const COUNT: usize>(&mut self) -> Result<[u8; COUNT]> {
        self.take(COUNT)?.try_into().map_err(|_| truncated())
    }
}

fn truncated() -> Error {
    damaged("it is truncated or its lengths are wrong")
}

fn damaged(what: &str) -> Error {
    Error::state(
        format!("the bytes are damaged: {what}"),
        "Pass the bytes that serialising gave, all and unaltered.",
    )
}

//! Saved states as bytes: any value in, bytes for another process or a later day out, and back.
//!
//! Magic (8), format version (4), length of the owner (4), owner, length of the payload (8), payload (postcard), CRC-32 of
//! all that precedes (4); little endian. They hold no pointers. The owner is text that says for whom they were written and
//! must match. Truncated, altered or foreign bytes are refused; what the payload holds is for the owner to check.

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};

const MAGIC: [u8; 8] = *b"FMICOMPT";
const FORMAT: u32 = 2;

/// Bytes of `value`, written for `owner`.
///
/// # Errors
/// The value cannot be written: a defect.
pub fn write(value: &impl Serialize, owner: &str) -> Result<Vec<u8>> {
    let payload = to_payload(value)?;
    let mut bytes = Vec::with_capacity(MAGIC.len() + 4 + 4 + owner.len() + 8 + payload.len() + 4);
    bytes.extend(MAGIC);
    bytes.extend(FORMAT.to_le_bytes());
    bytes.extend((owner.len() as u32).to_le_bytes());
    bytes.extend(owner.as_bytes());
    bytes.extend((payload.len() as u64).to_le_bytes());
    bytes.extend(payload);
    bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
    Ok(bytes)
}

/// Reads what [`write()`] wrote for the same owner.
///
/// # Errors
/// [`Error::State`] that says what is wrong with the bytes.
pub fn read<'bytes, Saved: Deserialize<'bytes>>(bytes: &'bytes [u8], owner: &str) -> Result<Saved> {
    let mut reader = Reader { rest: bytes };
    if reader.take(MAGIC.len())? != MAGIC {
        return Err(Error::state(
            "these bytes are not a saved state",
            "Pass the bytes that saving gave.",
        ));
    }
    let format = u32::from_le_bytes(reader.array()?);
    if format != FORMAT {
        return Err(Error::state(
            format!("format version {format}, this library reads version {FORMAT}"),
            "Restore it with the version that wrote it.",
        ));
    }
    let length = u32::from_le_bytes(reader.array()?) as usize;
    let written_for = reader.take(length)?;
    if written_for != owner.as_bytes() {
        return Err(Error::state(
            format!(
                "it was written for {:?}, this is {owner:?}",
                String::from_utf8_lossy(written_for)
            ),
            "Restore it where it was saved: the same model, choices and version.",
        ));
    }
    let length = usize::try_from(u64::from_le_bytes(reader.array()?)).map_err(|_| truncated())?;
    let payload = reader.take(length)?;
    let covered = bytes.len() - reader.rest.len();
    let checksum = u32::from_le_bytes(reader.array()?);
    if !reader.rest.is_empty() || checksum != crc32fast::hash(&bytes[..covered]) {
        return Err(damaged("checksum or length do not fit"));
    }
    from_payload(payload)
}

/// What [`write()`] puts between header and checksum: for an owner who writes it as a part of another value.
pub(crate) fn to_payload(value: &impl Serialize) -> Result<Vec<u8>> {
    postcard::to_stdvec(value)
        .map_err(|error| Error::state(format!("it cannot be written ({error})"), "Please report this defect."))
}

/// Reads what [`to_payload`] wrote, all of it.
pub(crate) fn from_payload<'bytes, Saved: Deserialize<'bytes>>(payload: &'bytes [u8]) -> Result<Saved> {
    match postcard::take_from_bytes(payload) {
        Ok((saved, [])) => Ok(saved),
        Ok(_) => Err(damaged("it is too long")),
        Err(error) => Err(damaged(&error.to_string())),
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
        "Pass the bytes that saving gave, all and unaltered.",
    )
}

//! Lists that live as long as the program, read back from bytes that do.

use serde::{Deserialize, Deserializer};

/// A list whose memory is not given back: descriptions are read a few times in the life of a program.
pub fn leaked<'de, T: Deserialize<'de>, D: Deserializer<'de>>(deserializer: D) -> Result<&'static [T], D::Error> {
    Vec::deserialize(deserializer).map(|list| &*list.leak())
}

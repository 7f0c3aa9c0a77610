//! Instantiation token (FMI 3.0) and GUID (FMI 2.0): which scene and choice a library is to run, and a fingerprint.
//!
//! The choice made when an FMU is bundled travels in the token, so that no resource file has to be found and read, and
//! the fingerprint of the variable table tells a model description that belongs to another library.
//!
//! ```text
//! jostle:packing:molecular-dynamics:input:disks=60:1f0c3a5be2d49768
//! ```

use crate::error::{Error, Result};
use crate::scene::variables::fingerprint;
use crate::scene::{Card, Choice, Scene, Variable};

/// Token of a scene bundled with `choice`.
pub fn write(card: &Card, choice: Choice, rows: &[Variable]) -> String {
    format!("{}{}:{:016x}", prefix(card), choice.disks, fingerprint(rows))
}

/// Choice and rows that `token` stands for.
///
/// # Errors
/// The token is of another scene or of a library with other variables.
pub fn read<S: Scene>(token: &str) -> Result<(Choice, Vec<Variable>)> {
    let card = S::card();
    let refused = |expected: String| {
        Error::call(
            format!("the instantiation token is {token:?}, this library expects {expected:?}"),
            "Take modelDescription.xml and the binary from the same FMU.",
        )
    };
    let shape = || format!("{}N:...", prefix(&card));
    let rest = token.strip_prefix(&prefix(&card)).ok_or_else(|| refused(shape()))?;
    let disks = rest.split(':').next().and_then(|disks| disks.parse().ok());
    let disks = disks
        .filter(|disks| card.disks.contains(disks))
        .ok_or_else(|| refused(shape()))?;
    let choice = Choice { disks };
    let rows = S::variables(choice);
    let expected = write(&card, choice, &rows);
    if token != expected {
        return Err(refused(expected));
    }
    Ok((choice, rows))
}

fn prefix(card: &Card) -> String {
    format!("jostle:{}:{}:{}:disks=", card.scene, card.engine, card.drive)
}

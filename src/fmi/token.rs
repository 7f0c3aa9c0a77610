//! Instantiation token (FMI 3.0) and GUID (FMI 2.0): which scene and choice a library is to run, and a fingerprint.
//!
//! The choice made when an FMU is bundled travels in the token, so that no resource file has to be found and read, and
//! the fingerprint of the variable table tells a model description that belongs to another library.
//!
//! ```text
//! jostle:packing:molecular-dynamics:input:disks=60:1f0c3a5be2d49768
//! jostle:packing:molecular-dynamics:input:disks=60:arrays:1f0c3a5be2d49768    what has an index is one array
//! ```

use crate::error::{Error, Result};
use crate::scene::variables::fingerprint;
use crate::scene::{Card, Choice, Scene, Variable};

/// What a token stands for.
#[derive(Debug, Clone, PartialEq)]
pub struct Contents {
    /// What was decided when the FMU was bundled.
    pub choice: Choice,
    /// Variables for this choice.
    pub rows: Vec<Variable>,
    /// Computed variables with an index are arrays (FMI 3.0), see [`super::arrays`].
    pub arrays: bool,
}

/// Token of a scene bundled with `choice`, all variables scalar.
pub fn write(card: &Card, choice: Choice, rows: &[Variable]) -> String {
    compose(card, choice, rows, false)
}

/// Token of a scene bundled with `choice`, with arrays if `arrays` says so.
pub fn compose(card: &Card, choice: Choice, rows: &[Variable], arrays: bool) -> String {
    let layout = if arrays { ":arrays" } else { "" };
    format!("{}{}{layout}:{:016x}", prefix(card), choice.disks, fingerprint(rows))
}

/// What `token` stands for.
///
/// # Errors
/// The token is of another scene or of a library with other variables.
pub fn read<S: Scene>(token: &str) -> Result<Contents> {
    let card = S::card();
    let refused = |expected: String| {
        Error::call(
            format!("the instantiation token is {token:?}, this library expects {expected:?}"),
            "Take modelDescription.xml and the binary from the same FMU.",
        )
    };
    let shape = || format!("{}N:...", prefix(&card));
    let rest = token.strip_prefix(&prefix(&card)).ok_or_else(|| refused(shape()))?;
    let mut parts = rest.split(':');
    let disks = parts.next().and_then(|disks| disks.parse().ok());
    let disks = disks
        .filter(|disks| card.disks.contains(disks))
        .ok_or_else(|| refused(shape()))?;
    let (choice, arrays) = (Choice { disks }, parts.next() == Some("arrays"));
    let rows = S::variables(choice);
    let expected = compose(&card, choice, &rows, arrays);
    if token != expected {
        return Err(refused(expected));
    }
    Ok(Contents { choice, rows, arrays })
}

fn prefix(card: &Card) -> String {
    format!("jostle:{}:{}:{}:disks=", card.scene, card.engine, card.drive)
}

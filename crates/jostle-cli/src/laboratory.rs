//! The components of the shaker laboratory, which have neither engines nor drives nor disks.

use jostle::Error;
use jostle::scene::ModelType;

use crate::selection::Selection;

/// The component of this name.
pub fn find(name: &str) -> Option<ModelType> {
    shaker_lab::ALL
        .iter()
        .copied()
        .find(|model| (model.info)().name == name)
}

/// All components as a text for the help.
pub fn list() -> String {
    let names: Vec<&str> = shaker_lab::ALL.iter().map(|model| (model.info)().name).collect();
    format!(
        "Components of the shaker laboratory, without engine, drive and disks:\n  {}",
        names.join(", ")
    )
}

/// Refuses options that only scenes have.
///
/// # Errors
/// One of them was given.
pub fn refuse_options(selection: &Selection, drive: Option<&str>) -> Result<(), Error> {
    let disks = selection.disks.map(|disks| disks.to_string());
    let given = [
        ("--engine", selection.engine.as_deref()),
        ("--drive", drive),
        ("--disks", disks.as_deref()),
    ];
    match given.into_iter().find_map(|(option, value)| Some((option, value?))) {
        None => Ok(()),
        Some((option, value)) => {
            let allowed = format!("no option of {}, a component of the shaker laboratory", selection.scene);
            Err(Error::parameter(option, value, allowed, "Leave it out."))
        }
    }
}

//! The C library: any scene by name, behind one opaque pointer. The header is `include/jostle.h`.
//!
//! Needs: a caller that passes pointers of the size it says, and no simulation that it has freed. Guarantees: everything
//! else is checked; a panic stays in its own simulation; no globals, so that the library may be loaded and unloaded. Not
//! here: the scenes (`jostle::scene`), FMI (`fmi_component`).
#![allow(unsafe_code)] // pointers of the caller are followed here; nothing else in this crate needs to be
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // those of clippy.toml

mod creation;
mod handle;
mod listing;
mod saving;
mod text;
mod texts;
mod values;

pub use creation::{JostleSetting, jostle_free, jostle_new, jostle_new_from_toml};
pub use handle::{JostleSimulation, JostleStatus, jostle_error_text};
pub use listing::{
    JostleCausality, JostleKind, JostleVariable, jostle_scenes, jostle_variable, jostle_variable_count, jostle_version,
};
pub use saving::{jostle_restore, jostle_save};
pub use values::{
    jostle_advance_to, jostle_find, jostle_get, jostle_get_by_name, jostle_get_integer_by_name, jostle_get_integers,
    jostle_limit_work, jostle_set, jostle_set_by_name, jostle_time,
};

#[cfg(test)]
mod tests;

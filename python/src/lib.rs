//! The extension module `jostle._core`: one class, [`core::Core`], that holds any scene. What users see is Python, in `../jostle`.
//!
//! Needs: buffers of doubles from the caller. Guarantees: the bits of the FMU and the C library; the interpreter is free while
//! a step is done; one thread at a time in a simulation, and a second one is refused; a panic stays in its own simulation.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // those of clippy.toml

mod core;
mod entry;
mod refusal;
mod variables;

use pyo3::prelude::*;

#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::core::{Core, State};
    #[pymodule_export]
    use crate::variables::scenes;

    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}

//! Scenes of jostle as a WebAssembly module: what the page in `page/` calls. `scripts/web` builds it.
//!
//! A page holds simulations by number ([`Module`]). Texts and numbers go through buffers of the module, of which the
//! page gets the address ([`exports`]). Not here: what is drawn (`page/`).
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // those of clippy.toml

mod exports;
mod module;
mod shown;
mod text;

pub use module::Module;

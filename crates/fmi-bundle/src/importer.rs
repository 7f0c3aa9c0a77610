//! The other side: a library that was taken out of an FMU, or that cargo made, loaded and driven through FMI 3.0.
//!
//! The only unsafe code of this crate is in the files of this module: C functions of a library that is known at run time alone. The
//! rest of the crate calls their safe methods, which keep each pointer alive for as long as the library may use it.

mod instance;
mod library;
mod typed;

pub use instance::Instance;
pub use library::{Library, MAKE_ANEW};

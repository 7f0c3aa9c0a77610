//! Vibrated granular disks as components that plug into other people's simulations.
//!
//! SI units throughout; x to the right, y up, angles and angular velocities counter-clockwise.
//! Imports point one way: `scene -> measure -> engine, packing -> contact, collision, drive -> geometry`. Only `scene` knows the crate
//! `fmi_component`, which makes a co-simulation component of a scene.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod clone_in_place;
pub mod collision;
pub mod contact;
pub mod drive;
pub mod elementary;
pub mod engine;
pub mod error;
pub mod geometry;
pub mod measure;
pub mod packing;
pub mod scene;

pub use fmi_component::{Error, Result};

/// The programs of the guide run with the tests of the documentation.
#[cfg(all(doctest, feature = "toml"))]
#[doc = include_str!("../docs/rust.md")]
pub struct GuideForRust;

//! A shaker laboratory as components: what moves the box of P (chapter 2), what measures it, what controls it.
//!
//! ```text
//! gamma_controller -> voltage -> loudspeaker -> motion of the base -> grains (another component) -> force -> loudspeaker
//!        ^                          acceleration                        angles
//!        '------- accelerometer <--------'                                '--> camera
//!                      '--> spectral_amplitude
//! ```
//!
//! Each model is a struct whose fields are its variables; `fmi_component` makes an FMU of it. Guarantees: the same inputs and seed give
//! the same bits on every system. Inputs are taken as they are at the beginning of a step. The Python package `jostle_lab` holds a second,
//! independent implementation of each. Not here: grains.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))] // those of clippy.toml

mod accelerometer;
mod camera;
mod gamma_controller;
mod instants;
mod loudspeaker;
mod low_pass;
mod noise;
mod spectral_amplitude;
mod spectrum;
mod transition;

pub use accelerometer::{Accelerometer, STANDARD_GRAVITY};
pub use camera::{Camera, DISKS};
pub use gamma_controller::GammaController;
pub use loudspeaker::Loudspeaker;
pub use spectral_amplitude::SpectralAmplitude;

use fmi_component::{Export, ModelType};

/// All models; the library of `loudspeaker` is `jostle_loudspeaker`.
pub static ALL: [ModelType; 5] = [
    model::<Accelerometer>(),
    model::<Camera>(),
    model::<GammaController>(),
    model::<Loudspeaker>(),
    model::<SpectralAmplitude>(),
];

const fn model<E: Export>() -> ModelType {
    ModelType::of::<E::Model>()
}

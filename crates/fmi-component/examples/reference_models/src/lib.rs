//! The models of the Reference FMUs of the Modelica Association, written anew from their published equations, with the fixed time steps
//! of their model descriptions: <https://github.com/modelica/Reference-FMUs>. `tests/trajectories.rs` compares what they compute.
//!
//! Each is exported by the example of its name, and `cargo run -p reference-models FOLDER` writes the FMUs once
//! `cargo build -p reference-models --examples` has built these libraries.

mod bouncing_ball;
mod dahlquist;
mod feedthrough;
mod resource;
mod stair;
mod state_space;
mod van_der_pol;

pub use bouncing_ball::BouncingBall;
pub use dahlquist::Dahlquist;
pub use feedthrough::{Choice, Feedthrough};
pub use resource::Resource;
pub use stair::Stair;
pub use state_space::StateSpace;
pub use van_der_pol::VanDerPol;

use fmi_component::{Export, ModelType};

/// All models, each with the name of the library that exports it.
pub static ALL: [(&str, ModelType); 7] = [
    ("bouncing_ball", model::<BouncingBall>()),
    ("dahlquist", model::<Dahlquist>()),
    ("feedthrough", model::<Feedthrough>()),
    ("resource", model::<Resource>()),
    ("stair", model::<Stair>()),
    ("state_space", model::<StateSpace>()),
    ("van_der_pol", model::<VanDerPol>()),
];

/// The model of a component.
pub const fn model<E: Export>() -> ModelType {
    ModelType::of::<E::Model>()
}

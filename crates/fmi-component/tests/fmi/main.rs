//! The FMI boundary through its exported C functions, with the oscillators behind it.
#![allow(unsafe_code, clippy::undocumented_unsafe_blocks, clippy::unwrap_used)]

mod abuse;
mod arrays_and_derivatives;
mod client;
mod decay;
mod events;
mod exports;
mod intermediate;
mod life_cycle;
mod listener;
mod many;
mod state_table;
mod states;
mod tunable;

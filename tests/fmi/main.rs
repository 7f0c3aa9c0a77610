//! The FMI boundary through its exported C functions, with the probe scene behind it.
#![allow(unsafe_code, clippy::undocumented_unsafe_blocks, clippy::unwrap_used)]

mod abuse;
mod arrays_and_derivatives;
mod bundle;
mod client;
mod events;
mod intermediate;
mod life_cycle;
mod listener;
mod many;
mod state_table;
mod states;

//! The derive macros of `fmi-component`: a struct whose fields are the variables in, its table of variables and its state out.
//!
//! Needs: a struct with named fields. Guarantees: what it cannot translate is an error at the attribute or field, which says
//! what to write. Not here: what the generated code calls (`fmi_component::derived`).
//!
//! ```text
//! attributes -> field (role, type, facts) -> rows, start, inputs, state
//! ```

mod component;
mod enumeration;
#[cfg(test)]
mod error_tests;
mod facts;
mod field;
mod rows;
mod shape;
mod text;
mod unit;

use proc_macro::TokenStream;
use syn::{DeriveInput, parse_macro_input};

/// Makes a component of a struct: its fields are variables of an FMU and states.
///
/// - `#[parameter(start = ..)]`, `#[input]`, `#[output]`, `#[calculated]` before a field make it a variable. In parentheses `start`, `min`, `max`,
///   `unit`, `nominal`, `name`, `mime_type` with values; of inputs and outputs `derivative`, and `discrete`; of parameters `tunable`.
/// - `#[state(start = ..)]`, or no attribute: part of saved states alone; `#[state(skip)]` not even that.
/// - `#[component(name = "..", stop_time = 1.0, step_size = 0.01)]` before the struct.
///
/// Documentation comments are the descriptions. What the component does is `impl CoSimulation`. The README of `fmi-component` has the types.
#[proc_macro_derive(Component, attributes(component, parameter, calculated, input, output, state))]
pub fn derive_component(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    component::expand(&input)
        .unwrap_or_else(|error| error.to_compile_error())
        .into()
}

/// Makes the options of a variable of an `enum` without fields. `#[enumeration(name = "..")]` renames the type or an option. Derive `Clone`,
/// `Copy` and `PartialEq` too; serde's `Serialize` and `Deserialize` are made here.
#[proc_macro_derive(Enumeration, attributes(enumeration))]
pub fn derive_enumeration(input: TokenStream) -> TokenStream {
    let input = parse_macro_input!(input as DeriveInput);
    enumeration::expand(&input)
        .unwrap_or_else(|error| error.to_compile_error())
        .into()
}

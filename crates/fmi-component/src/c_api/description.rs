//! `fmi_component_describe`, the one exported function that no standard knows: a library tells what its model is.
//!
//! ```c
//! /* choices: lines NAME=NUMBER of structural parameters, zero-terminated; null for the defaults.
//!    take is called once with bytes that are gone when it returns; environment is passed on to it.
//!    Returns 0: they are a description; 1: they are the text of an error, UTF-8; 2: take is null, nothing was done. */
//! int32_t fmi_component_describe(const char* choices, void* environment,
//!                                void (*take)(void* environment, const uint8_t* bytes, size_t count));
//! ```
//!
//! No memory changes hands. The format of the bytes is that of [`Description`]; should this signature ever
//! change, the function gets another name.

use std::ffi::{c_char, c_int};
use std::panic::{AssertUnwindSafe, catch_unwind};

use super::types::Opaque;
use crate::description::Description;
use crate::dynamic::ModelType;
use crate::handle::describe as describe_panic;
use crate::memory;

/// The function that takes the bytes.
pub type Take = unsafe extern "C" fn(Opaque, *const u8, usize);

/// Returned with a description.
pub const DESCRIBED: c_int = 0;
/// Returned with the text of an error.
pub const REFUSED: c_int = 1;
/// Returned with nothing.
pub const NO_TAKER: c_int = 2;

/// `fmi_component_describe`.
///
/// # Safety
/// `choices` is null or zero-terminated; `take` is null or a function that may be called with `environment`.
pub unsafe fn describe(model: &ModelType, choices: *const c_char, environment: Opaque, take: Option<Take>) -> c_int {
    let Some(take) = take else { return NO_TAKER };
    let work = || {
        let choices = match choices.is_null() {
            true => String::new(),
            // SAFETY: by the caller's promise.
            false => unsafe { memory::text(choices, "choices") }?,
        };
        Description::of(model, &choices)?.to_bytes()
    };
    let (status, bytes) = match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(bytes)) => (DESCRIBED, bytes),
        Ok(Err(error)) => (REFUSED, error.to_string().into_bytes()),
        Err(panic) => (REFUSED, describe_panic(&*panic).into_bytes()),
    };
    // SAFETY: by the caller's promise; the bytes live until the call returns.
    unsafe { take(environment, bytes.as_ptr(), bytes.len()) };
    status
}

/// Exports `fmi_component_describe`. Used by [`export_fmu!`](crate::export_fmu).
#[doc(hidden)]
#[macro_export]
macro_rules! __export_description {
    ($model:expr) => {
        #[allow(unsafe_code, non_snake_case)] // an exported name; a name that no module of the caller has
        mod __fmi_component_description {
            use super::*; // in a module, as the functions of FMI are: a path of the caller means the same in all three

            static MODEL: &$crate::ModelType = $model;

            #[unsafe(no_mangle)]
            unsafe extern "C" fn fmi_component_describe(
                choices: *const ::std::ffi::c_char,
                environment: $crate::c_api::Opaque,
                take: ::std::option::Option<$crate::c_api::description::Take>,
            ) -> ::std::ffi::c_int {
                // SAFETY: the caller's promise about its pointers, passed on unchanged.
                unsafe { $crate::c_api::description::describe(MODEL, choices, environment, take) }
            }
        }
    };
}

//! The C library with small scenes.
#![no_main]

#[path = "../harness/c_calls.rs"]
mod c_calls;
#[path = "../harness/hand.rs"]
mod hand;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| c_calls::run(bytes));

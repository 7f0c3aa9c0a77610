//! The C library with small scenes.
#![no_main]

#[path = "../harness/c_calls.rs"]
mod c_calls;
#[path = "../harness/hand.rs"]
mod hand;
#[path = "../harness/mutate.rs"]
mod mutate;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| c_calls::run(bytes));
libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    mutate::mutate(data, size, most, seed)
});

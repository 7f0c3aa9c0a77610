//! Both versions of FMI with the oscillators, which refuse and panic when set to.
#![no_main]

#[path = "../harness/fmi.rs"]
mod fmi;
#[path = "../harness/fmi_calls.rs"]
mod fmi_calls;
#[path = "../harness/hand.rs"]
mod hand;
#[path = "../harness/oscillators.rs"]
mod library;
#[path = "../harness/lives.rs"]
mod lives;
#[path = "../harness/mutate.rs"]
mod mutate;
#[path = "../harness/tokens.rs"]
mod tokens;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fmi_calls::run(bytes));
libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    mutate::mutate(data, size, most, seed)
});

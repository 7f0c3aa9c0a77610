//! Both versions of FMI with the probe scene, which refuses and panics when told to.
#![no_main]

#[path = "../harness/fmi.rs"]
mod fmi;
#[path = "../harness/fmi_calls.rs"]
mod fmi_calls;
#[path = "../harness/hand.rs"]
mod hand;
#[path = "../harness/lives.rs"]
mod lives;
#[path = "../harness/mutate.rs"]
mod mutate;

mod library {
    pub use fmu_probe::{Probe as Scene, fmi2, fmi3};
    pub const LONGEST_STEP: f64 = 1e300;
    pub fn choices() -> Vec<u32> {
        vec![3, 1]
    }
}

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fmi_calls::run(bytes));
libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, most: usize, seed: u32| {
    mutate::mutate(data, size, most, seed)
});

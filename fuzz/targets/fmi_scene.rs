//! Both versions of FMI with a scene that is shipped: hard disks on a base that follows the inputs.
#![no_main]

#[path = "../harness/fmi.rs"]
mod fmi;
#[path = "../harness/fmi_calls.rs"]
mod fmi_calls;
#[path = "../harness/hand.rs"]
mod hand;

mod library {
    pub use jostle::scene::packing::event_driven::HardPackingOnInput as Subject;
    pub const DISKS: u32 = 3;
    pub const LONGEST_STEP: f64 = 0.05;
    jostle::export_fmu!(jostle::scene::packing::event_driven::HardPackingOnInput);
}

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fmi_calls::run(bytes));

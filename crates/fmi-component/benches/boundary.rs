//! Cost of the FMI boundary: `cargo bench -p fmi-component --bench boundary`.
//!
//! Nanoseconds of each call behind the exported functions of FMI 3.0, beside the same step of the model in Rust alone. Built for
//! the generic x86-64 that ships.

mod importer;

use oscillators::Oscillators;

fn main() {
    importer::measure::<Oscillators>(&[("bodies", 3)], 1e-9, 20_000);
    importer::measure::<Oscillators>(&[("bodies", 100)], 1e-9, 2_000);
}

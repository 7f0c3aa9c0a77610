//! How molecular dynamics converges to hard disks as contacts stiffen, as CSV.
//!
//! `cargo run --release -p jostle-bench --example two_engines`; drawn by `python -m jostle_lab figure engines`.
#![allow(clippy::unwrap_used)] // the module is shared with the test of the same name

#[path = "../../../tests/support/four_disks.rs"]
mod four_disks;

fn main() {
    println!("normal_stiffness,difference");
    for exponent in 10..=20 {
        let stiffness = 10_f64.powf(f64::from(exponent) / 2.0);
        println!("{stiffness:e},{:e}", four_disks::difference(stiffness));
    }
}

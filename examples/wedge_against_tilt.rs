//! Angular velocity of a disk in a vibrated wedge against the tilt of the wedge, as CSV:
//! `cargo run --release --example wedge_against_tilt`.
//!
//! The scene is chosen by name, as on the command line. The disk turns one way at small tilts and the other way at large
//! ones.

use jostle::scene::{AnySimulation, Selection};

const SECONDS: f64 = 1000.0;

fn main() -> jostle::Result<()> {
    let selection = Selection {
        engine: Some("map"),
        ..Selection::of("wedge")
    };
    println!("tilt [degrees],R omega / (A omega_b)");
    for degrees in (0..30).step_by(3) {
        let tilt = f64::from(degrees).to_radians().to_string();
        let mut wedge = AnySimulation::new(selection, &[("wedge.tilt", &tilt), ("seed", "1")])?;
        wedge.advance_to(SECONDS)?;
        println!("{degrees},{}", wedge.real("scaled_angular_velocity")?);
    }
    Ok(())
}

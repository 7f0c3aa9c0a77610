//! A packing on a shaken base, as a Rust program.

use std::f64::consts::TAU;

use jostle::scene::Simulation;
use jostle::scene::packing::PackingOnInput;

const AMPLITUDE: f64 = 1e-3;
const OMEGA: f64 = TAU * 20.0;
const STEP: f64 = 1.0 / 512.0;
const STEPS: u32 = 1024;

fn main() -> jostle::Result<()> {
    let mut packing = Simulation::<PackingOnInput>::new(&[("disks", 60)], &[("seed", 1.into())])?;
    let mut force = 0.0;
    for n in 0..STEPS {
        let time = f64::from(n) * STEP;
        packing.set("base.displacement", AMPLITUDE * (1.0 - (OMEGA * time).cos()))?;
        packing.set("base.velocity", AMPLITUDE * OMEGA * (OMEGA * time).sin())?;
        packing.advance_to(time + STEP)?;
        force += packing.real("base.reaction_force")? / f64::from(STEPS);
    }
    println!("angle of disk 1: {} rad", packing.real("disk.angle[1]")?);
    println!("mean force on the base: {force} N");
    Ok(())
}

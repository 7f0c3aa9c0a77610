//! The same bits on every system: a checksum over all values of every scene along a short run.
//!
//! Regression: `tests/same_bits.txt` holds what x86-64 Linux computes, so that any other system which runs this test, or the
//! same one with another C library, shows the first difference. After a change of the physics that is meant:
//! `UPDATE_SAME_BITS=1 cargo test --test same_bits`, and a line in the change log.

#![allow(clippy::unwrap_used)]

use std::fmt::Write;

use jostle::elementary::{cos, sin};
use jostle::scene::{DynSimulation, MODELS, StructuralParameters, Value};

const STEPS: u32 = 64;
const STEP: f64 = 1.0 / 512.0;
/// Of the base, where it follows inputs: 1 mm at 20 Hz, three times gravity.
const AMPLITUDE: f64 = 1e-3;
const OMEGA: f64 = std::f64::consts::TAU * 20.0;

fn set(simulation: &mut dyn DynSimulation, name: &str, value: f64) {
    let table = simulation.values().table().clone();
    if let Some(position) = table
        .position(name)
        .filter(|&position| position < table.settable().len())
    {
        simulation.set_at(position, Value::Real(value)).unwrap();
    }
}

fn checksum(simulation: &mut dyn DynSimulation) -> u32 {
    set(simulation, "drive.amplitude", AMPLITUDE);
    simulation.start(0.0).unwrap();
    let mut hasher = crc32fast::Hasher::new();
    for n in 0..STEPS {
        let phase = OMEGA * f64::from(n) * STEP;
        set(simulation, "base.displacement", AMPLITUDE * (1.0 - cos(phase)));
        set(simulation, "base.velocity", AMPLITUDE * OMEGA * sin(phase));
        simulation.advance_to(f64::from(n + 1) * STEP).unwrap();
        let table = simulation.values().table().clone();
        // All but how it is computed.
        let rows = table.variables().iter().enumerate();
        for (position, _) in rows.filter(|(_, row)| !row.outside_states) {
            match simulation.value(position).unwrap() {
                Value::Real(real) => hasher.update(&real.to_bits().to_le_bytes()),
                Value::Integer(integer) => hasher.update(&integer.to_le_bytes()),
            }
        }
    }
    hasher.finalize()
}

#[test]
fn every_scene_computes_the_same_bits_on_every_system() {
    let mut found = String::new();
    for model in MODELS {
        let info = (model.info)();
        let disks = 20.min(*info.structure[0].range.end());
        let structure = StructuralParameters::choose(&info, &[("disks", disks)]).unwrap();
        let sum = checksum(&mut *(model.prepare)(structure));
        writeln!(found, "{} {sum:08x}", info.identifier).unwrap();
    }
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/same_bits.txt");
    if std::env::var_os("UPDATE_SAME_BITS").is_some() {
        std::fs::write(file, &found).unwrap();
    }
    assert_eq!(
        found,
        std::fs::read_to_string(file).unwrap(),
        "other bits than those of the record"
    );
}

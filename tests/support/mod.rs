//! What several integration tests share.
#![allow(dead_code, clippy::unwrap_used)]

pub mod four_disks;
pub mod impact_propagator;
pub mod reference_impact;
pub mod sawtooth_distance;
pub mod soft_disks;
pub mod thrown_disk;

use jostle::scene::{Kind, Model, Simulation, StructuralParameters, Value};

/// A simulation of `disks` disks at time 0 with some parameters changed.
pub fn simulation_of<M: Model>(disks: u32, changes: &[(&str, f64)]) -> Simulation<M> {
    let structure = StructuralParameters::choose(&M::info(), &[("disks", disks)]).unwrap();
    let mut simulation = Simulation::prepare(structure);
    for (name, value) in changes {
        let position = simulation.position(name).unwrap();
        let value = match simulation.variables()[position].kind {
            Kind::Real(_) => Value::Real(*value),
            _ => Value::Integer(*value as i64),
        };
        simulation.set_at(position, value).unwrap();
    }
    simulation.start(0.0).unwrap();
    simulation
}

/// Order of convergence between two errors whose steps differ by `ratio`.
pub fn order(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).abs().ln() / ratio.ln()
}

//! What several integration tests share.
#![allow(dead_code, clippy::unwrap_used)]

pub mod four_disks;
pub mod impact_propagator;
pub mod reference_impact;
pub mod sawtooth_distance;

use std::sync::Arc;

use jostle::scene::{Choice, Scene, Table, Value, Values};

/// Start values of a scene with some parameters changed.
pub fn values_of<S: Scene>(choice: Choice, changes: &[(&str, f64)]) -> Values {
    let mut values = Values::new(Arc::new(Table::new(S::variables(choice))));
    for (name, value) in changes {
        let value = if *name == "seed" {
            Value::Integer(*value as i64)
        } else {
            Value::Real(*value)
        };
        values.set_by_name(name, value).unwrap();
    }
    values
}

/// All values of a scene now.
pub fn outputs_of<S: Scene>(scene: &S, values: &Values) -> Values {
    let mut seen = values.clone();
    scene.write_outputs(seen.writer());
    seen
}

/// Order of convergence between two errors whose steps differ by `ratio`.
pub fn order(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (coarse / fine).abs().ln() / ratio.ln()
}

//! The reference trajectory in an FMU: short enough that rounding stays rounding.

#![allow(clippy::unwrap_used)]

#[path = "support/fmus.rs"]
mod fmus;

use fmi_bundle::{TOLERANCE, reference};
use jostle::scene::catalogue::MODELS;
use jostle::scene::{Causality, Kind, ModelType, Value};

/// Largest relative difference between the reference and a run in which gravity is one unit in the last place greater:
/// that touches every collision, as another rounding of a sine would. Packings that are settled first, by arithmetic that gives
/// the same bits everywhere, get greater friction instead, which does not act while they settle.
fn growth(model: &ModelType) -> f64 {
    let disks = (model.info)().structure[0].default;
    let component = fmus::component(model, disks);
    let identifier = &component.info().identifier;
    let reference = reference::record(&component).unwrap();
    let mut lines = reference.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(|value| value.parse().unwrap()).collect())
        .collect();
    let table = component.table();
    let settled = table
        .position("initial.settled")
        .map(|position| table.variables()[position].start());
    let name = match settled {
        Some(Value::Integer(1)) => "contact.friction",
        _ => "gravity",
    };
    let changed = table.position(name).unwrap();
    let Kind::Real(quantity) = &table.variables()[changed].kind else {
        panic!("{name} is real")
    };
    let mut twin = (model.prepare)(component.structure().clone());
    twin.set_at(changed, quantity.start.next_up().into()).unwrap();
    assert!(rows.len() > 16, "{identifier} refuses its reference");
    for (index, name) in names.iter().enumerate().skip(1) {
        let position = table.position(name).unwrap();
        if table.variables()[position].causality == Causality::Input {
            twin.set_at(position, rows[0][index].into()).unwrap();
        }
    }
    twin.start(0.0).unwrap();
    let mut largest: f64 = 0.0;
    for (number, row) in rows.iter().enumerate() {
        for (index, name) in names.iter().enumerate().skip(1) {
            let position = table.position(name).unwrap();
            let variable = &table.variables()[position];
            if variable.causality == Causality::Input {
                twin.set_at(position, row[index].into()).unwrap();
                continue;
            }
            let nominal = match &variable.kind {
                Kind::Real(quantity) => quantity.nominal,
                _ => 1.0,
            };
            let found = twin.value(position).unwrap().to_f64();
            let size = rows.iter().map(|row| row[index].abs()).fold(nominal, f64::max);
            largest = largest.max((found - row[index]).abs() / size);
        }
        if let Some(next) = rows.get(number + 1) {
            twin.advance_to(next[0]).unwrap();
        }
    }
    println!("{identifier}: {largest:e}");
    largest
}

#[test]
fn reference_trajectories_are_short() {
    let grown: Vec<f64> = MODELS.iter().copied().map(growth).collect();
    assert!(
        grown.iter().any(|grown| *grown > 0.0),
        "gravity has no effect: {grown:?}"
    );
    assert!(grown.iter().all(|grown| *grown < TOLERANCE / 1e3), "{grown:?}");
}

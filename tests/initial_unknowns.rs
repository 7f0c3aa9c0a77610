//! `InitialUnknowns` of every scene: the variables of which an initial output is said to depend are those that change it, no
//! fewer and no more.

#![allow(clippy::unwrap_used)]

#[path = "support/fmus.rs"]
mod fmus;
#[path = "../crates/fmi-bundle/tests/support/initial_unknowns.rs"]
mod initial_unknowns;

use fmi_component::{Value, Variable};
use initial_unknowns::{Trials, differences};
use jostle::scene::catalogue::{MODELS, Names};

/// Few enough to be quick, enough for a second row of disks.
const DISKS: u32 = 12;
/// Starting points that the scene accepts; fewer where laws are tabulated anew for each.
const POINTS: usize = 16;
const POINTS_OF_TABLES: usize = 5;

/// A table of impacts takes as long as the tangential spring oscillates in one: a much stiffer one shows nothing new.
fn is_quick(variable: &Variable, now: Value, other: Value) -> bool {
    match (variable.name.as_str(), now, other) {
        ("contact.stiffness_ratio", Value::Real(now), Value::Real(other)) => other <= 3.0 * now,
        _ => true,
    }
}

fn compare(scene: &str) {
    let mut wrong = Vec::new();
    for model in MODELS {
        let names = Names::from(&(model.info)());
        if names.scene != scene {
            continue;
        }
        let tabulated = names.engine == "event-driven" && scene == "packing";
        let trials = Trials {
            points: if tabulated { POINTS_OF_TABLES } else { POINTS },
            is_tried: is_quick,
            rounded: &["base.reaction_force_now", "energy.kinetic"],
        };
        wrong.extend(differences(&fmus::component(model, DISKS), &trials));
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn packing() {
    compare("packing");
}

#[test]
fn wedge() {
    compare("wedge");
}

#[test]
fn ratchet() {
    compare("ratchet");
}

#[test]
fn three_disk() {
    compare("three_disk");
}

//! Every scene under extreme but legal parameters, steps and inputs, and fed with damaged states: it may refuse, but it
//! neither panics nor hangs, what it shows is finite, and a refusal leaves it as it was.
//!
//! Trials are drawn from seeds, so that a failure names what repeats it. `ABUSE_TRIALS` asks for more of them,
//! `ABUSE_FIRST` for others, `ABUSE_TELLS` for what each does.

mod checks;
mod damaged;
mod extremes;
mod trial;

use std::collections::BTreeMap;
use std::panic::catch_unwind;

use jostle::drive::{FollowsInput, Sine};
use jostle::scene::disk_on_two_supports::{
    DiskOnTwoSupportsOnHarmonicTorque, DiskOnTwoSupportsOnInput, DiskOnTwoSupportsOnRandomSupports,
    DiskOnTwoSupportsOnSine,
};
use jostle::scene::packing::event_driven::{HardPackingOnInput, HardPackingOnSine};
use jostle::scene::packing::{
    LocatedPackingOnInput, LocatedPackingOnSine, PackingOnFixedBottom, PackingOnInput, PackingOnRandomBottom,
    PackingOnSine,
};
use jostle::scene::ratchet::{RatchetOnInput, RatchetOnSine};
use jostle::scene::wedge::{WedgeEventDriven, WedgeMap, WedgeMolecularDynamics};
use rand::RngExt;
use rand_pcg::Pcg64;

use damaged::damaged;
use extremes::extremes;

/// Work that a step of a trial may do (`jostle::engine::WorkBudget`). What absurd parameters ask beyond it is refused.
const MOST_WORK: u64 = 200_000;

fn number(variable: &str, usual: u64) -> u64 {
    let asked = std::env::var(variable).ok();
    asked.and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// Runs the trials and gathers what went wrong. None can hang: what a step may do is bounded.
fn run_all(name: &str, usual: u64, trial: fn(u64) -> Result<String, String>) {
    let (first, count) = (number("ABUSE_FIRST", 0), number("ABUSE_TRIALS", usual));
    let (mut wrong, mut observed) = (Vec::new(), BTreeMap::new());
    for seed in first..first + count {
        match catch_unwind(|| trial(seed)) {
            Ok(Ok(outcome)) => *observed.entry(outcome).or_insert(0) += 1,
            Ok(Err(what)) => wrong.push(format!("{name} {seed}: {what}")),
            Err(panic) => {
                let text = panic.downcast_ref::<String>().cloned();
                let text = text.or_else(|| panic.downcast_ref::<&str>().map(|text| text.to_string()));
                wrong.push(format!("{name} {seed}: panics {text:?}"));
            }
        }
    }
    eprintln!("{name}: {observed:?}");
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
}

fn pick<T: Copy>(generator: &mut Pcg64, from: &[T]) -> T {
    from[generator.random_range(0..from.len())]
}

macro_rules! trials {
    ($module:ident, $trial:ident; $($name:ident: $scene:ty, $usual:expr;)*) => {
        mod $module {
            use super::*;
            $(#[test]
            fn $name() {
                run_all(stringify!($name), $usual, $trial::<$scene>);
            })*
        }
    };
}

macro_rules! scenes {
    ($($name:ident: $scene:ty, $extremes:expr, $damaged:expr;)*) => {
        trials! { extreme_parameters, extremes; $($name: $scene, $extremes;)* }
        trials! { damaged_states, damaged; $($name: $scene, $damaged;)* }
    };
}

/// Trials that found something once: more impacts on the ceiling than in all, disks thrown to infinity, the resolution of
/// time.
#[test]
fn corrected_parameters_stay_corrected() {
    for outcome in [
        damaged::<RatchetOnInput>(209),
        damaged::<WedgeMolecularDynamics<FollowsInput>>(171),
        damaged::<WedgeMolecularDynamics<FollowsInput>>(231),
        extremes::<HardPackingOnSine>(314),
    ] {
        assert!(outcome.is_ok(), "{outcome:?}");
    }
}

scenes! {
    packing_on_sine: PackingOnSine, 12, 60;
    packing_on_input: PackingOnInput, 8, 40;
    packing_on_fixed_bottom: PackingOnFixedBottom, 12, 40;
    packing_on_random_bottom: PackingOnRandomBottom, 12, 40;
    located_packing_on_sine: LocatedPackingOnSine, 12, 60;
    located_packing_on_input: LocatedPackingOnInput, 8, 40;
    hard_packing_on_sine: HardPackingOnSine, 12, 60;
    hard_packing_on_input: HardPackingOnInput, 8, 40;
    wedge_map: WedgeMap, 20, 60;
    wedge_event_driven_on_sine: WedgeEventDriven<Sine>, 20, 60;
    wedge_event_driven_on_input: WedgeEventDriven<FollowsInput>, 20, 60;
    wedge_molecular_dynamics_on_sine: WedgeMolecularDynamics<Sine>, 12, 60;
    wedge_molecular_dynamics_on_input: WedgeMolecularDynamics<FollowsInput>, 12, 60;
    ratchet_on_sine: RatchetOnSine, 12, 60;
    ratchet_on_input: RatchetOnInput, 12, 60;
    three_disk_on_input: DiskOnTwoSupportsOnInput, 12, 40;
    three_disk_on_harmonic_torque: DiskOnTwoSupportsOnHarmonicTorque, 12, 40;
    three_disk_on_random_supports: DiskOnTwoSupportsOnRandomSupports, 12, 40;
    three_disk_on_sine: DiskOnTwoSupportsOnSine, 12, 40;
}

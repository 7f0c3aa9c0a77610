//! Event-driven against molecular dynamics: the same disks, laws and base; impacts of zero duration are the limit of
//! stiff contacts.
#![allow(clippy::unwrap_used)]

mod support;

use support::four_disks::difference;
use support::order;

/// The duration of a contact goes with k^-1/2, and so does the difference.
#[test]
fn molecular_dynamics_converges_to_hard_disks() {
    let stiffnesses = [1e6, 1e7, 1e8, 1e9];
    let differences = stiffnesses.map(difference);
    for (stiffness, difference) in stiffnesses.iter().zip(differences) {
        println!("k_n = {stiffness:e} N/m: engines differ by {difference:.2e} m");
    }
    let order = order(differences[0], differences[3], 1e3);
    println!("order in 1/k_n: {order:.2}");
    assert!((order - 0.5).abs() < 0.15 && differences[3] < 1e-3, "{differences:?}");
}

//! Two velocities of F IV, and what the symmetry of the teeth asks of the flow.

use super::*;

/// Mean transport velocity and its standard error [m/s] over seeds, after a second of transient.
fn transport(disks: u32, changes: &[(&str, f64)], seeds: u32, seconds: f64) -> (f64, f64) {
    let velocities: Vec<f64> = (1..=seeds)
        .map(|seed| {
            let mut changes = changes.to_vec();
            changes.extend([("seed", f64::from(seed)), ("measure.start", 1.0)]);
            let mut ratchet = on_sine(disks, &changes);
            ratchet.advance_to(1.0 + seconds).unwrap();
            ratchet.real("transport_velocity").unwrap()
        })
        .collect();
    let count = f64::from(seeds);
    let mean = velocities.iter().sum::<f64>() / count;
    let variance = velocities.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (count - 1.0);
    (mean, (variance / count).sqrt())
}

pub const POSITIVE: [(&str, f64); 3] = [
    ("tooth.height", 3e-3),
    ("tooth.asymmetry", 0.1),
    ("drive.frequency", 25.0),
];
const NEGATIVE: [(&str, f64); 3] = [
    ("tooth.height", 6e-3),
    ("tooth.asymmetry", 0.25),
    ("drive.frequency", 30.0),
];

/// F IV: 3.9 +- 0.3 cm/s (n = 0.7) and -3.2 +- 0.3 cm/s (n = 0.35), sign and rough size.
#[test]
fn two_transport_velocities_of_the_paper_are_reproduced() {
    let (forward, error) = transport(20, &POSITIVE, 10, 30.0);
    let (backward, backward_error) = transport(10, &NEGATIVE, 10, 30.0);
    println!("positive case: {:.2} +- {:.2} cm/s", 100.0 * forward, 100.0 * error);
    println!(
        "negative case: {:.2} +- {:.2} cm/s",
        100.0 * backward,
        100.0 * backward_error
    );
    assert!((forward - 0.039).abs() < 0.012, "{forward} +- {error}");
    assert!((backward + 0.032).abs() < 0.012, "{backward} +- {backward_error}");
}

/// Symmetric teeth carry nothing, and mirrored teeth carry as much the other way.
#[test]
fn symmetry_of_the_teeth_is_that_of_the_flow() {
    let even = [("tooth.asymmetry", 0.5), ("tooth.height", 3e-3)];
    let (none, error) = transport(20, &even, 10, 20.0);
    println!("symmetric: {:.2} +- {:.2} cm/s", 100.0 * none, 100.0 * error);
    assert!(none.abs() < 4.0 * error && error < 5e-3, "{none} +- {error}");
    let mirrored = [
        ("tooth.height", 3e-3),
        ("tooth.asymmetry", 0.9),
        ("drive.frequency", 25.0),
    ];
    let (right, right_error) = transport(20, &POSITIVE, 10, 20.0);
    let (left, left_error) = transport(20, &mirrored, 10, 20.0);
    println!("a = 0.1: {right:.4} +- {right_error:.4} m/s, a = 0.9: {left:.4} +- {left_error:.4} m/s");
    assert!((right + left).abs() < 4.0 * right_error.hypot(left_error));
    assert!(right > 10.0 * right_error);
}

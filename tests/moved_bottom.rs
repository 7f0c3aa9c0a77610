//! Packings whose bottom row is moved by the drive: fixed to the sine base (P Fig. 1.10), or vibrating randomly (P 1.3).
#![allow(clippy::unwrap_used)]

mod support;

use std::f64::consts::TAU;

use jostle::drive::{Drive, FixedBottom, HeldDisk, RandomBottom, RandomVibration, Sine};
use jostle::scene::packing::{PackingOnFixedBottom, PackingOnRandomBottom};
use jostle::scene::{Model, Simulation};
use support::simulation_of;

const STIFFNESS: f64 = 1e4;
const DAMPING: f64 = 0.8;
const GRAVITY: f64 = 9.8;
const MASS: f64 = 3.57 * std::f64::consts::PI * 0.02 * 0.02;

/// Equal disks of 2 cm in a box of so many diameters.
fn equal(diameters: f64) -> Vec<(&'static str, f64)> {
    vec![
        ("disk.radius_small", 0.02),
        ("disk.radius_medium", 0.02),
        ("disk.radius_large", 0.02),
        ("box.width", 0.04 * diameters),
    ]
}

fn places<M: Model>(packing: &Simulation<M>, disks: u32) -> Vec<[f64; 2]> {
    let real = |name: String| packing.real(&name).unwrap();
    (1..=disks)
        .map(|disk| [real(format!("disk.x[{disk}]")), real(format!("disk.y[{disk}]"))])
        .collect()
}

/// A disk without friction on two held ones, by classical Runge and Kutta steps of 0.2 us with `N = max(k delta - gamma u_n, 0)`.
fn brute_force(mut drive: impl Drive, mut state: [f64; 4], end: f64) -> [f64; 4] {
    let step = 2e-7;
    let mut rates = |time: f64, [x, y, vx, vy]: [f64; 4]| {
        let mut force = [0.0, -MASS * GRAVITY];
        drive.move_disks(time, |_, [hx, hy], [hvx, hvy]| {
            let distance = (x - hx).hypot(y - hy);
            let (nx, ny) = ((x - hx) / distance, (y - hy) / distance);
            let (overlap, parting) = (0.04 - distance, (vx - hvx) * nx + (vy - hvy) * ny);
            if overlap > 0.0 {
                let normal = (STIFFNESS * overlap - DAMPING * parting).max(0.0);
                force = [force[0] + normal * nx, force[1] + normal * ny];
            }
        });
        [vx, vy, force[0] / MASS, force[1] / MASS]
    };
    let ahead = |state: [f64; 4], rate: [f64; 4], by: f64| std::array::from_fn(|i| state[i] + by * rate[i]);
    for index in 0..(end / step).round() as u32 {
        let time = f64::from(index) * step;
        let first = rates(time, state);
        let second = rates(time + 0.5 * step, ahead(state, first, 0.5 * step));
        let third = rates(time + 0.5 * step, ahead(state, second, 0.5 * step));
        let fourth = rates(time + step, ahead(state, third, step));
        state =
            std::array::from_fn(|i| state[i] + step / 6.0 * (first[i] + 2.0 * second[i] + 2.0 * third[i] + fourth[i]));
    }
    state
}

/// Largest difference \[m\] between the free disk of a packing of three and the brute force, with a time step \[s\].
fn difference<M: Model>(
    given: &[(&str, f64)],
    time_step: f64,
    drive: impl FnOnce(&[HeldDisk]) -> Box<dyn FnOnce([f64; 4]) -> [f64; 4]>,
) -> f64 {
    let own = [
        ("contact.friction", 0.0),
        ("contact.normal_damping", DAMPING),
        ("initial.settled", 0.0),
        ("time_step", time_step),
    ];
    let mut packing = simulation_of::<M>(3, &[&equal(2.2), &own[..], given].concat());
    let start = places(&packing, 3);
    assert!(start[0][1] == start[1][1] && start[2][1] > 0.05, "{start:?}");
    let held: Vec<HeldDisk> = (0..2)
        .map(|index| HeldDisk {
            index,
            place: start[index as usize],
        })
        .collect();
    let expected = drive(&held)([start[2][0], start[2][1], 0.0, 0.0]);
    packing.advance_to(0.04).unwrap();
    let found = places(&packing, 3)[2];
    println!("free disk at {found:?}, by brute force {expected:?}");
    (found[0] - expected[0]).hypot(found[1] - expected[1])
}

/// The error falls with the time step, and the disk has bounced.
#[test]
fn a_free_disk_on_the_moved_row_moves_as_by_brute_force() {
    let sine = Sine {
        amplitude: 1e-4,
        frequency: 80.0,
        phase: 0.0,
    };
    let fixed = |step: f64| {
        let given = [("drive.amplitude", 1e-4), ("drive.frequency", 80.0)];
        difference::<PackingOnFixedBottom>(&given, step, |held| {
            let drive = FixedBottom {
                sine,
                disks: held.to_vec(),
            };
            Box::new(move |start| brute_force(drive, start, 0.04))
        })
    };
    let random = |step: f64, seed: u32| {
        let given = [("bottom.radius", 2e-4), ("bottom.seed", f64::from(seed))];
        difference::<PackingOnRandomBottom>(&given, step, |held| {
            let vibration = RandomVibration {
                radius: 2e-4,
                angular_frequency: 80.0 * TAU,
                damping_ratio: 0.5,
                seed: seed.into(),
            };
            let mut drive = RandomBottom::new(vibration, 0.0);
            drive.hold(held);
            Box::new(move |start| brute_force(drive, start, 0.04))
        })
    };
    // Of one noise alone the error may be small by chance, where a contact begins just at the end of a time step.
    let random_mean = |step: f64| (1..=8).map(|seed| random(step, seed)).sum::<f64>() / 8.0;
    for errors in [[1e-5, 1e-6].map(fixed), [1e-5, 1e-6].map(random_mean)] {
        println!("errors with steps of 10 and 1 us: {errors:?} m");
        assert!(errors[1] < 1e-6 && errors[1] < 0.15 * errors[0], "{errors:?}");
    }
}

/// Energies balance within the error of the time step, and the base gives what the free disks have in momentum.
fn balances<M: Model>(given: &[(&str, f64)]) {
    let mut residuals = Vec::new();
    for time_step in [1e-5, 2.5e-6] {
        let mut packing = simulation_of::<M>(
            60,
            &[given, &[("time_step", time_step), ("initial.settled", 1.0)]].concat(),
        );
        let real = |packing: &Simulation<M>, name: &str| packing.real(name).unwrap();
        packing.advance_to(0.2).unwrap();
        let [input, lost, residual] =
            ["energy.input", "energy.lost", "energy.residual"].map(|name| real(&packing, name));
        println!(
            "{}: input {input:.3e}, lost {lost:.3e}, residual {residual:.1e} J",
            M::info().identifier
        );
        assert!(lost > 1e-4 && residual.abs() < 1e-2 * lost);
        residuals.push(residual.abs() / lost);
    }
    assert!(residuals[1] < 0.6 * residuals[0], "{residuals:?}");
}

#[test]
fn energies_balance_with_the_work_of_the_moved_row() {
    balances::<PackingOnFixedBottom>(&[("drive.amplitude", 1.5e-4)]);
    balances::<PackingOnRandomBottom>(&[("bottom.radius", 2e-4)]);
}

/// The impulse on the base is the weight of the free disks over the time, up to their momentum; side walls without friction.
#[test]
fn the_base_carries_the_free_disks() {
    fn impulse_and_weight<M: Model>(given: &[(&str, f64)]) {
        let own = [("contact.friction", 0.0), ("initial.settled", 1.0)];
        let mut packing = simulation_of::<M>(20, &[&equal(5.2), &own[..], given].concat());
        let start = places(&packing, 20);
        let free = start.iter().filter(|place| place[1] > 0.0201).count() as f64;
        assert!((10.0..=15.0).contains(&free), "{start:?}");
        packing.advance_to(2.0).unwrap();
        let (impulse, weight) = (-packing.real("base.impulse").unwrap(), free * MASS * GRAVITY);
        println!("{free} free disks: {impulse} N.s for a weight of {weight} N over 2 s");
        assert!((impulse / 2.0 - weight).abs() < 0.01 * weight);
    }
    impulse_and_weight::<PackingOnFixedBottom>(&[]);
    impulse_and_weight::<PackingOnRandomBottom>(&[]);
}

/// The bottom row is where the drive says: with the base, or in its circles; it never turns. Others do.
#[test]
fn the_row_stays_with_the_base_or_in_its_circles() {
    let mut fixed = simulation_of::<PackingOnFixedBottom>(60, &[("drive.amplitude", 2e-4)]);
    let mut random = simulation_of::<PackingOnRandomBottom>(60, &[("bottom.radius", 3e-4)]);
    let (start, random_start) = (places(&fixed, 60), places(&random, 60));
    let radius = |disk: usize| fixed.real(&format!("disk.radius[{}]", disk + 1)).unwrap();
    let row: Vec<usize> = (0..60)
        .filter(|&disk| start[disk][1] < radius(disk) * (1.0 + 1e-6))
        .collect();
    assert!((6..=13).contains(&row.len()), "{row:?}");
    let mut farthest: f64 = 0.0;
    for sample in 1..=100 {
        let time = 3.3e-3 * f64::from(sample);
        fixed.advance_to(time).unwrap();
        random.advance_to(time).unwrap();
        let (now, random_now) = (places(&fixed, 60), places(&random, 60));
        let base = fixed.real("base.position").unwrap();
        for &disk in &row {
            assert_eq!(now[disk], [start[disk][0], start[disk][1] + base]);
            let (from, to) = (random_start[disk], random_now[disk]);
            let distance = (to[0] - from[0]).hypot(to[1] - from[1]);
            farthest = farthest.max(distance);
            assert!(distance < 3e-4);
            for turn in [
                format!("disk.angle[{}]", disk + 1),
                format!("disk.angular_velocity[{}]", disk + 1),
            ] {
                assert!(fixed.real(&turn).unwrap() == 0.0 && random.real(&turn).unwrap() == 0.0);
            }
        }
    }
    assert!(farthest > 2.5e-4);
    assert!(random.real("disk.angle[60]").unwrap() != 0.0 && random.real("base.position").unwrap() == 0.0);
}

/// Steps cut anywhere, states saved as bytes and brought back: the same bits. Another noise's state is refused.
#[test]
fn stepping_changes_no_bit_of_the_noise() {
    let start = |seed: f64| simulation_of::<PackingOnRandomBottom>(20, &[("bottom.seed", seed)]);
    let mut whole = start(1.0);
    whole.advance_to(0.1).unwrap();
    let mut cut = start(1.0);
    for time in [1e-6, 0.017, 0.017_003, 0.06] {
        cut.advance_to(time).unwrap();
    }
    let bytes = cut.to_bytes().unwrap();
    cut.advance_to(0.08).unwrap();
    cut.restore_bytes(&bytes).unwrap();
    cut.advance_to(0.1).unwrap();
    assert!(whole.model().unwrap().state().engine == cut.model().unwrap().state().engine);
    let mut other = start(2.0);
    let foreign = other.model().unwrap().state();
    other.advance_to(0.1).unwrap();
    assert!(places(&whole, 20) != places(&other, 20));
    let mut model = PackingOnRandomBottom::new(whole.structure(), 0.0, whole.values()).unwrap();
    assert!(model.restore(&foreign).is_err());
}

/// Angles \[rad\] that the disks turn by in a first and in a second time of `seconds`: how much the two agree, and the root mean
/// square of the second.
fn persistence<M: Model>(mut packing: Simulation<M>, disks: u32, seconds: f64) -> [f64; 2] {
    let mut angles = |time: f64| -> Vec<f64> {
        packing.advance_to(time).unwrap();
        (1..=disks)
            .map(|disk| packing.real(&format!("disk.angle[{disk}]")).unwrap())
            .collect()
    };
    let (first, both) = (angles(seconds), angles(2.0 * seconds));
    let second: Vec<f64> = both.iter().zip(&first).map(|(both, first)| both - first).collect();
    println!("{first:.2?} rad, then {second:.2?} rad");
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let agreement = product(&first, &second) / (product(&first, &first) * product(&second, &second)).sqrt();
    [agreement, (product(&second, &second) / f64::from(disks)).sqrt()]
}

/// P Fig. 1.10: a few equal disks on a row that is fixed to the frame turn, each in its own sense. P 1.3: so do those of a packing
/// whose row vibrates randomly.
#[test]
fn disks_turn_steadily_over_a_moved_row() {
    let frame = [
        ("drive.amplitude", 1.5e-4),
        ("wall.motion", 2.0),
        ("initial.settled", 1.0),
    ];
    let buttons = simulation_of::<PackingOnFixedBottom>(12, &[&equal(4.3), &frame[..]].concat());
    let random = simulation_of::<PackingOnRandomBottom>(60, &[("bottom.radius", 1.5e-4), ("initial.settled", 1.0)]);
    // Of disks without a sense of their own the agreement is zero within the root of their number.
    for [agreement, turned] in [persistence(buttons, 12, 10.0), persistence(random, 60, 5.0)] {
        println!("agreement {agreement:.3}, {turned:.2} rad");
        assert!(agreement > 0.8 && turned > 0.5);
    }
}

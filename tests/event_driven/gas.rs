//! A gas in a periodic cell: conservation laws, hardness, independence of shells and sampling, rollback.

use jostle::collision::{CollisionLaw, Coulomb, Smooth};
use jostle::drive::FollowsInput;
use jostle::engine::Engine;
use jostle::engine::event_driven::{EventDriven, Model, Moving, Periodic, Region, Settings, Walls};
use jostle::geometry::{Disk, Vector2};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

fn uniform(random: &mut Pcg64) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

type Gas<L> = EventDriven<L, Walls<Moving<FollowsInput>>, Periodic>;

/// Disks of several sizes on a square lattice in a periodic cell, with random velocities and spins of zero momentum.
fn gas<L: CollisionLaw>(law: L, across: usize, shell: f64) -> (Gas<L>, Vec<f64>) {
    let mut random = Pcg64::seed_from_u64(3);
    let count = across * across;
    let disks: Vec<Disk> = (0..count)
        .map(|index| Disk {
            x: (index % across) as f64 + 0.5,
            y: (index / across) as f64 + 0.5,
            radius: 0.3 + 0.19 * uniform(&mut random),
        })
        .collect();
    let masses: Vec<f64> = disks.iter().map(|disk| disk.radius * disk.radius).collect();
    let mut velocities: Vec<[f64; 3]> = (0..count)
        .map(|_| std::array::from_fn(|_| 2.0 * uniform(&mut random) - 1.0))
        .collect();
    for axis in 0..2 {
        let drift = velocities
            .iter()
            .zip(&masses)
            .map(|(velocity, mass)| mass * velocity[axis])
            .sum::<f64>();
        let drift = drift / masses.iter().sum::<f64>();
        velocities.iter_mut().for_each(|velocity| velocity[axis] -= drift);
    }
    let model = Model {
        law,
        boundary: Walls::none(),
        gravity: 0.0,
        space: Periodic(Region {
            corner: Vector2::zeros(),
            size: Vector2::repeat(across as f64),
        }),
    };
    let settings = Settings {
        shell,
        ..Settings::default()
    };
    (EventDriven::new(model, &disks, &masses, &velocities, settings), masses)
}

/// Kinetic energy and momentum at `time`.
fn sums<L: CollisionLaw>(gas: &Gas<L>, masses: &[f64], time: f64) -> (f64, Vector2<f64>) {
    masses
        .iter()
        .enumerate()
        .fold((0.0, Vector2::zeros()), |(energy, momentum), (disk, mass)| {
            let motion = gas.sample_at(time, disk);
            let surface_velocity = gas.state().bodies[disk].radius * motion.angular_velocity;
            let kinetic = 0.5 * mass * (motion.velocity.norm_squared() + 0.5 * surface_velocity * surface_velocity);
            (energy + kinetic, momentum + *mass * motion.velocity)
        })
}

/// Deepest overlap of any two disks over the sum of their radii, with images.
fn deepest_overlap<L: CollisionLaw>(gas: &Gas<L>, time: f64, width: f64) -> f64 {
    let count = gas.state().bodies.len();
    let positions: Vec<_> = (0..count).map(|disk| gas.sample_at(time, disk).position).collect();
    let mut deepest = f64::NEG_INFINITY;
    for i in 0..count {
        for j in 0..i {
            let apart = |axis: usize| {
                let distance = (positions[i][axis] - positions[j][axis]).rem_euclid(width);
                distance.min(width - distance)
            };
            let radius_sum = gas.state().bodies[i].radius + gas.state().bodies[j].radius;
            deepest = f64::max(deepest, 1.0 - apart(0).hypot(apart(1)) / radius_sum);
        }
    }
    deepest
}

/// Elastic and smooth: energy and momentum stay, disks never overlap, over a million impacts of unequal disks.
#[test]
fn elastic_gas_keeps_energy_momentum_and_hardness() {
    let (mut gas, masses) = gas(Smooth::ELASTIC, 10, 1.6);
    let (energy, _) = sums(&gas, &masses, 0.0);
    for sample in 1..=60 {
        let time = 41.0 * f64::from(sample);
        gas.advance_to(time).unwrap();
        assert!(deepest_overlap(&gas, time, 10.0) < 1e-10);
    }
    let time = 41.0 * 60.0;
    let impacts = gas.state().counts.disk_impacts;
    let (energy_now, momentum) = sums(&gas, &masses, time);
    let drift = (energy_now / energy - 1.0).abs();
    println!("{impacts} impacts: energy drift {drift:.1e}, momentum {momentum:?}");
    assert!(impacts > 400_000 && drift < 1e-9 && momentum.norm() < 1e-11);
    assert!(gas.state().counts.energy_lost.abs() < 1e-9 * energy);
}

/// The same over a hundred million events. Half a minute: `cargo test --release --test event_driven -- --ignored`.
#[test]
#[ignore = "takes half a minute in release mode"]
fn elastic_gas_keeps_energy_and_momentum_over_a_hundred_million_events() {
    let (mut gas, masses) = gas(Smooth::ELASTIC, 10, 1.8);
    let (energy, _) = sums(&gas, &masses, 0.0);
    let mut time = 0.0;
    let events = |gas: &Gas<_>| {
        let counts = gas.state().counts;
        counts.disk_impacts + counts.list_renewals + counts.stale
    };
    while events(&gas) < 100_000_000 {
        time += 1000.0;
        gas.advance_to(time).unwrap();
        assert!(deepest_overlap(&gas, time, 10.0) < 1e-9);
    }
    let (energy_now, momentum) = sums(&gas, &masses, time);
    let drift = energy_now / energy - 1.0;
    println!(
        "{} impacts: energy drift {drift:.1e}, momentum {momentum:?}",
        gas.state().counts.disk_impacts
    );
    // Rounding of each impact is about 1e-16 of its energy, at random.
    assert!(drift.abs() < 1e-11 && momentum.norm() < 1e-10);
}

/// With friction and loss: the energy counted as lost is the energy that is missing; momentum stays.
#[test]
fn cooling_gas_balances_its_energy() {
    let (mut gas, masses) = gas(Coulomb::new(0.9, 0.3).unwrap(), 8, 1.6);
    let (energy, _) = sums(&gas, &masses, 0.0);
    gas.advance_to(30.0).unwrap();
    let (energy_now, momentum) = sums(&gas, &masses, 30.0);
    let lost = gas.state().counts.energy_lost;
    assert!(
        lost > 0.5 * energy && (energy - energy_now - lost).abs() < 1e-12 * energy,
        "{lost} of {energy}"
    );
    assert!(momentum.norm() < 1e-13);
}

/// Until chaos magnifies rounding.
#[test]
fn the_trajectory_depends_neither_on_the_width_of_shells_nor_on_sampling() {
    let positions = |shell: f64, samples: u32| {
        let (mut gas, _) = gas(Smooth::ELASTIC, 6, shell);
        (1..=samples).for_each(|sample| gas.advance_to(2.0 * f64::from(sample) / f64::from(samples)).unwrap());
        (0..36)
            .map(|disk| gas.sample_at(2.0, disk).position)
            .collect::<Vec<_>>()
    };
    assert_eq!(positions(1.6, 1), positions(1.6, 977));
    for (one, other) in positions(1.3, 1).iter().zip(positions(2.2, 1)) {
        assert!((one - other).norm() < 1e-6);
    }
}

/// State taken in the middle, with the calendar in any condition: the same bits again, in another engine too.
#[test]
fn rollback_gives_the_same_bits() {
    let (mut gas, _) = gas(Coulomb::new(0.95, 0.2).unwrap(), 8, 1.6);
    gas.advance_to(3.21).unwrap();
    let saved = gas.state().clone();
    gas.advance_to(9.0).unwrap();
    let ahead = gas.state().clone();
    let (mut other, _) = self::gas(Coulomb::new(0.95, 0.2).unwrap(), 8, 1.6);
    for again in [&mut gas, &mut other] {
        assert!(again.fits(&saved, 3.21));
        again.restore(&saved, 3.21).unwrap();
        again.advance_to(4.0).unwrap();
        again.advance_to(9.0).unwrap();
        assert_eq!(*again.state(), ahead);
    }
}

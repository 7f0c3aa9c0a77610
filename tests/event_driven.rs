//! The event-driven engine: conservation, hardness, bits, and agreement with closed forms and with molecular dynamics.
#![allow(clippy::unwrap_used)]

mod support;

use std::f64::consts::TAU;

use jostle::collision::{CollisionLaw, ContactTime, Coulomb, Smooth};
use jostle::drive::{FollowsInput, RandomPhase, Sine};
use jostle::engine::WorkBudget;
use jostle::engine::event_driven::{
    AtRandomPhase, EventDriven, Gravity, Moving, Open, Partner, Periodic, Settings, Stop, Unbounded, Unobserved,
    VibratingBase, Walls, Weightless,
};
use jostle::geometry::{Disk, Wall};
use jostle::packing::{RadiusDistribution, advancing_front};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

fn uniform(random: &mut Pcg64) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

type Gas<L> = EventDriven<L, Unbounded, Weightless, Periodic>;

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
    let size = [across as f64; 2];
    let types = (law, Unbounded, Weightless, Periodic { size });
    (
        EventDriven::new(
            types,
            &disks,
            &masses,
            &velocities,
            Settings {
                shell,
                ..Settings::default()
            },
        ),
        masses,
    )
}

/// Kinetic energy and momentum at `time`.
fn sums<L: CollisionLaw>(gas: &Gas<L>, masses: &[f64], time: f64) -> (f64, [f64; 2]) {
    masses
        .iter()
        .enumerate()
        .fold((0.0, [0.0; 2]), |(energy, [px, py]), (disk, mass)| {
            let (_, [vx, vy], _, spin) = gas.seen(disk, time);
            let radius = gas.state().bodies[disk].radius;
            let kinetic = 0.5 * mass * (vx * vx + vy * vy + 0.5 * (radius * spin).powi(2));
            (energy + kinetic, [px + mass * vx, py + mass * vy])
        })
}

/// Deepest overlap of any two disks over the sum of their radii, with images.
fn deepest_overlap<L: CollisionLaw>(gas: &Gas<L>, time: f64, width: f64) -> f64 {
    let count = gas.state().bodies.len();
    let places: Vec<[f64; 2]> = (0..count).map(|disk| gas.seen(disk, time).0).collect();
    let mut deepest = f64::NEG_INFINITY;
    for i in 0..count {
        for j in 0..i {
            let apart = |axis: usize| {
                let distance = (places[i][axis] - places[j][axis]).rem_euclid(width);
                distance.min(width - distance)
            };
            let reach = gas.state().bodies[i].radius + gas.state().bodies[j].radius;
            deepest = f64::max(deepest, 1.0 - apart(0).hypot(apart(1)) / reach);
        }
    }
    deepest
}

/// Elastic and smooth: energy and momentum stay, disks never overlap, over a million impacts of unequal disks.
#[test]
fn elastic_gas_keeps_energy_momentum_and_hardness() {
    let (mut gas, masses) = gas(Smooth::ELASTIC, 10, 1.6);
    let (energy, _) = sums(&gas, &masses, 0.0);
    for look in 1..=60 {
        let time = 41.0 * f64::from(look);
        gas.advance_to(time).unwrap();
        assert!(deepest_overlap(&gas, time, 10.0) < 1e-10);
    }
    let time = 41.0 * 60.0;
    let impacts = gas.state().counts.disk_impacts;
    let (energy_now, momentum) = sums(&gas, &masses, time);
    let drift = (energy_now / energy - 1.0).abs();
    println!("{impacts} impacts: energy drift {drift:.1e}, momentum {momentum:?}");
    assert!(impacts > 400_000 && drift < 1e-9 && momentum[0].hypot(momentum[1]) < 1e-11);
    assert!(gas.state().counts.energy_lost.abs() < 1e-9 * energy);
}

/// The same over a hundred million events. Half a minute: `cargo test --release --test event_driven -- --ignored`.
#[test]
#[ignore = "takes half a minute in release mode"]
fn elastic_gas_keeps_energy_and_momentum_over_a_hundred_million_events() {
    let (mut gas, masses) = gas(Smooth::ELASTIC, 10, 1.8);
    let (energy, _) = sums(&gas, &masses, 0.0);
    let mut time = 0.0;
    while gas.state().counts.disk_impacts + gas.state().counts.listings + gas.state().counts.stale < 100_000_000 {
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
    assert!(drift.abs() < 1e-11 && momentum[0].hypot(momentum[1]) < 1e-10);
}

/// With friction and loss: what the tally says is lost is what is missing; momentum stays.
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
    assert!(momentum[0].hypot(momentum[1]) < 1e-13);
}

/// The trajectory does not depend on how far shells reach, nor on where one looks, until chaos magnifies rounding.
#[test]
fn shells_and_looks_leave_no_trace() {
    let places = |shell: f64, looks: u32| {
        let (mut gas, _) = gas(Smooth::ELASTIC, 6, shell);
        (1..=looks).for_each(|look| gas.advance_to(2.0 * f64::from(look) / f64::from(looks)).unwrap());
        (0..36).map(|disk| gas.seen(disk, 2.0).0).collect::<Vec<_>>()
    };
    assert_eq!(places(1.6, 1), places(1.6, 977));
    for (one, other) in places(1.3, 1).iter().zip(places(2.2, 1)) {
        assert!((one[0] - other[0]).hypot(one[1] - other[1]) < 1e-6);
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
        assert!(again.fits(&saved));
        again.restore(&saved);
        again.advance_to(4.0).unwrap();
        again.advance_to(9.0).unwrap();
        assert_eq!(*again.state(), ahead);
    }
}

/// Disks in a box of width 0.4 m over a base, as the packing scene has them, but with any law and base.
fn boxed<L: CollisionLaw, W: VibratingBase>(
    law: L,
    base: W,
    disks: &[Disk],
    velocities: &[[f64; 3]],
) -> EventDriven<L, Walls<W>, Gravity, Open> {
    let walls = vec![Wall::vibrating_floor(), Wall::left(-0.2), Wall::right(0.2)];
    let space = Open {
        corner: [-0.2, 0.0],
        size: [0.4, 1.0],
    };
    let masses: Vec<f64> = disks
        .iter()
        .map(|disk| 3.57 * std::f64::consts::PI * disk.radius.powi(2))
        .collect();
    let types = (
        law,
        Walls {
            walls,
            base,
            origin: 0.0,
        },
        Gravity(9.8),
        space,
    );
    EventDriven::new(types, disks, &masses, velocities, Settings::default())
}

fn sine(gamma: f64) -> Moving<Sine> {
    let drive = Sine {
        amplitude: Sine::amplitude_of(gamma, 80.0, 9.8),
        frequency: 80.0,
        phase: 0.0,
    };
    Moving {
        drive,
        farthest: drive.amplitude,
    }
}

/// Loose disks of three sizes.
fn sixty() -> Vec<Disk> {
    let radii = RadiusDistribution::default().sample(60, 4).unwrap();
    let wider: Vec<f64> = radii.iter().map(|radius| 1.001 * radius).collect();
    let places = advancing_front(&wider, 0.4).unwrap();
    places
        .into_iter()
        .zip(radii)
        .map(|(place, radius)| Disk { radius, ..place })
        .collect()
}

/// No overlap, nobody outside, not below the base, at many looks and at weak and violent shaking.
fn stays_inside<W: VibratingBase>(base: W, seconds: f64) {
    let disks = sixty();
    let mut engine = boxed(Coulomb::new(0.96, 0.1).unwrap(), base, &disks, &[[0.0; 3]; 60]);
    for look in 1..=200 {
        let time = seconds * f64::from(look) / 200.0;
        engine.advance_to(time).unwrap();
        let floor = engine.state().boundary.base.motion(time).displacement;
        let places: Vec<[f64; 2]> = (0..60).map(|disk| engine.seen(disk, time).0).collect();
        for (i, ([x, y], disk)) in places.iter().zip(&disks).enumerate() {
            let allowed = 1e-9 * disk.radius;
            assert!(
                x.abs() <= 0.2 - disk.radius + allowed,
                "disk {i} at x = {x}, t = {time}"
            );
            assert!(
                *y >= floor + disk.radius - allowed,
                "disk {i} at y = {y}, base at {floor}, t = {time}"
            );
            for (other, [ox, oy]) in disks.iter().zip(&places).take(i) {
                let gap = (x - ox).hypot(y - oy) - disk.radius - other.radius;
                assert!(
                    gap > -1e-9 * disk.radius.min(other.radius),
                    "disks overlap by {gap:e} at t = {time}"
                );
            }
        }
    }
}

#[test]
fn hard_disks_stay_hard_and_inside() {
    stays_inside(sine(2.5), 2.0);
    stays_inside(sine(40.0), 2.0);
    let phase = RandomPhase { peak_velocity: 0.1 };
    stays_inside(
        AtRandomPhase {
            phase,
            generator: Pcg64::seed_from_u64(9),
        },
        2.0,
    );
}

/// Momentum: what the walls give is what the disks have, with gravity.
#[test]
fn base_impulse_and_work_balance() {
    let disks = sixty();
    let mut engine = boxed(Smooth::new(0.97).unwrap(), sine(6.0), &disks, &[[0.0; 3]; 60]);
    engine.advance_to(1.5).unwrap();
    let masses: Vec<f64> = disks
        .iter()
        .map(|disk| 3.57 * std::f64::consts::PI * disk.radius.powi(2))
        .collect();
    let total: f64 = masses.iter().sum();
    let (mut momentum, mut energy) = (0.0, 0.0);
    for (disk, mass) in masses.iter().enumerate() {
        let ([_, y], [vx, vy], _, _) = engine.seen(disk, 1.5);
        momentum += mass * vy;
        energy += mass * (0.5 * (vx * vx + vy * vy) + 9.8 * (y - disks[disk].y));
    }
    let counts = engine.state().counts;
    assert!((momentum + total * 9.8 * 1.5 - counts.base_impulse).abs() < 1e-12 * counts.base_impulse);
    assert!((energy - counts.energy_input + counts.energy_lost).abs() < 1e-12 * counts.energy_input);
}

/// One disk on a base at rest: heights and times of the bounces are those of the closed form, e^n.
#[test]
fn bouncing_disk_follows_the_closed_form() {
    let disk = [Disk {
        x: 0.0,
        y: 0.02 + 0.1,
        radius: 0.02,
    }];
    let base = Moving {
        drive: FollowsInput::uniform(0.0, 0.0, 0.0),
        farthest: 0.0,
    };
    // The motion of an input is known until its cubic ends.
    let mut base = base;
    base.drive.aim(0.0, 10.0, 0.0, 0.0);
    let mut engine = boxed(Smooth::new(0.8).unwrap(), base, &disk, &[[0.0; 3]]);
    let fall = (2.0 * 0.1 / 9.8_f64).sqrt();
    let mut landing = fall;
    for bounce in 1..=12 {
        let flight = 2.0 * fall * 0.8_f64.powi(bounce);
        let top = landing + 0.5 * flight;
        engine.advance_to(top).unwrap();
        let height = engine.seen(0, top).0[1] - 0.02;
        assert!(
            (height - 0.1 * 0.64_f64.powi(bounce)).abs() < 1e-14,
            "bounce {bounce}: {height}"
        );
        landing += flight;
    }
}

/// A disk that comes to rest takes infinitely many bounces: the run stops and says where.
#[test]
fn collapse_is_told_with_time_and_place() {
    let disk = [Disk {
        x: 0.0,
        y: 0.03,
        radius: 0.02,
    }];
    let phase = RandomPhase { peak_velocity: 0.0 };
    let base = AtRandomPhase {
        phase,
        generator: Pcg64::seed_from_u64(1),
    };
    let mut engine = boxed(Smooth::new(0.5).unwrap(), base, &disk, &[[0.0; 3]]);
    let Stop::NoHeadway(stop) = engine.advance_to(1.0).unwrap_err() else {
        panic!("too many events");
    };
    let fall = (2.0 * 0.01 / 9.8_f64).sqrt();
    assert!((stop.time - 3.0 * fall).abs() < 1e-9, "{stop:?}");
    assert_eq!(stop.last, (0, Partner::Wall(0)));
}

/// A call does no more than it may, so that none runs for hours; what is left is done in further calls.
#[test]
fn the_work_of_a_call_is_bounded() {
    let disk = [Disk {
        x: 0.0,
        y: 0.05,
        radius: 0.02,
    }];
    let law = ContactTime::new(Smooth::new(0.6).unwrap(), 1e-5).unwrap();
    let mut engine = boxed(law, sine(3.0), &disk, &[[0.0; 3]]);
    let mut other = engine.clone();
    let start = engine.state().clone();
    let stop = engine
        .advance_within(10.0, &mut Unobserved, &mut WorkBudget::at_most(100))
        .unwrap_err();
    assert!(
        matches!(stop, Stop::TooManyEvents { time, most: 100 } if (0.1..10.0).contains(&time)),
        "{stop:?}"
    );
    engine.restore(&start);
    for step in 1..=1000 {
        engine.advance_to(0.01 * f64::from(step)).unwrap();
    }
    other.advance_to(10.0).unwrap();
    assert!(engine.state() == other.state());
}

/// Hits on a true sine: the disk is at the base at each impact, and leaves by the law. A long run through several epochs.
#[test]
fn long_runs_keep_their_digits() {
    let disk = [Disk {
        x: 0.0,
        y: 0.05,
        radius: 0.02,
    }];
    // Without a contact time this disk would stick to the base by ever shorter bounces, and the run would stop.
    let law = ContactTime::new(Smooth::new(0.6).unwrap(), 1e-5).unwrap();
    let mut engine = boxed(law, sine(3.0), &disk, &[[0.0; 3]]);
    for look in 1..=2000 {
        let time = 0.1 * f64::from(look);
        engine.advance_to(time).unwrap();
        let base = Sine::amplitude_of(3.0, 80.0, 9.8) * (TAU * (80.0 * time).fract()).sin();
        assert!(engine.seen(0, time).0[1] - 0.02 > base - 2e-11, "t = {time}");
    }
    assert!(engine.state().epoch > 100.0 && engine.state().counts.wall_impacts > 2000);
}

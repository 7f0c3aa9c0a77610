//! Disks in a box over a base: hardness, balances, closed forms, watchdog, bounded work, long runs.

use std::f64::consts::TAU;

use jostle::collision::{CollisionLaw, ContactTime, Coulomb, Smooth};
use jostle::drive::{AtRandomPhase, FollowsInput, Motion, RandomPhase, Sine};
use jostle::engine::event_driven::{
    EventDriven, EventDrivenStop, Model, Moving, Open, Partner, Region, Settings, VibratingBase, Walls,
};
use jostle::engine::{Engine, WorkBudget};
use jostle::geometry::{Disk, Vector2, Wall};
use jostle::packing::{RadiusDistribution, advancing_front};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

/// Disks in a box of width 0.4 m over a base, as the packing scene has them, but with any law and base.
fn boxed<L: CollisionLaw, W: VibratingBase>(
    law: L,
    base: W,
    disks: &[Disk],
    velocities: &[[f64; 3]],
) -> EventDriven<L, Walls<W>, Open> {
    let walls = vec![Wall::vibrating_floor(), Wall::left(-0.2), Wall::right(0.2)];
    let masses: Vec<f64> = disks
        .iter()
        .map(|disk| 3.57 * std::f64::consts::PI * disk.radius.powi(2))
        .collect();
    let model = Model {
        law,
        boundary: Walls {
            walls,
            base,
            origin: 0.0,
        },
        gravity: 9.8,
        space: Open(Region {
            corner: Vector2::new(-0.2, 0.0),
            size: Vector2::new(0.4, 1.0),
        }),
    };
    EventDriven::new(model, disks, &masses, velocities, Settings::default())
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

/// No overlap, no disk outside, none below the base, at many samples.
fn stays_inside<W: VibratingBase>(base: W, seconds: f64) {
    let disks = sixty();
    let mut engine = boxed(Coulomb::new(0.96, 0.1).unwrap(), base, &disks, &[[0.0; 3]; 60]);
    for sample in 1..=200 {
        let time = seconds * f64::from(sample) / 200.0;
        engine.advance_to(time).unwrap();
        let floor = engine.state().boundary.base.motion(time).displacement;
        let positions: Vec<_> = (0..60).map(|disk| engine.sample_at(time, disk).position).collect();
        for (i, (position, disk)) in positions.iter().zip(&disks).enumerate() {
            let (x, y) = (position.x, position.y);
            let allowed = 1e-9 * disk.radius;
            assert!(
                x.abs() <= 0.2 - disk.radius + allowed,
                "disk {i} at x = {x}, t = {time}"
            );
            assert!(
                y >= floor + disk.radius - allowed,
                "disk {i} at y = {y}, base at {floor}, t = {time}"
            );
            for (other, other_position) in disks.iter().zip(&positions).take(i) {
                let gap = (position - other_position).norm() - disk.radius - other.radius;
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
    stays_inside(AtRandomPhase::new(phase, Pcg64::seed_from_u64(9)), 2.0);
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
        let motion = engine.sample_at(1.5, disk);
        momentum += mass * motion.velocity.y;
        energy += mass * (0.5 * motion.velocity.norm_squared() + 9.8 * (motion.position.y - disks[disk].y));
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
    let mut base = Moving {
        drive: FollowsInput::uniform(0.0, 0.0, 0.0),
        farthest: 0.0,
    };
    // The motion of an input is known until its cubic ends.
    base.drive.set_target(0.0, 10.0, Motion::default());
    let mut engine = boxed(Smooth::new(0.8).unwrap(), base, &disk, &[[0.0; 3]]);
    let fall = (2.0 * 0.1 / 9.8_f64).sqrt();
    let mut landing = fall;
    for bounce in 1..=12 {
        let flight = 2.0 * fall * 0.8_f64.powi(bounce);
        let top = landing + 0.5 * flight;
        engine.advance_to(top).unwrap();
        let height = engine.sample_at(top, 0).position.y - 0.02;
        assert!(
            (height - 0.1 * 0.64_f64.powi(bounce)).abs() < 1e-14,
            "bounce {bounce}: {height}"
        );
        landing += flight;
    }
}

/// A disk that comes to rest takes infinitely many bounces: the run stops and says where.
#[test]
fn inelastic_collapse_is_reported_with_time_disk_and_partner() {
    let disk = [Disk {
        x: 0.0,
        y: 0.03,
        radius: 0.02,
    }];
    let phase = RandomPhase { peak_velocity: 0.0 };
    let base = AtRandomPhase::new(phase, Pcg64::seed_from_u64(1));
    let mut engine = boxed(Smooth::new(0.5).unwrap(), base, &disk, &[[0.0; 3]]);
    let EventDrivenStop::NoHeadway(stop) = engine.advance_to(1.0).unwrap_err() else {
        panic!("too many events");
    };
    let fall = (2.0 * 0.01 / 9.8_f64).sqrt();
    assert!((stop.time - 3.0 * fall).abs() < 1e-9, "{stop:?}");
    assert_eq!((stop.disk, stop.partner), (0, Partner::Wall(0)));
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
    let stop = engine.advance_within(10.0, &mut WorkBudget::at_most(100)).unwrap_err();
    assert!(
        matches!(stop, EventDrivenStop::TooManyEvents { time, most: 100 } if (0.1..10.0).contains(&time)),
        "{stop:?}"
    );
    engine.restore(&start, 0.0).unwrap();
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
    for sample in 1..=2000 {
        let time = 0.1 * f64::from(sample);
        engine.advance_to(time).unwrap();
        let base = Sine::amplitude_of(3.0, 80.0, 9.8) * (TAU * (80.0 * time).fract()).sin();
        assert!(engine.sample_at(time, 0).position.y - 0.02 > base - 2e-11, "t = {time}");
    }
    assert!(engine.state().epoch > 100.0 && engine.state().counts.wall_impacts > 2000);
}

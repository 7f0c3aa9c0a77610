//! Energy and momentum, and the mirror.

use super::*;
use jostle::engine::Engine;

/// Elastic smooth disks under gravity on a base at rest.
fn elastic(height: f64) -> EventDriven<Smooth, Sawtooth<Sine>, PeriodicAcross> {
    let at_rest = Sine {
        amplitude: 0.0,
        frequency: 25.0,
        phase: 0.0,
    };
    let base = Moving {
        drive: at_rest,
        farthest: 0.0,
    };
    let profile = SawtoothProfile::new(6e-3, height, 0.2, 4e-4).unwrap();
    let boundary = Sawtooth::new(profile, base, 0.6, 0.0);
    let disks: Vec<Disk> = (0..40)
        .map(|index| Disk {
            x: 5e-3 * (f64::from(index % 12) + 0.5),
            y: 8e-3 + 5e-3 * f64::from(index / 12),
            radius: 1e-3 + 5e-6 * f64::from(index),
        })
        .collect();
    let velocities: Vec<[f64; 3]> = (0..40)
        .map(|index| {
            [
                0.3 * f64::from(index).sin() + 0.05,
                0.3 * f64::from(7 * index).cos(),
                0.0,
            ]
        })
        .collect();
    let model = Model {
        law: Smooth::ELASTIC,
        boundary,
        gravity: 9.81,
        space: cell(),
    };
    EventDriven::new(model, &disks, &[1.0; 40], &velocities, Settings::default())
}

/// Energy stays on any base at rest, and horizontal momentum on a flat one, over some 100,000 impacts.
#[test]
fn elastic_smooth_disks_keep_energy_and_momentum() {
    for height in [0.0, 6e-3] {
        let mut disks = elastic(height);
        let sums = |disks: &EventDriven<Smooth, Sawtooth<Sine>, PeriodicAcross>, time: f64| {
            (0..40).fold((0.0, 0.0), |(energy, momentum), disk| {
                let motion = disks.sample_at(time, disk);
                let energy = energy + 0.5 * motion.velocity.norm_squared() + 9.81 * motion.position.y;
                (energy, momentum + motion.velocity.x)
            })
        };
        let (energy, momentum) = sums(&disks, 0.0);
        disks.advance_to(40.0).unwrap();
        let (energy_now, momentum_now) = sums(&disks, 40.0);
        let impacts = disks.state().counts.disk_impacts + disks.state().counts.wall_impacts;
        let drift = (energy_now / energy - 1.0).abs();
        let push = (momentum_now - momentum).abs();
        println!("height {height}: {impacts} impacts, energy drift {drift:.1e}, momentum {push:.1e}");
        assert!(impacts > 30_000 && drift < 1e-10);
        assert!(if height == 0.0 { push < 1e-11 } else { push > 0.0 });
    }
}

/// Mirrored disks have mirrored motion until rounding shows: the images of some hundred impacts.
#[test]
fn mirrored_teeth_give_mirrored_motion() {
    let drive = Sine {
        amplitude: 2e-3,
        frequency: 25.0,
        phase: 0.3,
    };
    let [mut plain, mut mirrored] = [false, true].map(|mirror| {
        let asymmetry = if mirror { 0.8 } else { 0.2 };
        let profile = SawtoothProfile::new(6e-3, 6e-3, asymmetry, 4e-4).unwrap();
        let boundary = Sawtooth::new(profile, Moving { drive, farthest: 2e-3 }, 0.6, 0.0);
        let disks: Vec<Disk> = (0..12)
            .map(|index| {
                let x = 5e-3 * (f64::from(index) + 0.4);
                Disk {
                    x: if mirror { 60e-3 - x } else { x },
                    y: 12e-3,
                    radius: 1e-3 + 1e-5 * f64::from(index),
                }
            })
            .collect();
        let sign = if mirror { -1.0 } else { 1.0 };
        let velocities: Vec<[f64; 3]> = (0..12)
            .map(|index| [sign * 0.2 * f64::from(index).sin(), 0.1, sign * 30.0])
            .collect();
        let law = VelocityFloor::new(Coulomb::new(0.8, 0.1).unwrap(), 5e-3).unwrap();
        let model = Model {
            law,
            boundary,
            gravity: 9.81,
            space: cell(),
        };
        EventDriven::new(model, &disks, &[1e-5; 12], &velocities, Settings::default())
    });
    let time = 0.25;
    plain.advance_to(time).unwrap();
    mirrored.advance_to(time).unwrap();
    let (one, two) = (plain.state().counts, mirrored.state().counts);
    assert!(one.disk_impacts > 20 && one.wall_impacts > 80, "{one:?}");
    assert!((one.disk_impacts, one.wall_impacts) == (two.disk_impacts, two.wall_impacts));
    let mut off: f64 = 0.0;
    for disk in 0..12 {
        let (one, image) = (plain.sample_at(time, disk), mirrored.sample_at(time, disk));
        off = off
            .max((one.position.x + image.position.x - 60e-3).abs())
            .max((one.position.y - image.position.y).abs());
        off = off
            .max((one.velocity.x + image.velocity.x).abs())
            .max(1e-3 * (one.angle + image.angle).abs());
    }
    println!(
        "{} and {} impacts, images off by {off:.1e}",
        one.disk_impacts, one.wall_impacts
    );
    assert!(off < 1e-6, "{off:e}");
}

/// Work of the base less losses is the change of energy, and the mean force on the base is the weight.
#[test]
fn energy_and_momentum_balance_to_rounding() {
    let mut ratchet = on_sine(20, &[("disk.inertia_factor", 0.4), ("disk.mass_rule", 2.0)]);
    let mut impulse = 0.0;
    for i in 1..=10_000 {
        ratchet.advance_to(f64::from(i) * 2e-3).unwrap();
        impulse += ratchet.real("base.reaction_force").unwrap() * 2e-3;
    }
    let output = |name: &str| ratchet.real(name).unwrap();
    let weight: f64 = (1..=20)
        .map(|disk| 9.81 * 1e-5 * (output(&format!("disk.radius[{disk}]")) / 1.1025e-3).powi(2))
        .sum();
    assert!(output("energy.residual").abs() < 1e-11 * output("energy.input"));
    assert!(
        (impulse / 20.0 + weight).abs() < 0.02 * weight,
        "{} of {weight}",
        impulse / 20.0
    );
    assert_eq!(output("collisions.ceiling"), 0.0);
    assert!((output("layers") - 0.7).abs() < 1e-12);
}

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

/// What the three parts of the teeth give is the horizontal momentum that the disks get since a mark, and impacts on the parts are
/// those on the base.
#[test]
fn impulses_of_sides_and_tips_are_the_momentum_of_the_disks() {
    let mut ratchet = on_sine(20, &[("measure.start", 0.7), ("drive.frequency", 30.0)]);
    let sums = |ratchet: &Simulation<RatchetOnSine>, what: &str| {
        ["left_side", "right_side", "tip"].map(|part| ratchet.real(&format!("tooth.{part}_{what}")).unwrap())
    };
    let momentum = |ratchet: &Simulation<RatchetOnSine>| 20.0 * 1e-5 * ratchet.real("mean_velocity").unwrap();
    let mut start = (0.0, 0.0);
    for (index, mark) in [0.0, 0.0, 0.0, 1.0, 1.0, 2.0].into_iter().enumerate() {
        ratchet.set("measure.mark", mark).unwrap();
        if index == 1 || index == 3 || index == 5 {
            start = (momentum(&ratchet), ratchet.real("collisions.base").unwrap());
        }
        ratchet.advance_to(0.7 + 1.3 * index as f64).unwrap();
        let (impulses, counts) = (sums(&ratchet, "impulse"), sums(&ratchet, "impacts"));
        if index == 0 {
            assert!(ratchet.real("collisions.base").unwrap() > 20.0 && counts == [0.0; 3] && impulses == [0.0; 3]);
            continue;
        }
        let given = momentum(&ratchet) - start.0;
        let exchanged = impulses.iter().map(|impulse| impulse.abs()).sum::<f64>();
        println!("{counts:?} impacts gave {impulses:?} N.s, momentum {given:e}");
        assert!((impulses.iter().sum::<f64>() - given).abs() < 1e-12 * exchanged);
        assert_eq!(
            counts.iter().sum::<f64>(),
            ratchet.real("collisions.base").unwrap() - start.1
        );
        assert!(counts[0] > 0.0 && counts[1] > 0.0 && counts[2] > 0.0 && impulses[0] < 0.0 && impulses[1] > 0.0);
    }
    assert_eq!(ratchet.real("collisions.ceiling").unwrap(), 0.0);
}

/// A smooth elastic disk thrown straight down on the middle of a side, or beside the top of a tip: the impulse is
/// `-2 m (v.n) n_x` with the normal from the shape of F Fig. 5.
#[test]
fn one_disk_meets_the_part_that_lies_below_it() {
    let [width, height, asymmetry, tip] = [6e-3_f64, 3e-3, 0.25, 4e-4];
    let [radius, speed, mass] = [1e-3, 0.5, 2.0];
    let sides = [asymmetry * width, (1.0 - asymmetry) * width].map(|extent| (height, extent, height.hypot(extent)));
    let [left, right] = sides.map(|(rise, extent, length)| [rise / length, extent / length]);
    let normals = [[-left[0], left[1]], right, [0.1_f64.sin(), 0.1_f64.cos()]];
    // Middles of the sides, and the point of the arc with the third normal: its centre is below the apex on the bisector.
    let apex_angle = (asymmetry * width / height).atan() + ((1.0 - asymmetry) * width / height).atan();
    let lean = 0.5 * ((1.0 - asymmetry) * width / height).atan() - 0.5 * (asymmetry * width / height).atan();
    let depth = tip / (0.5 * apex_angle).sin();
    let centre = [asymmetry * width + depth * lean.sin(), height - depth * lean.cos()];
    let points = [
        [0.5 * asymmetry * width, 0.5 * height],
        [0.5 * (1.0 + asymmetry) * width, 0.5 * height],
        [centre[0] + tip * normals[2][0], centre[1] + tip * normals[2][1]],
    ];
    for (part, ([x, y], [across, up])) in points.into_iter().zip(normals).enumerate() {
        let base = Moving {
            drive: Sine {
                amplitude: 0.0,
                frequency: 25.0,
                phase: 0.0,
            },
            farthest: 0.0,
        };
        let profile = SawtoothProfile::new(width, height, asymmetry, tip).unwrap();
        let model = Model {
            law: Smooth::ELASTIC,
            boundary: Sawtooth::new(profile, base, 0.6, 0.0),
            gravity: 0.0,
            space: cell(),
        };
        let disk = Disk {
            x: 2.0 * width + x + radius * across,
            y: y + radius * up + 1e-3,
            radius,
        };
        let mut engine = EventDriven::new(model, &[disk], &[mass], &[[0.0, -speed, 0.0]], Settings::default());
        engine.advance_to(1e-3 / speed + 1e-4).unwrap();
        let teeth = *engine.state().boundary.tooth_impacts();
        let counts = teeth.map(|sum| sum.count);
        let expected = 2.0 * mass * speed * up * across;
        assert!(
            counts[part] == 1 && counts.iter().sum::<u64>() == 1,
            "{part}: {counts:?}"
        );
        let off = teeth[part].impulse - expected;
        assert!(
            off.abs() < 1e-9 * expected.abs(),
            "{part}: off by {off:e} of {expected} N.s"
        );
    }
}

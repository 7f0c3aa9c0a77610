//! The disk in a wedge against simulations written another way, conservation laws, symmetry and limits.

#![allow(clippy::unwrap_used)]

mod cartesian;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use cartesian::{Plain, wall_angles};
use jostle::collision::{CollisionLaw, Coulomb, Dashpot, TabulatedDashpot, VelocityFloor};
use jostle::contact::LinearDashpot;
use jostle::drive::{AtRandomPhase, BaseMotion, RandomPhase, Sine};
use jostle::engine::Engine;
use jostle::engine::wedge::{DiskInWedge, Start, WedgeFrame, WedgeSetup};
use jostle::measure::BatchMeans;
use rand::SeedableRng;
use rand_pcg::Pcg64;

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.02;
const APERTURE: f64 = 2.0 * PI / 3.0;
/// Gamma = 2 at 80 Hz.
const BASE: Sine = Sine {
    amplitude: 7.757e-5,
    frequency: 80.0,
    phase: 0.0,
};
const PEAK: f64 = 7.757e-5 * 80.0 * TAU;

fn setup(aperture: f64, tilt: f64) -> WedgeSetup {
    WedgeSetup {
        frame: WedgeFrame::new(aperture, tilt),
        radius: RADIUS,
        gravity: GRAVITY,
        slow: 0.0,
    }
}

fn thrown(sideways: f64) -> Start {
    Start {
        time: 0.0,
        height: 1e-3,
        sideways,
    }
}

fn resting(seed: u64) -> AtRandomPhase {
    AtRandomPhase::new(RandomPhase { peak_velocity: PEAK }, Pcg64::seed_from_u64(seed))
}

fn dashpot(restitution: f64, kappa: f64, friction: f64) -> Dashpot {
    let damping = LinearDashpot::damping_ratio_for(restitution);
    Dashpot::of_damping_ratio(1.0, damping, 1.0, kappa, friction).unwrap()
}

fn tabulated(restitution: f64, kappa: f64, friction: f64) -> TabulatedDashpot {
    TabulatedDashpot::new(dashpot(restitution, kappa, friction), &[1.0], 0.5)
}

/// The map against a direct simulation of the same process with the same random numbers.
#[test]
fn the_map_is_the_random_phase_process() {
    for (aperture, tilt, restitution, kappa) in [
        (APERTURE, 0.17, 0.9, 0.773),
        (APERTURE, -0.4, 0.5, 10.0),
        (1.2, 0.3, 0.9, 0.1), // the right wall hangs over
        (2.9, 0.06, 0.7, 1.0),
    ] {
        let law = dashpot(restitution, kappa, 0.1);
        let mut disk = DiskInWedge::new(setup(aperture, tilt), law, resting(7), thrown(0.02));
        let mut generator = Pcg64::seed_from_u64(7);
        let phase = RandomPhase { peak_velocity: PEAK };
        let mut plain = Plain::new(tilt, 1e-3, 0.02);
        let angles = wall_angles(aperture, tilt);
        let mut last = 2;
        for impact in 0..40 {
            // Both roots of both walls, without the one just left.
            let mut best = (f64::INFINITY, 0);
            for (index, angle) in angles.iter().enumerate() {
                let (sine, cosine) = angle.sin_cos();
                let gap = -sine * plain.position[0] + cosine * plain.position[1];
                let speed = -sine * plain.velocity[0] + cosine * plain.velocity[1];
                let pull = GRAVITY * cosine;
                let root = (speed * speed + 2.0 * pull * gap.max(0.0)).sqrt();
                for delay in [(speed - root) / pull, (speed + root) / pull] {
                    let left = index == last && delay < 1e-9;
                    if delay > 0.0 && !left && delay < best.0 {
                        best = (delay, index);
                    }
                }
            }
            let (delay, wall) = best;
            plain = plain.at(delay);
            let (sine, cosine) = angles[wall].sin_cos();
            let normal = -sine * plain.velocity[0] + cosine * plain.velocity[1];
            let base = loop {
                let base = phase.sample(&mut generator, normal, cosine);
                if -restitution * (normal - base * cosine) + base * cosine > 0.0 {
                    break base;
                }
            };
            plain.bounce(angles[wall], base, &law);
            last = wall;
            disk.next_impact().unwrap();
            let motion = disk.sample_at(disk.state().time);
            let shift = RADIUS / (0.5 * aperture).sin();
            for (found, expected) in [
                (motion.position.x + shift * tilt.sin(), plain.position[0]),
                (motion.position.y - shift * tilt.cos(), plain.position[1]),
                (motion.velocity.x * 1e-3, plain.velocity[0] * 1e-3),
                (motion.velocity.y * 1e-3, plain.velocity[1] * 1e-3),
                (motion.angular_velocity * 1e-5, plain.angular_velocity * 1e-5),
                (motion.angle * 1e-3, plain.angle * 1e-3),
                (disk.state().time * 1e-2, plain.time * 1e-2),
            ] {
                assert!(
                    (found - expected).abs() < 1e-9,
                    "impact {impact}: {found} for {expected}, tilt {tilt}"
                );
            }
        }
    }
}

/// The moving wedge against flights stepped by a microsecond, whose first overlap is narrowed down by halving.
#[test]
fn the_moving_wedge_is_what_brute_force_finds() {
    for (tilt, phase) in [(0.17, 0.0), (-0.35, 1.0), (0.05, 4.0)] {
        let base = Sine { phase, ..BASE };
        let law = dashpot(0.9, 0.773, 0.1);
        let mut disk = DiskInWedge::new(setup(APERTURE, tilt), law, base, thrown(0.02));
        let mut plain = Plain::new(tilt, 1e-3, 0.02);
        // The engine's start counts from where the wedge is.
        plain.position[1] += base.motion(0.0).displacement;
        let angles = wall_angles(APERTURE, tilt);
        for impact in 0..8 {
            let gap = |delay: f64, angle: f64| {
                let now = plain.at(delay);
                let lift = base.motion(now.time).displacement;
                -angle.sin() * now.position[0] + angle.cos() * (now.position[1] - lift)
            };
            let overlapped = |delay: f64| angles.into_iter().position(|angle| gap(delay, angle) < 0.0);
            // The wall just left overlaps by rounding for the first few steps at most.
            let mut steps = 5_u32;
            while overlapped(f64::from(steps) * 1e-6).is_none() {
                steps += 1;
            }
            let (mut low, mut high) = (f64::from(steps - 1) * 1e-6, f64::from(steps) * 1e-6);
            let wall = overlapped(high).unwrap();
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if gap(middle, angles[wall]) < 0.0 {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            plain = plain.at(low);
            plain.bounce(angles[wall], base.motion(plain.time).velocity, &law);
            disk.next_impact().unwrap();
            let motion = disk.sample_at(disk.state().time);
            let error = (motion.velocity.x - plain.velocity[0]).hypot(motion.velocity.y - plain.velocity[1]);
            assert!(
                (disk.state().time - plain.time).abs() < 1e-10 && error < 1e-8 * PEAK.max(1.0),
                "impact {impact}: {} for {}, velocity off by {error:e}",
                disk.state().time,
                plain.time
            );
            assert!((motion.angular_velocity - plain.angular_velocity).abs() < 1e-6);
        }
    }
}

/// Energy per mass of the disk at `time`.
fn energy<L: CollisionLaw, B: BaseMotion>(disk: &DiskInWedge<L, B>, time: f64) -> f64 {
    let motion = disk.sample_at(time);
    let surface_velocity = RADIUS * motion.angular_velocity;
    0.5 * (motion.velocity.norm_squared() + 0.5 * surface_velocity * surface_velocity) + GRAVITY * motion.position.y
}

fn balance<L: CollisionLaw, B: BaseMotion>(mut disk: DiskInWedge<L, B>) {
    let (start, rise) = (energy(&disk, 0.0), disk.sample_at(0.0).velocity.y);
    let time = 200.0;
    disk.advance_to(time).unwrap();
    let sums = disk.state().sums;
    assert!(sums.collisions > 5_000 && sums.lost > 0.0);
    let energy_error = energy(&disk, time) - start - sums.input + sums.lost;
    assert!(energy_error.abs() < 1e-11 * sums.lost, "energy {energy_error:e}");
    let pushed = disk.sample_at(time).velocity.y - rise + GRAVITY * time;
    assert!((sums.velocity / pushed - 1.0).abs() < 1e-11, "momentum");
}

#[test]
fn energy_and_momentum_balance_to_rounding() {
    balance(DiskInWedge::new(
        setup(APERTURE, 0.2),
        tabulated(0.9, 0.773, 0.1),
        resting(1),
        thrown(0.02),
    ));
    let floored = VelocityFloor::new(tabulated(0.7, 0.773, 0.1), 1e-4).unwrap();
    let moving = DiskInWedge::new(setup(1.3, 0.2), floored, BASE, thrown(0.02));
    balance(moving);
}

/// A wedge with opposite tilt and opposite throw, with the same random numbers: the mirrored bits.
#[test]
fn mirrored_wedges_turn_oppositely_to_the_last_bit() {
    let map = |tilt: f64, sideways: f64| {
        let law = tabulated(0.9, 0.773, 0.1);
        DiskInWedge::new(setup(APERTURE, tilt), law, resting(3), thrown(sideways))
    };
    let moving = |tilt: f64, sideways: f64| {
        let law = tabulated(0.9, 0.773, 0.1);
        DiskInWedge::new(setup(APERTURE, tilt), law, BASE, thrown(sideways))
    };
    let (mut disk, mut image) = (map(0.3, 0.02), map(-0.3, -0.02));
    let (mut shaken, mut shaken_image) = (moving(0.3, 0.02), moving(-0.3, -0.02));
    for second in 1..=100 {
        let time = f64::from(second);
        disk.advance_to(time).unwrap();
        image.advance_to(time).unwrap();
        shaken.advance_to(time).unwrap();
        shaken_image.advance_to(time).unwrap();
        for (motion, mirror) in [
            (disk.sample_at(time), image.sample_at(time)),
            (shaken.sample_at(time), shaken_image.sample_at(time)),
        ] {
            assert_eq!(
                [motion.position.x, motion.position.y],
                [-mirror.position.x, mirror.position.y]
            );
            assert_eq!(
                (motion.angle, motion.angular_velocity),
                (-mirror.angle, -mirror.angular_velocity)
            );
        }
    }
    assert!(disk.sample_at(100.0).angle.abs() > 1.0);
}

/// Scaled mean angular velocity with its standard error.
fn turning<L: CollisionLaw>(aperture: f64, tilt: f64, law: L, seconds: f64) -> (f64, f64) {
    let mut disk = DiskInWedge::new(setup(aperture, tilt), law, resting(11), thrown(0.01));
    let mut batches = BatchMeans::new(5.0, 0.1);
    while batches.due() <= seconds {
        let due = batches.due();
        disk.advance_to(due).unwrap();
        batches.record(disk.sample_at(due).angle);
    }
    disk.advance_to(seconds).unwrap();
    let scale = RADIUS / PEAK;
    (
        scale * batches.mean(seconds, disk.sample_at(seconds).angle),
        scale * batches.standard_error(),
    )
}

/// P Fig 6.9: with a stiff tangential spring e_t = max(0, 1 - 3 mu (1 + e_n) |u_n / u_t|), which is Coulomb's law.
#[test]
fn a_stiff_tangential_spring_gives_coulomb_friction() {
    let seconds = 4000.0;
    for tilt in [0.15_f64, 0.42] {
        let soft = turning(APERTURE, tilt, tabulated(0.9, 0.773, 0.1), seconds);
        let stiff = turning(APERTURE, tilt, tabulated(0.9, 1000.0, 0.1), seconds);
        let limit = turning(APERTURE, tilt, Coulomb::new(0.9, 0.1).unwrap(), seconds);
        println!("tilt {tilt}: kappa 0.773 {soft:?}, kappa 1000 {stiff:?}, limit {limit:?}");
        let close = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).abs() < 4.0 * a.1.hypot(b.1);
        assert!(close(stiff, limit) && !close(soft, limit));
    }
}

/// P Fig 6.7: at 179 degrees the disk turns by less than a hundredth of what it does in an ordinary wedge at the same
/// relative tilt.
#[test]
fn a_flat_wedge_does_not_turn_the_disk() {
    let law = || tabulated(0.9, 0.773, 0.1);
    let flat = 179_f64.to_radians();
    let (mean, error) = turning(flat, 0.3 * WedgeFrame::critical_tilt(flat), law(), 8000.0);
    let (steep, _) = turning(APERTURE, 0.3 * WedgeFrame::critical_tilt(APERTURE), law(), 2000.0);
    println!("flat {mean} +- {error}, at 120 degrees {steep}");
    assert!(mean.abs() < 0.01 * steep && error < 1e-3 * steep);
}

/// Walls within a billionth of horizontal, exactly vertical, and hanging over: the disk stays inside.
#[test]
fn no_wall_is_a_singular_case() {
    let critical = WedgeFrame::critical_tilt(1.2);
    for (aperture, tilt) in [
        (APERTURE, WedgeFrame::critical_tilt(APERTURE) - 1e-9),
        (1.2, FRAC_PI_2 - critical),
        (1.2, 0.9 * critical),
        (1.05, -0.99 * WedgeFrame::critical_tilt(1.05)),
        (3.139, 0.0),
    ] {
        let setup = setup(aperture, tilt);
        let law = tabulated(0.9, 0.773, 0.1);
        let mut disk = DiskInWedge::new(setup, law.clone(), resting(5), thrown(0.02));
        let floored = VelocityFloor::new(law, 1e-4).unwrap();
        let mut moving = DiskInWedge::new(setup, floored, BASE, thrown(0.02));
        for step in 1..=2000 {
            let time = f64::from(step) * 0.02;
            disk.advance_to(time).unwrap();
            moving.advance_to(time).unwrap();
            let lift = moving.base(time).displacement;
            for (motion, lift) in [(disk.sample_at(time), 0.0), (moving.sample_at(time), lift)] {
                for angle in wall_angles(aperture, tilt) {
                    let distance = -angle.sin() * motion.position.x + angle.cos() * (motion.position.y - lift);
                    assert!(
                        distance > RADIUS * (1.0 - 1e-9),
                        "aperture {aperture}, tilt {tilt}, t {time}: {distance}"
                    );
                }
            }
        }
    }
}

/// P 6.3.2: with A, omega_b and g scaled away all drives give the same run.
#[test]
fn runs_collapse_when_scaled() {
    let scaled = |gamma: f64, angular_frequency: f64| {
        let peak = gamma * GRAVITY / angular_frequency;
        let (length, unit) = (peak * peak / GRAVITY, peak / GRAVITY);
        let walls = AtRandomPhase::new(RandomPhase { peak_velocity: peak }, Pcg64::seed_from_u64(2));
        let law = tabulated(0.9, 0.773, 0.1);
        let start = Start {
            time: 0.0,
            height: length,
            sideways: 0.3 * peak,
        };
        let mut disk = DiskInWedge::new(setup(APERTURE, 0.2), law, walls, start);
        disk.advance_to(60.0 * unit).unwrap();
        (disk.state().sums.collisions, disk.state().arc_length / length)
    };
    let (count, arc_length) = scaled(1.0, 1.0);
    assert!(count > 10);
    for (gamma, angular_frequency) in [(1.0, 10.0), (1.0, 100.0), (10.0, 1.0), (100.0, 100.0), (10.0, 1000.0)] {
        let (other, turned) = scaled(gamma, angular_frequency);
        assert!(
            other == count && (turned / arc_length - 1.0).abs() < 1e-6,
            "{turned} for {arc_length}"
        );
    }
}

//! Speed and errors of the disk on two supports: `cargo bench --bench three_disk`.
//!
//! Prints the error against CPU time of this engine and of the general molecular dynamics for one disk that falls on two
//! walls, of this engine alone under a slow torque that makes the disk slide and stop, and simulated seconds per CPU second
//! of the scene with each drive. Built for the generic x86-64 that ships.

use std::f64::consts::FRAC_PI_6;
use std::hint::black_box;

use cpu_time::ProcessTime;
use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::Degree;
use jostle::drive::Sine;
use jostle::drive::excitation::{Excitation, HarmonicTorque, InputTorque, SupportMotion};
use jostle::engine::Engine;
use jostle::engine::dem::verlet::{Gear5, Integrator, PredictorCorrector, VelocityVerlet};
use jostle::engine::dem::{self, ContactLaws, FixedGrid};
use jostle::engine::disk_on_two_supports::{
    DiskOnTwoSupports, SupportFrame, TimeStepLimits, TwoSupportsRig, TwoSupportsSetup, equilibrium,
};
use jostle::geometry::{Disk, Wall};
use jostle::scene::disk_on_two_supports::{
    DiskOnTwoSupportsOnHarmonicTorque, DiskOnTwoSupportsOnInput, DiskOnTwoSupportsOnRandomSupports,
    DiskOnTwoSupportsOnSine,
};
use jostle::scene::{Model, Simulation};

const TILT: f64 = 0.1;

/// P 5.1 with this tangential stiffness.
fn rig(stiffness: f64, walls: bool) -> TwoSupportsRig {
    TwoSupportsRig {
        radius: 1.0,
        mass: 0.1,
        gravity: 10.0,
        normal: LinearDashpot {
            stiffness: 1e3,
            damping: 10.0,
        },
        tangential: TangentialSpring {
            stiffness,
            friction: 0.1,
        },
        frames: [SupportFrame::new(TILT - FRAC_PI_6), SupportFrame::new(FRAC_PI_6 + TILT)],
        curvature: if walls { 0.0 } else { 0.5 },
    }
}

/// Median CPU seconds of five runs, and the result of the last.
fn timed<T>(work: impl Fn() -> T) -> (f64, T) {
    let mut seconds: Vec<f64> = (0..4)
        .map(|_| {
            let start = ProcessTime::now();
            black_box(work());
            start.elapsed().as_secs_f64()
        })
        .collect();
    let start = ProcessTime::now();
    let result = work();
    seconds.push(start.elapsed().as_secs_f64());
    seconds.sort_by(f64::total_cmp);
    (seconds[2], result)
}

type Motion = [f64; 6];

fn distance(one: &Motion, other: &Motion) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

const HEIGHT: f64 = 5e-3;
const SPIN: f64 = 0.2;

/// One disk that falls on two walls and comes to rest, by the engine of this scene.
fn fall(rig: TwoSupportsRig, step: f64, seconds: f64) -> Motion {
    let [x, y] = equilibrium(&rig, &[SupportMotion::REST; 2]).expect("rests");
    let torque = InputTorque::starting(0.0, 0.0, 0.0, Degree::Automatic);
    let place = [x, y + HEIGHT, 0.0];
    let mut disk = DiskOnTwoSupports::new(TwoSupportsSetup::new(rig, step), torque, 0.0, place, [0.0, 0.0, SPIN]);
    disk.advance(seconds, false).expect("runs");
    motion(&disk)
}

fn motion<E: Excitation>(disk: &DiskOnTwoSupports<E>) -> Motion {
    let now = &disk.state().now;
    [
        now.disk[0],
        now.disk[1],
        now.angle(),
        now.disk[3],
        now.disk[4],
        now.disk[5],
    ]
}

/// The same by molecular dynamics of any number of disks.
fn general<I: Integrator>(rig: TwoSupportsRig, step: f64, seconds: f64) -> Motion {
    let [x, y] = equilibrium(&rig, &[SupportMotion::REST; 2]).expect("rests");
    // Where the disk just touches both walls, from their vertex.
    let touching = [-TILT.sin(), TILT.cos()].map(|part| part / FRAC_PI_6.cos());
    let setup = dem::SoftDiskSetup {
        laws: ContactLaws {
            normal: rig.normal,
            tangential: rig.tangential,
        },
        walls: vec![
            Wall::vibrating_slope(TILT - FRAC_PI_6),
            Wall::vibrating_slope(TILT + FRAC_PI_6),
        ],
        masses: vec![rig.mass],
        gravity: rig.gravity,
        time_step: step,
        start_time: 0.0,
    };
    let disk = Disk {
        x: touching[0] + x,
        y: touching[1] + y + HEIGHT,
        radius: rig.radius,
    };
    let rest = Sine {
        amplitude: 0.0,
        frequency: 1.0,
        phase: 0.0,
    };
    let mut engine = FixedGrid::<PredictorCorrector<I>, Sine>::new(setup, &[disk], rest);
    engine.set_motion(|disks| disks.velocity[2] = SPIN);
    engine.advance_to(seconds).expect("runs");
    let now = engine.observables();
    let ([x, y, angle], [vx, vy, spin]) = (now.positions[0], now.velocities[0]);
    [x - touching[0], y - touching[1], angle, vx, vy, spin]
}

fn against_general_molecular_dynamics(stiffness: f64) {
    let (rig, seconds) = (rig(stiffness, true), 0.5);
    let limits = TimeStepLimits::of(&rig, None);
    let exact = fall(rig, 0.1 * limits.largest, seconds);
    println!("fall on two walls, k_t = {stiffness:e} N/m, {seconds} s: step, CPU ms per simulated s, error");
    let print = |name: &str, step: f64, (cpu, found): (f64, Motion)| {
        println!(
            "  {name:16} {step:9.1e} s {:9.3} ms/s  {:.1e}",
            cpu / seconds * 1e3,
            distance(&found, &exact)
        );
    };
    for radians in [2.0, 1.0, 0.5, 0.25] {
        let step = radians * limits.largest;
        print("three_disk", step, timed(|| fall(rig, step, seconds)));
    }
    for radians in [0.1, 0.025, 0.00625] {
        let step = radians * limits.largest;
        print(
            "velocity Verlet",
            step,
            timed(|| general::<VelocityVerlet>(rig, step, seconds)),
        );
        print("Gear", step, timed(|| general::<Gear5>(rig, step, seconds)));
    }
}

/// Half a period of the thesis's torque: contact 2 slips, the disk slides, stops and shivers.
fn slide(step: f64) -> Motion {
    let rig = rig(1e6, false);
    let [x, y] = equilibrium(&rig, &[SupportMotion::REST; 2]).expect("rests");
    let torque = HarmonicTorque {
        amplitude: 0.15,
        angular_frequency: 1.0,
    };
    let mut disk = DiskOnTwoSupports::new(TwoSupportsSetup::new(rig, step), torque, 0.0, [x, y, 0.0], [0.0; 3]);
    disk.advance(4.0, false).expect("runs");
    motion(&disk)
}

fn under_a_slow_torque() {
    let largest = TimeStepLimits::of(&rig(1e6, false), None).largest;
    let exact = slide(0.125 * largest);
    println!("slide and stop under 0.15 sin(t) N.m, 4 s: step, CPU ms per simulated s, error of the angle, of all");
    for radians in [1.5, 1.0, 0.5, 0.25] {
        let step = radians * largest;
        let (cpu, found) = timed(|| slide(step));
        let angle = (found[2] - exact[2]).abs();
        println!(
            "  {step:9.1e} s {:9.3} ms/s  {angle:.1e}  {:.1e}",
            cpu / 4.0 * 1e3,
            distance(&found, &exact)
        );
    }
}

fn scene<M: Model>(seconds: f64) {
    let mut runs: Vec<f64> = (0..5)
        .map(|_| {
            let mut disk = Simulation::<M>::new(&[], &[("tilt", TILT.into())]).expect("a legal scene");
            let start = ProcessTime::now();
            disk.advance_to(seconds).expect("runs");
            start.elapsed().as_secs_f64()
        })
        .collect();
    runs.sort_by(f64::total_cmp);
    println!(
        "  {:16} {:7.1} simulated s per CPU s",
        M::info().variant_of("drive").expect("a drive"),
        seconds / runs[2]
    );
}

fn main() {
    against_general_molecular_dynamics(3e3);
    against_general_molecular_dynamics(1e6);
    under_a_slow_torque();
    println!("scene with the thesis's parameters, tilt {TILT} rad:");
    scene::<DiskOnTwoSupportsOnInput>(5.0);
    scene::<DiskOnTwoSupportsOnHarmonicTorque>(5.0);
    scene::<DiskOnTwoSupportsOnRandomSupports>(2.0);
    scene::<DiskOnTwoSupportsOnSine>(2.0);
}

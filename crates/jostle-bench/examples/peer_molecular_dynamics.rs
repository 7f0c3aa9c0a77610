//! Molecular dynamics of a packing read from a file, for measurements beside other programs.
//!
//! `cargo run --release -p jostle-bench --example peer_molecular_dynamics -- FILE STEPS TIME_STEP`
//!
//! FILE: first line `count width height`, then `radius x y vx vy omega` of each disk, with the corner of the box at the
//! origin. Laws, masses and motion of the bottom are those of the case in benches/peers/README.md: surface density
//! 3.57 kg/m2, g 9.8 m/s2, k_n 1e4 N/m, kappa 0.77, damping 0.1 kg/s, friction 0.1, bottom A - A cos(2 pi 80 t) with
//! A = 0.15514 mm (Gamma 4). Prints processor time per disk and step, and energies to compare.

use std::f64::consts::{FRAC_PI_2, PI};
use std::process::ExitCode;

use cpu_time::ProcessTime;
use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::Sine;
use jostle::engine::Engine;
use jostle::engine::dem::{ContactLaws, SoftDiskSetup, Verlet};
use jostle::geometry::{Disk, Wall};

const AMPLITUDE: f64 = 1.5514e-4;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("peer_molecular_dynamics: {error}\nArguments: FILE STEPS TIME_STEP");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &[String]) -> Result<(), Box<dyn std::error::Error>> {
    let [file, steps, time_step] = arguments else {
        return Err("three arguments are needed".into());
    };
    let (steps, time_step) = (steps.parse::<u64>()?, time_step.parse::<f64>()?);
    let text = std::fs::read_to_string(file)?;
    let mut numbers = text.split_whitespace().map(str::parse::<f64>);
    let mut next = || numbers.next().ok_or("the file ends early")?.map_err(|_| "not a number");
    let (count, width, _) = (next()? as usize, next()?, next()?);
    let (mut disks, mut rates) = (Vec::new(), Vec::new());
    for _ in 0..count {
        let (radius, x, y) = (next()?, next()?, next()?);
        disks.push(Disk {
            radius,
            x: x - 0.5 * width,
            y,
        });
        rates.push([next()?, next()?, next()?]);
    }
    let mut engine = engine(&disks, width, time_step);
    engine.set_motion(|state| {
        for (velocity, rate) in state.velocity.chunks_exact_mut(3).zip(&rates) {
            velocity.copy_from_slice(rate);
        }
    });
    let start = ProcessTime::now();
    engine
        .advance_to(steps as f64 * time_step)
        .map_err(|breakdown| format!("{breakdown:?}"))?;
    let seconds = start.elapsed().as_secs_f64();
    let energies = engine.energies();
    println!(
        "jostle N={count} steps={steps} cpu={seconds:.3} ns/particle-step={:.2} contacts={} kinetic={:.6e}",
        1e9 * seconds / steps as f64 / count as f64,
        engine.now().contacts,
        energies.kinetic,
    );
    Ok(())
}

fn engine(disks: &[Disk], width: f64, time_step: f64) -> Verlet<Sine> {
    let normal = LinearDashpot {
        stiffness: 1e4,
        damping: 0.1,
    };
    let tangential = TangentialSpring {
        stiffness: 0.77e4,
        friction: 0.1,
    };
    let lowered: Vec<Disk> = disks.iter().map(|disk| disk.raised(-AMPLITUDE)).collect();
    let setup = SoftDiskSetup {
        laws: ContactLaws { normal, tangential },
        walls: vec![
            Wall::vibrating_floor(),
            Wall::left(-0.5 * width),
            Wall::right(0.5 * width),
        ],
        masses: disks.iter().map(|disk| 3.57 * PI * disk.radius * disk.radius).collect(),
        gravity: 9.8,
        time_step,
        start_time: 0.0,
    };
    // A - A cos = A + A sin(. - pi/2): the floor of the file is at rest at zero, the sine starts at -A.
    let base = Sine {
        amplitude: AMPLITUDE,
        frequency: 80.0,
        phase: -FRAC_PI_2,
    };
    Verlet::new(setup, &lowered, base)
}

//! Speed of the event-driven engine on smooth elastic disks without gravity: `cargo bench --bench event_driven`.
//!
//! Equal disks of radius 1/2 in a periodic cell, packing fraction 0.6, from a triangular lattice with random velocities:
//! the classic benchmark of event-driven codes. Prints CPU nanoseconds per collision.

use cpu_time::ProcessTime;
use std::f64::consts::PI;

use jostle::collision::{CollisionLaw, Coulomb, Smooth};
use jostle::engine::Engine;
use jostle::engine::event_driven::{EventDriven, Model, Periodic, Region, Settings, Walls};
use jostle::geometry::{Disk, Vector2};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// Two normal deviates by Box and Muller.
fn normal_pair(random: &mut Pcg64) -> [f64; 2] {
    let mut uniform = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let (radius, angle) = ((-2.0 * (1.0 - uniform()).ln()).sqrt(), 2.0 * PI * uniform());
    [radius * angle.cos(), radius * angle.sin()]
}

fn lattice(count: usize, packing_fraction: f64) -> (Vec<Disk>, Vector2<f64>) {
    let mut across = ((count as f64).sqrt() + 0.5) as usize;
    across += across % 2;
    let lines = count / across;
    let spacing = (PI / 4.0 / packing_fraction * 2.0 / 3.0_f64.sqrt()).sqrt();
    let rise = spacing * 3.0_f64.sqrt() / 2.0;
    let disk = |index: usize| {
        let (line, place) = (index / across, index % across);
        let x = (place as f64 + 0.5 * (line % 2) as f64 + 0.25) * spacing;
        Disk {
            x,
            y: (line as f64 + 0.5) * rise,
            radius: 0.5,
        }
    };
    (
        (0..across * lines).map(disk).collect(),
        Vector2::new(across as f64 * spacing, lines as f64 * rise),
    )
}

/// Runs a gas and returns CPU nanoseconds a collision, list renewals and stale events a collision, collisions, energy.
fn run<L: CollisionLaw>(law: L, gravity: f64, count: usize, shell: f64, collisions: f64) -> [f64; 5] {
    let (disks, size) = lattice(count, 0.6);
    let number = disks.len() as f64;
    let mut random = Pcg64::seed_from_u64(1);
    let mut velocities: Vec<[f64; 3]> = Vec::with_capacity(disks.len());
    for _ in &disks {
        let [x, y] = normal_pair(&mut random);
        velocities.push([x, y, 0.0]);
    }
    let mean = [0, 1].map(|axis| velocities.iter().map(|velocity| velocity[axis]).sum::<f64>() / number);
    velocities
        .iter_mut()
        .for_each(|velocity| (0..2).for_each(|axis| velocity[axis] -= mean[axis]));
    let energy: f64 = velocities
        .iter()
        .map(|velocity| velocity[0].powi(2) + velocity[1].powi(2))
        .sum();
    let scale = (2.0 * number / energy).sqrt();
    velocities
        .iter_mut()
        .for_each(|velocity| (0..2).for_each(|axis| velocity[axis] *= scale));

    let model = Model {
        law,
        boundary: Walls::none(),
        gravity,
        space: Periodic(Region {
            corner: Vector2::zeros(),
            size,
        }),
    };
    let settings = Settings {
        shell,
        ..Settings::default()
    };
    let mut engine = EventDriven::new(model, &disks, &vec![1.0; disks.len()], &velocities, settings);
    // 6.15 collisions per disk and unit of time.
    let mut end = 20.0 / 6.15;
    engine.advance_to(end).expect("headway");
    let before = engine.state().counts;
    let start = ProcessTime::now();
    end += collisions / number / 6.15;
    engine.advance_to(end).expect("headway");
    let seconds = start.elapsed().as_secs_f64();
    let after = engine.state().counts;
    let done = (after.disk_impacts - before.disk_impacts) as f64;
    let bodies = &engine.state().bodies;
    let energy: f64 = bodies.iter().map(|body| body.velocity.norm_squared()).sum::<f64>() / number / 2.0;
    let (renewals, stale) = (after.list_renewals - before.list_renewals, after.stale - before.stale);
    [
        seconds / done * 1e9,
        renewals as f64 / done,
        stale as f64 / done,
        done,
        energy,
    ]
}

/// Without arguments a table; with a count, a shell and a number of collisions one line for a comparison side by side.
fn main() {
    let arguments: Vec<f64> = std::env::args()
        .skip(1)
        .filter_map(|argument| argument.parse().ok())
        .collect();
    let smooth = Smooth::new(1.0).expect("elastic");
    if let [count, shell, collisions] = arguments[..] {
        let [nanoseconds, ..] = run(smooth, 0.0, count as usize, shell, collisions);
        println!("{nanoseconds:.1} ns a collision");
        return;
    }
    // Friction cools the gas and a trace of gravity lets it fall; both change little over the run.
    let rough = Coulomb::new(1.0, 0.01).expect("elastic along the normal");
    for count in [60, 1000, 10_000, 100_000] {
        let [nanoseconds, renewals, stale, done, energy] = run(smooth, 0.0, count, 1.8, 2e6);
        let [rough, ..] = run(rough, 1e-9, count, 1.8, 2e6);
        println!(
            "{count:6} disks: {nanoseconds:6.1} ns a collision ({renewals:.3} list renewals, {stale:.3} stale a collision, \
             {done} collisions, energy {energy:.12}); with friction, spin and gravity {rough:6.1} ns, ratio {:.2}",
            rough / nanoseconds
        );
    }
}

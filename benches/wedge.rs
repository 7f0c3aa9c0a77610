//! Speed of the wedge scene: `cargo bench --bench wedge`.
//!
//! Prints nanoseconds per bounce of the map and of the moving wedge, of the parts they are made of, the time of a
//! communication step without an event, of saving and restoring, and simulated seconds per second of all three engines.
//! Medians of seven runs; built for the generic x86-64 that ships.

use cpu_time::ProcessTime;
use std::f64::consts::TAU;
use std::hint::black_box;

use jostle::collision::{CollisionLaw, Dashpot, TabulatedDashpot, VelocityFloor};
use jostle::contact::LinearDashpot;
use jostle::drive::{AtRandomPhase, BaseMotion, RandomPhase, Sine};
use jostle::engine::wedge::{DiskInWedge, Start, WedgeFrame, WedgeSetup};
use jostle::scene::wedge::{WedgeEventDrivenOnSine, WedgeMap, WedgeMolecularDynamicsOnSine};
use jostle::scene::{Model, Simulation};
use rand::SeedableRng;
use rand_pcg::Pcg64;

const RUNS: usize = 7;
const BASE: Sine = Sine {
    amplitude: 7.757e-5,
    frequency: 80.0,
    phase: 0.0,
};

/// Median seconds of `RUNS` calls of `work`.
fn median(mut work: impl FnMut()) -> f64 {
    let mut seconds: Vec<f64> = (0..RUNS)
        .map(|_| {
            let start = ProcessTime::now();
            work();
            start.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    seconds[RUNS / 2]
}

fn law(restitution: f64) -> TabulatedDashpot {
    let damping = LinearDashpot::damping_ratio_for(restitution);
    let law = Dashpot::of_damping_ratio(1.0, damping, 1.0, 0.773, 0.1).expect("a legal law");
    TabulatedDashpot::new(law, &[1.0], 0.5)
}

fn bounces<L: CollisionLaw, B: BaseMotion>(name: &str, law: L, walls: B) {
    let setup = WedgeSetup {
        frame: WedgeFrame::new(TAU / 3.0, 0.1745),
        radius: 0.02,
        gravity: 9.81,
        slow: 0.0,
    };
    let start = Start {
        time: 0.0,
        height: 1e-3,
        sideways: 0.02,
    };
    let mut disk = DiskInWedge::new(setup, law, walls, start);
    let count = 200_000;
    let seconds = median(|| (0..count).for_each(|_| disk.next_impact().expect("bounces")));
    println!(
        "{name:36} {:7.1} ns per bounce, {:.1} bounces per simulated second",
        seconds / f64::from(count) * 1e9,
        disk.state().sums.collisions as f64 / disk.state().time
    );
}

fn scene<M: Model>(seconds: f64) {
    let built = ProcessTime::now();
    let mut wedge = Simulation::<M>::new(&[], &[("wedge.tilt", 0.1745.into())]).expect("a legal wedge");
    let built = built.elapsed().as_secs_f64();
    let mut time = 0.0;
    let run = median(|| {
        time += seconds;
        wedge.advance_to(time).expect("runs");
    });
    // Steps so short that hardly any of them has an event.
    let calls = 10_000_u32;
    let step = median(|| {
        for _ in 0..calls {
            time += 1e-9;
            wedge.advance_to(time).expect("runs");
            black_box(wedge.all_values().expect("started"));
        }
    });
    let advance = median(|| {
        for _ in 0..calls {
            time += 1e-9;
            wedge.advance_to(time).expect("runs");
        }
    });
    let mut saved = wedge.save();
    let save = median(|| (0..calls).for_each(|_| saved = black_box(wedge.save())));
    let restore = median(|| (0..calls).for_each(|_| wedge.restore(&saved).expect("restores")));
    let each = |seconds: f64| seconds / f64::from(calls) * 1e9;
    println!(
        "{:20} {:10.0} simulated seconds per second; step without event {:.0} ns, with all outputs {:.0} ns; saved {:.0} \
         ns, restored {:.0} ns; built in {:.1} ms",
        M::info().variant_of("engine").unwrap_or_default(),
        seconds / run,
        each(advance),
        each(step),
        each(save),
        each(restore),
        built * 1e3
    );
}

fn main() {
    for restitution in [0.9, 0.5] {
        let walls = AtRandomPhase::new(
            RandomPhase {
                peak_velocity: BASE.amplitude * BASE.frequency * TAU,
            },
            Pcg64::seed_from_u64(1),
        );
        bounces(&format!("map, e_n {restitution}"), law(restitution), walls);
        let floored = VelocityFloor::new(law(restitution), 1e-4).expect("a legal floor");
        bounces(&format!("moving wedge, e_n {restitution}"), floored, BASE);
    }
    scene::<WedgeMap>(1000.0);
    scene::<WedgeEventDrivenOnSine>(1000.0);
    scene::<WedgeMolecularDynamicsOnSine>(1.0);
}

//! Error against work of the engines of soft disks, as lines of CSV.
//!
//! `cargo run --release -p jostle-bench --example work_precision [CASE]`, CASE one of impact, pile, packing; without it all.
//!
//! Columns: case, method, setting (time step in seconds), error, CPU seconds (median of five runs), evaluations (passes
//! over all contacts). Errors: of an impact the velocities afterwards relative to those before, root mean square over
//! 16 places of the touch in a step, against an integration of the phases apart from the engines; of a pile of three and
//! of a packing of 60 the angles turned, root mean square over disks relative to their own, against the method of fourth
//! order with steps of 0.4 microseconds, which Verlet's own sequence confirms. The horizons, 16 ms and 50 ms, are short
//! of chaos.

use cpu_time::ProcessTime;
use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::Sine;
use jostle::engine::Engine;
use jostle::engine::dem::verlet::{Gear5, Integrator, PredictorCorrector, VelocityVerlet};
use jostle::engine::dem::{ContactLaws, EventLocated, FixedGrid, SoftDiskSetup};
use jostle::geometry::{Disk, Wall};
use jostle::packing::{RadiusDistribution, advancing_front};

#[path = "../../../tests/support/reference_impact.rs"]
mod reference_impact;
use reference_impact::Impact;

const RUNS: usize = 5;
const GRAVITY: f64 = 9.8;
const LAWS: ContactLaws = ContactLaws {
    normal: LinearDashpot {
        stiffness: 1e4,
        damping: 0.1,
    },
    tangential: TangentialSpring {
        stiffness: 0.77e4,
        friction: 0.1,
    },
};

fn mass(radius: f64) -> f64 {
    3.57 * std::f64::consts::PI * radius * radius
}

/// Places afterwards, rates afterwards, CPU seconds, evaluations.
struct Run {
    places: Vec<[f64; 3]>,
    rates: Vec<[f64; 3]>,
    seconds: f64,
    evaluations: u64,
}

/// Where disks start, and in which box.
#[derive(Clone)]
struct Case {
    disks: Vec<Disk>,
    rates: Vec<[f64; 3]>,
    walls: Vec<Wall>,
    gravity: f64,
    drive: Sine,
    end: f64,
}

type Method = (&'static str, fn(&Case, f64) -> Run);

const METHODS: [Method; 3] = [
    ("velocity Verlet", fixed::<VelocityVerlet>),
    ("Gear 5", fixed::<Gear5>),
    ("located events", located),
];

impl Case {
    fn setup(&self, time_step: f64) -> SoftDiskSetup {
        SoftDiskSetup {
            laws: LAWS,
            walls: self.walls.clone(),
            masses: self.disks.iter().map(|disk| mass(disk.radius)).collect(),
            gravity: self.gravity,
            time_step,
            start_time: 0.0,
        }
    }
}

fn located(case: &Case, time_step: f64) -> Run {
    let mut engine = EventLocated::new(case.setup(time_step), &case.disks, case.drive);
    engine.set_motion(|disks| disks.velocities.clone_from(&case.rates));
    let start = ProcessTime::now();
    engine.advance_to(case.end).expect("runs");
    let seconds = start.elapsed().as_secs_f64();
    Run {
        places: engine.now().disks.positions.clone(),
        rates: engine.now().disks.velocities.clone(),
        seconds,
        evaluations: 2 * engine.now().steps,
    }
}

fn fixed<I: Integrator>(case: &Case, time_step: f64) -> Run {
    let mut engine = FixedGrid::<PredictorCorrector<I>, _>::new(case.setup(time_step), &case.disks, case.drive);
    let count = case.disks.len();
    engine.set_motion(|disks| disks.velocity[..3 * count].copy_from_slice(case.rates.as_flattened()));
    let start = ProcessTime::now();
    engine.advance_to(case.end).expect("runs");
    let seconds = start.elapsed().as_secs_f64();
    Run {
        places: engine.observables().positions[..count].to_vec(),
        rates: engine.observables().velocities[..count].to_vec(),
        seconds,
        evaluations: engine.now().steps,
    }
}

/// Prints one curve for each method: `error` of the runs at each time step.
fn curves(case: &str, steps: &[f64], run: impl Fn(&Method, f64) -> (f64, f64, u64)) {
    for method in &METHODS {
        for &step in steps {
            let mut runs: Vec<_> = (0..RUNS).map(|_| run(method, step)).collect();
            runs.sort_by(|a, b| a.1.total_cmp(&b.1));
            let (error, seconds, evaluations) = runs[RUNS / 2];
            println!("{case},{},{step:.3e},{error:.3e},{seconds:.3e},{evaluations}", method.0);
        }
    }
}

/// A disk that rolls back from a wall: stick, slip and stick again, without gravity.
fn impact() {
    const RADIUS: f64 = 0.02;
    let velocity: [f64; 3] = [0.05, -0.3, 2.0];
    let reference = Impact::of_disk(&LAWS, mass(RADIUS), RADIUS, velocity);
    let (_, tangential_after) = reference.velocities_after(4000);
    let restitution = LAWS.normal.restitution(mass(RADIUS));
    let duration = std::f64::consts::PI * (mass(RADIUS) / LAWS.normal.stiffness).sqrt();
    let steps: Vec<f64> = (0..14).map(|k| duration / 5.0 / f64::powi(2.0, k)).collect();
    curves("impact", &steps, |method, step| {
        let (mut squares, mut seconds, mut evaluations) = (0.0, 0.0, 0);
        for phase in 0..16 {
            let gap = -velocity[1] * step * (1.0 + (f64::from(phase) + 0.5) / 16.0);
            let case = Case {
                disks: vec![Disk {
                    x: 0.0,
                    y: RADIUS + gap,
                    radius: RADIUS,
                }],
                rates: vec![velocity],
                walls: vec![Wall::vibrating_floor()],
                gravity: 0.0,
                drive: at_rest(),
                end: 1.1 * duration - 2.0 * gap / velocity[1],
            };
            let run = method.1(&case, step);
            let after = run.rates[0];
            let normal = after[1] / -velocity[1] - restitution;
            let surface = (after[0] + RADIUS * after[2] - tangential_after) / reference.tangential_velocity;
            squares += f64::max(normal * normal, surface * surface) / 16.0;
            seconds += run.seconds / 16.0;
            evaluations += run.evaluations;
        }
        (squares.sqrt(), seconds, evaluations / 16)
    });
}

fn at_rest() -> Sine {
    Sine {
        amplitude: 0.0,
        frequency: 0.0,
        phase: 0.0,
    }
}

fn shaking(gamma: f64) -> Sine {
    Sine {
        amplitude: Sine::amplitude_of(gamma, 80.0, GRAVITY),
        frequency: 80.0,
        phase: 0.0,
    }
}

fn box_of(width: f64) -> Vec<Wall> {
    vec![
        Wall::vibrating_floor(),
        Wall::left(-0.5 * width),
        Wall::right(0.5 * width),
    ]
}

/// One disk above two on a shaking base.
fn pile() {
    let places = [(-0.021, 0.0201), (0.0205, 0.0203), (0.001, 0.0545)];
    let case = Case {
        disks: places.map(|(x, y)| Disk { x, y, radius: 0.02 }).to_vec(),
        rates: vec![[0.1, -0.1, 3.0], [0.0, -0.1, 0.0], [0.0, -0.2, 1.0]],
        walls: box_of(0.1),
        gravity: GRAVITY,
        drive: shaking(2.0),
        end: 0.016,
    };
    angles("pile", &case);
}

/// Sixty disks after three seconds of settling at Gamma 4, as in P 3.2.
fn packing() {
    let radii = RadiusDistribution::default().sample(60, 1).expect("radii");
    let disks = advancing_front(&radii, 0.4).expect("places");
    let mut case = Case {
        rates: vec![[0.0; 3]; disks.len()],
        disks,
        walls: box_of(0.4),
        gravity: GRAVITY,
        drive: shaking(4.0),
        end: 3.0,
    };
    let settled = located(&case, 5e-5);
    case.rates = settled.rates;
    for (disk, place) in case.disks.iter_mut().zip(&settled.places) {
        (disk.x, disk.y) = (place[0], place[1]);
    }
    case.end = 0.05;
    angles("packing", &case);
}

/// Errors of the angles turned.
fn angles(name: &str, case: &Case) {
    let reference = located(case, 4e-7).places;
    let size: f64 = reference.iter().map(|place| place[2].powi(2)).sum();
    let steps: Vec<f64> = (0..13).map(|k| 2e-4 / f64::powi(2.0, k)).collect();
    curves(name, &steps, |method, step| {
        let run = method.1(case, step);
        let pairs = run.places.iter().zip(&reference);
        let squares: f64 = pairs.map(|(place, exact)| (place[2] - exact[2]).powi(2)).sum();
        ((squares / size).sqrt(), run.seconds, run.evaluations)
    });
}

fn main() {
    let asked = std::env::args().nth(1);
    let cases: [(&str, fn()); 3] = [("impact", impact), ("pile", pile), ("packing", packing)];
    if let Some(name) = asked
        .as_deref()
        .filter(|name| cases.iter().all(|(known, _)| known != name))
    {
        eprintln!("no case is called {name}. Name one of impact, pile, packing, or none for all.");
        std::process::exit(2);
    }
    println!("case,method,setting,error,cpu_seconds,evaluations");
    for (name, case) in cases {
        if asked.as_deref().is_none_or(|asked| asked == name) {
            case();
        }
    }
}

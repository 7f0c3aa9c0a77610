//! Threads of soft disks: `cargo bench --bench threads -- [THREADS [DISKS...]]`, 2 threads if none are named.
//!
//! For packings at Gamma 4: wall time of a time step with one thread and with several, in turn, medians of the runs and of their
//! ratios, with the load of the machine beside them, since a load spoils what is measured. Both runs must end with the same bits.
//! Then, by processor time and so with less regard to load: how much of a step is divided among threads, and the ratio that follows
//! from it if dividing costs nothing.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Instant;

use cpu_time::ThreadTime;
use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::Sine;
use jostle::engine::Engine;
use jostle::engine::dem::verlet::{PredictorCorrector, VelocityVerlet};
use jostle::engine::dem::{ContactLaws, FixedGrid, SoftDiskSetup, TimeStepLimits};
use jostle::engine::threads::{OneThread, ThreadPool, Threads};
use jostle::geometry::Wall;
use jostle::packing::advancing_front;

const ROUNDS: usize = 9;

type Packing<T> = FixedGrid<PredictorCorrector<VelocityVerlet, LinearDashpot, T>, Sine>;

/// As the scene `packing` has them at its start, with the base at Gamma 4 and 80 Hz.
fn packing<T: Threads>(count: usize) -> Packing<T> {
    let width = 0.4 * (count as f64 / 60.0).sqrt();
    let radii: Vec<f64> = (0..count).map(|n| [0.015, 0.020, 0.025][(n * n + n / 3) % 3]).collect();
    let disks = advancing_front(&radii, width).expect("a box that is wide enough");
    let laws = ContactLaws {
        normal: LinearDashpot {
            stiffness: 1e4,
            damping: 0.1,
        },
        tangential: TangentialSpring {
            stiffness: 0.77e4,
            friction: 0.1,
        },
    };
    let masses: Vec<f64> = radii
        .iter()
        .map(|radius| 3.57 * std::f64::consts::PI * radius * radius)
        .collect();
    let base = Sine {
        amplitude: Sine::amplitude_of(4.0, 80.0, 9.8),
        frequency: 80.0,
        phase: 0.0,
    };
    let setup = SoftDiskSetup {
        laws,
        walls: vec![
            Wall::vibrating_floor(),
            Wall::left(-0.5 * width),
            Wall::right(0.5 * width),
        ],
        time_step: TimeStepLimits::verlet(&laws, &masses, Some(base.frequency)).default,
        masses,
        gravity: 9.8,
        start_time: 0.0,
    };
    FixedGrid::new(setup, &disks, base)
}

/// Does so many time steps more.
fn advance<T: Threads>(packing: &mut Packing<T>, steps: u64) {
    let end = packing.setup().start_time + (packing.state().steps + steps) as f64 * packing.setup().time_step;
    packing.advance_to(end).expect("runs");
}

fn microseconds_a_step<T: Threads>(packing: &mut Packing<T>, steps: u64) -> f64 {
    let start = Instant::now();
    advance(packing, steps);
    1e6 * start.elapsed().as_secs_f64() / steps as f64
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// Processes that wanted to run in the last minute, on average.
fn load() -> String {
    let load = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    load.split(' ').next().unwrap_or("unknown").to_owned()
}

/// One thread that plays several and adds up the processor time \[ns\] of what they would share.
#[derive(Debug, Clone, Default)]
struct Measured {
    count: usize,
    shared: Arc<AtomicU64>,
    regions: Arc<AtomicU64>,
    is_inside: Arc<AtomicBool>,
}

impl Threads for Measured {
    fn count(&self) -> usize {
        self.count.max(1)
    }

    fn within<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        work()
    }

    fn join<A: Send, B: Send>(&self, one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B + Send) -> (A, B) {
        if self.is_inside.swap(true, Ordering::Relaxed) {
            return (one(), other());
        }
        let start = ThreadTime::now();
        let both = (one(), other());
        let nanoseconds = start.elapsed().as_nanos() as u64;
        self.shared.fetch_add(nanoseconds, Ordering::Relaxed);
        self.regions.fetch_add(1, Ordering::Relaxed);
        self.is_inside.store(false, Ordering::Relaxed);
        both
    }
}

/// How a step is divided, by processor time.
struct Division {
    /// Time \[us\] of a step by one thread.
    undivided: f64,
    /// Of a step that is divided, but done by one thread.
    divided: f64,
    /// Part of that which is shared.
    shared: f64,
    /// How often a step shares something.
    regions: f64,
}

impl Division {
    /// The smallest times of several runs in turn.
    fn of(alone: &Packing<ThreadPool>, threads: usize, steps: u64) -> Self {
        let measured = Measured {
            count: threads,
            ..Measured::default()
        };
        let mut one = packing::<OneThread>(alone.radii().len());
        let mut other = packing::<Measured>(alone.radii().len());
        other.use_threads(measured.clone());
        let mut found = Self {
            undivided: f64::INFINITY,
            divided: f64::INFINITY,
            shared: 0.0,
            regions: 0.0,
        };
        for packing in 0..ROUNDS {
            let start = ThreadTime::now();
            advance(&mut one, steps);
            let undivided = 1e6 * start.elapsed().as_secs_f64() / steps as f64;
            measured.shared.store(0, Ordering::Relaxed);
            measured.regions.store(0, Ordering::Relaxed);
            let start = ThreadTime::now();
            advance(&mut other, steps);
            let divided = 1e6 * start.elapsed().as_secs_f64() / steps as f64;
            if packing == 0 {
                continue; // as long as the packing is not what it will be
            }
            found.undivided = found.undivided.min(undivided);
            if divided < found.divided {
                found.divided = divided;
                found.shared = 1e-3 * measured.shared.load(Ordering::Relaxed) as f64 / steps as f64 / divided;
                found.regions = measured.regions.load(Ordering::Relaxed) as f64 / steps as f64;
            }
        }
        found
    }

    /// One thread's time over that of so many if nothing else costs time.
    fn ratio(&self, threads: usize) -> f64 {
        self.undivided / self.divided / (1.0 - self.shared + self.shared / threads as f64)
    }
}

fn main() {
    // `cargo bench` passes `--bench`.
    let arguments = std::env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let mut numbers = arguments.map(|argument| argument.parse::<usize>().expect("whole numbers: threads, then disks"));
    let threads = numbers.next().unwrap_or(2);
    let mut sizes: Vec<usize> = numbers.collect();
    if sizes.is_empty() {
        sizes = vec![1000, 3000, 10_000, 100_000];
    }
    println!(
        "disks | us a step, 1 thread | {threads} threads | ratio (quartiles) | load | processor us a step | divided | shared part | regions a step | ratio if dividing is free"
    );
    for disks in sizes {
        let mut alone = packing::<ThreadPool>(disks);
        let steps = (5_000_000 / disks as u64).clamp(50, 2000);
        advance(&mut alone, steps.max(300));
        let mut shared = alone.clone();
        shared.use_threads(ThreadPool::new(threads).expect("threads"));
        let (mut of_one, mut of_all, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
        for _ in 0..ROUNDS {
            of_one.push(microseconds_a_step(&mut alone, steps));
            of_all.push(microseconds_a_step(&mut shared, steps));
            ratios.push(of_one[of_one.len() - 1] / of_all[of_all.len() - 1]);
            assert!(alone.state() == shared.state(), "the bits of one thread");
        }
        ratios.sort_by(f64::total_cmp);
        let [low, middle, high] = [ROUNDS / 4, ROUNDS / 2, ROUNDS - 1 - ROUNDS / 4].map(|n| ratios[n]);
        let (of_one, of_all, load) = (median(of_one), median(of_all), load());
        let division = Division::of(&alone, threads, steps);
        println!(
            "{disks:6} | {of_one:8.1} | {of_all:8.1} | {middle:.2} ({low:.2} to {high:.2}) | {load} | {:.1} | {:.1} | {:.3} | {:.2} | {:.2}",
            division.undivided,
            division.divided,
            division.shared,
            division.regions,
            division.ratio(threads)
        );
    }
}

//! Soft disks by several threads: the bits of one, and threads that end with what they work for.

#![allow(clippy::unwrap_used)]

mod support;

use std::sync::Mutex;

use jostle::contact::LinearDashpot;
use jostle::drive::{FollowsInput, Sine};
use jostle::engine::Engine;
use jostle::engine::dem::verlet::{PredictorCorrector, VelocityVerlet};
use jostle::engine::dem::{FixedGrid, SoftDiskSetup, limit_lanes};
use jostle::engine::threads::ThreadPool;
use jostle::geometry::{Disk, Wall};
use jostle::packing::{advancing_front, mirrored};
use jostle::scene::packing::PackingOnSine;
use jostle::scene::{Simulation, Value};
use support::soft_disks::{at_rest, laws, mass};

/// Tests that count threads, or start many, one after the other.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

type Packing<D> = FixedGrid<PredictorCorrector<VelocityVerlet, LinearDashpot, ThreadPool>, D>;

const TIME_STEP: f64 = 1e-5;

fn disks(count: usize) -> (Vec<Disk>, f64) {
    let width = 0.4 * (count as f64 / 60.0).sqrt();
    let radii: Vec<f64> = (0..count).map(|n| [0.015, 0.020, 0.025][n * 7 % 3]).collect();
    (advancing_front(&radii, width).unwrap(), width)
}

fn packing(disks: &[Disk], width: f64, friction: f64, threads: usize) -> Packing<Sine> {
    let setup = SoftDiskSetup {
        laws: laws(0.1, 0.77, friction),
        walls: vec![
            Wall::vibrating_floor(),
            Wall::left(-0.5 * width),
            Wall::right(0.5 * width),
        ],
        masses: disks.iter().map(|disk| mass(disk.radius)).collect(),
        gravity: 9.8,
        time_step: TIME_STEP,
        start_time: 0.0,
    };
    let base = Sine {
        amplitude: Sine::amplitude_of(15.0, 80.0, 9.8),
        frequency: 80.0,
        phase: 0.0,
    };
    let mut packing = Packing::new(setup, disks, base);
    packing.use_threads(ThreadPool::new(threads).unwrap());
    packing
}

/// What a run has done: bytes of its state, and work counts.
#[derive(PartialEq)]
struct Run {
    state: Vec<u8>,
    list_builds: u32,
    pairs: usize,
    contacts: u32,
}

/// Some hundred steps, of which a part is done twice, with other friction and gravity on the way.
fn run(count: usize, friction: f64, threads: usize) -> Run {
    let (disks, width) = disks(count);
    let mut packing = packing(&disks, width, friction, threads);
    let (mut list_builds, mut built) = (0, 0);
    let mut advance = |packing: &mut Packing<Sine>, steps: std::ops::Range<u32>| {
        for step in steps {
            // Not on the grid of time: a copy of the state is observed, with a list of its own perhaps.
            packing.advance_to((f64::from(step) + 1.3) * TIME_STEP).unwrap();
            let now = packing.state().disks.step_of_list_build;
            list_builds += u32::from(now != built);
            built = now;
        }
    };
    advance(&mut packing, 0..20);
    packing.advance_to(200.0 * TIME_STEP).unwrap();
    let saved = packing.copied_state();
    packing.advance_to(300.0 * TIME_STEP).unwrap();
    packing.restore(&saved, 200.0 * TIME_STEP).unwrap();
    packing.tune(0.5 * friction, 8.0);
    packing.advance_to(350.0 * TIME_STEP).unwrap();
    advance(&mut packing, 350..400);
    let state = packing.state();
    Run {
        list_builds,
        pairs: state.disks.pairs.count(),
        contacts: state.contacts,
        state: postcard::to_stdvec(state).unwrap(),
    }
}

/// Lists of one group of contacts and of many, with friction and without; more threads than there are processors.
#[test]
fn the_bits_do_not_depend_on_the_threads() {
    let _alone = ONE_AT_A_TIME.lock();
    for (count, friction) in [(7, 0.1), (60, 0.1), (61, 0.0), (300, 0.3), (3000, 0.1), (3000, 0.0)] {
        let one = run(count, friction, 1);
        println!(
            "{count} disks, friction {friction}: {} list builds, {} pairs, {} contacts",
            one.list_builds, one.pairs, one.contacts
        );
        assert!(one.list_builds > 2);
        for threads in [2, 3, 8] {
            assert!(run(count, friction, threads) == one, "{count} disks, {threads} threads");
        }
    }
}

/// Regression: work counts of 3000 disks.
#[test]
fn work_counts_are_those_of_the_record() {
    let _alone = ONE_AT_A_TIME.lock();
    for threads in [1, 3] {
        let Run {
            list_builds,
            pairs,
            contacts,
            ..
        } = run(3000, 0.1, threads);
        assert_eq!((list_builds, pairs, contacts), (5, 5938, 3792), "{threads} threads");
    }
}

#[test]
fn the_bits_depend_neither_on_lanes_nor_on_threads() {
    let _alone = ONE_AT_A_TIME.lock();
    limit_lanes(8);
    let widest = run(1000, 0.1, 1);
    for lanes in [2, 4, 8] {
        limit_lanes(lanes);
        assert!(run(1000, 0.1, 3) == widest, "{lanes} lanes");
    }
}

/// Disks that fly apart and into each other without a wall: momentum and angular momentum stay to rounding.
#[test]
fn three_threads_keep_momentum_and_angular_momentum() {
    let _alone = ONE_AT_A_TIME.lock();
    let (disks, _) = disks(500);
    let masses: Vec<f64> = disks.iter().map(|disk| mass(disk.radius)).collect();
    let setup = SoftDiskSetup {
        laws: laws(0.1, 0.77, 0.3),
        walls: Vec::new(),
        masses: masses.clone(),
        gravity: 0.0,
        time_step: TIME_STEP,
        start_time: 0.0,
    };
    let mut gas = Packing::<FollowsInput>::new(setup, &disks, at_rest());
    gas.use_threads(ThreadPool::new(3).unwrap());
    gas.set_motion(|state| {
        for (n, velocity) in state.velocity.as_chunks_mut::<3>().0.iter_mut().enumerate() {
            let phase = n as f64;
            *velocity = [phase.sin(), (2.0 * phase).cos(), 20.0 * (3.0 * phase).sin()];
        }
    });
    let angular_momentum = |gas: &Packing<FollowsInput>| -> f64 {
        let now = gas.observables();
        let rows = now.positions.iter().zip(now.velocities).zip(&masses).zip(&disks);
        rows.map(|(((place, rate), mass), disk)| {
            mass * (place[0] * rate[1] - place[1] * rate[0] + 0.5 * disk.radius.powi(2) * rate[2])
        })
        .sum()
    };
    let (momentum, spin, energy) = (gas.momentum(), angular_momentum(&gas), gas.kinetic_energy());
    gas.advance_to(1000.0 * TIME_STEP).unwrap();
    let now = gas.momentum();
    let scale = masses.iter().sum::<f64>();
    println!(
        "momentum {:.1e}, {:.1e} and angular momentum {:.1e} of {scale:.1e}",
        now[0] - momentum[0],
        now[1] - momentum[1],
        angular_momentum(&gas) - spin
    );
    assert!((now[0] - momentum[0]).abs() < 1e-13 * scale && (now[1] - momentum[1]).abs() < 1e-13 * scale);
    assert!((angular_momentum(&gas) - spin).abs() < 1e-13 * scale);
    assert!(gas.kinetic_energy() < 0.99 * energy, "disks have met");
}

/// The box is centred at x = 0: a mirrored packing moves as the mirror image, to the bit.
#[test]
fn three_threads_move_a_mirrored_packing_as_the_mirror_image() {
    let _alone = ONE_AT_A_TIME.lock();
    let (disks, width) = disks(1000);
    let [mut one, mut other] = [disks.clone(), mirrored(&disks)].map(|disks| packing(&disks, width, 0.2, 3));
    one.advance_to(500.0 * TIME_STEP).unwrap();
    other.advance_to(500.0 * TIME_STEP).unwrap();
    let (one, other) = (one.observables(), other.observables());
    for (a, b) in one.positions.iter().zip(other.positions) {
        assert_eq!([a[0], a[1], a[2]], [-b[0], b[1], -b[2]]);
    }
    assert_eq!((one.contacts, one.energy_lost), (other.contacts, other.energy_lost));
}

fn scene(disks: u32, threads: i64) -> Simulation<PackingOnSine> {
    let given = [
        ("box.width", (0.4 * (f64::from(disks) / 60.0).sqrt()).into()),
        ("drive.amplitude", Sine::amplitude_of(4.0, 80.0, 9.8).into()),
        ("threads", Value::Integer(threads)),
    ];
    Simulation::new(&[("disks", disks)], &given).unwrap()
}

/// A state of one thread goes on with eight: no state holds how many there are.
#[test]
fn a_saved_state_goes_on_with_the_threads_that_there_are() {
    let _alone = ONE_AT_A_TIME.lock();
    let (mut one, mut eight) = (scene(2500, 1), scene(2500, 8));
    one.advance_to(2e-3).unwrap();
    let bytes = one.to_bytes().unwrap();
    one.advance_to(4e-3).unwrap();
    eight.restore_bytes(&bytes).unwrap();
    assert_eq!(eight.values().integer("threads"), 8);
    eight.advance_to(4e-3).unwrap();
    let state = |simulation: &Simulation<PackingOnSine>| simulation.model().unwrap().engine().state().clone();
    assert!(state(&one) == state(&eight));
    let saved = eight.save();
    one.restore(&saved).unwrap();
    assert_eq!(one.values().integer("threads"), 1);
    assert!(state(&one) == state(&eight));
}

/// Threads of this process that a pool has started.
#[cfg(target_os = "linux")]
fn living() -> usize {
    let tasks = std::fs::read_dir("/proc/self/task").unwrap();
    let names = tasks.filter_map(|task| std::fs::read_to_string(task.unwrap().path().join("comm")).ok());
    names.filter(|name| name.trim() == "jostle").count()
}

/// Whether there are so many: a thread that begins has no name yet, and one that has ended may be listed a little longer.
#[cfg(target_os = "linux")]
fn are_living(count: usize) -> bool {
    let pause = std::time::Duration::from_millis(10);
    (0..1000).any(|_| {
        living() == count || {
            std::thread::sleep(pause);
            false
        }
    })
}

#[test]
#[cfg(target_os = "linux")]
fn threads_live_as_long_as_a_large_packing_that_asks_for_them() {
    let _alone = ONE_AT_A_TIME.lock();
    let alone = scene(2500, 1);
    assert_eq!(living(), 0, "one thread is the one that calls");
    let small = scene(60, 8);
    assert_eq!(living(), 0, "60 disks are computed by one");
    let mut large = scene(2500, 3);
    assert!(are_living(3));
    let saved = large.save();
    large.advance_to(1e-3).unwrap();
    large.restore(&saved).unwrap();
    assert_eq!(living(), 3, "a rollback keeps them");
    drop((alone, small, large));
    assert!(are_living(0));
}

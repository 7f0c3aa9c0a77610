//! Speed of the ratchet: `cargo bench --bench ratchet`, or with one of `cases`, `teeth`, `impacts` a part of it, or with
//! `profile DISKS SECONDS` a fixed run for callgrind.
//!
//! - cases: simulated seconds and events in a CPU second, for the two cases of F IV, for n = 4.2 and for the hardest;
//! - teeth: CPU time of an event as disks go from 10 to 10,000 with the teeth, at the same layer count;
//! - impacts: CPU time of an impact on the oscillating base, all that lies between two of them included, over that of an
//!   impact of two disks in a gas with the same law, both of 25 disks.

use cpu_time::ProcessTime;
use jostle::collision::{Coulomb, VelocityFloor};
use jostle::engine::Engine;
use jostle::engine::event_driven::{Counts, EventDriven, Model, Periodic, Region, Settings, Walls};
use jostle::geometry::{Disk, Vector2};
use jostle::scene::ratchet::RatchetOnSine;
use jostle::scene::{Simulation, Value};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

/// A ratchet of so many disks and teeth after two seconds.
fn ratchet(disks: u32, teeth: i64, changes: &[(&str, f64)]) -> Simulation<RatchetOnSine> {
    let mut given: Vec<(&str, Value)> = changes.iter().map(|(name, value)| (*name, (*value).into())).collect();
    given.push(("tooth.count", teeth.into()));
    let mut ratchet = Simulation::new(&[("disks", disks)], &given).expect("a ratchet");
    ratchet.advance_to(2.0).expect("progress");
    ratchet
}

fn counts(ratchet: &Simulation<RatchetOnSine>) -> Counts {
    ratchet.model().expect("a started simulation").engine().state().counts
}

/// What a run did: CPU time and simulated time \[s\], and its counts.
struct Done {
    cpu: f64,
    simulated: f64,
    disk_impacts: f64,
    wall_impacts: f64,
    events: f64,
}

impl Done {
    fn between(cpu: f64, simulated: f64, before: Counts, after: Counts) -> Self {
        let disk_impacts = (after.disk_impacts - before.disk_impacts) as f64;
        let wall_impacts = (after.wall_impacts - before.wall_impacts) as f64;
        let others = (after.list_renewals - before.list_renewals + after.stale - before.stale) as f64;
        Self {
            cpu,
            simulated,
            disk_impacts,
            wall_impacts,
            events: disk_impacts + wall_impacts + others,
        }
    }
}

/// Advances in one step until about `cpu` seconds are gone.
fn measure(mut ratchet: Simulation<RatchetOnSine>, cpu: f64) -> Done {
    let (begin, before) = (2.0, counts(&ratchet));
    let (start, mut time) = (ProcessTime::now(), begin);
    let mut step = 0.05;
    while start.elapsed().as_secs_f64() < cpu {
        step *= 1.2;
        time += step;
        ratchet.advance_to(time).expect("progress");
    }
    let after = counts(&ratchet);
    Done::between(start.elapsed().as_secs_f64(), time - begin, before, after)
}

const POSITIVE: &[(&str, f64)] = &[
    ("tooth.height", 3e-3),
    ("tooth.asymmetry", 0.1),
    ("drive.frequency", 25.0),
];
const NEGATIVE: &[(&str, f64)] = &[
    ("tooth.height", 6e-3),
    ("tooth.asymmetry", 0.25),
    ("drive.frequency", 30.0),
];
/// Gamma = 40 at the amplitude of 2 mm.
const HARDEST: &[(&str, f64)] = &[
    ("tooth.height", 16e-3),
    ("tooth.asymmetry", 0.05),
    ("tooth.tip_radius", 1e-4),
    ("drive.frequency", 70.498),
];

fn cases() {
    for (name, disks, changes) in [
        ("F, positive, n = 0.7", 20, POSITIVE),
        ("F, negative, n = 0.35", 10, NEGATIVE),
        ("positive, n = 4.2", 120, POSITIVE),
        ("negative, n = 4.2", 120, NEGATIVE),
        ("hardest, n = 4.2", 120, HARDEST),
    ] {
        let done = measure(ratchet(disks, 10, changes), 2.0);
        println!(
            "{name:22} {:7.0} s/s, {:.2e} events/s, {:.2e} impacts/s ({:4.1} % on the base), {:.0} ns an impact",
            done.simulated / done.cpu,
            done.events / done.cpu,
            (done.disk_impacts + done.wall_impacts) / done.cpu,
            100.0 * done.wall_impacts / (done.disk_impacts + done.wall_impacts),
            1e9 * done.cpu / (done.disk_impacts + done.wall_impacts),
        );
    }
}

fn teeth() {
    for disks in [10, 100, 1000, 10_000] {
        let done = measure(ratchet(disks, i64::from(disks) / 2, POSITIVE), 2.0);
        println!(
            "{disks:6} disks: {:4.0} ns an event, {:4.0} ns an impact",
            1e9 * done.cpu / done.events,
            1e9 * done.cpu / (done.disk_impacts + done.wall_impacts),
        );
    }
}

/// CPU time \[s\] of an impact in a gas of elastic disks, packing fraction 0.4, with the law of the ratchet.
fn gas(disks: usize) -> f64 {
    let across = (disks as f64).sqrt().ceil() as usize;
    let spacing = (std::f64::consts::PI / 4.0 / 0.4_f64).sqrt() * 2e-3;
    let mut random = Pcg64::seed_from_u64(3);
    let mut unit = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 - 0.5;
    let place = |index: usize| Disk {
        x: (0.5 + (index % across) as f64) * spacing,
        y: (0.5 + (index / across) as f64) * spacing,
        radius: 1e-3,
    };
    let all: Vec<Disk> = (0..across * across).map(place).collect();
    let velocities: Vec<[f64; 3]> = all.iter().map(|_| [unit(), unit(), 0.0]).collect();
    let law = VelocityFloor::new(Coulomb::new(1.0, 0.0).expect("a law"), 1e-9).expect("a law");
    let settings = Settings {
        shell: 2.0,
        ..Settings::default()
    };
    let model = Model {
        law,
        boundary: Walls::none(),
        gravity: 1e-9,
        space: Periodic(Region {
            corner: Vector2::zeros(),
            size: Vector2::repeat(across as f64 * spacing),
        }),
    };
    let mut engine = EventDriven::new(model, &all, &vec![1e-5; all.len()], &velocities, settings);
    engine.advance_to(0.5).expect("progress");
    let before = engine.state().counts.disk_impacts;
    let (start, mut time, mut step) = (ProcessTime::now(), 0.5, 0.01);
    while start.elapsed().as_secs_f64() < 1.0 {
        step *= 1.2;
        time += step;
        engine.advance_to(time).expect("progress");
    }
    start.elapsed().as_secs_f64() / (engine.state().counts.disk_impacts - before) as f64
}

fn impacts() {
    let pair = gas(25);
    for (name, changes) in [("positive", POSITIVE), ("negative", NEGATIVE), ("hardest", HARDEST)] {
        // So far apart that they rarely meet each other.
        let done = measure(ratchet(25, 1000, changes), 1.0);
        let base = done.cpu / done.wall_impacts;
        println!(
            "{name}: {:.0} ns an impact on the base ({:.1} % of others), {:.0} ns one of two disks, ratio {:.2}",
            1e9 * base,
            100.0 * done.disk_impacts / (done.wall_impacts + done.disk_impacts),
            1e9 * pair,
            base / pair
        );
    }
}

/// A fixed run, so that instructions can be counted: `valgrind --tool=callgrind BENCH profile DISKS SECONDS`.
fn profile() {
    let numbers: Vec<f64> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    let [disks, seconds] = numbers[..] else {
        eprintln!("profile DISKS SECONDS");
        return;
    };
    let mut ratchet = ratchet(disks as u32, 10, POSITIVE);
    ratchet.advance_to(2.0 + seconds).expect("progress");
    println!("{:?}", counts(&ratchet));
}

fn main() {
    let wanted = std::env::args().skip(1).find(|argument| !argument.starts_with("--"));
    match wanted.as_deref() {
        Some("cases") => cases(),
        Some("teeth") => teeth(),
        Some("impacts") => impacts(),
        Some("profile") => profile(),
        Some(other) => eprintln!("{other}: one of cases, teeth, impacts, profile"),
        None => {
            cases();
            teeth();
            impacts();
        }
    }
}

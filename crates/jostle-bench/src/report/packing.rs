//! The 60-disk packing over a time short of chaos, against the same packing at a much smaller step.
//!
//! The start is a settled, shaken packing with its velocities and with tangential springs that are not stretched yet, so that other
//! programs can start from it too: `packing60.txt`, in lines of `radius x y vx vy omega` after `count width height`.
//! The bottom is at `A - A cos omega t`: at rest at the start.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;
use std::sync::OnceLock;

use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::Sine;
use jostle::engine::dem::{ContactLaws, SoftDiskSetup, TimeStepLimits};
use jostle::geometry::{Disk, Wall};
use jostle::scene::Simulation;
use jostle::scene::packing::PackingOnSine;
use jostle::scene::soft_disks::refused_step;

use super::case::{Case, Done, Point, Stopwatch, Trouble, known, ladder, root_mean_square};
use super::engines::{Located, SoftEngine, each_engine};
use anyhow::{Context, Result as AnyResult, anyhow};

/// Name of the case.
pub const NAME: &str = "packing60";
/// Times followed \[s\]: two periods of the base, in which other programs take part, and four.
const HORIZON: f64 = 0.025;
const LONG_HORIZON: f64 = 0.05;
const DISKS: u32 = 60;
const WIDTH: f64 = 0.4;
/// Amplitude \[m\]: Gamma 4 as the peers in C++ and LAMMPS round it.
const AMPLITUDE: f64 = 1.5514e-4;
const FREQUENCY: f64 = 80.0;
const GRAVITY: f64 = 9.8;
/// Time step of the reference \[s\].
const REFERENCE_STEP: f64 = 6.25e-8;
const QUANTITIES: &[(&str, &str)] = &[
    (
        "angle",
        "error of the angles over the angles turned, both rms over the disks",
    ),
    (
        "position",
        "error of the positions over the distances moved, both rms over the disks",
    ),
];

/// One disk of the start: radius \[m\], place (x from the left wall, y from the bottom) \[m\], velocity, spin.
#[derive(Debug, Clone, Copy)]
struct Start {
    radius: f64,
    place: [f64; 2],
    rates: [f64; 3],
}

impl Start {
    fn mass(&self) -> f64 {
        3.57 * PI * self.radius.powi(2)
    }
}

/// Places (x, y, angle) of all disks.
type Places = Vec<[f64; 3]>;

/// The packing of 60 disks.
pub fn cases() -> Vec<Case> {
    // Over four periods Verlet needs smaller steps for the same errors.
    vec![case(NAME, HORIZON, 10), case("packing60_long", LONG_HORIZON, 12)]
}

fn case(name: &'static str, horizon: f64, settings: i32) -> Case {
    let mut points = Vec::new();
    for step in ladder(6.25e-5, 0.5, settings) {
        each_engine!(points, point(step, horizon));
    }
    // No point of the reference's own method may come near to its step.
    points.retain(|point| point.method != Located::METHOD || point.setting > REFERENCE_STEP);
    Case {
        name,
        problem: format!(
            "{DISKS} disks in a box on a bottom shaken at {FREQUENCY} Hz, Gamma 4, k_n = 1e4 N/m, mu = 0.1, for {horizon} s."
        ),
        setting: "time step [s]",
        reference: "located events at a time step of 62.5 ns",
        quantities: QUANTITIES,
        points,
    }
}

/// The same packing with the time step that the fourth-order engine takes for each of these tolerances.
pub fn by_tolerance(tolerances: impl Iterator<Item = f64>) -> Case {
    let points = tolerances.map(|tolerance| {
        Point::new(Located::METHOD, tolerance, move |watch: &mut Stopwatch| {
            let masses: Vec<f64> = start()?.iter().map(Start::mass).collect();
            let step = TimeStepLimits::event_located(&laws(), &masses, Some(FREQUENCY), tolerance).default;
            let (places, passes) = run::<Located>(step, HORIZON, watch)?;
            Ok(Done::exact(errors(&places, reference(HORIZON)?, start()?), passes))
        })
    });
    Case {
        name: "packing60_tolerance",
        problem: format!(
            "The packing of {NAME}, the time step chosen by a tolerance of the velocities after an impact."
        ),
        setting: "tolerance",
        reference: "located events at a time step of 62.5 ns",
        quantities: QUANTITIES,
        points: points.collect(),
    }
}

/// The start, settled the first time it is asked for.
fn start() -> Result<&'static [Start], Trouble> {
    static START: OnceLock<Vec<Start>> = OnceLock::new();
    Ok(known(&START, settled)?.as_slice())
}

/// The reference at a horizon \[s\], computed the first time it is asked for.
fn reference(horizon: f64) -> Result<&'static Places, Trouble> {
    static REFERENCES: [OnceLock<Places>; 2] = [const { OnceLock::new() }; 2];
    known(&REFERENCES[usize::from(horizon > HORIZON)], || {
        Ok(run::<Located>(REFERENCE_STEP, horizon, &mut Stopwatch::default())?.0)
    })
}

/// The packing of seed 1 after a second of shaking.
fn settled() -> Result<Vec<Start>, Trouble> {
    let parameters = [("drive.amplitude", AMPLITUDE.into()), ("seed", 1.into())];
    let mut packing = Simulation::<PackingOnSine>::new(&[("disks", DISKS)], &parameters)?;
    packing.advance_to(1.0)?;
    let engine = packing.model()?.engine();
    let now = engine.observables();
    let disks = engine.radii().iter().zip(now.positions).zip(now.velocities);
    Ok(disks
        .map(|((&radius, place), &rates)| Start {
            radius,
            place: [place[0] + 0.5 * WIDTH, place[1]],
            rates,
        })
        .collect())
}

/// Writes start and reference for other programs into `folder`.
pub fn write_states(folder: &Path) -> AnyResult<()> {
    let path = folder.join("packing60.txt");
    let cannot = |path: &Path| format!("{} cannot be written", path.display());
    let failed = |trouble: Trouble| anyhow!(trouble.to_string());
    let mut text = format!("{DISKS} {WIDTH} 0.8665\n");
    for disk in start().map_err(failed)? {
        let ([x, y], [vx, vy, spin]) = (disk.place, disk.rates);
        text.push_str(&format!("{} {x} {y} {vx} {vy} {spin}\n", disk.radius));
    }
    std::fs::write(&path, text).with_context(|| cannot(&path))?;
    let rows = reference(HORIZON)
        .map_err(failed)?
        .iter()
        .map(|[x, y, angle]| format!("{x} {y} {angle}\n"));
    let path = folder.join("packing60_reference.txt");
    std::fs::write(&path, rows.collect::<String>()).with_context(|| cannot(&path))
}

fn laws() -> ContactLaws {
    ContactLaws {
        normal: LinearDashpot {
            stiffness: 1e4,
            damping: 0.1,
        },
        tangential: TangentialSpring {
            stiffness: 0.77e4,
            friction: 0.1,
        },
    }
}

fn engine<E: SoftEngine>(start: &[Start], time_step: f64) -> E {
    let drive = Sine {
        amplitude: AMPLITUDE,
        frequency: FREQUENCY,
        phase: -FRAC_PI_2,
    };
    let bottom = Wall {
        offset: drive.amplitude,
        ..Wall::vibrating_floor()
    };
    let setup = SoftDiskSetup {
        laws: laws(),
        walls: vec![bottom, Wall::left(0.0), Wall::right(WIDTH)],
        masses: start.iter().map(Start::mass).collect(),
        gravity: GRAVITY,
        time_step,
        start_time: 0.0,
    };
    let disks: Vec<Disk> = start
        .iter()
        .map(|disk| Disk {
            x: disk.place[0],
            y: disk.place[1],
            radius: disk.radius,
        })
        .collect();
    let rates: Vec<[f64; 3]> = start.iter().map(|disk| disk.rates).collect();
    E::start(setup, &disks, drive, &rates)
}

/// Places at the horizon, and passes over all contacts until then.
fn run<E: SoftEngine>(time_step: f64, horizon: f64, watch: &mut Stopwatch) -> Result<(Places, f64), Trouble> {
    let start = start()?;
    let mut engine = engine::<E>(start, time_step);
    watch
        .measure(1, || engine.advance_to(horizon))
        .map_err(|breakdown| refused_step(E::METHOD, breakdown))?;
    Ok((engine.places(start.len()), E::PASSES * engine.steps() as f64))
}

fn point<E: SoftEngine>(step: f64, horizon: f64) -> Point {
    Point::new(E::METHOD, step, move |watch: &mut Stopwatch| {
        let exact = reference(horizon)?;
        let (places, passes) = run::<E>(step, horizon, watch)?;
        Ok(Done::exact(errors(&places, exact, start()?), passes))
    })
}

/// Errors of the angles and of the positions, relative to how far the reference has turned and moved.
fn errors(places: &Places, exact: &Places, start: &[Start]) -> [f64; 2] {
    let rms = |of: &dyn Fn(usize) -> f64| root_mean_square(&(0..start.len()).map(of).collect::<Vec<_>>());
    let distance = |a: [f64; 2], b: [f64; 3]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let missed = rms(&|disk| places[disk][2] - exact[disk][2]);
    let turned = rms(&|disk| exact[disk][2]);
    let off = rms(&|disk| distance([places[disk][0], places[disk][1]], exact[disk]));
    let moved = rms(&|disk| distance(start[disk].place, exact[disk]));
    [missed / turned, off / moved]
}

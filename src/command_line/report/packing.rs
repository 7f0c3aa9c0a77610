//! The 60-disk packing over a time short of chaos, against the same packing at a much smaller step.
//!
//! The start is a settled, shaken packing with its velocities and with skins that hold nothing yet, so that other
//! programs can start from it too: `packing60.txt`, in lines of `radius x y vx vy omega` after `count width height`.
//! The bottom is at `A - A cos omega t`: at rest at the start.

use std::cell::OnceCell;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;
use std::path::Path;
use std::rc::Rc;

use jostle::contact::{ElasticSkin, LinearDashpot};
use jostle::drive::Sine;
use jostle::engine::molecular_dynamics::{ContactLaws, Gear5, Integrator, MolecularDynamics, Setup, VelocityVerlet};
use jostle::geometry::{Disk, Wall};
use jostle::scene::Simulation;
use jostle::scene::packing::PackingOnSine;

use super::super::Failure;
use super::case::{Case, Done, Point, Stopwatch, Trouble, ladder, root_mean_square};

/// Time followed \[s\]: two periods of the base.
const HORIZON: f64 = 0.025;
const DISKS: u32 = 60;
const WIDTH: f64 = 0.4;
const GAMMA: f64 = 4.0;
const FREQUENCY: f64 = 80.0;
const GRAVITY: f64 = 9.8;
/// Time step of the reference \[s\].
const REFERENCE_STEP: f64 = 2.5e-9;
const QUANTITIES: &[(&str, &str)] = &[
    ("angle", "error of the angles over the angles turned, both rms over the disks"),
    ("position", "error of the positions over the distances moved, both rms over the disks"),
];

/// One disk of the start: radius \[m\], place (x from the left wall, y from the bottom) \[m\], velocity, spin.
#[derive(Debug, Clone, Copy)]
struct Start {
    radius: f64,
    place: [f64; 2],
    rates: [f64; 3],
}

/// Places (x, y, angle) of all disks.
type Places = Vec<[f64; 3]>;

/// What all points share: the start and, once it is needed, the reference.
struct Shared {
    start: Vec<Start>,
    reference: OnceCell<Places>,
}

/// The packing of 60 disks.
pub fn cases() -> Vec<Case> {
    let shared = Rc::new(Shared {
        start: settled().unwrap_or_default(),
        reference: OnceCell::new(),
    });
    let mut points = Vec::new();
    for step in ladder(6.4e-5, 0.5, 10) {
        points.push(point::<VelocityVerlet>("velocity Verlet", &shared, step));
        points.push(point::<Gear5>("Gear 5", &shared, step));
    }
    vec![Case {
        name: "packing60",
        problem: format!(
            "{DISKS} disks in a box on a bottom shaken at {FREQUENCY} Hz, Gamma {GAMMA}, k_n = 1e4 N/m, for {HORIZON} s."
        ),
        setting: "time step [s]",
        reference: "velocity Verlet at a time step of 2.5 ns",
        quantities: QUANTITIES,
        points,
    }]
}

/// The packing of seed 1 after a second of shaking.
fn settled() -> Result<Vec<Start>, Trouble> {
    let amplitude = Sine::amplitude_of(GAMMA, FREQUENCY, GRAVITY);
    let parameters = [("drive.amplitude", amplitude.into()), ("seed", 1.into())];
    let mut packing = Simulation::<PackingOnSine>::new(DISKS, &parameters)?;
    packing.advance_to(1.0)?;
    let engine = packing.scene().engine();
    let now = engine.now();
    let disks = engine.radii().iter().zip(now.places()).zip(now.rates());
    Ok(disks
        .map(|((&radius, place), &rates)| Start {
            radius,
            place: [place[0] + 0.5 * WIDTH, place[1]],
            rates,
        })
        .collect())
}

/// Writes the start for other programs.
pub fn write_state(path: &Path) -> Result<(), Failure> {
    let start = settled().map_err(|trouble| Failure::file(path, std::io::Error::other(trouble.to_string())))?;
    let mut text = format!("{DISKS} {WIDTH} 0.8665\n");
    for disk in start {
        let ([x, y], [vx, vy, spin]) = (disk.place, disk.rates);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{} {x} {y} {vx} {vy} {spin}", disk.radius);
    }
    std::fs::write(path, text).map_err(|error| Failure::file(path, error))
}

fn engine<I: Integrator>(start: &[Start], time_step: f64) -> MolecularDynamics<I, Sine> {
    let normal = LinearDashpot {
        stiffness: 1e4,
        damping: 0.1,
    };
    let skin = ElasticSkin {
        stiffness: 0.77e4,
        friction: 0.1,
    };
    let drive = Sine {
        amplitude: Sine::amplitude_of(GAMMA, FREQUENCY, GRAVITY),
        frequency: FREQUENCY,
        phase: -FRAC_PI_2,
    };
    let bottom = Wall {
        offset: drive.amplitude,
        ..Wall::vibrating_floor()
    };
    let setup = Setup {
        laws: ContactLaws { normal, skin },
        walls: vec![bottom, Wall::left(0.0), Wall::right(WIDTH)],
        masses: start.iter().map(|disk| 3.57 * PI * disk.radius.powi(2)).collect(),
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
    let mut engine = MolecularDynamics::new(setup, &disks, drive);
    engine.set_motion(|state| {
        for (velocity, disk) in state.velocity.as_chunks_mut().0.iter_mut().zip(start) {
            *velocity = disk.rates;
        }
    });
    engine
}

fn run<I: Integrator>(start: &[Start], time_step: f64, watch: &mut Stopwatch) -> Result<(Places, u64), Trouble> {
    let mut engine = engine::<I>(start, time_step);
    watch
        .measure(1, || engine.advance_to(HORIZON))
        .map_err(|breakdown| format!("{breakdown:?}"))?;
    Ok((engine.now().places()[..start.len()].to_vec(), engine.state().steps))
}

fn point<I: Integrator>(method: &'static str, shared: &Rc<Shared>, step: f64) -> Point {
    let shared = Rc::clone(shared);
    Point::new(method, step, move |watch: &mut Stopwatch| {
        let reference = shared.reference()?;
        let (places, steps) = run::<I>(&shared.start, step, watch)?;
        Ok(Done::exact(shared.errors(&places, reference), steps as f64))
    })
}

impl Shared {
    fn reference(&self) -> Result<&Places, Trouble> {
        if self.start.is_empty() {
            return Err("the packing did not settle".into());
        }
        if self.reference.get().is_none() {
            let (places, _) = run::<VelocityVerlet>(&self.start, REFERENCE_STEP, &mut Stopwatch::default())?;
            return Ok(self.reference.get_or_init(|| places));
        }
        self.reference.get().ok_or_else(|| "no reference".into())
    }

    /// Errors of the angles and of the positions, relative to how far the reference has turned and moved.
    fn errors(&self, places: &Places, reference: &Places) -> [f64; 2] {
        let angle = |of: &dyn Fn(usize) -> f64| root_mean_square(&(0..self.start.len()).map(of).collect::<Vec<_>>());
        let missed = angle(&|disk| places[disk][2] - reference[disk][2]);
        let turned = angle(&|disk| reference[disk][2]);
        let off = angle(&|disk| (places[disk][0] - reference[disk][0]).hypot(places[disk][1] - reference[disk][1]));
        let moved = angle(&|disk| {
            let [x, y] = self.start[disk].place;
            (reference[disk][0] - x).hypot(reference[disk][1] - y)
        });
        [missed / turned, off / moved]
    }
}

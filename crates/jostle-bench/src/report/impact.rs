//! One impact of a disk on a wall at rest, against the closed forms of `collision::Dashpot`.
//!
//! Eight impacts at as many places in a time step make one error, so that no curve depends on where the instant of
//! touch falls on the grid.

use std::f64::consts::{PI, TAU};

use jostle::collision::{CollisionLaw, Dashpot, Impact, TabulatedDashpot};
use jostle::contact::{LinearDashpot, TangentialSpring};
use jostle::drive::Sine;
use jostle::engine::dem::{ContactLaws, SoftDiskSetup, TimeStepLimits};
use jostle::geometry::{Disk, Wall};
use jostle::scene::soft_disks::refused_step;

use super::case::{Case, Done, Point, Stopwatch, Trouble, ladder, root_mean_square};
use super::engines::{Located, SoftEngine, each_engine};

const RADIUS: f64 = 0.02;
const STIFFNESS: f64 = 1e4;
/// Impacts of one error, and how often they are timed at once.
const PLACES: usize = 8;
const REPEATS: usize = 8;

const QUANTITIES: &[(&str, &str)] = &[
    ("e_n", "error of the normal restitution"),
    ("e_t", "error of the tangential restitution"),
    ("angle", "error of the angle at which the surface leaves the wall [rad]"),
];

/// Material and velocities of one impact.
#[derive(Debug, Clone, Copy)]
struct Hit {
    damping: f64,
    friction: f64,
    stiffness_ratio: f64,
    normal_velocity: f64,
    tangential_velocity: f64,
}

/// A grazing impact that sticks and slips, nearly elastic, and one that loses most of its energy.
pub fn cases() -> Vec<Case> {
    let packing = Hit {
        damping: 0.1,
        friction: 0.1,
        stiffness_ratio: 0.77,
        normal_velocity: 0.5,
        tangential_velocity: 0.1,
    };
    let lossy = Hit {
        damping: 3.0,
        friction: 0.4,
        ..packing
    };
    vec![
        case("one_impact", "a packing's contact, e_n = 0.977", packing),
        case("one_lossy_impact", "a lossy contact, e_n = 0.51", lossy),
    ]
}

fn case(name: &'static str, material: &str, hit: Hit) -> Case {
    let mut points = Vec::new();
    for steps in ladder(20.0, 2.0, 10) {
        each_engine!(points, soft(hit, steps));
    }
    points.push(stitched(hit));
    points.push(tabulated(hit));
    Case {
        name,
        problem: format!(
            "A disk hits a wall at rest once ({material}): gamma_n = {} kg/s, mu = {}, u_n = {} m/s, u_t = {} m/s.",
            hit.damping, hit.friction, hit.normal_velocity, hit.tangential_velocity
        ),
        setting: "time steps a contact (hard impacts: 1)",
        reference: "closed forms of stick and slip, stitched to rounding (collision::Dashpot)",
        quantities: QUANTITIES,
        points,
    }
}

impl Hit {
    fn law(self) -> Result<Dashpot, Trouble> {
        Ok(Dashpot::new(
            STIFFNESS,
            self.damping,
            self.stiffness_ratio,
            self.friction,
        )?)
    }

    fn laws(self) -> ContactLaws {
        ContactLaws {
            normal: LinearDashpot {
                stiffness: STIFFNESS,
                damping: self.damping,
            },
            tangential: TangentialSpring {
                stiffness: self.stiffness_ratio * STIFFNESS,
                friction: self.friction,
            },
        }
    }

    /// e_n, e_t and exit angle.
    fn exact(self) -> Result<[f64; 3], Trouble> {
        let (law, mass) = (self.law()?, mass());
        let ratio = self.tangential_velocity / self.normal_velocity;
        let tangential = law.tangential_restitution(mass, mass / 3.0, ratio);
        Ok(self.outcome(law.normal_restitution(mass), tangential))
    }

    fn outcome(self, normal: f64, tangential: f64) -> [f64; 3] {
        let angle = (tangential * self.tangential_velocity).atan2(normal * self.normal_velocity);
        [normal, tangential, angle]
    }

    fn impact(self) -> Impact {
        Impact {
            effective_mass: mass(),
            tangential_mass: mass() / 3.0,
            normal_velocity: -self.normal_velocity,
            tangential_velocity: self.tangential_velocity,
            time_since_last: f64::INFINITY,
        }
    }
}

fn mass() -> f64 {
    3.57 * PI * RADIUS * RADIUS
}

fn contact_time() -> f64 {
    PI * (mass() / STIFFNESS).sqrt()
}

/// Impacts that stick, slip and roll back, with the time step that the fourth-order engine takes for each of these
/// tolerances.
pub fn by_tolerance(tolerances: impl Iterator<Item = f64>) -> Case {
    let throws = [[0.3, 0.02], [0.3, 0.09], [0.2, 0.5], [0.2, 0.14]];
    let hits = throws.map(|[normal_velocity, tangential_velocity]| Hit {
        damping: 0.1,
        friction: 0.1,
        stiffness_ratio: 0.77,
        normal_velocity,
        tangential_velocity,
    });
    let points = tolerances.map(|tolerance| {
        Point::new(Located::METHOD, tolerance, move |watch: &mut Stopwatch| {
            // An infinitely heavy partner: the wall.
            let step =
                TimeStepLimits::event_located(&hits[0].laws(), &[mass(), f64::INFINITY], None, tolerance).default;
            let (mut errors, mut steps) = (Vec::new(), 0);
            for hit in hits {
                let (misses, done) = misses::<Located>(hit, step, watch)?;
                steps += done;
                let of = |i: usize| root_mean_square(&misses.iter().map(|miss| miss[i]).collect::<Vec<_>>());
                errors.push(of(0).max(of(1)));
            }
            let passes = Located::PASSES * steps as f64 / throws.len() as f64;
            Ok(Done::exact([root_mean_square(&errors)], passes))
        })
    });
    Case {
        name: "impact_tolerance",
        problem: "Impacts on a wall that stick, slip and roll back, the time step chosen by the tolerance.".into(),
        setting: "tolerance",
        reference: "closed forms of stick and slip, stitched to rounding (collision::Dashpot)",
        quantities: &[(
            "restitution",
            "error of the normal or the tangential restitution, whichever is larger, rms over the impacts",
        )],
        points: points.collect(),
    }
}

/// The disk just before touch, at `place` of a time step; and when to sample it.
fn engine<E: SoftEngine>(hit: Hit, step: f64, place: f64) -> (E, f64) {
    let setup = SoftDiskSetup {
        laws: hit.laws(),
        walls: vec![Wall::vibrating_floor()],
        masses: vec![mass()],
        gravity: 0.0,
        time_step: step,
        start_time: 0.0,
    };
    let gap = hit.normal_velocity * step * (0.5 + place);
    let disk = Disk {
        x: 0.0,
        y: RADIUS + gap,
        radius: RADIUS,
    };
    let at_rest = Sine {
        amplitude: 0.0,
        frequency: 1.0,
        phase: 0.0,
    };
    let rates = [hit.tangential_velocity, -hit.normal_velocity, 0.0];
    let engine = E::start(setup, &[disk], at_rest, &[rates]);
    let end = (1.6 * contact_time() / step).ceil() * step + 2.0 * step;
    (engine, end)
}

fn soft<E: SoftEngine>(hit: Hit, steps: f64) -> Point {
    let step = contact_time() / steps;
    Point::new(E::METHOD, steps, move |watch: &mut Stopwatch| {
        let (misses, steps) = misses::<E>(hit, step, watch)?;
        let errors = (0..3).map(|i| root_mean_square(&misses.iter().map(|miss| miss[i]).collect::<Vec<_>>()));
        Ok(Done::exact(errors, E::PASSES * steps as f64))
    })
}

/// Errors of e_n, e_t and exit angle of impacts at so many places in a step; steps of the first.
fn misses<E: SoftEngine>(hit: Hit, step: f64, watch: &mut Stopwatch) -> Result<(Vec<[f64; 3]>, u64), Trouble> {
    let exact = hit.exact()?;
    let fresh: Vec<_> = (0..PLACES)
        .map(|place| engine::<E>(hit, step, (place as f64 + 0.5) / PLACES as f64))
        .collect();
    let mut engines: Vec<_> = (0..REPEATS).flat_map(|_| fresh.iter().cloned()).collect();
    watch
        .measure((REPEATS * PLACES) as u32, || {
            engines.iter_mut().try_for_each(|(engine, end)| engine.advance_to(*end))
        })
        .map_err(|breakdown| refused_step(E::METHOD, breakdown))?;
    let outcomes = engines[..PLACES].iter().map(|(engine, _)| {
        let [vx, vy, spin] = engine.first_rate();
        hit.outcome(vy / hit.normal_velocity, (vx + RADIUS * spin) / hit.tangential_velocity)
    });
    let misses = outcomes
        .map(|found| std::array::from_fn(|i| found[i] - exact[i]))
        .collect();
    Ok((misses, engines[0].0.steps()))
}

/// Many impacts by an impulse law, which are too short for a clock one by one.
fn hard(method: &'static str, hit: Hit, law: impl CollisionLaw + 'static) -> Point {
    const IMPACTS: u32 = 10_000;
    Point::new(method, 1.0, move |watch: &mut Stopwatch| {
        let exact = hit.exact()?;
        let impact = hit.impact();
        let impulse = watch.measure(IMPACTS, || {
            let first = law.impulse(std::hint::black_box(&impact));
            (1..IMPACTS).fold(first, |_, _| law.impulse(std::hint::black_box(&impact)))
        });
        let normal = impulse.normal / mass() / hit.normal_velocity - 1.0;
        let tangential = 1.0 + impulse.tangential / impact.tangential_mass / hit.tangential_velocity;
        let found = hit.outcome(normal, tangential);
        Ok(Done::exact((0..3).map(|i| (found[i] - exact[i]).abs()), 1.0))
    })
}

fn stitched(hit: Hit) -> Point {
    match hit.law() {
        Ok(law) => hard("impulse, stitched", hit, law),
        Err(trouble) => refused("impulse, stitched", trouble.to_string()),
    }
}

fn tabulated(hit: Hit) -> Point {
    match hit.law() {
        Ok(law) => hard("impulse, table", hit, TabulatedDashpot::new(law, &[mass()], 0.5)),
        Err(trouble) => refused("impulse, table", trouble.to_string()),
    }
}

fn refused(method: &'static str, why: String) -> Point {
    Point::new(method, 1.0, move |_| Err(why.clone().into()))
}

/// A period of the contact \[s\], for other cases that count steps in it.
pub fn contact_period(mass: f64, stiffness: f64) -> f64 {
    TAU * (mass / stiffness).sqrt()
}

//! The wedge map with two laws that no scene has, as CSV, for P Figs 6.6 and 6.9:
//! `cargo run --release -p jostle-bench --example wedge_other_laws -- LAW MU KAPPA APERTURE SECONDS SEED TILT...`, angles in degrees.
//!
//! LAW is `rigid`, infinitely stiff tangential springs, `e_t = max(0, 1 - 3 mu (1 + e_n) |u_n / u_t|)`: sliding friction that at most
//! stops the surfaces, which is what [`Coulomb`] does. Or `recipe`, the one printed after P 4.79: full sliding (4.75)
//! wherever `|u_t / u_n| > mu / kappa`, stitching below; it can create energy (see docs of `collision::Dashpot`).
//! Normal restitution 0.9, Gamma = 2 at 80 Hz; a tenth of the time is left out at the start.

use std::f64::consts::TAU;

use jostle::collision::{CollisionLaw, Coulomb, Dashpot, Impact};
use jostle::contact::LinearDashpot;
use jostle::drive::{AtRandomPhase, RandomPhase};
use jostle::engine::Engine;
use jostle::engine::wedge::{DiskInWedge, Start, WedgeFrame, WedgeSetup};
use jostle::measure::BatchMeans;
use rand::SeedableRng;
use rand_pcg::Pcg64;

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.02;
const PEAK_VELOCITY: f64 = 2.0 * GRAVITY / (TAU * 80.0);
const RESTITUTION: f64 = 0.9;
const FIRST_BATCH: f64 = 0.01;

type Failure = Box<dyn std::error::Error>;

/// The printed recipe.
#[derive(Clone, Copy)]
struct Recipe {
    law: Dashpot,
    friction: f64,
    /// mu / kappa.
    sliding_from: f64,
}

impl CollisionLaw for Recipe {
    const ROTATES: bool = true;

    fn separation_velocity(&self, impact: &Impact) -> f64 {
        self.law.separation_velocity(impact)
    }

    fn tangential_impulse(&self, impact: &Impact, normal_impulse: f64) -> f64 {
        let slip = impact.tangential_velocity;
        if slip.abs() > self.sliding_from * impact.normal_velocity.abs() {
            return -(self.friction * normal_impulse).copysign(slip);
        }
        self.law.tangential_impulse(impact, normal_impulse)
    }
}

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [law, numbers @ ..] = words.as_slice() else {
        return Err("give LAW MU KAPPA APERTURE SECONDS SEED TILT..., such as rigid 0.1 1 120 1000 1 5 10".into());
    };
    let numbers = numbers
        .iter()
        .map(|word| word.parse::<f64>())
        .collect::<Result<Vec<_>, _>>()?;
    let [friction, kappa, aperture, seconds, seed, tilts @ ..] = numbers.as_slice() else {
        return Err("numbers are missing: MU KAPPA APERTURE SECONDS SEED TILT...".into());
    };
    println!("scaled,standard_error");
    for tilt in tilts {
        let frame = WedgeFrame::new(aperture.to_radians(), tilt.to_radians());
        match law.as_str() {
            "rigid" => run(Coulomb::new(RESTITUTION, *friction)?, frame, *seconds, *seed as u64)?,
            "recipe" => {
                let damping = LinearDashpot::damping_ratio_for(RESTITUTION);
                let recipe = Recipe {
                    law: Dashpot::of_damping_ratio(1.0, damping, 1.0, *kappa, *friction)?,
                    friction: *friction,
                    sliding_from: friction / kappa,
                };
                run(recipe, frame, *seconds, *seed as u64)?;
            }
            _ => return Err(format!("no law {law}: rigid or recipe").into()),
        }
    }
    Ok(())
}

/// Runs at one tilt and prints its row.
fn run<L: CollisionLaw>(law: L, frame: WedgeFrame, seconds: f64, seed: u64) -> Result<(), Failure> {
    let walls = AtRandomPhase::new(
        RandomPhase {
            peak_velocity: PEAK_VELOCITY,
        },
        Pcg64::seed_from_u64(seed),
    );
    let setup = WedgeSetup {
        frame,
        radius: RADIUS,
        gravity: GRAVITY,
        slow: 0.0,
    };
    let start = Start {
        time: 0.0,
        height: 1e-3,
        sideways: 0.01,
    };
    let mut disk = DiskInWedge::new(setup, law, walls, start);
    let mut turning = BatchMeans::new(0.1 * seconds, FIRST_BATCH);
    let advance = |disk: &mut DiskInWedge<_, _>, time: f64| {
        disk.advance_to(time)
            .map_err(|stop| format!("the disk does not go on: {stop:?}"))
    };
    while turning.due() <= seconds {
        let due = turning.due();
        advance(&mut disk, due)?;
        turning.record(disk.sample_at(due).angle);
    }
    advance(&mut disk, seconds)?;
    let scale = RADIUS / PEAK_VELOCITY;
    let mean = scale * turning.mean(seconds, disk.sample_at(seconds).angle);
    println!("{mean:.9e},{:.9e}", scale * turning.standard_error());
    Ok(())
}

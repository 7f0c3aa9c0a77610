//! The wedge map with infinitely stiff skins, the limit of P Fig. 6.9, as CSV:
//! `cargo run --release --example wedge_rigid_skin -- SECONDS SEED TILT...`, tilts in degrees.
//!
//! `e_t = max(0, 1 - 3 mu (1 + e_n) |u_n / u_t|)` with mu = 0.1, e_n = 0.9 and an aperture of 120 degrees: sliding
//! friction that at most stops the surfaces, which is what [`Coulomb`] does. Gamma = 2 at 80 Hz. A tenth of the time is
//! left out at the start.

use std::f64::consts::TAU;

use jostle::collision::Coulomb;
use jostle::drive::RandomPhase;
use jostle::engine::wedge::{DiskInWedge, Frame, Resting, Setup};
use jostle::measure::BatchMeans;
use rand::SeedableRng;
use rand_pcg::Pcg64;

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.02;
const PEAK_VELOCITY: f64 = 2.0 * GRAVITY / (TAU * 80.0);
const FIRST_BATCH: f64 = 0.01;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = std::env::args()
        .skip(1)
        .map(|text| text.parse::<f64>())
        .collect::<Result<Vec<_>, _>>()?;
    let [seconds, seed, tilts @ ..] = arguments.as_slice() else {
        return Err("give SECONDS SEED TILT..., such as 1000 1 5 10 15".into());
    };
    println!("tilt,scaled,standard_error");
    for tilt in tilts {
        let setup = Setup {
            frame: Frame::new(TAU / 3.0, tilt.to_radians()),
            radius: RADIUS,
            gravity: GRAVITY,
            slow: 0.0,
        };
        let walls = Resting {
            phase: RandomPhase {
                peak_velocity: PEAK_VELOCITY,
            },
            generator: Pcg64::seed_from_u64(*seed as u64),
        };
        let law = Coulomb::new(0.9, 0.1)?;
        let mut disk = DiskInWedge::new(setup, law, walls, 0.0, 1e-3, 0.01);
        let mut turning = BatchMeans::new(0.1 * seconds, FIRST_BATCH);
        let advance = |disk: &mut DiskInWedge<_, _>, time: f64| {
            disk.advance_to(time)
                .map_err(|stuck| format!("the disk does not get off the walls at t = {} s", stuck.time))
        };
        while turning.due() <= *seconds {
            let due = turning.due();
            advance(&mut disk, due)?;
            turning.record(disk.view(due).angle);
        }
        advance(&mut disk, *seconds)?;
        let scale = RADIUS / PEAK_VELOCITY;
        let mean = scale * turning.mean(*seconds, disk.view(*seconds).angle);
        println!("{tilt},{mean:.9e},{:.9e}", scale * turning.standard_error());
    }
    Ok(())
}

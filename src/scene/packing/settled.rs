//! The packing settled on its base: disks that rest on each other without friction, so that they stay where they are.
//!
//! The advancing front puts each disk on two others, which is no equilibrium of all: such a packing collapses for some tenths
//! of a second. Here it is relaxed before the start by kinetic damping: the disks move without friction, and whenever their
//! kinetic energy has passed a maximum all are stopped. What is left is an equilibrium of normal forces alone. Friction only
//! steadies it, and no spring needs to be stretched at the start.
//!
//! Source: kinetic damping is that of P. A. Cundall; see M. R. Barnes, Form-finding and analysis of prestressed nets and
//! membranes, Computers and Structures 30, 685 (1988).

use crate::contact::{ContactLaws, LinearDashpot, NormalForce, TangentialSpring};
use crate::drive::FollowsInput;
use crate::elementary::hypot;
use crate::engine::Engine;
use crate::engine::dem::verlet::{PredictorCorrector, VelocityVerlet};
use crate::engine::dem::{Breakdown, FixedGrid, SoftDiskSetup, TimeStepLimits};
use crate::engine::threads::{OneThread, Threads};
use crate::geometry::{Disk, Wall};
use crate::scene::soft_disks::refused_step;
use crate::scene::{Error, Result, Row, Values, Warning};

use super::initial_packing::{self, NAME};
use super::rows::SETTLED;

/// Time steps between two looks at the kinetic energy.
const STEPS_OF_A_LOOK: f64 = 10.0;
/// Kinetic energy over what falling by a radius would give at which the disks are at rest.
const AT_REST: f64 = 1e-11;
/// The same for hard disks, which fall through gaps of a thousandth of a radius anyway.
const HARD_AT_REST: f64 = 1e-7;
/// Time steps at most, and time steps times disks at most: some seconds of a core.
const MOST_STEPS: f64 = 1e5;
const MOST_DISK_STEPS: f64 = 1e8;

/// Row of the parameter. `usual` is its start value.
pub fn parameter<M>(usual: bool) -> Row<M> {
    let description = "1: the packing is settled on the base before the start, without friction, and moves with the base at the \
                       start; 0: each disk touches two others, at rest, and the packing collapses first";
    Row::long_parameter(SETTLED, 0..=1, i64::from(usual), description)
}

/// Whether the parameter asks for it.
pub fn is_wanted(values: &Values) -> bool {
    values.integer(SETTLED) == 1
}

/// Disks at rest, and what is doubtful about them.
pub struct Settled {
    /// The disks.
    pub disks: Vec<Disk>,
    /// They were not quite at rest when the work allowed was done.
    pub warning: Option<Warning>,
}

/// `disks` settled on a base at height zero under the normal force of `values`.
///
/// # Errors
/// Contacts that do not carry the packing.
pub fn soft<N: NormalForce, T: Threads>(threads: &T, disks: Vec<Disk>, normal: N, values: &Values) -> Result<Settled> {
    if !is_wanted(values) {
        return Ok(Settled { disks, warning: None });
    }
    let masses = initial_packing::masses(&disks, values);
    relaxed(threads, disks, masses, normal, AT_REST, values)
}

/// Gap of neighbours at the start over the sum of their radii: hard disks that touch have no next impact.
const START_GAP: f64 = 1e-3;

/// Gap of neighbours of hard disks over the sum of their radii in the packing that [`hard`] settles.
const WIDER_GAP: f64 = 3.0 * START_GAP;

/// Gap of neighbours of hard disks over the sum of their radii in the packing to start from.
pub fn gap_of_hard_disks(values: &Values) -> f64 {
    if is_wanted(values) { WIDER_GAP } else { START_GAP }
}

/// `disks` with gaps of [`gap_of_hard_disks`] settled on a base at height zero: as soft disks that are larger by the gaps, which
/// is more than they overlap.
///
/// # Errors
/// As [`soft`].
pub fn hard(disks: Vec<Disk>, values: &Values) -> Result<Settled> {
    if !is_wanted(values) {
        return Ok(Settled { disks, warning: None });
    }
    // Where hard disks rest does not depend on their density.
    let masses: Vec<f64> = disks.iter().map(|disk| disk.radius * disk.radius).collect();
    let smallest = disks.iter().map(|disk| disk.radius).fold(f64::INFINITY, f64::min);
    let lightest = masses.iter().copied().fold(f64::INFINITY, f64::min);
    let weight = values.real("gravity") * masses.iter().sum::<f64>();
    if weight == 0.0 {
        return Ok(Settled { disks, warning: None });
    }
    // No overlap is larger than the gap if a contact can carry all.
    let stiffness = weight / (START_GAP * smallest);
    let normal = LinearDashpot {
        stiffness,
        damping: 0.5 * (stiffness * lightest).sqrt(),
    };
    let scaled = |disk: &Disk, factor: f64| Disk {
        radius: factor * disk.radius,
        ..*disk
    };
    let inflated = disks.iter().map(|disk| scaled(disk, 1.0 + WIDER_GAP)).collect();
    let mut settled = relaxed(&OneThread, inflated, masses, normal, HARD_AT_REST, values)?;
    for (place, disk) in settled.disks.iter_mut().zip(&disks) {
        place.radius = disk.radius;
    }
    let walls = initial_packing::walls(values);
    if gaps_are_open(&settled.disks, &walls) {
        return Ok(settled);
    }
    let text = format!(
        "{SETTLED} = 1: the packing could not be settled without overlaps and starts as the front built it. Take fewer disks."
    );
    Ok(Settled {
        disks,
        warning: Some(Warning { topic: SETTLED, text }),
    })
}

/// Whether no disk touches another or a wall. Disks are compared with those not far below or above.
fn gaps_are_open(disks: &[Disk], walls: &[Wall]) -> bool {
    let mut by_height: Vec<&Disk> = disks.iter().collect();
    by_height.sort_by(|a, b| a.y.total_cmp(&b.y));
    let largest = disks.iter().map(|disk| disk.radius).fold(0.0, f64::max);
    let pair_is_open = |a: &Disk, b: &Disk| hypot(a.x - b.x, a.y - b.y) > a.radius + b.radius;
    by_height.iter().enumerate().all(|(index, disk)| {
        let near = by_height[index + 1..]
            .iter()
            .take_while(|other| other.y - disk.y <= disk.radius + largest);
        walls.iter().all(|wall| wall.distance(disk.centre(), 0.0) > disk.radius)
            && near.clone().all(|other| pair_is_open(disk, other))
    })
}

fn relaxed<N: NormalForce, T: Threads>(
    threads: &T,
    disks: Vec<Disk>,
    masses: Vec<f64>,
    normal: N,
    at_rest: f64,
    values: &Values,
) -> Result<Settled> {
    let gravity = values.real("gravity");
    let fall: f64 = disks
        .iter()
        .zip(&masses)
        .map(|(disk, mass)| gravity * mass * disk.radius)
        .sum();
    if fall == 0.0 {
        return Ok(Settled { disks, warning: None });
    }
    let tangential = TangentialSpring {
        stiffness: 0.0,
        friction: 0.0,
    };
    let laws = ContactLaws { normal, tangential };
    let time_step = TimeStepLimits::verlet(&laws, &masses, None).default;
    let setup = SoftDiskSetup {
        laws,
        walls: initial_packing::walls(values),
        masses,
        gravity,
        time_step,
        start_time: 0.0,
    };
    let base = FollowsInput::uniform(0.0, 0.0, 0.0);
    let mut engine = FixedGrid::<PredictorCorrector<VelocityVerlet, N, T>, _>::new(setup, &disks, base);
    engine.use_threads(threads.clone());
    let most = MOST_STEPS.min(MOST_DISK_STEPS / disks.len() as f64);
    let (mut steps, mut before, mut is_at_rest) = (0.0, 0.0, false);
    while !is_at_rest && steps < most {
        steps += STEPS_OF_A_LOOK;
        engine.advance_to(steps * time_step).map_err(too_soft)?;
        let now = engine.kinetic_energy();
        if now < before {
            is_at_rest = before < at_rest * fall;
            engine.set_motion(|disks| disks.velocity.fill(0.0));
        }
        before = if now < before { 0.0 } else { now };
    }
    let places = engine.observables().positions.iter().zip(&disks);
    let moved = |(place, disk): (&[f64; 3], &Disk)| Disk {
        x: place[0],
        y: place[1],
        ..*disk
    };
    let warning = (!is_at_rest).then(|| Warning {
        topic: SETTLED,
        text: format!(
            "{SETTLED} = 1: the packing was still moving after {steps} time steps of settling. It starts from there; run it for a while \
             on a base at rest."
        ),
    });
    Ok(Settled {
        disks: places.map(moved).collect(),
        warning,
    })
}

fn too_soft(breakdown: Breakdown) -> Error {
    let why = match refused_step(NAME, breakdown) {
        Error::Step { what, .. } => what,
        other => other.to_string(),
    };
    Error::parameter(
        SETTLED,
        1,
        format!("0 for contacts that do not carry the packing, which settles with {why}"),
        "Raise contact.normal_stiffness, or set it to 0.",
    )
}

//! The packing that the parameters describe: disks at rest in the box, their masses and walls.

use std::f64::consts::FRAC_1_SQRT_2;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::drive::HeldDisk;
use crate::elementary::powi;
use crate::geometry::{Disk, Wall};
use crate::packing::{RadiusClass, RadiusDistribution, advancing_front};
use crate::scene::{Error, Result, Unit, Values, Warning};

use super::rows;

/// Name of the scene.
pub const NAME: &str = "packing";

/// `count` disks on a base at height zero, with a gap between neighbours of `gap` times the sum of their radii.
///
/// # Errors
/// Disks that do not fit into the box.
pub fn disks(count: u32, values: &Values, gap: f64) -> Result<Vec<Disk>> {
    let (seed, perturbation) = (values.integer("seed") as u64, values.real(rows::PERTURBATION));
    // Each disk has its place and the room to be displaced in it.
    let gap = gap + perturbation;
    let radii: Vec<f64> = rows::RADII.iter().map(|name| values.real(name)).collect();
    let width = values.real("box.width");
    for (name, radius) in rows::RADII.iter().zip(&radii) {
        if 2.0 * radius * (1.0 + gap) > width {
            return Err(Error::parameter(
                *name,
                Unit::METRE.format(*radius),
                format!(
                    "at most half of box.width less gaps, {}",
                    Unit::METRE.format(0.5 * width / (1.0 + gap))
                ),
                "Take smaller disks or a wider box.",
            ));
        }
    }
    let classes = radii.iter().map(|&radius| RadiusClass { radius, parts: 1 });
    let distribution = RadiusDistribution::Classes(classes.collect());
    let radii = distribution.sample(count as usize, seed)?;
    let wider: Vec<f64> = radii.iter().map(|radius| radius * (1.0 + gap)).collect();
    let places = advancing_front(&wider, width)?;
    let mut disks: Vec<Disk> = places
        .into_iter()
        .zip(radii)
        .map(|(place, radius)| Disk { radius, ..place })
        .collect();
    if perturbation > 0.0 {
        displace(&mut disks, perturbation, seed);
    }
    Ok(disks)
}

/// Displaces each disk at random by up to `by` of its radius: evenly in the square within that distance, by arithmetic that gives
/// the same bits everywhere.
fn displace(disks: &mut [Disk], by: f64, seed: u64) {
    // Another stream than those of the radii and of the phases of a base.
    let mut generator = Pcg64::seed_from_u64(seed ^ 0xd1b5_4a32_d192_ed03);
    let mut even = || (generator.next_u64() >> 10) as f64 / (1_u64 << 53) as f64 - 1.0;
    for disk in disks {
        let farthest = by * disk.radius * FRAC_1_SQRT_2;
        disk.x += farthest * even();
        disk.y += farthest * even();
    }
}

/// Says if the seed decides nothing: neither the order of the radii nor the places nor, if `draws`, what comes later.
pub fn warning(disks: &[Disk], draws: bool, values: &Values) -> Option<Warning> {
    let equal = disks.iter().all(|disk| disk.radius == disks[0].radius);
    if draws || !equal || values.real(rows::PERTURBATION) > 0.0 {
        return None;
    }
    let perturbation = rows::PERTURBATION;
    let text = format!(
        "the seed decides nothing: all radii are equal and {perturbation} is 0, so that every seed gives the same run. For runs \
         that differ set {perturbation}, such as 1e-3."
    );
    Some(Warning { topic: "seed", text })
}

/// Says if a drive that moves `bottom` leaves no other of so many disks.
pub fn bottom_warning(bottom: &[HeldDisk], disks: usize) -> Option<Warning> {
    let text = "all disks stand on the floor and belong to the bottom row, so that nothing moves freely. Take more disks or a \
                smaller box.width.";
    (bottom.len() == disks).then(|| Warning {
        topic: "bottom",
        text: text.into(),
    })
}

/// Mass of each disk \[kg\].
pub fn masses(disks: &[Disk], values: &Values) -> Vec<f64> {
    masses_of(disks.iter().map(|disk| disk.radius), values)
}

/// Mass of each disk of these radii \[kg\].
pub fn masses_of(radii: impl Iterator<Item = f64>, values: &Values) -> Vec<f64> {
    let surface_density = values.real("disk.surface_density");
    radii
        .map(|radius| surface_density * std::f64::consts::PI * powi(radius, 2))
        .collect()
}

/// The disks that stand on a base at height zero, as a drive holds them: a settled disk overlaps with it, and one that is
/// displaced at the start may be off it by as much as that.
pub fn bottom_row(disks: &[Disk], values: &Values) -> Vec<HeldDisk> {
    let displaced = match values.integer(rows::SETTLED) {
        1 => 0.0,
        _ => values.real(rows::PERTURBATION),
    };
    let farthest = 1.0 + 1e-6 + displaced * (1.0 + FRAC_1_SQRT_2);
    let stands = |(_, disk): &(u32, &Disk)| disk.y <= farthest * disk.radius;
    let held = |(index, disk): (u32, &Disk)| HeldDisk {
        index,
        place: [disk.x, disk.y],
    };
    (0..).zip(disks).filter(stands).map(held).collect()
}

/// The vibrating bottom, then the left and the right wall of the box.
pub fn walls(values: &Values) -> Vec<Wall> {
    let half_width = 0.5 * values.real("box.width");
    let follows_base = if values.integer(rows::WALL_MOTION) == rows::WITH_BASE {
        1.0
    } else {
        0.0
    };
    let side = |wall: Wall| Wall { follows_base, ..wall };
    vec![
        Wall::vibrating_floor(),
        side(Wall::left(-half_width)),
        side(Wall::right(half_width)),
    ]
}

/// Refuses side walls that move with a floor that does not: that of the random-phase approximation.
///
/// # Errors
/// They are asked for.
pub fn check_walls_of_random_phase(values: &Values) -> Result<()> {
    if values.integer(rows::WALL_MOTION) != rows::WITH_BASE {
        return Ok(());
    }
    Err(Error::parameter(
        rows::WALL_MOTION,
        "with_base",
        "fixed with base.model random_phase, whose floor stays in place",
        "Set base.model moving, or leave the side walls fixed.",
    ))
}

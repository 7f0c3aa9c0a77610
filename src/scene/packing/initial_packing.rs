//! The packing that the parameters describe: disks at rest in the box, their masses and walls.

use crate::geometry::{Disk, Wall};
use crate::packing::{RadiusClass, RadiusDistribution, advancing_front};
use crate::scene::{Error, Result, Unit, Values};

use super::rows;

/// Name of the scene.
pub const NAME: &str = "packing";

/// `count` disks on a base at height zero, with a gap between neighbours of `gap` times the sum of their radii.
///
/// # Errors
/// Disks that do not fit into the box.
pub fn disks(count: u32, values: &Values, gap: f64) -> Result<Vec<Disk>> {
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
    let radii = distribution.sample(count as usize, values.integer("seed") as u64)?;
    let wider: Vec<f64> = radii.iter().map(|radius| radius * (1.0 + gap)).collect();
    let places = advancing_front(&wider, width)?;
    Ok(places
        .into_iter()
        .zip(radii)
        .map(|(place, radius)| Disk { radius, ..place })
        .collect())
}

/// Mass of each disk \[kg\].
pub fn masses(disks: &[Disk], values: &Values) -> Vec<f64> {
    let surface_density = values.real("disk.surface_density");
    disks
        .iter()
        .map(|disk| surface_density * std::f64::consts::PI * disk.radius.powi(2))
        .collect()
}

/// The vibrating bottom, then the left and the right wall of the box.
pub fn walls(values: &Values) -> Vec<Wall> {
    let half_width = 0.5 * values.real("box.width");
    vec![
        Wall::vibrating_floor(),
        Wall::left(-half_width),
        Wall::right(half_width),
    ]
}

//! Start of a ratchet: parameters in, loose rows of disks above the base and their masses out.

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::elementary::powi;
use crate::engine::event_driven::{PeriodicAcross, Region};
use crate::error::{Error, Result};
use crate::geometry::{Disk, SawtoothProfile, Vector2};
use crate::packing::RadiusDistribution;
use crate::scene::{Unit, Values};

use super::parameters::EQUAL_MASS;

/// Distance of neighbours in the rows over the largest diameter.
const PITCH: f64 = 1.1;

/// Narrowest period over the largest radius.
const NARROWEST: f64 = 12.0;

/// Teeth that a disk may cover at most: every search of a first hit goes through all of them.
const MOST_TEETH_UNDER_A_DISK: f64 = 1000.0;

/// Disks above this many rows over the base belong to the topmost cells.
const REGION_ROWS: f64 = 12.0;

/// Slack of the shells over the radius, times the layer count: as the room between disks. Takes the fewest instructions
/// from n = 0.35 to 4.2 at Gamma = 5 (`cargo bench --bench ratchet`, `profile`, under callgrind).
const SLACK_OF_A_LAYER: f64 = 3.6;
const LEAST_SLACK: f64 = 0.3;
const MOST_SLACK: f64 = 4.0;

/// Width of the cell \[m\].
pub fn cell_width(values: &Values) -> f64 {
    values.integer("tooth.count") as f64 * values.real("tooth.width")
}

/// Layer count n = N / k, k disks of the smallest radius across the cell (F III; k = width / 2.1 mm).
pub fn layers(disks: usize, values: &Values) -> f64 {
    disks as f64 * 2.0 * values.real("disk.radius_min") / cell_width(values)
}

/// Radius of a shell over that of its disk: the fewer disks, the wider.
///
/// Wide shells are renewed less often and list more neighbours. Their slack is an eighth of the period less four radii at
/// most: a disk must not meet two images of another within one shell; the farther image lies half a period away or more,
/// and has to come nearer by four slacks until it touches.
pub fn shell(disks: usize, values: &Values) -> f64 {
    let widest = (cell_width(values) / values.real("disk.radius_max") - 4.0) / 8.0;
    let slack = (SLACK_OF_A_LAYER / layers(disks, values)).clamp(LEAST_SLACK, MOST_SLACK);
    1.0 + slack.min(widest)
}

/// The cell of `disks` disks over teeth of this height `top` \[m\] on a base whose farthest displacement is `farthest` \[m\].
pub fn space(values: &Values, disks: usize, top: f64, farthest: f64) -> PeriodicAcross {
    let rows = REGION_ROWS + 2.0 * layers(disks, values);
    let height = top + farthest + rows * values.real("disk.radius_max");
    PeriodicAcross(Region {
        corner: Vector2::new(0.0, -farthest),
        size: Vector2::new(cell_width(values), height),
    })
}

/// Ceiling less the height `top` of the teeth and the widest disk \[m\]: farther up the base would crush it.
///
/// # Errors
/// A base that moves as far as that.
pub fn headroom(values: &Values, top: f64, farthest: f64) -> Result<f64> {
    let ceiling = values.real("cell.height");
    let headroom = ceiling - top - 2.0 * values.real("disk.radius_max");
    if farthest >= headroom {
        return Err(Error::parameter(
            "cell.height",
            Unit::METRE.format(ceiling),
            format!(
                "more than {}, above the base at its highest and a disk",
                Unit::METRE.format(ceiling - headroom + farthest)
            ),
            "Raise the ceiling or move the base less.",
        ));
    }
    Ok(headroom)
}

/// The teeth that the parameters describe.
///
/// # Errors
/// A shape that does not exist, by name.
pub fn profile(values: &Values) -> Result<SawtoothProfile> {
    SawtoothProfile::new(
        values.real("tooth.width"),
        values.real("tooth.height"),
        values.real("tooth.asymmetry"),
        values.real("tooth.tip_radius"),
    )
}

/// Disks in loose rows above a base whose highest point is at `top` \[m\].
///
/// # Errors
/// Radii, a period or a ceiling that leave no place, by name.
pub fn disks(count: usize, values: &Values, top: f64) -> Result<Vec<Disk>> {
    let (min, max) = (values.real("disk.radius_min"), values.real("disk.radius_max"));
    if min > max {
        return Err(Error::parameter(
            "disk.radius_min",
            Unit::METRE.format(min),
            format!("at most disk.radius_max = {}", Unit::METRE.format(max)),
            "Swap the two or raise disk.radius_max.",
        ));
    }
    let tooth = values.real("tooth.width");
    if 2.0 * max > MOST_TEETH_UNDER_A_DISK * tooth {
        return Err(Error::parameter(
            "tooth.width",
            Unit::METRE.format(tooth),
            format!(
                "at least {}: a disk of disk.radius_max covers {MOST_TEETH_UNDER_A_DISK} teeth at most",
                Unit::METRE.format(2.0 * max / MOST_TEETH_UNDER_A_DISK)
            ),
            "Take wider teeth or smaller disks.",
        ));
    }
    let width = cell_width(values);
    if width < NARROWEST * max {
        return Err(Error::parameter(
            "tooth.count",
            values.integer("tooth.count"),
            format!("at least {}: the cell is {NARROWEST} radii wide or more", {
                Unit::ONE.format((NARROWEST * max / values.real("tooth.width")).ceil())
            }),
            "Add teeth or take smaller disks.",
        ));
    }
    let seed = values.integer("seed") as u64;
    let radii = RadiusDistribution::Uniform { min, max }.sample(count, seed)?;
    let pitch = 2.0 * PITCH * max;
    let across = (width / pitch) as usize;
    let highest = top + pitch * count.div_ceil(across) as f64;
    let ceiling = values.real("cell.height");
    if highest > ceiling {
        return Err(Error::parameter(
            "cell.height",
            Unit::METRE.format(ceiling),
            format!("at least {} for the rows at the start", Unit::METRE.format(highest)),
            "Raise the ceiling, add teeth or take fewer disks.",
        ));
    }
    // Another stream than that of the radii, which has the seed itself.
    let mut generator = Pcg64::seed_from_u64(seed ^ 0x9e37_79b9_7f4a_7c15);
    let mut unit = || (generator.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let spacing = width / across as f64;
    let place = |(index, radius): (usize, f64)| Disk {
        x: spacing * ((index % across) as f64 + 0.5) + (unit() - 0.5) * (spacing - 2.0 * max),
        y: top + pitch * ((index / across) as f64 + 0.5),
        radius,
    };
    Ok(radii.into_iter().enumerate().map(place).collect())
}

/// Masses \[kg\] by the rule of the parameters.
pub fn masses(disks: &[Disk], values: &Values) -> Vec<f64> {
    let mass = values.real("disk.mass");
    if values.integer("disk.mass_rule") == EQUAL_MASS {
        return vec![mass; disks.len()];
    }
    let mean = 0.5 * (values.real("disk.radius_min") + values.real("disk.radius_max"));
    disks.iter().map(|disk| mass * powi(disk.radius / mean, 2)).collect()
}

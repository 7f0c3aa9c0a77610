//! Disks as the passes over the contacts see them: what two contacts need of a disk lies together, in lanes.

use crate::engine::dem::two_lanes::{F64x2, xy};
use crate::geometry::Wall;

use super::kinematics::RelativeArcs;
use super::state::Kinematics;

/// (x, y), (their rates), (radius times angle, its rate) of a disk.
pub type DiskRecord = [F64x2; 3];

/// Sums of contact forces on a disk: (first moment about the end of the step), (impulse), (moment and impulse of the tangential
/// forces, which turn the disk).
pub type ImpulseSums = [F64x2; 3];

/// What makes a record at the end of a step of the sums: inverse masses of the three parts.
///
/// The moment of inertia is m R^2 / 2, so that the mass that resists arcs is m / 2.
#[inline]
pub fn inverse_masses_of_record([inverse_mass, _, _]: [f64; 3]) -> ImpulseSums {
    [inverse_mass, inverse_mass, 2.0 * inverse_mass].map(F64x2::splat)
}

/// Record of a disk after a step of length `step` \[s\] of free flight.
#[inline(always)]
pub fn free_flight(
    [position, velocity]: [&[f64; 3]; 2],
    remainders: &[[f64; 3]; 2],
    radius: f64,
    gravity: f64,
    step: f64,
) -> DiskRecord {
    let down = F64x2::new([0.0, step * gravity]);
    let speed = xy(velocity);
    let moved = speed * step - down * (0.5 * step) + xy(&remainders[0]);
    let rate = radius * velocity[2];
    [
        xy(position) + moved,
        speed + (xy(&remainders[1]) - down),
        F64x2::new([radius * (position[2] + remainders[0][2]) + step * rate, rate]),
    ]
}

/// Relative motion of two disks of which the radii have the sum `radius_sum` \[m\]; lambda counts beta from the direction of the
/// normal.
#[inline(always)]
pub fn of_pair(disks: &[DiskRecord], [i, j]: [usize; 2], radius_sum: f64) -> Kinematics {
    let (a, b) = (&disks[i], &disks[j]);
    let difference = |part: usize| (a[part] - b[part]).to_array();
    let [arc, rate] = (a[2] + b[2]).to_array();
    Kinematics::of_pair(difference(0), difference(1), radius_sum, RelativeArcs { arc, rate })
}

/// Relative motion of a disk of this radius \[m\] and a wall on a base with this displacement \[m\] and velocity \[m/s\].
#[inline(always)]
pub fn of_wall(disk: &DiskRecord, radius: f64, wall: &Wall, base: [f64; 2]) -> Kinematics {
    let [arc, rate] = disk[2].to_array();
    Kinematics::of_wall(
        disk[0].to_array(),
        disk[1].to_array(),
        radius,
        wall,
        base,
        RelativeArcs { arc, rate },
    )
}

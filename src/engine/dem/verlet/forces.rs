//! Contact forces of all candidate pairs: the inner loop.

use crate::contact::NormalForce;
use crate::drive::Motion;
use crate::engine::dem::lanes::{F64x2, per_lane, transpose, xy};
use crate::geometry::Wall;

use super::contact_laws::{Approach, ContactForces, LaneLaws, LaneSums, Sliding, Surfaces};
use super::contacts::{Pair, SpringMemory, WallContact};

/// Disks as the forces see them. All of one length.
#[derive(Clone, Copy)]
pub struct DiskArrays<'a> {
    /// x, y and angle.
    positions: &'a [[f64; 3]],
    velocities: &'a [[f64; 3]],
    radii: &'a [f64],
    /// Arc by which each surface has turned \[m\]: radius times angle. Only with tangential springs.
    arc_lengths: &'a [f64],
}

impl<'a> DiskArrays<'a> {
    /// The first positions, velocities and arcs, as many as there are radii.
    pub fn new(
        positions: &'a [[f64; 3]],
        velocities: &'a [[f64; 3]],
        radii: &'a [f64],
        arc_lengths: &'a [f64],
    ) -> Self {
        // One length for all, so that one check of an index serves all four.
        let count = radii.len();
        Self {
            positions: &positions[..count],
            velocities: &velocities[..count],
            radii,
            arc_lengths: &arc_lengths[..count],
        }
    }
}

/// Where forces are summed.
pub struct ForceArrays<'a> {
    /// x, y and torque over radius of each disk \[N\].
    pub on_disks: &'a mut [[f64; 3]],
    /// x and y by each wall \[N\].
    pub from_walls: &'a mut [[f64; 2]],
}

/// Pairs of contacts of which the geometry is computed before their forces: the roots and quotients of several proceed at
/// once, where those of one would be waited for.
const BLOCK: usize = 8;

/// Adds the forces between disks.
///
/// The tangential force on the centres is `tau (R_a + R_b) / r` while the torques have the arms R_a and R_b: so
/// angular momentum is kept when disks overlap, and the spring is elastic in the strict sense, force = -gradient.
#[inline(always)]
pub fn pair_forces<N: NormalForce, const SPRING: bool>(
    laws: &LaneLaws<N>,
    pairs: &mut [Pair],
    disks: DiskArrays<'_>,
    forces: &mut [[f64; 3]],
    sums: &mut LaneSums,
) {
    if pairs.is_empty() {
        return; // nothing for one disk, not even the making of what follows
    }
    // Once more, since the compiler does not see from farther away that the lengths are one.
    let disks = DiskArrays::new(disks.positions, disks.velocities, disks.radii, disks.arc_lengths);
    let forces = &mut forces[..disks.radii.len()];
    let (twos, rest) = pairs.as_chunks_mut();
    let mut geometries = [(Approach::default(), Surfaces::default()); BLOCK];
    for block in twos.chunks_mut(BLOCK) {
        for (geometry, two) in geometries.iter_mut().zip(&*block) {
            pair_geometry::<SPRING>(two, disks, geometry);
        }
        for (geometry, two) in geometries.iter().zip(block) {
            add_pair_forces::<N, SPRING>(laws, two, geometry, disks, forces, sums);
        }
    }
    if let [last] = rest {
        // A second pair that cannot touch fills the place.
        let mut two = [*last; 2];
        (two[1].radius_sum, two[1].spring) = (0.0, SpringMemory::OPEN);
        pair_geometry::<SPRING>(&two, disks, &mut geometries[0]);
        add_pair_forces::<N, SPRING>(laws, &mut two, &geometries[0], disks, forces, sums);
        *last = two[0];
    }
}

/// How the disks of two pairs lie and move.
#[inline(always)]
fn pair_geometry<const SPRING: bool>(
    pairs: &[Pair; 2],
    disks: DiskArrays<'_>,
    (approach, surfaces): &mut (Approach, Surfaces),
) {
    let DiskArrays {
        positions,
        velocities,
        arc_lengths,
        ..
    } = disks;
    let first = [pairs[0].first as usize, pairs[1].first as usize];
    let second = [pairs[0].second as usize, pairs[1].second as usize];
    let difference = |of: &[[f64; 3]]| transpose([0, 1].map(|k| xy(&of[first[k]]) - xy(&of[second[k]])));
    let radius_sum = per_lane(|k| pairs[k].radius_sum);
    let ([dx, dy], [ux, uy]) = (difference(positions), difference(velocities));
    let distance = (dx * dx + dy * dy).sqrt();
    let inverse = 1.0 / distance;
    let (nx, ny) = (dx * inverse, dy * inverse);
    *approach = Approach {
        normal: [nx, ny],
        overlap: radius_sum - distance,
        velocity: ux * nx + uy * ny,
    };
    if SPRING {
        *surfaces = Surfaces {
            tangential_displacement: per_lane(|k| arc_lengths[first[k]]) + per_lane(|k| arc_lengths[second[k]]),
            radius_sum,
            lever: radius_sum * inverse,
        };
    }
}

/// The surfaces of two pairs.
struct PairSurfaces<'a> {
    disks: DiskArrays<'a>,
    first: [usize; 2],
    second: [usize; 2],
    normal: [F64x2; 2],
    lever: F64x2,
}

impl Sliding for PairSurfaces<'_> {
    #[inline(always)]
    fn velocity(&self) -> F64x2 {
        let DiskArrays { velocities, radii, .. } = self.disks;
        let (first, second) = (self.first, self.second);
        let difference =
            |axis: usize| per_lane(|k| velocities[first[k]][axis]) - per_lane(|k| velocities[second[k]][axis]);
        let rotation = |disk: [usize; 2]| per_lane(|k| radii[disk[k]]) * per_lane(|k| velocities[disk[k]][2]);
        let [nx, ny] = self.normal;
        (difference(0) * ny - difference(1) * nx) * self.lever + (rotation(first) + rotation(second))
    }
}

/// Adds the forces of two pairs.
#[inline(always)]
fn add_pair_forces<N: NormalForce, const SPRING: bool>(
    laws: &LaneLaws<N>,
    pairs: &mut [Pair; 2],
    (approach, surfaces): &(Approach, Surfaces),
    disks: DiskArrays<'_>,
    forces: &mut [[f64; 3]],
    sums: &mut LaneSums,
) {
    let first = [pairs[0].first as usize, pairs[1].first as usize];
    let second = [pairs[0].second as usize, pairs[1].second as usize];
    let [nx, ny] = approach.normal;
    let sliding = PairSurfaces {
        disks,
        first,
        second,
        normal: [nx, ny],
        lever: surfaces.lever,
    };
    let [one, other] = pairs;
    let springs = [&mut one.spring, &mut other.spring];
    let ContactForces { normal, tangential } = laws.forces::<SPRING>(approach, surfaces, springs, sums, sliding);

    let (mut fx, mut fy) = (normal * nx, normal * ny);
    if SPRING {
        let sideways = tangential * surfaces.lever;
        fx += sideways * ny;
        fy -= sideways * nx;
    }
    let (fx, fy) = (fx.to_array(), fy.to_array());
    for k in 0..2 {
        let force = &mut forces[first[k]];
        force[0] += fx[k];
        force[1] += fy[k];
        let force = &mut forces[second[k]];
        force[0] -= fx[k];
        force[1] -= fy[k];
    }
    if SPRING {
        let tangential = tangential.to_array();
        for k in 0..2 {
            forces[first[k]][2] += tangential[k];
            forces[second[k]][2] += tangential[k];
        }
    }
}

/// The walls and the base that carries some of them.
#[derive(Clone, Copy)]
pub struct MovingWalls<'a> {
    /// Walls.
    pub walls: &'a [Wall],
    /// Motion of the base.
    pub base: Motion,
}

/// Adds the forces between disks and walls.
#[inline(always)]
pub fn wall_forces<N: NormalForce, const SPRING: bool>(
    laws: &LaneLaws<N>,
    contacts: &mut [WallContact],
    walls: MovingWalls<'_>,
    disks: DiskArrays<'_>,
    forces: &mut ForceArrays<'_>,
    sums: &mut LaneSums,
) {
    let forces = &mut ForceArrays {
        on_disks: &mut forces.on_disks[..disks.radii.len()],
        from_walls: forces.from_walls,
    };
    let (twos, rest) = contacts.as_chunks_mut();
    for two in twos {
        two_wall_contacts::<N, SPRING>(laws, two, walls, disks, forces, [0.0; 2], sums);
    }
    if let [last] = rest {
        let mut two = [*last; 2];
        two[1].spring = SpringMemory::OPEN;
        two_wall_contacts::<N, SPRING>(laws, &mut two, walls, disks, forces, [0.0, f64::INFINITY], sums);
        *last = two[0];
    }
}

/// The surfaces of two disks at walls: velocities of the centres, and of the surfaces round them \[m/s\].
struct WallSurfaces {
    tangent: [F64x2; 2],
    velocity: [F64x2; 2],
    rotation: F64x2,
}

impl Sliding for WallSurfaces {
    #[inline(always)]
    fn velocity(&self) -> F64x2 {
        let ([tx, ty], [vx, vy]) = (self.tangent, self.velocity);
        tx * vx + ty * vy + self.rotation
    }
}

/// `aside` \[m\] moves each disk away from its wall: a second contact that is not there is infinitely far.
#[inline(always)]
fn two_wall_contacts<N: NormalForce, const SPRING: bool>(
    laws: &LaneLaws<N>,
    contacts: &mut [WallContact; 2],
    MovingWalls { walls, base }: MovingWalls<'_>,
    disks: DiskArrays<'_>,
    forces: &mut ForceArrays<'_>,
    aside: [f64; 2],
    sums: &mut LaneSums,
) {
    let disk = [contacts[0].disk as usize, contacts[1].disk as usize];
    let wall = [contacts[0].wall as usize, contacts[1].wall as usize];
    let position = |axis: usize| per_lane(|k| disks.positions[disk[k]][axis]);
    let velocity = |axis: usize| per_lane(|k| disks.velocities[disk[k]][axis]);
    let radius = per_lane(|k| disks.radii[disk[k]]);
    let (nx, ny) = (
        per_lane(|k| walls[wall[k]].normal[0]),
        per_lane(|k| walls[wall[k]].normal[1]),
    );
    let (tx, ty) = (ny, -nx);
    let follows = per_lane(|k| walls[wall[k]].follows_base);
    let (x, y) = (position(0), position(1) - follows * base.displacement);
    let (vx, vy) = (velocity(0), velocity(1) - follows * base.velocity);
    let distance = nx * x + ny * y - per_lane(|k| walls[wall[k]].offset);
    let approach = Approach {
        normal: [nx, ny],
        overlap: radius - distance - F64x2::new(aside),
        velocity: nx * vx + ny * vy,
    };
    let surfaces = Surfaces {
        tangential_displacement: per_lane(|k| disks.arc_lengths[disk[k]]) + tx * x + ty * y,
        radius_sum: F64x2::splat(0.0),
        lever: F64x2::splat(1.0),
    };
    let sliding = WallSurfaces {
        tangent: [tx, ty],
        velocity: [vx, vy],
        rotation: radius * velocity(2),
    };
    let [one, other] = contacts;
    let springs = [&mut one.spring, &mut other.spring];
    let ContactForces { normal, tangential } = laws.forces::<SPRING>(&approach, &surfaces, springs, sums, sliding);

    let fx = (normal * nx + tangential * tx).to_array();
    let fy = (normal * ny + tangential * ty).to_array();
    let tangential = tangential.to_array();
    for k in 0..2 {
        let force = &mut forces.on_disks[disk[k]];
        force[0] += fx[k];
        force[1] += fy[k];
        if SPRING {
            force[2] += tangential[k];
        }
        let force = &mut forces.from_walls[wall[k]];
        force[0] += fx[k];
        force[1] += fy[k];
    }
}

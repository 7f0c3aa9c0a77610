//! What distinguishes contacts among disks and contacts with walls: how bodies lie and move, and on which a force acts.

use fearless_simd::{Simd, SimdBase, f64x2};

use crate::drive::Motion;
use crate::engine::dem::lanes::{Lanes, MOST_LANES, xy};
use crate::geometry::Wall;

use super::eights::Eight;

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

    /// The same, where the compiler has lost sight of the one length.
    #[inline(always)]
    pub fn again(self) -> Self {
        Self::new(self.positions, self.velocities, self.radii, self.arc_lengths)
    }

    /// Disks.
    pub fn count(&self) -> usize {
        self.radii.len()
    }
}

/// Where forces are summed.
pub struct ForceArrays<'a> {
    /// x, y and torque over radius of each disk \[N\].
    pub on_disks: &'a mut [[f64; 3]],
    /// x and y by each wall \[N\].
    pub from_walls: &'a mut [[f64; 2]],
}

/// The walls and the base that carries some of them.
#[derive(Clone, Copy)]
pub struct MovingWalls<'a> {
    /// Walls.
    pub walls: &'a [Wall],
    /// Motion of the base.
    pub base: Motion,
}

/// How eight pairs of bodies lie and move.
#[derive(Debug, Clone, Copy, Default)]
#[repr(C, align(64))]
pub struct Geometry {
    /// Towards the first body, x.
    pub normal_x: [f64; MOST_LANES],
    /// And y.
    pub normal_y: [f64; MOST_LANES],
    /// delta \[m\].
    pub overlap: [f64; MOST_LANES],
    /// u_n \[m/s\].
    pub velocity: [f64; MOST_LANES],
    /// lambda \[m\] with beta counted from zero.
    pub tangential_displacement: [f64; MOST_LANES],
    /// Force on the centres over that on the surfaces.
    pub lever: [f64; MOST_LANES],
}

/// What distinguishes contacts among disks and contacts with walls.
pub trait Kind: Copy {
    /// Computes how bodies lie and move, from the place `at` on as many as a register holds.
    fn geometry<S: Simd, V: Lanes<S>, const SPRING: bool>(self, simd: S, eight: &Eight, at: usize, into: &mut Geometry);

    /// Lever of the angle of the normal in lambda: the sum of the radii, or 0.
    fn radius_sum<S: Simd, V: Lanes<S>>(simd: S, eight: &Eight, at: usize) -> V;

    /// u_t \[m/s\] of two bodies with this normal and lever.
    fn sliding(self, bodies: [u32; 2], normal: [f64; 2], lever: f64) -> f64;

    /// Adds the force on the first body, and the opposite one, with its part along the surfaces.
    fn add<S: Simd, const SPRING: bool>(
        simd: S,
        bodies: [u32; 2],
        force: [f64; 2],
        tangential: f64,
        forces: &mut ForceArrays<'_>,
    );
}

/// Contacts among disks.
///
/// The tangential force on the centres is `tau (R_a + R_b) / r` while the torques have the arms R_a and R_b: so
/// angular momentum is kept when disks overlap, and the spring is elastic in the strict sense, force = -gradient.
#[derive(Clone, Copy)]
pub struct BetweenDisks<'a> {
    /// Disks.
    pub disks: DiskArrays<'a>,
}

impl Kind for BetweenDisks<'_> {
    #[inline(always)]
    fn geometry<S: Simd, V: Lanes<S>, const SPRING: bool>(
        self,
        simd: S,
        eight: &Eight,
        at: usize,
        into: &mut Geometry,
    ) {
        let DiskArrays {
            positions,
            velocities,
            arc_lengths,
            ..
        } = self.disks;
        let here = at..at + V::LEN;
        let nothing = f64x2::splat(simd, 0.0);
        let (mut apart, mut relative) = ([nothing; MOST_LANES], [nothing; MOST_LANES]);
        let mut turned = [0.0; MOST_LANES];
        for (k, bodies) in eight.bodies[here.clone()].iter().enumerate() {
            let [first, second] = bodies.map(|index| index as usize);
            apart[k] = xy(simd, &positions[first]) - xy(simd, &positions[second]);
            relative[k] = xy(simd, &velocities[first]) - xy(simd, &velocities[second]);
            if SPRING {
                turned[k] = arc_lengths[first] + arc_lengths[second];
            }
        }
        let ([dx, dy], [ux, uy]): ([V; 2], [V; 2]) = (V::columns(&apart), V::columns(&relative));
        let radius_sum = V::from_slice(simd, &eight.length[here.clone()]);
        let distance = (dx * dx + dy * dy).sqrt();
        let inverse = V::splat(simd, 1.0) / distance;
        let (nx, ny) = (dx * inverse, dy * inverse);
        nx.store_slice(&mut into.normal_x[here.clone()]);
        ny.store_slice(&mut into.normal_y[here.clone()]);
        (radius_sum - distance).store_slice(&mut into.overlap[here.clone()]);
        (ux * nx + uy * ny).store_slice(&mut into.velocity[here.clone()]);
        if SPRING {
            V::from_fn(simd, |k| turned[k]).store_slice(&mut into.tangential_displacement[here.clone()]);
            (radius_sum * inverse).store_slice(&mut into.lever[here]);
        }
    }

    #[inline(always)]
    fn radius_sum<S: Simd, V: Lanes<S>>(simd: S, eight: &Eight, at: usize) -> V {
        V::from_slice(simd, &eight.length[at..at + V::LEN])
    }

    fn sliding(self, bodies: [u32; 2], [nx, ny]: [f64; 2], lever: f64) -> f64 {
        let DiskArrays { velocities, radii, .. } = self.disks;
        let [first, second] = bodies.map(|index| index as usize);
        let ([ax, ay, spin_a], [bx, by, spin_b]) = (velocities[first], velocities[second]);
        ((ax - bx) * ny - (ay - by) * nx) * lever + (radii[first] * spin_a + radii[second] * spin_b)
    }

    #[inline(always)]
    fn add<S: Simd, const SPRING: bool>(
        simd: S,
        [first, second]: [u32; 2],
        force: [f64; 2],
        tangential: f64,
        forces: &mut ForceArrays<'_>,
    ) {
        let force = f64x2::load_array(simd, force);
        let on_first = &mut forces.on_disks[first as usize];
        [on_first[0], on_first[1]] = (xy(simd, on_first) + force).to_array();
        if SPRING {
            on_first[2] += tangential;
        }
        let on_second = &mut forces.on_disks[second as usize];
        [on_second[0], on_second[1]] = (xy(simd, on_second) - force).to_array();
        if SPRING {
            on_second[2] += tangential;
        }
    }
}

/// Contacts of disks with walls.
#[derive(Clone, Copy)]
pub struct AtWalls<'a> {
    /// Disks.
    pub disks: DiskArrays<'a>,
    /// Walls.
    pub walls: MovingWalls<'a>,
}

impl Kind for AtWalls<'_> {
    #[inline(always)]
    fn geometry<S: Simd, V: Lanes<S>, const SPRING: bool>(
        self,
        simd: S,
        eight: &Eight,
        at: usize,
        into: &mut Geometry,
    ) {
        let (disks, MovingWalls { walls, base }) = (self.disks, self.walls);
        let here = at..at + V::LEN;
        let mut vectors = [[f64x2::splat(simd, 0.0); MOST_LANES]; 5];
        for (k, [disk, wall]) in eight.bodies[here.clone()].iter().enumerate() {
            let (disk, wall) = (*disk as usize, &walls[*wall as usize]);
            vectors[0][k] = xy(simd, &disks.positions[disk]);
            vectors[1][k] = xy(simd, &disks.velocities[disk]);
            vectors[2][k] = f64x2::load_array(simd, [disks.radii[disk], disks.arc_lengths[disk]]);
            vectors[3][k] = f64x2::load_array(simd, [wall.normal[0], wall.normal[1]]);
            vectors[4][k] = f64x2::load_array(simd, [wall.offset, wall.follows_base]);
        }
        let ([x, y], [vx, vy]): ([V; 2], [V; 2]) = (V::columns(&vectors[0]), V::columns(&vectors[1]));
        let ([radius, arc_length], [nx, ny]) = (V::columns(&vectors[2]), V::columns(&vectors[3]));
        let [offset, follows] = V::columns(&vectors[4]);
        let (y, vy) = (y - follows * base.displacement, vy - follows * base.velocity);
        let distance = nx * x + ny * y - offset;
        let aside = V::from_slice(simd, &eight.length[here.clone()]);
        nx.store_slice(&mut into.normal_x[here.clone()]);
        ny.store_slice(&mut into.normal_y[here.clone()]);
        (radius - distance - aside).store_slice(&mut into.overlap[here.clone()]);
        (nx * vx + ny * vy).store_slice(&mut into.velocity[here.clone()]);
        if SPRING {
            // The tangent is (n_y, -n_x).
            (arc_length + ny * x - nx * y).store_slice(&mut into.tangential_displacement[here.clone()]);
            V::splat(simd, 1.0).store_slice(&mut into.lever[here]);
        }
    }

    #[inline(always)]
    fn radius_sum<S: Simd, V: Lanes<S>>(simd: S, _eight: &Eight, _at: usize) -> V {
        V::splat(simd, 0.0)
    }

    fn sliding(self, [disk, wall]: [u32; 2], [nx, ny]: [f64; 2], _lever: f64) -> f64 {
        let DiskArrays { velocities, radii, .. } = self.disks;
        let (disk, MovingWalls { walls, base }) = (disk as usize, self.walls);
        let [vx, vy, spin] = velocities[disk];
        let vy = vy - walls[wall as usize].follows_base * base.velocity;
        ny * vx - nx * vy + radii[disk] * spin
    }

    #[inline(always)]
    fn add<S: Simd, const SPRING: bool>(
        simd: S,
        [disk, wall]: [u32; 2],
        force: [f64; 2],
        tangential: f64,
        forces: &mut ForceArrays<'_>,
    ) {
        let on_disk = &mut forces.on_disks[disk as usize];
        [on_disk[0], on_disk[1]] = (xy(simd, on_disk) + f64x2::load_array(simd, force)).to_array();
        if SPRING {
            on_disk[2] += tangential;
        }
        let from_wall = &mut forces.from_walls[wall as usize];
        *from_wall = [from_wall[0] + force[0], from_wall[1] + force[1]];
    }
}

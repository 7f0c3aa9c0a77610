//! Contact forces of all candidate pairs: the inner loop.

use crate::contact::{ElasticSkin, LinearDashpot};
use crate::drive::Motion;
use crate::geometry::Wall;

use super::contacts::{AtWall, Pair, SkinMemory};
use super::two_contacts::{Approach, Laws, Sliding, Sums, Surfaces, Two, turned, two, vector};

/// Contact laws of every contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactLaws {
    /// Normal force.
    pub normal: LinearDashpot,
    /// Tangential force.
    pub skin: ElasticSkin,
}

/// Sums over the contacts of one evaluation.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
    /// Power lost in the dashpots \[W\].
    pub dissipated_power: f64,
    /// Energy lost by slip since the last evaluation \[J\].
    pub slip_heat: f64,
    /// Deepest overlap \[m\].
    pub deepest: f64,
    /// Closed contacts.
    pub contacts: u32,
}

/// Bodies as the forces see them. All of one length.
#[derive(Clone, Copy)]
pub struct Bodies<'a> {
    /// x, y and angle.
    places: &'a [[f64; 3]],
    rates: &'a [[f64; 3]],
    radii: &'a [f64],
    /// How far each surface has turned \[m\]: radius times angle. Only with skins.
    rims: &'a [f64],
}

impl<'a> Bodies<'a> {
    /// The first so many places, rates and rims as there are radii.
    pub fn new(places: &'a [[f64; 3]], rates: &'a [[f64; 3]], radii: &'a [f64], rims: &'a [f64]) -> Self {
        // One length for all, so that one check of an index serves all four.
        let count = radii.len();
        Self {
            places: &places[..count],
            rates: &rates[..count],
            radii,
            rims: &rims[..count],
        }
    }
}

/// Adds the forces between disks to `forces`: x, y and torque over radius of each.
///
/// The tangential force on the centres is `tau (R_a + R_b) / r` while the torques have the arms R_a and R_b: so
/// angular momentum is kept when disks overlap, and the skin is elastic in the strict sense, force = -gradient.
#[inline(always)]
pub fn between_disks<const SKIN: bool>(
    laws: &Laws,
    pairs: &mut [Pair],
    bodies: Bodies<'_>,
    forces: &mut [[f64; 3]],
    sums: &mut Sums,
) {
    if pairs.is_empty() {
        return; // nothing for one disk, not even the making of what follows
    }
    // Once more, since the lengths are not seen to be one from farther away.
    let bodies = Bodies::new(bodies.places, bodies.rates, bodies.radii, bodies.rims);
    let forces = &mut forces[..bodies.radii.len()];
    let (twos, rest) = pairs.as_chunks_mut();
    let mut looks = [(Approach::default(), Surfaces::default()); BLOCK];
    for block in twos.chunks_mut(BLOCK) {
        for (look, two) in looks.iter_mut().zip(&*block) {
            look_at::<SKIN>(two, bodies, look);
        }
        for (look, two) in looks.iter().zip(block) {
            push::<SKIN>(laws, two, look, bodies, forces, sums);
        }
    }
    if let [last] = rest {
        // A second pair that cannot touch fills the place.
        let mut two = [*last; 2];
        (two[1].reach, two[1].skin) = (0.0, SkinMemory::OPEN);
        look_at::<SKIN>(&two, bodies, &mut looks[0]);
        push::<SKIN>(laws, &mut two, &looks[0], bodies, forces, sums);
        *last = two[0];
    }
}

/// Twos of pairs that are looked at before their forces are worked out: the roots and quotients of several go on at once,
/// where those of one would be waited for.
const BLOCK: usize = 8;

/// How the disks of two pairs lie and move.
#[inline(always)]
fn look_at<const SKIN: bool>(pairs: &[Pair; 2], bodies: Bodies<'_>, (approach, surfaces): &mut (Approach, Surfaces)) {
    let Bodies {
        places, rates, rims, ..
    } = bodies;
    let first = [pairs[0].first as usize, pairs[1].first as usize];
    let second = [pairs[0].second as usize, pairs[1].second as usize];
    let apart = |of: &[[f64; 3]]| turned([0, 1].map(|k| vector(&of[first[k]]) - vector(&of[second[k]])));
    let reach = two(|k| pairs[k].reach);
    let ([dx, dy], [ux, uy]) = (apart(places), apart(rates));
    let distance = (dx * dx + dy * dy).sqrt();
    let inverse = 1.0 / distance;
    let (nx, ny) = (dx * inverse, dy * inverse);
    *approach = Approach {
        normal: [nx, ny],
        overlap: reach - distance,
        velocity: ux * nx + uy * ny,
    };
    if SKIN {
        *surfaces = Surfaces {
            way: two(|k| rims[first[k]]) + two(|k| rims[second[k]]),
            reach,
            lever: reach * inverse,
        };
    }
}

/// The surfaces of two pairs.
struct Rubbing<'a> {
    bodies: Bodies<'a>,
    first: [usize; 2],
    second: [usize; 2],
    normal: [Two; 2],
    lever: Two,
}

impl Sliding for Rubbing<'_> {
    #[inline(always)]
    fn velocity(&self) -> Two {
        let Bodies { rates, radii, .. } = self.bodies;
        let (first, second) = (self.first, self.second);
        let apart = |axis: usize| two(|k| rates[first[k]][axis]) - two(|k| rates[second[k]][axis]);
        let around = |disk: [usize; 2]| two(|k| radii[disk[k]]) * two(|k| rates[disk[k]][2]);
        let [nx, ny] = self.normal;
        (apart(0) * ny - apart(1) * nx) * self.lever + (around(first) + around(second))
    }
}

/// Adds the forces of two pairs.
#[inline(always)]
fn push<const SKIN: bool>(
    laws: &Laws,
    pairs: &mut [Pair; 2],
    (approach, surfaces): &(Approach, Surfaces),
    bodies: Bodies<'_>,
    forces: &mut [[f64; 3]],
    sums: &mut Sums,
) {
    let first = [pairs[0].first as usize, pairs[1].first as usize];
    let second = [pairs[0].second as usize, pairs[1].second as usize];
    let [nx, ny] = approach.normal;
    let sliding = Rubbing {
        bodies,
        first,
        second,
        normal: [nx, ny],
        lever: surfaces.lever,
    };
    let [one, other] = pairs;
    let skins = [&mut one.skin, &mut other.skin];
    let (normal, tangential) = laws.act::<SKIN>(approach, surfaces, skins, sums, sliding);

    let (mut fx, mut fy) = (normal * nx, normal * ny);
    if SKIN {
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
    if SKIN {
        let along = tangential.to_array();
        for k in 0..2 {
            forces[first[k]][2] += along[k];
            forces[second[k]][2] += along[k];
        }
    }
}

/// Adds the forces of the walls to `forces`, and each wall's own sum (x, y) to `from_walls`, which lists them flat.
#[inline(always)]
pub fn at_walls<const SKIN: bool>(
    laws: &Laws,
    at_walls: &mut [AtWall],
    (walls, base): (&[Wall], Motion),
    bodies: Bodies<'_>,
    (forces, from_walls): (&mut [[f64; 3]], &mut [f64]),
    sums: &mut Sums,
) {
    let forces = &mut forces[..bodies.radii.len()];
    let (from_walls, _) = from_walls.as_chunks_mut();
    let (twos, rest) = at_walls.as_chunks_mut();
    for two in twos {
        two_at_walls::<SKIN>(
            laws,
            two,
            (walls, base),
            bodies,
            (&mut *forces, &mut *from_walls),
            [0.0; 2],
            sums,
        );
    }
    if let [last] = rest {
        let mut two = [*last; 2];
        two[1].skin = SkinMemory::OPEN;
        two_at_walls::<SKIN>(
            laws,
            &mut two,
            (walls, base),
            bodies,
            (forces, from_walls),
            [0.0, f64::INFINITY],
            sums,
        );
        *last = two[0];
    }
}

/// The surfaces of two disks at walls: velocities of the centres, and of the rims round them \[m/s\].
struct AlongWall {
    tangent: [Two; 2],
    velocity: [Two; 2],
    rim: Two,
}

impl Sliding for AlongWall {
    #[inline(always)]
    fn velocity(&self) -> Two {
        let ([tx, ty], [vx, vy]) = (self.tangent, self.velocity);
        tx * vx + ty * vy + self.rim
    }
}

/// `aside` moves each disk away from its wall: a second one that is not there is infinitely far.
#[inline(always)]
fn two_at_walls<const SKIN: bool>(
    laws: &Laws,
    near: &mut [AtWall; 2],
    (walls, base): (&[Wall], Motion),
    bodies: Bodies<'_>,
    (forces, from_walls): (&mut [[f64; 3]], &mut [[f64; 2]]),
    aside: [f64; 2],
    sums: &mut Sums,
) {
    let disk = [near[0].disk as usize, near[1].disk as usize];
    let wall = [near[0].wall as usize, near[1].wall as usize];
    let place = |axis: usize| two(|k| bodies.places[disk[k]][axis]);
    let rate = |axis: usize| two(|k| bodies.rates[disk[k]][axis]);
    let radius = two(|k| bodies.radii[disk[k]]);
    let (nx, ny) = (two(|k| walls[wall[k]].normal[0]), two(|k| walls[wall[k]].normal[1]));
    let (tx, ty) = (ny, -nx);
    let follows = two(|k| walls[wall[k]].follows_base);
    let (x, y) = (place(0), place(1) - follows * base.displacement);
    let (vx, vy) = (rate(0), rate(1) - follows * base.velocity);
    let distance = nx * x + ny * y - two(|k| walls[wall[k]].offset);
    let approach = Approach {
        normal: [nx, ny],
        overlap: radius - distance - Two::new(aside),
        velocity: nx * vx + ny * vy,
    };
    let surfaces = Surfaces {
        way: two(|k| bodies.rims[disk[k]]) + tx * x + ty * y,
        reach: Two::splat(0.0),
        lever: Two::splat(1.0),
    };
    let sliding = AlongWall {
        tangent: [tx, ty],
        velocity: [vx, vy],
        rim: radius * rate(2),
    };
    let [one, other] = near;
    let skins = [&mut one.skin, &mut other.skin];
    let (normal, tangential) = laws.act::<SKIN>(&approach, &surfaces, skins, sums, sliding);

    let fx = (normal * nx + tangential * tx).to_array();
    let fy = (normal * ny + tangential * ty).to_array();
    let along = tangential.to_array();
    for k in 0..2 {
        let force = &mut forces[disk[k]];
        force[0] += fx[k];
        force[1] += fy[k];
        if SKIN {
            force[2] += along[k];
        }
        let force = &mut from_walls[wall[k]];
        force[0] += fx[k];
        force[1] += fy[k];
    }
}

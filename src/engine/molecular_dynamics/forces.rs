//! Contact forces of all candidate pairs: the inner loop.

use crate::contact::{ElasticSkin, LinearDashpot};
use crate::drive::Motion;
use crate::geometry::Wall;

use super::contacts::{AtWall, Pair, SkinMemory};

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

/// A closed contact in its own frame: what the laws need.
struct Closed {
    overlap: f64,
    /// u_n \[m/s\], negative on approach.
    normal_velocity: f64,
    /// u_t \[m/s\] of the surfaces.
    surface_velocity: f64,
    normal: [f64; 2],
    /// lambda \[m\] with beta counted from zero (P 4.5, 4.7).
    surface: f64,
    /// Lever of beta in lambda: the sum of the radii, and 0 at a wall, whose normal does not turn.
    reach: f64,
}

impl ContactLaws {
    /// Normal force and tangential force on the first body \[N\], with the skin's memory brought up to date.
    ///
    /// A contact that closes inside the step of length `step` \[s\] has its lambda* dated back to the instant of touch.
    #[inline(always)]
    fn act(&self, contact: &Closed, skin: &mut SkinMemory, step: f64, tally: &mut Tally) -> (f64, f64) {
        let normal_force = self.normal.force(contact.overlap, contact.normal_velocity);
        if !skin.is_closed() {
            // Closed since `overlap / approach` ago, and for no longer than this step.
            let since = if -contact.normal_velocity * step > contact.overlap {
                contact.overlap / -contact.normal_velocity
            } else {
                step
            };
            skin.direction = contact.normal;
            skin.reference = contact.surface - contact.surface_velocity * since;
            skin.stretch = 0.0;
        }
        let turn = skin.turn(contact.normal, contact.reach);
        let trial = contact.surface - contact.reach * turn - skin.reference;
        let stretch = self.skin.limited(trial, normal_force);
        let slip = trial - stretch;
        // Slip heats by the mean of the forces before and after; both point against the slip.
        tally.slip_heat += 0.5 * self.skin.stiffness * (stretch + skin.stretch) * slip;
        skin.reference += slip;
        skin.stretch = stretch;
        tally.dissipated_power += self
            .normal
            .dissipated_power(contact.overlap, contact.normal_velocity, normal_force);
        tally.deepest = if contact.overlap > tally.deepest {
            contact.overlap
        } else {
            tally.deepest
        };
        tally.contacts += 1;
        (normal_force, self.skin.force(stretch))
    }

    /// Opens a contact: what the skin still held is lost.
    #[cold]
    fn open(&self, skin: &mut SkinMemory, tally: &mut Tally) {
        tally.slip_heat += self.skin.energy(skin.stretch);
        *skin = SkinMemory::OPEN;
    }

    /// Adds the forces between disks to `forces` (x, y, torque of each).
    ///
    /// The tangential force on the centres is `tau (R_a + R_b) / r` while the torques have the arms R_a and R_b: so
    /// angular momentum is kept when disks overlap, and the skin is elastic in the strict sense, force = -gradient.
    pub fn between_disks(
        &self,
        pairs: &mut [Pair],
        (places, rates, radii): (&[[f64; 3]], &[[f64; 3]], &[f64]),
        forces: &mut [[f64; 3]],
        step: f64,
        tally: &mut Tally,
    ) {
        for pair in pairs {
            let (i, j) = (pair.first as usize, pair.second as usize);
            let (a, b) = (&places[i], &places[j]);
            let (dx, dy) = (a[0] - b[0], a[1] - b[1]);
            let squared = dx * dx + dy * dy;
            if squared >= pair.reach * pair.reach {
                if pair.skin.is_closed() {
                    self.open(&mut pair.skin, tally);
                }
                continue;
            }
            let distance = squared.sqrt();
            let inverse = 1.0 / distance;
            let (nx, ny) = (dx * inverse, dy * inverse);
            let (va, vb) = (&rates[i], &rates[j]);
            let (ra, rb) = (radii[i], radii[j]);
            let (ux, uy) = (va[0] - vb[0], va[1] - vb[1]);
            let lever = pair.reach * inverse;
            let contact = Closed {
                overlap: pair.reach - distance,
                normal_velocity: ux * nx + uy * ny,
                surface_velocity: (ux * ny - uy * nx) * lever + ra * va[2] + rb * vb[2],
                normal: [nx, ny],
                surface: ra * a[2] + rb * b[2],
                reach: pair.reach,
            };
            let (normal, tangential) = self.act(&contact, &mut pair.skin, step, tally);
            let sideways = tangential * lever;
            let (fx, fy) = (normal * nx + sideways * ny, normal * ny - sideways * nx);
            let force = &mut forces[i];
            force[0] += fx;
            force[1] += fy;
            force[2] += tangential * ra;
            let force = &mut forces[j];
            force[0] -= fx;
            force[1] -= fy;
            force[2] += tangential * rb;
        }
    }

    /// Adds the forces of the walls to `forces`, and each wall's own sum (x, y) to `on_walls`, which lists them flat.
    #[allow(clippy::too_many_arguments)]
    pub fn at_walls(
        &self,
        at_walls: &mut [AtWall],
        walls: &[Wall],
        base: Motion,
        (places, rates, radii): (&[[f64; 3]], &[[f64; 3]], &[f64]),
        (forces, from_walls): (&mut [[f64; 3]], &mut [f64]),
        step: f64,
        tally: &mut Tally,
    ) {
        for near in at_walls {
            let disk = near.disk as usize;
            let index = near.wall as usize;
            let wall = &walls[index];
            let ([x, y, angle], radius) = (places[disk], radii[disk]);
            let overlap = radius - wall.distance(x, y, base.displacement);
            if overlap <= 0.0 {
                if near.skin.is_closed() {
                    self.open(&mut near.skin, tally);
                }
                continue;
            }
            let ([nx, ny], [tx, ty]) = (wall.normal, wall.tangent());
            let [vx, vy, angular_velocity] = rates[disk];
            let (lift, vy) = (
                wall.follows_base * base.displacement,
                vy - wall.follows_base * base.velocity,
            );
            let contact = Closed {
                overlap,
                normal_velocity: nx * vx + ny * vy,
                surface_velocity: tx * vx + ty * vy + radius * angular_velocity,
                normal: wall.normal,
                surface: radius * angle + tx * x + ty * (y - lift),
                reach: 0.0,
            };
            let (normal, tangential) = self.act(&contact, &mut near.skin, step, tally);
            let (fx, fy) = (normal * nx + tangential * tx, normal * ny + tangential * ty);
            let force = &mut forces[disk];
            force[0] += fx;
            force[1] += fy;
            force[2] += tangential * radius;
            from_walls[2 * index] += fx;
            from_walls[2 * index + 1] += fy;
        }
    }
}

//! The closed contacts of a state, for observers.

use crate::contact::{ContactLaws, NormalForce};
use crate::drive::Motion;
use crate::elementary::hypot;
use crate::engine::dem::SoftDisks;
use crate::engine::{ContactNow, Touched};

use super::contacts::{Pair, SpringMemory, WallContact};
use super::state::Disks;

/// Disks, walls and laws at one instant.
pub struct Closed<'a, N> {
    pub constants: &'a SoftDisks<N>,
    pub disks: &'a Disks,
    pub base: Motion,
}

impl<N: NormalForce> Closed<'_, N> {
    /// All of them, disks with disks first.
    pub fn all(&self) -> Vec<ContactNow> {
        let pairs = self.disks.pairs.iter().filter_map(|pair| self.of_pair(&pair));
        let walls = self.disks.wall_contacts.iter();
        pairs
            .chain(walls.filter_map(|contact| self.of_wall(&contact)))
            .collect()
    }

    fn of_pair(&self, pair: &Pair) -> Option<ContactNow> {
        let [first, second] = [pair.first, pair.second].map(|index| index as usize);
        let (positions, velocities) = (self.disks.positions(), self.disks.velocities());
        let (a, b) = (positions[first], positions[second]);
        let (dx, dy) = (a[0] - b[0], a[1] - b[1]);
        let distance = hypot(dx, dy);
        let overlap = pair.radius_sum - distance;
        if overlap <= 0.0 {
            return None;
        }
        let normal = [dx / distance, dy / distance];
        let [va, vb] = [velocities[first], velocities[second]];
        let velocity = (va[0] - vb[0]) * normal[0] + (va[1] - vb[1]) * normal[1];
        let inside = self.constants.radii[first] - 0.5 * overlap;
        Some(self.contact(
            pair.first,
            Touched::Disk(pair.second),
            &pair.spring,
            a,
            Approach {
                normal,
                overlap,
                velocity,
                inside,
            },
        ))
    }

    fn of_wall(&self, contact: &WallContact) -> Option<ContactNow> {
        let disk = contact.disk as usize;
        let wall = &self.constants.setup.walls[contact.wall as usize];
        let place = self.disks.positions()[disk];
        let overlap = self.constants.radii[disk] - wall.distance([place[0], place[1]], self.base.displacement);
        if overlap <= 0.0 {
            return None;
        }
        let [vx, vy, _] = self.disks.velocities()[disk];
        let velocity = wall.normal.x * vx + wall.normal.y * (vy - wall.follows_base * self.base.velocity);
        let inside = self.constants.radii[disk] - 0.5 * overlap;
        Some(self.contact(
            contact.disk,
            Touched::Wall(contact.wall),
            &contact.spring,
            place,
            Approach {
                normal: wall.normal.into(),
                overlap,
                velocity,
                inside,
            },
        ))
    }

    fn contact(
        &self,
        first: u32,
        other: Touched,
        spring: &SpringMemory,
        [x, y, _]: [f64; 3],
        approach: Approach,
    ) -> ContactNow {
        let ContactLaws { normal, tangential } = &self.constants.setup.laws;
        let Approach {
            normal: [nx, ny],
            overlap,
            velocity,
            inside,
        } = approach;
        ContactNow {
            first,
            other,
            point: [x - inside * nx, y - inside * ny],
            normal: [nx, ny],
            normal_force: normal.of_one(overlap, velocity),
            tangential_force: tangential.force(spring.stretch),
        }
    }
}

/// Two bodies that touch: normal, overlap \[m\], normal velocity \[m/s\] and how far the middle of the overlap is from the
/// centre of the first \[m\].
struct Approach {
    normal: [f64; 2],
    overlap: f64,
    velocity: f64,
    inside: f64,
}

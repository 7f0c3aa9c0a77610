//! Impacts: two bodies that touch, an impulse and its opposite, the energy lost.

use crate::collision::{CollisionLaw, Impact, Impulse, effective_mass, tangential_mass};
use crate::geometry::clockwise;

use super::{Boundary, EventDriven, EventDrivenState, Space, Spin};

impl<L: CollisionLaw, B: Boundary, S: Space> EventDriven<L, B, S> {
    /// Impact of two disks that have flown to where they touch.
    pub(super) fn collide_disks(&mut self, first: u32, second: u32) {
        let inverse_factor = self.inverse_inertia_factor;
        let EventDrivenState {
            bodies,
            spins,
            shells,
            counts,
            ..
        } = &mut self.state;
        let (i, j) = (first as usize, second as usize);
        let (a, b) = (bodies[i], bodies[j]);
        let (entry_a, entry_b) = (&shells.entries[i], &shells.entries[j]);
        let mut separation = a.position - b.position;
        if entry_a.at_edge {
            separation = self.space.nearest_image(separation);
        }
        let normal = separation * (1.0 / separation.norm_squared().sqrt());
        let velocity = a.velocity - b.velocity;
        let spin = |disk: usize| if L::ROTATES { spins[disk].angular_velocity } else { 0.0 };
        let since = |disk: usize| {
            if L::REMEMBERS {
                spins[disk].since
            } else {
                f64::NEG_INFINITY
            }
        };
        let surface = a.radius * spin(i) + b.radius * spin(j);
        let (inverse_a, inverse_b) = (entry_a.inverse_mass, entry_b.inverse_mass);
        let impact = Impact {
            effective_mass: effective_mass(inverse_a, inverse_b),
            tangential_mass: tangential_mass(
                inverse_a,
                inverse_b,
                inverse_factor * inverse_a,
                inverse_factor * inverse_b,
            ),
            normal_velocity: velocity.dot(&normal).min(0.0),
            tangential_velocity: velocity.perp(&normal) + surface,
            time_since_last: a.time - since(i).max(since(j)),
        };
        let impulse = self.law.impulse(&impact);
        let momentum = impulse.normal * normal + impulse.tangential * clockwise(&normal);
        for (disk, signed_inverse_mass) in [(i, inverse_a), (j, -inverse_b)] {
            let body = &mut bodies[disk];
            body.velocity += momentum * signed_inverse_mass;
            body.impacts = body.impacts.wrapping_add(1);
            let lever = inverse_factor * signed_inverse_mass.abs() / body.radius;
            turn::<L>(&mut spins[disk], lever, impulse.tangential, a.time);
        }
        counts.disk_impacts += 1;
        counts.energy_lost += energy_lost(&impact, impulse);
    }

    /// Impact of a disk on a wall that it has flown to.
    pub(super) fn collide_with_wall(&mut self, disk: u32, wall: u32) {
        let inverse_factor = self.inverse_inertia_factor;
        let EventDrivenState {
            bodies,
            spins,
            boundary,
            counts,
            shells,
            ..
        } = &mut self.state;
        let (body, spin) = (&mut bodies[disk as usize], &mut spins[disk as usize]);
        let inverse_mass = shells.entries[disk as usize].inverse_mass;
        let impact_at = |normal_velocity: f64, tangential_velocity: f64| Impact {
            effective_mass: 1.0 / inverse_mass,
            tangential_mass: tangential_mass(inverse_mass, 0.0, inverse_factor * inverse_mass, 0.0),
            normal_velocity,
            tangential_velocity,
            time_since_last: body.time - spin.since,
        };
        // Asked before the tangential velocity is known, which no law needs for the normal one.
        let law = &self.law;
        let separation_velocity = |approach: f64| law.separation_velocity(&impact_at(approach, 0.0));
        let contact = boundary.contact(wall, body, separation_velocity);
        let normal = contact.normal;
        let velocity = body.velocity - contact.velocity;
        let surface = if L::ROTATES {
            body.radius * spin.angular_velocity
        } else {
            0.0
        };
        let impact = impact_at(velocity.dot(&normal).min(0.0), velocity.perp(&normal) + surface);
        let impulse = law.impulse(&impact);
        let momentum = impulse.normal * normal + impulse.tangential * clockwise(&normal);
        body.velocity += momentum * inverse_mass;
        body.impacts = body.impacts.wrapping_add(1);
        let lever = inverse_factor * inverse_mass / body.radius;
        turn::<L>(spin, lever, impulse.tangential, body.time);
        counts.wall_impacts += 1;
        counts.energy_lost += energy_lost(&impact, impulse);
        counts.energy_input += momentum.dot(&contact.velocity);
        boundary.record(wall, contact.part, momentum);
        if boundary.is_base(wall) {
            counts.base_impulse += momentum.y;
        }
    }
}

/// Brings the angle up to `now` and applies the tangential impulse J_t; `lever` = R/I.
#[inline(always)]
fn turn<L: CollisionLaw>(spin: &mut Spin, lever: f64, tangential_impulse: f64, now: f64) {
    if L::ROTATES {
        spin.angle += spin.angular_velocity * (now - spin.since);
        spin.angular_velocity += lever * tangential_impulse;
    }
    if L::ROTATES || L::REMEMBERS {
        spin.since = now;
    }
}

/// Energy lost in an impact \[J\]: minus the work of both impulses at the mean velocities.
#[inline(always)]
fn energy_lost(impact: &Impact, impulse: Impulse) -> f64 {
    let normal = impact.normal_velocity + 0.5 * impulse.normal / impact.effective_mass;
    let tangential = impact.tangential_velocity + 0.5 * impulse.tangential / impact.tangential_mass;
    -impulse.normal * normal - impulse.tangential * tangential
}

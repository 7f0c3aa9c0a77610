//! Impacts: two bodies that touch, an impulse and its opposite, what is lost.

use crate::collision::{CollisionLaw, Impact, effective_mass, tangential_mass};

use super::{Boundary, EventDriven, Field, Space, Spin, State};

impl<L: CollisionLaw, B: Boundary, F: Field, S: Space> EventDriven<L, B, F, S> {
    /// Impact of two disks that have flown to where they touch.
    pub(super) fn meet_disk(&mut self, first: u32, second: u32, now: f64) {
        let inverse_factor = self.inverse_inertia_factor;
        let State {
            bodies,
            spins,
            shells,
            counts,
            ..
        } = &mut self.state;
        let (i, j) = (first as usize, second as usize);
        let (a, b) = (bodies[i], bodies[j]);
        let mut separation = [a.x - b.x, a.y - b.y];
        let (here, there) = (&shells.listings[i], &shells.listings[j]);
        if here.at_edge {
            separation = self.space.shortest(separation);
        }
        let inverse = 1.0 / (separation[0] * separation[0] + separation[1] * separation[1]).sqrt();
        let n = [separation[0] * inverse, separation[1] * inverse];
        let (vx, vy) = (a.vx - b.vx, a.vy - b.vy);
        let spin = |disk: usize| if L::ROTATES { spins[disk].angular_velocity } else { 0.0 };
        let since = |disk: usize| {
            if L::REMEMBERS {
                spins[disk].since
            } else {
                f64::NEG_INFINITY
            }
        };
        let turning = a.radius * spin(i) + b.radius * spin(j);
        let impact = Impact {
            effective_mass: effective_mass(here.inverse_mass, there.inverse_mass),
            tangential_mass: tangential_mass(
                here.inverse_mass,
                there.inverse_mass,
                inverse_factor * here.inverse_mass,
                inverse_factor * there.inverse_mass,
            ),
            normal_velocity: (vx * n[0] + vy * n[1]).min(0.0),
            tangential_velocity: vx * n[1] - vy * n[0] + turning,
            time_since_last: now - since(i).max(since(j)),
        };
        let impulse = self.law.impulse(&impact);
        let (along, across) = (impulse.normal, impulse.tangential);
        let push = [along * n[0] + across * n[1], along * n[1] - across * n[0]];
        for (disk, signed_inverse_mass) in [(i, here.inverse_mass), (j, -there.inverse_mass)] {
            let body = &mut bodies[disk];
            body.vx += push[0] * signed_inverse_mass;
            body.vy += push[1] * signed_inverse_mass;
            body.impacts = body.impacts.wrapping_add(1);
            let lever = inverse_factor * signed_inverse_mass.abs() / body.radius;
            turn::<L>(&mut spins[disk], lever, across, now);
        }
        counts.disk_impacts += 1;
        counts.energy_lost += heat(&impact, along, across);
    }

    pub(super) fn meet_wall(&mut self, disk: u32, wall: u32, now: f64) {
        let inverse_factor = self.inverse_inertia_factor;
        let State {
            bodies,
            spins,
            boundary,
            counts,
            shells,
            ..
        } = &mut self.state;
        let (body, spin) = (&mut bodies[disk as usize], &mut spins[disk as usize]);
        let inverse_mass = shells.listings[disk as usize].inverse_mass;
        let impact_at = |normal_velocity: f64, tangential_velocity: f64| Impact {
            effective_mass: 1.0 / inverse_mass,
            tangential_mass: tangential_mass(inverse_mass, 0.0, inverse_factor * inverse_mass, 0.0),
            normal_velocity,
            tangential_velocity,
            time_since_last: now - spin.since,
        };
        // Asked before the tangential velocity is known, which no law needs for the normal one.
        let law = &self.law;
        let separation = |approach: f64| law.separation_velocity(&impact_at(approach, 0.0));
        let meeting = boundary.meet(wall, body, now, separation);
        let n = meeting.normal;
        let (vx, vy) = (body.vx - meeting.velocity[0], body.vy - meeting.velocity[1]);
        let turning = if L::ROTATES {
            body.radius * spin.angular_velocity
        } else {
            0.0
        };
        let impact = impact_at((vx * n[0] + vy * n[1]).min(0.0), vx * n[1] - vy * n[0] + turning);
        let impulse = law.impulse(&impact);
        let (along, across) = (impulse.normal, impulse.tangential);
        let push = [along * n[0] + across * n[1], along * n[1] - across * n[0]];
        body.vx += push[0] * inverse_mass;
        body.vy += push[1] * inverse_mass;
        body.impacts = body.impacts.wrapping_add(1);
        turn::<L>(spin, inverse_factor * inverse_mass / body.radius, across, now);
        counts.wall_impacts += 1;
        counts.energy_lost += heat(&impact, along, across);
        counts.energy_input += push[0] * meeting.velocity[0] + push[1] * meeting.velocity[1];
        if boundary.is_base(wall) {
            counts.base_impulse += push[1];
        }
    }
}

/// Brings the angle up to `now` and applies the tangential impulse; `lever` = R/I.
#[inline(always)]
fn turn<L: CollisionLaw>(spin: &mut Spin, lever: f64, across: f64, now: f64) {
    if L::ROTATES {
        spin.angle += spin.angular_velocity * (now - spin.since);
        spin.angular_velocity += lever * across;
    }
    if L::ROTATES || L::REMEMBERS {
        spin.since = now;
    }
}

/// Energy lost in an impact \[J\]: minus the work of both impulses at the mean velocities.
#[inline(always)]
fn heat(impact: &Impact, along: f64, across: f64) -> f64 {
    let normal = impact.normal_velocity + 0.5 * along / impact.effective_mass;
    let tangential = impact.tangential_velocity + 0.5 * across / impact.tangential_mass;
    -along * normal - across * tangential
}

//! Predictions: a disk in flight in, its earliest event out.

use crate::collision::CollisionLaw;

use super::shells::Listing;
use super::{Body, Boundary, EventDriven, Field, LEAVES_SHELL, Space, State, WALLS};

/// A neighbour that approaches closely enough to be worth a square root.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Candidate {
    disk: u32,
    approach: f64,
    gap: f64,
    discriminant: f64,
}

impl<L: CollisionLaw, B: Boundary, F: Field, S: Space> EventDriven<L, B, F, S> {
    /// Finds the next event of a disk that is at `now`.
    pub(super) fn predict(&mut self, disk: u32, now: f64) {
        let State {
            bodies,
            shells,
            boundary,
            ..
        } = &mut self.state;
        let body = bodies[disk as usize];
        let gravity = self.field.gravity();
        let Listing {
            anchor, at_edge, walls, ..
        } = shells.listings[disk as usize];
        let mut earliest = time_in_shell(&body, anchor, shells.slack(body.radius), gravity);
        let mut partner = LEAVES_SHELL;

        let neighbours = shells.neighbours(disk);
        if self.near.len() < neighbours.len() {
            self.near.resize(neighbours.len(), Candidate::default());
        }
        // Two passes: the first has no branch that depends on velocities, the second only takes roots worth taking.
        let mut count = 0;
        for &other in neighbours {
            let there = &bodies[other as usize];
            let ahead = now - there.time;
            let fall = ahead * gravity;
            let mut separation = [
                body.x - there.x - ahead * there.vx,
                body.y - there.y - ahead * (there.vy - 0.5 * fall),
            ];
            if at_edge {
                separation = self.space.shortest(separation);
            }
            let (vx, vy) = (body.vx - there.vx, body.vy - (there.vy - fall));
            let distance = body.radius + there.radius;
            let squared = distance * distance;
            let approach = -(separation[0] * vx + separation[1] * vy);
            let gap = separation[0] * separation[0] + separation[1] * separation[1] - squared;
            let speed = vx * vx + vy * vy;
            let cross = separation[0] * vy - separation[1] * vx;
            let discriminant = speed * squared - cross * cross;
            self.near[count] = Candidate {
                disk: other,
                approach,
                gap,
                discriminant,
            };
            count += usize::from((approach > 0.0) & (discriminant >= 0.0));
        }
        for candidate in &self.near[..count] {
            // `gap / (2 approach)` bounds the time to touch from below.
            if candidate.gap >= 2.0 * candidate.approach * earliest {
                continue;
            }
            let delay = if candidate.gap > 0.0 {
                candidate.gap / (candidate.approach + candidate.discriminant.sqrt())
            } else {
                0.0
            };
            if delay < earliest {
                (earliest, partner) = (delay, candidate.disk);
            }
        }

        if B::EXISTS && walls != 0 {
            let (delay, wall) = boundary.first_hit(walls, &body, now, gravity, earliest);
            if delay < earliest {
                (earliest, partner) = (delay, WALLS + wall);
            }
        }
        if partner < WALLS {
            shells.listings[disk as usize].partner_impacts = bodies[partner as usize].impacts;
        }
        let body = &mut bodies[disk as usize];
        body.partner = partner;
        body.next_time = now + earliest;
        self.calendar.schedule(disk, body.next_time);
    }
}

/// A time \[s\] within which the disk surely stays in its shell; exact without gravity.
#[inline(always)]
fn time_in_shell(body: &Body, anchor: [f64; 2], slack: f64, gravity: f64) -> f64 {
    let (dx, dy) = (body.x - anchor[0], body.y - anchor[1]);
    let squared = body.vx * body.vx + body.vy * body.vy;
    if gravity == 0.0 {
        let outward = dx * body.vx + dy * body.vy;
        let room = slack * slack - dx * dx - dy * dy;
        let discriminant = outward * outward + squared * room;
        let time = room / (outward + discriminant.max(0.0).sqrt());
        return if time > 0.0 { time } else { 0.0 };
    }
    // |r(t)| <= |r| + |v| t + g t^2 / 2
    let room = (slack - dx.hypot(dy)).max(0.0);
    2.0 * room / (squared.sqrt() + (squared + 2.0 * gravity * room).sqrt())
}

//! Predictions: a disk in flight in, its earliest event out.

use nalgebra::Vector2;

use crate::collision::CollisionLaw;
use crate::elementary::hypot;

use super::shells::ShellEntry;
use super::{Body, Boundary, EventDriven, EventDrivenState, Partner, Space};

/// A neighbour that approaches closely enough to be worth a square root.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Candidate {
    disk: u32,
    approach: f64,
    gap: f64,
    discriminant: f64,
}

impl<L: CollisionLaw, B: Boundary, S: Space> EventDriven<L, B, S> {
    /// Finds the next event of a disk after its own time.
    pub(super) fn predict(&mut self, disk: u32) {
        let EventDrivenState {
            bodies,
            shells,
            boundary,
            ..
        } = &mut self.state;
        let body = bodies[disk as usize];
        let gravity = self.gravity;
        let ShellEntry {
            centre, at_edge, walls, ..
        } = shells.entries[disk as usize];
        let mut earliest = time_in_shell(&body, centre, shells.slack(body.radius), gravity);
        let mut partner = Partner::Shell;

        let neighbours = shells.neighbours(disk);
        if self.candidates.len() < neighbours.len() {
            self.candidates.resize(neighbours.len(), Candidate::default());
        }
        // `geometry::disk_disk` in two passes: the first has no branch that depends on velocities, the second takes only
        // the roots that can matter.
        let mut count = 0;
        for &other in neighbours {
            let there = &bodies[other as usize];
            let ahead = body.time - there.time;
            let fall = ahead * gravity;
            let mean = Vector2::new(there.velocity.x, there.velocity.y - 0.5 * fall);
            let mut separation = body.position - there.position - ahead * mean;
            if at_edge {
                separation = self.space.nearest_image(separation);
            }
            let velocity = body.velocity - Vector2::new(there.velocity.x, there.velocity.y - fall);
            let radius_sum = body.radius + there.radius;
            let squared = radius_sum * radius_sum;
            let approach = -separation.dot(&velocity);
            let cross = separation.perp(&velocity);
            let discriminant = velocity.norm_squared() * squared - cross * cross;
            self.candidates[count] = Candidate {
                disk: other,
                approach,
                gap: separation.norm_squared() - squared,
                discriminant,
            };
            count += usize::from((approach > 0.0) & (discriminant >= 0.0));
        }
        for candidate in &self.candidates[..count] {
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
                (earliest, partner) = (delay, Partner::Disk(candidate.disk));
            }
        }

        if walls != 0 {
            let hit = boundary.first_hit(walls, &body, gravity, earliest);
            if hit.delay < earliest {
                (earliest, partner) = (hit.delay, Partner::Wall(hit.wall));
            }
        }
        if let Partner::Disk(other) = partner {
            shells.entries[disk as usize].partner_impacts = bodies[other as usize].impacts;
        }
        let body = &mut bodies[disk as usize];
        body.next_partner = partner.into();
        body.next_time = body.time + earliest;
        self.calendar.schedule(disk, body.next_time);
    }
}

/// A time \[s\] within which the disk surely stays in its shell; exact without gravity.
#[inline(always)]
fn time_in_shell(body: &Body, centre: Vector2<f64>, slack: f64, gravity: f64) -> f64 {
    let (offset, velocity) = (body.position - centre, body.velocity);
    let speed_squared = velocity.norm_squared();
    if gravity == 0.0 {
        let outward = offset.dot(&velocity);
        let room = slack * slack - offset.x * offset.x - offset.y * offset.y;
        let discriminant = outward * outward + speed_squared * room;
        let time = room / (outward + discriminant.max(0.0).sqrt());
        return if time > 0.0 { time } else { 0.0 };
    }
    // |r(t)| <= |r| + |v| t + g t^2 / 2
    let room = (slack - hypot(offset.x, offset.y)).max(0.0);
    2.0 * room / (speed_squared.sqrt() + (speed_squared + 2.0 * gravity * room).sqrt())
}

//! Sawtooth base that moves vertically as its drive says, under a ceiling at rest.
//!
//! First hits are found for certain. The gap between a disk and a tooth, both moving, is a convex function of place along
//! a path (`geometry::sawtooth`), so that its second derivative is nowhere less than `-(g + a)`, a the greatest
//! acceleration of the base. From gap and rate at one instant this gives a parabola below the gap; the march steps to
//! its root, cannot pass a hit and converges on one like Newton's method. Source: F B.3 and B.4, by other means: no
//! windows, no end points, no angular ranges.

use serde::{Deserialize, Serialize};

use crate::drive::{BoundedDrive, Motion};
use crate::geometry::{Flight, SawtoothProfile, disk_wall};

use super::{Body, Boundary, Meeting, Moving, VibratingBase};

const BASE: u32 = 0;
const CEILING: u32 = 1;

/// Gap \[radii\] at which the march takes its last step.
const TOUCH: f64 = 1e-12;
/// Gap \[radii\] within which a disk that meets the base may touch two teeth at once.
const TOGETHER: f64 = 1e-6;
/// More than any march takes (some tens); what is left then is a hover within rounding of a touch.
const MOST_STEPS: usize = 100_000;

/// Teeth on a base that moves, and a ceiling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sawtooth<D> {
    profile: SawtoothProfile,
    base: Moving<D>,
    /// The drive of the base in local time.
    local: D,
    ceiling: f64,
    /// Time \[s\] at which local time is zero.
    origin: f64,
    ceiling_hits: u64,
}

impl<D: BoundedDrive> Sawtooth<D> {
    /// Teeth on a base under a ceiling at the height `ceiling` \[m\]; local time begins at `origin` \[s\].
    pub fn new(profile: SawtoothProfile, base: Moving<D>, ceiling: f64, origin: f64) -> Self {
        Self {
            profile,
            local: base.drive.counted_from(origin),
            base,
            ceiling,
            origin,
            ceiling_hits: 0,
        }
    }

    /// Shape of the teeth.
    pub fn profile(&self) -> &SawtoothProfile {
        &self.profile
    }

    /// Motion of the base, in time since zero.
    pub fn base(&self) -> &Moving<D> {
        &self.base
    }

    /// Motion of the base at a local time \[s\], as impacts see it.
    pub fn local_motion(&self, local_time: f64) -> Motion {
        self.local.motion(local_time)
    }

    /// Height of the ceiling \[m\].
    pub fn ceiling(&self) -> f64 {
        self.ceiling
    }

    /// Hits on the ceiling so far.
    pub fn ceiling_hits(&self) -> u64 {
        self.ceiling_hits
    }

    /// From now on the base moves like this.
    pub fn set_base(&mut self, base: Moving<D>) {
        self.local = base.drive.counted_from(self.origin);
        self.base = base;
    }

    /// Gap \[m\] of a disk `delay` after its place, its rate \[m/s\] and the normal, towards one tooth.
    #[inline]
    fn gap(&self, tooth: i64, body: &Body, base: Motion, delay: f64, gravity: f64) -> (f64, f64, [f64; 2]) {
        let fall = gravity * delay;
        let place = [
            body.x + delay * body.vx,
            body.y + delay * (body.vy - 0.5 * fall) - base.displacement,
        ];
        let (distance, normal) = self.profile.distance(tooth, place);
        let rate = normal[0] * body.vx + normal[1] * (body.vy - fall - base.velocity);
        (distance - body.radius, rate, normal)
    }

    /// Delay \[s\] of the first hit on a tooth if it comes within `horizon` \[s\].
    #[inline]
    fn first_hit_of_tooth(
        &self,
        tooth: i64,
        body: &Body,
        (now, base): (f64, Motion),
        gravity: f64,
        horizon: f64,
    ) -> Option<f64> {
        let bound = gravity + self.local.greatest_acceleration();
        let (mut gap, mut rate, _) = self.gap(tooth, body, base, 0.0, gravity);
        if gap <= 0.0 && rate < 0.0 {
            return Some(0.0);
        }
        // The contact just left may overlap by rounding: it is one again when the gap comes back to where it is.
        let overlap = (-gap).max(0.0);
        let mut delay = 0.0;
        for _ in 0..MOST_STEPS {
            let above = (gap + overlap).max(0.0);
            let root = (rate * rate + 2.0 * bound * above).sqrt();
            let step = if rate < 0.0 {
                2.0 * above / (root - rate)
            } else {
                (rate + root) / bound
            };
            let next = delay + step;
            if next > horizon || next.is_nan() {
                return None;
            }
            if next <= delay || (above <= TOUCH * body.radius && rate < 0.0) {
                return Some(next);
            }
            delay = next;
            let base = self.local.motion(now + delay);
            (gap, rate, _) = self.gap(tooth, body, base, delay, gravity);
        }
        Some(delay)
    }
}

impl<D: BoundedDrive> Boundary for Sawtooth<D>
where
    Moving<D>: VibratingBase,
{
    const EXISTS: bool = true;

    fn within_reach(&self, [_, y]: [f64; 2], distance: f64) -> u32 {
        let base = y - distance <= self.profile.top() + self.base.farthest;
        let ceiling = y + distance >= self.ceiling;
        u32::from(base) << BASE | u32::from(ceiling) << CEILING
    }

    fn first_hit(&self, walls: u32, body: &Body, now: f64, gravity: f64, horizon: f64) -> (f64, u32) {
        let (mut earliest, mut first) = (f64::INFINITY, BASE);
        if walls & (1 << CEILING) != 0 {
            let flight = Flight {
                gap: self.ceiling - body.y - body.radius,
                velocity: -body.vy,
                pull: -gravity,
            };
            (earliest, first) = (disk_wall(&flight), CEILING);
        }
        if walls & (1 << BASE) == 0 {
            return (earliest, first);
        }
        let mut within = horizon.min(earliest).min(self.local.known_until() - now);
        let reach = body.radius + body.vx.abs() * within.max(0.0);
        let (left, right) = self.profile.teeth_between(body.x - reach, body.x + reach);
        let base = self.local.motion(now);
        for tooth in left..=right {
            if let Some(delay) = self.first_hit_of_tooth(tooth, body, (now, base), gravity, within) {
                (earliest, first, within) = (delay, BASE, delay);
            }
        }
        (earliest, first)
    }

    /// Of two teeth that the disk touches at once, the one that it approaches faster.
    fn meet(&mut self, wall: u32, body: &Body, now: f64, _separation: impl Fn(f64) -> f64) -> Meeting {
        if wall == CEILING {
            self.ceiling_hits += 1;
            return Meeting {
                normal: [0.0, -1.0],
                velocity: [0.0, 0.0],
            };
        }
        let base = self.local.motion(now);
        let reach = body.radius * (1.0 + TOGETHER);
        let (left, right) = self.profile.teeth_between(body.x - reach, body.x + reach);
        let (mut least, mut fastest) = (f64::INFINITY, f64::INFINITY);
        let mut normal = [0.0, 1.0];
        for tooth in left..=right {
            let (gap, rate, out) = self.gap(tooth, body, base, 0.0, 0.0);
            let touches = gap <= TOGETHER * body.radius;
            let (was_touching, together) = (least <= TOGETHER * body.radius, touches);
            if (together && (!was_touching || rate < fastest)) || (!was_touching && gap < least) {
                (fastest, normal) = (rate, out);
            }
            least = least.min(gap);
        }
        Meeting {
            normal,
            velocity: [0.0, base.velocity],
        }
    }

    fn is_base(&self, wall: u32) -> bool {
        wall == BASE
    }

    fn shift(&mut self, seconds: f64) {
        self.origin += seconds;
        self.local = self.base.drive.counted_from(self.origin);
    }

    fn fits(&self, other: &Self, epoch: f64) -> bool {
        let same_shape = other.profile == self.profile && other.ceiling == self.ceiling;
        let same_time = other.origin == epoch && other.local == other.base.drive.counted_from(epoch);
        same_shape && same_time && other.base.farthest().abs() < 1e100
    }

    /// The base and the ceiling.
    fn count(&self) -> u32 {
        2
    }

    /// Each tooth within reach is looked at.
    fn most_work(&self, radius: f64) -> u64 {
        (radius / self.profile.width()) as u64
    }
}

//! Sawtooth base that moves vertically as its drive says, under a ceiling at rest.
//!
//! First hits are found for certain. The gap between a disk and a tooth, both moving, is a convex function of place along
//! a path (`geometry::sawtooth`), so that its second derivative is nowhere less than `-(g + a)`, a the greatest
//! acceleration of the base. From gap and rate at one instant this gives a parabola below the gap; the march steps to
//! its root, cannot pass a hit and converges on one like Newton's method. Source: F B.3 and B.4, by other means: no
//! windows, no end points, no angular ranges.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

use crate::drive::{BoundedDrive, Motion};
use crate::geometry::{Flight, SawtoothProfile, ToothPart, disk_wall};

use super::{Body, Boundary, Moving, VibratingBase, WallContact, WallHit};

const BASE: u32 = 0;
const CEILING: u32 = 1;

/// Gap \[radii\] at which the march takes its last step.
const TOUCH: f64 = 1e-12;
/// Gap \[radii\] within which a disk that hits the base may touch two teeth at once.
const TOUCHES_BOTH: f64 = 1e-6;
/// More than any march takes (some tens); what is left then is a hover within rounding of a touch.
const MOST_STEPS: usize = 100_000;

/// Gap \[m\] between a disk and a tooth, its rate \[m/s\] and the normal there.
#[derive(Clone, Copy)]
struct Gap {
    value: f64,
    rate: f64,
    normal: Vector2<f64>,
    part: ToothPart,
}

/// Impacts of disks on one part of all teeth.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PartImpacts {
    /// How many.
    pub count: u64,
    /// Impulse to the right that they gave to the disks \[N.s\].
    pub impulse: f64,
}

/// Impacts on the left sides, right sides and tips of the teeth, as the variants of [`ToothPart`] come.
pub type ToothImpacts = [PartImpacts; 3];

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
    tooth_impacts: ToothImpacts,
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
            tooth_impacts: ToothImpacts::default(),
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

    /// Impacts on the parts of the teeth so far.
    pub fn tooth_impacts(&self) -> &ToothImpacts {
        &self.tooth_impacts
    }

    /// From now on the base moves like this.
    pub fn set_base(&mut self, base: Moving<D>) {
        self.local = base.drive.counted_from(self.origin);
        self.base = base;
    }

    /// Gap between one tooth and a disk `delay` \[s\] after the time of `body`, when the base moves as `base`.
    #[inline]
    fn gap(&self, tooth: i64, body: &Body, base: Motion, delay: f64, gravity: f64) -> Gap {
        let (mut position, mut velocity) = body.motion_after(delay, gravity);
        position.y -= base.displacement;
        velocity.y -= base.velocity;
        let clearance = self.profile.clearance(tooth, position);
        Gap {
            value: clearance.distance - body.radius,
            rate: clearance.normal.dot(&velocity),
            normal: clearance.normal,
            part: clearance.part,
        }
    }

    /// Delay \[s\] of the first hit on a tooth if it comes within `horizon` \[s\]; `start` is the motion of the base now.
    #[inline]
    fn first_hit_of_tooth(&self, tooth: i64, body: &Body, start: Motion, gravity: f64, horizon: f64) -> Option<f64> {
        let bound = gravity + self.local.greatest_acceleration();
        let mut gap = self.gap(tooth, body, start, 0.0, gravity);
        if gap.value <= 0.0 && gap.rate < 0.0 {
            return Some(0.0);
        }
        // The contact just left may overlap by rounding: it counts as one again when the gap has returned to its value now.
        let overlap = (-gap.value).max(0.0);
        let mut delay = 0.0;
        for _ in 0..MOST_STEPS {
            let (above, rate) = ((gap.value + overlap).max(0.0), gap.rate);
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
            let base = self.local.motion(body.time + delay);
            gap = self.gap(tooth, body, base, delay, gravity);
        }
        Some(delay)
    }
}

impl<D: BoundedDrive> Boundary for Sawtooth<D>
where
    Moving<D>: VibratingBase,
{
    fn walls_within(&self, distance: f64, position: Vector2<f64>) -> u32 {
        let base = position.y - distance <= self.profile.top() + self.base.farthest;
        let ceiling = position.y + distance >= self.ceiling;
        u32::from(base) << BASE | u32::from(ceiling) << CEILING
    }

    fn first_hit(&self, walls: u32, body: &Body, gravity: f64, horizon: f64) -> WallHit {
        let mut hit = WallHit::NONE;
        if walls & (1 << CEILING) != 0 {
            let flight = Flight {
                gap: self.ceiling - body.position.y - body.radius,
                velocity: -body.velocity.y,
                pull: -gravity,
            };
            hit = WallHit {
                delay: disk_wall(&flight),
                wall: CEILING,
            };
        }
        if walls & (1 << BASE) == 0 {
            return hit;
        }
        let mut within = horizon.min(hit.delay).min(self.local.known_until() - body.time);
        let half_width = body.radius + body.velocity.x.abs() * within.max(0.0);
        let start = self.local.motion(body.time);
        for tooth in self.profile.teeth_within(half_width, body.position.x) {
            if let Some(delay) = self.first_hit_of_tooth(tooth, body, start, gravity, within) {
                (hit, within) = (WallHit { delay, wall: BASE }, delay);
            }
        }
        hit
    }

    /// Of two teeth that the disk touches at once, the one that it approaches faster.
    fn contact(&mut self, wall: u32, body: &Body, _separation_velocity: impl Fn(f64) -> f64) -> WallContact {
        if wall == CEILING {
            self.ceiling_hits += 1;
            return WallContact {
                normal: Vector2::new(0.0, -1.0),
                velocity: Vector2::zeros(),
                part: 0,
            };
        }
        let base = self.local.motion(body.time);
        let half_width = body.radius * (1.0 + TOUCHES_BOTH);
        let (mut least, mut fastest) = (f64::INFINITY, f64::INFINITY);
        let (mut normal, mut part) = (Vector2::y(), ToothPart::Tip);
        for tooth in self.profile.teeth_within(half_width, body.position.x) {
            let gap = self.gap(tooth, body, base, 0.0, 0.0);
            let touched = least <= TOUCHES_BOTH * body.radius;
            let touches = gap.value <= TOUCHES_BOTH * body.radius;
            if (touches && (!touched || gap.rate < fastest)) || (!touched && gap.value < least) {
                (fastest, normal, part) = (gap.rate, gap.normal, gap.part);
            }
            least = least.min(gap.value);
        }
        WallContact {
            normal,
            velocity: Vector2::new(0.0, base.velocity),
            part: part as u32,
        }
    }

    /// F Figs 13, 14 ask which sides the disks meet.
    #[inline(always)]
    fn record(&mut self, wall: u32, part: u32, impulse: Vector2<f64>) {
        if wall == BASE
            && let Some(sum) = self.tooth_impacts.get_mut(part as usize)
        {
            // Wrapping, since a state that is read back may hold any count.
            sum.count = sum.count.wrapping_add(1);
            sum.impulse += impulse.x;
        }
    }

    fn is_base(&self, wall: u32) -> bool {
        wall == BASE
    }

    fn shift_origin(&mut self, seconds: f64) {
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

    /// The search goes through each tooth under the disk.
    fn most_work(&self, radius: f64) -> u64 {
        (radius / self.profile.width()) as u64
    }
}

//! How the bodies of two contacts lie and move, in lanes: pairs of disks, and disks at walls.

use crate::engine::dem::angle::{SMALL_SINE, angle_between};
use crate::engine::dem::two_lanes::{F64x2, lane, per_lane, transpose};

use super::cubic::{Cubic, integrals};
use super::disk_records::{DiskRecord, ImpulseSums};
use super::state::{Contact, Kinematics};
use super::step_context::StepContext;

/// Relative motion of two contacts at the end of a step. Slopes are rates times the step.
#[derive(Clone, Copy)]
pub struct LaneMotion {
    /// Overlap and its slope \[m\].
    pub overlap: [F64x2; 2],
    /// lambda and its slope \[m\].
    pub displacement: [F64x2; 2],
    /// Normal.
    pub normal: [F64x2; 2],
    /// Angle by which the normal has turned from the remembered direction \[rad\].
    pub turn: F64x2,
    /// Angle by which the normal would turn in a step at its present rate \[rad\].
    pub turning: F64x2,
    /// Lever of the tangential force.
    pub lever: F64x2,
}

impl LaneMotion {
    /// One lane, after a step of length `step` \[s\].
    #[inline(always)]
    pub fn kinematics(&self, k: usize, step: f64) -> Kinematics {
        Kinematics {
            overlap: lane(self.overlap[0], k),
            closing: lane(self.overlap[1], k) / step,
            tangential_displacement: lane(self.displacement[0], k),
            sliding: lane(self.displacement[1], k) / step,
            normal: self.normal.map(|part| lane(part, k)),
            turning: lane(self.turning, k) / step,
            lever: lane(self.lever, k),
        }
    }
}

/// Forces at both nodes of the step: normal and tangential \[N\], and the overlaps there \[m\].
#[derive(Clone, Copy)]
pub struct NodeForces {
    /// N.
    pub normal: [F64x2; 2],
    /// tau.
    pub tangential: [F64x2; 2],
    /// delta.
    pub overlap: [F64x2; 2],
}

/// Impulse and first moment about the end of the step, in lanes.
#[derive(Clone, Copy)]
pub struct LaneImpulse {
    /// Along x.
    pub x: [F64x2; 2],
    /// Along y.
    pub y: [F64x2; 2],
    /// Of the tangential force.
    pub tangential: [F64x2; 2],
}

/// Sums over disks and walls.
pub struct Receivers<'step> {
    /// Of each disk.
    pub disks: &'step mut [ImpulseSums],
    /// Impulse (x, y) of each wall \[N.s\].
    pub walls: &'step mut [[f64; 2]],
}

/// Bodies of two contacts, and what their frame has at the start of the step.
pub trait LaneGeometry: Copy {
    /// Bodies of these contacts.
    fn of(contacts: [&Contact; 2], context: &StepContext<'_>) -> Self;
    /// Relative motion at the end of the step, where the disks are at `disks`.
    fn end(&self, context: &StepContext<'_>, disks: &[DiskRecord]) -> LaneMotion;
    /// x and y of the forces at both nodes.
    fn forces(&self, end: &LaneMotion, at: &NodeForces) -> [[F64x2; 2]; 2];
    /// Work of the wall \[J\] by these vertical forces at the nodes.
    fn work(&self, context: &StepContext<'_>, vertical: [F64x2; 2]) -> F64x2;
    /// Adds an impulse to the bodies.
    fn add(&self, given: &LaneImpulse, to: &mut Receivers<'_>);
}

/// Two pairs of disks.
#[derive(Debug, Clone, Copy)]
pub struct PairLanes {
    first: [usize; 2],
    second: [usize; 2],
    radius_sum: F64x2,
    /// Remembered direction.
    direction: [F64x2; 2],
    /// Normal at the start, and its rate times the step.
    normal: [F64x2; 2],
    normal_slope: [F64x2; 2],
}

impl LaneGeometry for PairLanes {
    #[inline(always)]
    fn of(contacts: [&Contact; 2], context: &StepContext<'_>) -> Self {
        let (first, second) = (
            contacts.map(|contact| contact.first as usize),
            contacts.map(|contact| contact.second as usize),
        );
        let radii = context.start.radii;
        let normal = [0, 1].map(|axis: usize| per_lane(|k| contacts[k].kinematics.normal[axis]));
        let turning = per_lane(|k| contacts[k].kinematics.turning) * context.step;
        Self {
            first,
            second,
            radius_sum: per_lane(|k| radii[first[k]]) + per_lane(|k| radii[second[k]]),
            direction: [0, 1].map(|axis: usize| per_lane(|k| contacts[k].direction[axis])),
            normal,
            normal_slope: turned(normal, turning),
        }
    }

    #[inline(always)]
    fn end(&self, context: &StepContext<'_>, disks: &[DiskRecord]) -> LaneMotion {
        let (a, b) = (self.first.map(|i| &disks[i]), self.second.map(|i| &disks[i]));
        let difference = |part: usize| transpose([0, 1].map(|k| a[k][part] - b[k][part]));
        let ([dx, dy], [ux, uy]) = (difference(0), difference(1));
        let [arc, rate] = transpose([0, 1].map(|k| a[k][2] + b[k][2]));
        let distance = (dx * dx + dy * dy).sqrt();
        let inverse = 1.0 / distance;
        let (nx, ny) = (dx * inverse, dy * inverse);
        let (approach, sideways) = (ux * nx + uy * ny, ux * ny - uy * nx);
        let lever = self.radius_sum * inverse;
        let turn = turn_between(self.direction, [nx, ny]);
        LaneMotion {
            overlap: [self.radius_sum - distance, approach * -context.step],
            displacement: [arc - self.radius_sum * turn, (sideways * lever + rate) * context.step],
            normal: [nx, ny],
            turn,
            turning: sideways * inverse * -context.step,
            lever,
        }
    }

    /// The lever of the tangential force is that of [`Kinematics::lever`]; the normal turns from start to end.
    #[inline(always)]
    fn forces(&self, end: &LaneMotion, at: &NodeForces) -> [[F64x2; 2]; 2] {
        let slope = turned(end.normal, end.turning);
        let [nx, ny] = [0, 1].map(|axis: usize| {
            let start = [self.normal[axis], self.normal_slope[axis]];
            Cubic::new(start, [end.normal[axis], slope[axis]]).at_nodes()
        });
        let sideways = [0, 1].map(|i: usize| {
            let distance = self.radius_sum - at.overlap[i];
            at.tangential[i] * (self.radius_sum / distance)
        });
        [
            [0, 1].map(|i: usize| at.normal[i] * nx[i] + sideways[i] * ny[i]),
            [0, 1].map(|i: usize| at.normal[i] * ny[i] - sideways[i] * nx[i]),
        ]
    }

    #[inline(always)]
    fn work(&self, _context: &StepContext<'_>, _vertical: [F64x2; 2]) -> F64x2 {
        F64x2::splat(0.0)
    }

    #[inline(always)]
    fn add(&self, given: &LaneImpulse, to: &mut Receivers<'_>) {
        for (k, [moment, impulse, turning]) in vectors(given).into_iter().enumerate() {
            let sums = &mut to.disks[self.first[k]];
            sums[0] += moment;
            sums[1] += impulse;
            sums[2] += turning;
            let sums = &mut to.disks[self.second[k]];
            sums[0] -= moment;
            sums[1] -= impulse;
            sums[2] += turning;
        }
    }
}

/// Two disks at walls.
#[derive(Debug, Clone, Copy)]
pub struct WallLanes {
    disk: [usize; 2],
    wall: [usize; 2],
    radius: F64x2,
    normal: [F64x2; 2],
    offset: F64x2,
    follows_base: F64x2,
}

impl LaneGeometry for WallLanes {
    #[inline(always)]
    fn of(contacts: [&Contact; 2], context: &StepContext<'_>) -> Self {
        let (disk, wall) = (
            contacts.map(|contact| contact.first as usize),
            contacts.map(|contact| contact.second as usize),
        );
        let walls = wall.map(|wall| &context.walls[wall]);
        Self {
            disk,
            wall,
            radius: per_lane(|k| context.start.radii[disk[k]]),
            normal: [0, 1].map(|axis: usize| per_lane(|k| walls[k].normal[axis])),
            offset: per_lane(|k| walls[k].offset),
            follows_base: per_lane(|k| walls[k].follows_base),
        }
    }

    #[inline(always)]
    fn end(&self, context: &StepContext<'_>, disks: &[DiskRecord]) -> LaneMotion {
        let at = self.disk.map(|i| &disks[i]);
        let part = |part: usize| transpose([0, 1].map(|k| at[k][part]));
        let ([x, y], [vx, vy], [arc, rate]) = (part(0), part(1), part(2));
        let base = &context.base[1];
        let (y, vy) = (
            y - self.follows_base * base.displacement,
            vy - self.follows_base * base.velocity,
        );
        let [nx, ny] = self.normal;
        LaneMotion {
            overlap: [
                self.radius - (nx * x + ny * y - self.offset),
                (nx * vx + ny * vy) * -context.step,
            ],
            displacement: [arc + ny * x - nx * y, (ny * vx - nx * vy + rate) * context.step],
            normal: self.normal,
            turn: F64x2::splat(0.0),
            turning: F64x2::splat(0.0),
            lever: F64x2::splat(1.0),
        }
    }

    #[inline(always)]
    fn forces(&self, _end: &LaneMotion, at: &NodeForces) -> [[F64x2; 2]; 2] {
        let [nx, ny] = self.normal;
        [
            [0, 1].map(|i: usize| at.normal[i] * nx + at.tangential[i] * ny),
            [0, 1].map(|i: usize| at.normal[i] * ny - at.tangential[i] * nx),
        ]
    }

    #[inline(always)]
    fn work(&self, context: &StepContext<'_>, vertical: [F64x2; 2]) -> F64x2 {
        let [first, second] = context.base_velocity_at_nodes;
        self.follows_base * (vertical[0] * first + vertical[1] * second) * (0.5 * context.step)
    }

    #[inline(always)]
    fn add(&self, given: &LaneImpulse, to: &mut Receivers<'_>) {
        for (k, [moment, impulse, turning]) in vectors(given).into_iter().enumerate() {
            let sums = &mut to.disks[self.disk[k]];
            sums[0] += moment;
            sums[1] += impulse;
            sums[2] += turning;
            let wall = &mut to.walls[self.wall[k]];
            wall[0] += lane(given.x[0], k);
            wall[1] += lane(given.y[0], k);
        }
    }
}

/// Impulse and moment in lanes, from forces at both nodes; zero where `holds` is not set.
#[inline(always)]
pub fn impulse([x, y]: [[F64x2; 2]; 2], tangential: [F64x2; 2], step: f64, holds: F64x2) -> LaneImpulse {
    let kept = |of: [F64x2; 2]| of.map(|part| part & holds);
    LaneImpulse {
        x: kept(integrals(x, step)),
        y: kept(integrals(y, step)),
        tangential: kept(tangential),
    }
}

/// As in [`ImpulseSums`], for each of two contacts.
#[inline(always)]
fn vectors(given: &LaneImpulse) -> [ImpulseSums; 2] {
    let [moment, other_moment] = transpose([given.x[1], given.y[1]]);
    let [impulse, other_impulse] = transpose([given.x[0], given.y[0]]);
    let [turning, other_turning] = transpose([given.tangential[1], given.tangential[0]]);
    [[moment, impulse, turning], [other_moment, other_impulse, other_turning]]
}

/// Derivative of a direction that turns by `angle` a unit of time.
#[inline(always)]
fn turned([x, y]: [F64x2; 2], angle: F64x2) -> [F64x2; 2] {
    [y * angle * -1.0, x * angle]
}

/// Angles from `direction` to `normal` \[rad\].
#[inline(always)]
fn turn_between(direction: [F64x2; 2], normal: [F64x2; 2]) -> F64x2 {
    let sine = direction[0] * normal[1] - direction[1] * normal[0];
    if sine.abs().simd_ge(F64x2::splat(SMALL_SINE)).any() {
        return wide_turn(direction, normal);
    }
    let square = sine * sine;
    sine * (square * (square * (3.0 / 40.0) + 1.0 / 6.0) + 1.0)
}

#[cold]
#[inline(never)]
fn wide_turn(direction: [F64x2; 2], normal: [F64x2; 2]) -> F64x2 {
    let [direction, normal] = [direction, normal].map(|vector| move |k| vector.map(|part| lane(part, k)));
    per_lane(|k| angle_between(direction(k), normal(k)))
}

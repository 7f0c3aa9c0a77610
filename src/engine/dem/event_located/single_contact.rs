//! One contact over a step, apart from the lanes: those that change their phase in it, and the few that overlap without a
//! force.

use super::contact_step::{ContactStep, Outcome};
use super::disk_records::{DiskRecord, of_pair, of_wall};
use super::frame::{ContactFrame, PairFrame, WallFrame};
use super::impulse::{ContactImpulse, OwnImpulse};
use super::lane_contacts::FOLLOWING_ANGLE;
use super::lane_geometry::{PairLanes, Receivers, WallLanes};
use super::state::{Contact, Kinematics, LocatedPhase};
use super::step_context::StepContext;
use crate::engine::dem::angle::angle_between;
use crate::engine::dem::two_lanes::F64x2;

/// A contact after a step.
pub struct Integrated {
    /// What it gave to its bodies.
    pub given: ContactImpulse,
    /// What it is at the end of the step.
    pub after: Contact,
    /// Whether its phase may have changed.
    pub changed: bool,
}

/// Contacts of one kind, one by one.
pub trait SingleContact {
    /// Whether bodies that were apart may have touched within the step: they overlap, or are apart and not further than the
    /// step could have brought them.
    fn may_touch(context: &StepContext<'_>, disks: &[DiskRecord], bodies: [usize; 2]) -> bool;
    /// Integrates a contact. What it gave in the last pass is contained in the motion.
    fn integrate(context: &StepContext<'_>, disks: &[DiskRecord], contact: &Contact, own: OwnImpulse) -> Integrated;
    /// Adds its impulse to the bodies.
    fn add_single(contact: &Contact, given: &ContactImpulse, to: &mut Receivers<'_>);
}

impl SingleContact for PairLanes {
    #[inline(always)]
    fn may_touch(context: &StepContext<'_>, disks: &[DiskRecord], [i, j]: [usize; 2]) -> bool {
        let radius_sum = context.start.radii[i] + context.start.radii[j];
        let (a, b) = (&disks[i], &disks[j]);
        let apart = a[0] - b[0];
        let beyond = (apart * apart).reduce_add() - radius_sum * radius_sum;
        beyond < 0.0 || beyond < context.step * (apart * (a[1] - b[1])).reduce_add()
    }

    fn integrate(context: &StepContext<'_>, disks: &[DiskRecord], contact: &Contact, own: OwnImpulse) -> Integrated {
        let pair = contact.bodies();
        let radius_sum = context.start.radii[pair[0]] + context.start.radii[pair[1]];
        let mut start = *contact;
        if contact.phase == LocatedPhase::Open {
            start.kinematics = context.start.of_pair(pair);
            start.direction = start.kinematics.normal;
            // Not what an earlier contact left, which is there or not with the age of the list.
            start.reference = start.kinematics.tangential_displacement;
        }
        let mut end = of_pair(disks, pair, radius_sum);
        let turn = angle_between(start.direction, end.normal);
        end.tangential_displacement -= radius_sum * turn;
        let frame = PairFrame::new(&start.kinematics, &end, context.step, radius_sum);
        let inverse_mass = context.inverse_masses[pair[0]][0] + context.inverse_masses[pair[1]][0];
        let mut integrated = integrated(context, &start, &end, own, inverse_mass, &frame);
        if turn.abs() > FOLLOWING_ANGLE {
            integrated.after.follow(turn, radius_sum);
        }
        integrated
    }

    #[inline(always)]
    fn add_single(contact: &Contact, given: &ContactImpulse, to: &mut Receivers<'_>) {
        let [first, second] = contact.bodies();
        let [moment, impulse, turning] = vectors(given);
        let sums = &mut to.disks[first];
        sums[0] += moment;
        sums[1] += impulse;
        sums[2] += turning;
        let sums = &mut to.disks[second];
        sums[0] -= moment;
        sums[1] -= impulse;
        sums[2] += turning;
    }
}

impl SingleContact for WallLanes {
    #[inline(always)]
    fn may_touch(context: &StepContext<'_>, disks: &[DiskRecord], [disk, wall]: [usize; 2]) -> bool {
        let end = end_at_wall(context, disks, [disk, wall]);
        end.overlap > 0.0 || end.overlap > context.step * end.closing
    }

    fn integrate(context: &StepContext<'_>, disks: &[DiskRecord], contact: &Contact, own: OwnImpulse) -> Integrated {
        let [disk, wall] = contact.bodies();
        let end = end_at_wall(context, disks, [disk, wall]);
        let wall = &context.walls[wall];
        let mut start = *contact;
        start.direction = wall.normal.into();
        if contact.phase == LocatedPhase::Open {
            start.kinematics = context.start.of_wall(disk, wall, &context.base[0]);
            start.reference = start.kinematics.tangential_displacement;
        }
        let frame = WallFrame {
            normal: wall.normal.into(),
            follows_base: wall.follows_base,
            base: context.base,
            step: context.step,
        };
        let inverse_mass = context.inverse_masses[disk][0];
        integrated(context, &start, &end, own, inverse_mass, &frame)
    }

    #[inline(always)]
    fn add_single(contact: &Contact, given: &ContactImpulse, to: &mut Receivers<'_>) {
        let [disk, wall] = contact.bodies();
        let [moment, impulse, turning] = vectors(given);
        let sums = &mut to.disks[disk];
        sums[0] += moment;
        sums[1] += impulse;
        sums[2] += turning;
        to.walls[wall][0] += given.impulse[0];
        to.walls[wall][1] += given.impulse[1];
    }
}

#[inline(always)]
fn end_at_wall(context: &StepContext<'_>, disks: &[DiskRecord], [disk, wall]: [usize; 2]) -> Kinematics {
    let base = &context.base[1];
    let radius = context.start.radii[disk];
    of_wall(
        &disks[disk],
        radius,
        &context.walls[wall],
        [base.displacement, base.velocity],
    )
}

#[inline(always)]
fn vectors(given: &ContactImpulse) -> [F64x2; 3] {
    let [impulse, moment] = given.own.tangential;
    [
        F64x2::new(given.moment),
        F64x2::new(given.impulse),
        F64x2::new([moment, impulse]),
    ]
}

/// `start` is the contact at the start, with its motion.
#[inline(always)]
fn integrated<F: ContactFrame>(
    context: &StepContext<'_>,
    start: &Contact,
    end: &Kinematics,
    own: OwnImpulse,
    inverse_mass: f64,
    frame: &F,
) -> Integrated {
    let step = ContactStep {
        contact: start,
        start: &start.kinematics,
        end,
        own,
        inverse_mass,
        frame,
        step: context.step,
    };
    let (outcome, changed) = match step.without_force(context.laws) {
        Some(outcome) => (outcome, false),
        None => (step.integrate_with_events(context.laws), true),
    };
    let Outcome {
        phase,
        reference,
        closing_rate,
        given,
    } = outcome;
    Integrated {
        given,
        after: Contact {
            phase,
            reference,
            closing_rate,
            kinematics: *end,
            ..*start
        },
        changed,
    }
}

//! One step: predict, integrate every contact along the motion found so far, correct by the impulses, and again.

use crate::drive::Motion;
use crate::engine::dem::angle::angle_between;
use crate::engine::dem::candidates::make_room;
use crate::geometry::Wall;

use super::contact_step::ContactStep;
use super::extrapolation::{along_tangent, extrapolated};
use super::frame::{ContactFrame, PairFrame, WallFrame};
use super::impulse::{ContactImpulse, OwnImpulse};
use super::kinematics::DiskArrays;
use super::laws::Laws;
use super::state::{Contact, Kinematics, LocatedPhase};

/// What does not change during a step, and the disks at its start.
#[derive(Clone, Copy)]
pub struct StepContext<'engine> {
    /// Contact laws.
    pub laws: &'engine Laws,
    /// 1/m, 1/m, 1/I of each disk.
    pub inverse_masses: &'engine [[f64; 3]],
    /// Walls.
    pub walls: &'engine [Wall],
    /// Gravity \[m/s2\], downwards.
    pub gravity: f64,
    /// Disks at the start.
    pub start: DiskArrays<'engine>,
    /// Base at the start and at the end.
    pub base: [Motion; 2],
    /// What rounding took from positions and velocities at the start.
    pub remainders: &'engine [[[f64; 3]; 2]],
    /// Length of the step \[s\].
    pub step: f64,
}

/// A contact at the end of the step, as known so far.
#[derive(Debug, Clone, Copy)]
struct ContactEnd {
    /// Whether there is anything to commit: the bodies overlap, or did at the start.
    touched: bool,
    after: Contact,
    own: OwnImpulse,
}

/// Sums over the contacts of the last pass.
#[derive(Debug, Clone, Copy, Default)]
pub struct StepSums {
    /// Energy lost \[J\].
    pub lost: f64,
    /// Work of the walls \[J\].
    pub work: f64,
    /// Deepest overlap \[m\].
    pub deepest: f64,
    /// Overlapping contacts.
    pub contacts: u32,
    /// Contacts whose phase changed.
    pub changes: u32,
}

/// Impulses and moments of one step, and the motion at its end. Scratch memory: nothing outlives the step.
#[derive(Debug, Clone, Default)]
pub struct StepScratch {
    /// Impulse (x, y, angular) on each disk, and first moment of the forces about the end of the step.
    impulses: Vec<[[f64; 3]; 2]>,
    /// Positions at the end.
    pub positions: Vec<[f64; 3]>,
    /// Velocities at the end.
    pub velocities: Vec<[f64; 3]>,
    /// What rounding took from both.
    pub remainders: Vec<[[f64; 3]; 2]>,
    /// Impulses of the walls in this step.
    pub wall_impulses: Vec<[f64; 2]>,
    pair_ends: Vec<ContactEnd>,
    wall_ends: Vec<ContactEnd>,
    /// Sums over the contacts.
    pub sums: StepSums,
}

impl StepScratch {
    /// For so many disks.
    pub fn new(disks: usize) -> Self {
        let mut scratch = Self::default();
        make_room(&mut scratch.pair_ends, disks);
        make_room(&mut scratch.wall_ends, disks);
        scratch
    }

    /// Moves all disks to the end of the step by the forces at its start and their rates.
    pub fn predict(&mut self, context: &StepContext<'_>, pairs: &[Contact], wall_contacts: &[Contact]) {
        self.clear(context);
        let radii = context.start.radii;
        begin(&mut self.pair_ends, pairs, context);
        begin(&mut self.wall_ends, wall_contacts, context);
        for (contact, end) in pairs.iter().zip(&self.pair_ends) {
            if contact.phase.is_pressed() {
                let given = along_tangent(contact, end.own, context.step);
                add(&mut self.impulses, contact.first, &given, radii, 1.0);
                add(&mut self.impulses, contact.second, &given, radii, -1.0);
            }
        }
        for (contact, end) in wall_contacts.iter().zip(&self.wall_ends) {
            if contact.phase.is_pressed() {
                let given = along_tangent(contact, end.own, context.step);
                add(&mut self.impulses, contact.first, &given, radii, 1.0);
            }
        }
        self.correct(context);
    }

    /// Integrates all contacts along the motion found so far and corrects the motion; with `LAST` energies too.
    pub fn refine<const LAST: bool>(
        &mut self,
        context: &StepContext<'_>,
        pairs: &[Contact],
        wall_contacts: &[Contact],
    ) {
        self.clear(context);
        let radii = context.start.radii;
        let now = DiskArrays {
            positions: &self.positions,
            velocities: &self.velocities,
            radii,
        };
        for (contact, end) in pairs.iter().zip(&mut self.pair_ends) {
            if let Some(given) = pair_step::<LAST>(context, now, contact, end, &mut self.sums) {
                add(&mut self.impulses, contact.first, &given, radii, 1.0);
                add(&mut self.impulses, contact.second, &given, radii, -1.0);
            }
        }
        for (contact, end) in wall_contacts.iter().zip(&mut self.wall_ends) {
            if let Some(given) = wall_step::<LAST>(context, now, contact, end, &mut self.sums) {
                add(&mut self.impulses, contact.first, &given, radii, 1.0);
                let sum = &mut self.wall_impulses[contact.second as usize];
                sum[0] += given.impulse[0];
                sum[1] += given.impulse[1];
            }
        }
        self.correct(context);
    }

    /// Makes the contacts those at the end of the step.
    pub fn commit(&self, pairs: &mut [Contact], wall_contacts: &mut [Contact]) {
        commit(pairs, &self.pair_ends);
        commit(wall_contacts, &self.wall_ends);
    }

    fn clear(&mut self, context: &StepContext<'_>) {
        self.sums = StepSums::default();
        self.impulses.clear();
        self.impulses.resize(context.start.positions.len(), [[0.0; 3]; 2]);
        self.wall_impulses.clear();
        self.wall_impulses.resize(context.walls.len(), [0.0; 2]);
    }

    /// Positions and velocities at the end from impulses and moments. The sums are compensated: equal steps in a row would
    /// else all be rounded the same way, and short steps drift by half a unit in the last place each.
    fn correct(&mut self, context: &StepContext<'_>) {
        self.positions.clear();
        self.velocities.clear();
        self.remainders.clear();
        let StepContext { step, start, .. } = *context;
        let (drop, fall) = (
            [0.0, 0.5 * step * step * context.gravity, 0.0],
            [0.0, step * context.gravity, 0.0],
        );
        let disks = start.positions.iter().zip(start.velocities).zip(context.remainders);
        let impulses = self.impulses.iter().zip(context.inverse_masses);
        for (((position, velocity), [short_position, short_velocity]), ([impulse, moment], inverse)) in
            disks.zip(impulses)
        {
            let moved: [(f64, f64); 3] = std::array::from_fn(|i| {
                let exact = step * velocity[i] + step * short_velocity[i];
                compensated(
                    position[i],
                    short_position[i] + (moment[i] * inverse[i] - drop[i]) + exact,
                )
            });
            let sped: [(f64, f64); 3] = std::array::from_fn(|i| {
                compensated(velocity[i], short_velocity[i] + (impulse[i] * inverse[i] - fall[i]))
            });
            self.positions.push(moved.map(|(sum, _)| sum));
            self.velocities.push(sped.map(|(sum, _)| sum));
            self.remainders
                .push([moved.map(|(_, short)| short), sped.map(|(_, short)| short)]);
        }
    }
}

fn commit(contacts: &mut [Contact], ends: &[ContactEnd]) {
    for (contact, end) in contacts.iter_mut().zip(ends) {
        if end.touched {
            *contact = end.after;
        }
    }
}

/// Sum of two numbers, the first the larger or near it, and what rounding took from it (Kahan 1965).
#[inline(always)]
fn compensated(sum: f64, term: f64) -> (f64, f64) {
    let next = sum + term;
    (next, term - (next - sum))
}

/// Bodies that overlap at the start of a run have just touched: their springs are not stretched.
pub fn close_overlapping(context: &StepContext<'_>, pairs: &mut [Contact], wall_contacts: &mut [Contact]) {
    let close = |contact: &mut Contact, kinematics: Kinematics| {
        if kinematics.overlap <= 0.0 {
            return;
        }
        let pressed = context.laws.normal_force(kinematics.overlap, kinematics.closing) > 0.0;
        contact.phase = match pressed {
            true if context.laws.has_friction() => LocatedPhase::Stick,
            true => LocatedPhase::SlipForward,
            false => LocatedPhase::Unpressed,
        };
        contact.direction = kinematics.normal;
        contact.reference = kinematics.tangential_displacement;
        contact.kinematics = kinematics;
    };
    for contact in pairs {
        close(contact, context.start.of_pair(contact.bodies()));
    }
    for contact in wall_contacts {
        let [disk, wall] = contact.bodies();
        close(
            contact,
            context.start.of_wall(disk, &context.walls[wall], &context.base[0]),
        );
    }
}

/// Own impulses of all contacts by the force that continues along its tangent.
fn begin(ends: &mut Vec<ContactEnd>, contacts: &[Contact], context: &StepContext<'_>) {
    ends.clear();
    ends.extend(contacts.iter().map(|contact| {
        let own = if contact.phase.is_pressed() {
            extrapolated(contact, context.laws, context.step)
        } else {
            OwnImpulse::default()
        };
        ContactEnd {
            touched: false,
            after: *contact,
            own,
        }
    }));
}

#[inline(always)]
fn pair_step<const LAST: bool>(
    context: &StepContext<'_>,
    now: DiskArrays<'_>,
    contact: &Contact,
    slot: &mut ContactEnd,
    sums: &mut StepSums,
) -> Option<ContactImpulse> {
    let pair = contact.bodies();
    let radius_sum = now.radii[pair[0]] + now.radii[pair[1]];
    let is_open = contact.phase == LocatedPhase::Open;
    if is_open {
        let [dx, dy] = now.difference(pair);
        let (va, vb) = (&now.velocities[pair[0]], &now.velocities[pair[1]]);
        let leaving = dx * (va[0] - vb[0]) + dy * (va[1] - vb[1]);
        // Disks that are apart and not further than the step could have brought them may have touched within it.
        let beyond = dx * dx + dy * dy - radius_sum * radius_sum;
        if beyond >= 0.0 && beyond >= context.step * leaving {
            slot.touched = false;
            return None;
        }
    }
    let (start, direction) = if is_open {
        let start = context.start.of_pair(pair);
        (start, start.normal)
    } else {
        (contact.kinematics, contact.direction)
    };
    let mut end = now.of_pair(pair);
    let turn = angle_between(direction, end.normal);
    end.tangential_displacement -= radius_sum * turn;
    let frame = PairFrame::new(&start, &end, context.step, radius_sum);
    let inverse_mass = context.inverse_masses[pair[0]][0] + context.inverse_masses[pair[1]][0];
    let step = ContactStep {
        contact,
        start: &start,
        end: &end,
        own: slot.own,
        inverse_mass,
        frame: &frame,
        step: context.step,
    };
    let given = contact_step::<LAST, _>(&step, context.laws, slot, sums);
    slot.after.direction = direction;
    if turn.abs() > FOLLOWING_ANGLE {
        slot.after.direction = end.normal;
        slot.after.reference += radius_sum * turn;
        slot.after.kinematics.tangential_displacement += radius_sum * turn;
    }
    Some(given)
}

/// Beyond this the remembered direction follows the normal \[rad\].
const FOLLOWING_ANGLE: f64 = 1e-3;

#[inline(always)]
fn wall_step<const LAST: bool>(
    context: &StepContext<'_>,
    now: DiskArrays<'_>,
    contact: &Contact,
    slot: &mut ContactEnd,
    sums: &mut StepSums,
) -> Option<ContactImpulse> {
    let [disk, wall] = contact.bodies();
    let wall = &context.walls[wall];
    let end = now.of_wall(disk, wall, &context.base[1]);
    let is_open = contact.phase == LocatedPhase::Open;
    if is_open && end.overlap <= 0.0 && end.overlap <= context.step * end.closing {
        slot.touched = false;
        return None;
    }
    let start = if is_open {
        context.start.of_wall(disk, wall, &context.base[0])
    } else {
        contact.kinematics
    };
    let frame = WallFrame {
        normal: wall.normal.into(),
        follows_base: wall.follows_base,
        base: context.base,
        step: context.step,
    };
    let inverse_mass = context.inverse_masses[disk][0];
    let step = ContactStep {
        contact,
        start: &start,
        end: &end,
        own: slot.own,
        inverse_mass,
        frame: &frame,
        step: context.step,
    };
    let given = contact_step::<LAST, _>(&step, context.laws, slot, sums);
    slot.after.direction = wall.normal.into();
    Some(given)
}

/// Integrates one contact; `slot` receives what it is afterwards.
#[inline(always)]
fn contact_step<const LAST: bool, F: ContactFrame>(
    step: &ContactStep<'_, F>,
    laws: &Laws,
    slot: &mut ContactEnd,
    sums: &mut StepSums,
) -> ContactImpulse {
    let outcome = match step.within_phase::<LAST>(laws) {
        Some(outcome) => outcome,
        None => {
            sums.changes += 1;
            step.integrate_with_events(laws)
        }
    };
    let (given, end) = (outcome.given, step.end);
    if LAST {
        sums.lost += given.lost;
        sums.work += given.work;
        if end.overlap > 0.0 {
            sums.contacts += 1;
            sums.deepest = if end.overlap > sums.deepest {
                end.overlap
            } else {
                sums.deepest
            };
        }
    }
    slot.touched = true;
    slot.own = given.own;
    slot.after.phase = outcome.phase;
    slot.after.reference = outcome.reference;
    slot.after.closing_rate = outcome.closing_rate;
    slot.after.kinematics = *end;
    given
}

#[inline(always)]
fn add(impulses: &mut [[[f64; 3]; 2]], disk: u32, given: &ContactImpulse, radii: &[f64], side: f64) {
    let radius = radii[disk as usize];
    let [impulse, moment] = &mut impulses[disk as usize];
    impulse[0] += side * given.impulse[0];
    impulse[1] += side * given.impulse[1];
    impulse[2] += radius * given.own.tangential[0];
    moment[0] += side * given.moment[0];
    moment[1] += side * given.moment[1];
    moment[2] += radius * given.own.tangential[1];
}

//! One step: predict, integrate every contact along the motion found so far, correct by what comes out, and again.

use crate::drive::Motion;
use crate::geometry::Wall;

use super::extrapolation::{along_tangent, extrapolated};
use super::frame::{Carried, Frame, Turning};
use super::kinematics::{Disks, angle_between};
use super::laws::Laws;
use super::passage::Passage;
use super::push::{Own, Push};
use super::state::{Contact, Kinematics, Phase};

/// What does not change during a step, and the disks at its start.
#[derive(Clone, Copy)]
pub struct Scenery<'engine> {
    /// Contact laws.
    pub laws: &'engine Laws,
    /// 1/m, 1/m, 1/I of each disk.
    pub inverse_masses: &'engine [[f64; 3]],
    /// Walls.
    pub walls: &'engine [Wall],
    /// Gravity \[m/s2\], downwards.
    pub gravity: f64,
    /// Disks at the start.
    pub start: Disks<'engine>,
    /// Base at the start and at the end.
    pub base: [Motion; 2],
    /// What places and rates at the start are short of by rounding.
    pub remainders: &'engine [[[f64; 3]; 2]],
    /// Length of the step \[s\].
    pub step: f64,
}

/// A contact at the end of the step, as known so far.
#[derive(Debug, Clone, Copy)]
pub struct End {
    /// Whether there is anything to take over: the bodies overlap, or did at the start.
    touched: bool,
    after: Contact,
    own: Own,
}

/// Sums over the contacts of the last pass.
#[derive(Debug, Clone, Copy, Default)]
pub struct Tally {
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
pub struct Work {
    /// Impulse (x, y, angular) on each disk, and first moment of the forces about the end of the step.
    sums: Vec<[[f64; 3]; 2]>,
    /// Places at the end.
    pub places: Vec<[f64; 3]>,
    /// Rates at the end.
    pub rates: Vec<[f64; 3]>,
    /// What both are short of by rounding.
    pub remainders: Vec<[[f64; 3]; 2]>,
    /// Impulses of the walls in this step.
    pub wall_impulses: Vec<[f64; 2]>,
    pair_ends: Vec<End>,
    wall_ends: Vec<End>,
    /// Sums over the contacts.
    pub tally: Tally,
}

impl Work {
    /// Moves all disks to the end of the step by the forces at its start and their rates.
    pub fn predict(&mut self, scenery: &Scenery<'_>, pairs: &[Contact], at_walls: &[Contact]) {
        self.clear(scenery);
        let radii = scenery.start.radii;
        begin(&mut self.pair_ends, pairs, scenery);
        begin(&mut self.wall_ends, at_walls, scenery);
        for (contact, end) in pairs.iter().zip(&self.pair_ends) {
            if contact.phase.is_pressed() {
                let push = along_tangent(contact, end.own, scenery.step);
                give(&mut self.sums, contact.first, &push, radii, 1.0);
                give(&mut self.sums, contact.second, &push, radii, -1.0);
            }
        }
        for (contact, end) in at_walls.iter().zip(&self.wall_ends) {
            if contact.phase.is_pressed() {
                let push = along_tangent(contact, end.own, scenery.step);
                give(&mut self.sums, contact.first, &push, radii, 1.0);
            }
        }
        self.correct(scenery);
    }

    /// Integrates all contacts along the motion found so far and corrects the motion; with `LAST` energies too.
    pub fn refine<const LAST: bool>(&mut self, scenery: &Scenery<'_>, pairs: &[Contact], at_walls: &[Contact]) {
        self.clear(scenery);
        let radii = scenery.start.radii;
        let now = Disks {
            places: &self.places,
            rates: &self.rates,
            radii,
        };
        for (contact, end) in pairs.iter().zip(&mut self.pair_ends) {
            if let Some(push) = pass_pair::<LAST>(scenery, now, contact, end, &mut self.tally) {
                give(&mut self.sums, contact.first, &push, radii, 1.0);
                give(&mut self.sums, contact.second, &push, radii, -1.0);
            }
        }
        for (contact, end) in at_walls.iter().zip(&mut self.wall_ends) {
            if let Some(push) = pass_wall::<LAST>(scenery, now, contact, end, &mut self.tally) {
                give(&mut self.sums, contact.first, &push, radii, 1.0);
                let sum = &mut self.wall_impulses[contact.second as usize];
                sum[0] += push.impulse[0];
                sum[1] += push.impulse[1];
            }
        }
        self.correct(scenery);
    }

    /// Takes over what the contacts are at the end of the step.
    pub fn commit(&self, pairs: &mut [Contact], at_walls: &mut [Contact]) {
        for (contact, end) in pairs.iter_mut().zip(&self.pair_ends) {
            if end.touched {
                *contact = end.after;
            }
        }
        for (contact, end) in at_walls.iter_mut().zip(&self.wall_ends) {
            if end.touched {
                *contact = end.after;
            }
        }
    }

    fn clear(&mut self, scenery: &Scenery<'_>) {
        self.tally = Tally::default();
        self.sums.clear();
        self.sums.resize(scenery.start.places.len(), [[0.0; 3]; 2]);
        self.wall_impulses.clear();
        self.wall_impulses.resize(scenery.walls.len(), [0.0; 2]);
    }

    /// Places and rates at the end from impulses and moments. The sums are compensated: equal steps in a row would else
    /// all be rounded the same way, and short steps drift by half a unit in the last place each.
    fn correct(&mut self, scenery: &Scenery<'_>) {
        self.places.clear();
        self.rates.clear();
        self.remainders.clear();
        let Scenery { step, start, .. } = *scenery;
        let (drop, fall) = (
            [0.0, 0.5 * step * step * scenery.gravity, 0.0],
            [0.0, step * scenery.gravity, 0.0],
        );
        let disks = start.places.iter().zip(start.rates).zip(scenery.remainders);
        let sums = self.sums.iter().zip(scenery.inverse_masses);
        for (((place, rate), [short_place, short_rate]), ([impulse, moment], inverse)) in disks.zip(sums) {
            let moved: [(f64, f64); 3] = std::array::from_fn(|i| {
                let exact_rate = step * rate[i] + step * short_rate[i];
                compensated(
                    place[i],
                    short_place[i] + (moment[i] * inverse[i] - drop[i]) + exact_rate,
                )
            });
            let sped: [(f64, f64); 3] =
                std::array::from_fn(|i| compensated(rate[i], short_rate[i] + (impulse[i] * inverse[i] - fall[i])));
            self.places.push(moved.map(|(sum, _)| sum));
            self.rates.push(sped.map(|(sum, _)| sum));
            self.remainders
                .push([moved.map(|(_, short)| short), sped.map(|(_, short)| short)]);
        }
    }
}

/// Sum of two numbers, the first the larger or near it, and what rounding took from it (Kahan 1965).
#[inline(always)]
fn compensated(sum: f64, term: f64) -> (f64, f64) {
    let next = sum + term;
    (next, term - (next - sum))
}

/// Bodies that overlap at the start of a run have just touched: their skins are not stretched.
pub fn close_overlapping(scenery: &Scenery<'_>, pairs: &mut [Contact], at_walls: &mut [Contact]) {
    let start = scenery.start;
    let close = |contact: &mut Contact, kinematics: Kinematics| {
        if kinematics.overlap <= 0.0 {
            return;
        }
        let pressed = scenery.laws.normal_force(kinematics.overlap, kinematics.closing) > 0.0;
        contact.phase = match pressed {
            true if scenery.laws.grips() => Phase::Stick,
            true => Phase::SlipForward,
            false => Phase::Unpressed,
        };
        contact.direction = kinematics.normal;
        contact.reference = kinematics.surface;
        contact.kinematics = kinematics;
    };
    for contact in pairs {
        let pair = (contact.first as usize, contact.second as usize);
        close(contact, start.of_pair(pair));
    }
    for contact in at_walls {
        let wall = &scenery.walls[contact.second as usize];
        let kinematics = start.of_wall(contact.first as usize, wall, &scenery.base[0]);
        close(contact, kinematics);
    }
}

/// Own impulses of all contacts by the force that goes on along its tangent.
fn begin(ends: &mut Vec<End>, contacts: &[Contact], scenery: &Scenery<'_>) {
    ends.clear();
    ends.extend(contacts.iter().map(|contact| {
        let own = if contact.phase.is_pressed() {
            extrapolated(contact, scenery.laws, scenery.step)
        } else {
            Own::default()
        };
        End {
            touched: false,
            after: *contact,
            own,
        }
    }));
}

#[inline(always)]
fn pass_pair<const LAST: bool>(
    scenery: &Scenery<'_>,
    now: Disks<'_>,
    contact: &Contact,
    slot: &mut End,
    tally: &mut Tally,
) -> Option<Push> {
    let pair = (contact.first as usize, contact.second as usize);
    let reach = now.radii[pair.0] + now.radii[pair.1];
    let is_open = contact.phase == Phase::Open;
    if is_open {
        let [dx, dy] = now.difference(pair);
        let (va, vb) = (&now.rates[pair.0], &now.rates[pair.1]);
        let leaving = dx * (va[0] - vb[0]) + dy * (va[1] - vb[1]);
        // Disks that are apart and not further than the step could have brought them may have touched within it.
        let beyond = dx * dx + dy * dy - reach * reach;
        if beyond >= 0.0 && beyond >= scenery.step * leaving {
            slot.touched = false;
            return None;
        }
    }
    let (start, direction) = if is_open {
        let start = scenery.start.of_pair(pair);
        (start, start.normal)
    } else {
        (contact.kinematics, contact.direction)
    };
    let mut end = now.of_pair(pair);
    let turn = angle_between(direction, end.normal);
    end.surface -= reach * turn;
    let frame = Turning::new(&start, &end, scenery.step, reach);
    let mobility = scenery.inverse_masses[pair.0][0] + scenery.inverse_masses[pair.1][0];
    let push = pass::<LAST, _>(scenery, contact, (&start, &end), (&frame, mobility), slot, tally);
    slot.after.direction = direction;
    if turn.abs() > FOLLOWING_ANGLE {
        slot.after.direction = end.normal;
        slot.after.reference += reach * turn;
        slot.after.kinematics.surface += reach * turn;
    }
    Some(push)
}

/// Beyond this the remembered direction follows the normal \[rad\].
const FOLLOWING_ANGLE: f64 = 1e-3;

#[inline(always)]
fn pass_wall<const LAST: bool>(
    scenery: &Scenery<'_>,
    now: Disks<'_>,
    contact: &Contact,
    slot: &mut End,
    tally: &mut Tally,
) -> Option<Push> {
    let (disk, wall) = (contact.first as usize, &scenery.walls[contact.second as usize]);
    let end = now.of_wall(disk, wall, &scenery.base[1]);
    let is_open = contact.phase == Phase::Open;
    if is_open && end.overlap <= 0.0 && end.overlap <= scenery.step * end.closing {
        slot.touched = false;
        return None;
    }
    let start = if is_open {
        scenery.start.of_wall(disk, wall, &scenery.base[0])
    } else {
        contact.kinematics
    };
    let frame = Carried {
        normal: wall.normal.into(),
        follows_base: wall.follows_base,
        base: scenery.base,
        step: scenery.step,
    };
    let mobility = scenery.inverse_masses[disk][0];
    let push = pass::<LAST, _>(scenery, contact, (&start, &end), (&frame, mobility), slot, tally);
    slot.after.direction = wall.normal.into();
    Some(push)
}

/// One contact between `start` and `end`; `slot` has what it is afterwards.
#[inline(always)]
fn pass<const LAST: bool, F: Frame>(
    scenery: &Scenery<'_>,
    contact: &Contact,
    (start, end): (&Kinematics, &Kinematics),
    (frame, mobility): (&F, f64),
    slot: &mut End,
    tally: &mut Tally,
) -> Push {
    let passage = Passage {
        start,
        end,
        phase: contact.phase,
        reference: contact.reference,
        own: slot.own,
        mobility,
        frame,
        step: scenery.step,
    };
    let outcome = match passage.within_phase::<LAST>(scenery.laws) {
        Some(outcome) => outcome,
        None => {
            tally.changes += 1;
            passage.in_pieces(scenery.laws)
        }
    };
    let push = outcome.push;
    if LAST {
        tally.lost += push.lost;
        tally.work += push.work;
        if end.overlap > 0.0 {
            tally.contacts += 1;
            tally.deepest = if end.overlap > tally.deepest {
                end.overlap
            } else {
                tally.deepest
            };
        }
    }
    slot.touched = true;
    slot.own = push.own;
    slot.after.phase = outcome.phase;
    slot.after.reference = outcome.reference;
    slot.after.closing_rate = outcome.closing_rate;
    slot.after.kinematics = *end;
    push
}

#[inline(always)]
fn give(sums: &mut [[[f64; 3]; 2]], disk: u32, push: &Push, radii: &[f64], side: f64) {
    let radius = radii[disk as usize];
    let [impulse, moment] = &mut sums[disk as usize];
    impulse[0] += side * push.impulse[0];
    impulse[1] += side * push.impulse[1];
    impulse[2] += radius * push.own.tangential[0];
    moment[0] += side * push.moment[0];
    moment[1] += side * push.moment[1];
    moment[2] += radius * push.own.tangential[1];
}

//! One step: predict, then integrate every contact along the motion found so far, and correct by what comes out.

use crate::drive::Motion;
use crate::geometry::Wall;

use super::frame::{Carried, Turning};
use super::passage::{Laws, Outcome, Own, Passage, Push};
use super::state::{Contact, Kinematics, Phase};

/// What does not change during a step.
pub struct Scenery<'engine> {
    /// Contact laws.
    pub laws: &'engine Laws,
    /// Radii \[m\].
    pub radii: &'engine [f64],
    /// 1/m, 1/m, 1/I of each disk.
    pub inverse_masses: &'engine [[f64; 3]],
    /// Walls.
    pub walls: &'engine [Wall],
    /// Gravity \[m/s2\], downwards.
    pub gravity: f64,
}

/// A contact at the end of the step, as known so far.
#[derive(Debug, Clone, Copy)]
pub struct End {
    kinematics: Kinematics,
    outcome: Outcome,
    direction: [f64; 2],
    own: Own,
}

/// Impulses and moments of one step, and the motion at its end. Scratch memory: nothing outlives the step.
#[derive(Debug, Clone, Default)]
pub struct Work {
    /// Impulse (x, y, angular) on each disk.
    impulse: Vec<[f64; 3]>,
    /// First moment of the forces about the end of the step.
    moment: Vec<[f64; 3]>,
    /// Places at the end.
    pub places: Vec<[f64; 3]>,
    /// Rates at the end.
    pub rates: Vec<[f64; 3]>,
    /// Impulses of the walls in this step.
    pub wall_impulses: Vec<[f64; 2]>,
    pairs: Vec<Option<End>>,
    at_walls: Vec<Option<End>>,
    /// Sums over the contacts.
    pub tally: Tally,
}

/// Sums over the contacts of one pass.
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
    pub events: u32,
}

/// Places and rates of all disks.
#[derive(Clone, Copy)]
pub struct Disks<'a> {
    /// x, y, angle.
    pub places: &'a [[f64; 3]],
    /// Their rates.
    pub rates: &'a [[f64; 3]],
}

impl Tally {
    #[inline(always)]
    fn add(&mut self, push: &Push, overlap: f64) {
        self.lost += push.dissipated + push.slip_heat;
        self.work += push.work;
        if overlap > 0.0 {
            self.contacts += 1;
            self.deepest = if overlap > self.deepest { overlap } else { self.deepest };
        }
    }
}

/// Relative motion of two disks, lambda counted from `direction`.
#[inline(always)]
fn of_pair(disks: Disks<'_>, radii: &[f64], (i, j): (usize, usize), difference: [f64; 2], distance: f64) -> Kinematics {
    let reach = radii[i] + radii[j];
    let inverse = 1.0 / distance;
    let (nx, ny) = (difference[0] * inverse, difference[1] * inverse);
    let (va, vb) = (&disks.rates[i], &disks.rates[j]);
    let (ux, uy) = (va[0] - vb[0], va[1] - vb[1]);
    let sideways = ux * ny - uy * nx;
    let lever = reach * inverse;
    Kinematics {
        overlap: reach - distance,
        closing: -(ux * nx + uy * ny),
        surface: radii[i] * disks.places[i][2] + radii[j] * disks.places[j][2],
        sliding: sideways * lever + radii[i] * va[2] + radii[j] * vb[2],
        normal: [nx, ny],
        turning: -sideways * inverse,
        lever,
    }
}

/// Relative motion of a disk and a wall.
#[inline(always)]
fn of_wall(disks: Disks<'_>, radius: f64, disk: usize, wall: &Wall, base: &Motion) -> Kinematics {
    let ([x, y, angle], [vx, vy, spin]) = (disks.places[disk], disks.rates[disk]);
    let (y, vy) = (
        y - wall.follows_base * base.displacement,
        vy - wall.follows_base * base.velocity,
    );
    let ([nx, ny], [tx, ty]) = (wall.normal, wall.tangent());
    Kinematics {
        overlap: radius - (nx * x + ny * y - wall.offset),
        closing: -(nx * vx + ny * vy),
        surface: radius * angle + tx * x + ty * y,
        sliding: tx * vx + ty * vy + radius * spin,
        normal: wall.normal,
        turning: 0.0,
        lever: 1.0,
    }
}

/// Angle \[rad\] from `direction` to `normal`, counter-clockwise.
#[inline(always)]
fn angle_between(direction: [f64; 2], normal: [f64; 2]) -> f64 {
    let sine = direction[0] * normal[1] - direction[1] * normal[0];
    if sine.abs() < 0.002 {
        let square = sine * sine;
        return sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0)));
    }
    sine.atan2(direction[0] * normal[0] + direction[1] * normal[1])
}

/// Force of a pressed contact at the start of a step, and its rate: (N, N', tau, tau').
#[inline(always)]
fn start_force(contact: &Contact, laws: &Laws) -> [f64; 4] {
    let start = &contact.start;
    let force = laws.normal_force(start.overlap, start.closing);
    let rate = laws.normal_force(start.closing, contact.closing_rate);
    match contact.phase.slip_sense() {
        Some(sense) => {
            let share = if laws.has_skin() { -sense * laws.skin.friction } else { 0.0 };
            [force, rate, share * force, share * rate]
        }
        None => {
            let stretch = start.surface - contact.reference;
            [force, rate, laws.skin.force(stretch), laws.skin.force(start.sliding)]
        }
    }
}

/// Impulse and moment of the force that goes on from the start of a step along its tangent.
#[inline(always)]
fn extrapolated([force, rate, tangential, tangential_rate]: [f64; 4], step: f64) -> Own {
    let integrals = |force: f64, rate: f64| {
        [
            step * (force + 0.5 * step * rate),
            0.5 * step * step * (force + step * rate / 3.0),
        ]
    };
    Own {
        normal: integrals(force, rate),
        tangential: integrals(tangential, tangential_rate),
    }
}

impl Work {
    /// Moves all disks to the end of the step by the forces at its start and their rates.
    pub fn predict(&mut self, scenery: &Scenery<'_>, disks: Disks<'_>, pairs: &[Contact], at_walls: &[Contact], step: f64) {
        self.clear(disks.places.len(), scenery.walls.len());
        for contact in pairs.iter().filter(|contact| contact.phase.is_pressed()) {
            let (i, j) = (contact.first as usize, contact.second as usize);
            let own = extrapolated(start_force(contact, scenery.laws), step);
            let push = turned(contact, &own, step);
            self.give(i, &push, scenery.radii[i], 1.0);
            self.give(j, &push, scenery.radii[j], -1.0);
        }
        for contact in at_walls.iter().filter(|contact| contact.phase.is_pressed()) {
            let i = contact.first as usize;
            let own = extrapolated(start_force(contact, scenery.laws), step);
            let push = turned(contact, &own, step);
            self.give(i, &push, scenery.radii[i], 1.0);
        }
        self.correct(scenery, disks, step);
    }

    /// Integrates all contacts along the motion found so far and corrects the motion.
    pub fn refine(
        &mut self,
        scenery: &Scenery<'_>,
        disks: Disks<'_>,
        (pairs, at_walls): (&[Contact], &[Contact]),
        base: [Motion; 2],
        (step, first): (f64, bool),
    ) {
        self.clear(disks.places.len(), scenery.walls.len());
        if first {
            self.pairs.clear();
            self.pairs.resize(pairs.len(), None);
            self.at_walls.clear();
            self.at_walls.resize(at_walls.len(), None);
        }
        let mut ends = std::mem::take(&mut self.pairs);
        for (contact, end) in pairs.iter().zip(&mut ends) {
            self.pass_pair(scenery, disks, contact, end, step);
        }
        self.pairs = ends;
        let mut ends = std::mem::take(&mut self.at_walls);
        for (contact, end) in at_walls.iter().zip(&mut ends) {
            self.pass_wall(scenery, disks, contact, end, (base, step));
        }
        self.at_walls = ends;
        self.correct(scenery, disks, step);
    }

    #[inline(always)]
    fn pass_pair(&mut self, scenery: &Scenery<'_>, disks: Disks<'_>, contact: &Contact, slot: &mut Option<End>, step: f64) {
        let (i, j) = (contact.first as usize, contact.second as usize);
        let radii = scenery.radii;
        let reach = radii[i] + radii[j];
        let is_open = contact.phase == Phase::Open;
        let difference = |places: &[[f64; 3]]| [places[i][0] - places[j][0], places[i][1] - places[j][1]];
        let at_end = difference(&self.places);
        let squared = at_end[0] * at_end[0] + at_end[1] * at_end[1];
        if is_open && squared >= reach * reach {
            *slot = None;
            return;
        }
        let (start, direction) = if is_open {
            let at_start = difference(disks.places);
            let start = of_pair(disks, radii, (i, j), at_start, at_start[0].hypot(at_start[1]));
            (start, start.normal)
        } else {
            (contact.start, contact.direction)
        };
        let now = Disks {
            places: &self.places,
            rates: &self.rates,
        };
        let mut kinematics = of_pair(now, radii, (i, j), at_end, squared.sqrt());
        kinematics.surface -= reach * angle_between(direction, kinematics.normal);
        let own = own_so_far(slot, contact, scenery.laws, step);
        let frame = Turning::new(&start, &kinematics, step, reach);
        let passage = Passage {
            start: &start,
            end: &kinematics,
            phase: contact.phase,
            reference: contact.reference,
            own,
            mobility: scenery.inverse_masses[i][0] + scenery.inverse_masses[j][0],
            frame: &frame,
            step,
        };
        let outcome = match passage.within_phase(scenery.laws) {
            Some(outcome) => outcome,
            None => {
                self.tally.events += 1;
                passage.in_pieces(scenery.laws)
            }
        };
        self.give(i, &outcome.push, radii[i], 1.0);
        self.give(j, &outcome.push, radii[j], -1.0);
        self.tally.add(&outcome.push, kinematics.overlap);
        *slot = Some(End {
            own: outcome.push.own,
            kinematics,
            outcome,
            direction,
        });
    }

    #[inline(always)]
    fn pass_wall(
        &mut self,
        scenery: &Scenery<'_>,
        disks: Disks<'_>,
        contact: &Contact,
        slot: &mut Option<End>,
        (base, step): ([Motion; 2], f64),
    ) {
        let (i, index) = (contact.first as usize, contact.second as usize);
        let (radius, wall) = (scenery.radii[i], &scenery.walls[index]);
        let now = Disks {
            places: &self.places,
            rates: &self.rates,
        };
        let kinematics = of_wall(now, radius, i, wall, &base[1]);
        let is_open = contact.phase == Phase::Open;
        if is_open && kinematics.overlap <= 0.0 {
            *slot = None;
            return;
        }
        let start = if is_open { of_wall(disks, radius, i, wall, &base[0]) } else { contact.start };
        let own = own_so_far(slot, contact, scenery.laws, step);
        let frame = Carried {
            normal: wall.normal,
            follows_base: wall.follows_base,
            base,
            step,
        };
        let passage = Passage {
            start: &start,
            end: &kinematics,
            phase: contact.phase,
            reference: contact.reference,
            own,
            mobility: scenery.inverse_masses[i][0],
            frame: &frame,
            step,
        };
        let outcome = match passage.within_phase(scenery.laws) {
            Some(outcome) => outcome,
            None => {
                self.tally.events += 1;
                passage.in_pieces(scenery.laws)
            }
        };
        self.give(i, &outcome.push, radius, 1.0);
        for (sum, part) in self.wall_impulses[index].iter_mut().zip(outcome.push.impulse) {
            *sum += part;
        }
        self.tally.add(&outcome.push, kinematics.overlap);
        *slot = Some(End {
            own: outcome.push.own,
            kinematics,
            outcome,
            direction: wall.normal,
        });
    }

    /// Takes over what the contacts are at the end of the step.
    pub fn commit(&self, radii: &[f64], pairs: &mut [Contact], at_walls: &mut [Contact]) {
        for (contact, end) in pairs.iter_mut().zip(&self.pairs) {
            let Some(end) = end else {
                continue;
            };
            let reach = radii[contact.first as usize] + radii[contact.second as usize];
            end.take_over(contact, reach);
        }
        for (contact, end) in at_walls.iter_mut().zip(&self.at_walls) {
            if let Some(end) = end {
                end.take_over(contact, 0.0);
            }
        }
    }

    fn clear(&mut self, disks: usize, walls: usize) {
        self.tally = Tally::default();
        for sums in [&mut self.impulse, &mut self.moment] {
            sums.clear();
            sums.resize(disks, [0.0; 3]);
        }
        self.wall_impulses.clear();
        self.wall_impulses.resize(walls, [0.0; 2]);
    }

    #[inline(always)]
    fn give(&mut self, disk: usize, push: &Push, radius: f64, side: f64) {
        let sum = &mut self.impulse[disk];
        sum[0] += side * push.impulse[0];
        sum[1] += side * push.impulse[1];
        sum[2] += radius * push.own.tangential[0];
        let sum = &mut self.moment[disk];
        sum[0] += side * push.moment[0];
        sum[1] += side * push.moment[1];
        sum[2] += radius * push.own.tangential[1];
    }

    /// Places and rates at the end from impulses and moments.
    fn correct(&mut self, scenery: &Scenery<'_>, disks: Disks<'_>, step: f64) {
        self.places.clear();
        self.rates.clear();
        let fall = scenery.gravity * step;
        for (disk, (place, rate)) in disks.places.iter().zip(disks.rates).enumerate() {
            let (impulse, moment, inverse) = (
                &self.impulse[disk],
                &self.moment[disk],
                &scenery.inverse_masses[disk],
            );
            let moved = |axis: usize| place[axis] + (step * rate[axis] + moment[axis] * inverse[axis]);
            let sped = |axis: usize| rate[axis] + impulse[axis] * inverse[axis];
            self.places.push([moved(0), moved(1) - 0.5 * step * fall, moved(2)]);
            self.rates.push([sped(0), sped(1) - fall, sped(2)]);
        }
    }
}

/// Bodies that overlap at the start of a run have just touched: their skins are not stretched.
pub fn close_overlapping(scenery: &Scenery<'_>, disks: Disks<'_>, pairs: &mut [Contact], at_walls: &mut [Contact], base: &Motion) {
    let radii = scenery.radii;
    let close = |contact: &mut Contact, kinematics: Kinematics| {
        if kinematics.overlap <= 0.0 || contact.phase != Phase::Open {
            return;
        }
        let pressed = scenery.laws.normal_force(kinematics.overlap, kinematics.closing) > 0.0;
        contact.phase = if pressed { Phase::Stick } else { Phase::Unpressed };
        contact.direction = kinematics.normal;
        contact.reference = kinematics.surface;
        contact.start = kinematics;
        contact.closing_rate = 0.0;
    };
    for contact in pairs {
        let (i, j) = (contact.first as usize, contact.second as usize);
        let difference = [disks.places[i][0] - disks.places[j][0], disks.places[i][1] - disks.places[j][1]];
        let distance = (difference[0] * difference[0] + difference[1] * difference[1]).sqrt();
        close(contact, of_pair(disks, radii, (i, j), difference, distance));
    }
    for contact in at_walls {
        let disk = contact.first as usize;
        let wall = &scenery.walls[contact.second as usize];
        close(contact, of_wall(disks, radii[disk], disk, wall, base));
    }
}

fn own_so_far(slot: &Option<End>, contact: &Contact, laws: &Laws, step: f64) -> Own {
    match slot {
        Some(end) => end.own,
        None if contact.phase.is_pressed() => extrapolated(start_force(contact, laws), step),
        None => Own::default(),
    }
}

/// The extrapolated force along the normal as it turns.
#[inline(always)]
fn turned(contact: &Contact, own: &Own, step: f64) -> Push {
    let start = &contact.start;
    let [nx, ny] = start.normal;
    let vector = |normal: f64, tangential: f64| {
        let sideways = tangential * start.lever;
        [normal * nx + sideways * ny, normal * ny - sideways * nx]
    };
    let mut push = Push {
        impulse: vector(own.normal[0], own.tangential[0]),
        moment: vector(own.normal[1], own.tangential[1]),
        own: *own,
        ..Push::default()
    };
    // The force turns with the normal: to first order by half the angle of the step in the impulse, a third in the
    // moment.
    let turn = step * start.turning;
    let rotate = |[x, y]: [f64; 2], angle: f64| [x - angle * y, y + angle * x];
    push.impulse = rotate(push.impulse, 0.5 * turn);
    push.moment = rotate(push.moment, turn / 3.0);
    push
}

impl End {
    fn take_over(&self, contact: &mut Contact, reach: f64) {
        contact.phase = self.outcome.phase;
        contact.direction = self.direction;
        contact.reference = self.outcome.reference;
        contact.start = self.kinematics;
        contact.closing_rate = self.outcome.closing_rate;
        let turn = angle_between(contact.direction, contact.start.normal);
        if reach > 0.0 && turn.abs() > 0.001 {
            contact.direction = contact.start.normal;
            contact.reference += reach * turn;
            contact.start.surface += reach * turn;
        }
    }
}

//! One disk on two supports: time in, motion and contact forces out; exact from event to event.
//!
//! Needs: a setup and an excitation. Guarantees: the trajectory lives on a grid of time of its own and does not depend on
//! where it is advanced to or looked at; phases of the contacts change at the instant that the equations give, to
//! rounding, so that the order of the Runge-Kutta step survives them; mirrored data give mirrored bits.
//! Not here: names, ranges and units of parameters (`scene::three_disk`).

mod cell;
pub mod contact;
pub mod dynamics;
mod equilibrium;
mod runge_kutta;
pub mod state;
pub mod support;
mod time_step;

use crate::drive::excitation::{Excitation, Piece, SupportMotion};

pub use cell::Stuck;
use cell::{Cell, Course};
pub use contact::{Contact, Phase, Sense};
pub use dynamics::{Bench, LOST, Look, Setup, WORK};
pub use equilibrium::{NoEquilibrium, equilibrium};
pub use runge_kutta::Vector;
pub use state::{Node, Record, SlidingPoint, State};
pub use support::Frame;
pub use time_step::TimeStepLimits;

/// Angle \[rad\] beyond which the disk's angle is counted anew, so that stretches of the skins keep their digits.
const RECOUNT: f64 = 1e-2;

/// A disk on two supports, driven by E.
#[derive(Debug)]
pub struct ThreeDisk<E> {
    setup: Setup,
    state: State<E>,
    /// The present cell, as far as it has been computed.
    course: Course,
}

impl<E: Excitation> ThreeDisk<E> {
    /// A disk at `start_time` \[s\] with its skins not stretched, in these positions and rates.
    pub fn new(setup: Setup, excitation: E, start_time: f64, place: [f64; 3], rates: [f64; 3]) -> Self {
        let mut disk = Vector::default();
        disk[..3].copy_from_slice(&place);
        disk[3..6].copy_from_slice(&rates);
        let apart = Contact {
            phase: Phase::Apart,
            unstretched: 0.0,
        };
        let mut start = Node {
            offset: 0.0,
            disk,
            turned: 0.0,
            contacts: [apart; 2],
            record: Record::default(),
        };
        let cell = Cell {
            setup: &setup,
            piece: excitation.piece(start_time),
            start: start_time,
        };
        let look = cell.look(0.0, &disk, &start.contacts);
        start.contacts = look.contacts.map(|force| Contact {
            phase: if force.overlap > 0.0 && force.push > 0.0 {
                Phase::Stick
            } else if force.overlap > 0.0 {
                Phase::Relaxing
            } else {
                Phase::Apart
            },
            unstretched: force.slide,
        });
        Self {
            setup,
            state: State {
                origin: start_time,
                cell: 0,
                start,
                time: start_time,
                now: start,
                excitation,
            },
            course: Course::default(),
        }
    }

    /// What stays fixed.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Everything that changes.
    pub fn state(&self) -> &State<E> {
        &self.state
    }

    /// Whether `state` at `time` \[s\] can be one of a disk on this grid of time.
    pub fn fits(&self, state: &State<E>, time: f64) -> bool {
        let step = self.setup.time_step;
        let cell_start = state.origin + state.cell as f64 * step;
        let within = state.time - cell_start;
        let rounding = 1e-9 * step + 4.0 * f64::EPSILON * (state.time.abs() + state.origin.abs());
        let nodes = state.start.is_sane() && state.now.is_sane() && state.start.offset == 0.0;
        let in_cell = (-rounding..=step + rounding).contains(&within) && (within - state.now.offset).abs() <= rounding;
        state.time == time && state.origin.is_finite() && nodes && in_cell && state.excitation.is_sane()
    }

    /// Goes to a state of this same disk.
    pub fn restore(&mut self, state: &State<E>) {
        self.state = state.clone();
        self.course.end = None;
    }

    /// Changes what drives the disk from now on. If `change` says that it did, a new grid of time starts here.
    pub fn steer(&mut self, change: impl FnOnce(&mut E) -> bool) {
        let mut excitation = self.state.excitation.clone();
        if !change(&mut excitation) {
            return;
        }
        let now = Node {
            offset: 0.0,
            ..self.state.now
        };
        self.state = State {
            origin: self.state.time,
            cell: 0,
            start: recounted(now, self.setup.radius),
            now,
            excitation,
            ..self.state
        };
        self.course.end = None;
    }

    /// Advances to `end_time` \[s\] or, if `stop` says so, to the first event after the present time and not after
    /// `end_time`; says whether an event ended it.
    ///
    /// # Errors
    /// Events follow each other without end. The state is then of no use.
    pub fn advance(&mut self, end_time: f64, stop: bool) -> Result<bool, Stuck> {
        // Stopped there by an event, it has it behind it; a look would have to decide anew, to rounding.
        if end_time == self.state.time {
            return Ok(false);
        }
        loop {
            let cell_start = self.cell_start(0);
            let next_start = self.cell_start(1);
            let looks_only = end_time < next_start;
            if looks_only && !stop && end_time == cell_start {
                self.state.now = self.state.start;
                break;
            }
            let end = self.course(cell_start)?;
            if stop {
                if let Some(node) = self.pending(cell_start) {
                    self.state.now = node;
                    self.state.time = self.state.time.next_up();
                    return Ok(true);
                }
                let mut times = self.course.events.iter().map(|node| cell_start + node.offset);
                let next = times.find(|time| *time > self.state.time);
                let event = next.filter(|time| *time <= end_time);
                if let Some((time, node)) = event.and_then(|time| Some((time, self.last_event_at(cell_start, time)?))) {
                    self.state.time = time;
                    self.state.now = node;
                    return Ok(true);
                }
            }
            if looks_only {
                self.state.now = self.within(cell_start, end_time);
                break;
            }
            self.state.cell += 1;
            self.state.start = recounted(Node { offset: 0.0, ..end }, self.setup.radius);
            self.state.excitation.next_cell();
            self.course.end = None;
        }
        self.state.time = end_time;
        Ok(false)
    }

    /// The disk after the last event of the present cell that falls on `time` \[s\], to rounding of time: of two contacts
    /// that change together neither is left behind.
    fn last_event_at(&self, cell_start: f64, time: f64) -> Option<Node> {
        let mut events = self.course.events.iter().rev();
        events.find(|node| cell_start + node.offset == time).copied()
    }

    /// The disk after an event that falls on the present time but has not happened yet: the second contact, if what drives
    /// the disk was changed when the first one did. Told one bit of time later than it is, since time must go on.
    fn pending(&self, cell_start: f64) -> Option<Node> {
        let last = self.last_event_at(cell_start, self.state.time);
        last.filter(|node| node.contacts != self.state.now.contacts)
    }

    /// Start \[s\] of the cell that is `ahead` of the present one.
    fn cell_start(&self, ahead: u64) -> f64 {
        self.state.origin + (self.state.cell + ahead) as f64 * self.setup.time_step
    }

    fn cell(&self, start: f64) -> Cell<'_, E::Piece> {
        Cell {
            setup: &self.setup,
            piece: self.state.excitation.piece(start),
            start,
        }
    }

    /// Computes the present cell if it has not been, and gives its end.
    fn course(&mut self, start: f64) -> Result<Node, Stuck> {
        if let Some(end) = self.course.end {
            return Ok(end);
        }
        let cell = Cell {
            setup: &self.setup,
            piece: self.state.excitation.piece(start),
            start,
        };
        cell.run(&self.state.start, self.setup.time_step, &mut self.course)
    }

    /// The disk at `time` \[s\] inside the present cell, whose course is known.
    fn within(&self, start: f64, time: f64) -> Node {
        let offset = time - start;
        let passed = self.course.events.iter().rev().find(|node| node.offset <= offset);
        self.cell(start).fly(passed.unwrap_or(&self.state.start), offset)
    }

    /// Forces and accelerations at the time reached.
    pub fn look(&self) -> Look {
        let now = &self.state.now;
        self.cell(self.cell_start(0)).look(now.offset, &now.disk, &now.contacts)
    }

    /// Torque and motion of the supports at the time reached.
    pub fn driven(&self) -> (f64, [SupportMotion; 2]) {
        let (piece, offset) = (self.cell(self.cell_start(0)).piece, self.state.now.offset);
        (piece.torque(offset), piece.supports(offset))
    }
}

/// The same disk with its angle counted from where it is now, if it has turned far.
fn recounted(mut node: Node, radius: f64) -> Node {
    let angle = node.disk[2];
    if angle.abs() > RECOUNT {
        node.turned += angle;
        node.disk[2] = 0.0;
        for contact in &mut node.contacts {
            contact.unstretched -= radius * angle;
        }
    }
    node
}

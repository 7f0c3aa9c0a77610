//! One disk on two supports: time in, motion and contact forces out; exact from event to event.
//!
//! Needs: a setup and an excitation. Guarantees: the trajectory lives on its own grid of times and does not depend on the
//! times to which it is advanced or at which it is observed; phases of the contacts change at the instant that the
//! equations give, to rounding, so that the order of the Runge-Kutta step survives them; mirrored data give mirrored bits.
//! Not here: names, ranges and units of parameters (`scene::disk_on_two_supports`).

pub mod contact;
pub mod dynamics;
mod equilibrium;
mod runge_kutta;
pub mod state;
pub mod support;
mod time_step;
mod time_step_limits;

use super::{Engine, WorkBudget};
use crate::drive::excitation::{Excitation, Piece, SupportMotion};

pub use contact::{Contact, ContactPhase, Sense};
pub use dynamics::{ENERGY_INPUT, ENERGY_LOST, TwoSupportsObservables, TwoSupportsRig, TwoSupportsSetup};
pub use equilibrium::{NoEquilibrium, equilibrium};
pub use runge_kutta::Vector;
pub use state::{Node, Record, SlidingPoint, TwoSupportsState};
pub use support::SupportFrame;
pub use time_step::TwoSupportsStop;
use time_step::{StepEvents, TimeStep};
pub use time_step_limits::TimeStepLimits;

/// Angle \[rad\] beyond which the disk's angle is counted anew, so that stretches of the springs keep their digits.
const RECOUNT: f64 = 1e-2;

/// Work of a time step, in units of [`WorkBudget`].
const WORK_OF_STEP: f64 = 10.0;

/// A disk on two supports, driven by E.
#[derive(Debug)]
pub struct DiskOnTwoSupports<E> {
    setup: TwoSupportsSetup,
    state: TwoSupportsState<E>,
    /// The present time step, if it has been computed.
    events: StepEvents,
}

impl<E: Excitation> DiskOnTwoSupports<E> {
    /// A disk at `start_time` \[s\] with its tangential springs not stretched, at this position (x, y, angle) with these rates.
    pub fn new(setup: TwoSupportsSetup, excitation: E, start_time: f64, place: [f64; 3], rates: [f64; 3]) -> Self {
        let mut disk = Vector::default();
        disk[..3].copy_from_slice(&place);
        disk[3..6].copy_from_slice(&rates);
        let apart = Contact {
            phase: ContactPhase::Apart,
            unstretched: 0.0,
        };
        let mut start = Node {
            offset: 0.0,
            disk,
            angle_offset: 0.0,
            contacts: [apart; 2],
            record: Record::default(),
        };
        let step = TimeStep {
            setup: &setup,
            piece: excitation.piece(start_time),
            start: start_time,
        };
        let observed = step.observe(0.0, &disk, &start.contacts);
        start.contacts = observed.contacts.map(|force| Contact {
            phase: if force.overlap > 0.0 && force.push > 0.0 {
                ContactPhase::Stick
            } else if force.overlap > 0.0 {
                ContactPhase::Relaxing
            } else {
                ContactPhase::Apart
            },
            unstretched: force.tangential_displacement,
        });
        Self {
            setup,
            state: TwoSupportsState {
                origin: start_time,
                step: 0,
                start,
                time: start_time,
                now: start,
                excitation,
            },
            events: StepEvents::new(),
        }
    }

    /// What stays fixed.
    pub fn setup(&self) -> &TwoSupportsSetup {
        &self.setup
    }

    /// Continues from a state of this same disk.
    pub fn resume(&mut self, state: &TwoSupportsState<E>) {
        self.state = state.clone();
        self.events.end = None;
    }

    /// Takes the work of advancing to `end_time` \[s\] off `budget`.
    ///
    /// # Errors
    /// The budget is too small.
    pub fn spend(&self, end_time: f64, budget: &mut WorkBudget) -> Result<(), TwoSupportsStop> {
        let time = self.state.time;
        let steps = (end_time - time) / self.setup.time_step;
        if budget.spend((steps * WORK_OF_STEP) as u64) {
            Ok(())
        } else {
            Err(TwoSupportsStop::TooManySteps { time, steps })
        }
    }

    /// Changes what drives the disk from now on. If `change` says that this changes the drive in the present cell, a new grid of
    /// times starts here.
    pub fn steer(&mut self, change: impl FnOnce(&mut E) -> bool) {
        let mut excitation = self.state.excitation.clone();
        if !change(&mut excitation) {
            self.state.excitation = excitation;
            return;
        }
        let now = Node {
            offset: 0.0,
            ..self.state.now
        };
        self.state = TwoSupportsState {
            origin: self.state.time,
            step: 0,
            start: recounted(now, self.setup.radius),
            now,
            excitation,
            ..self.state
        };
        self.events.end = None;
    }

    /// Advances to `end_time` \[s\] or, if `stop` says so, to the first event after the present time and not after
    /// `end_time`; says whether an event ended it.
    ///
    /// # Errors
    /// Events follow each other without end. The state is then of no use.
    pub fn advance(&mut self, end_time: f64, stop: bool) -> Result<bool, TwoSupportsStop> {
        // Stopped there by an event, it has it behind it; an observation would have to decide anew, to rounding.
        if end_time == self.state.time {
            return Ok(false);
        }
        loop {
            let (start, next_start) = (self.step_start(0), self.step_start(1));
            let ends_within = end_time < next_start;
            if ends_within && !stop && end_time == start {
                self.state.now = self.state.start;
                break;
            }
            let end = self.compute_step(start)?;
            if stop {
                if let Some(node) = self.pending(start) {
                    self.state.now = node;
                    self.state.time = self.state.time.next_up();
                    return Ok(true);
                }
                let mut times = self.events.events.iter().map(|node| start + node.offset);
                let next = times.find(|time| *time > self.state.time);
                let event = next.filter(|time| *time <= end_time);
                if let Some((time, node)) = event.and_then(|time| Some((time, self.last_event_at(start, time)?))) {
                    self.state.time = time;
                    self.state.now = node;
                    return Ok(true);
                }
            }
            if ends_within {
                self.state.now = self.within(start, end_time);
                break;
            }
            self.state.step += 1;
            self.state.start = recounted(Node { offset: 0.0, ..end }, self.setup.radius);
            self.state.excitation.next_cell();
            self.events.end = None;
        }
        self.state.time = end_time;
        Ok(false)
    }

    /// The disk after the last event of the present time step that falls on `time` \[s\], to rounding of time: of two contacts
    /// that change together neither is left behind.
    fn last_event_at(&self, start: f64, time: f64) -> Option<Node> {
        let mut events = self.events.events.iter().rev();
        events.find(|node| start + node.offset == time).copied()
    }

    /// The disk after an event that falls on the present time but has not happened yet: the second contact, if what drives
    /// the disk was changed when the first one did. Reported one bit of time later than it is, since time must advance.
    fn pending(&self, start: f64) -> Option<Node> {
        let last = self.last_event_at(start, self.state.time);
        last.filter(|node| node.contacts != self.state.now.contacts)
    }

    /// Start \[s\] of the time step that is `ahead` of the present one.
    fn step_start(&self, ahead: u64) -> f64 {
        self.state.origin + (self.state.step + ahead) as f64 * self.setup.time_step
    }

    fn time_step(&self, start: f64) -> TimeStep<'_, E::Piece> {
        TimeStep {
            setup: &self.setup,
            piece: self.state.excitation.piece(start),
            start,
        }
    }

    /// Computes the present time step if it has not been, and gives its end.
    fn compute_step(&mut self, start: f64) -> Result<Node, TwoSupportsStop> {
        if let Some(end) = self.events.end {
            return Ok(end);
        }
        let step = TimeStep {
            setup: &self.setup,
            piece: self.state.excitation.piece(start),
            start,
        };
        step.run(&self.state.start, self.setup.time_step, &mut self.events)
    }

    /// The disk at `time` \[s\] inside the present time step, whose events are known.
    fn within(&self, start: f64, time: f64) -> Node {
        let offset = time - start;
        let passed = self.events.events.iter().rev().find(|node| node.offset <= offset);
        self.time_step(start)
            .smooth_step(passed.unwrap_or(&self.state.start), offset)
    }

    /// Forces and accelerations at the time reached.
    pub fn observe(&self) -> TwoSupportsObservables {
        let now = &self.state.now;
        self.time_step(self.step_start(0))
            .observe(now.offset, &now.disk, &now.contacts)
    }

    /// All that the future depends on.
    pub fn state(&self) -> &TwoSupportsState<E> {
        &self.state
    }

    /// Torque and motion of the supports at the time reached.
    pub fn driven(&self) -> (f64, [SupportMotion; 2]) {
        let (piece, offset) = (self.time_step(self.step_start(0)).piece, self.state.now.offset);
        (piece.torque(offset), piece.supports(offset))
    }
}

impl<E: Excitation> Engine for DiskOnTwoSupports<E> {
    type State = TwoSupportsState<E>;
    type Stop = TwoSupportsStop;

    fn advance_within(&mut self, end_time: f64, budget: &mut WorkBudget) -> Result<(), TwoSupportsStop> {
        self.spend(end_time, budget)?;
        let backup = self.state.clone();
        let outcome = self.advance(end_time, false);
        if outcome.is_err() {
            self.resume(&backup);
        }
        outcome.map(|_| ())
    }

    fn copied_state(&self) -> TwoSupportsState<E> {
        self.state.clone()
    }

    fn fits(&self, state: &TwoSupportsState<E>, time: f64) -> bool {
        let step = self.setup.time_step;
        let step_start = state.origin + state.step as f64 * step;
        let within = state.time - step_start;
        let rounding = 1e-9 * step + 4.0 * f64::EPSILON * (state.time.abs() + state.origin.abs());
        let nodes = state.start.is_sane() && state.now.is_sane() && state.start.offset == 0.0;
        let in_step = (-rounding..=step + rounding).contains(&within) && (within - state.now.offset).abs() <= rounding;
        state.time == time && state.origin.is_finite() && nodes && in_step && state.excitation.is_sane()
    }

    fn restore(&mut self, state: &TwoSupportsState<E>, _time: f64) -> Result<(), TwoSupportsStop> {
        self.resume(state);
        Ok(())
    }
}

/// The same disk with its angle counted from where it is now, if it has turned far.
fn recounted(mut node: Node, radius: f64) -> Node {
    let angle = node.disk[2];
    if angle.abs() > RECOUNT {
        node.angle_offset += angle;
        node.disk[2] = 0.0;
        for contact in &mut node.contacts {
            contact.unstretched -= radius * angle;
        }
    }
    node
}

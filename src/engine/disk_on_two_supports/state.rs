//! Everything of the disk on its supports that changes with time.

use serde::{Deserialize, Serialize};

use crate::error::are_sane;

use super::contact::{Contact, Sense};
use super::runge_kutta::Vector;

/// The disk at one instant, with what its contacts did so far.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Node {
    /// Time since the start of the time step \[s\].
    pub offset: f64,
    /// x, y \[m\], angle beyond `angle_offset` \[rad\], their rates, work put in and energy lost \[J\].
    pub disk: Vector,
    /// Angle \[rad\] that was taken out of `disk`, so that the stretches of the springs keep their digits.
    pub angle_offset: f64,
    /// The left and the right contact.
    pub contacts: [Contact; 2],
    /// What the contacts did.
    pub record: Record,
}

impl Node {
    /// Angle turned since the start \[rad\].
    pub fn angle(&self) -> f64 {
        self.angle_offset + self.disk[2]
    }

    /// Whether all numbers are finite and far from overflow.
    pub fn is_sane(&self) -> bool {
        let stretch = self.contacts.map(|contact| contact.unstretched);
        are_sane(self.disk) && are_sane(stretch) && are_sane([self.offset, self.angle_offset]) && self.record.is_sane()
    }
}

/// What the contacts did since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Record {
    /// Times a contact began to slip.
    pub slips: u64,
    /// Times a contact opened.
    pub detachments: u64,
    /// When the first one opened \[s\].
    pub first_detachment: Option<f64>,
    /// Time for which each contact slipped, and was open \[s\].
    pub slipping: [f64; 2],
    /// See `slipping`.
    pub open: [f64; 2],
    /// Time with both contacts slipping, by [`SlidingPoint`] \[s\].
    pub sliding: [f64; 4],
    /// How often they began to.
    pub slides: [u64; 4],
}

/// Corners of the admissible region where both contacts slip (P 4.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SlidingPoint {
    /// The disk turns clockwise on both.
    S1,
    /// The disk turns counter-clockwise on both.
    S2,
    /// Springs stretched against each other, pulling the disk up.
    T1,
    /// The same, pushing it down.
    T2,
}

impl SlidingPoint {
    /// Where the contacts are, if both slip.
    pub fn of(contacts: &[Contact; 2]) -> Option<Self> {
        let senses = (contacts[0].slips()?, contacts[1].slips()?);
        Some(match senses {
            (Sense::Clockwise, Sense::Clockwise) => Self::S1,
            (Sense::CounterClockwise, Sense::CounterClockwise) => Self::S2,
            (Sense::CounterClockwise, Sense::Clockwise) => Self::T1,
            (Sense::Clockwise, Sense::CounterClockwise) => Self::T2,
        })
    }
}

impl Record {
    /// Whether all numbers are finite and far from overflow.
    pub fn is_sane(&self) -> bool {
        let times = self.slipping.into_iter().chain(self.open).chain(self.sliding);
        are_sane(times.chain(self.first_detachment))
    }

    /// What the contacts did since `before`.
    pub fn since(&self, before: &Self) -> Self {
        Self {
            slips: self.slips.saturating_sub(before.slips),
            slipping: [0, 1].map(|index| self.slipping[index] - before.slipping[index]),
            open: [0, 1].map(|index| self.open[index] - before.open[index]),
            sliding: [0, 1, 2, 3].map(|index| self.sliding[index] - before.sliding[index]),
            slides: [0, 1, 2, 3].map(|index| self.slides[index].saturating_sub(before.slides[index])),
            ..*self
        }
    }

    /// Adds `duration` \[s\] in which the contacts were in these phases.
    pub fn add_time(&mut self, contacts: &[Contact; 2], duration: f64) {
        for (index, contact) in contacts.iter().enumerate() {
            if contact.slips().is_some() {
                self.slipping[index] += duration;
            } else if !contact.is_closed() {
                self.open[index] += duration;
            }
        }
        if let Some(point) = SlidingPoint::of(contacts) {
            self.sliding[point as usize] += duration;
        }
    }

    /// Counts what changes from `before` to `after` at `time` \[s\].
    pub fn add_event(&mut self, before: &[Contact; 2], after: &[Contact; 2], time: f64) {
        for (before, after) in before.iter().zip(after) {
            if after.slips().is_some() && before.slips() != after.slips() {
                self.slips += 1;
            }
            if before.is_closed() && !after.is_closed() {
                self.detachments += 1;
                self.first_detachment.get_or_insert(time);
            }
        }
        let point = SlidingPoint::of(after);
        if let Some(point) = point.filter(|_| point != SlidingPoint::of(before)) {
            self.slides[point as usize] += 1;
        }
    }
}

/// State of the engine: the start of the present time step, and the instant to which it was advanced.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TwoSupportsState<E> {
    /// Time of step 0 \[s\]; it moves where the inputs change.
    pub origin: f64,
    /// Number of the present time step from there.
    pub step: u64,
    /// Start of the time step.
    pub start: Node,
    /// Time reached \[s\].
    pub time: f64,
    /// The disk then.
    pub now: Node,
    /// What drives it, in this time step.
    pub excitation: E,
}

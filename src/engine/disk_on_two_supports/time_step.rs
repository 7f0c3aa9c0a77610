//! One time step: smooth steps from event to event.

use crate::drive::excitation::Piece;

use super::contact::{Bounds, Contact, after, margins};
use super::dynamics::{PhaseFactors, TwoSupportsObservables, TwoSupportsSetup, observe, rates_of};
use super::runge_kutta::{Vector, advance};
use super::state::Node;

/// Most events in one time step; more are no progress.
const MOST_EVENTS: usize = 1000;

/// The events in a time step and its end.
#[derive(Debug, Clone, Default)]
pub struct StepEvents {
    /// The disk just after each event, in order.
    pub events: Vec<Node>,
    /// The disk at the end of the step; none before the step was computed.
    pub end: Option<Node>,
}

impl StepEvents {
    /// None yet, with room for as many as a step may have.
    pub fn new() -> Self {
        Self {
            events: Vec::with_capacity(MOST_EVENTS),
            end: None,
        }
    }
}

/// Why the engine cannot go on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TwoSupportsStop {
    /// Events follow each other without end.
    NoProgress {
        /// When \[s\].
        time: f64,
    },
    /// One call is to do more time steps than its budget allows.
    TooManySteps {
        /// Time reached \[s\].
        time: f64,
        /// Steps asked for.
        steps: f64,
    },
}

/// One time step: what is constant, what drives, when it starts.
pub struct TimeStep<'engine, P> {
    pub setup: &'engine TwoSupportsSetup,
    pub piece: P,
    /// Start \[s\].
    pub start: f64,
}

/// Both margins of the left contact, then those of the right one.
type Margins = [f64; 4];

impl<P: Piece> TimeStep<'_, P> {
    fn bounds(&self) -> Bounds {
        Bounds {
            normal_stiffness: self.setup.normal.stiffness,
            tangential_stiffness: self.setup.tangential.stiffness,
            friction: self.setup.tangential.friction,
            time: self.setup.time_step,
        }
    }

    fn factors(&self, contacts: &[Contact; 2]) -> [PhaseFactors; 2] {
        [0, 1].map(|index| PhaseFactors::of(&contacts[index], &self.setup.tangential))
    }

    /// Forces and accelerations at `offset` \[s\] from the start.
    #[inline(never)]
    pub fn observe(&self, offset: f64, disk: &Vector, contacts: &[Contact; 2]) -> TwoSupportsObservables {
        observe(self.setup, &self.piece, offset, disk, &self.factors(contacts))
    }

    /// The disk at `offset` if nothing happens between `from` and there.
    pub fn smooth_step(&self, from: &Node, offset: f64) -> Node {
        let first = self.observe(from.offset, &from.disk, &from.contacts).rates;
        self.continue_to(from, &first, offset)
    }

    #[inline]
    fn continue_to(&self, from: &Node, first: &Vector, offset: f64) -> Node {
        let duration = offset - from.offset;
        if duration <= 0.0 {
            return *from;
        }
        let factors = self.factors(&from.contacts);
        let rates =
            |passed: f64, disk: &Vector| rates_of(self.setup, &self.piece, from.offset + passed, disk, &factors);
        let mut node = Node {
            offset,
            disk: advance(&from.disk, first, duration, rates),
            ..*from
        };
        node.record.add_time(&from.contacts, duration);
        node
    }

    fn margins(&self, contacts: &[Contact; 2], observed: &TwoSupportsObservables) -> Margins {
        let bounds = self.bounds();
        let [left, right] = [0, 1].map(|index| margins(&contacts[index], &observed.contacts[index], &bounds));
        [left[0], left[1], right[0], right[1]]
    }

    fn margins_of(&self, node: &Node) -> Margins {
        self.margins(&node.contacts, &self.observe(node.offset, &node.disk, &node.contacts))
    }

    /// Every contact whose margin is negative goes to its next phase.
    fn change(&self, node: &mut Node, observed: &TwoSupportsObservables) {
        let bounds = self.bounds();
        let before = node.contacts;
        node.contacts = [0, 1].map(|index| {
            let (contact, force) = (&before[index], &observed.contacts[index]);
            let margins = margins(contact, force, &bounds);
            match margins.iter().position(|margin| *margin < 0.0) {
                Some(which) => after(contact, force, which, &bounds),
                None => *contact,
            }
        });
        node.record.add_event(&before, &node.contacts, self.start + node.offset);
    }

    /// Advances the disk from `from` to the end of the step after `duration` \[s\].
    ///
    /// # Errors
    /// More events than can be progress.
    pub fn run(&self, from: &Node, duration: f64, step: &mut StepEvents) -> Result<Node, TwoSupportsStop> {
        step.events.clear();
        step.end = None;
        let mut node = *from;
        loop {
            let first = self.observe(node.offset, &node.disk, &node.contacts);
            let now = self.margins(&node.contacts, &first);
            let mut changed = if is_negative(&now) {
                Some(node)
            } else {
                let end = self.continue_to(&node, &first.rates, duration);
                let last = self.observe(duration, &end.disk, &end.contacts);
                match self.first_event(&node, &first, &now, &end, &last) {
                    None => {
                        step.end = Some(end);
                        return Ok(end);
                    }
                    event => event,
                }
            };
            if let Some(event) = &mut changed {
                let at = self.observe(event.offset, &event.disk, &event.contacts);
                self.change(event, &at);
                step.events.push(*event);
                node = *event;
            }
            if step.events.len() >= MOST_EVENTS {
                return Err(TwoSupportsStop::NoProgress {
                    time: self.start + node.offset,
                });
            }
        }
    }

    /// The disk at the first instant at which a margin is negative, if that is before `end`.
    fn first_event(
        &self,
        from: &Node,
        first: &TwoSupportsObservables,
        now: &Margins,
        end: &Node,
        last: &TwoSupportsObservables,
    ) -> Option<Node> {
        let at_end = self.margins(&end.contacts, last);
        let middle = self.middle(from, first, end, last);
        let halfway = self.margins_of(&middle);
        // An event of the interpolation counts only if the Runge-Kutta step confirms it.
        let suspect = if is_negative(&halfway) {
            Some(0.5)
        } else {
            deepest_dip(now, &halfway, &at_end)
        };
        let bracket = suspect.and_then(|share| {
            let offset = from.offset + share * (end.offset - from.offset);
            let node = self.continue_to(from, &first.rates, offset);
            Some((node, self.margins_of(&node))).filter(|(_, margins)| is_negative(margins))
        });
        let (mut high, mut beyond) = match bracket {
            Some(bracket) => bracket,
            None if is_negative(&at_end) => (*end, at_end),
            None => return None,
        };
        // Of several margins that are negative at once each is followed back to where it became so.
        let mut followed = [false; 4];
        while let Some(index) = deepest(&beyond, &followed) {
            high = self.crossing(from, &first.rates, now, &high, &beyond, index);
            followed[index] = true;
            beyond = self.margins_of(&high);
        }
        Some(high)
    }

    /// Halfway between two nodes of one smooth stretch, by the quintic through positions, velocities and accelerations.
    fn middle(&self, from: &Node, first: &TwoSupportsObservables, end: &Node, last: &TwoSupportsObservables) -> Node {
        let h = end.offset - from.offset;
        let mut disk = from.disk;
        for row in 0..3 {
            let (q0, q1) = (from.disk[row], end.disk[row]);
            let (v0, v1) = (from.disk[row + 3], end.disk[row + 3]);
            let (a0, a1) = (first.rates[row + 3], last.rates[row + 3]);
            disk[row] = 0.5 * (q0 + q1) + h * (5.0 / 32.0 * (v0 - v1) + h / 64.0 * (a0 + a1));
            disk[row + 3] = 15.0 / 8.0 * ((q1 - q0) / h) - 7.0 / 16.0 * (v0 + v1) + h / 32.0 * (a1 - a0);
        }
        Node {
            offset: from.offset + 0.5 * h,
            disk,
            ..*from
        }
    }

    /// The first node found at which the margin of this index is negative, the bracket being down to rounding.
    ///
    /// Regula falsi with the Illinois rule; steps of the full order from `from`, so that events are as exact as steps.
    fn crossing(
        &self,
        from: &Node,
        first: &Vector,
        now: &Margins,
        beyond: &Node,
        deficits: &Margins,
        index: usize,
    ) -> Node {
        let (mut low, mut low_value) = (from.offset, now[index].max(0.0));
        let (mut high, mut high_value) = (*beyond, deficits[index]);
        let smallest = 4.0 * f64::EPSILON * self.setup.time_step;
        let mut kept = 0_i32;
        for round in 0..200 {
            let width = high.offset - low;
            if width <= smallest {
                break;
            }
            let share = low_value / (low_value - high_value);
            let secant = low + width * share.clamp(1e-3, 0.999_999);
            let try_at = if round % 4 == 3 { low + 0.5 * width } else { secant };
            if !(try_at > low && try_at < high.offset) {
                break;
            }
            let node = self.continue_to(from, first, try_at);
            let value = self.margins_of(&node)[index];
            if value < 0.0 {
                (high, high_value) = (node, value);
                if kept > 0 {
                    low_value *= 0.5;
                }
                kept = 1;
            } else {
                (low, low_value) = (try_at, value);
                if kept < 0 {
                    high_value *= 0.5;
                }
                kept = -1;
            }
        }
        high
    }
}

fn is_negative(margins: &Margins) -> bool {
    margins.iter().any(|margin| *margin < 0.0)
}

/// Share of a step after which a margin may dip below zero and return, by the parabola through its start, middle and end.
///
/// The parabola is good to some thousandths of the margin's swing: dips within a hundredth of it are examined.
fn deepest_dip(start: &Margins, middle: &Margins, end: &Margins) -> Option<f64> {
    let mut found = None;
    let mut deepest = 0.0;
    for ((&m0, &m1), &m2) in start.iter().zip(middle).zip(end) {
        let (bend, slope) = (2.0 * (m0 + m2 - 2.0 * m1), 4.0 * m1 - 3.0 * m0 - m2);
        let dips = bend > 0.0 && slope < 0.0 && -slope < 2.0 * bend;
        if dips && m0 > 0.0 && m2 >= 0.0 {
            let lowest = m0 - 0.25 * slope * slope / bend;
            let depth = lowest / (m0 + m1 + m2) - 0.01;
            if depth < deepest {
                deepest = depth;
                found = Some(-0.5 * slope / bend);
            }
        }
    }
    found
}

/// The most negative margin that was not followed: the same for mirrored contacts, whichever is the left one.
fn deepest(margins: &Margins, followed: &[bool; 4]) -> Option<usize> {
    let mut found = None;
    let mut depth = 0.0;
    for (index, &margin) in margins.iter().enumerate() {
        if margin < depth && !followed[index] {
            depth = margin;
            found = Some(index);
        }
    }
    found
}

//! One cell of the grid of time: smooth steps from event to event.

use crate::drive::excitation::Piece;

use super::contact::{Bounds, Contact, after, margins};
use super::dynamics::{Look, Mode, Setup, look, rates_of};
use super::runge_kutta::{Vector, advance};
use super::state::Node;

/// Most events in one cell; more are no progress.
const MOST_EVENTS: usize = 1000;

/// The events in a cell and its end.
#[derive(Debug, Clone, Default)]
pub struct Course {
    /// The disk just after each event, in order.
    pub events: Vec<Node>,
    /// The disk at the end of the cell; none before the course was computed.
    pub end: Option<Node>,
}

/// Events follow each other without end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stuck {
    /// When \[s\].
    pub time: f64,
}

/// One cell: what is fixed, what drives, where it starts.
pub struct Cell<'engine, P> {
    pub setup: &'engine Setup,
    pub piece: P,
    /// Start of the cell \[s\].
    pub start: f64,
}

/// Margins of the left and the right contact.
type Margins = [[f64; 2]; 2];

impl<P: Piece> Cell<'_, P> {
    fn bounds(&self) -> Bounds {
        Bounds {
            normal_stiffness: self.setup.normal.stiffness,
            tangential_stiffness: self.setup.skin.stiffness,
            friction: self.setup.skin.friction,
            time: self.setup.time_step,
        }
    }

    fn modes(&self, contacts: &[Contact; 2]) -> [Mode; 2] {
        [0, 1].map(|index| Mode::of(&contacts[index], &self.setup.skin))
    }

    /// Forces and accelerations at `offset` from the start of the cell.
    #[inline(never)]
    pub fn look(&self, offset: f64, disk: &Vector, contacts: &[Contact; 2]) -> Look {
        look(self.setup, &self.piece, offset, disk, &self.modes(contacts))
    }

    /// The disk at `offset` if nothing happens between `from` and there.
    pub fn fly(&self, from: &Node, offset: f64) -> Node {
        let first = self.look(from.offset, &from.disk, &from.contacts).rates;
        self.fly_on(from, &first, offset)
    }

    #[inline]
    fn fly_on(&self, from: &Node, first: &Vector, offset: f64) -> Node {
        let duration = offset - from.offset;
        if duration <= 0.0 {
            return *from;
        }
        let modes = self.modes(&from.contacts);
        let rates = |passed: f64, disk: &Vector| rates_of(self.setup, &self.piece, from.offset + passed, disk, &modes);
        let mut node = Node {
            offset,
            disk: advance(&from.disk, first, duration, rates),
            ..*from
        };
        node.record.pass(&from.contacts, duration);
        node
    }

    fn margins(&self, contacts: &[Contact; 2], look: &Look) -> Margins {
        let bounds = self.bounds();
        [0, 1].map(|index| margins(&contacts[index], &look.contacts[index], &bounds))
    }

    fn margins_of(&self, node: &Node) -> Margins {
        self.margins(&node.contacts, &self.look(node.offset, &node.disk, &node.contacts))
    }

    /// Every contact whose margin is negative goes to its next phase.
    fn change(&self, node: &mut Node, look: &Look) {
        let bounds = self.bounds();
        let before = node.contacts;
        node.contacts = [0, 1].map(|index| {
            let (contact, force) = (&before[index], &look.contacts[index]);
            let margins = margins(contact, force, &bounds);
            match margins.iter().position(|margin| *margin < 0.0) {
                Some(which) => after(contact, force, which, &bounds),
                None => *contact,
            }
        });
        node.record.note(&before, &node.contacts, self.start + node.offset);
    }

    /// Follows the disk from `from` to the end of the cell after `duration`.
    ///
    /// # Errors
    /// More events than can be progress.
    pub fn run(&self, from: &Node, duration: f64, course: &mut Course) -> Result<Node, Stuck> {
        course.events.clear();
        course.end = None;
        let mut node = *from;
        loop {
            let first = self.look(node.offset, &node.disk, &node.contacts);
            let now = self.margins(&node.contacts, &first);
            let mut changed = if is_negative(&now) {
                Some(node)
            } else {
                let end = self.fly_on(&node, &first.rates, duration);
                let last = self.look(duration, &end.disk, &end.contacts);
                match self.first_event(&node, &first, &now, &end, &last) {
                    None => {
                        course.end = Some(end);
                        return Ok(end);
                    }
                    event => event,
                }
            };
            if let Some(event) = &mut changed {
                let at = self.look(event.offset, &event.disk, &event.contacts);
                self.change(event, &at);
                course.events.push(*event);
                node = *event;
            }
            if course.events.len() >= MOST_EVENTS {
                return Err(Stuck {
                    time: self.start + node.offset,
                });
            }
        }
    }

    /// The disk at the first instant at which a margin is negative, if that is before `end`.
    fn first_event(&self, from: &Node, first: &Look, now: &Margins, end: &Node, last: &Look) -> Option<Node> {
        let at_end = self.margins(&end.contacts, last);
        let middle = self.middle(from, first, end, last);
        let look = self.look(middle.offset, &middle.disk, &middle.contacts);
        let halfway = self.margins(&middle.contacts, &look);
        // What the interpolation shows is believed only if the step shows it too.
        let suspect = if is_negative(&halfway) {
            Some(0.5)
        } else {
            deepest_dip(now, &halfway, &at_end)
        };
        let bracket = suspect.and_then(|share| {
            let offset = from.offset + share * (end.offset - from.offset);
            let node = self.fly_on(from, &first.rates, offset);
            Some((node, self.margins_of(&node))).filter(|(_, margins)| is_negative(margins))
        });
        let (mut high, mut beyond) = match bracket {
            Some(bracket) => bracket,
            None if is_negative(&at_end) => (*end, at_end),
            None => return None,
        };
        // Of several margins that are negative at once each is followed back to where it became so.
        let mut followed = [[false; 2]; 2];
        while let Some((contact, which)) = deepest(&beyond, &followed) {
            high = self.crossing(
                from,
                first,
                now[contact][which],
                &high,
                beyond[contact][which],
                (contact, which),
            );
            followed[contact][which] = true;
            beyond = self.margins_of(&high);
        }
        Some(high)
    }

    /// Halfway between two nodes of one smooth stretch, by the quintic through places, velocities and accelerations.
    fn middle(&self, from: &Node, first: &Look, end: &Node, last: &Look) -> Node {
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

    /// The first node found at which margin `which` is negative, the bracket being down to rounding.
    ///
    /// Regula falsi with the Illinois rule; steps of the full order from `from`, so that events are as exact as steps.
    fn crossing(
        &self,
        from: &Node,
        first: &Look,
        margin: f64,
        beyond: &Node,
        deficit: f64,
        which: (usize, usize),
    ) -> Node {
        let (mut low, mut low_value) = (from.offset, margin.max(0.0));
        let (mut high, mut high_value) = (*beyond, deficit);
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
            let node = self.fly_on(from, &first.rates, try_at);
            let value = self.margins_of(&node)[which.0][which.1];
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
    margins.iter().flatten().any(|margin| *margin < 0.0)
}

/// Share of a step after which a margin may dip below zero and return, by the parabola through its start, middle and end.
///
/// The parabola is good to some thousandths of the margin's swing: dips within a hundredth of it are looked at.
fn deepest_dip(start: &Margins, middle: &Margins, end: &Margins) -> Option<f64> {
    let mut found = None;
    let mut deepest = 0.0;
    for contact in 0..2 {
        for which in 0..2 {
            let (m0, m1, m2) = (start[contact][which], middle[contact][which], end[contact][which]);
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
    }
    found
}

/// The most negative margin that was not followed: the same for mirrored contacts, whichever is the left one.
fn deepest(margins: &Margins, followed: &[[bool; 2]; 2]) -> Option<(usize, usize)> {
    let mut found = None;
    let mut depth = 0.0;
    for contact in 0..2 {
        for which in 0..2 {
            if margins[contact][which] < depth && !followed[contact][which] {
                depth = margins[contact][which];
                found = Some((contact, which));
            }
        }
    }
    found
}

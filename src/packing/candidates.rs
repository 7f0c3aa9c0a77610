//! Which place is the lowest: places where a disk could rest, lowest first, kept as the front grows.
//!
//! A disk never leaves, so a place once blocked stays blocked, and a new place needs the newest disk as a support. Each
//! place is therefore found once, when the later of its supports arrives, and dropped once, when it is found blocked.
//!
//! Up to [`CLASSES`] different radii have a queue each, and the first place in it that still stands is the lowest. More
//! radii share [`CLASSES`] queues made for the smallest radius of each class: a disk shrunk about its lowest point can
//! only roll down, so a place of the smaller disk bounds the places of the larger one around it from below.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::front::{Element, Front, Place};

/// Queues at most. More of them make the bounds tighter and every insertion dearer.
const CLASSES: usize = 16;
/// Heights that differ by less than this part of the smallest radius count as equal; the leftmost place wins.
const TIE: f64 = 1e-9;

/// A place with its rank.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    /// Height of the disk's lowest point in units of the tie.
    rank: u64,
    place: Place,
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |place: &Place| (place.left, place.right);
        self.rank
            .cmp(&other.rank)
            .then(self.place.centre.x.total_cmp(&other.place.centre.x))
            .then_with(|| key(&self.place).cmp(&key(&other.place)))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Candidate {}

/// Places for disks of one radius.
#[derive(Debug)]
struct Queue {
    radius: f64,
    places: BinaryHeap<Reverse<Candidate>>,
}

/// All queues, by growing radius.
#[derive(Debug)]
pub(super) struct Candidates {
    tie: f64,
    queues: Vec<Queue>,
}

impl Candidates {
    /// Queues for these radii over an empty front.
    pub(super) fn new(radii: &[f64], front: &Front) -> Self {
        let mut distinct = radii.to_vec();
        distinct.sort_by(f64::total_cmp);
        distinct.dedup();
        let smallest = distinct.first().copied().unwrap_or(1.0);
        if distinct.len() > CLASSES {
            // The 16th root by square roots, which have the same bits everywhere.
            let ratio = distinct[distinct.len() - 1] / smallest;
            let step = ratio.sqrt().sqrt().sqrt().sqrt();
            let bounds = std::iter::successors(Some(smallest), |bound| Some(bound * step));
            distinct = bounds.take(CLASSES).collect();
        }
        let queue = |radius| Queue {
            radius,
            places: BinaryHeap::new(),
        };
        let mut candidates = Self {
            tie: TIE * smallest,
            queues: distinct.into_iter().map(queue).collect(),
        };
        for class in 0..candidates.queues.len() {
            candidates.offer(front, class, Element::LeftWall, Element::Floor);
        }
        candidates
    }

    /// The lowest place for a disk of `radius`, the leftmost of several.
    pub(super) fn lowest(&mut self, front: &Front, radius: f64) -> Option<Place> {
        let class = self.queues.partition_point(|queue| queue.radius <= radius).max(1) - 1;
        let tie = self.tie;
        let queue = &mut self.queues[class];
        let mut best: Option<Candidate> = None;
        let mut bounds = Vec::new();
        while let Some(&Reverse(first)) = queue.places.peek() {
            if best.is_some_and(|best| best.rank <= first.rank) {
                break;
            }
            queue.places.pop();
            if !front.stands(&first.place, queue.radius) {
                continue;
            }
            if queue.radius == radius {
                return Some(first.place);
            }
            bounds.push(Reverse(first));
            let elements = front.near(first.place.centre, radius, radius);
            best = lower(best, lowest_among(front, &elements, radius, tie));
        }
        queue.places.extend(bounds);
        let anywhere = || lowest_among(front, &front.elements(), radius, tie);
        best.or_else(anywhere).map(|candidate| candidate.place)
    }

    /// Takes up the places that disk `index`, just placed, offers together with its neighbours.
    pub(super) fn add_around(&mut self, front: &Front, index: u32) {
        let disk = *front.disk(index);
        for class in 0..self.queues.len() {
            let radius = self.queues[class].radius;
            for other in front.near(disk.centre(), disk.radius + radius, radius) {
                let (left, right) = match other {
                    Element::LeftWall => (other, Element::Disk(index)),
                    Element::Disk(neighbour) if front.disk(neighbour).x < disk.x => (other, Element::Disk(index)),
                    _ => (Element::Disk(index), other),
                };
                self.offer(front, class, left, right);
            }
        }
    }

    fn offer(&mut self, front: &Front, class: usize, left: Element, right: Element) {
        let queue = &mut self.queues[class];
        if let Some(place) = front.resting_place(left, right, queue.radius)
            && front.stands(&place, queue.radius)
        {
            let rank = rank(&place, queue.radius, self.tie);
            queue.places.push(Reverse(Candidate { rank, place }));
        }
    }
}

/// The lowest place of a disk of `radius` on any two of `elements`.
fn lowest_among(front: &Front, elements: &[Element], radius: f64, tie: f64) -> Option<Candidate> {
    let mut best: Option<Candidate> = None;
    for &left in elements {
        for &right in elements {
            let Some(place) = front.resting_place(left, right, radius) else {
                continue;
            };
            let candidate = Candidate {
                rank: rank(&place, radius, tie),
                place,
            };
            if best.is_none_or(|best| candidate < best) && front.stands(&place, radius) {
                best = Some(candidate);
            }
        }
    }
    best
}

fn lower(a: Option<Candidate>, b: Option<Candidate>) -> Option<Candidate> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

/// Height of the lowest point of the disk in units of the tie.
fn rank(place: &Place, radius: f64, tie: f64) -> u64 {
    // Negative by rounding becomes 0.
    ((place.centre.y - radius) / tie).round() as u64
}

/// The lowest place found by trying every pair of the front: slow, for tests.
#[cfg(test)]
pub(super) fn lowest_by_exhaustion(front: &Front, radius: f64, smallest: f64) -> Option<(Place, u64)> {
    let tie = TIE * smallest;
    lowest_among(front, &front.elements(), radius, tie).map(|best| (best.place, best.rank))
}

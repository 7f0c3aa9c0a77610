//! The front: the chain of touching elements from the left wall to the right wall that seals off what is built.
//!
//! Needs: places found by [`Front::resting_place`] and confirmed by [`Front::stands`]. Guarantees: a disk that is clear
//! of the front and above it is clear of every disk ever placed, since neighbours in the chain touch. Hence nothing
//! below the front is kept. Not here: which place is the lowest (`candidates`).

use nalgebra::Vector2;

use super::columns::Columns;
use super::resting::{above, beside, on_disks, slack};
use crate::geometry::Disk;

/// What a disk can rest on. A disk is known by its number in the order of placing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Element {
    LeftWall,
    Floor,
    RightWall,
    Disk(u32),
}

impl Element {
    /// Index into the links of the chain.
    fn slot(self) -> usize {
        match self {
            Self::LeftWall => 0,
            Self::Floor => 1,
            Self::RightWall => 2,
            Self::Disk(index) => 3 + index as usize,
        }
    }
}

/// Centre of a disk that touches `left` and `right`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    pub centre: Vector2<f64>,
    pub left: Element,
    pub right: Element,
}

/// Chain links of an element; none once the element has left the front.
#[derive(Debug, Clone, Copy)]
struct Links {
    previous: Element,
    next: Element,
}

/// The front and all disks placed so far.
#[derive(Debug)]
pub(super) struct Front {
    half_width: f64,
    disks: Vec<Disk>,
    links: Vec<Option<Links>>,
    columns: Columns,
}

impl Front {
    /// Left wall, floor, right wall. The floor is always filled from the left, so that it stays next to the right wall.
    pub(super) fn new(radii: &[f64], width: f64) -> Self {
        let link = |previous, next| Some(Links { previous, next });
        Self {
            half_width: 0.5 * width,
            disks: Vec::with_capacity(radii.len()),
            links: vec![
                link(Element::LeftWall, Element::Floor),
                link(Element::LeftWall, Element::RightWall),
                link(Element::Floor, Element::RightWall),
            ],
            columns: Columns::new(radii, width),
        }
    }

    /// All disks in the order of placing.
    pub(super) fn into_disks(self) -> Vec<Disk> {
        self.disks
    }

    pub(super) fn disk(&self, index: u32) -> &Disk {
        &self.disks[index as usize]
    }

    /// Chain from the left wall to the right wall.
    pub(super) fn elements(&self) -> Vec<Element> {
        let mut chain = vec![Element::LeftWall];
        let mut at = Element::LeftWall;
        while at != Element::RightWall {
            at = self.next(at);
            chain.push(at);
        }
        chain
    }

    /// True while `element` is part of the front.
    fn contains(&self, element: Element) -> bool {
        self.links[element.slot()].is_some()
    }

    fn next(&self, element: Element) -> Element {
        self.links[element.slot()].map_or(Element::RightWall, |links| links.next)
    }

    fn previous(&self, element: Element) -> Element {
        self.links[element.slot()].map_or(Element::LeftWall, |links| links.previous)
    }

    /// Front elements that a disk of `radius` centred within a distance \[m\] of a point may touch.
    pub(super) fn near(&self, point: Vector2<f64>, distance: f64, radius: f64) -> Vec<Element> {
        let mut found = Vec::new();
        let span = distance + radius;
        if point.x - span <= -self.half_width {
            found.push(Element::LeftWall);
        }
        if point.y <= span && self.contains(Element::Floor) {
            found.push(Element::Floor);
        }
        if point.x + span >= self.half_width {
            found.push(Element::RightWall);
        }
        self.columns.any_near(point.x, span, |index| {
            let disk = self.disk(index);
            let limit = (disk.radius + span) * (1.0 + 1e-9);
            if (disk.centre() - point).norm_squared() <= limit * limit {
                found.push(Element::Disk(index));
            }
            false
        });
        found
    }

    /// Where a disk of `radius` rests on `left` and `right`: between the walls, not in the floor, its centre between the
    /// two supports. Says nothing about third elements.
    pub(super) fn resting_place(&self, left: Element, right: Element, radius: f64) -> Option<Place> {
        let at_left = radius - self.half_width;
        let centre = match (left, right) {
            (Element::LeftWall, Element::Floor) => Vector2::new(at_left, radius),
            (Element::LeftWall, Element::Disk(b)) => Vector2::new(at_left, above(self.disk(b), at_left, radius)?),
            (Element::Disk(a), Element::RightWall) => Vector2::new(-at_left, above(self.disk(a), -at_left, radius)?),
            (Element::Disk(a), Element::Floor) => Vector2::new(beside(self.disk(a), radius)?, radius),
            (Element::Disk(a), Element::Disk(b)) if self.disk(a).x < self.disk(b).x => {
                on_disks(self.disk(a), self.disk(b), radius)?
            }
            _ => return None,
        };
        let slack = slack(radius, centre);
        let inside = centre.x.abs() <= self.half_width - radius + slack && centre.y >= radius - slack;
        let held = |element: Element, side: f64| match element {
            Element::Disk(index) => side * (centre.x - self.disk(index).x) >= -slack,
            _ => true,
        };
        (inside && held(left, 1.0) && held(right, -1.0)).then_some(Place { centre, left, right })
    }

    /// True if a disk of `radius` can be put at `place`: both supports in the front, no overlap, above the front.
    pub(super) fn stands(&self, place: &Place, radius: f64) -> bool {
        self.contains(place.left)
            && self.contains(place.right)
            && self.is_clear(place, radius)
            && self.is_above(place, radius)
    }

    fn is_clear(&self, place: &Place, radius: f64) -> bool {
        !self.columns.any_near(place.centre.x, radius, |index| {
            let disk = self.disk(index);
            let radius_sum = disk.radius + radius;
            let allowed = radius_sum - slack(radius_sum, place.centre);
            (disk.centre() - place.centre).norm_squared() < allowed * allowed
        })
    }

    /// True if the chain from the left to the right support passes below the place.
    ///
    /// The polygon place, left, ..., right, place does not cross itself, because its sides run inside disks that do not
    /// overlap; so the sign of its area decides. A right support before the left one in the chain lies behind the front.
    fn is_above(&self, place: &Place, radius: f64) -> bool {
        let mut outline = Outline::at(place, self.half_width);
        let (mut ahead, mut behind) = (place.left, place.left);
        outline.start(place.left, self.centre(place.left));
        loop {
            let from = ahead;
            ahead = self.next(ahead);
            behind = self.previous(behind);
            outline.pass(from, ahead, self.centre(from), self.centre(ahead));
            if ahead == place.right {
                return outline.closed(place.right) >= -1e-9 * radius * radius;
            }
            if behind == place.right || ahead == Element::RightWall {
                return false;
            }
        }
    }

    /// Centre of a disk; nothing for walls and floor.
    fn centre(&self, element: Element) -> Option<Vector2<f64>> {
        match element {
            Element::Disk(index) => Some(self.disk(index).centre()),
            _ => None,
        }
    }

    /// Puts a disk of `radius` at `place` and takes what it covers out of the front. Returns its number.
    pub(super) fn put(&mut self, place: Place, radius: f64) -> u32 {
        let mut covered = self.next(place.left);
        while covered != place.right {
            let next = self.next(covered);
            if let Element::Disk(index) = covered {
                let disk = *self.disk(index);
                self.columns.remove(&disk, index);
            }
            self.links[covered.slot()] = None;
            covered = next;
        }
        let index = self.disks.len() as u32;
        let disk = Disk::new(place.centre, radius);
        self.disks.push(disk);
        self.columns.add(&disk, index);
        self.links.push(Some(Links {
            previous: place.left,
            next: place.right,
        }));
        if let Some(links) = &mut self.links[place.left.slot()] {
            links.next = Element::Disk(index);
        }
        if let Some(links) = &mut self.links[place.right.slot()] {
            links.previous = Element::Disk(index);
        }
        index
    }
}

/// Twice the signed area of a polygon, relative to the place, so that no digits cancel.
struct Outline {
    place: Vector2<f64>,
    half_width: f64,
    last: Vector2<f64>,
    area: f64,
}

impl Outline {
    fn at(place: &Place, half_width: f64) -> Self {
        Self {
            place: place.centre,
            half_width,
            last: place.centre,
            area: 0.0,
        }
    }

    fn to(&mut self, corner: Vector2<f64>) {
        self.area += (self.last - self.place).perp(&(corner - self.place));
        self.last = corner;
    }

    /// First corner: the left support, or the point of the left wall at the height of the place.
    fn start(&mut self, left: Element, centre: Option<Vector2<f64>>) {
        match centre {
            Some(centre) => self.to(centre),
            None if left == Element::LeftWall => self.to(Vector2::new(-self.half_width, self.place.y)),
            None => {}
        }
    }

    /// From one element of the chain to the next; down the left wall, along the floor, up to the right wall.
    fn pass(&mut self, from: Element, to: Element, from_centre: Option<Vector2<f64>>, to_centre: Option<Vector2<f64>>) {
        let height = |centre: Option<Vector2<f64>>| centre.map_or(0.0, |centre| centre.y);
        if from == Element::LeftWall {
            self.to(Vector2::new(-self.half_width, height(to_centre)));
        }
        match (to, to_centre) {
            (_, Some(centre)) => self.to(centre),
            (Element::Floor, _) => {
                let x = from_centre.map_or(-self.half_width, |centre| centre.x);
                self.to(Vector2::new(x, 0.0));
            }
            (Element::RightWall, _) => self.to(Vector2::new(self.half_width, height(from_centre))),
            _ => {}
        }
    }

    /// Last corner at the right support, then back to the place.
    fn closed(mut self, right: Element) -> f64 {
        match right {
            Element::Floor => self.to(Vector2::new(self.place.x, 0.0)),
            Element::RightWall => self.to(Vector2::new(self.half_width, self.place.y)),
            _ => {}
        }
        self.to(self.place);
        self.area
    }
}

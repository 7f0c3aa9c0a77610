//! Loops over disks by several threads: integration, arcs of the surfaces, distances. Each number has the bits that one thread gives.

use std::marker::PhantomData;

use fearless_simd::{Simd, SimdBase, f64x2};

use crate::engine::dem::lanes::{LaneWork, Lanes, MOST_LANES, in_lanes, largest, xy};
use crate::engine::threads::Divisible;

use super::integrator::{Constants, Coordinates, Integrator};

/// Numbers between which arrays of degrees of freedom are divided: those of eight disks, so that registers stay as they lie.
const UNIT: usize = 24;

/// [`Integrator::correct_and_predict`] of an integrator without higher derivatives, and then [`ArcLengths`] and [`Farthest`] of what
/// was predicted.
pub struct Advance<'a, I> {
    /// Positions, velocities and accelerations.
    pub coordinates: Coordinates<'a>,
    /// Forces, then weights.
    pub force: &'a mut [f64],
    /// Of the same degrees of freedom.
    pub constants: Constants<'a>,
    /// \[s\]
    pub step: f64,
    /// Of as many disks as there are radii.
    pub arc_lengths: &'a mut [f64],
    /// Of the disks, which come first among the degrees of freedom \[m\].
    pub radii: &'a [f64],
    /// Positions that distances are taken from, of as many disks.
    pub then: &'a [[f64; 3]],
    /// The rule.
    pub integrator: PhantomData<I>,
}

impl<I: Integrator> Divisible for Advance<'_, I> {
    type Output = f64;

    fn units(&self) -> usize {
        self.force.len().div_ceil(UNIT)
    }

    fn split_at(self, units: usize) -> (Self, Self) {
        let at = (units * UNIT).min(self.force.len());
        let disks = (units * UNIT / 3).min(self.radii.len());
        let (coordinates, coordinates_after) = self.coordinates.split_at(at);
        let (force, force_after) = self.force.split_at_mut(at);
        let (constants, constants_after) = self.constants.split_at(at);
        let (arc_lengths, arc_lengths_after) = self.arc_lengths.split_at_mut(disks);
        let (radii, radii_after) = self.radii.split_at(disks);
        let (then, then_after) = self.then.split_at(disks);
        let one = Self {
            coordinates,
            force,
            constants,
            arc_lengths,
            radii,
            then,
            ..self
        };
        let other = Self {
            coordinates: coordinates_after,
            force: force_after,
            constants: constants_after,
            arc_lengths: arc_lengths_after,
            radii: radii_after,
            then: then_after,
            ..one
        };
        (one, other)
    }

    fn run(mut self) -> f64 {
        let (radii, then) = (self.radii, self.then);
        I::correct_and_predict(self.coordinates.reborrow(), self.force, self.constants, self.step);
        let positions = &self.coordinates.position.as_chunks().0[..radii.len()];
        let arc_lengths = self.arc_lengths;
        ArcLengths {
            arc_lengths,
            radii,
            positions,
        }
        .run();
        Divisible::run(Farthest { now: positions, then })
    }

    fn merged(one: f64, other: f64) -> f64 {
        one.max(other)
    }
}

/// Radius times angle of each disk \[m\].
pub struct ArcLengths<'a> {
    /// What is computed.
    pub arc_lengths: &'a mut [f64],
    /// \[m\]
    pub radii: &'a [f64],
    /// x, y and angle, of as many disks or more.
    pub positions: &'a [[f64; 3]],
}

impl Divisible for ArcLengths<'_> {
    type Output = ();

    fn units(&self) -> usize {
        self.arc_lengths.len()
    }

    fn split_at(self, units: usize) -> (Self, Self) {
        let (arc_lengths, arc_lengths_after) = self.arc_lengths.split_at_mut(units);
        let (radii, radii_after) = self.radii.split_at(units);
        let (positions, positions_after) = self.positions.split_at(units);
        let part = |arc_lengths, radii, positions| Self {
            arc_lengths,
            radii,
            positions,
        };
        (
            part(arc_lengths, radii, positions),
            part(arc_lengths_after, radii_after, positions_after),
        )
    }

    fn run(self) {
        let turns = self.radii.iter().zip(self.positions);
        for (arc_length, (radius, position)) in self.arc_lengths.iter_mut().zip(turns) {
            *arc_length = radius * position[2];
        }
    }

    fn merged((): (), (): ()) {}
}

/// Largest square of a distance \[m2\] between the positions in two lists.
pub struct Farthest<'a> {
    /// Positions.
    pub now: &'a [[f64; 3]],
    /// As many others.
    pub then: &'a [[f64; 3]],
}

impl Divisible for Farthest<'_> {
    type Output = f64;

    fn units(&self) -> usize {
        self.then.len()
    }

    fn split_at(self, units: usize) -> (Self, Self) {
        let (now, now_after) = self.now.split_at(units);
        let (then, then_after) = self.then.split_at(units);
        (
            Self { now, then },
            Self {
                now: now_after,
                then: then_after,
            },
        )
    }

    fn run(self) -> f64 {
        in_lanes(self)
    }

    fn merged(one: f64, other: f64) -> f64 {
        one.max(other)
    }
}

impl LaneWork for Farthest<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<S: Simd, V: Lanes<S>>(self, simd: S) -> f64 {
        let (now, then) = (self.now.chunks_exact(V::LEN), self.then.chunks_exact(V::LEN));
        let rest = now.remainder().iter().zip(then.remainder());
        let mut farthest = V::splat(simd, 0.0);
        for (now, then) in now.zip(then) {
            let mut moved = [f64x2::splat(simd, 0.0); MOST_LANES];
            for k in 0..V::LEN {
                moved[k] = xy(simd, &now[k]) - xy(simd, &then[k]);
            }
            let [dx, dy] = V::columns(&moved);
            farthest = (dx * dx + dy * dy).max(farthest);
        }
        let squares = rest.map(|(now, then)| [now[0] - then[0], now[1] - then[1]]);
        squares
            .map(|[dx, dy]| dx * dx + dy * dy)
            .fold(largest(farthest), f64::max)
    }
}

/// Largest square of a speed \[m2/s2\].
pub struct Fastest<'a>(pub &'a [[f64; 3]]);

impl Divisible for Fastest<'_> {
    type Output = f64;

    fn units(&self) -> usize {
        self.0.len()
    }

    fn split_at(self, units: usize) -> (Self, Self) {
        let (velocities, velocities_after) = self.0.split_at(units);
        (Self(velocities), Self(velocities_after))
    }

    fn run(self) -> f64 {
        let squares = self.0.iter().map(|[vx, vy, _]| vx * vx + vy * vy);
        squares.fold(0.0, f64::max)
    }

    fn merged(one: f64, other: f64) -> f64 {
        one.max(other)
    }
}

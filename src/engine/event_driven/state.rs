//! State of an event-driven run, its sums, and what stops it.

use serde::{Deserialize, Serialize};

use crate::collision::CollisionLaw;
use crate::error::are_sane;

use super::shells::Shells;
use super::{Body, Boundary, EventDriven, Field, LEAVES_SHELL, Space, Spin, WALLS};

/// Farthest local time \[s\] from its origin.
const FARTHEST: f64 = 1e12;

/// What stopped a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stop {
    /// Events follow each other so fast that time stands still.
    NoHeadway(NoHeadway),
    /// One call had more events to handle than it may.
    TooManyEvents {
        /// Time reached \[s\].
        time: f64,
        /// Events that one call may handle.
        most: u64,
    },
}

/// Where time stands still.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoHeadway {
    /// Time \[s\].
    pub time: f64,
    /// Events since the last look of the watchdog.
    pub events: u64,
    /// Time that they took \[s\].
    pub took: f64,
    /// The last two that met; a wall is named by its number.
    pub last: (u32, Partner),
}

/// Whom a disk met.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Partner {
    /// Another disk.
    Disk(u32),
    /// A wall.
    Wall(u32),
    /// Nobody: it left its shell, which fast disks do often.
    Shell,
}

/// Sums since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Counts {
    /// Impacts of two disks.
    pub disk_impacts: u64,
    /// Impacts on walls.
    pub wall_impacts: u64,
    /// Listings of neighbours.
    pub listings: u64,
    /// Events whose partner had met another.
    pub stale: u64,
    /// Energy lost in impacts \[J\].
    pub energy_lost: f64,
    /// Work of the base on the disks \[J\].
    pub energy_input: f64,
    /// Vertical impulse of the base on the disks \[N.s\].
    pub base_impulse: f64,
    /// Events at the last look of the watchdog, and the time then \[s\].
    pub(super) watched: (u64, f64),
}

impl Counts {
    /// All events, if there is room for as many again: a damaged count may be anything.
    pub(super) fn events(&self) -> Option<u64> {
        let counts = [self.disk_impacts, self.wall_impacts, self.listings, self.stale];
        let sum = counts.iter().try_fold(0_u64, |sum, &count| sum.checked_add(count))?;
        (sum < u64::MAX / 2).then_some(sum)
    }
}

/// Everything that changes with time. Times are local: the time is `epoch + local`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State<B> {
    /// Origin of local time \[s\].
    pub epoch: f64,
    /// Disks in flight.
    pub bodies: Vec<Body>,
    /// Their spins and what goes with impacts.
    pub spins: Vec<Spin>,
    /// Walls.
    pub boundary: B,
    /// Sums.
    pub counts: Counts,
    pub(super) shells: Shells,
}

impl<L: CollisionLaw, B: Boundary, F: Field, S: Space> EventDriven<L, B, F, S> {
    /// Whether `state` can be one of this run: as many disks, and indices that exist.
    pub fn fits(&self, state: &State<B>) -> bool {
        let disks = self.state.bodies.len();
        let walls = 1_u32
            .checked_shl(self.state.boundary.count())
            .unwrap_or(0)
            .wrapping_sub(1);
        let body_holds = |(body, own): (&Body, &Body)| {
            let partner_holds = (body.partner as usize) < disks
                || body.partner == LEAVES_SHELL
                || (body.partner >= WALLS && body.partner - WALLS < self.state.boundary.count());
            are_sane([body.x, body.y, body.vx, body.vy])
                && body.radius == own.radius
                && body.time.abs() <= FARTHEST
                && body.next_time >= body.time
                && partner_holds
        };
        let spin_holds = |spin: &Spin| are_sane([spin.angle, spin.angular_velocity]) && spin.since.abs() <= FARTHEST;
        let Counts {
            energy_lost,
            energy_input,
            base_impulse,
            watched,
            ..
        } = state.counts;
        let watch_holds = state.counts.events().is_some_and(|events| watched.0 <= events);
        state.bodies.len() == disks
            && state.spins.len() == disks
            && state.bodies.iter().zip(&self.state.bodies).all(body_holds)
            && state.spins.iter().all(spin_holds)
            && are_sane([energy_lost, energy_input, base_impulse, watched.1, state.epoch])
            && watch_holds
            && self.state.boundary.fits(&state.boundary, state.epoch)
            && state.shells.is_sound(&self.state.shells)
            && state.shells.listings.iter().all(|listing| listing.walls & !walls == 0)
    }
}

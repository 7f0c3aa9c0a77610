//! State of an event-driven run, its sums, and what stops it.

use serde::{Deserialize, Serialize};

use crate::collision::CollisionLaw;
use crate::engine::{Engine, WorkBudget};
use crate::error::are_sane;

use super::shells::Shells;
use super::{Body, Boundary, EventDriven, Partner, Space, Spin, Unobserved};

/// Farthest local time \[s\] from its origin.
const FARTHEST: f64 = 1e12;

/// What stopped a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EventDrivenStop {
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
    /// Events in the interval that the watchdog checks.
    pub events: u64,
    /// Duration of that interval \[s\].
    pub duration: f64,
    /// Disk of the last event.
    pub disk: u32,
    /// Its partner.
    pub partner: Partner,
}

/// Sums since the start.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Counts {
    /// Impacts of two disks.
    pub disk_impacts: u64,
    /// Impacts on walls.
    pub wall_impacts: u64,
    /// Renewals of the neighbour list of a disk.
    pub list_renewals: u64,
    /// Events whose partner had another impact before.
    pub stale: u64,
    /// Energy lost in impacts \[J\].
    pub energy_lost: f64,
    /// Work of the base on the disks \[J\].
    pub energy_input: f64,
    /// Vertical impulse of the base on the disks \[N.s\].
    pub base_impulse: f64,
    /// Start of the interval that the watchdog checks next.
    pub(super) watched_from: Watch,
}

/// Events and time \[s\] at a check of the watchdog.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Watch {
    pub(super) events: u64,
    pub(super) time: f64,
}

impl Counts {
    /// All events, if there is room for as many again: a damaged count may be anything.
    pub(super) fn events(&self) -> Option<u64> {
        let counts = [self.disk_impacts, self.wall_impacts, self.list_renewals, self.stale];
        let sum = counts.iter().try_fold(0_u64, |sum, &count| sum.checked_add(count))?;
        (sum < u64::MAX / 2).then_some(sum)
    }
}

/// Everything that changes with time. Times are local: the time is `epoch + local`.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct EventDrivenState<B> {
    /// Origin of local time \[s\].
    pub epoch: f64,
    /// Disks in flight.
    pub bodies: Vec<Body>,
    /// Their spins and other data of impacts only.
    pub spins: Vec<Spin>,
    /// Walls.
    pub boundary: B,
    /// Sums.
    pub counts: Counts,
    pub(super) shells: Shells,
}

impl<B: Clone> Clone for EventDrivenState<B> {
    fn clone(&self) -> Self {
        Self {
            bodies: self.bodies.clone(),
            spins: self.spins.clone(),
            boundary: self.boundary.clone(),
            shells: self.shells.clone(),
            ..*self
        }
    }

    /// Copies without allocating where there is room.
    fn clone_from(&mut self, source: &Self) {
        (self.epoch, self.counts) = (source.epoch, source.counts);
        self.bodies.clone_from(&source.bodies);
        self.spins.clone_from(&source.spins);
        self.boundary.clone_from(&source.boundary);
        self.shells.clone_from(&source.shells);
    }
}

impl<L: CollisionLaw, B: Boundary, S: Space> Engine for EventDriven<L, B, S> {
    type State = EventDrivenState<B>;
    type Stop = EventDrivenStop;

    fn advance_within(&mut self, end_time: f64, budget: &mut WorkBudget) -> Result<(), EventDrivenStop> {
        self.advance_observed(end_time, &mut Unobserved, budget)
    }

    fn copied_state(&self) -> EventDrivenState<B> {
        self.state.clone()
    }

    fn copy_state_to(&self, state: &mut EventDrivenState<B>) {
        state.clone_from(&self.state);
    }

    /// As many disks, and indices that exist; at any time.
    fn fits(&self, state: &EventDrivenState<B>, _time: f64) -> bool {
        let disks = self.state.bodies.len();
        let walls = self.state.boundary.count();
        let wall_set = 1_u32.checked_shl(walls).unwrap_or(0).wrapping_sub(1);
        let body_holds = |(body, own): (&Body, &Body)| {
            let partner_holds = match body.next_partner.into() {
                Partner::Disk(disk) => (disk as usize) < disks,
                Partner::Wall(wall) => wall < walls,
                Partner::Shell => true,
            };
            are_sane(body.position.iter().chain(&body.velocity).copied())
                && body.radius == own.radius
                && body.time.abs() <= FARTHEST
                && body.next_time >= body.time
                && partner_holds
        };
        let spin_holds = |spin: &Spin| are_sane([spin.angle, spin.angular_velocity]) && spin.since.abs() <= FARTHEST;
        let counts = &state.counts;
        let sums = [counts.energy_lost, counts.energy_input, counts.base_impulse];
        let watch = counts.watched_from;
        state.bodies.len() == disks
            && state.spins.len() == disks
            && state.bodies.iter().zip(&self.state.bodies).all(body_holds)
            && state.spins.iter().all(spin_holds)
            && are_sane(sums)
            && are_sane([watch.time, state.epoch])
            && counts.events().is_some_and(|events| watch.events <= events)
            && self.state.boundary.fits(&state.boundary, state.epoch)
            && state.shells.is_sound(&self.state.shells)
            && state.shells.entries.iter().all(|entry| entry.walls & !wall_set == 0)
    }

    /// Never fails.
    fn restore(&mut self, state: &EventDrivenState<B>, _time: f64) -> Result<(), EventDrivenStop> {
        self.state.clone_from(state);
        self.fill_calendar();
        Ok(())
    }
}

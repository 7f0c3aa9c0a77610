//! Event-driven dynamics: hard disks on parabolas between instantaneous impacts.
//!
//! Needs: disks that do not overlap. Guarantees: impacts in the order of time, momentum to rounding, no drift of a global
//! clock (each disk keeps its own time and flies only when it has an event), the same bits wherever the run is sampled and
//! after any rollback (the calendar is rebuilt from the disks' next times). A run that makes no progress stops with
//! time, place and remedy. Not here: when shapes meet (`geometry::time_of_impact`), what an impact does (`collision`).
//!
//! The main loop: next event, fly there, resolve, predict anew. Each disk has one event, its earliest; an event whose
//! partner had another impact in the meantime is recognised by the partner's count of impacts and predicted anew.

mod body;
mod boundary;
mod impacts;
mod observer;
mod prediction;
mod queue;
mod sawtooth;
mod shells;
mod space;
mod state;
mod tuning;
mod waiting;
mod walls;

use nalgebra::Vector2;

use super::{DiskMotion, WorkBudget};
use crate::collision::CollisionLaw;
use crate::geometry::Disk;

pub use body::{Body, PackedPartner, Partner, Spin};
pub use boundary::{Boundary, WallContact, WallHit};
pub use observer::{Observer, Unobserved};
pub use sawtooth::{PartImpacts, Sawtooth, ToothImpacts};
pub use space::{Open, Periodic, PeriodicAcross, Region, Space};
pub use state::{Counts, EventDrivenState, EventDrivenStop, NoHeadway};
pub use walls::{Moving, VibratingBase, Walls};

use prediction::Candidate;
use queue::Calendar;
use shells::Shells;
use state::Watch;

/// Local time \[s\] after which its origin moves on, so that differences of times keep their digits in long runs.
const EPOCH: f64 = 32.0;

/// Events between two checks of the watchdog, and the least time \[s\] that they must take for one disk; for n disks an
/// n-th. A collapsed disk goes on with a bounce for each unit in the last place of the time, some 1e-16 s; a disk at
/// 1e9 m/s leaves its shell as often as that. Disks in a dense packing have 1e6 events a second, not 1e10.
const WATCH_EVENTS: u64 = 100_000;
const WATCH_TIME: f64 = 1e-5;

/// The engine: collision law L, boundary B, space S.
#[derive(Debug, Clone)]
pub struct EventDriven<L, B, S> {
    law: L,
    gravity: f64,
    space: S,
    state: EventDrivenState<B>,
    calendar: Calendar,
    /// Of one prediction.
    candidates: Vec<Candidate>,
    /// 1/l with the moment of inertia `l m R^2`.
    inverse_inertia_factor: f64,
    work_of_event: u64,
}

/// What disks move in and how they collide.
#[derive(Debug, Clone)]
pub struct Model<L, B, S> {
    /// Collision law.
    pub law: L,
    /// Walls.
    pub boundary: B,
    /// Gravity \[m/s2\], downwards; 0 for a gas.
    pub gravity: f64,
    /// Open or periodic.
    pub space: S,
}

/// How a run is set up, besides its types.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Radius of a shell over the radius of its disk. Wide shells are renewed less often and have more neighbours: 1.3
    /// suits packings, whose disks stay where they are, 1.8 a gas.
    pub shell: f64,
    /// Time of the start \[s\].
    pub start_time: f64,
    /// Inertia factor l: the moment of inertia is `l m R^2`, 1/2 for a uniform disk, 2/5 for a ball.
    pub inertia_factor: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            shell: 1.3,
            start_time: 0.0,
            inertia_factor: 0.5,
        }
    }
}

impl<L: CollisionLaw, B: Boundary, S: Space> EventDriven<L, B, S> {
    /// Disks with their masses \[kg\] and velocities: x, y \[m/s\], angular \[rad/s\].
    pub fn new(
        model: Model<L, B, S>,
        disks: &[Disk],
        masses: &[f64],
        velocities: &[[f64; 3]],
        settings: Settings,
    ) -> Self {
        let Model {
            law,
            boundary,
            gravity,
            space,
        } = model;
        let bodies = disks.iter().zip(velocities).map(|(disk, &[vx, vy, _])| Body {
            position: disk.centre(),
            velocity: [vx, vy].into(),
            time: 0.0,
            radius: disk.radius,
            next_time: f64::INFINITY,
            impacts: 0,
            next_partner: Partner::Shell.into(),
        });
        let spins = velocities.iter().map(|&[_, _, angular_velocity]| Spin {
            angle: 0.0,
            angular_velocity,
            since: 0.0,
            periods: [0, 0],
        });
        let largest = disks.iter().map(|disk| disk.radius).fold(0.0, f64::max);
        let mut engine = Self {
            work_of_event: law.most_work() + boundary.most_work(largest),
            state: EventDrivenState {
                epoch: settings.start_time,
                bodies: bodies.collect(),
                spins: spins.collect(),
                boundary,
                counts: Counts::default(),
                shells: Shells::new(&space, disks, masses, settings.shell),
            },
            law,
            gravity,
            space,
            calendar: Calendar::default(),
            candidates: vec![Candidate::default(); 64],
            inverse_inertia_factor: 1.0 / settings.inertia_factor,
        };
        engine.calendar.reset(disks.len(), f64::INFINITY, 0.0);
        for disk in 0..disks.len() as u32 {
            engine.find_walls(disk);
            engine.predict(disk);
        }
        // The mean delay of an event is known only now.
        engine.fill_calendar();
        engine
    }

    /// Handles all events up to `end_time` \[s\] and takes their work off `work`; shows the flights that they end to the
    /// observer, which changes no bit. Flights that go on at the end are shown by [`Self::show_flights`].
    ///
    /// # Errors
    /// The run makes no progress, or there are more events than the budget allows; the state is then of no use.
    pub fn advance_observed(
        &mut self,
        end_time: f64,
        observer: &mut impl Observer,
        work: &mut WorkBudget,
    ) -> Result<(), EventDrivenStop> {
        loop {
            let end = end_time - self.state.epoch;
            let bodies = &self.state.bodies;
            let Some((time, disk)) = self.calendar.peek(|disk| bodies[disk as usize].next_time) else {
                return Ok(());
            };
            if time > end {
                return Ok(());
            }
            if !work.spend(self.work_of_event) {
                let (time, most) = (self.state.epoch + time, work.most() / self.work_of_event);
                return Err(EventDrivenStop::TooManyEvents { time, most });
            }
            self.calendar.pop();
            self.resolve(disk, time, observer).map_err(EventDrivenStop::NoHeadway)?;
            if time > EPOCH {
                self.begin_epoch();
                observer.shift_origin(EPOCH);
            }
        }
    }

    /// Shows the flights that go on at `time` \[s\], as far as that: needed once, at the end of an observation.
    pub fn show_flights(&self, time: f64, observer: &mut impl Observer) {
        let now = time - self.state.epoch;
        for (disk, body) in self.state.bodies.iter().enumerate() {
            observer.flight(disk as u32, body, now);
        }
    }

    /// The state: all that the future depends on.
    pub fn state(&self) -> &EventDrivenState<B> {
        &self.state
    }

    /// Work of all events since the start, in units of [`WorkBudget`].
    pub fn work_done(&self) -> u64 {
        let events = self.state.counts.events().unwrap_or(u64::MAX);
        events.saturating_mul(self.work_of_event)
    }

    /// Where the disks live.
    pub fn space(&self) -> &S {
        &self.space
    }

    /// Changes the boundary at `time` \[s\] and predicts anew all disks that are near a wall before or after. Shows the
    /// flights that it cuts in two.
    pub fn change_boundary(&mut self, time: f64, observer: &mut impl Observer, change: impl FnOnce(&mut B)) {
        change(&mut self.state.boundary);
        let now = time - self.state.epoch;
        for disk in 0..self.state.bodies.len() as u32 {
            let before = self.state.shells.entries[disk as usize].walls;
            self.find_walls(disk);
            if before | self.state.shells.entries[disk as usize].walls != 0 {
                self.fly(disk, now, observer);
                self.predict(disk);
            }
        }
    }

    /// Motion of a disk at `time` \[s\]; positions in a periodic cell go on beyond its edges.
    #[inline(always)]
    pub fn sample_at(&self, time: f64, disk: usize) -> DiskMotion {
        let now = time - self.state.epoch;
        let (mut body, spin) = (self.state.bodies[disk], &self.state.spins[disk]);
        body.fly(now, self.gravity);
        let periods = Vector2::from(spin.periods.map(f64::from));
        DiskMotion {
            position: body.position + self.space.region().size.component_mul(&periods),
            velocity: body.velocity,
            angle: spin.angle + spin.angular_velocity * (now - spin.since),
            angular_velocity: spin.angular_velocity,
        }
    }

    #[inline(always)]
    fn fly(&mut self, disk: u32, now: f64, observer: &mut impl Observer) {
        let body = &mut self.state.bodies[disk as usize];
        observer.flight(disk, body, now);
        body.fly(now, self.gravity);
    }

    fn resolve(&mut self, disk: u32, now: f64, observer: &mut impl Observer) -> Result<(), NoHeadway> {
        let partner: Partner = self.state.bodies[disk as usize].next_partner.into();
        self.fly(disk, now, observer);
        match partner {
            Partner::Shell => self.renew_shell(disk),
            Partner::Wall(wall) => self.collide_with_wall(disk, wall),
            Partner::Disk(other) => {
                let impacts = self.state.bodies[other as usize].impacts;
                if impacts == self.state.shells.entries[disk as usize].partner_impacts {
                    self.fly(other, now, observer);
                    self.collide_disks(disk, other);
                    self.predict(disk);
                    self.predict(other);
                    return self.watch(now, disk, partner);
                }
                self.state.counts.stale += 1;
            }
        }
        self.predict(disk);
        self.watch(now, disk, partner)
    }

    /// The disk is near the edge of its shell: it gets a new one around its position.
    fn renew_shell(&mut self, disk: u32) {
        let EventDrivenState {
            bodies,
            spins,
            shells,
            counts,
            ..
        } = &mut self.state;
        let body = &mut bodies[disk as usize];
        let position = self.space.wrapped(body.position);
        if position != body.position {
            let moved = (body.position - position).component_div(&self.space.region().size);
            for (periods, moved) in spins[disk as usize].periods.iter_mut().zip(&moved) {
                *periods += moved.round() as i32;
            }
            body.position = position;
        }
        counts.list_renewals += 1;
        shells.renew(&self.space, disk, position);
        self.find_walls(disk);
    }

    /// Finds the walls that the disk may hit while it is in its shell.
    fn find_walls(&mut self, disk: u32) {
        let radius = self.state.bodies[disk as usize].radius;
        let distance = radius + self.state.shells.slack(radius);
        let entry = &mut self.state.shells.entries[disk as usize];
        entry.walls = self.state.boundary.walls_within(distance, entry.centre);
    }

    fn watch(&mut self, now: f64, disk: u32, partner: Partner) -> Result<(), NoHeadway> {
        let counts = &mut self.state.counts;
        let since = counts.watched_from;
        let events = counts.disk_impacts + counts.wall_impacts + counts.list_renewals + counts.stale;
        if events - since.events < WATCH_EVENTS {
            return Ok(());
        }
        let time = self.state.epoch + now;
        counts.watched_from = Watch { events, time };
        let (events, duration) = (events - since.events, time - since.time);
        if duration >= WATCH_TIME / self.state.bodies.len() as f64 {
            return Ok(());
        }
        Err(NoHeadway {
            time,
            events,
            duration,
            disk,
            partner,
        })
    }

    /// Rebuilds the calendar from the disks' next times.
    fn fill_calendar(&mut self) {
        let bodies = &self.state.bodies;
        let finite = |body: &&Body| body.next_time.is_finite();
        let (mut earliest, mut delays, mut count) = (f64::INFINITY, 0.0, 0_u32);
        for body in bodies.iter().filter(finite) {
            earliest = earliest.min(body.next_time);
            delays += body.next_time - body.time;
            count += 1;
        }
        let earliest = if count > 0 { earliest } else { 0.0 };
        // What is pending waits longer than the mean event: a disk's next event is more often a long wait than a short.
        let mean_delay = 0.5 * delays / f64::from(count.max(1));
        self.calendar.reset(bodies.len(), mean_delay, earliest);
        for (disk, body) in bodies.iter().enumerate() {
            self.calendar.schedule(disk as u32, body.next_time);
        }
    }

    /// Moves the origin of local time on.
    fn begin_epoch(&mut self) {
        let EventDrivenState {
            epoch,
            bodies,
            spins,
            boundary,
            ..
        } = &mut self.state;
        *epoch += EPOCH;
        boundary.shift_origin(EPOCH);
        bodies.iter_mut().for_each(|body| {
            body.time -= EPOCH;
            body.next_time -= EPOCH;
        });
        spins.iter_mut().for_each(|spin| spin.since -= EPOCH);
        self.fill_calendar();
    }
}

//! Event-driven dynamics: hard disks on parabolas between instantaneous impacts.
//!
//! Needs: disks that do not overlap. Guarantees: impacts in the order of time, momentum to rounding, no drift of a global
//! clock (each disk keeps its own time and flies only when something happens to it), the same bits wherever one looks and
//! after any rollback (the calendar is made anew from the disks' next times). A run that makes no headway stops with
//! time, place and remedy. Not here: when shapes meet (`geometry::time_of_impact`), what an impact does (`collision`).
//!
//! The main loop: next event, fly there, resolve, predict anew. Each disk has one event, its earliest; an event whose
//! partner has met another in the meantime is recognised by the partner's count of impacts and predicted anew.

mod body;
mod boundary;
mod field;
mod impacts;
mod observer;
mod prediction;
mod queue;
mod sawtooth;
mod shells;
mod space;
mod state;
mod walls;

use super::WorkBudget;
use crate::collision::CollisionLaw;
use crate::geometry::Disk;

pub use body::{Body, Spin};
pub use boundary::{Boundary, Meeting, Unbounded};
pub use field::{Field, Gravity, Weightless};
pub use observer::{Observer, Unobserved};
pub use sawtooth::Sawtooth;
pub use space::{Open, Periodic, PeriodicAcross, Space};
pub use state::{Counts, NoHeadway, Partner, State, Stop};
pub use walls::{AtRandomPhase, Moving, VibratingBase, Walls};

use prediction::Candidate;
use queue::Calendar;
use shells::Shells;

/// Partner code: the disk may leave its shell.
const LEAVES_SHELL: u32 = u32::MAX;
/// Partner codes from here on are walls.
const WALLS: u32 = u32::MAX - 32;

/// Local time \[s\] after which its origin moves on, so that differences of times keep their digits in long runs.
const EPOCH: f64 = 32.0;

/// Events between two looks of the watchdog, and the least time \[s\] that they must take for one disk; for n disks an
/// n-th. A collapsed disk goes on with a bounce for each unit in the last place of the time, some 1e-16 s; a disk at
/// 1e9 m/s leaves its shell as often as that. Disks in a dense packing have 1e6 events a second, not 1e10.
const WATCH_EVENTS: u64 = 100_000;
const WATCH_TIME: f64 = 1e-5;

/// The engine: collision law L, boundary B, field F, space S.
#[derive(Debug, Clone)]
pub struct EventDriven<L, B, F, S> {
    law: L,
    field: F,
    space: S,
    state: State<B>,
    calendar: Calendar,
    near: Vec<Candidate>,
    /// 1/l with the moment of inertia `l m R^2`.
    inverse_inertia_factor: f64,
    work_of_event: u64,
}

/// How a run is set up, besides its types.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Radius of a shell over the radius of its disk. Wide shells are renewed less often and list more neighbours: 1.3
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

impl<L: CollisionLaw, B: Boundary, F: Field, S: Space> EventDriven<L, B, F, S> {
    /// Disks with their masses \[kg\] and velocities (x, y, angular).
    pub fn new(
        (law, boundary, field, space): (L, B, F, S),
        disks: &[Disk],
        masses: &[f64],
        velocities: &[[f64; 3]],
        settings: Settings,
    ) -> Self {
        let bodies = disks.iter().zip(velocities).map(|(disk, velocity)| Body {
            x: disk.x,
            y: disk.y,
            vx: velocity[0],
            vy: velocity[1],
            time: 0.0,
            radius: disk.radius,
            next_time: f64::INFINITY,
            impacts: 0,
            partner: LEAVES_SHELL,
        });
        let spins = velocities.iter().map(|velocity| Spin {
            angle: 0.0,
            angular_velocity: velocity[2],
            since: 0.0,
            periods: [0, 0],
        });
        let state = State {
            epoch: settings.start_time,
            bodies: bodies.collect(),
            spins: spins.collect(),
            boundary,
            counts: Counts::default(),
            shells: Shells::new(&space, disks, masses, settings.shell),
        };
        let near = vec![Candidate::default(); 64];
        let largest = disks.iter().map(|disk| disk.radius).fold(0.0, f64::max);
        let mut engine = Self {
            work_of_event: law.most_work() + state.boundary.most_work(largest),
            law,
            field,
            space,
            state,
            calendar: Calendar::default(),
            near,
            inverse_inertia_factor: 1.0 / settings.inertia_factor,
        };
        for disk in 0..engine.state.bodies.len() as u32 {
            engine.find_walls(disk);
        }
        engine.predict_all(0.0);
        engine
    }

    /// Handles all events up to `end_time` \[s\].
    ///
    /// # Errors
    /// The run makes no headway, or there are more events than one call may handle; the state is then of no use.
    pub fn advance_to(&mut self, end_time: f64) -> Result<(), Stop> {
        self.advance_observed(end_time, &mut Unobserved)
    }

    /// As [`Self::advance_to`], to the bit, and shows the flights that end on the way. What still flies at the end is
    /// shown by [`Self::show_flights`].
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub fn advance_observed(&mut self, end_time: f64, observer: &mut impl Observer) -> Result<(), Stop> {
        self.advance_within(end_time, observer, &mut WorkBudget::default())
    }

    /// As [`Self::advance_observed`], with the work that it takes taken off `work`.
    ///
    /// # Errors
    /// As [`Self::advance_to`].
    pub fn advance_within(
        &mut self,
        end_time: f64,
        observer: &mut impl Observer,
        work: &mut WorkBudget,
    ) -> Result<(), Stop> {
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
                return Err(Stop::TooManyEvents { time, most });
            }
            self.calendar.pop();
            self.resolve(disk, time, observer).map_err(Stop::NoHeadway)?;
            if time > EPOCH {
                self.begin_epoch();
                observer.shift(EPOCH);
            }
        }
    }

    /// Shows the flights that go on at `time` \[s\], as far as that: what an observer needs at its end and nowhere else.
    pub fn show_flights(&self, time: f64, observer: &mut impl Observer) {
        let now = time - self.state.epoch;
        for (disk, body) in self.state.bodies.iter().enumerate() {
            observer.flight(disk as u32, body, now);
        }
    }

    /// The state: all that the future depends on.
    pub fn state(&self) -> &State<B> {
        &self.state
    }

    /// Where the disks live.
    pub fn space(&self) -> &S {
        &self.space
    }

    /// Goes back (or on) to a state of this run.
    pub fn restore(&mut self, state: &State<B>) {
        self.state.clone_from(state);
        self.fill_calendar();
    }

    /// Changes the boundary at `time` \[s\] and predicts anew whoever is near a wall before or after.
    pub fn change_boundary(&mut self, time: f64, change: impl FnOnce(&mut B)) {
        self.change_boundary_observed(time, change, &mut Unobserved);
    }

    /// As [`Self::change_boundary`], and shows the flights that it cuts in two.
    pub fn change_boundary_observed(&mut self, time: f64, change: impl FnOnce(&mut B), observer: &mut impl Observer) {
        change(&mut self.state.boundary);
        let now = time - self.state.epoch;
        for disk in 0..self.state.bodies.len() as u32 {
            let before = self.state.shells.listings[disk as usize].walls;
            self.find_walls(disk);
            if before | self.state.shells.listings[disk as usize].walls != 0 {
                self.fly(disk, now, observer);
                self.predict(disk, now);
            }
        }
    }

    /// Place, velocity, angle and angular velocity of a disk at `time` \[s\], with periods undone.
    pub fn seen(&self, disk: usize, time: f64) -> ([f64; 2], [f64; 2], f64, f64) {
        let now = time - self.state.epoch;
        let (mut body, spin) = (self.state.bodies[disk], &self.state.spins[disk]);
        body.fly(now, self.field);
        let [width, height] = self.space.region().1;
        let place = [
            body.x + f64::from(spin.periods[0]) * width,
            body.y + f64::from(spin.periods[1]) * height,
        ];
        let angle = spin.angle + spin.angular_velocity * (now - spin.since);
        (place, [body.vx, body.vy], angle, spin.angular_velocity)
    }

    #[inline(always)]
    fn fly(&mut self, disk: u32, now: f64, observer: &mut impl Observer) {
        let body = &mut self.state.bodies[disk as usize];
        observer.flight(disk, body, now);
        body.fly(now, self.field);
    }

    fn resolve(&mut self, disk: u32, now: f64, observer: &mut impl Observer) -> Result<(), NoHeadway> {
        let partner = self.state.bodies[disk as usize].partner;
        self.fly(disk, now, observer);
        if partner == LEAVES_SHELL {
            self.renew_shell(disk);
            self.predict(disk, now);
            return self.watch(now, (disk, Partner::Shell));
        }
        if B::EXISTS && partner >= WALLS {
            self.meet_wall(disk, partner - WALLS, now);
            self.predict(disk, now);
            return self.watch(now, (disk, Partner::Wall(partner - WALLS)));
        }
        if self.state.bodies[partner as usize].impacts != self.state.shells.listings[disk as usize].partner_impacts {
            self.state.counts.stale += 1;
            self.predict(disk, now);
            return self.watch(now, (disk, Partner::Disk(partner)));
        }
        self.fly(partner, now, observer);
        self.meet_disk(disk, partner, now);
        self.predict(disk, now);
        self.predict(partner, now);
        self.watch(now, (disk, Partner::Disk(partner)))
    }

    /// The disk may be at the end of its shell: if it is near it, it gets a new shell where it is.
    fn renew_shell(&mut self, disk: u32) {
        let State {
            bodies,
            spins,
            shells,
            counts,
            ..
        } = &mut self.state;
        let body = &mut bodies[disk as usize];
        let place = self.space.wrapped([body.x, body.y]);
        if place != [body.x, body.y] {
            let [width, height] = self.space.region().1;
            let periods = &mut spins[disk as usize].periods;
            periods[0] += ((body.x - place[0]) / width).round() as i32;
            periods[1] += ((body.y - place[1]) / height).round() as i32;
            [body.x, body.y] = place;
        }
        counts.listings += 1;
        shells.relist(&self.space, disk, place);
        self.find_walls(disk);
    }

    fn find_walls(&mut self, disk: u32) {
        if B::EXISTS {
            let State {
                bodies,
                shells,
                boundary,
                ..
            } = &mut self.state;
            let radius = bodies[disk as usize].radius;
            let distance = radius + shells.slack(radius);
            let listing = &mut shells.listings[disk as usize];
            listing.walls = boundary.within_reach(listing.anchor, distance);
        }
    }

    fn watch(&mut self, now: f64, last: (u32, Partner)) -> Result<(), NoHeadway> {
        let counts = &mut self.state.counts;
        let since = counts.watched;
        let events = counts.disk_impacts + counts.wall_impacts + counts.listings + counts.stale;
        if events - since.0 < WATCH_EVENTS {
            return Ok(());
        }
        let time = self.state.epoch + now;
        counts.watched = (events, time);
        if time - since.1 >= WATCH_TIME / self.state.bodies.len() as f64 {
            return Ok(());
        }
        Err(NoHeadway {
            time,
            events: events - since.0,
            took: time - since.1,
            last,
        })
    }

    fn predict_all(&mut self, now: f64) {
        for disk in 0..self.state.bodies.len() as u32 {
            self.state.bodies[disk as usize].fly(now, self.field);
        }
        self.calendar.reset(self.state.bodies.len(), f64::INFINITY, now);
        for disk in 0..self.state.bodies.len() as u32 {
            self.predict(disk, now);
        }
        // The delays are known only now.
        self.fill_calendar();
    }

    /// Makes the calendar from the disks' next times.
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
        let State {
            epoch,
            bodies,
            spins,
            boundary,
            ..
        } = &mut self.state;
        *epoch += EPOCH;
        boundary.shift(EPOCH);
        bodies.iter_mut().for_each(|body| {
            body.time -= EPOCH;
            body.next_time -= EPOCH;
        });
        spins.iter_mut().for_each(|spin| spin.since -= EPOCH);
        self.fill_calendar();
    }
}

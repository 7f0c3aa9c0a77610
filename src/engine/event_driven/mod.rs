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
mod queue;
mod sawtooth;
mod shells;
mod space;
mod walls;

use serde::{Deserialize, Serialize};

use crate::collision::{CollisionLaw, Impact, effective_mass, tangential_mass};
use crate::error::are_sane;
use crate::geometry::Disk;

pub use body::{Body, Spin};
pub use boundary::{Boundary, Meeting, Unbounded};
pub use field::{Field, Gravity, Weightless};
pub use sawtooth::Sawtooth;
pub use space::{Open, Periodic, PeriodicAcross, Space};
pub use walls::{AtRandomPhase, Moving, VibratingBase, Walls};

use queue::Calendar;
use shells::{Listing, Shells};

/// Partner code: the disk may leave its shell.
const LEAVES_SHELL: u32 = u32::MAX;
/// Partner codes from here on are walls.
const WALLS: u32 = u32::MAX - 32;

/// Local time \[s\] after which its origin moves on, so that differences of times keep their digits in long runs.
const EPOCH: f64 = 32.0;

/// Farthest local time \[s\] from its origin.
const FARTHEST: f64 = 1e12;

/// Events between two looks of the watchdog, and the least time \[s\] that they must take for one disk; for n disks an
/// n-th. A collapsed disk goes on with a bounce for each unit in the last place of the time, some 1e-16 s; a disk at
/// 1e9 m/s leaves its shell as often as that. Disks in a dense packing have 1e6 events a second, not 1e10.
const WATCH_EVENTS: u64 = 100_000;
const WATCH_TIME: f64 = 1e-5;

/// What stopped a run.
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
    watched: (u64, f64),
}

impl Counts {
    /// All events, if there is room for as many again: a damaged count may be anything.
    fn events(&self) -> Option<u64> {
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
    shells: Shells,
}

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
}

/// A neighbour that approaches closely enough to be worth a square root.
#[derive(Debug, Clone, Copy, Default)]
struct Candidate {
    disk: u32,
    approach: f64,
    gap: f64,
    discriminant: f64,
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
        let mut engine = Self {
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
    /// The run makes no headway.
    pub fn advance_to(&mut self, end_time: f64) -> Result<(), NoHeadway> {
        loop {
            let end = end_time - self.state.epoch;
            let bodies = &self.state.bodies;
            let Some((time, disk)) = self.calendar.peek(|disk| bodies[disk as usize].next_time) else {
                return Ok(());
            };
            if time > end {
                return Ok(());
            }
            self.calendar.pop();
            self.resolve(disk, time)?;
            if time > EPOCH {
                self.begin_epoch();
            }
        }
    }

    /// The state: all that the future depends on.
    pub fn state(&self) -> &State<B> {
        &self.state
    }

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

    /// Goes back (or on) to a state of this run.
    pub fn restore(&mut self, state: &State<B>) {
        self.state.clone_from(state);
        self.fill_calendar();
    }

    /// Changes the boundary at `time` \[s\] and predicts anew whoever is near a wall before or after.
    pub fn change_boundary(&mut self, time: f64, change: impl FnOnce(&mut B)) {
        change(&mut self.state.boundary);
        let now = time - self.state.epoch;
        for disk in 0..self.state.bodies.len() as u32 {
            let before = self.state.shells.listings[disk as usize].walls;
            self.find_walls(disk);
            if before | self.state.shells.listings[disk as usize].walls != 0 {
                self.state.bodies[disk as usize].fly(now, self.field);
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

    fn resolve(&mut self, disk: u32, now: f64) -> Result<(), NoHeadway> {
        let partner = self.state.bodies[disk as usize].partner;
        if partner == LEAVES_SHELL {
            self.renew_shell(disk, now);
            self.predict(disk, now);
            return self.watch(now, (disk, Partner::Shell));
        }
        self.state.bodies[disk as usize].fly(now, self.field);
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
        self.meet_disk(disk, partner, now);
        self.predict(disk, now);
        self.predict(partner, now);
        self.watch(now, (disk, Partner::Disk(partner)))
    }

    fn meet_disk(&mut self, first: u32, second: u32, now: f64) {
        let inverse_factor = self.inverse_inertia_factor;
        let State {
            bodies,
            spins,
            shells,
            counts,
            ..
        } = &mut self.state;
        let (i, j) = (first as usize, second as usize);
        bodies[j].fly(now, self.field);
        let (a, b) = (bodies[i], bodies[j]);
        let mut separation = [a.x - b.x, a.y - b.y];
        let (here, there) = (&shells.listings[i], &shells.listings[j]);
        if here.at_edge {
            separation = self.space.shortest(separation);
        }
        let inverse = 1.0 / (separation[0] * separation[0] + separation[1] * separation[1]).sqrt();
        let n = [separation[0] * inverse, separation[1] * inverse];
        let (vx, vy) = (a.vx - b.vx, a.vy - b.vy);
        let spin = |disk: usize| if L::ROTATES { spins[disk].angular_velocity } else { 0.0 };
        let since = |disk: usize| {
            if L::REMEMBERS {
                spins[disk].since
            } else {
                f64::NEG_INFINITY
            }
        };
        let turning = a.radius * spin(i) + b.radius * spin(j);
        let impact = Impact {
            effective_mass: effective_mass(here.inverse_mass, there.inverse_mass),
            tangential_mass: tangential_mass(
                here.inverse_mass,
                there.inverse_mass,
                inverse_factor * here.inverse_mass,
                inverse_factor * there.inverse_mass,
            ),
            normal_velocity: (vx * n[0] + vy * n[1]).min(0.0),
            tangential_velocity: vx * n[1] - vy * n[0] + turning,
            time_since_last: now - since(i).max(since(j)),
        };
        let impulse = self.law.impulse(&impact);
        let (along, across) = (impulse.normal, impulse.tangential);
        let push = [along * n[0] + across * n[1], along * n[1] - across * n[0]];
        for (disk, signed_inverse_mass) in [(i, here.inverse_mass), (j, -there.inverse_mass)] {
            let body = &mut bodies[disk];
            body.vx += push[0] * signed_inverse_mass;
            body.vy += push[1] * signed_inverse_mass;
            body.impacts = body.impacts.wrapping_add(1);
            let lever = inverse_factor * signed_inverse_mass.abs() / body.radius;
            turn::<L>(&mut spins[disk], lever, across, now);
        }
        counts.disk_impacts += 1;
        counts.energy_lost += heat(&impact, along, across);
    }

    fn meet_wall(&mut self, disk: u32, wall: u32, now: f64) {
        let inverse_factor = self.inverse_inertia_factor;
        let State {
            bodies,
            spins,
            boundary,
            counts,
            shells,
            ..
        } = &mut self.state;
        let (body, spin) = (&mut bodies[disk as usize], &mut spins[disk as usize]);
        let inverse_mass = shells.listings[disk as usize].inverse_mass;
        let impact_at = |normal_velocity: f64, tangential_velocity: f64| Impact {
            effective_mass: 1.0 / inverse_mass,
            tangential_mass: tangential_mass(inverse_mass, 0.0, inverse_factor * inverse_mass, 0.0),
            normal_velocity,
            tangential_velocity,
            time_since_last: now - spin.since,
        };
        // Asked before the tangential velocity is known, which no law needs for the normal one.
        let law = &self.law;
        let separation = |approach: f64| law.separation_velocity(&impact_at(approach, 0.0));
        let meeting = boundary.meet(wall, body, now, separation);
        let n = meeting.normal;
        let (vx, vy) = (body.vx - meeting.velocity[0], body.vy - meeting.velocity[1]);
        let turning = if L::ROTATES {
            body.radius * spin.angular_velocity
        } else {
            0.0
        };
        let impact = impact_at((vx * n[0] + vy * n[1]).min(0.0), vx * n[1] - vy * n[0] + turning);
        let impulse = law.impulse(&impact);
        let (along, across) = (impulse.normal, impulse.tangential);
        let push = [along * n[0] + across * n[1], along * n[1] - across * n[0]];
        body.vx += push[0] * inverse_mass;
        body.vy += push[1] * inverse_mass;
        body.impacts = body.impacts.wrapping_add(1);
        turn::<L>(spin, inverse_factor * inverse_mass / body.radius, across, now);
        counts.wall_impacts += 1;
        counts.energy_lost += heat(&impact, along, across);
        counts.energy_input += push[0] * meeting.velocity[0] + push[1] * meeting.velocity[1];
        if boundary.is_base(wall) {
            counts.base_impulse += push[1];
        }
    }

    /// Finds the next event of a disk that is at `now`.
    fn predict(&mut self, disk: u32, now: f64) {
        let State {
            bodies,
            shells,
            boundary,
            ..
        } = &mut self.state;
        let body = bodies[disk as usize];
        let gravity = self.field.gravity();
        let Listing {
            anchor, at_edge, walls, ..
        } = shells.listings[disk as usize];
        let mut earliest = time_in_shell(&body, anchor, shells.slack(body.radius), gravity);
        let mut partner = LEAVES_SHELL;

        let neighbours = shells.neighbours(disk);
        if self.near.len() < neighbours.len() {
            self.near.resize(neighbours.len(), Candidate::default());
        }
        // Two passes: the first has no branch that depends on velocities, the second only takes roots worth taking.
        let mut count = 0;
        for &other in neighbours {
            let there = &bodies[other as usize];
            let ahead = now - there.time;
            let fall = ahead * gravity;
            let mut separation = [
                body.x - there.x - ahead * there.vx,
                body.y - there.y - ahead * (there.vy - 0.5 * fall),
            ];
            if at_edge {
                separation = self.space.shortest(separation);
            }
            let (vx, vy) = (body.vx - there.vx, body.vy - (there.vy - fall));
            let distance = body.radius + there.radius;
            let squared = distance * distance;
            let approach = -(separation[0] * vx + separation[1] * vy);
            let gap = separation[0] * separation[0] + separation[1] * separation[1] - squared;
            let speed = vx * vx + vy * vy;
            let cross = separation[0] * vy - separation[1] * vx;
            let discriminant = speed * squared - cross * cross;
            self.near[count] = Candidate {
                disk: other,
                approach,
                gap,
                discriminant,
            };
            count += usize::from((approach > 0.0) & (discriminant >= 0.0));
        }
        for candidate in &self.near[..count] {
            // `gap / (2 approach)` bounds the time to touch from below.
            if candidate.gap >= 2.0 * candidate.approach * earliest {
                continue;
            }
            let delay = if candidate.gap > 0.0 {
                candidate.gap / (candidate.approach + candidate.discriminant.sqrt())
            } else {
                0.0
            };
            if delay < earliest {
                (earliest, partner) = (delay, candidate.disk);
            }
        }

        if B::EXISTS && walls != 0 {
            let (delay, wall) = boundary.first_hit(walls, &body, now, gravity, earliest);
            if delay < earliest {
                (earliest, partner) = (delay, WALLS + wall);
            }
        }
        if partner < WALLS {
            shells.listings[disk as usize].partner_impacts = bodies[partner as usize].impacts;
        }
        let body = &mut bodies[disk as usize];
        body.partner = partner;
        body.next_time = now + earliest;
        self.calendar.schedule(disk, body.next_time);
    }

    /// The disk may be at the end of its shell: if it is near it, it gets a new shell where it is.
    fn renew_shell(&mut self, disk: u32, now: f64) {
        let State {
            bodies,
            spins,
            shells,
            counts,
            ..
        } = &mut self.state;
        let body = &mut bodies[disk as usize];
        body.fly(now, self.field);
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

/// Brings the angle up to `now` and applies the tangential impulse; `lever` = R/I.
#[inline(always)]
fn turn<L: CollisionLaw>(spin: &mut Spin, lever: f64, across: f64, now: f64) {
    if L::ROTATES {
        spin.angle += spin.angular_velocity * (now - spin.since);
        spin.angular_velocity += lever * across;
    }
    if L::ROTATES || L::REMEMBERS {
        spin.since = now;
    }
}

/// Energy lost in an impact \[J\]: minus the work of both impulses at the mean velocities.
#[inline(always)]
fn heat(impact: &Impact, along: f64, across: f64) -> f64 {
    let normal = impact.normal_velocity + 0.5 * along / impact.effective_mass;
    let tangential = impact.tangential_velocity + 0.5 * across / impact.tangential_mass;
    -along * normal - across * tangential
}

/// A time \[s\] within which the disk surely stays in its shell; exact without gravity.
#[inline(always)]
fn time_in_shell(body: &Body, anchor: [f64; 2], slack: f64, gravity: f64) -> f64 {
    let (dx, dy) = (body.x - anchor[0], body.y - anchor[1]);
    let squared = body.vx * body.vx + body.vy * body.vy;
    if gravity == 0.0 {
        let outward = dx * body.vx + dy * body.vy;
        let room = slack * slack - dx * dx - dy * dy;
        let discriminant = outward * outward + squared * room;
        let time = room / (outward + discriminant.max(0.0).sqrt());
        return if time > 0.0 { time } else { 0.0 };
    }
    // |r(t)| <= |r| + |v| t + g t^2 / 2
    let room = (slack - dx.hypot(dy)).max(0.0);
    2.0 * room / (squared.sqrt() + (squared + 2.0 * gravity * room).sqrt())
}

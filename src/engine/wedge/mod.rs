//! One disk in a vibrated wedge, from impact to impact: exact flights, instantaneous impacts.
//!
//! With walls [`AtRandomPhase`](crate::drive::AtRandomPhase) this is the map of P 6.3.1, with a drive the exact event-driven
//! wedge. The map is written in the position along the wall that was hit last ([`WedgeFrame`]) instead of the height y of
//! P 6.16 to 6.39, which divides by the sine and the cosine of the walls' angles.
//!
//! Needs: `|tilt| < theta_0`. Guarantees: the trajectory depends on its impacts alone, so that where and how often it is
//! sampled changes no bit of what follows; the gap to the wall just left is zero to the last bit; energy and momentum
//! balance to rounding ([`Sums`]). Memory does not grow. Not here: what an impact does (`collision`), how the walls move
//! ([`BaseMotion`]).

mod frame;
mod state;

use nalgebra::Vector2;

use super::{DiskMotion, Engine, WorkBudget};
use crate::collision::{CollisionLaw, Impact, tangential_mass};
use crate::drive::{BaseMotion, Motion};
use crate::geometry::{Flight, clockwise};

pub use frame::{Side, WedgeFrame};
pub use state::{Sums, WedgeState};

/// What stays as it is during a run. Mass scales forces and energies only: the motion is that of a unit mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WedgeSetup {
    /// Aperture and tilt.
    pub frame: WedgeFrame,
    /// Radius R of the disk \[m\].
    pub radius: f64,
    /// Gravity \[m/s2\], above 0.
    pub gravity: f64,
    /// Impacts that leave the wall at no more than this \[m/s\] are counted as slow: the velocity floor, if there is one.
    pub slow: f64,
}

/// Start of a disk without spin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Start {
    /// Time \[s\].
    pub time: f64,
    /// Height \[m\] up the bisector from where the disk would touch both walls.
    pub height: f64,
    /// Velocity \[m/s\] to the right, across the bisector.
    pub sideways: f64,
}

/// What stopped a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WedgeStop {
    /// The disk no longer gets off the walls.
    Stuck(Stuck),
    /// One call had more impacts to do than it may.
    TooManyImpacts {
        /// Time reached \[s\].
        time: f64,
        /// Impacts that one call may do.
        most: u64,
    },
}

/// Where the disk no longer gets off the walls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stuck {
    /// Time \[s\].
    pub time: f64,
    /// Wall that was hit last.
    pub side: Side,
    /// Position of the centre along that wall, from the vertex of the shifted wedge \[m\].
    pub along: f64,
    /// Impacts without progress of time.
    pub collisions: u32,
}

/// Impacts after which the watchdog checks the time.
const WATCHED: u32 = 100_000;
/// Time \[s\] in which so many impacts are no progress: 1e10 impacts a second are none that a run could live through.
pub const NO_PROGRESS: f64 = 1e-5;

/// The engine: impact law L of a disk of unit mass at a wall, motion of the walls B.
#[derive(Debug, Clone)]
pub struct DiskInWedge<L, B> {
    setup: WedgeSetup,
    law: L,
    tangential_mass: f64,
    state: WedgeState<B>,
    work_of_impact: u64,
}

impl<L: CollisionLaw, B: BaseMotion> DiskInWedge<L, B> {
    /// A disk that starts as `start` says.
    pub fn new(setup: WedgeSetup, law: L, walls: B, start: Start) -> Self {
        let Start { time, height, sideways } = start;
        let side = if sideways > 0.0 { Side::Right } else { Side::Left };
        let bisector = setup.frame.bisector();
        let state = WedgeState {
            base: walls.motion(time),
            walls,
            time,
            side,
            position: height * bisector,
            velocity: sideways.abs() * clockwise(&bisector),
            surface_velocity: 0.0,
            arc_length: 0.0,
            next_side: side,
            delay: f64::INFINITY,
            sums: Sums::default(),
            watched_since: time,
            watched: 0,
        };
        let mut engine = Self {
            setup,
            work_of_impact: law.most_work(),
            law,
            tangential_mass: tangential_mass(1.0, 0.0, 2.0, 0.0),
            state,
        };
        engine.predict();
        engine
    }

    /// Flies to the next wall and bounces there.
    ///
    /// # Errors
    /// The disk is stuck; the state is then of no use. Call it only while a next impact is known (a finite delay).
    #[inline]
    pub fn next_impact(&mut self) -> Result<(), Stuck> {
        let state = &mut self.state;
        let base = state.walls.motion(state.time + state.delay);
        (state.position, state.velocity) = motion_after(&self.setup, state, state.delay, base);
        state.time += state.delay;
        state.base = base;
        state.arc_length += state.surface_velocity * state.delay;
        if state.next_side != state.side {
            state.position = self.setup.frame.reflected(state.position);
            state.velocity = self.setup.frame.reflected(state.velocity);
        }
        state.side = state.next_side;
        state.position.y = 0.0;
        if !self.bounce() {
            return Err(self.stuck(1));
        }
        self.predict();
        self.watch()
    }

    /// Moves the start of the flight to `time` \[s\], under the motion of the walls as it is, then changes that motion.
    pub fn steer(&mut self, time: f64, change: impl FnOnce(&mut B)) {
        let state = &mut self.state;
        let delay = time - state.time;
        let base = state.walls.motion(time);
        (state.position, state.velocity) = motion_after(&self.setup, state, delay, base);
        state.arc_length += state.surface_velocity * delay;
        state.time = time;
        change(&mut state.walls);
        state.base = state.walls.motion(time);
        self.predict();
    }

    /// Collides by another law from now on.
    pub fn set_law(&mut self, law: L) {
        self.work_of_impact = law.most_work();
        self.law = law;
    }

    /// Changes gravity \[m/s2\], above 0, at `time` \[s\], which must lie in the present flight.
    pub fn set_gravity(&mut self, time: f64, gravity: f64) {
        self.steer(time, |_| ());
        self.setup.gravity = gravity;
        self.predict();
    }

    /// The impact law.
    pub fn law(&self) -> &L {
        &self.law
    }

    /// All that the future depends on.
    pub fn state(&self) -> &WedgeState<B> {
        &self.state
    }

    /// What stays as it is.
    pub fn setup(&self) -> &WedgeSetup {
        &self.setup
    }

    /// Motion of the walls at `time` \[s\].
    pub fn base(&self, time: f64) -> Motion {
        self.state.walls.motion(time)
    }

    /// Motion of the disk at `time` \[s\], which must lie in the present flight, from the wedge's own vertex while the walls
    /// are at rest.
    pub fn sample_at(&self, time: f64) -> DiskMotion {
        let (WedgeSetup { frame, radius, .. }, state) = (&self.setup, &self.state);
        let delay = time - state.time;
        let base = self.base(time);
        let (position, velocity) = motion_after(&self.setup, state, delay, base);
        let bisector = frame.bisector();
        let shift = Vector2::new(radius / bisector.y * bisector.x, *radius);
        let mut position = frame.to_laboratory(state.side, position + shift);
        position.y += base.displacement;
        DiskMotion {
            position,
            velocity: frame.to_laboratory(state.side, velocity),
            angle: (state.arc_length + state.surface_velocity * delay) / radius,
            angular_velocity: state.surface_velocity / radius,
        }
    }

    /// P 2.11, 2.23, 2.24 in the frame of the wall. False if the disk does not get off the wall.
    #[inline]
    fn bounce(&mut self) -> bool {
        let state = &mut self.state;
        let (up, sign) = (self.setup.frame.up(state.side), state.side.sign());
        let impact = |wall_velocity: f64| Impact {
            effective_mass: 1.0,
            tangential_mass: self.tangential_mass,
            normal_velocity: state.velocity.y - wall_velocity * up.y,
            tangential_velocity: state.velocity.x - wall_velocity * up.x + sign * state.surface_velocity,
            time_since_last: f64::INFINITY,
        };
        let leaves =
            |wall_velocity: f64| self.law.separation_velocity(&impact(wall_velocity)) + wall_velocity * up.y > 0.0;
        let sampled = state
            .walls
            .velocity_at_impact(state.base, state.velocity.y, up.y, leaves);
        let Some(wall_velocity) = sampled else {
            return false;
        };
        let before = impact(wall_velocity);
        let impulse = self.law.impulse(&before);
        let momentum = Vector2::new(impulse.tangential, impulse.normal);
        state.velocity += momentum;
        state.surface_velocity += sign * 2.0 * impulse.tangential;
        let upward = momentum.dot(&up);
        let normal = before.normal_velocity + 0.5 * impulse.normal;
        let tangential = before.tangential_velocity + 0.5 * impulse.tangential / self.tangential_mass;
        state.sums.velocity += upward;
        state.sums.input += upward * wall_velocity;
        state.sums.lost -= impulse.normal * normal + impulse.tangential * tangential;
        state.sums.collisions += 1;
        let separation = before.normal_velocity + impulse.normal;
        state.sums.slow_collisions += u64::from(separation <= self.setup.slow * (1.0 + 1e-9));
        true
    }

    /// Finds the next impact.
    #[inline]
    fn predict(&mut self) {
        let (WedgeSetup { frame, gravity, .. }, state) = (&self.setup, &mut self.state);
        let base = state.base.velocity;
        let delay = |side: Side, position: Vector2<f64>, velocity: Vector2<f64>| {
            let up = frame.up(side).y;
            let flight = Flight {
                gap: position.y,
                velocity: velocity.y - base * up,
                pull: gravity * up,
            };
            state.walls.first_hit(state.time, &flight, up)
        };
        let (here, there) = (state.side, state.side.other());
        let same = delay(here, state.position, state.velocity);
        let crossing = delay(there, frame.reflected(state.position), frame.reflected(state.velocity));
        (state.next_side, state.delay) = if crossing < same {
            (there, crossing)
        } else {
            (here, same)
        };
    }

    #[inline]
    fn watch(&mut self) -> Result<(), Stuck> {
        let state = &mut self.state;
        state.watched += 1;
        if state.watched < WATCHED {
            return Ok(());
        }
        if state.time - state.watched_since < NO_PROGRESS {
            return Err(self.stuck(WATCHED));
        }
        (state.watched, state.watched_since) = (0, state.time);
        Ok(())
    }

    #[cold]
    fn stuck(&self, collisions: u32) -> Stuck {
        let state = &self.state;
        Stuck {
            time: state.time,
            side: state.side,
            along: state.position.x,
            collisions,
        }
    }
}

impl<L: CollisionLaw, B: BaseMotion> Engine for DiskInWedge<L, B> {
    type State = WedgeState<B>;
    type Stop = WedgeStop;

    /// Does all impacts up to `end_time` \[s\]. After an error the state is that of the last impact and of no use.
    fn advance_within(&mut self, end_time: f64, budget: &mut WorkBudget) -> Result<(), WedgeStop> {
        while self.state.time + self.state.delay <= end_time {
            if !budget.spend(self.work_of_impact) {
                let (time, most) = (self.state.time, budget.most() / self.work_of_impact);
                return Err(WedgeStop::TooManyImpacts { time, most });
            }
            self.next_impact().map_err(WedgeStop::Stuck)?;
        }
        Ok(())
    }

    fn copied_state(&self) -> WedgeState<B> {
        self.state.clone()
    }

    /// A finite flight that `time` lies in.
    fn fits(&self, state: &WedgeState<B>, time: f64) -> bool {
        let numbers = [
            state.time,
            state.position.x,
            state.position.y,
            state.velocity.x,
            state.velocity.y,
            state.surface_velocity,
            state.arc_length,
            state.base.displacement,
            state.base.velocity,
        ];
        let in_flight = state.time <= time && time < state.time + state.delay;
        numbers.iter().all(|number| number.is_finite()) && state.delay >= 0.0 && in_flight
    }

    /// Never fails.
    fn restore(&mut self, state: &WedgeState<B>, _time: f64) -> Result<(), WedgeStop> {
        self.state.clone_from(state);
        Ok(())
    }
}

/// Position on the wedge and velocity in the laboratory, `delay` \[s\] after the start of the flight, with the walls at `base`.
#[inline]
fn motion_after<B>(
    setup: &WedgeSetup,
    state: &WedgeState<B>,
    delay: f64,
    base: Motion,
) -> (Vector2<f64>, Vector2<f64>) {
    let up = setup.frame.up(state.side);
    let rise = base.displacement - state.base.displacement;
    let fall = 0.5 * setup.gravity * delay * delay + rise;
    (
        state.position + state.velocity * delay - fall * up,
        state.velocity - setup.gravity * delay * up,
    )
}

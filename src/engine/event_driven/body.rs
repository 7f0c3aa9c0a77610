//! One disk in flight.

use serde::{Deserialize, Serialize};

use super::field::Field;

/// What prediction reads: one cache line. Place and velocity are those at the disk's own `time`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[repr(align(64))]
pub struct Body {
    /// Centre, to the right \[m\].
    pub x: f64,
    /// Centre, up \[m\].
    pub y: f64,
    /// Velocity, to the right \[m/s\].
    pub vx: f64,
    /// Velocity, up \[m/s\].
    pub vy: f64,
    /// Local time of place and velocity \[s\].
    pub time: f64,
    /// Radius \[m\].
    pub radius: f64,
    /// Local time of its next event \[s\].
    pub next_time: f64,
    /// Impacts so far, which tells a prediction with an older velocity.
    pub impacts: u32,
    /// Partner of its next event: a disk, or one of the codes of the engine.
    pub partner: u32,
}

impl Body {
    /// Flies on to `now` \[s\].
    #[inline(always)]
    pub fn fly<F: Field>(&mut self, now: f64, field: F) {
        let ahead = now - self.time;
        let fall = ahead * field.gravity();
        self.x += ahead * self.vx;
        self.y += ahead * (self.vy - 0.5 * fall);
        self.vy -= fall;
        self.time = now;
    }
}

/// What only impacts read.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spin {
    /// Angle \[rad\] at `since`.
    pub angle: f64,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: f64,
    /// Local time of the last impact \[s\]; before the first, of the start.
    pub since: f64,
    /// Periods that the disk has been moved by, to the right and up.
    pub periods: [i32; 2],
}

//! One disk in flight.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};

/// What prediction reads: one cache line. Position and velocity are those at the disk's own `time`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[repr(align(64))]
pub struct Body {
    /// Centre \[m\], y up.
    pub position: Vector2<f64>,
    /// Velocity \[m/s\].
    pub velocity: Vector2<f64>,
    /// Local time of position and velocity \[s\].
    pub time: f64,
    /// Radius \[m\].
    pub radius: f64,
    /// Local time of its next event \[s\].
    pub next_time: f64,
    /// Impacts so far: a prediction that was made at another count is stale.
    pub impacts: u32,
    /// Partner of its next event.
    pub next_partner: PackedPartner,
}

impl Body {
    /// Flies on to `now` \[s\] under `gravity` \[m/s2\].
    #[inline(always)]
    pub fn fly(&mut self, now: f64, gravity: f64) {
        (self.position, self.velocity) = self.motion_after(now - self.time, gravity);
        self.time = now;
    }

    /// Position and velocity `delay` \[s\] later.
    #[inline(always)]
    pub fn motion_after(&self, delay: f64, gravity: f64) -> (Vector2<f64>, Vector2<f64>) {
        let (velocity, fall) = (self.velocity, delay * gravity);
        let mean = Vector2::new(velocity.x, velocity.y - 0.5 * fall);
        (
            self.position + delay * mean,
            Vector2::new(velocity.x, velocity.y - fall),
        )
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
    /// Periods of a periodic cell that the disk has been moved by, to the right and up.
    pub periods: [i32; 2],
}

/// Partner of an event of a disk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Partner {
    /// Another disk.
    Disk(u32),
    /// A wall.
    Wall(u32),
    /// None: the disk may leave its shell, which fast disks do often.
    Shell,
}

/// A [`Partner`] in four bytes instead of eight, with which a [`Body`] would not fit a cache line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PackedPartner(u32);

/// Numbers from here on are walls, at most 32; the last is the shell.
const WALLS: u32 = u32::MAX - 32;

impl From<Partner> for PackedPartner {
    #[inline(always)]
    fn from(partner: Partner) -> Self {
        Self(match partner {
            Partner::Disk(disk) => disk,
            Partner::Wall(wall) => WALLS + wall,
            Partner::Shell => u32::MAX,
        })
    }
}

impl From<PackedPartner> for Partner {
    #[inline(always)]
    fn from(PackedPartner(code): PackedPartner) -> Self {
        match code {
            u32::MAX => Self::Shell,
            WALLS.. => Self::Wall(code - WALLS),
            _ => Self::Disk(code),
        }
    }
}

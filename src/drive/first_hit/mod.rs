//! When a disk in flight meets a base that moves: the flight along the wall's normal in, the delay of the first hit out.
//!
//! Needs: finite numbers. Guarantees: the hit is the first one and is accurate to rounding; the gap stays positive until
//! then, beyond rounding; the contact just left is no hit while the bodies part; a delay is never negative and never
//! NaN; infinity means never, or not before the base's motion becomes unknown. A flight whose gap has a minimum within
//! rounding of zero may count as a hit or as a miss.
//! Not here: walls at rest (`geometry::disk_wall`), what an impact does (`collision`).
//!
//! Everything is relative to the wall as it stands and moves at the start, so that flights of a billionth of a period,
//! between the last bounces of a disk that comes to rest, keep their digits.

mod quintic;
mod sine;

use super::Drive;
use crate::geometry::Flight;

/// A base for which the first hit is found.
pub trait FirstHit: Drive {
    /// Delay \[s\] from `time` \[s\] until the disk meets the wall, or infinity.
    ///
    /// `flight.gap` and `flight.velocity` are relative to the moving wall at `time`, `flight.pull` is the acceleration of
    /// the disk alone. `normal_up` = n_y is the vertical part of the wall's normal, of either sign: the wall moves along
    /// its normal by n_y times the displacement of the base. Source: F B16 as corrected; P 2.37.
    fn first_hit(&self, time: f64, flight: &Flight, normal_up: f64) -> f64;
}

//! What a run is made of and what can stop it.

use crate::geometry::Wall;

use super::forces::ContactLaws;

/// What stays as it is during a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Contact laws.
    pub laws: ContactLaws,
    /// Walls; those that follow the base move with the drive.
    pub walls: Vec<Wall>,
    /// Mass of each disk \[kg\]; the moment of inertia is that of a uniform disk.
    pub masses: Vec<f64>,
    /// Gravity \[m/s2\], downwards.
    pub gravity: f64,
    /// Time step \[s\].
    pub time_step: f64,
    /// Time of step 0 \[s\].
    pub start_time: f64,
}

/// What stopped a run, with the time \[s\] at which it showed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Breakdown {
    /// Two bodies overlap by `overlap` \[m\], more than half of the smallest radius \[m\].
    TooDeep {
        /// Time \[s\].
        time: f64,
        /// Overlap \[m\].
        overlap: f64,
        /// Largest allowed overlap \[m\].
        allowed: f64,
    },
    /// A disk moved by `distance` \[m\] in one time step, more than half of the smallest radius \[m\].
    TooFast {
        /// Time \[s\].
        time: f64,
        /// Distance in one step \[m\].
        distance: f64,
        /// Largest allowed distance \[m\].
        allowed: f64,
    },
    /// A position is no longer a number.
    NotFinite {
        /// Time \[s\].
        time: f64,
    },
    /// More time steps are asked for in one call than can be done.
    TooManySteps {
        /// Time \[s\].
        time: f64,
        /// Steps asked for.
        steps: f64,
        /// Steps that one call may do.
        most: f64,
    },
}

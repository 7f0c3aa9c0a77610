//! The constants of a run and what can stop it.

use crate::contact::{ContactLaws, LinearDashpot};
use crate::geometry::{Disk, Wall};

/// What stays constant during a run.
#[derive(Debug, Clone, PartialEq)]
pub struct SoftDiskSetup<N = LinearDashpot> {
    /// Contact laws.
    pub laws: ContactLaws<N>,
    /// Walls; those that follow the base move with the drive.
    pub walls: Vec<Wall>,
    /// Mass of each disk \[kg\]; the moment of inertia is that of a uniform disk. Disks that the drive moves have the mass 0: they
    /// belong to the floor, which is the first wall, and have neither energy nor momentum.
    pub masses: Vec<f64>,
    /// Gravity \[m/s2\], downwards.
    pub gravity: f64,
    /// Time step \[s\].
    pub time_step: f64,
    /// Time of step 0 \[s\].
    pub start_time: f64,
}

/// A [`SoftDiskSetup`] with the radii of its disks.
#[derive(Debug, Clone, PartialEq)]
pub struct SoftDisks<N = LinearDashpot> {
    /// Laws, walls, masses and times.
    pub setup: SoftDiskSetup<N>,
    /// Radii \[m\].
    pub radii: Vec<f64>,
    /// The smallest radius \[m\].
    pub smallest_radius: f64,
}

impl<N> SoftDisks<N> {
    /// `setup` for these disks.
    pub fn new(setup: SoftDiskSetup<N>, disks: &[Disk]) -> Self {
        let radii: Vec<f64> = disks.iter().map(|disk| disk.radius).collect();
        let smallest_radius = radii.iter().copied().fold(f64::INFINITY, f64::min);
        Self {
            setup,
            radii,
            smallest_radius,
        }
    }

    /// Time \[s\] after so many steps.
    pub fn time_of(&self, steps: u64) -> f64 {
        self.setup.start_time + steps as f64 * self.setup.time_step
    }

    /// Refuses an overlap \[m\] of more than half of the smallest radius.
    ///
    /// # Errors
    /// [`Breakdown::TooDeep`].
    pub fn check_overlap(&self, overlap: f64, time: f64) -> Result<(), Breakdown> {
        let allowed = 0.5 * self.smallest_radius;
        if overlap > allowed {
            return Err(Breakdown::TooDeep { time, overlap, allowed });
        }
        Ok(())
    }

    /// Refuses a distance \[m\] travelled in one step of more than half of the smallest radius: the neighbour list could
    /// miss contacts.
    ///
    /// # Errors
    /// [`Breakdown::TooFast`].
    pub fn check_distance(&self, distance: f64, time: f64) -> Result<(), Breakdown> {
        let allowed = 0.5 * self.smallest_radius;
        if distance > allowed {
            return Err(Breakdown::TooFast {
                time,
                distance,
                allowed,
            });
        }
        Ok(())
    }
}

/// What stopped a run, with the time \[s\] at which it was found.
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

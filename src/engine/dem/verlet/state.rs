//! Everything of the disks and their contacts that changes with time.

use serde::{Deserialize, Serialize};

use crate::clone_in_place::clone_in_place;

use super::contact_list::ContactList;
use super::contacts::{Pair, WallContact};

/// Disks at one point of the grid of time. Degrees of freedom are flat: x, y, angle of disk 0, of disk 1, ..., then the
/// impulses (x, y) that the walls have given, as the velocities of bodies of unit mass.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Disks {
    /// Positions \[m\] and angles \[rad\].
    pub position: Vec<f64>,
    /// Velocities \[m/s\] and angular velocities \[rad/s\].
    pub velocity: Vec<f64>,
    /// Accelerations \[m/s2\], \[rad/s2\].
    pub acceleration: Vec<f64>,
    /// Higher derivatives, if the integrator keeps any.
    pub higher: Vec<f64>,
    /// Neighbour list: disks that may touch before it is built again.
    pub pairs: ContactList<Pair>,
    /// Disks that may touch a wall before the list is built again.
    pub wall_contacts: ContactList<WallContact>,
    /// Positions (x, y, angle) when the list was built.
    pub positions_at_list_build: Vec<[f64; 3]>,
    /// Base displacement \[m\] when the list was built.
    pub base_at_list_build: f64,
    /// Step at which the list was built.
    pub step_of_list_build: u64,
    /// Gap \[m\] below which pairs are in the list.
    pub list_margin: f64,
    /// Vertical force \[N\] of the base on the disks now.
    pub base_force: f64,
    /// Power \[W\] lost in the dashpots now.
    pub dissipated_power: f64,
    /// Power \[W\] of the disks that the drive moves on the others now, beyond that of the base that they belong to.
    pub moved_power: f64,
}

clone_in_place!(Disks {
    position,
    velocity,
    acceleration,
    higher,
    pairs,
    wall_contacts,
    positions_at_list_build,
    base_at_list_build,
    step_of_list_build,
    list_margin,
    base_force,
    dissipated_power,
    moved_power
});

impl Disks {
    /// x, y and angle of each disk (and, behind them, degrees of freedom that are no disk's).
    pub fn positions(&self) -> &[[f64; 3]] {
        self.position.as_chunks().0
    }

    /// Velocities and angular velocity of each disk (and more behind them).
    pub fn velocities(&self) -> &[[f64; 3]] {
        self.velocity.as_chunks().0
    }

    /// How many contacts remember that they are closed; none does without tangential springs.
    pub fn closed_contacts(&self) -> u32 {
        (self.pairs.closed() + self.wall_contacts.closed()) as u32
    }
}

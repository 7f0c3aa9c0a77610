//! Everything of a molecular dynamics run that changes with time.

use serde::{Deserialize, Serialize};

use crate::drive::Motion;

use super::contacts::{AtWall, Pair};

/// State at one point of the time grid. Degrees of freedom are flat: x, y, angle of disk 0, of disk 1, ..., then the
/// impulses (x, y) that the walls have given, as the velocities of bodies of unit mass.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct State<D> {
    /// Steps done: the time is `start + steps * time_step`, never a running sum.
    pub steps: u64,
    /// Motion of the base as a function of time.
    pub drive: D,
    /// Motion of the base now.
    pub base: Motion,
    /// Positions \[m\] and angles \[rad\].
    pub position: Vec<f64>,
    /// Velocities \[m/s\] and angular velocities \[rad/s\].
    pub velocity: Vec<f64>,
    /// Accelerations \[m/s2\], \[rad/s2\].
    pub acceleration: Vec<f64>,
    /// Higher derivatives, if the integrator keeps any.
    pub higher: Vec<f64>,
    /// Disks that may touch before the next search.
    pub pairs: Vec<Pair>,
    /// Disks that may touch a wall before the next search.
    pub at_walls: Vec<AtWall>,
    /// Positions (x, y, angle) at the last search.
    pub searched: Vec<[f64; 3]>,
    /// Base displacement \[m\] at the last search.
    pub searched_base: f64,
    /// Step of the last search.
    pub searched_step: u64,
    /// Gap \[m\] below which pairs are listed since the last search.
    pub searched_margin: f64,
    /// Vertical force \[N\] of the base on the disks now.
    pub base_force: f64,
    /// Power \[W\] lost in the dashpots now.
    pub dissipated_power: f64,
    /// Work \[J\] that the base has done on the disks.
    pub energy_input: f64,
    /// Energy \[J\] lost in dashpots and by slip.
    pub energy_lost: f64,
    /// Closed contacts now.
    pub contacts: u32,
}

impl<D: Clone> Clone for State<D> {
    fn clone(&self) -> Self {
        Self {
            drive: self.drive.clone(),
            position: self.position.clone(),
            velocity: self.velocity.clone(),
            acceleration: self.acceleration.clone(),
            higher: self.higher.clone(),
            pairs: self.pairs.clone(),
            at_walls: self.at_walls.clone(),
            searched: self.searched.clone(),
            ..*self
        }
    }

    /// Copies without allocating where there is room: the back-up of every step and the look between grid points.
    fn clone_from(&mut self, source: &Self) {
        self.drive.clone_from(&source.drive);
        self.position.clone_from(&source.position);
        self.velocity.clone_from(&source.velocity);
        self.acceleration.clone_from(&source.acceleration);
        self.higher.clone_from(&source.higher);
        self.pairs.clone_from(&source.pairs);
        self.at_walls.clone_from(&source.at_walls);
        self.searched.clone_from(&source.searched);
        let Self {
            steps,
            base,
            searched_base,
            searched_step,
            searched_margin,
            ..
        } = *source;
        let Self {
            base_force,
            dissipated_power,
            energy_input,
            energy_lost,
            contacts,
            ..
        } = *source;
        (self.steps, self.base, self.searched_base, self.searched_step) = (steps, base, searched_base, searched_step);
        self.searched_margin = searched_margin;
        (self.base_force, self.dissipated_power) = (base_force, dissipated_power);
        (self.energy_input, self.energy_lost, self.contacts) = (energy_input, energy_lost, contacts);
    }
}

impl<D> State<D> {
    /// x, y and angle of each disk (and, behind them, degrees of freedom that are no disk's).
    pub fn places(&self) -> &[[f64; 3]] {
        self.position.as_chunks().0
    }

    /// Velocities and angular velocity of each disk (and more behind them).
    pub fn rates(&self) -> &[[f64; 3]] {
        self.velocity.as_chunks().0
    }

    /// How many contacts remember that they are closed; none does without skins.
    pub fn remembered(&self) -> u32 {
        let between = self.pairs.iter().filter(|pair| pair.skin.is_closed()).count();
        let at_walls = self.at_walls.iter().filter(|near| near.skin.is_closed()).count();
        (between + at_walls) as u32
    }
}

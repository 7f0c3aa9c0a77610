//! Everything of a run that changes with time.

use serde::{Deserialize, Serialize};

use crate::drive::Motion;

/// What a contact does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Phase {
    /// Apart.
    Open,
    /// Overlapping while the force is cut off at zero: the disks leave faster than the spring can follow.
    Unpressed,
    /// Pressed, skin sticking: lambda* is constant.
    Stick,
    /// Pressed, skin slipping at Amonton's limit with positive stretch.
    SlipForward,
    /// The same with negative stretch.
    SlipBackward,
}

impl Phase {
    /// Sign of the stretch while slipping.
    #[inline]
    pub fn slip_sense(self) -> Option<f64> {
        match self {
            Self::SlipForward => Some(1.0),
            Self::SlipBackward => Some(-1.0),
            _ => None,
        }
    }

    /// Whether there is a force.
    #[inline]
    pub fn is_pressed(self) -> bool {
        !matches!(self, Self::Open | Self::Unpressed)
    }
}

/// Relative motion of two bodies in the frame of their contact, at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Kinematics {
    /// Overlap delta \[m\], negative while apart.
    pub overlap: f64,
    /// Rate of the overlap, -u_n \[m/s\].
    pub closing: f64,
    /// lambda \[m\] (P 4.5, 4.7), counted with beta = 0 along the contact's remembered direction.
    pub surface: f64,
    /// Rate of lambda, u_t \[m/s\].
    pub sliding: f64,
    /// Normal, from the second body to the first.
    pub normal: [f64; 2],
    /// Rate at which the normal turns, counter-clockwise \[rad/s\].
    pub turning: f64,
    /// `(R_a + R_b) / r`, by which the tangential force acts on the centres; 1 at a wall.
    pub lever: f64,
}

/// A candidate for contact and what it remembers; `first < second`, or a disk and a wall.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Index of the disk.
    pub first: u32,
    /// Index of the other disk or of the wall.
    pub second: u32,
    /// What it does at the grid point.
    pub phase: Phase,
    /// Direction from which the angle of the normal is counted.
    pub direction: [f64; 2],
    /// lambda* \[m\].
    pub reference: f64,
    /// Relative motion at the grid point, while overlapping.
    pub kinematics: Kinematics,
    /// Rate of `kinematics.closing` \[m/s2\].
    pub closing_rate: f64,
}

impl Contact {
    /// Two bodies that do not touch.
    pub fn open(first: u32, second: u32) -> Self {
        Self {
            first,
            second,
            phase: Phase::Open,
            direction: [0.0; 2],
            reference: 0.0,
            kinematics: Kinematics::default(),
            closing_rate: 0.0,
        }
    }
}

/// State at one point of the time grid.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct State<D> {
    /// Steps done: the time is `start + steps * time_step`, never a running sum.
    pub steps: u64,
    /// Motion of the base as a function of time.
    pub drive: D,
    /// Motion of the base now.
    pub base: Motion,
    /// x \[m\], y \[m\] and angle \[rad\] of each disk.
    pub places: Vec<[f64; 3]>,
    /// Their rates.
    pub rates: Vec<[f64; 3]>,
    /// What places and rates are short of by rounding.
    pub remainders: Vec<[[f64; 3]; 2]>,
    /// Impulse (x, y) \[N.s\] that each wall has given.
    pub wall_impulses: Vec<[f64; 2]>,
    /// Disks that may touch before the next search.
    pub pairs: Vec<Contact>,
    /// Disks that may touch a wall before the next search.
    pub at_walls: Vec<Contact>,
    /// Places at the last search.
    pub searched: Vec<[f64; 3]>,
    /// Base displacement \[m\] at the last search.
    pub searched_base: f64,
    /// Gap up to which that search looked \[m\].
    pub margin: f64,
    /// Work \[J\] that the base has done on the disks.
    pub energy_input: f64,
    /// Energy \[J\] lost in dashpots and by slip.
    pub energy_lost: f64,
    /// Overlapping contacts now.
    pub contacts: u32,
    /// Changes of phase so far: steps of contacts that were taken in pieces.
    pub changes: u64,
}

impl<D: Clone> Clone for State<D> {
    fn clone(&self) -> Self {
        Self {
            drive: self.drive.clone(),
            places: self.places.clone(),
            rates: self.rates.clone(),
            remainders: self.remainders.clone(),
            wall_impulses: self.wall_impulses.clone(),
            pairs: self.pairs.clone(),
            at_walls: self.at_walls.clone(),
            searched: self.searched.clone(),
            ..*self
        }
    }

    /// Copies without allocating where there is room.
    fn clone_from(&mut self, source: &Self) {
        self.drive.clone_from(&source.drive);
        self.places.clone_from(&source.places);
        self.rates.clone_from(&source.rates);
        self.remainders.clone_from(&source.remainders);
        self.wall_impulses.clone_from(&source.wall_impulses);
        self.pairs.clone_from(&source.pairs);
        self.at_walls.clone_from(&source.at_walls);
        self.searched.clone_from(&source.searched);
        let State {
            steps,
            base,
            searched_base,
            margin,
            ..
        } = *source;
        let State {
            energy_input,
            energy_lost,
            contacts,
            changes,
            ..
        } = *source;
        (self.steps, self.base, self.searched_base, self.margin) = (steps, base, searched_base, margin);
        (self.energy_input, self.energy_lost) = (energy_input, energy_lost);
        (self.contacts, self.changes) = (contacts, changes);
    }
}

//! Everything of the disks and their contacts that changes with time.

use serde::{Deserialize, Serialize};

use crate::clone_in_place::clone_in_place;
use crate::engine::dem::candidates::Candidate;
use crate::error::are_sane;

/// Phase of a contact, in which its force is a smooth function of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum LocatedPhase {
    /// Apart.
    Open,
    /// Overlapping while the force is cut off at zero: the disks leave faster than the spring can follow.
    Unpressed,
    /// Pressed, tangential spring sticking: lambda* is constant.
    Stick,
    /// Pressed, tangential spring slipping at the limit of Coulomb friction with positive stretch.
    SlipForward,
    /// The same with negative stretch.
    SlipBackward,
}

impl LocatedPhase {
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
    pub tangential_displacement: f64,
    /// Rate of lambda, u_t \[m/s\].
    pub sliding: f64,
    /// Normal, from the second body to the first.
    pub normal: [f64; 2],
    /// Angular velocity of the normal, counter-clockwise \[rad/s\].
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
    /// Phase at the grid point.
    pub phase: LocatedPhase,
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
            phase: LocatedPhase::Open,
            direction: [0.0; 2],
            reference: 0.0,
            kinematics: Kinematics::default(),
            closing_rate: 0.0,
        }
    }

    /// Indices of the two bodies.
    #[inline(always)]
    pub fn bodies(&self) -> [usize; 2] {
        [self.first as usize, self.second as usize]
    }

    /// Makes the normal, which has turned by `turn` \[rad\], the remembered direction; `radius_sum` \[m\] is the lever of that angle in
    /// lambda.
    pub fn follow(&mut self, turn: f64, radius_sum: f64) {
        self.direction = self.kinematics.normal;
        self.reference += radius_sum * turn;
        self.kinematics.tangential_displacement += radius_sum * turn;
    }

    /// Whether all numbers are finite and directions are no longer than one.
    pub fn is_sane(&self) -> bool {
        let Kinematics {
            overlap,
            closing,
            tangential_displacement,
            sliding,
            normal,
            turning,
            lever,
        } = self.kinematics;
        let unit = |vector: [f64; 2]| vector.iter().all(|part| part.abs() <= 1.0 + 1e-9);
        are_sane([overlap, closing, tangential_displacement, sliding, turning, lever])
            && are_sane([self.reference, self.closing_rate])
            && unit(normal)
            && unit(self.direction)
    }
}

impl Candidate for Contact {
    fn key(&self) -> [u32; 2] {
        [self.first, self.second]
    }

    fn remembers(&self) -> bool {
        self.phase != LocatedPhase::Open
    }
}

/// Disks at one point of the grid of time.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Disks {
    /// x \[m\], y \[m\] and angle \[rad\] of each disk.
    pub positions: Vec<[f64; 3]>,
    /// Their rates.
    pub velocities: Vec<[f64; 3]>,
    /// What rounding took from positions and velocities.
    pub remainders: Vec<[[f64; 3]; 2]>,
    /// Impulse (x, y) \[N.s\] that each wall has given.
    pub wall_impulses: Vec<[f64; 2]>,
    /// Neighbour list: disks that may touch before it is built again.
    pub pairs: Vec<Contact>,
    /// Disks that may touch a wall before the list is built again.
    pub wall_contacts: Vec<Contact>,
    /// Positions when the list was built.
    pub positions_at_list_build: Vec<[f64; 3]>,
    /// Base displacement \[m\] when the list was built.
    pub base_at_list_build: f64,
    /// Gap \[m\] below which pairs are in the list.
    pub list_margin: f64,
    /// Changes of phase so far: steps of contacts that had events.
    pub changes: u64,
}

clone_in_place!(Disks {
    positions,
    velocities,
    remainders,
    wall_impulses,
    pairs,
    wall_contacts,
    positions_at_list_build,
    base_at_list_build,
    list_margin,
    changes
});

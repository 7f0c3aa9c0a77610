//! Disks that are fixed to a base that moves as a sine (P Fig. 1.10).

use serde::{Deserialize, Serialize};

use super::HeldDisk;
use crate::clone_in_place::clone_in_place;
use crate::drive::{Drive, Motion, Sine};

/// Sine base and the disks on it that move with it and do not turn.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub struct FixedBottom {
    /// Motion of the base.
    pub sine: Sine,
    /// The disks.
    pub disks: Vec<HeldDisk>,
}

clone_in_place!(FixedBottom { sine, disks });

impl Drive for FixedBottom {
    const MOVES_DISKS: bool = true;

    fn motion(&self, time: f64) -> Motion {
        self.sine.motion(time)
    }

    fn move_disks(&mut self, time: f64, mut place: impl FnMut(usize, [f64; 2], [f64; 2])) {
        let base = self.sine.motion(time);
        for HeldDisk { index, place: [x, y] } in &self.disks {
            place(*index as usize, [*x, y + base.displacement], [0.0, base.velocity]);
        }
    }
}

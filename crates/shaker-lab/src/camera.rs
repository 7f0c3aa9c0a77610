//! Angles in, what a camera makes of them out (P 2.4.3).
//!
//! The marks on the disks are rectangles: a picture gives their angle only modulo 180 degrees. Paths are made continuous by the rule of the
//! thesis with its sign put right: after a jump above +90 degrees the path goes on 180 degrees lower, after one below -90 degrees 180
//! higher. So a disk that turns by more than 90 degrees between two pictures is taken for one that turns less or the other way.

use std::f64::consts::PI;

use fmi_component::{CoSimulation, Component, Result, Step};

use crate::instants;

/// Disks that it sees: those of a packing unless another number is chosen. Inputs that are not connected stay at 0.
pub const DISKS: usize = 60;
const NAME: &str = "camera";

/// Camera that takes pictures of up to 60 marked disks at a frame rate: angles in, their paths as the pictures show them out.
#[derive(Component)]
#[component(name = "camera", stop_time = 10.0, step_size = 1.0)]
pub struct Camera {
    /// Pictures in a second; the first is taken at the start.
    #[parameter(start = 1, min = 1e-6, max = 1e6, unit = "Hz")]
    frame_rate: f64,
    /// Angle of the disk, counter-clockwise, unwrapped.
    #[input(unit = "rad")]
    angle: [f64; DISKS],
    /// Path of the mark as the pictures show it; in the first picture from 0 to pi.
    #[output(unit = "rad")]
    path: [f64; DISKS],
    /// Number of pictures so far.
    #[output]
    frames: i64,
    /// Half turns between mark and path.
    half_turns: Vec<i64>,
    marks: Vec<f64>,
    taken: u64,
}

impl Camera {
    fn take_picture(&mut self) {
        let first = self.taken == 0;
        self.half_turns.resize(DISKS, 0);
        self.marks.resize(DISKS, 0.0);
        for (disk, angle) in self.angle.iter().enumerate() {
            let mark = photographed(*angle);
            let jump = mark - self.marks[disk];
            if !first && jump > 0.5 * PI {
                self.half_turns[disk] -= 1;
            } else if !first && jump < -0.5 * PI {
                self.half_turns[disk] += 1;
            }
            self.marks[disk] = mark;
            self.path[disk] = mark + self.half_turns[disk] as f64 * PI;
        }
        self.taken += 1;
    }
}

/// Angle of a mark, in \[0, pi).
fn photographed(angle: f64) -> f64 {
    let remainder = angle.rem_euclid(PI);
    // The remainder of a tiny negative angle rounds to pi.
    if remainder >= PI { 0.0 } else { remainder }
}

impl CoSimulation for Camera {
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        self.path = self.angle.map(photographed);
        Ok(())
    }

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        let frames = instants::before_end(step, self.frame_rate, NAME)?;
        // The disks stand still within a step: further pictures in it show the same.
        if self.taken < frames {
            self.take_picture();
            self.taken = frames;
        }
        self.frames = i64::try_from(self.taken).unwrap_or(i64::MAX);
        Ok(())
    }
}

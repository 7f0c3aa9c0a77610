//! What does not change during a step.

use crate::drive::Motion;
use crate::geometry::Wall;

use super::cubic::Cubic;
use super::kinematics::DiskArrays;
use super::laws::Laws;

/// What does not change during a step, and the disks at its start.
#[derive(Clone, Copy)]
pub struct StepContext<'engine> {
    /// Contact laws.
    pub laws: &'engine Laws,
    /// 1/m, 1/m, 1/I of each disk.
    pub inverse_masses: &'engine [[f64; 3]],
    /// Walls.
    pub walls: &'engine [Wall],
    /// Gravity \[m/s2\], downwards.
    pub gravity: f64,
    /// Disks at the start.
    pub start: DiskArrays<'engine>,
    /// Base at the start and at the end.
    pub base: [Motion; 2],
    /// Velocity of the base \[m/s\] at the nodes of Gauss's rule.
    pub base_velocity_at_nodes: [f64; 2],
    /// What rounding took from positions and velocities at the start.
    pub remainders: &'engine [[[f64; 3]; 2]],
    /// Length of the step \[s\].
    pub step: f64,
}

/// Velocity \[m/s\] at the nodes of Gauss's rule of a base that moves so at the ends of a step.
pub fn velocity_at_nodes(base: [Motion; 2], step: f64) -> [f64; 2] {
    if step == 0.0 {
        return base.map(|motion| motion.velocity);
    }
    let [start, end] = base.map(|motion| [motion.displacement, step * motion.velocity]);
    Cubic::new(start, end).slopes_at_nodes().map(|slope| slope / step)
}

//! Rotation of the disks of a packing as P 3.1 measures it: parameters, outputs, and the record that a step adds to.

use crate::measure::Rotation;
use crate::scene::{Row, Unit, Values};

/// Of squared angular velocities.
const SQUARE_RADIAN_PER_SQUARE_SECOND: Unit = Unit::new("rad2/s2", [0, 0, -2, 0, 0, 0, 0, 2]);

const START: &str = "measure.start";
const INTERVAL: &str = "measure.interval";
const ROTATING_CORRELATION: &str = "measure.rotating_correlation";

/// Parameters of the measurement.
pub fn parameters<M>() -> Vec<Row<M>> {
    vec![
        Row::parameter(
            START,
            Unit::SECOND,
            0.0..=1e9,
            0.0,
            "Time from which on the rotation of the disks is measured: leaves out how the packing started",
        ),
        Row::parameter(
            INTERVAL,
            Unit::SECOND,
            1e-6..=1e9,
            1.0,
            "Time between the samples of the angles from which the rotation is computed; 1 s in P 3.1",
        ),
        Row::parameter(
            ROTATING_CORRELATION,
            Unit::ONE,
            0.0..=1.0,
            0.95,
            "A disk counts as rotating if the squared correlation of its angle with time is above this",
        ),
    ]
}

/// The rotation so far, and before the step under way.
#[derive(Debug)]
pub struct RotationRecord {
    /// The rotation so far.
    pub now: Rotation,
    before: Rotation,
    /// Whether the step under way takes samples, so that there is something to take back.
    is_sampling: bool,
    rotating_correlation: f64,
}

impl RotationRecord {
    /// A record of so many disks, in a run from `start_time` \[s\] on.
    pub fn new(disks: usize, start_time: f64, values: &Values) -> Self {
        let now = Rotation::new(disks, values.real(START).max(start_time), values.real(INTERVAL));
        Self {
            before: now.clone(),
            now,
            is_sampling: false,
            rotating_correlation: values.real(ROTATING_CORRELATION),
        }
    }

    /// Before a step to `end_time` \[s\].
    pub fn back_up(&mut self, end_time: f64) {
        self.is_sampling = self.now.due() <= end_time;
        if self.is_sampling {
            self.before.clone_from(&self.now);
        }
    }

    /// After a step that was refused.
    pub fn go_back(&mut self) {
        if self.is_sampling {
            self.now.clone_from(&self.before);
        }
    }
}

/// A packing that measures rotation.
pub trait MeasuresRotation {
    /// Its record.
    fn rotation(&self) -> &RotationRecord;
}

/// Outputs over all disks.
pub fn of_all<M: MeasuresRotation>() -> [Row<M>; 6] {
    let share = |name, what, read| Row::output(name, Unit::ONE, 1.0, what, read);
    let square = |name, what, read| Row::output(name, SQUARE_RADIAN_PER_SQUARE_SECOND, 1.0, what, read);
    [
        square(
            "rotation.mean_square",
            "Mean over the disks of the square of disk.mean_angular_velocity (P 3.1)",
            |packing: &M| packing.rotation().now.mean_square(),
        ),
        square(
            "rotation.persistent_mean_square",
            "rotation.mean_square without what a random walk of the angles adds to it in n intervals, the variance of \
             the angular velocities in the intervals over n - 1; may be negative, 0 before two intervals",
            |packing| packing.rotation().now.persistent_mean_square(),
        ),
        share(
            "rotation.correlation",
            "Mean over the disks of disk.rotation_correlation (P 3.1)",
            |packing: &M| packing.rotation().now.mean_correlation(),
        ),
        share(
            "rotation.adjusted_deviation",
            "Mean over the disks of disk.adjusted_deviation (P 3.1)",
            |packing| packing.rotation().now.mean_adjusted_deviation(),
        ),
        share(
            "rotation.share_rotating",
            "Share of the disks whose disk.rotation_correlation is above measure.rotating_correlation",
            |packing| {
                let record = packing.rotation();
                record.now.share_above(record.rotating_correlation)
            },
        ),
        Row::output(
            "rotation.fastest",
            Unit::RADIAN_PER_SECOND,
            1.0,
            "Largest magnitude of disk.mean_angular_velocity",
            |packing| packing.rotation().now.fastest(),
        ),
    ]
}

/// Outputs of each disk.
pub fn of_each<M: MeasuresRotation + 'static>(disks: u32) -> impl Iterator<Item = Row<M>> {
    let outputs = move |name, unit, what, read: fn(&Rotation, usize) -> f64| {
        Row::outputs(name, disks, unit, 1.0, what, move |packing: &M, disk| {
            read(&packing.rotation().now, disk)
        })
    };
    outputs(
        "disk.mean_angular_velocity",
        Unit::RADIAN_PER_SECOND,
        "Angle turned from measure.start to the last sample over that time, counter-clockwise, of disk {} (P 3.1); 0 before \
         the second sample",
        Rotation::mean_angular_velocity,
    )
    .chain(outputs(
        "disk.rotation_correlation",
        Unit::ONE,
        "Squared correlation rho^2 of the sampled angle with time of disk {} (P 3.1); 0 if it never turned",
        Rotation::correlation,
    ))
    .chain(outputs(
        "disk.adjusted_deviation",
        Unit::ONE,
        "Adjusted deviation sigma_a of the angular velocities in the intervals of disk {} (P eq. 3.1): 0 steady, 1 all noise \
         or never turned",
        Rotation::adjusted_deviation,
    ))
}

//! Torques: as the importer gives them, and harmonic.

use std::f64::consts::TAU;

use super::DiskOnTwoSupportsDrive;
use crate::drive::excitation::{HarmonicTorque, InputTorque};
use crate::scene::disk_on_two_supports::DiskOnTwoSupportsScene;
use crate::scene::disks_on_base::names;
use crate::scene::drives::extrapolated;
use crate::scene::{Derived, Row, TIME, Unit, Values, Warning};

/// Terminal of the input torque.
const TERMINAL: &str = "torque";

/// P 5.2: the torque is slow against the oscillation of the disk on its contacts.
const SLOWNESS: Derived = Derived {
    name: "angular frequency of the torque over sqrt(k_n / m)",
    unit: Unit::ONE,
    value: |real| real("torque.angular_frequency") * (real("disk.mass") / real("contact.normal_stiffness")).sqrt(),
};

const TORQUE: &str = "torque";
const RATE: &str = "torque.rate";
const DEGREE: &str = "torque.extrapolation_degree";

impl DiskOnTwoSupportsDrive for InputTorque {
    const NAME: &'static str = "input";
    const DESCRIPTION: &'static str = "Disk on two supports that is turned by a torque";
    const TERMINAL: Option<&'static str> = Some(TERMINAL);

    fn rows<M>() -> Vec<Row<M>> {
        vec![
            extrapolated::degree_parameter(DEGREE, "the torque"),
            Row::input(
                TORQUE,
                Unit::NEWTON_METRE,
                0.1,
                "Torque on the disk, counter-clockwise, at the present communication point",
            )
            .with_derivative(RATE)
            .in_terminal(TERMINAL, "torque"),
            Row::input(
                RATE,
                Unit::NEWTON_METRE_PER_SECOND,
                1.0,
                "Rate of the torque at the present communication point. Optional: while it has been 0 throughout, the rate is that of \
                 the torques so far",
            )
            .in_terminal(TERMINAL, "rate"),
        ]
    }

    fn period(_values: &Values) -> Option<f64> {
        None
    }

    fn new(start_time: f64, _time_step: f64, values: &Values) -> Self {
        Self::starting(
            start_time,
            values.real(TORQUE),
            values.real(RATE),
            extrapolated::degree(DEGREE, values),
        )
    }

    fn set_target(&mut self, time: f64, end: f64, values: &Values) -> bool {
        Self::set_target(self, time, end, values.real(TORQUE), values.real(RATE))
    }

    fn warning(&self, told: &[&'static str]) -> Option<Warning> {
        extrapolated::warning(self.history(), [TORQUE, RATE, RATE], told)
    }

    fn continues(&self, _other: &Self) -> bool {
        true
    }
}

impl DiskOnTwoSupportsDrive for HarmonicTorque {
    const NAME: &'static str = "harmonic-torque";
    const DESCRIPTION: &'static str = "Disk on two supports that is turned by a harmonic torque";
    const PERIOD: &'static [&'static str] = &["torque.angular_frequency"];

    fn rows<M>() -> Vec<Row<M>> {
        vec![
            Row::parameter(
                "torque.amplitude",
                Unit::NEWTON_METRE,
                0.0..=1e9,
                0.15,
                "Amplitude A_e of the torque A_e sin(omega_e t); the default is 1.3 times the one at which the disk begins to slide",
            ),
            Row::parameter(
                "torque.angular_frequency",
                Unit::RADIAN_PER_SECOND,
                1e-6..=1e9,
                1.0,
                "Angular frequency omega_e of the torque; slow is far below sqrt(k_n / m)",
            )
            .recommended_by(
                SLOWNESS,
                0.0..=0.5,
                "the torque swings as fast as the disk does on its contacts; the theory is that of slow torques. Raise \
                 contact.normal_stiffness or lower the frequency.",
            ),
        ]
    }

    fn outputs() -> Vec<Row<DiskOnTwoSupportsScene<Self>>> {
        let applied = Row::output(
            "torque.applied",
            Unit::NEWTON_METRE,
            0.1,
            "Torque on the disk now, counter-clockwise",
            |scene: &DiskOnTwoSupportsScene<Self>| scene.engine.driven().0,
        );
        vec![applied.depending_on(&names(&[&[TIME, "torque.amplitude", "torque.angular_frequency"]]))]
    }

    fn period(values: &Values) -> Option<f64> {
        Some(TAU / values.real("torque.angular_frequency"))
    }

    /// Whole periods.
    fn batch(values: &Values) -> Option<f64> {
        Self::period(values)
    }

    fn new(_start_time: f64, _time_step: f64, values: &Values) -> Self {
        Self {
            amplitude: values.real("torque.amplitude"),
            angular_frequency: values.real("torque.angular_frequency"),
        }
    }

    fn continues(&self, other: &Self) -> bool {
        self == other
    }
}

//! Torques: held or with a rate, as the importer gives them, and harmonic.

use std::f64::consts::TAU;

use super::ThreeDiskDrive;
use crate::drive::excitation::{HarmonicTorque, HeldTorque, SupportMotion};
use crate::scene::{OutputWriter, TIME, Unit, Values, Variable};

impl ThreeDiskDrive for HeldTorque {
    const NAME: &'static str = "input";
    const IDENTIFIER: &'static str = "jostle_three_disk";
    const DESCRIPTION: &'static str = "Disk on two supports that is turned by a torque";

    fn variables() -> Vec<Variable> {
        vec![
            Variable::input(
                "torque",
                Unit::NewtonMetre,
                0.1,
                "Torque on the disk, counter-clockwise, at the present communication point",
            ),
            Variable::input(
                "torque.rate",
                Unit::NewtonMetrePerSecond,
                1.0,
                "Rate of the torque during the next communication step; 0 holds the torque",
            ),
        ]
    }

    fn outputs() -> Vec<Variable> {
        Vec::new()
    }

    fn period(_values: &Values) -> Option<f64> {
        None
    }

    fn new(start_time: f64, _time_step: f64, values: &Values) -> Self {
        Self {
            torque: values.real("torque"),
            rate: values.real("torque.rate"),
            since: start_time,
        }
    }

    fn aim(&mut self, time: f64, values: &Values) -> bool {
        Self::set_target(self, time, values.real("torque"), values.real("torque.rate"))
    }

    fn continues(&self, _other: &Self) -> bool {
        true
    }

    fn write(_outputs: &mut OutputWriter<'_>, _torque: f64, _supports: &[SupportMotion; 2]) {}
}

impl ThreeDiskDrive for HarmonicTorque {
    const NAME: &'static str = "harmonic-torque";
    const IDENTIFIER: &'static str = "jostle_three_disk_harmonic_torque";
    const DESCRIPTION: &'static str = "Disk on two supports that is turned by a harmonic torque";
    const PERIOD: &'static [&'static str] = &["torque.angular_frequency"];

    fn output_at_start(name: &str) -> Vec<&'static str> {
        match name {
            "torque.applied" => vec![TIME, "torque.amplitude", "torque.angular_frequency"],
            _ => Vec::new(),
        }
    }

    fn variables() -> Vec<Variable> {
        vec![
            Variable::parameter(
                "torque.amplitude",
                Unit::NewtonMetre,
                0.0..=1e9,
                0.113,
                "Amplitude A_e of the torque A_e sin(omega_e t)",
            ),
            Variable::parameter(
                "torque.angular_frequency",
                Unit::RadianPerSecond,
                1e-6..=1e9,
                1.0,
                "Angular frequency omega_e of the torque; slow is far below sqrt(k_n / m)",
            ),
        ]
    }

    fn outputs() -> Vec<Variable> {
        vec![Variable::output(
            "torque.applied",
            Unit::NewtonMetre,
            0.1,
            "Torque on the disk now, counter-clockwise",
        )]
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

    fn write(outputs: &mut OutputWriter<'_>, torque: f64, _supports: &[SupportMotion; 2]) {
        outputs.real("torque.applied", torque);
    }
}

//! Inputs that are small, or simple, and once gave wrong results or none.

#![allow(clippy::unwrap_used)]

mod support;

use jostle::drive::Sine;
use jostle::engine::dem::event_located::EventStepper;
use jostle::engine::dem::verlet::{PredictorCorrector, VelocityVerlet};
use jostle::scene::packing::SoftPacking;
use jostle::scene::packing::soft::SoftMethod;
use jostle::scene::{Simulation, Value};

type Verlet = PredictorCorrector<VelocityVerlet>;

/// A packing of soft disks on a sine of 1 mm at 50 Hz.
fn shaken<M: SoftMethod>(disks: u32, given: &[(&str, f64)]) -> Simulation<SoftPacking<M, Sine>> {
    let base = [("drive.amplitude", 1e-3), ("drive.frequency", 50.0)];
    let given: Vec<(&str, Value)> = base
        .iter()
        .chain(given)
        .map(|(name, value)| (*name, (*value).into()))
        .collect();
    Simulation::new(&[("disks", disks)], &given).unwrap()
}

/// Angular velocities of the disks after `end` \[s\] with this time step \[s\].
fn spins(time_step: f64, end: f64) -> Vec<f64> {
    let mut packing = shaken::<EventStepper>(12, &[("time_step", time_step)]);
    packing.advance_to(end).unwrap();
    let spin = |disk| packing.real(&format!("disk.angular_velocity[{disk}]")).unwrap();
    (1..=12).map(spin).collect()
}

/// Steps of a nanosecond made contacts change at the very end of a step, and the time that was left divided by.
#[test]
fn errors_of_located_events_fall_with_the_step_down_to_rounding() {
    let end = 4e-5;
    let reference = spins(1e-7, end);
    let error = |step: f64| {
        let squares = spins(step, end)
            .into_iter()
            .zip(&reference)
            .map(|(one, other)| (one - other).powi(2));
        (squares.sum::<f64>() / 12.0).sqrt()
    };
    let errors = [2e-5, 1e-5, 5e-6, 2e-6, 1e-6].map(error);
    println!("errors at 20, 10, 5, 2, 1 us: {errors:?} rad/s");
    assert!(errors.is_sorted_by(|longer, shorter| shorter < longer), "{errors:?}");
    assert!(errors[4] < 1e-2 * errors[0], "{errors:?}");
    for step in [1e-8, 3e-9, 1e-9] {
        let rounding = error(step);
        println!("error at {step:e} s: {rounding:e} rad/s");
        assert!(rounding < errors[3], "{step:e} s: {rounding:e} rad/s");
    }
}

/// Slip just before a contact opens made a loss of the rounding of its force, divided by the stiffness of the spring.
#[test]
fn a_tangential_spring_too_soft_to_matter_does_not_matter() {
    let energies = |given: &[(&str, f64)]| {
        let mut packing = shaken::<EventStepper>(20, given);
        packing.advance_to(0.05).unwrap();
        ["energy.lost", "energy.residual", "energy.kinetic"].map(|name| packing.real(name).unwrap())
    };
    let [lost, residual, kinetic] = energies(&[("contact.friction", 0.0)]);
    for kappa in [1e-12, 1e-20, 1e-60, 1e-99, 1e-105, 1e-160, 1e-300, 5e-324] {
        let soft = energies(&[("contact.stiffness_ratio", kappa)]);
        let close = |one: f64, other: f64| (one - other).abs() < 1e-6 * lost;
        assert!(
            close(soft[0], lost) && close(soft[1], residual) && close(soft[2], kinetic),
            "{kappa:e}: {soft:?}, without friction {lost} {residual} {kinetic}"
        );
    }
}

/// A quotient by -0.0 is minus infinity, smaller than any time step.
#[test]
fn a_damping_or_frequency_of_negative_zero_is_zero() {
    fn outcome<M: SoftMethod>(given: &[(&str, f64)]) -> Vec<Value> {
        let mut packing = shaken::<M>(3, given);
        packing.advance_to(0.01).unwrap();
        packing.all_values().unwrap()
    }
    for name in ["contact.normal_damping", "drive.frequency"] {
        assert_eq!(
            outcome::<Verlet>(&[(name, -0.0)]),
            outcome::<Verlet>(&[(name, 0.0)]),
            "{name}"
        );
        assert_eq!(
            outcome::<EventStepper>(&[(name, -0.0)]),
            outcome::<EventStepper>(&[(name, 0.0)]),
            "{name}"
        );
    }
}

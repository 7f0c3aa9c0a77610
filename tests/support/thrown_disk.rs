//! A soft disk thrown at the floor, without gravity, by any engine of soft disks; and how far its restitution is from P 4.56 and
//! from an integration of the tangential law.

use jostle::contact::LinearDashpot;
use jostle::drive::FollowsInput;
use jostle::engine::Engine;
use jostle::engine::dem::{ContactLaws, FixedGrid, SoftDiskSetup, Stepper};
use jostle::geometry::{Disk, Wall};

use super::reference_impact::Impact;
use super::soft_disks::{RADIUS, at_rest, mass};

/// Velocity (x, y, angular) after the impact. The touch falls at the fraction `phase` of a time step; `throw` sets `velocity`.
pub fn velocity_after<S: Stepper<Normal = LinearDashpot>>(
    laws: ContactLaws,
    velocity: [f64; 3],
    time_step: f64,
    phase: f64,
    throw: impl FnOnce(&mut S::Disks),
) -> [f64; 3] {
    let setup = SoftDiskSetup {
        laws,
        walls: vec![Wall::vibrating_floor()],
        masses: vec![mass(RADIUS)],
        gravity: 0.0,
        time_step,
        start_time: 0.0,
    };
    let gap = -velocity[1] * time_step * (3.0 + phase);
    let disk = Disk {
        x: 0.0,
        y: RADIUS + gap,
        radius: RADIUS,
    };
    let mut engine = FixedGrid::<S, FollowsInput>::new(setup, &[disk], at_rest());
    engine.set_motion(throw);
    engine.advance_to(0.01).unwrap();
    assert_eq!(engine.now().contacts, 0);
    engine.observables().velocities[0]
}

/// Root mean square over where in a step the touch falls, of the errors of e_n and of u_t'; `after` is the velocity after the
/// impact for a phase.
pub fn errors(laws: ContactLaws, velocity: [f64; 3], after: impl Fn(f64) -> [f64; 3]) -> [f64; 2] {
    let reference = Impact::of_disk(&laws, mass(RADIUS), RADIUS, velocity);
    let (normal_after, tangential_after) = reference.velocities_after(4000);
    let restitution = laws.normal.restitution(mass(RADIUS));
    assert!(
        (-normal_after / -velocity[1] - restitution).abs() < 1e-9,
        "reference against P 4.56"
    );
    let phases = 16;
    let mut squares = [0.0; 2];
    for phase in 0..phases {
        let after = after((f64::from(phase) + 0.5) / f64::from(phases));
        squares[0] += (after[1] / -velocity[1] - restitution).powi(2);
        let surface = after[0] + RADIUS * after[2] - tangential_after;
        squares[1] += (surface / reference.tangential_velocity).powi(2);
    }
    squares.map(|square| (square / f64::from(phases)).sqrt())
}

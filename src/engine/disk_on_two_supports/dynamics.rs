//! Newton's equations of the disk: positions, velocities and phases in, accelerations and forces out (P 4.23, 4.24).

use crate::contact::{LinearDashpot, TangentialSpring};
use crate::drive::excitation::{Piece, SupportMotion};

use super::contact::{Contact, ContactForce, ContactPhase, Sense};
use super::runge_kutta::Vector;
use super::support::{Kinematics, SupportFrame, kinematics};

/// The disk, its supports and laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoSupportsRig {
    /// Radius R of the disk \[m\].
    pub radius: f64,
    /// Mass m \[kg\].
    pub mass: f64,
    /// Gravity g \[m/s2\].
    pub gravity: f64,
    /// Normal law of both contacts.
    pub normal: LinearDashpot,
    /// Tangential law of both contacts.
    pub tangential: TangentialSpring,
    /// Directions of the left and the right contact.
    pub frames: [SupportFrame; 2],
    /// 1 / (R + R_i) \[1/m\]; 0 for walls.
    pub curvature: f64,
}

/// What stays constant: the [`TwoSupportsRig`] with what follows from it, and the time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoSupportsSetup {
    rig: TwoSupportsRig,
    /// Time step \[s\].
    pub time_step: f64,
    per_mass: f64,
    per_inertia: f64,
}

impl std::ops::Deref for TwoSupportsSetup {
    type Target = TwoSupportsRig;

    #[inline(always)]
    fn deref(&self) -> &TwoSupportsRig {
        &self.rig
    }
}

impl TwoSupportsSetup {
    /// A rig with a time step \[s\].
    pub fn new(rig: TwoSupportsRig, time_step: f64) -> Self {
        Self {
            rig,
            time_step,
            per_mass: 1.0 / rig.mass,
            per_inertia: 2.0 / (rig.mass * rig.radius * rig.radius),
        }
    }
}

impl TwoSupportsRig {
    /// Moment of inertia of the disk \[kg.m2\] (P 5.6).
    pub fn inertia(&self) -> f64 {
        0.5 * self.mass * self.radius * self.radius
    }
}

/// Index of the work put in \[J\] among the quantities of [`Vector`]: x, y \[m\], angle \[rad\], their rates, work put in and
/// energy lost \[J\].
pub const ENERGY_INPUT: usize = 6;
/// Index of the energy lost \[J\].
pub const ENERGY_LOST: usize = 7;

/// Relative rounding of a slip rate, generously.
const ROUNDING: f64 = 1e-12;

/// Rates and forces at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoSupportsObservables {
    /// Rates of the quantities.
    pub rates: Vector,
    /// The left and the right contact.
    pub contacts: [ContactForce; 2],
}

/// Place (x, y, angle) of the disk.
#[inline]
pub fn place(disk: &Vector) -> [f64; 3] {
    [disk[0], disk[1], disk[2]]
}

/// Its rates.
#[inline]
pub fn rates(disk: &Vector) -> [f64; 3] {
    [disk[3], disk[4], disk[5]]
}

/// A phase as factors, so that the equations hold no branch on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PhaseFactors {
    /// 1 if a force acts, 0 if none.
    closed: f64,
    /// 1 if the tangential spring holds.
    held: f64,
    /// lambda* \[m\] if it holds.
    unstretched: f64,
    /// Stretch over normal force if it slips, `sigma mu / k_t` \[m/N\].
    slipping: f64,
    /// Sense of slip, 0 if it does not.
    sense: f64,
    /// 1 while disk and support part faster than they recover.
    relaxing: f64,
}

impl PhaseFactors {
    /// Of a contact.
    pub fn of(contact: &Contact, spring: &TangentialSpring) -> Self {
        let sense = contact.slips().map_or(0.0, Sense::sign);
        let one_if = |holds: bool| f64::from(u8::from(holds));
        Self {
            closed: one_if(contact.is_closed()),
            held: one_if(contact.phase == ContactPhase::Stick),
            unstretched: contact.unstretched,
            slipping: sense * (spring.friction / spring.stiffness),
            sense,
            relaxing: one_if(contact.phase == ContactPhase::Relaxing),
        }
    }
}

/// Rates of the quantities of `disk`, `offset` \[s\] after the start of the time step with this excitation.
///
/// The tangential force has the arm (R + R_i) / r, not R_i: so the spring is conservative though the disks overlap.
#[inline(never)]
pub fn rates_of<P: Piece>(
    setup: &TwoSupportsSetup,
    piece: &P,
    offset: f64,
    disk: &Vector,
    factors: &[PhaseFactors; 2],
) -> Vector {
    observe(setup, piece, offset, disk, factors).rates
}

/// Force of one contact.
#[derive(Clone, Copy)]
struct Force {
    push: f64,
    normal: f64,
    stretch: f64,
    tangential: f64,
    /// On the centre of the disk, along x and y.
    on_centre: [f64; 2],
}

#[inline(always)]
fn force(setup: &TwoSupportsSetup, frame: &SupportFrame, factors: &PhaseFactors, at: &Kinematics) -> Force {
    let push = setup.normal.stiffness * at.overlap + setup.normal.damping * at.overlap_rate;
    let normal = factors.closed * push;
    let stretch = factors.held * (at.tangential_displacement - factors.unstretched) + factors.slipping * push;
    let tangential = setup.tangential.force(stretch);
    let pull = tangential * at.shortness;
    let along_normal = normal * at.normal - pull * at.tangent;
    let along_tangent = normal * at.tangent + pull * at.normal;
    let on_centre = [
        along_normal * frame.normal[0] + along_tangent * frame.tangent[0],
        along_normal * frame.normal[1] + along_tangent * frame.tangent[1],
    ];
    Force {
        push,
        normal,
        stretch,
        tangential,
        on_centre,
    }
}

/// What follows from the accelerations (x, y) \[m/s2\] at one contact. `speed` \[m/s\] and `hurry` \[m/s2\] are sizes
/// of velocities and accelerations that cancel.
#[inline(always)]
fn account(
    setup: &TwoSupportsSetup,
    (frame, factors, support): (&SupportFrame, &PhaseFactors, &SupportMotion),
    (at, force): (&Kinematics, &Force),
    accelerations: [f64; 2],
    (speed, hurry): (f64, f64),
) -> ContactForce {
    let (law, spring) = (setup.normal, setup.tangential);
    let rising = [
        accelerations[0] - support.accelerations[0],
        accelerations[1] - support.accelerations[1],
    ];
    let along = |direction: [f64; 2]| rising[0] * direction[0] + rising[1] * direction[1];
    let outward = along(frame.normal) * at.normal + along(frame.tangent) * at.tangent;
    let force_rate = law.stiffness * at.overlap_rate + law.damping * (at.centripetal - outward);
    let sense = if factors.sense != 0.0 {
        factors.sense
    } else if force.stretch != 0.0 {
        1.0_f64.copysign(force.stretch)
    } else {
        1.0_f64.copysign(at.tangential_velocity)
    };
    let slip_compliance = spring.friction / spring.stiffness;
    let slip_rate =
        factors.sense * at.tangential_velocity - factors.sense * factors.sense * slip_compliance * force_rate;
    let lost_power = factors.closed * law.damping * at.overlap_rate * at.overlap_rate
        - factors.relaxing * law.stiffness * at.overlap * at.overlap_rate
        + spring.friction * force.normal * slip_rate;
    let speed = at.tangential_velocity.abs() + at.overlap_rate.abs() + speed + setup.radius * support.rates[2].abs();
    let carried = force.on_centre[0] * support.rates[0] + force.on_centre[1] * support.rates[1];
    ContactForce {
        overlap: at.overlap,
        push: force.push,
        normal: force.normal,
        tangential: force.tangential,
        tangential_displacement: at.tangential_displacement,
        stretch: force.stretch,
        slip_rate: sense * at.tangential_velocity - slip_compliance * force_rate,
        slip_rounding: ROUNDING * (speed + slip_compliance * (law.stiffness * speed + law.damping * hurry)),
        lost_power,
        input_power: carried - force.tangential * setup.radius * support.rates[2],
    }
}

/// Rates and forces, as [`rates_of`].
#[inline(always)]
pub fn observe<P: Piece>(
    setup: &TwoSupportsSetup,
    piece: &P,
    offset: f64,
    disk: &Vector,
    factors: &[PhaseFactors; 2],
) -> TwoSupportsObservables {
    let [support_1, support_2] = &piece.supports(offset);
    let [frame_1, frame_2] = &setup.frames;
    let [factors_1, factors_2] = factors;
    let (place, [x, y, angle]) = (place(disk), rates(disk));
    let (radius, curvature) = (setup.radius, setup.curvature);
    let at_1 = &kinematics(frame_1, curvature, radius, place, [x, y, angle], support_1);
    let at_2 = &kinematics(frame_2, curvature, radius, place, [x, y, angle], support_2);
    let force_1 = &force(setup, frame_1, factors_1, at_1);
    let force_2 = &force(setup, frame_2, factors_2, at_2);

    let torque = piece.torque(offset);
    let acceleration = [
        (force_1.on_centre[0] + force_2.on_centre[0]) * setup.per_mass,
        (force_1.on_centre[1] + force_2.on_centre[1]) * setup.per_mass - setup.gravity,
    ];
    let spin_up = (setup.radius * (force_1.tangential + force_2.tangential) + torque) * setup.per_inertia;
    let hurry = (force_1.push.abs() + force_2.push.abs()) * setup.per_mass + setup.gravity;
    let sizes = (setup.radius * angle.abs(), hurry);
    let left = account(
        setup,
        (frame_1, factors_1, support_1),
        (at_1, force_1),
        acceleration,
        sizes,
    );
    let right = account(
        setup,
        (frame_2, factors_2, support_2),
        (at_2, force_2),
        acceleration,
        sizes,
    );

    let input = left.input_power + right.input_power + torque * angle;
    let lost = left.lost_power + right.lost_power;
    TwoSupportsObservables {
        rates: [x, y, angle, acceleration[0], acceleration[1], spin_up, input, lost],
        contacts: [left, right],
    }
}

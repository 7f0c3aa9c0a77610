//! Newton's equations of the disk: positions, velocities and phases in, accelerations and forces out (P 4.23, 4.24).

use crate::contact::{ElasticSkin, LinearDashpot};
use crate::drive::excitation::{Piece, SupportMotion};

use super::contact::{Contact, ContactForce, Phase, Sense};
use super::runge_kutta::Vector;
use super::support::{Frame, Kinematics, kinematics};

/// The disk, its supports and laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bench {
    /// Radius R of the disk \[m\].
    pub radius: f64,
    /// Mass m \[kg\].
    pub mass: f64,
    /// Gravity g \[m/s2\].
    pub gravity: f64,
    /// Normal law of both contacts.
    pub normal: LinearDashpot,
    /// Skin of both contacts.
    pub skin: ElasticSkin,
    /// Directions of the left and the right contact.
    pub frames: [Frame; 2],
    /// 1 / (R + R_i) \[1/m\]; 0 for walls.
    pub curvature: f64,
}

/// What stays fixed: the [`Bench`] with what follows from it, and the step of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup {
    bench: Bench,
    /// Step of the grid of time \[s\].
    pub time_step: f64,
    per_mass: f64,
    per_inertia: f64,
}

impl std::ops::Deref for Setup {
    type Target = Bench;

    #[inline(always)]
    fn deref(&self) -> &Bench {
        &self.bench
    }
}

impl Setup {
    /// A bench with a step of time \[s\].
    pub fn new(bench: Bench, time_step: f64) -> Self {
        Self {
            bench,
            time_step,
            per_mass: 1.0 / bench.mass,
            per_inertia: 2.0 / (bench.mass * bench.radius * bench.radius),
        }
    }
}

impl Bench {
    /// Moment of inertia of the disk \[kg.m2\] (P 5.6).
    pub fn inertia(&self) -> f64 {
        0.5 * self.mass * self.radius * self.radius
    }
}

/// Quantities of [`Vector`]: x, y \[m\], angle \[rad\], their rates, work put in and energy lost \[J\].
pub const WORK: usize = 6;
/// See [`WORK`].
pub const LOST: usize = 7;

/// Relative rounding of a slip rate, generously.
const ROUNDING: f64 = 1e-12;

/// Everything at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
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

/// A phase as numbers, so that the equations hold no branch on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// 1 if a force acts, 0 if none.
    closed: f64,
    /// 1 if the skin holds.
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

impl Mode {
    /// Of a contact.
    pub fn of(contact: &Contact, skin: &ElasticSkin) -> Self {
        let sense = contact.slips().map_or(0.0, Sense::sign);
        let one_if = |holds: bool| f64::from(u8::from(holds));
        Self {
            closed: one_if(contact.is_closed()),
            held: one_if(contact.phase == Phase::Stick),
            unstretched: contact.unstretched,
            slipping: sense * (skin.friction / skin.stiffness),
            sense,
            relaxing: one_if(contact.phase == Phase::Relaxing),
        }
    }
}

/// Rates of the quantities of `disk`, `offset` \[s\] after the start of the cell with this excitation.
///
/// The skin pulls at arm (R + R_i) / r, not R_i: so it is conservative though the disks overlap.
#[inline(never)]
pub fn rates_of<P: Piece>(setup: &Setup, piece: &P, offset: f64, disk: &Vector, modes: &[Mode; 2]) -> Vector {
    look(setup, piece, offset, disk, modes).rates
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
fn force(setup: &Setup, frame: &Frame, mode: &Mode, at: &Kinematics) -> Force {
    let push = setup.normal.stiffness * at.overlap + setup.normal.damping * at.overlap_rate;
    let normal = mode.closed * push;
    let stretch = mode.held * (at.slide - mode.unstretched) + mode.slipping * push;
    let tangential = setup.skin.force(stretch);
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
    setup: &Setup,
    (frame, mode, support): (&Frame, &Mode, &SupportMotion),
    (at, force): (&Kinematics, &Force),
    accelerations: [f64; 2],
    (speed, hurry): (f64, f64),
) -> ContactForce {
    let (law, skin) = (setup.normal, setup.skin);
    let rising = [
        accelerations[0] - support.accelerations[0],
        accelerations[1] - support.accelerations[1],
    ];
    let along = |direction: [f64; 2]| rising[0] * direction[0] + rising[1] * direction[1];
    let outward = along(frame.normal) * at.normal + along(frame.tangent) * at.tangent;
    let force_rate = law.stiffness * at.overlap_rate + law.damping * (at.centripetal - outward);
    let sense = if mode.sense != 0.0 {
        mode.sense
    } else if force.stretch != 0.0 {
        1.0_f64.copysign(force.stretch)
    } else {
        1.0_f64.copysign(at.slide_rate)
    };
    let give = skin.friction / skin.stiffness;
    let rubbing = mode.sense * at.slide_rate - mode.sense * mode.sense * give * force_rate;
    let lost_power = mode.closed * law.damping * at.overlap_rate * at.overlap_rate
        - mode.relaxing * law.stiffness * at.overlap * at.overlap_rate
        + skin.friction * force.normal * rubbing;
    let speed = at.slide_rate.abs() + at.overlap_rate.abs() + speed + setup.radius * support.rates[2].abs();
    let carried = force.on_centre[0] * support.rates[0] + force.on_centre[1] * support.rates[1];
    ContactForce {
        overlap: at.overlap,
        push: force.push,
        normal: force.normal,
        tangential: force.tangential,
        slide: at.slide,
        stretch: force.stretch,
        slip_rate: sense * at.slide_rate - give * force_rate,
        slip_rounding: ROUNDING * (speed + give * (law.stiffness * speed + law.damping * hurry)),
        lost_power,
        input_power: carried - force.tangential * setup.radius * support.rates[2],
    }
}

/// Rates and forces, as [`rates_of`].
#[inline(always)]
pub fn look<P: Piece>(setup: &Setup, piece: &P, offset: f64, disk: &Vector, modes: &[Mode; 2]) -> Look {
    let [support_1, support_2] = &piece.supports(offset);
    let [frame_1, frame_2] = &setup.frames;
    let [mode_1, mode_2] = modes;
    let (place, [x, y, angle]) = (place(disk), rates(disk));
    let (radius, curvature) = (setup.radius, setup.curvature);
    let at_1 = &kinematics(frame_1, curvature, radius, place, [x, y, angle], support_1);
    let at_2 = &kinematics(frame_2, curvature, radius, place, [x, y, angle], support_2);
    let force_1 = &force(setup, frame_1, mode_1, at_1);
    let force_2 = &force(setup, frame_2, mode_2, at_2);

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
        (frame_1, mode_1, support_1),
        (at_1, force_1),
        acceleration,
        sizes,
    );
    let right = account(
        setup,
        (frame_2, mode_2, support_2),
        (at_2, force_2),
        acceleration,
        sizes,
    );

    let input = left.input_power + right.input_power + torque * angle;
    let lost = left.lost_power + right.lost_power;
    Look {
        rates: [x, y, angle, acceleration[0], acceleration[1], spin_up, input, lost],
        contacts: [left, right],
    }
}

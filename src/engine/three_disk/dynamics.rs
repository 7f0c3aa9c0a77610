//! Newton's equations of the disk: positions, velocities and phases in, accelerations and forces out (P 4.23, 4.24).

use crate::contact::{ElasticSkin, LinearDashpot};
use crate::drive::excitation::Piece;

use super::contact::{Contact, ContactForce, Phase, Sense};
use super::runge_kutta::Vector;
use super::support::{Frame, kinematics};

/// What stays fixed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setup {
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
    /// Step of the grid of time \[s\].
    pub time_step: f64,
}

impl Setup {
    /// Moment of inertia of the disk \[kg.m2\] (P 5.6).
    #[inline]
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

/// Rates and forces, as [`rates_of`].
#[inline(always)]
pub fn look<P: Piece>(setup: &Setup, piece: &P, offset: f64, disk: &Vector, modes: &[Mode; 2]) -> Look {
    let Setup {
        radius,
        mass,
        normal: law,
        skin,
        ..
    } = *setup;
    let supports = piece.supports(offset);
    let moves: [_; 2] = std::array::from_fn(|index| {
        let frame = &setup.frames[index];
        kinematics(
            frame,
            setup.curvature,
            radius,
            place(disk),
            rates(disk),
            &supports[index],
        )
    });
    // Push, normal force, stretch and tangential force.
    let forces: [_; 2] = std::array::from_fn(|index| {
        let (at, mode) = (&moves[index], &modes[index]);
        let push = law.stiffness * at.overlap + law.damping * at.overlap_rate;
        let stretch = mode.held * (at.slide - mode.unstretched) + mode.slipping * push;
        (push, mode.closed * push, stretch, skin.force(stretch))
    });
    let forward: [[f64; 2]; 2] = std::array::from_fn(|index| {
        let (at, frame, (_, normal, _, tangential)) = (&moves[index], &setup.frames[index], forces[index]);
        let pull = tangential * at.shortness;
        let along_normal = normal * at.normal - pull * at.tangent;
        let along_tangent = normal * at.tangent + pull * at.normal;
        std::array::from_fn(|axis| along_normal * frame.normal[axis] + along_tangent * frame.tangent[axis])
    });
    let torque = piece.torque(offset);
    let accelerations = [
        (forward[0][0] + forward[1][0]) / mass,
        (forward[0][1] + forward[1][1]) / mass - setup.gravity,
        (radius * (forces[0].3 + forces[1].3) + torque) / setup.inertia(),
    ];
    let give = skin.friction / skin.stiffness;
    let hurry = (forces[0].0.abs() + forces[1].0.abs()) / mass + setup.gravity;
    let contacts: [ContactForce; 2] = std::array::from_fn(|index| {
        let (at, frame, support, mode) = (&moves[index], &setup.frames[index], &supports[index], &modes[index]);
        let (push, normal, stretch, tangential) = forces[index];
        let rising = [0, 1].map(|axis| accelerations[axis] - support.accelerations[axis]);
        let along = |direction: [f64; 2]| rising[0] * direction[0] + rising[1] * direction[1];
        let outward = along(frame.normal) * at.normal + along(frame.tangent) * at.tangent;
        let force_rate = law.stiffness * at.overlap_rate + law.damping * (at.centripetal - outward);
        let sense = if mode.sense != 0.0 {
            mode.sense
        } else if stretch != 0.0 {
            1.0_f64.copysign(stretch)
        } else {
            1.0_f64.copysign(at.slide_rate)
        };
        let rubbing = mode.sense * at.slide_rate - mode.sense * mode.sense * give * force_rate;
        let lost_power = mode.closed * law.damping * at.overlap_rate * at.overlap_rate
            - mode.relaxing * law.stiffness * at.overlap * at.overlap_rate
            + skin.friction * normal * rubbing;
        let speed = at.slide_rate.abs() + at.overlap_rate.abs() + radius * (disk[5].abs() + support.rates[2].abs());
        let carried = forward[index][0] * support.rates[0] + forward[index][1] * support.rates[1];
        ContactForce {
            overlap: at.overlap,
            push,
            normal,
            tangential,
            slide: at.slide,
            stretch,
            slip_rate: sense * at.slide_rate - give * force_rate,
            slip_rounding: ROUNDING * (speed + give * (law.stiffness * speed + law.damping * hurry)),
            lost_power,
            input_power: carried - tangential * radius * support.rates[2],
        }
    });
    let input = contacts[0].input_power + contacts[1].input_power + torque * disk[5];
    let lost = contacts[0].lost_power + contacts[1].lost_power;
    let [x, y, angle] = rates(disk);
    let [ax, ay, spin_up] = accelerations;
    Look {
        rates: [x, y, angle, ax, ay, spin_up, input, lost],
        contacts,
    }
}

//! Newton's equations of the disk: positions, velocities and phases in, accelerations and forces out (P 4.23, 4.24).

use crate::contact::{ElasticSkin, LinearDashpot};
use crate::drive::excitation::{Excitation, Instant};

use super::contact::{Contact, ContactForce, Phase};
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

/// Forces and accelerations of `disk` with these contacts at an instant.
///
/// The skin pulls at arm (R + R_i) / r, not R_i: so it is conservative though the disks overlap.
#[inline]
pub fn look<E: Excitation>(
    setup: &Setup,
    excitation: &E,
    instant: Instant,
    disk: &Vector,
    contacts: &[Contact; 2],
) -> Look {
    let Setup {
        radius,
        mass,
        normal: law,
        skin,
        ..
    } = *setup;
    let supports = excitation.supports(instant);
    let moves: [_; 2] = std::array::from_fn(|index| {
        kinematics(
            &setup.frames[index],
            setup.curvature,
            radius,
            place(disk),
            rates(disk),
            &supports[index],
        )
    });
    // Push, normal force, stretch and tangential force.
    let forces: [_; 2] = std::array::from_fn(|index| {
        let (at, contact) = (&moves[index], &contacts[index]);
        let push = law.stiffness * at.overlap + law.damping * at.overlap_rate;
        let (normal, stretch) = match contact.phase {
            Phase::Apart | Phase::Relaxing => (0.0, 0.0),
            Phase::Stick => (push, at.slide - contact.unstretched),
            Phase::Slip(sense) => (push, sense.sign() * (skin.friction * push / skin.stiffness)),
        };
        (push, normal, stretch, skin.force(stretch))
    });
    let forward: [[f64; 2]; 2] = std::array::from_fn(|index| {
        let (at, frame, (_, normal, _, tangential)) = (&moves[index], &setup.frames[index], forces[index]);
        let pull = tangential / at.stretch;
        let along_normal = normal * at.normal - pull * at.tangent;
        let along_tangent = normal * at.tangent + pull * at.normal;
        std::array::from_fn(|axis| along_normal * frame.normal[axis] + along_tangent * frame.tangent[axis])
    });
    let torque = excitation.torque(instant);
    let accelerations = [
        (forward[0][0] + forward[1][0]) / mass,
        (forward[0][1] + forward[1][1]) / mass - setup.gravity,
        (radius * (forces[0].3 + forces[1].3) + torque) / setup.inertia(),
    ];
    let hurry = (forces[0].0.abs() + forces[1].0.abs()) / mass + setup.gravity;
    let contacts: [ContactForce; 2] = std::array::from_fn(|index| {
        let (at, frame, support, contact) = (&moves[index], &setup.frames[index], &supports[index], &contacts[index]);
        let (push, normal, stretch, tangential) = forces[index];
        let rising = [0, 1].map(|axis| accelerations[axis] - support.accelerations[axis]);
        let along = |direction: [f64; 2]| rising[0] * direction[0] + rising[1] * direction[1];
        let outward = along(frame.normal) * at.normal + along(frame.tangent) * at.tangent;
        let force_rate = law.stiffness * at.overlap_rate + law.damping * (at.centripetal - outward);
        let sense = match contact.phase {
            Phase::Slip(sense) => sense.sign(),
            _ if stretch == 0.0 => 1.0_f64.copysign(at.slide_rate),
            _ => 1.0_f64.copysign(stretch),
        };
        let slip_rate = sense * at.slide_rate - skin.friction * force_rate / skin.stiffness;
        let rates_in_it =
            at.slide_rate.abs() + at.overlap_rate.abs() + radius * (disk[5].abs() + support.rates[2].abs());
        let force_rates = law.stiffness * rates_in_it + law.damping * hurry;
        let lost_power = match contact.phase {
            Phase::Apart => 0.0,
            Phase::Relaxing => -law.stiffness * at.overlap * at.overlap_rate,
            Phase::Stick => law.damping * at.overlap_rate * at.overlap_rate,
            Phase::Slip(_) => law.damping * at.overlap_rate * at.overlap_rate + skin.friction * normal * slip_rate,
        };
        let carried = forward[index][0] * support.rates[0] + forward[index][1] * support.rates[1];
        ContactForce {
            overlap: at.overlap,
            push,
            normal,
            tangential,
            slide: at.slide,
            stretch,
            slip_rate,
            slip_rounding: ROUNDING * (rates_in_it + skin.friction / skin.stiffness * force_rates),
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

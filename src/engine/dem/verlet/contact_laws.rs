//! The contact laws on two contacts side by side, each in its own frame: overlaps and velocities in, forces out.
//!
//! The formulas are those of [`crate::contact`]. Nothing branches on whether a contact is closed, except at the instants
//! at which it closes or opens: few candidates do not touch. Not here: which disks touch and where a contact lies in space
//! (`forces`).

use std::marker::PhantomData;

use crate::contact::{ContactLaws, NormalForce};
use crate::engine::dem::angle::SMALL_SINE;
use crate::engine::dem::lanes::{F64x2, lane, largest, per_lane};

use super::contacts::SpringMemory;

/// Two candidates along their normals.
#[derive(Clone, Copy, Default)]
pub struct Approach {
    /// Towards the first body.
    pub normal: [F64x2; 2],
    /// delta \[m\], positive while they touch.
    pub overlap: F64x2,
    /// u_n \[m/s\], negative on approach.
    pub velocity: F64x2,
}

/// Two candidates along their surfaces.
#[derive(Clone, Copy, Default)]
pub struct Surfaces {
    /// lambda \[m\] with beta counted from zero (P 4.5, 4.7).
    pub tangential_displacement: F64x2,
    /// Lever of beta in lambda \[m\]: the sum of the radii, and 0 at a wall, whose normal does not turn.
    pub radius_sum: F64x2,
    /// Force on the centres over that on the surfaces: the sum of the radii over the distance, and 1 at a wall.
    pub lever: F64x2,
}

/// Gives u_t \[m/s\] of two contacts. Not a closure: one that is called from a rare branch is not inlined, and everything
/// that it captures would be stored for it each time.
pub trait Sliding {
    /// Relative velocity along the surfaces.
    fn velocity(&self) -> F64x2;
}

/// Normal forces and tangential forces on the first bodies of two contacts \[N\].
#[derive(Clone, Copy)]
pub struct ContactForces {
    /// n.
    pub normal: F64x2,
    /// tau, along the tangent.
    pub tangential: F64x2,
}

/// The contact laws on lanes, with what follows from their constants.
pub struct LaneLaws<N> {
    normal: [F64x2; 2],
    tangential_stiffness: F64x2,
    half_tangential_stiffness: F64x2,
    /// Largest stretch over normal force, mu / k_t \[m/N\].
    slip_compliance: F64x2,
    step: f64,
    law: PhantomData<N>,
}

impl<N: NormalForce> LaneLaws<N> {
    /// For an evaluation at the end of a step of length `step` \[s\].
    pub fn new(laws: &ContactLaws<N>, step: f64) -> Self {
        let ContactLaws { normal, tangential } = laws;
        // A spring without stiffness never slips: finite, so that its product with any force is a number.
        let slip_compliance = (tangential.friction / tangential.stiffness).min(f64::MAX);
        Self {
            normal: normal.constants().map(F64x2::splat),
            tangential_stiffness: F64x2::splat(tangential.stiffness),
            half_tangential_stiffness: F64x2::splat(0.5 * tangential.stiffness),
            slip_compliance: F64x2::splat(slip_compliance),
            step,
            law: PhantomData,
        }
    }

    /// Forces of two contacts, zero for those that do not touch, with the springs' memory brought up to date. `sliding`
    /// is called at first touch only.
    ///
    /// Without SPRING no force acts along the surfaces, and nothing of them is read or remembered.
    #[inline(always)]
    pub fn forces<const SPRING: bool>(
        &self,
        approach: &Approach,
        surfaces: &Surfaces,
        springs: [&mut SpringMemory; 2],
        sums: &mut LaneSums,
        sliding: impl Sliding,
    ) -> ContactForces {
        let Approach {
            normal: direction,
            overlap,
            velocity,
        } = *approach;
        let zero = F64x2::splat(0.0);
        let touches = overlap.simd_gt(zero);
        let elastic = N::elastic(self.normal, overlap);
        let normal = (elastic - N::viscous(self.normal, overlap, velocity)).fast_max(zero) & touches;
        let lost_power = || ((elastic - normal) & touches) * velocity;
        if !SPRING {
            sums.add(lost_power(), overlap);
            sums.touching += F64x2::splat(1.0) & touches;
            return ContactForces {
                normal,
                tangential: zero,
            };
        }

        let [one, other] = springs;
        let closed = per_lane(|k| [one.direction[0], other.direction[0]][k]).simd_ne(zero)
            | per_lane(|k| [one.direction[1], other.direction[1]][k]).simd_ne(zero);
        if closed.to_bitmask() != touches.to_bitmask() {
            let touch = Touch {
                approach,
                tangential_displacement: surfaces.tangential_displacement,
                sliding: sliding.velocity(),
            };
            self.close_or_open(&touch, [&mut *one, &mut *other], sums);
        }
        let sine = sine_of_turn(direction, [one, other]);
        let sine = if sine.abs().simd_ge(F64x2::splat(SMALL_SINE)).any() {
            turn_directions(direction, surfaces.radius_sum, [&mut *one, &mut *other]);
            sine_of_turn(direction, [one, other])
        } else {
            sine
        };
        let square = sine * sine;
        let turn = sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0)));

        let reference = F64x2::new([one.reference, other.reference]);
        let trial = surfaces.tangential_displacement - surfaces.radius_sum * turn - reference;
        let limit = self.slip_compliance * normal;
        let stretch = trial.fast_max(zero - limit).fast_min(limit) & touches;
        let slip = trial - stretch;
        // Slip dissipates the mean of the forces before and after times its length; both point against the slip.
        let before = F64x2::new([one.stretch, other.stretch]);
        sums.slip_heat += self.half_tangential_stiffness * (stretch + before) * slip;
        sums.add(lost_power(), overlap);
        let reference = ((reference + slip) & touches).to_array();
        let kept = stretch.to_array();
        (one.reference, other.reference) = (reference[0], reference[1]);
        (one.stretch, other.stretch) = (kept[0], kept[1]);
        ContactForces {
            normal,
            tangential: zero - self.tangential_stiffness * stretch,
        }
    }

    /// For a contact that closes inside the step lambda* is that of the instant of touch; one that opens loses the energy
    /// that its spring still holds.
    #[cold]
    #[inline(never)]
    fn close_or_open(&self, touch: &Touch<'_>, springs: [&mut SpringMemory; 2], sums: &mut LaneSums) {
        let approach = touch.approach;
        for (k, spring) in springs.into_iter().enumerate() {
            let (overlap, speed) = (lane(approach.overlap, k), -lane(approach.velocity, k));
            match (spring.is_closed(), overlap > 0.0) {
                (false, true) => {
                    sums.closed += 1;
                    // Closed since `overlap / speed`, and for no longer than this step.
                    let since = if speed * self.step > overlap {
                        overlap / speed
                    } else {
                        self.step
                    };
                    *spring = SpringMemory {
                        direction: approach.normal.map(|part| lane(part, k)),
                        reference: lane(touch.tangential_displacement, k) - lane(touch.sliding, k) * since,
                        stretch: 0.0,
                    };
                }
                (true, false) => {
                    sums.closed -= 1;
                    sums.lost_spring_energy +=
                        lane(self.half_tangential_stiffness, k) * spring.stretch * spring.stretch;
                    *spring = SpringMemory::OPEN;
                }
                _ => {}
            }
        }
    }
}

/// Two contacts of which one closes or opens: lambda \[m\] and u_t \[m/s\] beside their approach.
struct Touch<'a> {
    approach: &'a Approach,
    tangential_displacement: F64x2,
    sliding: F64x2,
}

/// Sines of the angles from the remembered directions to the normals; 0 while open.
#[inline(always)]
fn sine_of_turn(normal: [F64x2; 2], [one, other]: [&SpringMemory; 2]) -> F64x2 {
    let x = F64x2::new([one.direction[0], other.direction[0]]);
    let y = F64x2::new([one.direction[1], other.direction[1]]);
    x * normal[1] - y * normal[0]
}

/// Lets the remembered directions follow normals that have turned far.
#[cold]
#[inline(never)]
fn turn_directions(normal: [F64x2; 2], radius_sum: F64x2, springs: [&mut SpringMemory; 2]) {
    for (k, spring) in springs.into_iter().enumerate().filter(|(_, spring)| spring.is_closed()) {
        // The angle that is left is below the limit, and computed again by the caller.
        spring.turn(normal.map(|part| lane(part, k)), lane(radius_sum, k));
    }
}

/// Sums over the contacts of one evaluation.
#[derive(Debug, Clone, Copy, Default)]
pub struct ForceSums {
    /// Power lost in the dashpots \[W\].
    pub dissipated_power: f64,
    /// Energy lost by slip since the last evaluation \[J\].
    pub slip_heat: f64,
    /// Deepest overlap \[m\].
    pub deepest: f64,
    /// Closed contacts.
    pub contacts: u32,
}

/// The same sums, lane by lane.
#[derive(Default)]
pub struct LaneSums {
    dissipated_power: F64x2,
    slip_heat: F64x2,
    deepest: F64x2,
    /// Closed contacts without springs, which do not remember that they are closed.
    touching: F64x2,
    /// Contacts with springs that closed less those that opened since the last evaluation.
    closed: i64,
    lost_spring_energy: f64,
}

impl LaneSums {
    #[inline(always)]
    fn add(&mut self, lost_power: F64x2, overlap: F64x2) {
        self.dissipated_power += lost_power;
        self.deepest = overlap.fast_max(self.deepest);
    }

    /// Both lanes together; with springs, `closed` contacts were closed before.
    pub fn total<const SPRING: bool>(&self, closed: u32) -> ForceSums {
        ForceSums {
            dissipated_power: self.dissipated_power.reduce_add(),
            slip_heat: self.slip_heat.reduce_add() + self.lost_spring_energy,
            deepest: largest(self.deepest),
            contacts: if SPRING {
                (i64::from(closed) + self.closed) as u32
            } else {
                self.touching.reduce_add() as u32
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{LinearDashpot, TangentialSpring};

    struct AtRest;

    impl Sliding for AtRest {
        fn velocity(&self) -> F64x2 {
            F64x2::splat(0.0)
        }
    }

    /// Pressed and sticking, pressed and slipping in both senses, leaving faster than the spring recovers.
    #[test]
    fn lanes_give_the_forces_of_the_scalar_laws() {
        let normal = LinearDashpot {
            stiffness: 1e4,
            damping: 0.3,
        };
        let tangential = TangentialSpring {
            stiffness: 7e3,
            friction: 0.2,
        };
        let laws = LaneLaws::new(&ContactLaws { normal, tangential }, 1e-5);
        for (overlap, velocity, trial) in [
            (2e-4, -0.1, 1e-5),
            (2e-4, 0.05, 1e-3),
            (3e-4, 0.0, -1e-3),
            (1e-5, 0.9, 1e-5),
        ] {
            let approach = Approach {
                normal: [F64x2::splat(1.0), F64x2::splat(0.0)],
                overlap: F64x2::splat(overlap),
                velocity: F64x2::splat(velocity),
            };
            let surfaces = Surfaces {
                tangential_displacement: F64x2::splat(trial),
                ..Surfaces::default()
            };
            let mut springs = [SpringMemory {
                direction: [1.0, 0.0],
                ..SpringMemory::OPEN
            }; 2];
            let [one, other] = &mut springs;
            let mut sums = LaneSums::default();
            let forces = laws.forces::<true>(&approach, &surfaces, [one, other], &mut sums, AtRest);

            let force = normal.force(overlap, velocity);
            let stretch = tangential.limited(trial, force);
            let lost = 2.0 * normal.dissipated_power(overlap, velocity, force);
            assert_eq!(forces.normal.to_array(), [force; 2]);
            assert_eq!(sums.total::<true>(2).dissipated_power, lost);
            for (k, spring) in springs.iter().enumerate() {
                let expected = tangential.force(stretch);
                assert!((lane(forces.tangential, k) - expected).abs() <= 2.0 * f64::EPSILON * expected.abs());
                assert!((spring.stretch - stretch).abs() <= 2.0 * f64::EPSILON * stretch.abs());
            }
        }
    }
}

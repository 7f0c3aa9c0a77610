//! The contact laws on contacts side by side, each in its own frame: overlaps and velocities in, forces out.
//!
//! The formulas are those of [`crate::contact`]. Nothing branches on whether a contact is closed, except at the instants
//! at which it closes or opens: few candidates do not touch. Not here: which disks touch and where a contact lies in space
//! (`forces`).

use std::marker::PhantomData;

use fearless_simd::{Select, Simd, SimdMask};

use crate::contact::{ContactLaws, NormalForce};
use crate::engine::dem::angle::SMALL_SINE;
use crate::engine::dem::lanes::Lanes;

use super::contacts::SpringMemory;
use super::eights::EightSprings;
use super::force_sums::LaneSums;

/// Candidates along their normals.
#[derive(Clone, Copy)]
pub struct Approach<V> {
    /// Towards the first body.
    pub normal: [V; 2],
    /// delta \[m\], positive while they touch.
    pub overlap: V,
    /// u_n \[m/s\], negative on approach.
    pub velocity: V,
}

/// Candidates along their surfaces.
#[derive(Clone, Copy)]
pub struct Surfaces<V> {
    /// lambda \[m\] with beta counted from zero (P 4.5, 4.7).
    pub tangential_displacement: V,
    /// Lever of beta in lambda \[m\]: the sum of the radii, and 0 at a wall, whose normal does not turn.
    pub radius_sum: V,
    /// Force on the centres over that on the surfaces: the sum of the radii over the distance, and 1 at a wall.
    pub lever: V,
}

/// Gives u_t \[m/s\] of a contact. Not a closure: everything that one captures would be stored for a rare branch each time.
pub trait Sliding {
    /// Relative velocity along the surfaces of the contact in the `k`-th place of its eight, with this normal and lever.
    fn velocity(&self, k: usize, normal: [f64; 2], lever: f64) -> f64;
}

/// Normal forces and tangential forces on the first bodies of contacts \[N\].
#[derive(Clone, Copy)]
pub struct ContactForces<V> {
    /// n.
    pub normal: V,
    /// tau, along the tangent.
    pub tangential: V,
}

/// The contact laws on lanes, with what follows from their constants.
pub struct LaneLaws<S, V, N> {
    normal: [V; 2],
    tangential_stiffness: V,
    half_tangential_stiffness: V,
    /// Largest stretch over normal force, mu / k_t \[m/N\].
    slip_compliance: V,
    half_stiffness_of_one: f64,
    step: f64,
    simd: S,
    law: PhantomData<N>,
}

impl<S: Simd, V: Lanes<S>, N: NormalForce> LaneLaws<S, V, N> {
    /// For an evaluation at the end of a step of length `step` \[s\].
    #[inline(always)]
    pub fn new(simd: S, laws: &ContactLaws<N>, step: f64) -> Self {
        let ContactLaws { normal, tangential } = laws;
        // A spring without stiffness never slips: finite, so that its product with any force is a number.
        let slip_compliance = (tangential.friction / tangential.stiffness).min(f64::MAX);
        let half_stiffness_of_one = 0.5 * tangential.stiffness;
        let [elastic, viscous] = normal.constants();
        Self {
            normal: [V::splat(simd, elastic), V::splat(simd, viscous)],
            tangential_stiffness: V::splat(simd, tangential.stiffness),
            half_tangential_stiffness: V::splat(simd, half_stiffness_of_one),
            slip_compliance: V::splat(simd, slip_compliance),
            half_stiffness_of_one,
            step,
            simd,
            law: PhantomData,
        }
    }

    /// For registers of this kind.
    #[inline(always)]
    pub fn simd(&self) -> S {
        self.simd
    }

    /// Forces of contacts, zero for those that do not touch, with the springs' memory brought up to date. `sliding` is
    /// called at first touch only. The springs are those of the eight from the place `at` on, a multiple of the lanes.
    ///
    /// Without SPRING no force acts along the surfaces, and nothing of them is read or remembered.
    #[inline(always)]
    pub fn forces<const SPRING: bool>(
        &self,
        approach: Approach<V>,
        surfaces: Surfaces<V>,
        (springs, at): (&mut EightSprings, usize),
        sums: &mut LaneSums<V>,
        sliding: impl Sliding,
    ) -> ContactForces<V> {
        // What goes to a function that is not inlined is put together where it is called: it would be in memory all the time.
        let Approach {
            normal: [nx, ny],
            overlap,
            velocity,
        } = approach;
        let Surfaces {
            tangential_displacement,
            radius_sum,
            lever,
        } = surfaces;
        let simd = self.simd;
        let zero = V::splat(simd, 0.0);
        let touches = overlap.simd_gt(zero);
        let elastic = N::elastic(self.normal, overlap);
        let normal = touches.select((elastic - N::viscous(self.normal, overlap, velocity)).max(zero), zero);
        let lost_power = touches.select(elastic - normal, zero) * velocity;
        sums.parts.dissipated_power.add(at, lost_power);
        sums.deepest = overlap.max(sums.deepest);
        if !SPRING {
            sums.parts.touching.add(at, touches.select(V::splat(simd, 1.0), zero));
            return ContactForces {
                normal,
                tangential: zero,
            };
        }

        let [mut x, mut y]: [V; 2] = directions(simd, springs, at);
        let closed = x.simd_ne(zero) | y.simd_ne(zero);
        if closed.to_bitmask() != touches.to_bitmask() {
            let approach = Approach {
                normal: [nx, ny],
                overlap,
                velocity,
            };
            let surfaces = Surfaces {
                tangential_displacement,
                radius_sum,
                lever,
            };
            self.close_or_open(approach, surfaces, (&mut *springs, at), sums, sliding);
            [x, y] = directions(simd, springs, at);
        }
        // Of the angle from the remembered direction to the normal; 0 while open.
        let mut sine = x * ny - y * nx;
        if sine.abs().simd_ge(V::splat(simd, SMALL_SINE)).any_true() {
            turn_directions([nx, ny], radius_sum, (&mut *springs, at));
            [x, y] = directions(simd, springs, at);
            sine = x * ny - y * nx;
        }
        let square = sine * sine;
        let turn = sine * (square * (square * (3.0 / 40.0) + 1.0 / 6.0) + 1.0);

        let reference = V::from_slice(simd, &springs.reference[at..at + V::LEN]);
        let trial = tangential_displacement - radius_sum * turn - reference;
        let limit = self.slip_compliance * normal;
        let stretch = touches.select(trial.max(zero - limit).min(limit), zero);
        let slip = trial - stretch;
        // Slip dissipates the mean of the forces before and after times its length; both point against the slip.
        let before = V::from_slice(simd, &springs.stretch[at..at + V::LEN]);
        sums.parts
            .slip_heat
            .add(at, self.half_tangential_stiffness * (stretch + before) * slip);
        touches
            .select(reference + slip, zero)
            .store_slice(&mut springs.reference[at..at + V::LEN]);
        stretch.store_slice(&mut springs.stretch[at..at + V::LEN]);
        ContactForces {
            normal,
            tangential: zero - self.tangential_stiffness * stretch,
        }
    }

    /// For a contact that closes inside the step lambda* is that of the instant of touch; one that opens loses the energy
    /// that its spring still holds.
    #[cold]
    #[inline(never)]
    fn close_or_open(
        &self,
        approach: Approach<V>,
        surfaces: Surfaces<V>,
        (springs, at): (&mut EightSprings, usize),
        sums: &mut LaneSums<V>,
        sliding: impl Sliding,
    ) {
        for k in 0..V::LEN {
            let (overlap, speed) = (approach.overlap[k], -approach.velocity[k]);
            let spring = springs.get(at + k);
            match (spring.is_closed(), overlap > 0.0) {
                (false, true) => {
                    sums.parts.closed += 1;
                    // Closed since `overlap / speed`, and for no longer than this step.
                    let since = if speed * self.step > overlap {
                        overlap / speed
                    } else {
                        self.step
                    };
                    let direction = [approach.normal[0][k], approach.normal[1][k]];
                    let slid = sliding.velocity(at + k, direction, surfaces.lever[k]) * since;
                    let closed = SpringMemory {
                        direction,
                        reference: surfaces.tangential_displacement[k] - slid,
                        stretch: 0.0,
                    };
                    springs.set(at + k, closed);
                }
                (true, false) => {
                    sums.parts.closed -= 1;
                    sums.parts.lost_spring_energy += self.half_stiffness_of_one * spring.stretch * spring.stretch;
                    springs.set(at + k, SpringMemory::OPEN);
                }
                _ => {}
            }
        }
    }
}

/// Remembered directions; zero while open.
#[inline(always)]
fn directions<S: Simd, V: Lanes<S>>(simd: S, springs: &EightSprings, at: usize) -> [V; 2] {
    [
        V::from_slice(simd, &springs.direction_x[at..at + V::LEN]),
        V::from_slice(simd, &springs.direction_y[at..at + V::LEN]),
    ]
}

/// Lets the remembered directions follow normals that have turned far.
#[cold]
#[inline(never)]
fn turn_directions<S: Simd, V: Lanes<S>>(normal: [V; 2], radius_sum: V, (springs, at): (&mut EightSprings, usize)) {
    for k in 0..V::LEN {
        let mut spring = springs.get(at + k);
        if spring.is_closed() {
            // The angle that is left is below the limit, and computed again by the caller.
            spring.turn([normal[0][k], normal[1][k]], radius_sum[k]);
            springs.set(at + k, spring);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::force_sums::ForceSums;
    use super::*;
    use crate::contact::{LinearDashpot, TangentialSpring};
    use crate::engine::dem::lanes::{LaneWork, in_lanes};

    struct AtRest;

    impl Sliding for AtRest {
        fn velocity(&self, _k: usize, _normal: [f64; 2], _lever: f64) -> f64 {
            0.0
        }
    }

    const NORMAL: LinearDashpot = LinearDashpot {
        stiffness: 1e4,
        damping: 0.3,
    };
    const TANGENTIAL: TangentialSpring = TangentialSpring {
        stiffness: 7e3,
        friction: 0.2,
    };

    /// An overlap, a normal velocity and a trial stretch in all lanes: the first lane, and whether all are like it.
    struct InAllLanes(f64, f64, f64);

    impl LaneWork for InAllLanes {
        type Output = (f64, f64, f64, ForceSums, usize);

        #[inline(always)]
        fn run<S: Simd, V: Lanes<S>>(self, simd: S) -> Self::Output {
            let Self(overlap, velocity, trial) = self;
            let laws = ContactLaws {
                normal: NORMAL,
                tangential: TANGENTIAL,
            };
            let laws = LaneLaws::<S, V, _>::new(simd, &laws, 1e-5);
            let approach = Approach {
                normal: [V::splat(simd, 1.0), V::splat(simd, 0.0)],
                overlap: V::splat(simd, overlap),
                velocity: V::splat(simd, velocity),
            };
            let surfaces = Surfaces {
                tangential_displacement: V::splat(simd, trial),
                radius_sum: V::splat(simd, 0.0),
                lever: V::splat(simd, 1.0),
            };
            let mut springs = EightSprings {
                direction_x: [1.0; 8],
                ..EightSprings::default()
            };
            let mut sums = LaneSums::new(simd);
            let forces = laws.forces::<true>(approach, surfaces, (&mut springs, 0), &mut sums, AtRest);
            assert!((0..V::LEN).all(|k| forces.normal[k] == forces.normal[0]));
            assert!((0..V::LEN).all(|k| forces.tangential[k] == forces.tangential[0]));
            let sums = sums.partial().total::<true>(2);
            (forces.normal[0], forces.tangential[0], springs.stretch[0], sums, V::LEN)
        }
    }

    /// Pressed and sticking, pressed and slipping in both senses, leaving faster than the spring recovers.
    #[test]
    fn lanes_give_the_forces_of_the_scalar_laws() {
        for (overlap, velocity, trial) in [
            (2e-4, -0.1, 1e-5),
            (2e-4, 0.05, 1e-3),
            (3e-4, 0.0, -1e-3),
            (1e-5, 0.9, 1e-5),
        ] {
            let (normal, tangential, kept, sums, lanes) = in_lanes(InAllLanes(overlap, velocity, trial));
            let force = NORMAL.force(overlap, velocity);
            let stretch = TANGENTIAL.limited(trial, force);
            let lost = lanes as f64 * NORMAL.dissipated_power(overlap, velocity, force);
            assert_eq!(normal, force);
            assert_eq!(sums.dissipated_power, lost);
            let expected = TANGENTIAL.force(stretch);
            assert!((tangential - expected).abs() <= 2.0 * f64::EPSILON * expected.abs());
            assert!((kept - stretch).abs() <= 2.0 * f64::EPSILON * stretch.abs());
        }
    }
}

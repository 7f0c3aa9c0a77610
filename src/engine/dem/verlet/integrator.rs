//! Integrators of Newton's equations: predict, let the forces be evaluated there, correct.
//!
//! The force is evaluated once a step, at predicted positions and predicted velocities of the same instant, so that
//! damping acts with the velocity at the instant of the force. Integrators work on flat arrays of degrees of freedom: the
//! impulses of the walls are further degrees of freedom of unit mass, and so obey the same recursion as the momenta that
//! they balance.

use fearless_simd::Simd;

use crate::contact::Numbers;
use crate::engine::dem::lanes::{LaneWork, Lanes, in_lanes};

/// A rule that advances degrees of freedom by one step.
///
/// It is a type parameter of the engine, though the scenes use velocity Verlet alone, because P used Gear's: who repeats
/// P's runs or compares integrators takes [`Gear5`](super::Gear5), and neither is compiled into the other.
pub trait Integrator: std::fmt::Debug + Clone + Copy + Default + Send + 'static {
    /// Derivatives beyond the acceleration that are kept for each degree of freedom.
    const HIGHER_DERIVATIVES: usize;

    /// Name for reports.
    const NAME: &'static str;

    /// Moves everything from t to t + `step` by what is known at t.
    fn predict(coordinates: Coordinates<'_>, step: f64);

    /// Corrects what was predicted by the force evaluated there, `acceleration = force * inverse_mass`.
    fn correct(coordinates: Coordinates<'_>, force: &[f64], inverse_mass: &[f64], step: f64);

    /// Corrects and then predicts the next step, with the same bits as one after the other, and puts the weights in the place of
    /// the forces for the next evaluation.
    fn correct_and_predict(mut coordinates: Coordinates<'_>, force: &mut [f64], constants: Constants<'_>, step: f64) {
        Self::correct(coordinates.reborrow(), force, constants.inverse_mass, step);
        Self::predict(coordinates, step);
        force.copy_from_slice(constants.weight);
    }
}

/// What stays constant of all degrees of freedom.
#[derive(Clone, Copy)]
pub struct Constants<'a> {
    /// Weights \[N\].
    pub weight: &'a [f64],
    /// 1/m \[1/kg\].
    pub inverse_mass: &'a [f64],
}

impl Constants<'_> {
    /// Those of the first `count` degrees of freedom, and of the others.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        let (weight, weight_after) = self.weight.split_at(count);
        let (inverse_mass, inverse_mass_after) = self.inverse_mass.split_at(count);
        let part = |weight, inverse_mass| Constants { weight, inverse_mass };
        (part(weight, inverse_mass), part(weight_after, inverse_mass_after))
    }
}

/// Flat view of all degrees of freedom: positions and angles, their rates, their second derivatives, and more.
pub struct Coordinates<'state> {
    /// Positions \[m\] and angles \[rad\].
    pub position: &'state mut [f64],
    /// Velocities \[m/s\] and angular velocities \[rad/s\].
    pub velocity: &'state mut [f64],
    /// Accelerations \[m/s2\], \[rad/s2\].
    pub acceleration: &'state mut [f64],
    /// [`Integrator::HIGHER_DERIVATIVES`] arrays of the same length, one behind the other.
    pub higher: &'state mut [f64],
}

impl<'state> Coordinates<'state> {
    /// Those of the first `count` degrees of freedom, and of the others. Only without higher derivatives.
    pub fn split_at(self, count: usize) -> (Self, Self) {
        debug_assert!(self.higher.is_empty());
        let (position, position_after) = self.position.split_at_mut(count);
        let (velocity, velocity_after) = self.velocity.split_at_mut(count);
        let (acceleration, acceleration_after) = self.acceleration.split_at_mut(count);
        let part = |position: &'state mut [f64], velocity, acceleration| Self {
            position,
            velocity,
            acceleration,
            higher: &mut [],
        };
        (
            part(position, velocity, acceleration),
            part(position_after, velocity_after, acceleration_after),
        )
    }

    /// The same view for a shorter time.
    pub fn reborrow(&mut self) -> Coordinates<'_> {
        Coordinates {
            position: self.position,
            velocity: self.velocity,
            acceleration: self.acceleration,
            higher: self.higher,
        }
    }
}

/// Velocity Verlet, second order, with damping at the predicted velocity of the same instant.
///
/// `x += h v + h^2 a / 2`, `v += h (a + a') / 2`. Source: Swope et al. 1982, doi:10.1063/1.442716.
#[derive(Debug, Clone, Copy, Default)]
pub struct VelocityVerlet;

impl Integrator for VelocityVerlet {
    const HIGHER_DERIVATIVES: usize = 0;
    const NAME: &'static str = "velocity Verlet";

    fn predict(coordinates: Coordinates<'_>, step: f64) {
        let Coordinates {
            position,
            velocity,
            acceleration,
            ..
        } = coordinates;
        in_lanes(Drift {
            position,
            velocity,
            acceleration,
            step,
        });
    }

    fn correct(coordinates: Coordinates<'_>, force: &[f64], inverse_mass: &[f64], step: f64) {
        let Coordinates {
            velocity, acceleration, ..
        } = coordinates;
        in_lanes(Kick {
            velocity,
            acceleration,
            force,
            inverse_mass,
            step,
        });
    }

    fn correct_and_predict(coordinates: Coordinates<'_>, force: &mut [f64], constants: Constants<'_>, step: f64) {
        let Coordinates {
            position,
            velocity,
            acceleration,
            ..
        } = coordinates;
        in_lanes(KickAndDrift {
            position,
            velocity,
            acceleration,
            force,
            constants,
            step,
        });
    }
}

/// `x += h v + h^2 a / 2`, `v += h a`.
struct Drift<'a> {
    position: &'a mut [f64],
    velocity: &'a mut [f64],
    acceleration: &'a [f64],
    step: f64,
}

impl LaneWork for Drift<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd, V: Lanes<S>>(self, simd: S) {
        let step = self.step;
        each_register::<S, V, Self, 1, 2>(simd, step, [self.acceleration], [self.position, self.velocity]);
    }
}

impl Change<1, 2> for Drift<'_> {
    #[inline(always)]
    fn of<T: Numbers>([step, half]: [T; 2], [a]: [T; 1], [x, v]: [T; 2]) -> [T; 2] {
        [x + step * (v + half * a), v + step * a]
    }
}

/// `a' = F / m`, `v += h (a' - a) / 2`.
struct Kick<'a> {
    velocity: &'a mut [f64],
    acceleration: &'a mut [f64],
    force: &'a [f64],
    inverse_mass: &'a [f64],
    step: f64,
}

impl LaneWork for Kick<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd, V: Lanes<S>>(self, simd: S) {
        let (given, changed) = ([self.force, self.inverse_mass], [self.velocity, self.acceleration]);
        each_register::<S, V, Self, 2, 2>(simd, self.step, given, changed);
    }
}

impl Change<2, 2> for Kick<'_> {
    #[inline(always)]
    fn of<T: Numbers>([_, half]: [T; 2], [force, inverse_mass]: [T; 2], [v, a]: [T; 2]) -> [T; 2] {
        let corrected = force * inverse_mass;
        [v + half * (corrected - a), corrected]
    }
}

/// [`Kick`] and then [`Drift`], with the weights in the place of the forces: each number is loaded and stored once.
struct KickAndDrift<'a> {
    position: &'a mut [f64],
    velocity: &'a mut [f64],
    acceleration: &'a mut [f64],
    force: &'a mut [f64],
    constants: Constants<'a>,
    step: f64,
}

impl LaneWork for KickAndDrift<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd, V: Lanes<S>>(self, simd: S) {
        let changed = [self.position, self.velocity, self.acceleration, self.force];
        let given = [self.constants.weight, self.constants.inverse_mass];
        each_register::<S, V, Self, 2, 4>(simd, self.step, given, changed);
    }
}

impl Change<2, 4> for KickAndDrift<'_> {
    #[inline(always)]
    fn of<T: Numbers>(steps: [T; 2], [weight, inverse_mass]: [T; 2], [x, v, a, force]: [T; 4]) -> [T; 4] {
        let [kicked, corrected] = Kick::of(steps, [force, inverse_mass], [v, a]);
        let [moved, predicted] = Drift::of(steps, [corrected], [x, kicked]);
        [moved, predicted, corrected, weight]
    }
}

/// What becomes of numbers of the same index in arrays of which some are GIVEN and some are CHANGED.
trait Change<const GIVEN: usize, const CHANGED: usize> {
    /// With the step and half of it.
    fn of<T: Numbers>(steps: [T; 2], given: [T; GIVEN], changed: [T; CHANGED]) -> [T; CHANGED];
}

/// Changes arrays of one length, register by register.
#[inline(always)]
fn each_register<S: Simd, V: Lanes<S>, C: Change<GIVEN, CHANGED>, const GIVEN: usize, const CHANGED: usize>(
    simd: S,
    step: f64,
    given: [&[f64]; GIVEN],
    changed: [&mut [f64]; CHANGED],
) {
    let length = changed[0].len();
    let given = given.map(|numbers| &numbers[..length]);
    let changed = changed.map(|numbers| &mut numbers[..length]);
    let steps = [V::splat(simd, step), V::splat(simd, 0.5 * step)];
    let (mut one, mut other) = ([V::splat(simd, 0.0); GIVEN], [V::splat(simd, 0.0); CHANGED]);
    let whole = length - length % V::LEN;
    for start in (0..whole).step_by(V::LEN) {
        let at = start..start + V::LEN;
        for k in 0..GIVEN {
            one[k] = V::from_slice(simd, &given[k][at.clone()]);
        }
        for k in 0..CHANGED {
            other[k] = V::from_slice(simd, &changed[k][at.clone()]);
        }
        let results = C::of(steps, one, other);
        for k in 0..CHANGED {
            results[k].store_slice(&mut changed[k][at.clone()]);
        }
    }
    for n in whole..length {
        let (one, other) = (
            given.map(|numbers| numbers[n]),
            changed.each_ref().map(|numbers| numbers[n]),
        );
        let results = C::of([step, 0.5 * step], one, other);
        for k in 0..CHANGED {
            changed[k][n] = results[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::dem::verlet::Gear5;

    /// Error of x'' = -x after one period, started with exact derivatives.
    fn oscillator_error<I: Integrator>(steps: usize) -> f64 {
        let step = std::f64::consts::TAU / steps as f64;
        let (mut position, mut velocity, mut acceleration) = ([1.0], [0.0], [-1.0]);
        let mut higher = vec![0.0, 1.0, 0.0];
        higher.truncate(I::HIGHER_DERIVATIVES);
        macro_rules! coordinates {
            () => {
                Coordinates {
                    position: &mut position,
                    velocity: &mut velocity,
                    acceleration: &mut acceleration,
                    higher: &mut higher,
                }
            };
        }
        for _ in 0..steps {
            I::predict(coordinates!(), step);
            let force = [-position[0]];
            I::correct(coordinates!(), &force, &[1.0], step);
        }
        (position[0] - 1.0).hypot(velocity[0])
    }

    fn order<I: Integrator>() -> f64 {
        (oscillator_error::<I>(200) / oscillator_error::<I>(400)).log2()
    }

    /// The closed form is cos t.
    #[test]
    fn orders_on_the_harmonic_oscillator() {
        let (verlet, gear) = (order::<VelocityVerlet>(), order::<Gear5>());
        println!("order on x'' = -x: velocity Verlet {verlet:.2}, Gear 5 {gear:.2}");
        assert!((verlet - 2.0).abs() < 0.05, "{verlet}");
        assert!(gear > 3.9, "{gear}");
    }
}

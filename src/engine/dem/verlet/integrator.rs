//! Integrators of Newton's equations: predict, let the forces be evaluated there, correct.
//!
//! The force is evaluated once a step, at predicted positions and predicted velocities of the same instant, so that
//! damping acts with the velocity at the instant of the force. Integrators work on flat arrays of degrees of freedom: the
//! impulses of the walls are further degrees of freedom of unit mass, and so obey the same recursion as the momenta that
//! they balance.

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

    /// Corrects and then predicts the next step, with the same bits as one after the other.
    fn correct_and_predict(mut coordinates: Coordinates<'_>, force: &[f64], inverse_mass: &[f64], step: f64) {
        Self::correct(coordinates.reborrow(), force, inverse_mass, step);
        Self::predict(coordinates, step);
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

impl Coordinates<'_> {
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

    #[inline]
    fn predict(coordinates: Coordinates<'_>, step: f64) {
        drift(
            coordinates.position,
            coordinates.velocity,
            coordinates.acceleration,
            step,
        );
    }

    #[inline]
    fn correct(coordinates: Coordinates<'_>, force: &[f64], inverse_mass: &[f64], step: f64) {
        kick(
            coordinates.velocity,
            coordinates.acceleration,
            force,
            inverse_mass,
            step,
        );
    }

    #[inline]
    fn correct_and_predict(coordinates: Coordinates<'_>, force: &[f64], inverse_mass: &[f64], step: f64) {
        let Coordinates {
            position,
            velocity,
            acceleration,
            ..
        } = coordinates;
        kick_and_drift(position, velocity, acceleration, force, inverse_mass, step);
    }
}

/// `x += h v + h^2 a / 2`, `v += h a`. Never inlined: the compiler vectorises it only where it knows from the arguments
/// that the arrays do not overlap.
#[inline(never)]
fn drift(position: &mut [f64], velocity: &mut [f64], acceleration: &[f64], step: f64) {
    let half = 0.5 * step;
    for ((position, velocity), acceleration) in position.iter_mut().zip(velocity).zip(acceleration) {
        *position += step * (*velocity + half * acceleration);
        *velocity += step * acceleration;
    }
}

/// `a' = F / m`, `v += h (a' - a) / 2`, likewise.
#[inline(never)]
fn kick(velocity: &mut [f64], acceleration: &mut [f64], force: &[f64], inverse_mass: &[f64], step: f64) {
    let half = 0.5 * step;
    let forces = force.iter().zip(inverse_mass);
    for ((velocity, acceleration), (force, inverse_mass)) in velocity.iter_mut().zip(acceleration).zip(forces) {
        let corrected = force * inverse_mass;
        *velocity += half * (corrected - *acceleration);
        *acceleration = corrected;
    }
}

/// [`kick`] and then [`drift`]: each number is loaded and stored once.
#[inline(never)]
fn kick_and_drift(
    position: &mut [f64],
    velocity: &mut [f64],
    acceleration: &mut [f64],
    force: &[f64],
    inverse_mass: &[f64],
    step: f64,
) {
    let half = 0.5 * step;
    let forces = force.iter().zip(inverse_mass);
    let derivatives = velocity.iter_mut().zip(acceleration);
    for ((position, (velocity, acceleration)), (force, inverse_mass)) in
        position.iter_mut().zip(derivatives).zip(forces)
    {
        let corrected = force * inverse_mass;
        let kicked = *velocity + half * (corrected - *acceleration);
        *acceleration = corrected;
        *position += step * (kicked + half * corrected);
        *velocity = kicked + step * corrected;
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

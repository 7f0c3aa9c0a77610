//! Integrators of Newton's equations: predict, let the forces be evaluated there, correct.
//!
//! Both kinds evaluate the force once a step, at predicted positions and predicted velocities of the same instant, so
//! that damping acts with the velocity of the moment of the force. All work on flat arrays of degrees of freedom: the
//! boundary impulses ride along as further degrees of freedom of unit mass, and so obey the very same recursion as the
//! momenta that they balance.

/// A rule that advances degrees of freedom by one step; a type, not a flag.
pub trait Integrator: Clone + Copy + Default + Send + 'static {
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
        kick_and_drift((position, velocity, acceleration), force, inverse_mass, step);
    }
}

/// `x += h v + h^2 a / 2`, `v += h a`: inlined nowhere, since the compiler takes two at a time only if it knows from the
/// arguments that the arrays do not overlap.
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

/// [`kick`] and then [`drift`]: each number is fetched and stored once.
#[inline(never)]
fn kick_and_drift(
    (position, velocity, acceleration): (&mut [f64], &mut [f64], &mut [f64]),
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

/// Fifth-order Gear predictor-corrector for second-order equations whose force depends on velocity.
///
/// Source: P 2.2; Gear 1971; coefficients 3/16, 251/360, 1, 11/18, 1/6, 1/60 as in Allen and Tildesley 1987, table E.1.
#[derive(Debug, Clone, Copy, Default)]
pub struct Gear5;

/// Corrector coefficients times k!, for the k-th derivative as it stands (not scaled by the step).
const GEAR: [f64; 6] = [
    3.0 / 16.0,
    251.0 / 360.0,
    2.0,
    6.0 * 11.0 / 18.0,
    24.0 / 6.0,
    120.0 / 60.0,
];

impl Gear5 {
    /// The three arrays beyond the acceleration.
    fn split(higher: &mut [f64], count: usize) -> (&mut [f64], &mut [f64], &mut [f64]) {
        let (third, rest) = higher.split_at_mut(count);
        let (fourth, fifth) = rest.split_at_mut(count);
        (third, fourth, fifth)
    }
}

impl Integrator for Gear5 {
    const HIGHER_DERIVATIVES: usize = 3;
    const NAME: &'static str = "Gear 5";

    fn predict(coordinates: Coordinates<'_>, step: f64) {
        let Coordinates {
            position,
            velocity,
            acceleration,
            higher,
        } = coordinates;
        let (third, fourth, fifth) = Self::split(higher, position.len());
        let h = step;
        for i in 0..position.len() {
            let (r1, r2, r3, r4, r5) = (velocity[i], acceleration[i], third[i], fourth[i], fifth[i]);
            position[i] += h * (r1 + h / 2.0 * (r2 + h / 3.0 * (r3 + h / 4.0 * (r4 + h / 5.0 * r5))));
            velocity[i] += h * (r2 + h / 2.0 * (r3 + h / 3.0 * (r4 + h / 4.0 * r5)));
            acceleration[i] += h * (r3 + h / 2.0 * (r4 + h / 3.0 * r5));
            third[i] += h * (r4 + h / 2.0 * r5);
            fourth[i] += h * r5;
        }
    }

    fn correct(coordinates: Coordinates<'_>, force: &[f64], inverse_mass: &[f64], step: f64) {
        let Coordinates {
            position,
            velocity,
            acceleration,
            higher,
        } = coordinates;
        let (third, fourth, fifth) = Self::split(higher, position.len());
        let h = step;
        for i in 0..position.len() {
            let corrected = force[i] * inverse_mass[i];
            let half_difference = 0.5 * (corrected - acceleration[i]);
            position[i] += GEAR[0] * h * h * half_difference;
            velocity[i] += GEAR[1] * h * half_difference;
            acceleration[i] = corrected;
            third[i] += GEAR[3] / h * half_difference;
            fourth[i] += GEAR[4] / (h * h) * half_difference;
            fifth[i] += GEAR[5] / (h * h * h) * half_difference;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

//! Gear's predictor-corrector of fifth order, the integrator of P 2.2.

use super::integrator::{Coordinates, Integrator};

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

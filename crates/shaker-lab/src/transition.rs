//! Exact steps of a linear system with inputs: x' = A x + b_1 u_1 + b_2 u_2.
//!
//! Needs: inputs that are constant over the step, or the sine and cosine of one frequency. Guarantees: no error but rounding, whatever the
//! step.
//!
//! The matrix exponential is ours: that of nalgebra comes with its feature "std", which brings products by kernels of the processor at hand
//! and the C library's functions, whose last bits differ between systems.

use nalgebra::{SMatrix, SVector};

/// What a step of one length makes of the state and of the two inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Transition {
    of_state: SMatrix<f64, 3, 3>,
    of_inputs: SMatrix<f64, 3, 2>,
}

impl Transition {
    /// Steps of `step` \[s\] under constant inputs.
    pub fn held(system: &SMatrix<f64, 3, 3>, inputs: &SMatrix<f64, 3, 2>, step: f64) -> Self {
        Self::joined(system, inputs, &SMatrix::zeros(), step)
    }

    /// Steps of `step` \[s\] under (u, u'/omega) of a harmonic oscillation u with the angular frequency `omega` \[rad/s\].
    pub fn oscillating(system: &SMatrix<f64, 3, 3>, inputs: &SMatrix<f64, 3, 2>, omega: f64, step: f64) -> Self {
        Self::joined(
            system,
            inputs,
            &SMatrix::<f64, 2, 2>::new(0.0, omega, -omega, 0.0),
            step,
        )
    }

    /// The inputs joined to the state, u' = `of_inputs` u: the matrix exponential then has all of the answer.
    fn joined(
        system: &SMatrix<f64, 3, 3>,
        inputs: &SMatrix<f64, 3, 2>,
        of_inputs: &SMatrix<f64, 2, 2>,
        step: f64,
    ) -> Self {
        let mut joined = SMatrix::<f64, 5, 5>::zeros();
        joined.fixed_view_mut::<3, 3>(0, 0).copy_from(system);
        joined.fixed_view_mut::<3, 2>(0, 3).copy_from(inputs);
        joined.fixed_view_mut::<2, 2>(3, 3).copy_from(of_inputs);
        let exponential = exponential(&(joined * step));
        Self {
            of_state: exponential.fixed_view::<3, 3>(0, 0).into_owned(),
            of_inputs: exponential.fixed_view::<3, 2>(0, 3).into_owned(),
        }
    }

    /// The state at the end of the step.
    pub fn end(&self, state: &SVector<f64, 3>, inputs: [f64; 2]) -> SVector<f64, 3> {
        self.of_state * state + self.effect(inputs)
    }

    /// What the inputs alone do to the state.
    pub fn effect(&self, inputs: [f64; 2]) -> SVector<f64, 3> {
        self.of_inputs * SVector::from(inputs)
    }
}

/// exp(M) = (exp(M / 2^s))^(2^s), the inner one by its series: 18 terms are exact to rounding where the 1-norm is 1/2 at most (0.5^19 / 19!
/// = 1.6e-23). Source: C. Moler, C. Van Loan, SIAM Review 45, 3 (2003), method 3.
fn exponential(matrix: &SMatrix<f64, 5, 5>) -> SMatrix<f64, 5, 5> {
    let columns = matrix
        .column_iter()
        .map(|column| column.iter().map(|entry| entry.abs()).sum());
    let mut norm = columns.fold(0.0, f64::max);
    let (mut scaled, mut squarings) = (*matrix, 0);
    while norm > 0.5 {
        (scaled, norm, squarings) = (scaled * 0.5, norm * 0.5, squarings + 1);
    }
    let mut sum = SMatrix::identity();
    for term in (1..=18).rev() {
        sum = SMatrix::identity() + scaled * sum / f64::from(term);
    }
    (0..squarings).fold(sum, |power, _| power * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x'' = -9 x + u, x(0) = 1: closed forms under a constant u, and under u = sin(2 t).
    #[test]
    fn an_oscillator_follows_its_closed_form_in_one_step() {
        let system = SMatrix::<f64, 3, 3>::new(-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -9.0, 0.0);
        let inputs = SMatrix::<f64, 3, 2>::new(0.0, 0.0, 0.0, 0.0, 1.0, 0.0);
        let start = SVector::from([1.0, 1.0, 0.0]);
        for step in [1e-4, 0.1, 1.0, 7.0] {
            let held = Transition::held(&system, &inputs, step).end(&start, [4.5, 0.0]);
            let exact = [(-step).exp(), 0.5 + 0.5 * (3.0 * step).cos(), -1.5 * (3.0 * step).sin()];
            for (found, exact) in held.iter().zip(exact) {
                assert!((found - exact).abs() < 1e-13, "{step}: {found} {exact}");
            }
            let driven = Transition::oscillating(&system, &inputs, 2.0, step).end(&start, [0.0, 1.0]);
            let exact = (3.0 * step).cos() + 0.2 * (2.0 * step).sin() - 2.0 / 15.0 * (3.0 * step).sin();
            assert!((driven[1] - exact).abs() < 1e-13, "{step}: {} {exact}", driven[1]);
        }
    }
}

//! Arrays: a linear system with matrices as parameters and vectors as input and output.

use fmi_component::{CoSimulation, Component, Result, Step};

/// Fixed step of the explicit Euler method \[s\].
const TIME_STEP: f64 = 1e-3;
const N: usize = 3;
const UNIT_MATRIX: [[f64; N]; N] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Linear system with constant coefficients: dx/dt = A x + B u, y = C x + D u.
#[derive(Component)]
#[component(stop_time = 10.0, step_size = 1.0)]
#[allow(non_snake_case)] // matrices have capital letters
pub struct StateSpace {
    /// Matrix coefficient A.
    #[parameter(start = UNIT_MATRIX, tunable)]
    A: [[f64; N]; N],
    /// Matrix coefficient B.
    #[parameter(start = UNIT_MATRIX, tunable)]
    B: [[f64; N]; N],
    /// Matrix coefficient C.
    #[parameter(start = UNIT_MATRIX, tunable)]
    C: [[f64; N]; N],
    /// Matrix coefficient D.
    #[parameter(start = UNIT_MATRIX, tunable)]
    D: [[f64; N]; N],
    /// Initial state vector.
    #[parameter(start = [0, 0, 0])]
    x0: [f64; N],
    /// Input vector.
    #[input(start = [1, 2, 3])]
    u: [f64; N],
    /// Output vector.
    #[output]
    y: [f64; N],
    /// State vector.
    #[output]
    x: [f64; N],
}

/// Row `row` of P a + Q b.
fn row(row: usize, (p, a): (&[[f64; N]; N], &[f64; N]), (q, b): (&[[f64; N]; N], &[f64; N])) -> f64 {
    (0..N)
        .map(|column| p[row][column] * a[column] + q[row][column] * b[column])
        .sum()
}

impl CoSimulation for StateSpace {
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        self.x = self.x0;
        self.y = std::array::from_fn(|index| row(index, (&self.C, &self.x), (&self.D, &self.u)));
        Ok(())
    }

    fn do_step(&mut self, step: &mut Step) -> Result<()> {
        for _ in step.grid(TIME_STEP)? {
            let rate: [f64; N] = std::array::from_fn(|index| row(index, (&self.A, &self.x), (&self.B, &self.u)));
            self.x = std::array::from_fn(|index| self.x[index] + TIME_STEP * rate[index]);
        }
        self.y = std::array::from_fn(|index| row(index, (&self.C, &self.x), (&self.D, &self.u)));
        Ok(())
    }
}

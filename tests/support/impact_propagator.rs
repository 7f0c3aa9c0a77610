//! Impact of two bodies by the equations of P 4.2 and 4.5, integrated by exponentials of the equations' matrices.
//!
//! Nothing is taken from the closed forms of the library: the matrix exponential is summed as a Taylor series, phases are
//! scanned step by step, also for dips inside a step, and their ends are found by halving the step fifty times.
//! Units: time in sqrt(m_eff / k_n), velocities in |u_n|.

type State = [f64; 4]; // overlap x, its rate v, surface velocity u, stretch z
type Matrix = [[f64; 4]; 4];
type Functional = [f64; 4];

/// Material of an impact without dimension; `mobility` is m_eff / alpha.
#[derive(Debug, Clone, Copy)]
pub struct Material {
    pub damping_ratio: f64,
    pub stiffness_ratio: f64,
    pub friction: f64,
    pub mobility: f64,
}

/// Propagators of one phase over a step, half of it, a quarter and so on, and what must stay positive in it.
struct LinearPhase {
    matrix: Matrix,
    propagators: Vec<Matrix>,
    margins: Vec<Functional>,
}

/// All that one material needs, prepared once.
pub struct Propagator {
    material: Material,
    stick: LinearPhase,
    slip: [LinearPhase; 2],
}

const STEPS_A_CONTACT: f64 = 1024.0;
const HALVINGS: usize = 50;
/// Dips shallower than this are rounding.
const DIP: f64 = -1e-13;

fn times(matrix: &Matrix, state: &State) -> State {
    std::array::from_fn(|row| (0..4).map(|column| matrix[row][column] * state[column]).sum())
}

fn dot(functional: &Functional, state: &State) -> f64 {
    (0..4).map(|i| functional[i] * state[i]).sum()
}

fn exponential(matrix: &Matrix, time: f64) -> Matrix {
    let mut sum: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let mut term = sum;
    for order in 1..=30 {
        term = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                (0..4).map(|k| term[row][k] * matrix[k][column]).sum::<f64>() * time / f64::from(order)
            })
        });
        for row in 0..4 {
            for column in 0..4 {
                sum[row][column] += term[row][column];
            }
        }
    }
    sum
}

impl LinearPhase {
    fn new(matrix: Matrix, margins: Vec<Functional>, step: f64) -> Self {
        let propagators = (0..=HALVINGS)
            .map(|k| exponential(&matrix, step * 0.5_f64.powi(k as i32)))
            .collect();
        Self {
            matrix,
            propagators,
            margins,
        }
    }

    /// Rate of margin number `which`: the functional times the matrix.
    fn rate(&self, which: usize, state: &State) -> f64 {
        dot(&self.margins[which], &times(&self.matrix, state))
    }

    /// Last state of the coming step at which `goes_on` still holds, and the state just after it.
    fn descend(&self, mut state: State, goes_on: impl Fn(&State) -> bool) -> (State, State) {
        for propagator in &self.propagators[1..] {
            let next = times(propagator, &state);
            if goes_on(&next) {
                state = next;
            }
        }
        (state, times(&self.propagators[HALVINGS], &state))
    }

    /// Runs until a margin is used up: the state there and the number of the margin.
    fn run(&self, mut state: State) -> (State, usize) {
        let positive = |state: &State| self.margins.iter().all(|margin| dot(margin, state) > 0.0);
        for _ in 0..10 * STEPS_A_CONTACT as usize {
            let next = times(&self.propagators[0], &state);
            for which in 0..self.margins.len() {
                let value = |state: &State| dot(&self.margins[which], state);
                let falls = |state: &State| self.rate(which, state) < 0.0;
                if positive(&next) && falls(&state) && !falls(&next) {
                    let (low, _) = self.descend(state, falls);
                    if value(&low) < DIP {
                        return (self.descend(state, |state| value(state) > 0.0 && falls(state)).1, which);
                    }
                }
            }
            if !positive(&next) {
                let (_, after) = self.descend(state, positive);
                let least = (0..self.margins.len())
                    .min_by(|a, b| dot(&self.margins[*a], &after).total_cmp(&dot(&self.margins[*b], &after)));
                return (after, least.unwrap());
            }
            state = next;
        }
        panic!("no end of phase");
    }
}

impl Propagator {
    pub fn new(material: Material) -> Self {
        let Material {
            damping_ratio: c,
            stiffness_ratio: kappa,
            friction: mu,
            mobility: rho,
        } = material;
        let step = std::f64::consts::PI / STEPS_A_CONTACT;
        let (overlap, rate) = ([0.0, 1.0, 0.0, 0.0], [-1.0, -2.0 * c, 0.0, 0.0]);
        let force: Functional = [1.0, 2.0 * c, 0.0, 0.0];
        let force_rate: Functional = std::array::from_fn(|i| overlap[i] + 2.0 * c * rate[i]);
        let stick = LinearPhase::new(
            [overlap, rate, [0.0, 0.0, 0.0, -rho * kappa], [0.0, 0.0, 1.0, 0.0]],
            [1.0, -1.0]
                .map(|sense| [mu * force[0], mu * force[1], 0.0, -sense * kappa])
                .to_vec(),
            step,
        );
        let slip = [1.0, -1.0].map(|sense| {
            LinearPhase::new(
                [
                    overlap,
                    rate,
                    force.map(|f| -sense * rho * mu * f),
                    force_rate.map(|f| sense * mu / kappa * f),
                ],
                vec![force, [-mu * force_rate[0], -mu * force_rate[1], sense * kappa, 0.0]],
                step,
            )
        });
        Self { material, stick, slip }
    }

    /// Velocities (u_n', u_t') / |u_n| after an impact at `ratio` = |u_t / u_n|.
    pub fn velocities_after(&self, ratio: f64) -> (f64, f64) {
        let Material {
            damping_ratio,
            stiffness_ratio,
            friction,
            ..
        } = self.material;
        let mut state = [0.0, 1.0, ratio, 0.0];
        let mut slipping = (damping_ratio == 0.0 && stiffness_ratio * ratio > friction).then_some(0);
        for _ in 0..10_000 {
            match slipping {
                None => {
                    let (after, side) = self.stick.run(state);
                    state = after;
                    slipping = Some(side);
                }
                Some(side) => {
                    let (after, margin) = self.slip[side].run(state);
                    state = after;
                    if margin == 0 {
                        return (-state[1], state[2]);
                    }
                    slipping = None;
                    // At the switch the margin of stick is at a double root: step off it before reading its sign.
                    state = times(&self.stick.propagators[20], &state);
                }
            }
        }
        panic!(
            "no end of impact: {:?} ratio {ratio} at {state:?} {slipping:?}",
            self.material
        );
    }

    /// e_n by steps so long that their rounding does not add up.
    pub fn normal_restitution(damping_ratio: f64) -> f64 {
        let c = damping_ratio;
        let matrix = [[0.0, 1.0, 0.0, 0.0], [-1.0, -2.0 * c, 0.0, 0.0], [0.0; 4], [0.0; 4]];
        let phase = LinearPhase::new(matrix, vec![[1.0, 2.0 * c, 0.0, 0.0]], 0.125);
        -phase.run([0.0, 1.0, 0.0, 0.0]).0[1]
    }
}

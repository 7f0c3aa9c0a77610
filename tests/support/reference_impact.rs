//! Impact of a disk on a wall at rest by the equations of P 4.2 to 4.6, integrated apart from the engine: classical
//! Runge-Kutta on each smooth phase, phases ended by bisection at the instant of the switch.

use jostle::engine::dem::ContactLaws;

/// One impact: material, and the velocities at touch.
#[derive(Debug, Clone, Copy)]
pub struct Impact {
    pub mass: f64,
    pub normal_stiffness: f64,
    pub normal_damping: f64,
    pub tangential_stiffness: f64,
    pub friction: f64,
    /// u_n < 0 at touch.
    pub normal_velocity: f64,
    /// u_t at touch.
    pub tangential_velocity: f64,
}

/// Overlap, its rate, surface velocity, stretch of the tangential spring.
type ImpactState = [f64; 4];

impl Impact {
    /// A disk that touches with this velocity (x, y, angular) of its centre.
    pub fn of_disk(laws: &ContactLaws, mass: f64, radius: f64, velocity: [f64; 3]) -> Self {
        Self {
            mass,
            normal_stiffness: laws.normal.stiffness,
            normal_damping: laws.normal.damping,
            tangential_stiffness: laws.tangential.stiffness,
            friction: laws.tangential.friction,
            normal_velocity: velocity[1],
            tangential_velocity: velocity[0] + radius * velocity[2],
        }
    }

    fn force(&self, [overlap, rate, ..]: ImpactState) -> f64 {
        self.normal_stiffness * overlap + self.normal_damping * rate
    }

    /// Rate of the normal force.
    fn force_rate(&self, phase: ImpactState) -> f64 {
        self.normal_stiffness * phase[1] - self.normal_damping * self.force(phase) / self.mass
    }

    fn derivative(&self, phase: ImpactState, slip: Option<f64>) -> ImpactState {
        let [_, rate, velocity, stretch] = phase;
        let normal = self.force(phase);
        let pull = match slip {
            Some(sense) => sense * self.friction * normal,
            None => self.tangential_stiffness * stretch,
        };
        let stretch_rate = match slip {
            Some(sense) => sense * self.friction * self.force_rate(phase) / self.tangential_stiffness,
            None => velocity,
        };
        // A uniform disk: the surface is moved by F (1/m + R^2/I) = 3 F / m (P 4.60).
        [rate, -normal / self.mass, -3.0 * pull / self.mass, stretch_rate]
    }

    fn advance(&self, phase: ImpactState, slip: Option<f64>, step: f64) -> ImpactState {
        let add = |a: ImpactState, b: ImpactState, h: f64| std::array::from_fn(|i| a[i] + h * b[i]);
        let k1 = self.derivative(phase, slip);
        let k2 = self.derivative(add(phase, k1, 0.5 * step), slip);
        let k3 = self.derivative(add(phase, k2, 0.5 * step), slip);
        let k4 = self.derivative(add(phase, k3, step), slip);
        std::array::from_fn(|i| phase[i] + step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
    }

    /// Positive while the present phase goes on: the contact presses, and the tangential spring sticks or slips as it does.
    fn margins(&self, phase: ImpactState, slip: Option<f64>) -> [f64; 2] {
        let limit = self.friction * self.force(phase);
        let keeps = match slip {
            None => limit - self.tangential_stiffness * phase[3].abs(),
            Some(sense) => sense * phase[2] * self.tangential_stiffness - self.friction * self.force_rate(phase),
        };
        [self.force(phase), keeps]
    }

    /// Velocities (u_n', u_t') after the impact, with `steps` steps a contact time.
    pub fn velocities_after(&self, steps: u32) -> (f64, f64) {
        let duration = std::f64::consts::PI * (self.mass / self.normal_stiffness).sqrt();
        let step = duration / f64::from(steps);
        let mut phase = [0.0, -self.normal_velocity, self.tangential_velocity, 0.0];
        // Without damping the force starts from zero, and so may the slip (P 4.76).
        let starts_slipping = self.normal_damping == 0.0
            && self.tangential_stiffness * phase[2].abs() > self.friction * self.force_rate(phase);
        let mut slip = starts_slipping.then(|| phase[2].signum());
        let mut first = true;
        loop {
            let next = self.advance(phase, slip, step);
            let holds = |state: ImpactState| self.margins(state, slip).iter().all(|margin| *margin > 0.0);
            if holds(next) || first {
                (phase, first) = (next, false);
                continue;
            }
            let (mut low, mut high) = (0.0, step);
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if holds(self.advance(phase, slip, middle)) {
                    low = middle
                } else {
                    high = middle
                }
            }
            phase = self.advance(phase, slip, high);
            if self.force(phase) <= 1e-12 * self.normal_stiffness * duration * self.normal_velocity.abs() {
                return (phase[1], phase[2]);
            }
            slip = if slip.is_some() { None } else { Some(phase[3].signum()) };
            first = true;
        }
    }
}

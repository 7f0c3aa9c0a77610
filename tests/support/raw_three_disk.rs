//! The disk on two supports straight from the printed equations, by brute force: centres, distances, `atan2`, tiny steps.
//!
//! P 4.1 to 4.12, 4.23, 4.24 with ERRATA's signs and arms. Classical Runge-Kutta steps; Coulomb's limit and the cut-off of
//! the normal force act inside each evaluation, lambda* moves at the end of a step and is dated back to the touch. Errors fall
//! at events with the square of the step where forces are continuous there, with its first power where they jump.

/// The system.
#[derive(Clone, Copy)]
pub struct Raw {
    pub radius: f64,
    pub mass: f64,
    pub gravity: f64,
    pub normal_stiffness: f64,
    pub tangential_stiffness: f64,
    pub damping: f64,
    pub friction: f64,
    /// theta_0 and theta_T.
    pub opening: f64,
    pub tilt: f64,
    pub walls: bool,
    /// Torque `constant + amplitude sin(omega t)`.
    pub torque: [f64; 3],
    /// Both supports move up by `amplitude sin(omega t)`.
    pub shaking: [f64; 2],
}

/// x, y, theta and their rates, x and y of the centre from where it just touches both supports.
pub type Motion = [f64; 6];

/// A run's end.
#[derive(Clone, Copy, Debug)]
pub struct End {
    pub motion: Motion,
    /// First time that a normal force vanished.
    pub opened: Option<f64>,
}

/// One contact: overlap, its rate, lambda, unit normal, distance of the centres over the sum of the radii.
struct Touch {
    overlap: f64,
    rate: f64,
    lambda: f64,
    normal: [f64; 2],
    ratio: f64,
}

/// A contact at the end of the step before.
#[derive(Clone, Copy)]
struct Before {
    overlap: f64,
    lambda: f64,
    closed: bool,
}

impl Raw {
    fn touch(&self, index: usize, time: f64, motion: &Motion) -> Touch {
        let [x, y, theta, vx, vy, _] = *motion;
        let [amplitude, omega] = self.shaking;
        let (lift, lift_rate) = (
            amplitude * (omega * time).sin(),
            amplitude * omega * (omega * time).cos(),
        );
        let alpha = [self.opening - self.tilt, self.opening + self.tilt][index];
        let side = [1.0, -1.0][index];
        let rest = [side * alpha.sin(), alpha.cos()];
        if self.walls {
            // The wall passes through the rest position of the contact point; d along (cos, -+ sin).
            let tangent = [rest[1], -rest[0]];
            let off = [x, y - lift];
            let speed = [vx, vy - lift_rate];
            Touch {
                overlap: -(off[0] * rest[0] + off[1] * rest[1]),
                rate: -(speed[0] * rest[0] + speed[1] * rest[1]),
                lambda: self.radius * theta + off[0] * tangent[0] + off[1] * tangent[1],
                normal: rest,
                ratio: 1.0,
            }
        } else {
            let radius_sum = 2.0 * self.radius;
            let from = [radius_sum * rest[0] + x, radius_sum * rest[1] + y - lift];
            let distance = from[0].hypot(from[1]);
            let normal = [from[0] / distance, from[1] / distance];
            let beta = from[1].atan2(from[0]) - rest[1].atan2(rest[0]);
            Touch {
                overlap: radius_sum - distance,
                rate: -(vx * normal[0] + (vy - lift_rate) * normal[1]),
                lambda: self.radius * theta - radius_sum * beta,
                normal,
                ratio: distance / radius_sum,
            }
        }
    }

    /// Normal force and limited stretch.
    fn law(&self, touch: &Touch, unstretched: f64) -> (f64, f64) {
        if touch.overlap <= 0.0 {
            return (0.0, 0.0);
        }
        let normal = (self.normal_stiffness * touch.overlap + self.damping * touch.rate).max(0.0);
        let limit = self.friction * normal / self.tangential_stiffness;
        (normal, (touch.lambda - unstretched).clamp(-limit, limit))
    }

    fn rates(&self, time: f64, motion: &Motion, unstretched: &[f64; 2]) -> Motion {
        let [constant, amplitude, omega] = self.torque;
        let (mut fx, mut fy) = (0.0, -self.mass * self.gravity);
        let mut torque = constant + amplitude * (omega * time).sin();
        for (index, &unstretched) in unstretched.iter().enumerate() {
            let touch = self.touch(index, time, motion);
            let (normal, stretch) = self.law(&touch, unstretched);
            let tau = -self.tangential_stiffness * stretch;
            let tangent = [touch.normal[1], -touch.normal[0]];
            fx += normal * touch.normal[0] + tau / touch.ratio * tangent[0];
            fy += normal * touch.normal[1] + tau / touch.ratio * tangent[1];
            torque += self.radius * tau;
        }
        let inertia = 0.5 * self.mass * self.radius * self.radius;
        [
            motion[3],
            motion[4],
            motion[5],
            fx / self.mass,
            fy / self.mass,
            torque / inertia,
        ]
    }

    /// From `start`, the tangential springs not stretched there, in `steps` steps to `duration`.
    pub fn run(&self, start: Motion, duration: f64, steps: u64) -> End {
        let h = duration / steps as f64;
        let mut motion = start;
        let mut unstretched = [0, 1].map(|index| self.touch(index, 0.0, &motion).lambda);
        let mut before = [0, 1].map(|index| {
            let touch = self.touch(index, 0.0, &motion);
            Before {
                overlap: touch.overlap,
                lambda: touch.lambda,
                closed: false,
            }
        });
        let mut opened = None;
        let add =
            |from: &Motion, rates: &Motion, h: f64| -> Motion { std::array::from_fn(|row| from[row] + h * rates[row]) };
        for step in 0..steps {
            let time = step as f64 * h;
            let k1 = self.rates(time, &motion, &unstretched);
            let k2 = self.rates(time + 0.5 * h, &add(&motion, &k1, 0.5 * h), &unstretched);
            let k3 = self.rates(time + 0.5 * h, &add(&motion, &k2, 0.5 * h), &unstretched);
            let k4 = self.rates(time + h, &add(&motion, &k3, h), &unstretched);
            motion = std::array::from_fn(|row| motion[row] + h / 6.0 * (k1[row] + 2.0 * (k2[row] + k3[row]) + k4[row]));
            for index in 0..2 {
                let touch = self.touch(index, time + h, &motion);
                if touch.overlap > 0.0 && before[index].overlap <= 0.0 {
                    // lambda* is lambda at touch, dated back inside the step.
                    let share = touch.overlap / (touch.overlap - before[index].overlap);
                    unstretched[index] = touch.lambda - share * (touch.lambda - before[index].lambda);
                }
                let (normal, stretch) = self.law(&touch, unstretched[index]);
                unstretched[index] = touch.lambda - stretch;
                if before[index].closed && normal == 0.0 && opened.is_none() {
                    opened = Some(time + h);
                }
                before[index] = Before {
                    overlap: touch.overlap,
                    lambda: touch.lambda,
                    closed: normal > 0.0,
                };
            }
        }
        End { motion, opened }
    }
}

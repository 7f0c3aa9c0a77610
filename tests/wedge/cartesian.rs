//! A disk in a wedge in Cartesian coordinates, with walls by their angles.

use std::f64::consts::PI;

use jostle::collision::Dashpot;

use super::{GRAVITY, RADIUS};

/// A disk in flight, without the frames of the library: Cartesian, in the laboratory, walls as P 6.4, 6.5.
#[derive(Debug, Clone, Copy)]
pub struct Plain {
    pub time: f64,
    pub position: [f64; 2],
    pub velocity: [f64; 2],
    pub angular_velocity: f64,
    pub angle: f64,
}

impl Plain {
    /// The start of `DiskInWedge::new`, relative to the vertex of the shifted wedge.
    pub fn new(tilt: f64, height: f64, sideways: f64) -> Self {
        Self {
            time: 0.0,
            position: [-height * tilt.sin(), height * tilt.cos()],
            velocity: [sideways * tilt.cos(), sideways * tilt.sin()],
            angular_velocity: 0.0,
            angle: 0.0,
        }
    }

    pub fn at(&self, delay: f64) -> Self {
        let [[x, y], [vx, vy]] = [self.position, self.velocity];
        Self {
            time: self.time + delay,
            position: [x + vx * delay, y + vy * delay - 0.5 * GRAVITY * delay * delay],
            velocity: [vx, vy - GRAVITY * delay],
            angle: self.angle + self.angular_velocity * delay,
            ..*self
        }
    }

    /// P 2.11, 2.23, 2.24 at a wall of this angle that moves up at `base`.
    pub fn bounce(&mut self, angle: f64, base: f64, law: &Dashpot) {
        let (sine, cosine) = angle.sin_cos();
        let [vx, vy] = self.velocity;
        let (normal, tangential) = (-sine * vx + cosine * vy, cosine * vx + sine * vy);
        let un = normal - base * cosine;
        let ut = tangential + RADIUS * self.angular_velocity - base * sine;
        let et = law.tangential_restitution(1.0, 1.0 / 3.0, (ut / un).abs());
        let normal = normal - (1.0 + law.normal_restitution(1.0)) * un;
        let tangential = tangential - (1.0 - et) / 3.0 * ut;
        self.angular_velocity -= 2.0 * (1.0 - et) / (3.0 * RADIUS) * ut;
        self.velocity = [
            -sine * normal + cosine * tangential,
            cosine * normal + sine * tangential,
        ];
    }
}

pub fn wall_angles(aperture: f64, tilt: f64) -> [f64; 2] {
    let critical = 0.5 * (PI - aperture);
    [tilt - critical, tilt + critical]
}

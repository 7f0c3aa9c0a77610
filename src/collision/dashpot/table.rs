//! Tangential restitution from a table: one column of cubics for each class of impacts with equal effective mass.
//!
//! The table runs over `y = r_0 / (r + r_0)`, `r = |u_t / u_n|`, `r_0 = max(mu/kappa, rho mu (1 + e_n))`, so that its ends
//! are r = infinity and r = 0 and there is nothing beyond. It holds `psi(y) = (1 - e_t)(r + r_0) / r_0`, which is finite
//! at both ends and goes to `rho mu (1 + e_n) / r_0` where sliding is full. Where the sequence of stick and slip
//! changes, psi has a kink: kinks are found by bisection and become ends of pieces. Between them pieces are halved
//! until the cubic through four points fits.

use super::super::{CollisionLaw, Impact, Impulse};
use super::{Dashpot, StickSlip};

/// Dashpot restitution from tables, one for each effective mass that was announced.
///
/// `e_t` is within 1e-6 of [`Dashpot`] at every ratio, and `|J_t| <= mu J_n` holds exactly. An impact of an effective
/// mass that was not announced is followed phase by phase, so that the result never depends on what was announced by more
/// than that.
#[derive(Debug, Clone, PartialEq)]
pub struct TabulatedDashpot {
    law: Dashpot,
    /// Every announced mass has its table.
    complete: bool,
    /// Impacts followed to make the tables.
    samples: usize,
    classes: Vec<Class>,
    /// Open addressing by the bits of the effective mass; `u32::MAX` where free. A power of two long.
    slots: Vec<u32>,
}

/// What a class of impacts has in common.
#[derive(Debug, Clone, PartialEq)]
struct Class {
    effective_mass: f64,
    restitution: f64,
    /// r_0.
    ratio_scale: f64,
    pieces: Vec<Piece>,
    /// First piece in each of equally wide cells of y.
    guide: [u32; CELLS],
}

/// One cubic in `(y - start) * inverse_width`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    end: f64,
    start: f64,
    inverse_width: f64,
    coefficients: [f64; 4],
}

const CELLS: usize = 256;
/// Misfit of psi at which a piece is good; the stated bound on e_t is five times it.
const TOLERANCE: f64 = 2e-7;
/// Pieces narrower than this are kept as they are.
const NARROWEST: f64 = 1e-9;
/// Impacts followed for a table before it is given up: stiff springs have thousands of kinks.
const MOST_SAMPLES: usize = 20_000;
/// Where the misfit is checked; the cubic passes through 0, 1/4, 3/4, 1.
const PROBES: [f64; 4] = [0.07, 0.5, 0.62, 0.93];

/// psi at one y, and the sequence of phases there.
#[derive(Clone, Copy)]
struct Sample {
    y: f64,
    psi: f64,
    sequence: u64,
}

impl TabulatedDashpot {
    /// Tabulates `law` for these effective masses \[kg\] (`collision::effective_mass`, equal bits) and the inertia factor
    /// l of the bodies, 1/2 for disks: rho = 1 + 1/l whatever the masses.
    ///
    /// Takes some milliseconds and ten kilobytes for each different mass. A spring so stiff that its table would have no
    /// end is not tabulated: each impact is followed phase by phase.
    pub fn new(law: Dashpot, effective_masses: &[f64], inertia_factor: f64) -> Self {
        let mut masses = effective_masses.to_vec();
        masses.sort_by(f64::total_cmp);
        masses.dedup();
        let mobility = 1.0 + 1.0 / inertia_factor;
        let (mut classes, mut samples) = (Vec::new(), 0);
        for mass in masses.iter().rev() {
            // Damping adds switches. Where the table of a mass has no end, those of lighter ones hardly have one, and to
            // try each of them would take a second a mass; without a table each impact is followed.
            let Some(class) = Class::new(&law, *mass, mobility, &mut samples) else {
                break;
            };
            classes.push(class);
        }
        let mut slots = vec![u32::MAX; (4 * classes.len()).next_power_of_two().max(4)];
        for (number, class) in (0_u32..).zip(&classes) {
            let mut slot = slot_of(class.effective_mass, slots.len());
            while slots[slot] != u32::MAX {
                slot = (slot + 1) & (slots.len() - 1);
            }
            slots[slot] = number;
        }
        let complete = !masses.is_empty() && classes.len() == masses.len();
        Self {
            law,
            complete,
            samples,
            classes,
            slots,
        }
    }

    /// The law that is tabulated.
    pub fn law(&self) -> &Dashpot {
        &self.law
    }

    /// Number of cubics held: 48 bytes each.
    pub fn pieces(&self) -> usize {
        self.classes.iter().map(|class| class.pieces.len()).sum()
    }

    /// Number of impacts that were followed to make the tables: what they cost.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// Tangential restitution e_t at `ratio` = |u_t / u_n| for an announced effective mass \[kg\].
    pub fn tangential_restitution(&self, effective_mass: f64, ratio: f64) -> Option<f64> {
        self.class(effective_mass).map(|class| {
            let y = class.ratio_scale / (ratio + class.ratio_scale);
            1.0 - class.psi(y) * y
        })
    }

    #[inline]
    fn class(&self, effective_mass: f64) -> Option<&Class> {
        let mut slot = slot_of(effective_mass, self.slots.len());
        loop {
            let class = self.classes.get(self.slots[slot] as usize)?;
            if class.effective_mass == effective_mass {
                return Some(class);
            }
            slot = (slot + 1) & (self.slots.len() - 1);
        }
    }
}

/// First slot to try: a hash of the mantissa's upper bits.
#[inline]
fn slot_of(mass: f64, slots: usize) -> usize {
    (mass.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 32) as usize & (slots - 1)
}

impl CollisionLaw for TabulatedDashpot {
    const ROTATES: bool = true;

    #[inline]
    fn separation_velocity(&self, impact: &Impact) -> f64 {
        match self.class(impact.effective_mass) {
            Some(class) => class.restitution * impact.normal_velocity.abs(),
            None => self.law.separation_velocity(impact),
        }
    }

    #[inline]
    fn tangential_impulse(&self, impact: &Impact, normal_impulse: f64) -> f64 {
        match self.class(impact.effective_mass) {
            Some(class) => class.tangential_impulse(impact, normal_impulse, self.law.friction),
            None => self.law.tangential_impulse(impact, normal_impulse),
        }
    }

    fn most_work(&self) -> u64 {
        if self.complete { 1 } else { self.law.most_work() }
    }

    #[inline]
    fn impulse(&self, impact: &Impact) -> Impulse {
        match self.class(impact.effective_mass) {
            Some(class) => {
                let normal = impact.normal_impulse(class.restitution * impact.normal_velocity.abs());
                Impulse {
                    normal,
                    tangential: class.tangential_impulse(impact, normal, self.law.friction),
                }
            }
            None => self.law.impulse(impact),
        }
    }
}

impl Class {
    /// None if the table would have no end.
    fn new(law: &Dashpot, effective_mass: f64, mobility: f64, samples: &mut usize) -> Option<Self> {
        let mut class = Self {
            effective_mass,
            restitution: law.normal_restitution(effective_mass),
            ratio_scale: 1.0,
            pieces: Vec::new(),
            guide: [0; CELLS],
        };
        if law.slides_freely() {
            class.pieces.push(Piece {
                end: 1.0,
                start: 0.0,
                inverse_width: 1.0,
                coefficients: [0.0; 4],
            });
            return Some(class);
        }
        let stick_slip = law.stick_slip(effective_mass, mobility);
        class.ratio_scale = stick_slip.full_slide().max(law.friction / law.stiffness_ratio);
        let (fits, followed) = class.fit(&stick_slip);
        *samples += followed;
        if !fits {
            return None;
        }
        let mut piece = 0;
        for (cell, first) in class.guide.iter_mut().enumerate() {
            while class.pieces[piece].end <= cell as f64 / CELLS as f64 {
                piece += 1;
            }
            *first = piece as u32;
        }
        Some(class)
    }

    /// Covers [0, 1] with pieces, from left to right; false if that takes too many. And how many impacts were followed.
    fn fit(&mut self, stick_slip: &StickSlip) -> (bool, usize) {
        let scale = self.ratio_scale;
        let samples = std::cell::Cell::new(0);
        let sample = |y: f64| {
            samples.set(samples.get() + 1);
            // The ends stand for ratios so large or small that nothing changes any more.
            let ratio = (scale * (1.0 - y) / y).clamp(1e-8 * scale, 1e8 * scale);
            let outcome = stick_slip.after(ratio);
            let psi = (ratio - outcome.velocity) / ratio * (ratio + scale) / scale;
            Sample {
                y,
                psi,
                sequence: outcome.sequence,
            }
        };
        let mut waiting = vec![(sample(0.0), sample(1.0))];
        while let Some((left, right)) = waiting.pop() {
            if samples.get() > MOST_SAMPLES {
                return (false, samples.get());
            }
            let width = right.y - left.y;
            if width > NARROWEST && left.sequence != right.sequence {
                let (mut low, mut high) = (left, right);
                while high.y - low.y > 1e-13 {
                    let middle = sample(0.5 * (low.y + high.y));
                    if middle.sequence == left.sequence {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                if high.y < right.y {
                    waiting.push((high, right));
                }
                // The left piece carries its own side of the kink to where the right one begins.
                waiting.push((left, Sample { y: high.y, ..low }));
                continue;
            }
            let at = |part: f64| sample(left.y + part * width).psi;
            let piece = Piece::through(left, right, [at(0.25), at(0.75)]);
            let misfit = |part: f64| (at(part) - piece.at(left.y + part * width)).abs();
            if width <= NARROWEST || PROBES.iter().all(|part| misfit(*part) < TOLERANCE) {
                self.pieces.push(piece);
            } else {
                let middle = sample(left.y + 0.5 * width);
                waiting.push((middle, right));
                waiting.push((left, middle));
            }
        }
        (true, samples.get())
    }

    #[inline]
    fn psi(&self, y: f64) -> f64 {
        let mut piece = self.guide[((y * CELLS as f64) as usize).min(CELLS - 1)] as usize;
        while self.pieces[piece].end < y && piece + 1 < self.pieces.len() {
            piece += 1;
        }
        self.pieces[piece].at(y)
    }

    #[inline]
    fn tangential_impulse(&self, impact: &Impact, normal_impulse: f64, friction: f64) -> f64 {
        let tangential = impact.tangential_velocity.abs();
        if tangential == 0.0 {
            return 0.0;
        }
        let scaled = self.ratio_scale * normal_impulse / (impact.effective_mass * (1.0 + self.restitution));
        let y = scaled / (tangential + scaled);
        let limit = friction * normal_impulse;
        let braking = (impact.tangential_mass * tangential * y * self.psi(y)).clamp(-limit, limit);
        -braking * impact.tangential_velocity.signum()
    }
}

impl Piece {
    /// Cubic through its ends and two values at 1/4 and 3/4.
    fn through(left: Sample, right: Sample, inner: [f64; 2]) -> Self {
        let (a, b, c, d) = (left.psi, inner[0], inner[1], right.psi);
        // Lagrange at 0, 1/4, 3/4, 1, collected by powers.
        let coefficients = [
            a,
            (-19.0 * a + 24.0 * b - 8.0 * c + 3.0 * d) / 3.0,
            (32.0 * a - 56.0 * b + 40.0 * c - 16.0 * d) / 3.0,
            (-16.0 * a + 32.0 * b - 32.0 * c + 16.0 * d) / 3.0,
        ];
        Self {
            end: right.y,
            start: left.y,
            inverse_width: 1.0 / (right.y - left.y),
            coefficients,
        }
    }

    #[inline]
    fn at(&self, y: f64) -> f64 {
        let [c0, c1, c2, c3] = self.coefficients;
        let u = (y - self.start) * self.inverse_width;
        c0 + u * (c1 + u * (c2 + u * c3))
    }
}

//! Two contacts side by side, each in its own frame: overlaps and velocities in, forces out.
//!
//! Two, because every x86-64 adds and multiplies two numbers in one instruction; each has the bits that it would have
//! alone. Nothing branches on whether a contact is closed, but for the instants at which it closes or opens: candidates
//! are few that do not touch. Not here: who touches whom and what a contact looks like in space (`forces`).

use wide::f64x2;

use super::contacts::{SMALL_SINE, SkinMemory};
use super::forces::{ContactLaws, Tally};

/// One number of each of two contacts.
pub type Two = f64x2;

/// Both numbers, by a function of the place, 0 or 1.
#[inline(always)]
pub fn two(of: impl Fn(usize) -> f64) -> Two {
    Two::new([of(0), of(1)])
}

/// The first two of three numbers: x and y of a place or a rate, in one fetch.
#[inline(always)]
pub fn vector(of: &[f64; 3]) -> Two {
    Two::new([of[0], of[1]])
}

/// x of both and y of both from two vectors.
#[inline(always)]
pub fn turned([one, other]: [Two; 2]) -> [Two; 2] {
    let ([one_x, one_y], [other_x, other_y]) = (one.to_array(), other.to_array());
    [Two::new([one_x, other_x]), Two::new([one_y, other_y])]
}

/// Two candidates along their normals.
#[derive(Clone, Copy, Default)]
pub struct Approach {
    /// Towards the first body.
    pub normal: [Two; 2],
    /// \[m\], positive while they touch.
    pub overlap: Two,
    /// u_n \[m/s\], negative on approach.
    pub velocity: Two,
}

/// Two candidates along their surfaces.
#[derive(Clone, Copy, Default)]
pub struct Surfaces {
    /// lambda \[m\] with beta counted from zero (P 4.5, 4.7).
    pub way: Two,
    /// Lever of beta in lambda \[m\]: the sum of the radii, and 0 at a wall, whose normal does not turn.
    pub reach: Two,
    /// Force on the centres over that on the surfaces: the sum of the radii over the distance, and 1 at a wall.
    pub lever: Two,
}

/// Tells u_t \[m/s\] of two surfaces. No closure, since one that is called from a rare branch is not inlined, and all that
/// it refers to would be stored for it each time.
pub trait Sliding {
    /// Relative velocity along the surfaces.
    fn velocity(&self) -> Two;
}

/// The contact laws, with what follows from them worked out once an evaluation.
pub struct Laws {
    normal_stiffness: Two,
    damping: Two,
    skin_stiffness: Two,
    half_skin_stiffness: Two,
    /// Largest stretch over normal force, mu / k_t \[m/N\].
    slack: Two,
    step: f64,
}

impl Laws {
    /// For an evaluation at the end of a step of length `step` \[s\].
    pub fn new(laws: &ContactLaws, step: f64) -> Self {
        let ContactLaws { normal, skin } = laws;
        // A skin without stiffness never slips: finite, so that no force times it is no number.
        let slack = (skin.friction / skin.stiffness).min(f64::MAX);
        Self {
            normal_stiffness: Two::splat(normal.stiffness),
            damping: Two::splat(normal.damping),
            skin_stiffness: Two::splat(skin.stiffness),
            half_skin_stiffness: Two::splat(0.5 * skin.stiffness),
            slack: Two::splat(slack),
            step,
        }
    }

    /// Normal forces and tangential forces on the first bodies \[N\], zero for those that do not touch, with the skins'
    /// memory brought up to date. `sliding` is asked at first touch only.
    ///
    /// The formulas are those of [`crate::contact`]. Without SKIN nothing acts along the surfaces, and nothing of them is
    /// read or remembered.
    #[inline(always)]
    pub fn act<const SKIN: bool>(
        &self,
        approach: &Approach,
        surfaces: &Surfaces,
        skins: [&mut SkinMemory; 2],
        sums: &mut Sums,
        sliding: impl Sliding,
    ) -> (Two, Two) {
        let Approach {
            normal,
            overlap,
            velocity,
        } = *approach;
        let zero = Two::splat(0.0);
        let touches = overlap.simd_gt(zero);
        let spring = self.normal_stiffness * overlap;
        let normal_force = (spring - self.damping * velocity).fast_max(zero) & touches;
        let lost = || ((spring - normal_force) & touches) * velocity;
        if !SKIN {
            sums.add(lost(), overlap);
            sums.touching += Two::splat(1.0) & touches;
            return (normal_force, zero);
        }

        let [one, other] = skins;
        let closed = two(|k| [one.direction[0], other.direction[0]][k]).simd_ne(zero)
            | two(|k| [one.direction[1], other.direction[1]][k]).simd_ne(zero);
        if closed.to_bitmask() != touches.to_bitmask() {
            let closing = (surfaces.way, sliding.velocity());
            self.close_or_open(approach, closing, [&mut *one, &mut *other], sums);
        }
        let sine = sine_of_turn(normal, [one, other]);
        let sine = if sine.abs().simd_ge(Two::splat(SMALL_SINE)).any() {
            follow(normal, surfaces.reach, [&mut *one, &mut *other]);
            sine_of_turn(normal, [one, other])
        } else {
            sine
        };
        let square = sine * sine;
        let turn = sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0)));

        let reference = Two::new([one.reference, other.reference]);
        let trial = surfaces.way - surfaces.reach * turn - reference;
        let limit = self.slack * normal_force;
        let stretch = trial.fast_max(zero - limit).fast_min(limit) & touches;
        let slip = trial - stretch;
        // Slip heats by the mean of the forces before and after; both point against the slip.
        let before = Two::new([one.stretch, other.stretch]);
        sums.slip_heat += self.half_skin_stiffness * (stretch + before) * slip;
        sums.add(lost(), overlap);
        let reference = ((reference + slip) & touches).to_array();
        let kept = stretch.to_array();
        (one.reference, other.reference) = (reference[0], reference[1]);
        (one.stretch, other.stretch) = (kept[0], kept[1]);
        (normal_force, zero - self.skin_stiffness * stretch)
    }

    /// A contact that closes inside the step has its lambda* dated back to the instant of touch; one that opens loses
    /// what its skin still held.
    #[cold]
    #[inline(never)]
    fn close_or_open(
        &self,
        approach: &Approach,
        (way, surface_velocity): (Two, Two),
        skins: [&mut SkinMemory; 2],
        sums: &mut Sums,
    ) {
        for (k, skin) in skins.into_iter().enumerate() {
            let at = |two: Two| two.to_array()[k];
            let (overlap, speed) = (at(approach.overlap), -at(approach.velocity));
            match (skin.is_closed(), overlap > 0.0) {
                (false, true) => {
                    sums.closed += 1;
                    // Closed since `overlap / speed` ago, and for no longer than this step.
                    let since = if speed * self.step > overlap {
                        overlap / speed
                    } else {
                        self.step
                    };
                    *skin = SkinMemory {
                        direction: approach.normal.map(at),
                        reference: at(way) - at(surface_velocity) * since,
                        stretch: 0.0,
                    };
                }
                (true, false) => {
                    sums.closed -= 1;
                    sums.lost_skin += at(self.half_skin_stiffness) * skin.stretch * skin.stretch;
                    *skin = SkinMemory::OPEN;
                }
                _ => {}
            }
        }
    }
}

/// Sines of the angles by which the normals are turned from the remembered directions; 0 while open.
#[inline(always)]
fn sine_of_turn(normal: [Two; 2], [one, other]: [&SkinMemory; 2]) -> Two {
    let x = Two::new([one.direction[0], other.direction[0]]);
    let y = Two::new([one.direction[1], other.direction[1]]);
    x * normal[1] - y * normal[0]
}

/// Lets the remembered directions follow normals that have turned far.
#[cold]
#[inline(never)]
fn follow(normal: [Two; 2], reach: Two, skins: [&mut SkinMemory; 2]) {
    for (k, skin) in skins.into_iter().enumerate().filter(|(_, skin)| skin.is_closed()) {
        let at = |two: Two| two.to_array()[k];
        // What is left is below the limit, and computed again by the caller.
        skin.turn(normal.map(at), at(reach));
    }
}

/// Sums over the contacts of one evaluation, by place.
#[derive(Default)]
pub struct Sums {
    dissipated_power: Two,
    slip_heat: Two,
    deepest: Two,
    /// Of those without skins, which do not remember that they are closed.
    touching: Two,
    /// Contacts closed less contacts opened since the last evaluation.
    closed: i64,
    lost_skin: f64,
}

impl Sums {
    #[inline(always)]
    fn add(&mut self, lost: Two, overlap: Two) {
        self.dissipated_power += lost;
        self.deepest = overlap.fast_max(self.deepest);
    }

    /// Both places together; with skins, `closed` contacts were closed before.
    pub fn tally<const SKIN: bool>(&self, closed: u32) -> Tally {
        let [one, other] = self.deepest.to_array();
        Tally {
            dissipated_power: self.dissipated_power.reduce_add(),
            slip_heat: self.slip_heat.reduce_add() + self.lost_skin,
            deepest: one.max(other),
            contacts: if SKIN {
                (i64::from(closed) + self.closed) as u32
            } else {
                self.touching.reduce_add() as u32
            },
        }
    }
}

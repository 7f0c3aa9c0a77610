//! Numbers side by side in SIMD registers: two, four where the processor has AVX2, eight where it has AVX-512.
//!
//! Loops are written once, over registers of so many [`Lanes`], and compiled for each width. Every number has the bits that
//! it would have alone: the operations are those of IEEE 754, none is fused, and sums over lanes are kept in eight parts
//! whatever the width ([`EightSums`]). The crate `fearless_simd` has the instructions; what can be used is asked for once in a process.
//! Not AVX-512 of processors before Ice Lake, which slow down for it: they get four lanes.

use std::sync::atomic::{AtomicUsize, Ordering};

use fearless_simd::{Level, Simd, SimdBase, SimdCombine, SimdFloat, SimdSplit, f64x2, f64x4, f64x8};

/// Lanes of the widest register.
pub const MOST_LANES: usize = 8;

/// A register of numbers.
pub trait Lanes<S: Simd>: SimdFloat<S, Element = f64> {
    /// (x of all, y of all) from vectors (x, y), of which the first go to the lanes.
    fn columns(vectors: &[f64x2<S>]) -> [Self; 2];

    /// The vectors (x, y) of the lanes, into the first of `vectors`.
    fn vectors(columns: [Self; 2], vectors: &mut [[f64; 2]]);
}

impl<S: Simd> Lanes<S> for f64x2<S> {
    #[inline(always)]
    fn columns(vectors: &[Self]) -> [Self; 2] {
        let (one, other) = (vectors[0], vectors[1]);
        [one.zip_low(other), one.zip_high(other)]
    }

    #[inline(always)]
    fn vectors([x, y]: [Self; 2], vectors: &mut [[f64; 2]]) {
        vectors[0] = x.zip_low(y).to_array();
        vectors[1] = x.zip_high(y).to_array();
    }
}

/// Registers of two halves.
macro_rules! lanes_of_halves {
    ($($whole:ident: $half:ident;)*) => {$(
        impl<S: Simd> Lanes<S> for $whole<S> {
            #[inline(always)]
            fn columns(vectors: &[f64x2<S>]) -> [Self; 2] {
                let (low, high) = vectors.split_at(<$half<S>>::LEN);
                let ([low_x, low_y], [high_x, high_y]) = ($half::columns(low), $half::columns(high));
                [low_x.combine(high_x), low_y.combine(high_y)]
            }

            #[inline(always)]
            fn vectors([x, y]: [Self; 2], vectors: &mut [[f64; 2]]) {
                let ((low_x, high_x), (low_y, high_y)) = (x.split(), y.split());
                let (low, high) = vectors.split_at_mut(<$half<S>>::LEN);
                $half::vectors([low_x, low_y], low);
                $half::vectors([high_x, high_y], high);
            }
        }
    )*};
}

lanes_of_halves! {
    f64x4: f64x2;
    f64x8: f64x4;
}

/// x and y out of (x, y, angle), in one fetch.
#[inline(always)]
pub fn xy<S: Simd>(simd: S, of: &[f64; 3]) -> f64x2<S> {
    let [x, y, _] = *of;
    f64x2::load_array(simd, [x, y])
}

/// Eight parts of a sum: numbers in the order of a list go to them in turn, however many lanes are added at once.
#[derive(Debug, Clone, Copy, Default)]
pub struct EightSums([f64; MOST_LANES]);

impl EightSums {
    /// Adds a register to the parts that begin with `first`, a multiple of its length.
    #[inline(always)]
    pub fn add<S: Simd, V: Lanes<S>>(&mut self, first: usize, lanes: V) {
        let parts = &mut self.0[first..first + V::LEN];
        (V::from_slice(lanes.token(), parts) + lanes).store_slice(parts);
    }

    /// Adds other parts, each to its own.
    pub fn add_all(&mut self, other: &Self) {
        self.0.iter_mut().zip(other.0).for_each(|(part, other)| *part += other);
    }

    /// All parts together.
    pub fn total(&self) -> f64 {
        let [a, b, c, d, e, f, g, h] = self.0;
        ((a + b) + (c + d)) + ((e + f) + (g + h))
    }
}

/// The largest lane.
#[inline(always)]
pub fn largest<S: Simd, V: Lanes<S>>(lanes: V) -> f64 {
    lanes.as_slice().iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

/// A loop that is compiled for each width.
pub trait LaneWork {
    /// What comes out, the same bits for each width.
    type Output;

    /// Does it with registers V. Write `#[inline(always)]`, here and at everything in the loop that has registers for arguments
    /// or results, closures too: only so is it compiled for the instructions of its width.
    fn run<S: Simd, V: Lanes<S>>(self, simd: S) -> Self::Output;
}

/// Does the work as wide as this process computes.
#[inline]
pub fn in_lanes<W: LaneWork>(work: W) -> W::Output {
    #[cfg(target_arch = "x86_64")]
    {
        let (level, most) = (Level::new(), most_lanes());
        if let Some(simd) = level.as_avx512().filter(|_| most >= 8) {
            return simd.vectorize(
                #[inline(always)]
                || work.run::<_, f64x8<_>>(simd),
            );
        }
        if let Some(simd) = level.as_avx2().filter(|_| most >= 4) {
            return simd.vectorize(
                #[inline(always)]
                || work.run::<_, f64x4<_>>(simd),
            );
        }
        let Some(simd) = level.as_sse2() else {
            unreachable!("every x86-64 has SSE2");
        };
        simd.vectorize(
            #[inline(always)]
            || work.run::<_, f64x2<_>>(simd),
        )
    }
    // Every other target has one set of instructions, which its compiler knows.
    #[cfg(not(target_arch = "x86_64"))]
    fearless_simd::dispatch!(Level::baseline(), simd => work.run::<_, f64x2<_>>(simd))
}

static ALLOWED: AtomicUsize = AtomicUsize::new(0);

/// Lanes that are used, if the processor has them. Read from the environment once.
#[cfg(target_arch = "x86_64")]
fn most_lanes() -> usize {
    match ALLOWED.load(Ordering::Relaxed) {
        0 => {
            let most = std::env::var("JOSTLE_LANES").map_or(8, |most| match most.as_str() {
                "2" => 2,
                "4" => 4,
                "8" => 8,
                _ => panic!("JOSTLE_LANES is `{most}`: 2, 4 or 8 lanes at most, or not set"),
            });
            limit_lanes(most);
            most
        }
        most => most,
    }
}

/// Lets this process compute with no more than `most` lanes (2, 4 or 8) from now on, for measurements and for tests: the bits are
/// the same. Only x86-64 has a choice.
pub fn limit_lanes(most: usize) {
    ALLOWED.store(most.clamp(2, 8), Ordering::Relaxed);
}

/// Lanes that this process computes with.
pub fn lanes() -> usize {
    struct Width;
    impl LaneWork for Width {
        type Output = usize;
        #[inline(always)]
        fn run<S: Simd, V: Lanes<S>>(self, _simd: S) -> usize {
            V::LEN
        }
    }
    in_lanes(Width)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest sum, the sum in parts, and x and y of vectors that went to registers and back.
    struct Several<'a>(&'a [f64; 64]);

    impl LaneWork for Several<'_> {
        type Output = (f64, f64, Vec<[f64; 2]>);

        #[inline(always)]
        fn run<S: Simd, V: Lanes<S>>(self, simd: S) -> Self::Output {
            let (mut sums, mut most, mut there_and_back) = (EightSums::default(), V::splat(simd, 0.0), Vec::new());
            for (n, numbers) in self.0.chunks_exact(V::LEN).enumerate() {
                let register = V::from_slice(simd, numbers);
                sums.add(n % (MOST_LANES / V::LEN) * V::LEN, register);
                most = register.max(most);
                let mut vectors = [f64x2::splat(simd, 0.0); MOST_LANES];
                for k in 0..V::LEN {
                    vectors[k] = f64x2::load_array(simd, [numbers[k], -numbers[k]]);
                }
                let [x, y] = V::columns(&vectors);
                assert!((0..V::LEN).all(|k| x[k] == numbers[k] && y[k] == -numbers[k]));
                let mut back = [[0.0; 2]; MOST_LANES];
                V::vectors([x, y], &mut back[..V::LEN]);
                there_and_back.extend_from_slice(&back[..V::LEN]);
            }
            (sums.total(), largest(most), there_and_back)
        }
    }

    /// Registers of eight exist on every processor, if only in halves: so the widest path is tested here too.
    #[test]
    fn every_width_gives_the_same_bits() {
        let numbers: [f64; 64] = std::array::from_fn(|k| 1.0 / (k as f64 + 0.3));
        fearless_simd::dispatch!(Level::new(), simd => {
            let two = Several(&numbers).run::<_, f64x2<_>>(simd);
            assert_eq!(two, Several(&numbers).run::<_, f64x4<_>>(simd));
            assert_eq!(two, Several(&numbers).run::<_, f64x8<_>>(simd));
            assert_eq!(two.1, numbers[0]);
            assert!((two.0 - numbers.iter().sum::<f64>()).abs() < 1e-14);
            assert!(two.2.iter().zip(numbers).all(|(vector, number)| *vector == [number, -number]));
        });
    }
}

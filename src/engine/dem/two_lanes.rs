//! Two numbers in one SIMD register: every x86-64 and 64-bit Arm adds and multiplies both in one instruction, and each
//! has the bits that it would have alone. For loops that are not compiled for wider registers: see `lanes` for those that are.

pub use wide::f64x2 as F64x2;

/// Both lanes, by a function of the lane, 0 or 1.
#[inline(always)]
pub fn per_lane(value: impl Fn(usize) -> f64) -> F64x2 {
    F64x2::new([value(0), value(1)])
}

/// One lane.
#[inline(always)]
pub fn lane(of: F64x2, k: usize) -> f64 {
    of.to_array()[k]
}

/// x and y out of (x, y, angle), in one fetch.
#[inline(always)]
pub fn xy(of: &[f64; 3]) -> F64x2 {
    F64x2::new([of[0], of[1]])
}

/// (x of both, y of both) from two vectors (x, y).
#[inline(always)]
pub fn transpose([one, other]: [F64x2; 2]) -> [F64x2; 2] {
    let ([one_x, one_y], [other_x, other_y]) = (one.to_array(), other.to_array());
    [F64x2::new([one_x, other_x]), F64x2::new([one_y, other_y])]
}

/// The larger lane.
pub fn largest(of: F64x2) -> f64 {
    let [one, other] = of.to_array();
    one.max(other)
}

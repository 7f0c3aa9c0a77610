//! Elementary functions that give the same bits on every system.
//!
//! The standard library passes sines, exponentials and powers on to the C library at hand, whose last bits differ between
//! versions of glibc, Windows, macOS and WebAssembly; vibrated disks make another run of another last bit. These are those
//! of the crate `libm`: Rust alone, never contracted to fused operations. Largest errors found, in units in the last place:
//! 0.73 in sine and cosine, 0.76 in the exponential and powers, 0.83 in inverse sine and cosine, 1.3 in `atan2`, 0.9 in
//! `hypot` (`docs/decisions.md`). Square roots, sums, products, remainders and roundings are exact by IEEE 754 and
//! need no other. `clippy.toml` keeps the standard library's functions out.

pub use libm::{
    acos, acosh, asin, atan, atan2, atanh, cos, cosh, exp, expm1 as exp_m1, fma as mul_add, hypot, log as ln,
    pow as powf, sin, sincos as sin_cos, sinh, tan,
};

/// `x` to an integer power, by squaring.
///
/// The standard library's may become a call of the C library's `pow`. A constant exponent leaves nothing but products.
#[inline]
#[must_use]
pub const fn powi(x: f64, exponent: i32) -> f64 {
    let mut rest = exponent.unsigned_abs();
    let (mut square, mut power) = (x, 1.0);
    while rest > 0 {
        if rest & 1 == 1 {
            power *= square;
        }
        rest >>= 1;
        square *= square;
    }
    if exponent < 0 { 1.0 / power } else { power }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integer_powers_are_products() {
        for x in [-3.7, 0.0, 1e-150, 2.0, 1e200] {
            assert_eq!(powi(x, 0), 1.0);
            assert_eq!(powi(x, 1), x);
            assert_eq!(powi(x, 2), x * x);
            assert_eq!(powi(x, 3), x * (x * x));
            assert_eq!(powi(x, -2), 1.0 / (x * x));
        }
        assert_eq!(powi(2.0, 1023), 2.0_f64.powi(1023));
        assert_eq!(powi(2.0, i32::MIN), 0.0);
    }

    /// Against the C library of this system, whose error is at most one unit in the last place as well.
    #[test]
    fn functions_agree_with_the_standard_library() {
        let close = |ours: f64, standard: f64| (ours - standard).abs() <= 3.0 * f64::EPSILON * standard.abs();
        for k in -2000..2000 {
            let x = 0.004_321 * f64::from(k);
            let unit = x / 9.0;
            assert!(
                close(sin(x), x.sin()) && close(cos(x), x.cos()) && sin_cos(x) == (sin(x), cos(x)),
                "{x}"
            );
            assert!(close(exp(x), x.exp()) && close(exp_m1(x), x.exp_m1()), "{x}");
            assert_eq!(ln(1.0), 0.0);
            assert!(close(ln(x.abs() + 1e-9), (x.abs() + 1e-9).ln()), "{x}");
            assert!(
                close(sinh(x), x.sinh()) && close(cosh(x), x.cosh()) && close(tan(x), x.tan()),
                "{x}"
            );
            let (rapidity, area) = (atanh(unit), acosh(1.0 + x.abs())); // poor in the standard library near -1
            assert!(
                close(sinh(rapidity) / cosh(rapidity), unit) && close(cosh(area), 1.0 + x.abs()),
                "{x}"
            );
            assert!(
                close(asin(unit), unit.asin()) && close(acos(unit), unit.acos()) && close(atan(x), x.atan()),
                "{x}"
            );
            assert!(
                close(atan2(x, 0.7), x.atan2(0.7)) && close(atan2(-0.3, x), (-0.3_f64).atan2(x)),
                "{x}"
            );
            assert!(
                close(hypot(x, 0.5), x.hypot(0.5)) && close(powf(x.abs(), 0.25), x.abs().powf(0.25)),
                "{x}"
            );
            assert_eq!(mul_add(x, unit, -x * unit), x.mul_add(unit, -x * unit));
        }
    }
}

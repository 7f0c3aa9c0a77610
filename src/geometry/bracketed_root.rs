//! Newton's method that cannot leave a bracket: a function with a sign change in, its root to rounding out.

/// Root of a function that falls from `value(low) >= 0` to `value(high) < 0` and never rises between.
///
/// `function` gives value and slope. Newton's steps are taken as long as they stay inside the bracket and halve the
/// step, bisection otherwise, until the bracket or the step is down to rounding. Equal arguments give equal bits.
#[inline]
pub(crate) fn falling_root(low: f64, high: f64, function: impl Fn(f64) -> (f64, f64)) -> f64 {
    falling_root_near(low, high, 0.5 * (low + high), function)
}

/// [`falling_root`] with a first guess inside the bracket.
#[inline]
pub(crate) fn falling_root_near(mut low: f64, mut high: f64, guess: f64, function: impl Fn(f64) -> (f64, f64)) -> f64 {
    let mut at = guess;
    let mut last_step = high - low;
    for _ in 0..200 {
        let (value, slope) = function(at);
        if value >= 0.0 {
            low = at;
            if value == 0.0 {
                return at;
            }
        } else {
            high = at;
        }
        let newton = at - value / slope;
        let step = (newton - at).abs();
        let inside = newton > low && newton < high;
        // Errors square from step to step: what the next step would still change is about step^3 / last_step^2.
        if inside && step * step * step <= 0.25 * f64::EPSILON * newton.abs() * last_step * last_step {
            return newton;
        }
        let next = if inside && step < 0.5 * last_step {
            newton
        } else {
            0.5 * (low + high)
        };
        last_step = (next - at).abs();
        if next == at || next <= low || next >= high || last_step <= f64::EPSILON * 0.5 * next.abs() {
            return next;
        }
        at = next;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_simple_and_multiple_roots() {
        let simple = falling_root(0.0, 2.0, |x| (2.0 - x * x, -2.0 * x));
        assert!((simple - 2.0_f64.sqrt()).abs() < 3e-16);
        let triple = falling_root(-1.0, 7.0, |x| ((1.0 - x).powi(3), -3.0 * (1.0 - x).powi(2)));
        assert!((triple - 1.0).abs() < 1e-5);
        // A jump: no slope helps.
        let jump = falling_root(0.0, 1.0, |x| (if x < 0.3 { 1.0 } else { -1.0 }, 0.0));
        assert!((jump - 0.3).abs() < 1e-15);
    }
}

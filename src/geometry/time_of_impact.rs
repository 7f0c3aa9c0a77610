//! When disks meet: relative positions and velocities in, times from now out.
//!
//! Guarantees: a time is never negative and never NaN; infinity means never. A pair that overlaps by rounding and
//! approaches meets now. Differences of nearly equal numbers appear only where the input itself is as uncertain.
//! Not here: walls that move (`drive::FirstHit`), what an impact does (`collision`).

use nalgebra::Vector2;

/// Free flight of a disk towards a wall, along the wall's normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flight {
    /// Distance between the disk's surface and the wall \[m\]. Set it to zero after an impact on this wall: a remainder of
    /// rounding would be carried from bounce to bounce.
    pub gap: f64,
    /// Rate of the gap now \[m/s\], negative on approach.
    pub velocity: f64,
    /// Acceleration of the disk towards the wall \[m/s2\]: `g n_y`, negative for a ceiling, any size.
    pub pull: f64,
}

/// Time \[s\] until two disks meet that fall alike, or infinity.
///
/// `position` r = r_1 - r_2 \[m\], `velocity` v = v_1 - v_2 \[m/s\], `distance` R = R_1 + R_2 \[m\]. Both fall with the same
/// acceleration, so that r + v t is straight.
///
/// `t = (r^2 - R^2) / (-r.v + sqrt D)`, `D = v^2 R^2 - (r x v)^2`, which is `(r.v)^2 - v^2 (r^2 - R^2)` without the
/// cancellation for disks far apart. Pairs that part, or pass (D < 0), never meet; pairs that overlap and approach meet
/// now. Source: P 2.30, F B6.
#[inline]
pub fn disk_disk(position: Vector2<f64>, velocity: Vector2<f64>, distance: f64) -> f64 {
    let approach = -position.dot(&velocity);
    if approach > 0.0 {
        let gap = position.norm_squared() - distance * distance;
        if gap <= 0.0 {
            return 0.0;
        }
        let cross = position.perp(&velocity);
        let discriminant = velocity.norm_squared() * (distance * distance) - cross * cross;
        if discriminant >= 0.0 {
            return gap / (approach + discriminant.sqrt());
        }
    }
    f64::INFINITY
}

/// Time \[s\] until a disk meets a wall at rest, or infinity.
///
/// First t >= 0 with `gap + velocity t - pull t^2 / 2 = 0` with a decreasing gap. A disk at the wall that moves off, or lies
/// at rest, meets it again when the pull brings it back: after `2 velocity / pull`. Towards a ceiling the disk may turn
/// back first. Source: P 2.36 with a zero velocity in the second branch, F B10 to B13.
#[inline]
pub fn disk_wall(flight: &Flight) -> f64 {
    let Flight { gap, velocity, pull } = *flight;
    let gap = if gap > 0.0 { gap } else { 0.0 };
    let discriminant = velocity * velocity + 2.0 * pull * gap;
    if velocity < 0.0 {
        if discriminant >= 0.0 {
            return 2.0 * gap / (discriminant.sqrt() - velocity);
        }
    } else if pull > 0.0 {
        return (velocity + discriminant.sqrt()) / pull;
    }
    f64::INFINITY
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wall(gap: f64, velocity: f64, pull: f64) -> f64 {
        disk_wall(&Flight { gap, velocity, pull })
    }

    /// Floor (pull 10), vertical wall (0), ceiling (-10).
    #[test]
    fn walls_of_every_tilt_are_hit_at_the_closed_form_times() {
        assert_eq!(wall(5.0, 0.0, 10.0), 1.0);
        assert_eq!(wall(0.0, 5.0, 10.0), 1.0);
        assert_eq!(wall(15.0, -10.0, 10.0), 1.0);
        assert_eq!(wall(15.0, 10.0, 10.0), 3.0);
        assert_eq!(wall(6.0, -2.0, 0.0), 3.0);
        assert_eq!(wall(6.0, 2.0, 0.0), f64::INFINITY);
        assert_eq!(wall(6.0, 0.0, 0.0), f64::INFINITY);
        assert_eq!(wall(15.0, -20.0, -10.0), 1.0);
        assert_eq!(wall(5.0, -10.0, -10.0), 1.0); // just reaches it
        assert_eq!(wall(5.1, -10.0, -10.0), f64::INFINITY);
        assert_eq!(wall(5.0, 1.0, -10.0), f64::INFINITY);
    }

    #[test]
    fn walls_overlapped_by_rounding_are_hit_at_once_or_left() {
        assert_eq!(wall(-1e-17, -1.0, 10.0), 0.0);
        assert_eq!(wall(-1e-17, -1.0, -10.0), 0.0);
        assert_eq!(wall(-1e-17, 5.0, 10.0), 1.0);
        assert_eq!(wall(-1e-17, 0.0, 10.0), 0.0);
        assert_eq!(wall(-1e-17, 1.0, -10.0), f64::INFINITY);
        assert_eq!(wall(0.0, 0.0, 0.0), f64::INFINITY);
    }

    /// `(v^2 + 2 a d).sqrt() - |v|` would lose every digit here.
    #[test]
    fn times_to_walls_lose_no_digits() {
        assert!((wall(1e-12, -1.0, 10.0) / 1e-12 - 1.0).abs() < 1e-11);
        assert!((wall(1.0, -1.0, 1e-18) - 1.0).abs() < 1e-15);
        assert!(wall(1.0, 1e-3, 1e-300) > 1e296);
    }

    #[test]
    fn disks_meet_part_or_pass() {
        let disk_disk = |position: [f64; 2], velocity: [f64; 2]| disk_disk(position.into(), velocity.into(), 1.0);
        assert_eq!(disk_disk([-3.0, 0.0], [2.0, 0.0]), 1.0);
        assert_eq!(disk_disk([-3.0, 0.0], [-2.0, 0.0]), f64::INFINITY);
        assert_eq!(disk_disk([-3.0, 1.5], [2.0, 0.0]), f64::INFINITY);
        assert_eq!(disk_disk([-3.0, 1.0], [2.0, 0.0]), 1.5); // grazing
        assert_eq!(disk_disk([-3.0, 0.0], [0.0, 0.0]), f64::INFINITY);
        assert_eq!(disk_disk([0.0, 0.0], [1.0, 0.0]), f64::INFINITY);
        assert_eq!(disk_disk([1.0 - 1e-16, 0.0], [-1.0, 0.3]), 0.0);
        assert_eq!(disk_disk([1.0 - 1e-16, 0.0], [1.0, 0.3]), f64::INFINITY);
        assert_eq!(disk_disk([1.0, 0.0], [f64::NAN, 0.3]), f64::INFINITY);
    }

    /// Any sizes and signs, as long as their fourth powers are numbers.
    #[test]
    fn times_of_impact_are_never_negative_or_nan() {
        let sizes = [0.0, 1e-70, 1e-17, 1e-3, 1.0, 7.0, 1e17, 1e70]
            .map(|size| [size, -size])
            .concat();
        for a in &sizes {
            for b in &sizes {
                for c in &sizes {
                    assert!(wall(*a, *b, *c) >= 0.0);
                    for d in &sizes {
                        assert!(disk_disk(Vector2::new(*a, *b), Vector2::new(*c, *d), 1.0) >= 0.0);
                    }
                }
            }
        }
    }

    /// Far apart the two terms of the printed discriminant agree in all digits but the last few.
    #[test]
    fn distant_disks_keep_their_digits() {
        let time = disk_disk(Vector2::new(-1e8, 0.6), Vector2::x(), 1.0);
        assert!((time - (1e8 - 0.8)).abs() < 2e-8);
    }

    #[test]
    fn contact_is_reached_to_rounding() {
        let mut seed = 1_u64;
        let mut unit = || {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut met = 0;
        for _ in 0..100_000 {
            let position = Vector2::new(10.0 * unit() - 5.0, 10.0 * unit() - 5.0);
            let velocity = Vector2::new(2.0 * unit() - 1.0, 2.0 * unit() - 1.0);
            let time = disk_disk(position, velocity, 1.0);
            assert!(time >= 0.0);
            if position.x.hypot(position.y) > 1.0 && time < 1e3 {
                let there = position + velocity * time;
                // The grazing ones come within the square root of rounding; all satisfy the equation.
                assert!(
                    (there.norm_squared() - 1.0).abs() < 1e-13 * (1.0 + time),
                    "{position:?} {velocity:?}"
                );
                assert!(there.dot(&velocity) <= 1e-6);
                met += 1;
            }
        }
        assert!(met > 5_000);
    }
}

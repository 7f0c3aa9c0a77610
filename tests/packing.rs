//! The advancing front: contacts, overlaps, known lattices, refusals. Everything is checked by brute force.

#![allow(clippy::unwrap_used)]

use jostle::geometry::Disk;
use jostle::packing::{RadiusClass, RadiusDistribution, advancing_front, mirrored};
use proptest::prelude::*;

/// Distance between two surfaces, negative where the disks overlap.
fn gap(a: &Disk, b: &Disk) -> f64 {
    (a.x - b.x).hypot(a.y - b.y) - (a.radius + b.radius)
}

/// 1e-12 of the contact distance and the rounding of the coordinates, as documented.
fn tolerance(radius_sum: f64, disk: &Disk) -> f64 {
    1.01e-12 * radius_sum + 8.0 * f64::EPSILON * (disk.x.abs() + disk.y.abs())
}

/// No overlap with anything ever placed, two touches or more with what was there before, supports on both sides.
fn check(disks: &[Disk], width: f64) -> Result<(), String> {
    for (index, disk) in disks.iter().enumerate() {
        let walls = [
            (disk.x - disk.radius + 0.5 * width, -1.0),
            (0.5 * width - disk.radius - disk.x, 1.0),
            (disk.y - disk.radius, 0.0),
        ];
        let neighbours = disks[..index].iter().map(|other| (gap(disk, other), other));
        let (mut touches, mut left, mut right) = (0, false, false);
        let mut contact = |gap: f64, radius_sum: f64, toward: f64| {
            let slack = tolerance(radius_sum, disk);
            if gap < -slack {
                return Err(format!(
                    "disk {index} overlaps by {:e} of {radius_sum}",
                    -gap / radius_sum
                ));
            }
            if gap <= slack {
                touches += 1;
                left |= toward <= slack;
                right |= toward >= -slack;
            }
            Ok(())
        };
        for (gap, toward) in walls {
            contact(gap, disk.radius, toward)?;
        }
        for (gap, other) in neighbours {
            contact(gap, disk.radius + other.radius, other.x - disk.x)?;
        }
        if touches < 2 || !left || !right {
            return Err(format!(
                "disk {index} has {touches} contacts, left {left}, right {right}: {disk:?}"
            ));
        }
    }
    Ok(())
}

fn packed(radii: &[f64], width: f64) -> Vec<Disk> {
    let disks = advancing_front(radii, width).unwrap();
    assert_eq!(disks.iter().map(|disk| disk.radius).collect::<Vec<_>>(), radii);
    check(&disks, width).unwrap_or_else(|trouble| panic!("width {width}: {trouble}"));
    disks
}

fn assert_at(disk: &Disk, x: f64, y: f64) {
    let size = disk.radius;
    assert!(
        (disk.x - x).abs() < 1e-9 * size && (disk.y - y).abs() < 1e-9 * size,
        "{disk:?} should be at {x}, {y}"
    );
}

#[test]
fn the_sixty_disks_of_the_paper_touch_and_do_not_overlap() {
    for seed in 0..40 {
        let radii = RadiusDistribution::default().sample(60, seed).unwrap();
        for width in [0.05, 0.0501, 0.06, 0.0999, 0.1, 0.13, 0.4, 2.0, 50.0] {
            packed(&radii, width);
        }
    }
}

#[test]
fn equal_disks_in_any_box_touch_and_do_not_overlap() {
    for step in 0..400 {
        let width = 2.0 + 0.02 * f64::from(step);
        packed(&[1.0; 80], width);
    }
}

#[test]
fn a_box_one_diameter_wide_holds_a_column() {
    for (index, disk) in packed(&[0.1; 50], 0.2).iter().enumerate() {
        assert_at(disk, 0.0, 0.1 + 0.2 * index as f64);
    }
}

#[test]
fn a_box_two_diameters_wide_holds_rows_of_two_and_one() {
    let disks = packed(&[0.1; 90], 0.4);
    for (index, disk) in disks.iter().enumerate() {
        let row = 2 * (index / 3) + usize::from(index % 3 == 2);
        let x = [-0.1, 0.1, 0.0][index % 3];
        assert_at(disk, x, 0.1 + 0.1 * 3f64.sqrt() * row as f64);
    }
}

#[test]
fn a_box_of_whole_diameters_holds_a_triangular_lattice() {
    for columns in [3usize, 7, 20] {
        let radius = 0.013;
        let disks = packed(&vec![radius; 600], 2.0 * radius * columns as f64);
        let mut expected = Vec::new();
        for row in 0.. {
            let members = columns - row % 2;
            if expected.len() >= disks.len() {
                break;
            }
            let y = radius * (1.0 + 3f64.sqrt() * row as f64);
            expected.extend((0..members).map(|k| (radius * (2.0 * k as f64 + 1.0 - members as f64), y)));
        }
        for (disk, (x, y)) in disks.iter().zip(expected) {
            assert_at(disk, x, y);
        }
    }
}

#[test]
fn a_box_of_whole_diameters_and_a_half_holds_full_rows() {
    let (columns, radius) = (5usize, 1.0);
    for (index, disk) in packed(&[radius; 100], 11.0).iter().enumerate() {
        let (row, k) = (index / columns, index % columns);
        // Odd rows lean on the right wall.
        let x = -5.5 + 1.0 + 2.0 * k as f64 + (row % 2) as f64;
        assert_at(disk, x, 1.0 + 3f64.sqrt() * row as f64);
    }
}

#[test]
fn a_box_just_too_narrow_for_two_holds_a_zigzag() {
    // Side steps of 1.5 radii leave steps up of sqrt(4 - 2.25) radii.
    for (index, disk) in packed(&[1.0; 40], 3.5).iter().enumerate() {
        let x = if index % 2 == 0 { -0.75 } else { 0.75 };
        assert_at(disk, x, 1.0 + 1.75f64.sqrt() * index as f64);
    }
}

#[test]
fn a_gap_too_wide_for_two_supports_takes_the_disk_in() {
    // Floor, 3 wide: disk 1 at the left wall, disk 2 beside it, disk 3 between disk 2 and the wall.
    let disks = packed(&[0.5, 0.5, 0.55], 3.2);
    assert_at(&disks[1], -0.1 - 0.0, 0.5);
    assert_at(&disks[2], disks[1].x + (1.05f64.powi(2) - 0.05f64.powi(2)).sqrt(), 0.55);
}

#[test]
fn a_third_disk_that_blocks_the_place_becomes_the_support() {
    // A pebble in the middle of two large disks: a large disk on top must not sink into it.
    packed(&[1.0, 1.0, 0.5, 1.0, 0.2, 1.0, 0.05, 1.0, 1.0], 4.0);
    packed(&[0.1, 0.1, 0.1, 0.1, 0.1, 1.0, 0.1, 0.1, 1.0], 2.0);
}

#[test]
fn very_different_disks_touch_and_do_not_overlap() {
    for seed in 0..4 {
        let class = |radius, parts| RadiusClass { radius, parts };
        let mixture = RadiusDistribution::Classes(vec![class(0.001, 80), class(0.01, 5), class(0.1, 1)]);
        packed(&mixture.sample(1500, seed).unwrap(), 0.2 + 0.07 * seed as f64);
        packed(
            &RadiusDistribution::Uniform { min: 0.001, max: 0.1 }
                .sample(300, seed)
                .unwrap(),
            0.7,
        );
    }
}

#[test]
fn ten_thousand_disks_touch_and_do_not_overlap() {
    packed(&RadiusDistribution::default().sample(10_000, 1).unwrap(), 4.0);
}

#[test]
fn the_same_input_gives_the_same_bits_and_the_mirror_is_exact() {
    let radii = RadiusDistribution::default().sample(60, 5).unwrap();
    let disks = packed(&radii, 0.4);
    assert_eq!(disks, packed(&radii, 0.4));
    let mirror = mirrored(&disks);
    assert!(
        disks
            .iter()
            .zip(&mirror)
            .all(|(a, b)| a.x == -b.x && a.y == b.y && a.radius == b.radius)
    );
    assert_eq!(mirrored(&mirror), disks);
}

#[test]
fn no_disks_give_no_packing() {
    assert_eq!(advancing_front(&[], 0.4).unwrap(), []);
}

#[test]
fn impossible_boxes_and_disks_are_refused_by_name() {
    for width in [f64::NAN, f64::INFINITY, 0.0, -0.0, -1.0, 1e9, f64::NEG_INFINITY] {
        let error = advancing_front(&[0.1], width).unwrap_err().to_string();
        assert!(error.starts_with("box.width = "), "{error}");
    }
    for radius in [f64::NAN, f64::INFINITY, 0.0, -0.1, 1e-300, 5e-324, 1e300] {
        let error = advancing_front(&[0.1, radius], 0.4).unwrap_err().to_string();
        assert!(
            error.starts_with("disk.radius = ") && error.contains("disk 2"),
            "{error}"
        );
    }
    let error = advancing_front(&[0.1, 0.21], 0.4).unwrap_err().to_string();
    let message =
        "disk.radius = 0.21 m (disk 2) is not allowed: at most half of box.width = 0.4 m, that is 0.2 m. Widen";
    assert!(error.starts_with(message), "{error}");
}

proptest! {
    /// Any radii up to a ratio of 20 in any box that holds the largest.
    #[test]
    fn any_disks_touch_and_do_not_overlap(
        radii in prop::collection::vec(0.05f64..1.0, 1..120),
        room in 1.0f64..12.0,
        exact in any::<bool>(),
    ) {
        let largest = radii.iter().copied().fold(0.0, f64::max);
        let width = 2.0 * largest * if exact { room.floor() } else { room };
        let disks = advancing_front(&radii, width).map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(disks.len(), radii.len());
        check(&disks, width).map_err(TestCaseError::fail)?;
    }

    /// Few distinct radii, where ties and lattices are common.
    #[test]
    fn any_mixture_of_three_touches_and_does_not_overlap(
        classes in prop::collection::vec(1u32..20, 3),
        picks in prop::collection::vec(0usize..3, 1..150),
        diameters in 1.0f64..6.0,
    ) {
        let radii: Vec<f64> = picks.iter().map(|&pick| f64::from(classes[pick])).collect();
        let largest = radii.iter().copied().fold(0.0, f64::max);
        let width = (2.0 * largest * diameters).floor();
        let disks = advancing_front(&radii, width).map_err(|error| TestCaseError::fail(error.to_string()))?;
        check(&disks, width).map_err(TestCaseError::fail)?;
    }
}

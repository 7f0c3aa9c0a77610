//! The icon of every FMU, drawn here so that no picture has to be kept in step with a program: disks on a shaken base.

use jostle::{Error, Result};

/// Width and height in pixels.
pub const SIZE: u32 = 128;
/// Each pixel is the mean of this many samples each way.
const SAMPLES: u32 = 4;

type Colour = [f64; 3];
const GROUND: Colour = [60.0, 66.0, 78.0];
/// Centre, radius (the icon is 1 wide, y up) and colour: blue turns one way, orange the other.
const DISKS: [(f64, f64, f64, Colour); 4] = [
    (0.24, 0.38, 0.17, [52.0, 120.0, 190.0]),
    (0.62, 0.42, 0.21, [232.0, 130.0, 40.0]),
    (0.40, 0.72, 0.15, [232.0, 130.0, 40.0]),
    (0.80, 0.76, 0.13, [52.0, 120.0, 190.0]),
];

/// The icon as a PNG file with a transparent background.
///
/// # Errors
/// The PNG writer fails.
pub fn png() -> Result<Vec<u8>> {
    let failed = |error: png::EncodingError| Error::call(format!("the icon: {error}"), "Please report this defect.");
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, SIZE, SIZE);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(failed)?;
    let pixels: Vec<u8> = (0..SIZE * SIZE)
        .flat_map(|index| pixel(index % SIZE, index / SIZE))
        .collect();
    writer.write_image_data(&pixels).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(file)
}

fn pixel(column: u32, row: u32) -> [u8; 4] {
    let (mut sum, mut covered) = ([0.0; 3], 0.0);
    for sample in 0..SAMPLES * SAMPLES {
        let place =
            |pixel: u32, part: u32| (f64::from(pixel) + (f64::from(part) + 0.5) / f64::from(SAMPLES)) / f64::from(SIZE);
        let (x, y) = (place(column, sample % SAMPLES), 1.0 - place(row, sample / SAMPLES));
        if let Some(colour) = colour_at(x, y) {
            covered += 1.0;
            for (total, part) in sum.iter_mut().zip(colour) {
                *total += part;
            }
        }
    }
    let [red, green, blue] = sum.map(|total: f64| (total / f64::max(covered, 1.0)).round() as u8);
    let opacity = 255.0 * covered / f64::from(SAMPLES * SAMPLES);
    [red, green, blue, opacity.round() as u8]
}

fn colour_at(x: f64, y: f64) -> Option<Colour> {
    for (centre_x, centre_y, radius, colour) in DISKS {
        let (dx, dy) = (x - centre_x, y - centre_y);
        if dx * dx + dy * dy <= radius * radius {
            // A spoke shows that they turn.
            let spoke = dy.abs() < 0.015 && dx > 0.0;
            return Some(if spoke { [255.0; 3] } else { colour });
        }
    }
    // A sawtooth of four teeth on a plate.
    let tooth = (4.0 * x).fract();
    (y < 0.10 + 0.10 * tooth).then_some(GROUND)
}

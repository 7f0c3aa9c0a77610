//! The icons of the FMUs, one a scene, drawn here so that no picture has to be kept in step with a program: as pixels and as SVG,
//! both from the same shapes.

use std::fmt::Write;

use fmi_bundle::Icon;
use jostle::{Error, Result};

/// Width and height in pixels.
pub const SIZE: u32 = 128;
/// Each pixel is the mean of this many samples each way.
const SAMPLES: u32 = 4;
/// Half the width of the spoke that shows that a disk turns.
const SPOKE: f64 = 0.015;

type Colour = [u8; 3];
type Point = (f64, f64);
const GROUND: Colour = [60, 66, 78];
/// Turns one way, and the other.
const BLUE: Colour = [52, 120, 190];
const ORANGE: Colour = [232, 130, 40];
const WHITE: Colour = [255; 3];

struct Disk {
    centre: Point,
    radius: f64,
    colour: Colour,
}

const fn disk(x: f64, y: f64, radius: f64, colour: Colour) -> Disk {
    Disk {
        centre: (x, y),
        radius,
        colour,
    }
}

/// What is drawn: the icon is 1 wide and high, y up, the origin at the lower left.
struct Picture {
    /// Polygons that do not cross themselves.
    ground: &'static [&'static [Point]],
    disks: &'static [Disk],
}

/// Disks in a box with a flat bottom.
const PACKING: Picture = Picture {
    ground: &[&[
        (0.0, 0.92),
        (0.0, 0.0),
        (1.0, 0.0),
        (1.0, 0.92),
        (0.94, 0.92),
        (0.94, 0.1),
        (0.06, 0.1),
        (0.06, 0.92),
    ]],
    disks: &[
        disk(0.23, 0.27, 0.17, BLUE),
        disk(0.52, 0.23, 0.13, ORANGE),
        disk(0.79, 0.25, 0.15, BLUE),
        disk(0.385, 0.555, 0.155, ORANGE),
        disk(0.715, 0.545, 0.155, BLUE),
        disk(0.212, 0.81, 0.14, BLUE),
        disk(0.53, 0.81, 0.14, ORANGE),
    ],
};

/// Disks above four teeth.
const RATCHET: Picture = Picture {
    ground: &[&[
        (0.0, 0.0),
        (1.0, 0.0),
        (1.0, 0.2),
        (0.75, 0.1),
        (0.75, 0.2),
        (0.5, 0.1),
        (0.5, 0.2),
        (0.25, 0.1),
        (0.25, 0.2),
        (0.0, 0.1),
    ]],
    disks: &[
        disk(0.24, 0.38, 0.17, BLUE),
        disk(0.62, 0.42, 0.21, ORANGE),
        disk(0.40, 0.72, 0.15, ORANGE),
        disk(0.80, 0.76, 0.13, BLUE),
    ],
};

/// A disk between two walls of different slope.
const WEDGE: Picture = Picture {
    ground: &[&[
        (0.0, 0.9),
        (0.0, 0.0),
        (1.0, 0.0),
        (1.0, 0.72),
        (0.92, 0.75),
        (0.42, 0.12),
        (0.1, 0.92),
    ]],
    disks: &[disk(0.483, 0.554, 0.22, ORANGE)],
};

/// A disk on two others that are held.
const THREE_DISK: Picture = Picture {
    ground: &[&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.1), (0.0, 0.1)]],
    disks: &[
        disk(0.25, 0.33, 0.23, GROUND),
        disk(0.75, 0.33, 0.23, GROUND),
        disk(0.5, 0.71, 0.225, BLUE),
    ],
};

/// A plate on the cone of a loudspeaker, and a disk on it: the components of the laboratory.
const SHAKER: Picture = Picture {
    ground: &[
        &[(0.3, 0.0), (0.7, 0.0), (0.7, 0.2), (0.3, 0.2)],
        &[(0.4, 0.2), (0.6, 0.2), (0.9, 0.5), (0.1, 0.5)],
    ],
    disks: &[disk(0.5, 0.72, 0.2, ORANGE)],
};

/// The icon of a scene or component with a transparent background.
///
/// # Errors
/// The PNG writer fails.
pub fn of(scene: &str) -> Result<Icon> {
    let picture = match scene {
        "packing" => &PACKING,
        "wedge" => &WEDGE,
        "three_disk" => &THREE_DISK,
        "ratchet" => &RATCHET,
        _ => &SHAKER,
    };
    let png = png(picture).map_err(|error| Error::call(format!("the icon: {error}"), "Please report this defect."))?;
    Ok(Icon {
        png,
        svg: Some(svg(picture)),
    })
}

fn png(picture: &Picture) -> std::result::Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, SIZE, SIZE);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    let pixels: Vec<u8> = (0..SIZE * SIZE)
        .flat_map(|index| pixel(picture, index % SIZE, index / SIZE))
        .collect();
    writer.write_image_data(&pixels)?;
    writer.finish()?;
    Ok(file)
}

fn pixel(picture: &Picture, column: u32, row: u32) -> [u8; 4] {
    let (mut sum, mut covered) = ([0.0; 3], 0.0);
    for sample in 0..SAMPLES * SAMPLES {
        let place =
            |pixel: u32, part: u32| (f64::from(pixel) + (f64::from(part) + 0.5) / f64::from(SAMPLES)) / f64::from(SIZE);
        let point = (place(column, sample % SAMPLES), 1.0 - place(row, sample / SAMPLES));
        if let Some(colour) = picture.colour_at(point) {
            covered += 1.0;
            for (total, part) in sum.iter_mut().zip(colour) {
                *total += f64::from(part);
            }
        }
    }
    let [red, green, blue] = sum.map(|total: f64| (total / f64::max(covered, 1.0)).round() as u8);
    let opacity = 255.0 * covered / f64::from(SAMPLES * SAMPLES);
    [red, green, blue, opacity.round() as u8]
}

impl Picture {
    fn colour_at(&self, point: Point) -> Option<Colour> {
        let on_disk = self.disks.iter().find_map(|disk| {
            let (dx, dy) = (point.0 - disk.centre.0, point.1 - disk.centre.1);
            let spoke = dy.abs() < SPOKE && dx > 0.0 && disk.colour != GROUND;
            let inside = dx * dx + dy * dy <= disk.radius * disk.radius;
            inside.then_some(if spoke { WHITE } else { disk.colour })
        });
        let on_ground = || self.ground.iter().any(|polygon| is_inside(polygon, point));
        on_disk.or_else(|| on_ground().then_some(GROUND))
    }
}

/// Whether a ray to the right crosses the outline an odd number of times.
fn is_inside(polygon: &[Point], (x, y): Point) -> bool {
    let ends = polygon.iter().cycle().skip(1);
    let crossed = polygon.iter().zip(ends).filter(|(from, to)| {
        let straddles = (from.1 > y) != (to.1 > y);
        straddles && x < from.0 + (y - from.1) / (to.1 - from.1) * (to.0 - from.0)
    });
    crossed.count() % 2 == 1
}

/// The same shapes; the ground first, since disks lie on it.
fn svg(picture: &Picture) -> String {
    let scale = f64::from(SIZE);
    let number = |value: f64| format!("{}", (value * scale * 100.0).round() / 100.0);
    let paint = |[red, green, blue]: Colour| format!("#{red:02x}{green:02x}{blue:02x}");
    let mut text = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE} {SIZE}\">\n");
    let mut add = |element: String| {
        // Writing to a text does not fail.
        let _ = writeln!(text, "  {element}");
    };
    for polygon in picture.ground {
        let points = polygon
            .iter()
            .map(|(x, y)| format!("{},{}", number(*x), number(1.0 - y)));
        let points = points.collect::<Vec<_>>().join(" ");
        add(format!("<polygon points=\"{points}\" fill=\"{}\"/>", paint(GROUND)));
    }
    for disk in picture.disks {
        let (x, y, radius) = (number(disk.centre.0), number(1.0 - disk.centre.1), number(disk.radius));
        let fill = paint(disk.colour);
        add(format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" fill=\"{fill}\"/>"
        ));
        if disk.colour != GROUND {
            let width = number(2.0 * SPOKE);
            add(format!(
                "<path d=\"M{x} {y}h{radius}\" stroke=\"#ffffff\" stroke-width=\"{width}\"/>"
            ));
        }
    }
    text + "</svg>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The disks of a scene touch each other and the walls, or are apart: none reaches into another by more than can be seen.
    #[test]
    fn no_disk_of_an_icon_is_inside_another() {
        for picture in [PACKING, RATCHET, WEDGE, THREE_DISK, SHAKER] {
            for (number, one) in picture.disks.iter().enumerate() {
                assert!(one.centre.0 - one.radius > 0.0 && one.centre.0 + one.radius < 1.0);
                assert!(one.centre.1 - one.radius > 0.0 && one.centre.1 + one.radius < 1.0);
                for other in &picture.disks[..number] {
                    let (dx, dy) = (one.centre.0 - other.centre.0, one.centre.1 - other.centre.1);
                    let reach = one.radius + other.radius - 0.01;
                    assert!(dx * dx + dy * dy > reach * reach, "{:?}", one.centre);
                }
            }
        }
    }
}

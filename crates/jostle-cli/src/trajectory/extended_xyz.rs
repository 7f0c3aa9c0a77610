//! A frame as extended XYZ: the number of disks, a line of keys, a line a disk.

use std::fmt::Write;

use super::Frame;
use crate::text::number;

/// The frame as it stands in the file.
pub fn text(frame: &Frame<'_>) -> String {
    let [across, up, deep] = frame.cell.bounds.map(|[low, high]| number(high - low));
    let origin = frame.cell.bounds.map(|[low, _]| number(low)).join(" ");
    let velocity = frame.velocities.as_ref().map_or("", |_| ":velo:R:3");
    let periodic = if frame.cell.is_periodic { "T" } else { "F" };
    let mut text = format!(
        "{}\nLattice=\"{across} 0 0 0 {up} 0 0 0 {deep}\" Origin=\"{origin}\" \
         Properties=species:S:1:pos:R:3:id:I:1:radius:R:1{velocity}:angle:R:1:angular_velocity:R:3 \
         Time={} Frame={} Scene={} pbc=\"{periodic} F F\"\n",
        frame.places.len(),
        number(frame.time),
        frame.number,
        frame.scene,
    );
    for (index, [x, y]) in frame.places.iter().enumerate() {
        // Formatting into a string cannot fail. X is a particle that is no element.
        let (x, y, radius) = (number(*x), number(*y), number(frame.radii[index]));
        let _ = write!(text, "X {x} {y} 0 {} {radius}", index + 1);
        if let Some(velocities) = &frame.velocities {
            let [along, up] = velocities[index].map(number);
            let _ = write!(text, " {along} {up} 0");
        }
        let (angle, rate) = (number(frame.angles[index]), number(frame.angular_velocities[index]));
        let _ = writeln!(text, " {angle} 0 0 {rate}");
    }
    text
}

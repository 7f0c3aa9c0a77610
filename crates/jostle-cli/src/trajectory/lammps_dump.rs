//! A frame as LAMMPS writes it by `dump custom` with `dump_modify units yes time yes`.

use std::fmt::Write;

use super::Frame;
use crate::text::number;

/// The frame as it stands in the file; the units stand in the `first` one alone.
pub fn text(frame: &Frame<'_>, first: bool) -> String {
    let units = if first { "ITEM: UNITS\nsi\n" } else { "" };
    let along = if frame.cell.is_periodic { "pp" } else { "ff" };
    let bounds = frame.cell.bounds.map(|bounds| bounds.map(number).join(" ")).join("\n");
    // LAMMPS calls places so that are not brought back into a periodic box.
    let places = if frame.cell.is_periodic { "xu yu zu" } else { "x y z" };
    let velocities = frame.velocities.as_ref().map_or("", |_| " vx vy vz");
    let mut text = format!(
        "{units}ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\n\
         ITEM: BOX BOUNDS {along} ff ff\n{bounds}\n\
         ITEM: ATOMS id type radius {places}{velocities} omegax omegay omegaz angle\n",
        number(frame.time),
        frame.number,
        frame.places.len(),
    );
    for (index, place) in frame.places.iter().enumerate() {
        // Formatting into a string cannot fail.
        let ([x, y], radius) = (place.map(number), number(frame.radii[index]));
        let _ = write!(text, "{} 1 {radius} {x} {y} 0", index + 1);
        if let Some(velocities) = &frame.velocities {
            let [along, up] = velocities[index].map(number);
            let _ = write!(text, " {along} {up} 0");
        }
        let (angle, rate) = (number(frame.angles[index]), number(frame.angular_velocities[index]));
        let _ = writeln!(text, " 0 0 {rate} {angle}");
    }
    text
}

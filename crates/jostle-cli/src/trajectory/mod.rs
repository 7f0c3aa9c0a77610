//! The motion of the disks as frames for programs that show particles: OVITO and whatever else reads extended XYZ or dumps of
//! LAMMPS.
//!
//! Positions are those of the outputs, to the last bit: of a periodic scene they are unwrapped. Disks lie in the plane z = 0.

mod extended_xyz;
mod lammps_dump;

use std::fs::File;
use std::path::{Path, PathBuf};

use jostle::scene::{DynSimulation, Value};
use jostle::{Error, Result};

use crate::failure::Failure;
use crate::output_file::TrajectoryFormat;
use crate::table::write_whole;

/// What the formats hold of the disks at one time.
struct Frame<'a> {
    /// Number of the frame in the run.
    number: u64,
    /// Time \[s\].
    time: f64,
    /// Name of the scene.
    scene: &'static str,
    cell: Cell,
    radii: &'a [f64],
    /// x and y \[m\].
    places: Vec<[f64; 2]>,
    /// x and y \[m/s\], if the scene has velocities.
    velocities: Option<Vec<[f64; 2]>>,
    /// \[rad\].
    angles: Vec<f64>,
    /// \[rad/s\].
    angular_velocities: Vec<f64>,
}

/// The box around the disks, the same in all frames.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cell {
    /// Lowest and highest x, y and z \[m\].
    bounds: [[f64; 2]; 3],
    /// Whether what leaves it to the right comes back from the left.
    is_periodic: bool,
}

/// A file that takes frames.
pub struct Trajectory {
    path: PathBuf,
    file: File,
    format: TrajectoryFormat,
    disks: Disks,
    radii: Vec<f64>,
    cell: Cell,
    frames: u64,
}

/// Positions of the outputs in the table, for each disk.
struct Disks {
    places: [Vec<usize>; 2],
    velocities: Option<[Vec<usize>; 2]>,
    angles: Vec<usize>,
    angular_velocities: Vec<usize>,
}

impl Disks {
    /// # Errors
    /// The scene does not say where its disks are.
    fn of(simulation: &dyn DynSimulation) -> Result<Self> {
        let all = |name: &str| numbered(simulation, name);
        let both = |names: [&str; 2]| Some([all(names[0])?, all(names[1])?]);
        let found = both(["disk.x", "disk.y"]).zip(both(["disk.angle", "disk.angular_velocity"]));
        let Some((places, [angles, angular_velocities])) = found else {
            let allowed = "a scene whose disks have the outputs disk.x and disk.y";
            let remedy =
                "Leave --trajectory out, or choose another scene or engine: jostle describe SCENE lists outputs.";
            return Err(Error::parameter(
                "--trajectory",
                simulation.info().name,
                allowed,
                remedy,
            ));
        };
        Ok(Self {
            places,
            velocities: both(["disk.velocity_x", "disk.velocity_y"]),
            angles,
            angular_velocities,
        })
    }
}

/// Positions in the table of `name[1]`, `name[2]` and so on.
fn numbered(simulation: &dyn DynSimulation, name: &str) -> Option<Vec<usize>> {
    let table = simulation.values().table();
    let positions: Vec<usize> = (1..)
        .map_while(|number| table.position(&format!("{name}[{number}]")))
        .collect();
    (!positions.is_empty()).then_some(positions)
}

fn reals(simulation: &dyn DynSimulation, positions: &[usize]) -> Result<Vec<f64>> {
    let real = |&position: &usize| {
        simulation.value(position).map(|value| match value {
            Value::Real(real) => real,
            Value::Integer(integer) => integer as f64,
        })
    };
    positions.iter().map(real).collect()
}

fn pairs(simulation: &dyn DynSimulation, [along, up]: &[Vec<usize>; 2]) -> Result<Vec<[f64; 2]>> {
    let (along, up) = (reals(simulation, along)?, reals(simulation, up)?);
    Ok(along.into_iter().zip(up).map(|(x, y)| [x, y]).collect())
}

/// The value of a parameter, if the scene has it.
fn parameter(simulation: &dyn DynSimulation, name: &str) -> Result<Option<f64>> {
    let position = simulation.values().table().position(name);
    let found = position.map(|position| reals(simulation, &[position])).transpose()?;
    Ok(found.map(|values| values[0]))
}

impl Cell {
    /// Width, where the scene has one, else what holds the disks now and the origin; likewise the height.
    fn around(simulation: &dyn DynSimulation, places: &[[f64; 2]], radii: &[f64]) -> Result<Self> {
        let extent = |axis: usize| {
            places
                .iter()
                .zip(radii)
                .fold([0.0_f64, 0.0_f64], |[low, high], (place, radius)| {
                    [low.min(place[axis] - radius), high.max(place[axis] + radius)]
                })
        };
        let box_width = parameter(simulation, "box.width")?;
        let teeth = parameter(simulation, "tooth.width")?.zip(parameter(simulation, "tooth.count")?);
        let along = match (box_width, teeth) {
            (Some(width), _) => [-0.5 * width, 0.5 * width],
            (None, Some((width, count))) => [0.0, width * count],
            (None, None) => extent(0),
        };
        let height = parameter(simulation, "cell.height")?;
        let largest = radii.iter().fold(0.0_f64, |largest, radius| largest.max(*radius));
        Ok(Self {
            bounds: [
                along,
                height.map_or_else(|| extent(1), |height| [0.0, height]),
                [-largest, largest],
            ],
            is_periodic: teeth.is_some(),
        })
    }
}

impl Trajectory {
    /// A file without frames; a file that was there is replaced.
    ///
    /// # Errors
    /// The scene does not say where its disks are, or the file cannot be made.
    pub fn create(
        path: &Path,
        format: TrajectoryFormat,
        simulation: &dyn DynSimulation,
    ) -> std::result::Result<Self, Failure> {
        let disks = Disks::of(simulation)?;
        let places = pairs(simulation, &disks.places)?;
        let radii = match numbered(simulation, "disk.radius") {
            Some(positions) => reals(simulation, &positions)?,
            None => vec![parameter(simulation, "disk.radius")?.unwrap_or_default(); places.len()],
        };
        let cell = Cell::around(simulation, &places, &radii)?;
        Ok(Self {
            path: path.into(),
            file: File::create(path).map_err(|error| Failure::file(path, &error))?,
            format,
            disks,
            radii,
            cell,
            frames: 0,
        })
    }

    /// Adds the frame `number`. If it does not fit, the file is left with the frames before it.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(
        &mut self,
        number: u64,
        time: f64,
        simulation: &dyn DynSimulation,
    ) -> std::result::Result<(), Failure> {
        let frame = Frame {
            number,
            time,
            scene: simulation.info().name,
            cell: self.cell,
            radii: &self.radii,
            places: pairs(simulation, &self.disks.places)?,
            velocities: match &self.disks.velocities {
                Some(positions) => Some(pairs(simulation, positions)?),
                None => None,
            },
            angles: reals(simulation, &self.disks.angles)?,
            angular_velocities: reals(simulation, &self.disks.angular_velocities)?,
        };
        let text = match self.format {
            TrajectoryFormat::ExtendedXyz => extended_xyz::text(&frame),
            TrajectoryFormat::LammpsDump => lammps_dump::text(&frame, self.frames == 0),
        };
        write_whole(&mut self.file, text.as_bytes()).map_err(|error| Failure::file(&self.path, &error))?;
        self.frames += 1;
        Ok(())
    }

    /// Frames in the file, all of them whole.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock;

    #[test]
    fn a_scene_that_does_not_say_where_its_disks_are_is_refused_by_name() {
        let mut clock = clock::prepare(2);
        clock.start(0.0).unwrap();
        let path = std::env::temp_dir().join(format!("jostle-no-places-{}.xyz", std::process::id()));
        let refused = Trajectory::create(&path, TrajectoryFormat::ExtendedXyz, &clock)
            .err()
            .unwrap();
        assert_eq!(refused.exit_code(), 2);
        let message = refused.to_string();
        assert!(
            message.starts_with("--trajectory = ") && message.contains("disk.x and disk.y"),
            "{message}"
        );
        assert!(message.contains("clock") && !path.exists(), "{message}");
    }
}

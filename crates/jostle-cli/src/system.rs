//! `jostle system`: writes a shaker with its load, sensors and controller as an SSP archive.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use fmi_bundle::system::{Connection, Element, HEIGHT, WIDTH};
use fmi_bundle::{Component, Libraries};
use jostle::Error;
use jostle::scene::{DynSimulation, Value, catalogue};

use crate::failure::Failure;
use crate::fmu::{self, Standard};
use crate::selection::Selection;
use crate::{laboratory, output_file};

/// Communication step \[s\]: 40 a period of 80 Hz, and a whole number of nanoseconds, which some runners count.
const STEP: f64 = 312.5e-6;
/// Amplitude \[V\] at which the controller begins; it finds the right one within some ten periods.
const FIRST_VOLTAGE: f64 = 10.0;

/// Write a whole system as an SSP 1.0 archive, which simulation tools open and run.
///
/// The shaker: a loudspeaker that shakes a packing of disks, two accelerometers on it, the spectral amplitude of the one, and a
/// controller that holds Gamma by the other. Parameters stand in files .ssv inside of the archive.
#[derive(Args, Debug)]
#[command(after_help = "Example:\n  jostle system shaker --out shaker.ssp")]
pub struct System {
    /// Which system.
    #[arg(value_enum)]
    name: Name,
    /// Version of FMI of the components. Most tools that run SSP know 2 alone.
    #[arg(long, value_enum, default_value = "2")]
    fmi: Standard,
    /// Number of disks of the packing.
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    disks: Option<i64>,
    /// Gamma that the controller holds: peak acceleration over gravity.
    #[arg(long, default_value_t = 2.0, allow_negative_numbers = true)]
    gamma: f64,
    /// Folder with the libraries of several systems, as of jostle fmu.
    #[arg(long, value_name = "FOLDER")]
    libraries: Option<PathBuf>,
    /// File to write.
    #[arg(long, value_name = "FILE.ssp")]
    out: PathBuf,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Name {
    /// Loudspeaker, packing, two accelerometers, spectral amplitude, controller of Gamma.
    Shaker,
}

/// A component with its libraries.
type Part = (Component, Libraries);

impl System {
    /// Writes the file.
    ///
    /// # Errors
    /// A wrong number of disks or Gamma, no library to put in, no place to write to.
    pub fn execute(self) -> Result<(), Failure> {
        output_file::check_ssp("--out", &self.out)?;
        let Name::Shaker = self.name;
        if !(1e-3..=1e3).contains(&self.gamma) {
            let remedy = "The packing leaves the base above 1.";
            return Err(Error::parameter("--gamma", self.gamma, "a number from 0.001 to 1000", remedy).into());
        }
        let (packing, weight, gravity) = self.packing()?;
        let part = |name| self.laboratory(name);
        let parts = Parts {
            loudspeaker: part("loudspeaker")?,
            accelerometer: part("accelerometer")?,
            spectral_amplitude: part("spectral_amplitude")?,
            gamma_controller: part("gamma_controller")?,
            packing,
        };
        let system = fmi_bundle::system::System {
            name: "shaker",
            description: "A loudspeaker shakes a packing of disks; a controller holds Gamma, the peak acceleration over gravity.",
            elements: parts.elements(self.gamma, weight, gravity),
            connections: connections(),
            stop_time: 2.0,
            step_size: STEP,
        };
        Ok(system.write(self.fmi.version(), &self.out)?)
    }

    fn laboratory(&self, name: &str) -> Result<Part, Failure> {
        let model = laboratory::find(name)
            .ok_or_else(|| Error::call(format!("there is no component {name}"), "Please report this defect."))?;
        let component = fmu::prepared(&model, &[])?;
        let libraries = fmu::libraries(&component, self.libraries.as_deref())?;
        Ok((component, libraries))
    }

    /// The packing, the weight of its disks \[N\] and gravity \[m/s2\].
    fn packing(&self) -> Result<(Part, f64, f64), Failure> {
        let selection = Selection {
            scene: "packing".into(),
            engine: None,
            disks: self.disks,
        };
        let selected = selection.of(*catalogue::find("packing", None, Some("input"))?)?;
        let structure: Vec<_> = selected.structure.iter().collect();
        let component = fmu::prepared(&selected.model, &structure)?;
        let libraries = fmu::libraries(&component, self.libraries.as_deref())?;
        let mut grains = (selected.model.prepare)(selected.structure.clone());
        grains.start(0.0)?;
        let gravity = read(&*grains, "gravity")?;
        let mut area = 0.0;
        for disk in 1..=selected.structure.get("disks") {
            let radius = read(&*grains, &format!("disk.radius[{disk}]"))?;
            area += std::f64::consts::PI * radius * radius;
        }
        let weight = read(&*grains, "disk.surface_density")? * area * gravity;
        Ok(((component, libraries), weight, gravity))
    }
}

fn read(simulation: &dyn DynSimulation, name: &str) -> Result<f64, Error> {
    Ok(simulation.value(simulation.position(name)?)?.to_f64())
}

/// What the system is made of.
struct Parts {
    loudspeaker: Part,
    accelerometer: Part,
    spectral_amplitude: Part,
    gamma_controller: Part,
    packing: Part,
}

impl Parts {
    fn elements(&self, gamma: f64, weight: f64, gravity: f64) -> Vec<Element<'_>> {
        let gravity = ("gravity", Value::Real(gravity));
        vec![
            Element {
                parameters: vec![
                    ("target", Value::Real(gamma)),
                    ("voltage.start", Value::Real(FIRST_VOLTAGE)),
                    gravity,
                ],
                outputs: vec!["gamma"],
                ..element("controller", &self.gamma_controller, 0.0, 1.0)
            },
            Element {
                parameters: vec![
                    ("drive.frequency", Value::Real(80.0)),
                    ("load.weight", Value::Real(weight)),
                ],
                outputs: vec!["current"],
                ..element("loudspeaker", &self.loudspeaker, 1.0, 1.0)
            },
            Element {
                // The force of the grains feeds back: a higher degree amplifies it.
                parameters: vec![
                    ("base.extrapolation_degree", Value::Integer(2)),
                    ("seed", Value::Integer(1)),
                ],
                outputs: vec!["energy.kinetic"],
                ..element("packing", &self.packing, 2.0, 1.0)
            },
            Element {
                parameters: vec![("seed", Value::Integer(1)), gravity],
                ..element("accelerometer_1", &self.accelerometer, 2.0, 0.0)
            },
            Element {
                // Fast and fine, for the controller: readings as often as steps.
                parameters: vec![
                    ("seed", Value::Integer(2)),
                    ("data_rate", Value::Real(1.0 / STEP)),
                    ("resolution", Value::Real(0.0039)),
                    gravity,
                ],
                ..element("accelerometer_2", &self.accelerometer, 2.0, 2.0)
            },
            Element {
                parameters: vec![("drive.frequency", Value::Real(80.0))],
                outputs: vec!["amplitude", "amplitude.corrected"],
                ..element("spectral_amplitude", &self.spectral_amplitude, 3.0, 0.0)
            },
        ]
    }
}

/// An element in a column and a row of the diagram.
fn element<'parts>(name: &'static str, (component, libraries): &'parts Part, column: f64, row: f64) -> Element<'parts> {
    Element {
        name,
        component,
        libraries,
        parameters: Vec::new(),
        outputs: Vec::new(),
        place: (column * 1.75 * WIDTH, row * 1.5 * HEIGHT),
    }
}

/// All connections of the shaker.
fn connections() -> Vec<Connection> {
    let of = |from, to| Connection { from, to };
    vec![
        of(("controller", "voltage"), ("loudspeaker", "drive.voltage")),
        of(("loudspeaker", "displacement"), ("packing", "base.displacement")),
        of(("loudspeaker", "velocity"), ("packing", "base.velocity")),
        of(("loudspeaker", "acceleration"), ("packing", "base.acceleration_input")),
        of(("packing", "base.reaction_force"), ("loudspeaker", "reaction_force")),
        of(("loudspeaker", "acceleration"), ("accelerometer_1", "acceleration")),
        of(("loudspeaker", "acceleration"), ("accelerometer_2", "acceleration")),
        of(("loudspeaker", "drive.turns"), ("controller", "drive.turns")),
        of(("accelerometer_1", "reading"), ("spectral_amplitude", "reading")),
        of(
            ("accelerometer_2", "reading.acceleration"),
            ("controller", "acceleration"),
        ),
    ]
}

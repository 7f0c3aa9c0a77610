//! `jostle fields`: where mass is and where it flows, by place and phase of the base, into CSV files.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, value_parser};
use jostle::Error;
use jostle::measure::FlowFields;
use jostle::scene::catalogue::Names;
use jostle::scene::ratchet::{RatchetOnSine, Resolution};
use jostle::scene::{Model, ModelType, Simulation};

use crate::csv_file::{self, CsvFile};
use crate::failure::Failure;
use crate::run::positive;
use crate::selection::{Selected, Selection};
use crate::{assignments, output_file, progress, standard_output, text};

/// Pieces of a run between which the progress bar moves.
const PIECES: u64 = 100;

/// Averages mass and momentum of the ratchet over boxes and phase windows, and over heights.
///
/// Boxes are squares, a sixth of a tooth wide, fixed in the laboratory. All teeth are folded into one, whose boxes then
/// hold the mass of all: in each phase window the masses add up to the mass of all disks. Window j is where the phase of
/// the base, y = A sin(phase), is from 2 pi j/6 to 2 pi (j+1)/6. Averages are exact time averages, not samples.
#[derive(Args, Debug)]
#[command(
    after_help = "Files:\n  fields.csv   phase,x,y,mass,momentum_x,momentum_y: window j, centre of the box [m], mean mass \
    [kg], mean momentum [kg.m/s]\n  profile.csv  y,mass,velocity_x: middle of a row of boxes [m], mean mass [kg], mean \
    velocity [m/s], over all phases\n\nExample:\n  jostle fields ratchet --seconds 30 --warm-up 2 --set \
    tooth.height=3e-3 --set tooth.asymmetry=0.1 --profile profile.csv\n\n\
    Exit code: 0 done, 2 wrong argument or parameter, 1 a step was refused or a file could not be written."
)]
pub struct Fields {
    #[command(flatten)]
    selection: Selection,
    /// Simulated time of the averages.
    #[arg(long, value_parser = positive, allow_negative_numbers = true)]
    seconds: f64,
    /// Simulated time before the averages begin.
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = not_negative, allow_negative_numbers = true)]
    warm_up: f64,
    /// File for the fields.
    #[arg(long, value_name = "FILE", default_value = "fields.csv")]
    output: PathBuf,
    /// File for mass and velocity by height.
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,
    /// Parameter, such as drive.frequency=30; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    assignments: Vec<String>,
    /// Boxes across a tooth.
    #[arg(long, value_name = "N", default_value_t = Resolution::default().boxes, value_parser = value_parser!(u32).range(1..=10_000), allow_negative_numbers = true)]
    boxes: u32,
    /// Windows of a period of the base.
    #[arg(long, value_name = "N", default_value_t = Resolution::default().phases, value_parser = value_parser!(u32).range(1..=10_000), allow_negative_numbers = true)]
    phases: u32,
    /// Boxes across the whole cell instead of one tooth.
    #[arg(long)]
    whole_cell: bool,
    /// Show no progress bar.
    #[arg(long)]
    no_progress: bool,
}

fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number >= 0.0 => Ok(number),
        _ => Err("give a time in seconds from 0, such as 2".into()),
    }
}

/// Refuses another `what` than the only one that has a flow.
fn known(what: &str, given: &str, only: &str) -> Result<(), Error> {
    if given == only {
        return Ok(());
    }
    let allowed = format!("{only}, the only one whose flow can be averaged");
    Err(Error::parameter(what, given, allowed, "Name this one."))
}

impl Fields {
    pub fn execute(self) -> Result<(), Failure> {
        let names = Names::from(&RatchetOnSine::info());
        let (scene, engine) = (&self.selection.scene, self.selection.engine.as_deref());
        known("scene", scene, names.scene)?;
        known("engine", engine.unwrap_or(names.engine), names.engine)?;
        let began = Instant::now();
        let ratchet = self.prepare()?;
        self.check_files()?;
        let (fields, end, ratchet) = self.observe(ratchet)?;
        let took = began.elapsed().as_secs_f64();
        self.write_fields(&fields, end)?;
        if let Some(path) = &self.profile {
            write_profile(path, &fields, end)?;
        }
        standard_output::write(&format!(
            "{} s of {} in {took:.2} s; transport velocity {} +- {} m/s\nfields in {}{}\n",
            text::number(end),
            names.scene,
            text::number(ratchet.real("transport_velocity")?),
            text::number(ratchet.real("transport_velocity.standard_error")?),
            self.output.display(),
            self.profile
                .as_ref()
                .map_or_else(String::new, |path| format!(", profile in {}", path.display())),
        ))
    }

    /// The ratchet at the start.
    fn prepare(&self) -> Result<Simulation<RatchetOnSine>, Failure> {
        let Selected { structure, .. } = self.selection.of(ModelType::of::<RatchetOnSine>())?;
        let mut ratchet = Simulation::<RatchetOnSine>::prepare(structure);
        assignments::assign(&mut ratchet, &self.assignments)?;
        ratchet.start(0.0)?;
        Ok(ratchet)
    }

    /// Refuses files that cannot be written before anything is computed for them.
    fn check_files(&self) -> Result<(), Failure> {
        output_file::check_csv("--output", &self.output)?;
        if let Some(profile) = &self.profile {
            output_file::check_csv("--profile", profile)?;
            let whole = |path: &Path| std::path::absolute(path).ok();
            if whole(profile) == whole(&self.output) {
                let allowed = "another file than --output, which holds the fields";
                return Err(Error::parameter("--profile", profile.display(), allowed, "Name two files.").into());
            }
        }
        csv_file::check(&self.output)?;
        self.profile.as_deref().map_or(Ok(()), csv_file::check)
    }

    /// Runs the scene and returns the fields, the time of their end \[s\], and the simulation then.
    fn observe(
        &self,
        mut ratchet: Simulation<RatchetOnSine>,
    ) -> Result<(FlowFields, f64, Simulation<RatchetOnSine>), Failure> {
        if self.warm_up > 0.0 {
            ratchet.advance_to(self.warm_up)?;
        }
        // The scene's own averages begin with the fields.
        ratchet.set("measure.mark", self.warm_up + 1.0)?;
        let resolution = Resolution {
            boxes: self.boxes,
            phases: self.phases,
            whole_cell: self.whole_cell,
        };
        let mut fields = ratchet.model()?.flow_fields(resolution)?;
        let bar = progress::bar(PIECES, !self.no_progress);
        for piece in 1..=PIECES {
            let time = self.warm_up + self.seconds * (piece as f64 / PIECES as f64);
            ratchet
                .advance_by(time, |model, values| model.advance_observed(time, values, &mut fields))
                .inspect_err(|_| bar.abandon())?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        let end = ratchet.model()?.show_last_flights(&mut fields);
        Ok((fields, end, ratchet))
    }

    fn write_fields(&self, fields: &FlowFields, end: f64) -> Result<(), Failure> {
        let header = ["phase", "x", "y", "mass", "momentum_x", "momentum_y"];
        let rows = fields.cells(end).map(|cell| {
            let [along, up] = cell.momentum.into();
            let numbers = [cell.x, cell.y, cell.mass, along, up].map(text::number);
            std::iter::once(cell.phase.to_string()).chain(numbers).collect()
        });
        write(&self.output, &header, rows)
    }
}

fn write_profile(path: &Path, fields: &FlowFields, end: f64) -> Result<(), Failure> {
    let rows = fields
        .layers(end)
        .map(|layer| [layer.y, layer.mass, layer.velocity].map(text::number).into());
    write(path, &["y", "mass", "velocity_x"], rows)
}

fn write(path: &Path, header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> Result<(), Failure> {
    let mut file = CsvFile::create(path)?;
    file.write(header)?;
    for row in rows {
        file.write(&row)?;
    }
    file.flush()
}

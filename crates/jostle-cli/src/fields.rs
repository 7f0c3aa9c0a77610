//! `jostle fields`: where mass is and where it flows, by place and phase of the base, into files.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, value_parser};
use jostle::Error;
use jostle::measure::FlowFields;
use jostle::scene::catalogue::Names;
use jostle::scene::ratchet::{RatchetOnSine, Resolution};
use jostle::scene::{Model, ModelType, Simulation, Unit, Value};

use crate::failure::Failure;
use crate::run::positive;
use crate::selection::{Selected, Selection};
use crate::table::{self, Column, Fact};
use crate::{assignments, output_file, progress, samples, standard_output, text};

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
    /// File for the fields: .csv, .parquet, or - for CSV to standard output.
    #[arg(long, value_name = "FILE", default_value = "fields.csv")]
    output: PathBuf,
    /// File for mass and velocity by height: .csv or .parquet.
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
        let facts = samples::facts(&self.selected()?, &ratchet)?;
        self.write_fields(&fields, end, &facts)?;
        if let Some(path) = &self.profile {
            write_profile(path, &fields, end, &facts)?;
        }
        let summary = format!(
            "{} s of {} in {took:.2} s; transport velocity {} +- {} m/s\nfields in {}{}\n",
            text::number(end),
            names.scene,
            text::number(ratchet.real("transport_velocity")?),
            text::number(ratchet.real("transport_velocity.standard_error")?),
            output_file::shown(&self.output),
            self.profile
                .as_ref()
                .map_or_else(String::new, |path| format!(", profile in {}", path.display())),
        );
        if output_file::is_standard_output(&self.output) {
            eprint!("{summary}");
            return Ok(());
        }
        standard_output::write(&summary)
    }

    fn selected(&self) -> Result<Selected, Error> {
        self.selection.of(ModelType::of::<RatchetOnSine>())
    }

    /// The ratchet at the start.
    fn prepare(&self) -> Result<Simulation<RatchetOnSine>, Failure> {
        let Selected { structure, .. } = self.selected()?;
        let mut ratchet = Simulation::<RatchetOnSine>::prepare(structure);
        assignments::assign(&mut ratchet, &self.assignments)?;
        ratchet.start(0.0)?;
        Ok(ratchet)
    }

    /// Refuses files that cannot be written before anything is computed for them.
    fn check_files(&self) -> Result<(), Failure> {
        output_file::plain_format("--output", &self.output)?;
        let mut files = vec![("--output", self.output.as_path())];
        if let Some(profile) = &self.profile {
            output_file::plain_format("--profile", profile)?;
            files.push(("--profile", profile));
        }
        output_file::check_distinct(&files)?;
        files
            .into_iter()
            .try_for_each(|(_, path)| output_file::check_writable(path))
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

    fn write_fields(&self, fields: &FlowFields, end: f64, facts: &[Fact]) -> Result<(), Failure> {
        let columns = [
            Column::integer("phase", "Window of the phase of the base"),
            Column::real("x", Unit::METRE, "Centre of the box, to the right"),
            Column::real("y", Unit::METRE, "Centre of the box, up"),
            Column::real("mass", Unit::KILOGRAM, "Mean mass in the box"),
            Column::real(
                "momentum_x",
                Unit::NEWTON_SECOND,
                "Mean momentum in the box, to the right",
            ),
            Column::real("momentum_y", Unit::NEWTON_SECOND, "Mean momentum in the box, up"),
        ];
        let rows = fields.cells(end).map(|cell| {
            let [along, up] = cell.momentum.into();
            let numbers = [cell.x, cell.y, cell.mass, along, up].map(Value::Real);
            std::iter::once(Value::Integer(cell.phase.into()))
                .chain(numbers)
                .collect()
        });
        write("--output", &self.output, &columns, facts, rows)
    }
}

fn write_profile(path: &Path, fields: &FlowFields, end: f64, facts: &[Fact]) -> Result<(), Failure> {
    let columns = [
        Column::real("y", Unit::METRE, "Middle of a row of boxes"),
        Column::real("mass", Unit::KILOGRAM, "Mean mass in the row"),
        Column::real(
            "velocity_x",
            Unit::METRE_PER_SECOND,
            "Mean velocity in the row, to the right",
        ),
    ];
    let rows = fields
        .layers(end)
        .map(|layer| [layer.y, layer.mass, layer.velocity].map(Value::Real).into());
    write("--profile", path, &columns, facts, rows)
}

fn write(
    option: &str,
    path: &Path,
    columns: &[Column],
    facts: &[Fact],
    rows: impl Iterator<Item = Vec<Value>>,
) -> Result<(), Failure> {
    let format = output_file::plain_format(option, path)?;
    let mut table = table::create(format, path, columns, facts, &[])?;
    for row in rows {
        table.write(&row)?;
    }
    table.finish()
}

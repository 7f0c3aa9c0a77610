//! `jostle theory`: curves of the theory as CSV, to be drawn elsewhere.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use jostle::Error;
use jostle::measure::disk_on_two_supports::{
    Acceleration, Corner, HarmonicTorque, Limits, Setting, closed_form, closed_form_range, closed_form_with_inertia,
    critical_tilt, cycle, detachment_friction, detachment_tilt, limits, mean_torques, point, regime, relaxed,
};

use crate::assignments::split;
use crate::failure::Failure;
use crate::nearest::did_you_mean;
use crate::{output_file, standard_output, text};

/// Computes what the theory says of a scene and prints it as CSV: what varies, then the quantity, in SI units.
///
/// Every value may be a number, a list 0.1,0.2 or a range 0.1:0.2:11 (from, to, how many); of several that vary all
/// combinations are printed, the first varies slowest. Names that are not set have the values of the thesis.
/// contact.normal_stiffness=inf stands for rigid contacts, otherwise disks sink into their supports.
#[derive(Args, Debug)]
#[command(
    after_help = "Example:\n  jostle theory three_disk velocity --set tilt=0.1:0.4:4 --set torque.amplitude=0.11,0.113\n\n\
    Names: gravity, disk.mass, disk.radius, support.angle, support.radius, tilt, contact.friction,\n\
    contact.normal_stiffness, contact.tangential_stiffness, torque.amplitude, torque.angular_frequency,\n\
    acceleration.x, acceleration.y."
)]
pub struct Theory {
    /// Scene; there is a theory of three_disk.
    scene: String,
    /// What to compute.
    #[arg(value_enum)]
    quantity: Quantity,
    /// Value, list or range of a parameter; may be repeated.
    #[arg(long = "set", value_name = "NAME=VALUES", allow_hyphen_values = true)]
    assignments: Vec<String>,
    /// CSV file for the table; - is standard output.
    #[arg(long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
}

#[derive(ValueEnum, Debug, Clone, Copy)]
enum Quantity {
    /// Corners of the admissible region: departure and stretch of S1, T2, S2, T1, D1, D2 [rad].
    Points,
    /// Torques at which the disk slides [N m], and where contacts open.
    Limits,
    /// Sliding regime under a harmonic torque: 0 none, 1 unidirectional, 2 bidirectional, 3 detaching.
    Regime,
    /// Mean angular velocity under a slow harmonic torque [rad/s].
    Velocity,
    /// Torques at the corners and their means [N m].
    Torques,
}

/// Names, and the values of P 5.1.
const DEFAULTS: [(&str, f64); 13] = [
    ("gravity", Setting::THESIS.gravity),
    ("disk.mass", Setting::THESIS.mass),
    ("disk.radius", Setting::THESIS.radius),
    ("support.angle", Setting::THESIS.half_angle),
    ("support.radius", 1.0),
    ("tilt", Setting::THESIS.tilt),
    ("contact.friction", Setting::THESIS.friction),
    ("contact.normal_stiffness", f64::INFINITY),
    ("contact.tangential_stiffness", Setting::THESIS.tangential_stiffness),
    ("torque.amplitude", 0.113),
    ("torque.angular_frequency", 1.0),
    ("acceleration.x", 0.0),
    ("acceleration.y", 0.0),
];

/// Most rows; more is a slip of the keyboard.
const MOST_ROWS: usize = 1_000_000;

impl Theory {
    pub fn execute(self) -> Result<(), Failure> {
        let scenes = "three_disk";
        if self.scene != scenes {
            let remedy = "The other scenes have no theory here.";
            return Err(Error::parameter("scene", self.scene, scenes, remedy).into());
        }
        let path = &self.output;
        let is_standard = output_file::is_standard_output(path);
        if !is_standard {
            output_file::check_csv("--output", path)?;
        }
        let swept = swept(&self.assignments)?;
        let page = page(self.quantity, &swept)?;
        if is_standard {
            return standard_output::write(&page);
        }
        std::fs::write(path, page).map_err(|error| Failure::file(path, &error))
    }
}

/// Values of each name that is set, in the order given.
fn swept(assignments: &[String]) -> Result<Vec<(usize, Vec<f64>)>, Error> {
    let mut swept: Vec<(usize, Vec<f64>)> = Vec::new();
    for (name, values) in split(assignments, "NAME=VALUES", "tilt=0.1")? {
        let Some(position) = DEFAULTS.iter().position(|(known, _)| *known == name) else {
            let known = DEFAULTS.map(|(known, _)| known);
            let allowed = format!("one of: {}", known.join(", "));
            let error = Error::parameter("--set", name, allowed, "Name one of these.");
            return Err(did_you_mean(error, known));
        };
        let Some(values) = numbers(values) else {
            let allowed = "a number, a list 0.1,0.2 or a range 0.1:0.2:11";
            return Err(Error::parameter(name, values, allowed, "Write numbers with digits."));
        };
        swept.push((position, values));
    }
    let rows = swept
        .iter()
        .try_fold(1_usize, |rows, (_, values)| rows.checked_mul(values.len()));
    match rows {
        Some(rows) if rows <= MOST_ROWS => Ok(swept),
        _ => Err(Error::parameter(
            "--set",
            "more rows than that",
            format!("up to {MOST_ROWS} rows"),
            "Give shorter lists.",
        )),
    }
}

/// `1`, `1,2,3` or `1:3:5`.
fn numbers(text: &str) -> Option<Vec<f64>> {
    let number = |word: &str| word.trim().parse::<f64>().ok().filter(|value| !value.is_nan());
    if let [from, to, count] = text.split(':').collect::<Vec<_>>()[..] {
        let (from, to) = (number(from)?, number(to)?);
        let count: u32 = count.trim().parse().ok()?;
        if count < 2 || count as usize > MOST_ROWS || !(from.is_finite() && to.is_finite()) {
            return None;
        }
        let last = f64::from(count - 1);
        let at = |index| (from * (last - f64::from(index)) + to * f64::from(index)) / last;
        return Some((0..count).map(at).collect());
    }
    text.split(',').map(number).collect()
}

/// Header and rows.
fn page(quantity: Quantity, swept: &[(usize, Vec<f64>)]) -> Result<String, Error> {
    let rows: usize = swept.iter().map(|(_, values)| values.len()).product();
    let mut page = String::new();
    for row in 0..rows {
        let mut values = DEFAULTS.map(|(_, value)| value);
        let mut rest = row;
        for (position, choices) in swept.iter().rev() {
            values[*position] = choices[rest % choices.len()];
            rest /= choices.len();
        }
        let columns = columns(quantity, &values)?;
        let given = swept.iter().map(|(position, _)| *position);
        if row == 0 {
            let names = given.clone().map(|position| DEFAULTS[position].0.to_string());
            let header: Vec<String> = names.chain(columns.iter().map(|(name, _)| name.clone())).collect();
            page += &(header.join(",") + "\n");
        }
        let numbers = given
            .map(|position| values[position])
            .chain(columns.iter().map(|(_, value)| *value));
        let line: Vec<String> = numbers.map(text::number).collect();
        page += &(line.join(",") + "\n");
    }
    Ok(page)
}

type Columns = Vec<(String, f64)>;

fn named(columns: &[(&str, f64)]) -> Columns {
    columns
        .iter()
        .map(|(name, value)| ((*name).to_string(), *value))
        .collect()
}

/// What is asked for, at these values.
fn columns(quantity: Quantity, values: &[f64; 13]) -> Result<Columns, Error> {
    let [
        gravity,
        mass,
        radius,
        half_angle,
        support_radius,
        tilt,
        friction,
        stiffness,
        tangential,
        amplitude,
        frequency,
        x,
        y,
    ] = *values;
    let setting = Setting {
        gravity,
        mass,
        radius,
        half_angle,
        tilt,
        friction,
        tangential_stiffness: tangential,
    }
    .checked()?;
    let acceleration = Acceleration {
        x: sane("acceleration.x", x, f64::NEG_INFINITY)?,
        y: sane("acceleration.y", y, f64::NEG_INFINITY)?,
    };
    let soft = if stiffness == f64::INFINITY {
        None
    } else {
        Some(relaxed(&setting, stiffness, support_radius)?)
    };
    let torque_limits = soft.map_or_else(|| limits(&setting), |soft| soft.limits());
    let amplitude = sane("torque.amplitude", amplitude, 0.0)?;
    Ok(match quantity {
        Quantity::Points => {
            let at = |corner| match &soft {
                Some(soft) => soft.point(corner),
                None => point(&setting, acceleration, corner),
            };
            let pair = |corner: Corner| {
                let (point, name) = (at(corner), corner.name());
                [
                    (format!("{name}.departure"), point.departure),
                    (format!("{name}.stretch"), point.stretch),
                ]
            };
            let corners = Corner::ALL
                .into_iter()
                .filter(|corner| soft.is_none() || !matches!(corner, Corner::D1 | Corner::D2));
            corners.flat_map(pair).collect()
        }
        Quantity::Limits => named(&[
            ("A_S1", torque_limits.clockwise),
            ("A_S2", torque_limits.counter_clockwise),
            ("A_0", Limits::untilted(&setting)),
            ("A_rest", closed_form_range(&torque_limits)),
            ("detachment_tilt", detachment_tilt(&setting)),
            ("detachment_friction", detachment_friction(&setting, acceleration)),
        ]),
        Quantity::Regime => named(&[
            ("regime", f64::from(regime(&setting, amplitude).number())),
            ("critical_tilt", critical_tilt(&setting, amplitude).unwrap_or(f64::NAN)),
        ]),
        Quantity::Velocity => velocity(&setting, &torque_limits, stiffness, amplitude, frequency)?,
        Quantity::Torques => {
            let torques = mean_torques(&setting);
            named(&[
                ("S1", torques.s1),
                ("S2", torques.s2),
                ("T1", torques.t1),
                ("T2", torques.t2),
                ("mean", torques.all()),
                ("mean_of_S", torques.sliding_together()),
            ])
        }
    })
}

/// The cycle, and the closed form where it holds.
fn velocity(
    setting: &Setting,
    limits: &Limits,
    stiffness: f64,
    amplitude: f64,
    frequency: f64,
) -> Result<Columns, Error> {
    if setting.friction <= 0.0 || setting.tilt.abs() >= detachment_tilt(setting) || !limits.lower().is_finite() {
        let allowed = format!(
            "above 0 and below {}, where a slide opens a contact at this tilt",
            jostle::elementary::tan(setting.half_angle - setting.tilt.abs())
        );
        let remedy = "Tilt less, or change the friction.";
        return Err(Error::parameter("contact.friction", setting.friction, allowed, remedy));
    }
    let torque = HarmonicTorque {
        amplitude,
        angular_frequency: sane("torque.angular_frequency", frequency, f64::MIN_POSITIVE)?,
    };
    let motion = cycle(setting, limits, torque);
    Ok(named(&[
        ("A_S1", limits.clockwise),
        ("A_S2", limits.counter_clockwise),
        ("angular_velocity", motion.angular_velocity),
        ("resting", motion.resting),
        ("closed_form", closed_form(setting, limits, torque).unwrap_or(f64::NAN)),
        (
            "closed_form_with_inertia",
            closed_form_with_inertia(setting, limits, stiffness, torque).unwrap_or(f64::NAN),
        ),
    ]))
}

/// `value`, if products of it do not overflow.
fn sane(name: &str, value: f64, low: f64) -> Result<f64, Error> {
    if value >= low && value.abs() <= 1e30 {
        return Ok(value);
    }
    let allowed = if low >= 0.0 {
        "from 0 to 1e30"
    } else {
        "from -1e30 to 1e30"
    };
    Err(Error::parameter(name, value, allowed, "Give it in SI units."))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(assignments: &[&str]) -> String {
        let assignments: Vec<String> = assignments.iter().map(|text| text.to_string()).collect();
        let made = swept(&assignments).and_then(|swept| page(Quantity::Velocity, &swept));
        made.unwrap_or_else(|error| error.to_string())
    }

    #[test]
    fn all_combinations_come_with_the_first_name_slowest() {
        let page = answer(&["tilt=0.1:0.3:3", "torque.amplitude=0.11,0.13"]);
        let lines: Vec<Vec<&str>> = page.lines().map(|line| line.split(',').collect()).collect();
        assert_eq!(lines.len(), 1 + 6);
        assert_eq!(&lines[0][..2], ["tilt", "torque.amplitude"]);
        let first: Vec<&str> = lines[1..].iter().map(|line| line[0]).collect();
        assert_eq!(first, ["0.1", "0.1", "0.2", "0.2", "0.3", "0.3"]);
        assert_eq!((lines[1][1], lines[2][1]), ("0.11", "0.13"));
    }

    #[test]
    fn what_is_wrong_is_named() {
        assert!(answer(&["tilt"]).contains("NAME=VALUES"));
        assert!(answer(&["tlt=1"]).contains("one of: gravity"));
        assert!(answer(&["tlt=1"]).contains("Did you mean tilt? Name one of these."));
        assert!(answer(&["tilt=0.1", "tilt=0.2"]).contains("tilt = 0.1 is set before"));
        assert!(answer(&["tilt=0.1:0.2"]).contains("tilt = 0.1:0.2"));
        assert!(answer(&["tilt=NaN"]).contains("tilt = NaN"));
        assert!(answer(&["tilt=0.6"]).contains("rolls off"));
        assert!(answer(&["tilt=0.5"]).contains("opens a contact"));
        assert!(answer(&["contact.friction=0"]).contains("above 0"));
        assert!(answer(&["torque.angular_frequency=0"]).starts_with("torque.angular_frequency = 0"));
        assert!(answer(&["torque.amplitude=inf"]).starts_with("torque.amplitude = inf"));
        assert!(answer(&["tilt=0:0.1:100000", "torque.amplitude=0:1:100000"]).contains("rows"));
        assert!(answer(&["contact.normal_stiffness=1"]).contains("overlap is small"));
    }
}

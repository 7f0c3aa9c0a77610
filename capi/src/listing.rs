//! What there is: scenes, and the variables of a simulation.

use std::ffi::c_char;

use fmi_component::memory;
use jostle::scene::catalogue::names;
use jostle::scene::{self, Variable};

use crate::handle::{Access, JostleSimulation, JostleStatus, enter};
use crate::text;
use crate::texts::{VariableTexts, unknown};

/// Who sets a variable, and when.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
pub enum JostleCausality {
    /// Given when the simulation is made, frozen since unless it is tunable.
    Parameter = 0,
    /// Computed from the parameters, constant unless one that it depends on is tuned.
    CalculatedParameter = 1,
    /// Set between steps.
    Input = 2,
    /// Computed by the scene.
    Output = 3,
}

/// What a variable holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
pub enum JostleKind {
    /// A real number: jostle_get.
    Real = 0,
    /// A whole number: jostle_get_integers.
    Integer = 1,
    /// The number of an option, the first being 1: jostle_get_integers.
    Enumeration = 2,
}

/// A variable. The texts live as long as its simulation.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct JostleVariable {
    /// Name, such as `disk.angle[1]`.
    pub name: *const c_char,
    /// Unit, such as `m/s`; `1` for pure numbers.
    pub unit: *const c_char,
    /// One sentence.
    pub description: *const c_char,
    /// Names of the options of an enumeration, separated by commas; else empty.
    pub options: *const c_char,
    /// Who sets it.
    pub causality: JostleCausality,
    /// What it holds.
    pub kind: JostleKind,
    /// Smallest allowed value; minus infinity for none.
    pub min: f64,
    /// Largest allowed value; infinity for none. (Whole numbers beyond 2^53 are rounded here.)
    pub max: f64,
    /// Value if none is given.
    pub start: f64,
    /// A parameter that jostle_set may change between steps too.
    pub tunable: bool,
}

/// Version of the library, such as `0.1.0`.
#[unsafe(no_mangle)]
pub extern "C" fn jostle_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// Lists what `jostle_new` takes: one line for each, with scene, engine and drive separated by spaces. The first engine of
/// a scene is its default, and the first drive of an engine. At most `size` bytes are written, a zero byte at the end
/// included. Returns the size of the whole text with its zero byte.
///
/// # Safety
/// `text` is null or has `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_scenes(text: *mut c_char, size: usize) -> usize {
    let lines = names()
        .into_iter()
        .map(|names| format!("{} {} {}\n", names.scene, names.engine, names.drive));
    // SAFETY: passed on.
    unsafe { text::write(&lines.collect::<String>(), text, size) }
}

/// Number of variables; 0 if the pointer is no simulation or another thread is at work in it.
///
/// # Safety
/// `simulation` is null or was made here and not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_variable_count(simulation: *const JostleSimulation) -> u32 {
    let mut count = 0;
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Read, |inner| {
            count = inner.simulation.variables().len() as u32;
            Ok(())
        });
    }
    count
}

/// Describes variable number `variable`, from 0 on.
///
/// # Safety
/// `simulation` is null or was made here and not freed; `description` is null or may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn jostle_variable(
    simulation: *const JostleSimulation,
    variable: u32,
    description: *mut JostleVariable,
) -> JostleStatus {
    // SAFETY: passed on.
    unsafe {
        enter(simulation, Access::Read, |inner| {
            let variables = inner.simulation.variables();
            let row = variables
                .get(variable as usize)
                .ok_or_else(|| unknown(variables, variable))?;
            let texts = inner.texts.get_or_insert_with(|| VariableTexts::new(variables));
            memory::write(description, describe(row, texts.at(variable as usize)), "description")
        })
    }
}

fn describe(row: &Variable, [name, unit, description, options]: [*const c_char; 4]) -> JostleVariable {
    let kind = match &row.kind {
        scene::Kind::Real(_) | scene::Kind::Single(_) => JostleKind::Real,
        scene::Kind::Integer { .. }
        | scene::Kind::Long { .. }
        | scene::Kind::Sized { .. }
        | scene::Kind::Boolean { .. }
        // By their lengths: no scene has any.
        | scene::Kind::Text { .. }
        | scene::Kind::Binary { .. } => JostleKind::Integer,
        scene::Kind::Enumeration { .. } => JostleKind::Enumeration,
    };
    let [min, max] = row.kind.bounds();
    JostleVariable {
        name,
        unit,
        description,
        options,
        causality: match row.causality {
            scene::Causality::Parameter => JostleCausality::Parameter,
            scene::Causality::CalculatedParameter => JostleCausality::CalculatedParameter,
            scene::Causality::Input => JostleCausality::Input,
            scene::Causality::Output => JostleCausality::Output,
        },
        kind,
        min,
        max,
        start: row.start().to_f64(),
        tunable: row.tunable,
    }
}

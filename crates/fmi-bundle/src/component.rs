//! A model with all that is decided when its FMU is written: what every file of the FMU is made from.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use fmi_component::description::Description;
use fmi_component::handle::describe;
use fmi_component::{
    Error, Kind, ModelInfo, ModelType, Result, StructuralParameters, Table, Variable, Version, arrays, token,
};

use crate::importer::{Instance, Library};
use crate::legal::check;
use crate::run::{Linked, Loaded, MEND, Run};

/// Whose work the FMU is, and under which terms it may be used.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Notices {
    /// SPDX expression of the licence, such as `MIT`; empty for none.
    pub license: String,
    /// Line that says whose work it is, such as `Copyright (c) 2026 A. Author`; empty for none.
    pub copyright: String,
    /// Files for `documentation/licenses/`, each a name and a text: licences, notices of third parties.
    pub files: Vec<(String, String)>,
}

/// Picture of a component.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Icon {
    /// A PNG file.
    pub png: Vec<u8>,
    /// The same as an SVG file, for importers that show it large.
    pub svg: Option<String>,
}

/// Where a model comes from, for the documentation page. Whatever is empty is left out.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Origin {
    /// Who made it.
    pub authors: String,
    /// Address of its sources.
    pub repository: String,
    /// Where questions go: an address, or one that begins with `mailto:`.
    pub contact: String,
    /// Programs that it was built with, and their versions.
    pub tools: String,
    /// What is new in this version: HTML.
    pub changes: String,
}

/// Where the code of a model is.
#[derive(Clone)]
enum Source {
    /// In this program.
    Linked(ModelType),
    /// In a library.
    Loaded(Arc<Library>),
}

/// A model with its structural parameters and what its FMU is to hold besides.
#[derive(Clone)]
pub struct Component {
    source: Source,
    events: bool,
    input_parts: u32,
    contains_panics: bool,
    info: ModelInfo,
    structure: StructuralParameters,
    table: Arc<Table>,
    /// Variables with an index become arrays (FMI 3.0), see [`fmi_component::arrays`].
    pub arrays: bool,
    /// When the FMU was made, as `2026-11-24T06:00:00Z`; none where the same bytes are wanted each time.
    pub date: Option<String>,
    /// Licence and notices.
    pub notices: Notices,
    /// Where it comes from.
    pub origin: Origin,
    /// Picture of the component.
    pub icon: Option<Icon>,
    /// Command that compares the FMU with its reference trajectory, such as `mytool replay FILE.fmu`, for the documentation page.
    pub replay_command: Option<String>,
    /// Amplitude a of the oscillation a (1 - cos(omega t)) of an input with a derivative in the reference trajectory, from that
    /// input and omega \[rad/s\]. [`nominal_amplitude`] unless it is replaced.
    pub amplitude: fn(&Variable, f64) -> f64,
}

impl Component {
    /// The component of `model` with these structural parameters, the defaults for those that are not named; scalar variables,
    /// no date, notices or icon.
    ///
    /// # Errors
    /// A structural parameter that the model does not have, or out of its range; variables or facts of the model that no
    /// importer would read; a panic of the model.
    pub fn new(model: &ModelType, structure: &[(&str, u32)]) -> Result<Self> {
        let info = catch_defect("the facts of the model", model.info)?;
        let structure = StructuralParameters::choose(&info, structure)?;
        let variables = catch_defect("the variables of the model", || (model.variables)(&structure))?;
        let description = Description {
            info,
            structure: structure.iter().map(|(_, value)| value).collect(),
            variables,
            events: model.events,
            input_parts: model.input_parts,
            contains_panics: true,
        };
        Self::described(Source::Linked(*model), description)
    }

    /// The component that the library `bytes` exports by `export_fmu!`, with these structural parameters: the library tells what its
    /// model is, and is run for the reference trajectory and the documentation page. Everything else as by [`Component::new`],
    /// which gives an FMU of the same bytes.
    ///
    /// # Errors
    /// As of [`Component::new`]; the library is not for this system, or exports no model, or was built with a `fmi-component` whose
    /// description has another format.
    pub fn from_library(bytes: &[u8], structure: &[(&str, u32)]) -> Result<Self> {
        Self::of_library(Arc::new(Library::load(bytes)?), structure)
    }

    /// As [`Component::from_library`], of a library that was loaded.
    ///
    /// # Errors
    /// As there.
    pub(crate) fn of_library(library: Arc<Library>, structure: &[(&str, u32)]) -> Result<Self> {
        let choices: Vec<String> = structure
            .iter()
            .map(|(name, value)| format!("{name}={value}"))
            .collect();
        let description = library.describe(&choices.join("\n"))?;
        Self::described(Source::Loaded(library), description)
    }

    fn described(source: Source, description: Description) -> Result<Self> {
        let structure = description.structure()?;
        let table = Arc::new(Table::try_new(description.variables)?);
        check(&description.info, table.variables())?;
        Ok(Self {
            source,
            events: description.events,
            input_parts: description.input_parts,
            contains_panics: description.contains_panics,
            info: description.info,
            structure,
            table,
            arrays: false,
            date: None,
            notices: Notices::default(),
            origin: Origin::default(),
            icon: None,
            replay_command: None,
            amplitude: nominal_amplitude,
        })
    }

    /// The model, where it is linked with this program.
    pub fn model(&self) -> Option<&ModelType> {
        match &self.source {
            Source::Linked(model) => Some(model),
            Source::Loaded(_) => None,
        }
    }

    /// Whether the model has events that an importer may stop at.
    pub(crate) fn has_events(&self) -> bool {
        self.events
    }

    /// Parts of a step between which an importer may set inputs; 0 for none.
    pub(crate) fn input_parts(&self) -> u32 {
        self.input_parts
    }

    /// Whether an importer may be called inside of a step.
    pub(crate) fn updates_inside_steps(&self) -> bool {
        self.events || self.input_parts > 0
    }

    /// Whether a panic of the model stays in its instance: not in a library that was built with `panic = "abort"`, which ends the
    /// importer then.
    pub fn contains_panics(&self) -> bool {
        self.contains_panics
    }

    /// A run of the model, not started yet.
    ///
    /// # Errors
    /// The library does not make an instance.
    pub(crate) fn prepare(&self) -> Result<Box<dyn Run>> {
        match &self.source {
            Source::Linked(model) => Ok(Box::new(Linked((model.prepare)(self.structure.clone())))),
            Source::Loaded(_) => Ok(Box::new(Loaded {
                instance: self.instance(false)?,
                table: self.table.clone(),
                time: 0.0,
            })),
        }
    }

    /// An instance of the library, with array variables or not.
    ///
    /// # Errors
    /// The library does not make one; the model is linked with this program.
    pub(crate) fn instance(&self, arrays: bool) -> Result<Instance> {
        let token = token::write(&self.info, &self.structure, self.table.variables(), arrays);
        match &self.source {
            Source::Loaded(library) => Instance::new(library.clone(), &token),
            Source::Linked(_) => Err(Error::call("the model is in no library", "Make it of one.")),
        }
    }

    /// Static facts of the model.
    pub fn info(&self) -> &ModelInfo {
        &self.info
    }

    /// Structural parameters.
    pub fn structure(&self) -> &StructuralParameters {
        &self.structure
    }

    /// Variables for these structural parameters.
    pub fn table(&self) -> &Arc<Table> {
        &self.table
    }

    /// Instantiation token (FMI 3.0) or GUID (FMI 2.0).
    pub fn token(&self) -> String {
        token::write(&self.info, &self.structure, self.table.variables(), self.arrays)
    }

    /// Whether FMI of this version has the type of the variable at `position`.
    pub(crate) fn is_in(&self, version: Version, position: usize) -> bool {
        let is_binary = matches!(self.table.variables()[position].kind, Kind::Binary { .. });
        version == Version::Three || !is_binary
    }

    /// Names of the variables that an FMU of `version` leaves out: FMI 2.0 has no binary variables. Inputs keep their start values.
    pub fn left_out(&self, version: Version) -> Vec<&str> {
        let names = self.table.variables().iter().enumerate();
        names
            .filter(|(position, _)| !self.is_in(version, *position))
            .map(|(_, variable)| variable.name.as_str())
            .collect()
    }

    /// What wrote the FMU: package and version of the model.
    pub(crate) fn tool(&self) -> String {
        format!("{} {}", self.info.package, self.info.version)
    }

    /// For each position of the table how many elements the FMU's variable has that begins there: 1 for a scalar, 0 inside an
    /// array.
    pub(crate) fn spans(&self) -> Vec<usize> {
        let variables = self.table.variables();
        match self.arrays {
            true => arrays::spans(variables),
            false => vec![1; variables.len()],
        }
    }

    /// Name in the FMU of the variable at `position`, where one begins.
    pub(crate) fn name_at(&self, position: usize) -> &str {
        let variable = &self.table.variables()[position];
        match self.is_array(position) {
            true => arrays::name(&variable.name),
            false => &variable.name,
        }
    }

    /// Names of the FMU's variables.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        let begins = |(position, span): (usize, usize)| (span > 0).then(|| self.name_at(position));
        self.spans().into_iter().enumerate().filter_map(begins)
    }

    /// Whether the FMU's variable that begins at `position` is an array.
    pub(crate) fn is_array(&self, position: usize) -> bool {
        self.arrays && arrays::begins(&self.table.variables()[position])
    }

    /// Lengths of the array that begins at `position`, the outermost first; none of a scalar.
    pub(crate) fn dimensions(&self, position: usize) -> Vec<usize> {
        let rows = self.table.variables().get(position..).filter(|_| self.arrays);
        rows.and_then(arrays::dimensions).unwrap_or_default()
    }
}

impl std::fmt::Debug for Component {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "Component({})", self.token())
    }
}

/// What `work` gives, which runs code of the model; a panic of it as an error.
///
/// # Errors
/// The model panics.
pub(crate) fn catch_defect<T>(what: &str, work: impl FnOnce() -> T) -> Result<T> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| Error::call(format!("{what}: {}", describe(&*panic)), MEND))
}

/// The nominal value of a real input.
pub fn nominal_amplitude(input: &Variable, _omega: f64) -> f64 {
    match &input.kind {
        Kind::Real(quantity) => quantity.nominal,
        _ => 1.0,
    }
}

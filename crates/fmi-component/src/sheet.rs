//! What the data sheet of a model says besides its variables: the page `documentation/index.html` inside of its FMU.

use serde::{Deserialize, Serialize};

use crate::leaked::leaked;

/// A symbol of the equations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Symbol {
    /// HTML of the symbol.
    pub symbol: &'static str,
    /// Variable that it stands for, whose unit the page shows; empty for none. A symbol of a variable that the model does not
    /// have is left out.
    pub variable: &'static str,
    /// What it is, HTML.
    pub meaning: &'static str,
}

/// A run whose picture is on the page: from the start values, under the inputs of the reference trajectory.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ExampleRun {
    /// Duration \[s\].
    pub duration: f64,
    /// Communication steps, after each of which a point is drawn.
    pub steps: u32,
    /// Inputs and outputs that are drawn, one above the other; those that the model does not have are left out.
    #[serde(deserialize_with = "leaked")]
    pub curves: &'static [&'static str],
    /// One sentence that says what is to be seen, HTML.
    pub about: &'static str,
}

/// The data sheet of a model. Whatever is empty is left out of the page.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DataSheet {
    /// What the model is for: some sentences of HTML.
    pub purpose: &'static str,
    /// Where it is wrong or refuses to run: a list of HTML fragments.
    pub limits: Vec<&'static str>,
    /// What the run does where inputs stay at zero, as importers leave them: HTML.
    pub without_inputs: &'static str,
    /// Fragments of SVG that are drawn one over the other, in a view box of 320 by 240 with y downwards. The page defines the classes
    /// `body`, `wall`, `base`, `thin`, `axis`, `in` (what goes into the model) and `out` (what comes out), and markers
    /// `#tip`, `#tip-in` and `#tip-out` for the ends of arrows.
    pub picture: Vec<&'static str>,
    /// Outputs that most users connect, in the order in which the diagram shows them; `disk.angle` stands for `disk.angle[1]` and so
    /// on. Those that the model does not have are left out. Without any the diagram shows the first.
    pub outputs: Vec<&'static str>,
    /// Parameters that most users set, which the diagram shows with their start values: of models that have no inputs above all.
    pub parameters: Vec<&'static str>,
    /// Symbols of the equations.
    pub symbols: Vec<Symbol>,
    /// The run that the page shows. Without one it shows the reference trajectory.
    pub example: Option<ExampleRun>,
}

impl DataSheet {
    /// Nothing but the variables.
    pub const EMPTY: Self = Self {
        purpose: "",
        limits: Vec::new(),
        without_inputs: "",
        picture: Vec::new(),
        outputs: Vec::new(),
        parameters: Vec::new(),
        symbols: Vec::new(),
        example: None,
    };
}

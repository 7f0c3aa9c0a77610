//! The texts of a simulation's variables, for callers that keep pointers to them.

use std::ffi::{CString, c_char};

use jostle::Error;
use jostle::scene::Variable;

/// The texts of all variables of a simulation.
pub struct VariableTexts {
    texts: Vec<[CString; 4]>,
}

impl VariableTexts {
    pub fn new(rows: &[Variable]) -> Self {
        // No text of a scene holds a zero byte.
        let text = |text: &str| CString::new(text.replace('\0', "")).unwrap_or_default();
        let texts = rows.iter().map(|row| {
            let options = row.kind.options().collect::<Vec<_>>().join(",");
            let unit = row.kind.unit().name;
            [text(&row.name), text(unit), text(&row.description), text(&options)]
        });
        Self { texts: texts.collect() }
    }

    /// Name, unit, description and options of the variable at `position`. They live as long as this value.
    pub fn at(&self, position: usize) -> [*const c_char; 4] {
        self.texts[position].each_ref().map(|text| text.as_ptr())
    }
}

/// The refusal of a number that no variable has.
pub fn unknown(variables: &[Variable], variable: u32) -> Error {
    Error::parameter(
        "variable",
        variable,
        format!("0 to {}", variables.len() - 1),
        "Take the numbers from jostle_find or jostle_variable.",
    )
}

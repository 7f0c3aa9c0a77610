//! What an importer of a model passes when it makes an instance.

use fmi_component::{ModelType, StructuralParameters, token};

/// Tokens of the model with each of these structural parameters, with and without array variables, and the most variables that
/// one of them has.
pub fn of(model: &ModelType, choices: &[&[(&str, u32)]]) -> (Vec<String>, usize) {
    let (mut tokens, mut variables, info) = (Vec::new(), 0, (model.info)());
    for chosen in choices {
        let structure = StructuralParameters::choose(&info, chosen).expect("in range");
        let table = (model.variables)(&structure);
        variables = variables.max(table.len());
        tokens.extend([false, true].map(|arrays| token::write(&info, &structure, &table, arrays)));
    }
    (tokens, variables)
}

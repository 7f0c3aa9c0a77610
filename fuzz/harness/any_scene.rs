//! Every scene of the catalogue behind one library, chosen by the token: a program holds the exported functions only once. All
//! do little work in a call, so that the boundary is tried and not the patience.

use std::ops::RangeInclusive;

use fmi_component::{DynSimulation, ModelInfo, ModelType, StructuralParameter, StructuralParameters, Variable};
use jostle::scene::catalogue::MODELS;

fmi_component::export_fmu!(dyn &super::ANY_SCENE);

pub use fmi_component::c_api::{Boolean, CallbackFunctions, Fmi2Log, IntermediateUpdate, Opaque, Status};

/// All scenes as one model, whose structural parameters are the position in the catalogue and the number of disks.
pub const ANY_SCENE: ModelType = ModelType {
    info,
    events: true,
    input_parts: 4,
    variables,
    prepare,
};

/// Longest step that is asked for \[s\].
pub const LONGEST_STEP: f64 = 0.05;

/// Work of one call.
const MOST_WORK: u64 = 2000;

fn info() -> ModelInfo {
    let parameter = |name, range: RangeInclusive<u32>| StructuralParameter {
        name,
        description: "",
        default: *range.start(),
        range,
    };
    let last = MODELS.len() as u32 - 1;
    ModelInfo {
        name: "any",
        variant: Vec::new(),
        structure: vec![parameter("scene", 0..=last), parameter("disks", 1..=3)],
        ..(MODELS[0].info)()
    }
}

/// The scene and its own structural parameters.
fn chosen(structure: &StructuralParameters) -> (&'static ModelType, StructuralParameters) {
    let model = MODELS[structure.get("scene") as usize];
    let info = (model.info)();
    let disks = structure.get("disks").min(*info.structure[0].range.end());
    match StructuralParameters::choose(&info, &[("disks", disks)]) {
        Ok(structure) => (model, structure),
        Err(error) => panic!("{error}"),
    }
}

fn variables(structure: &StructuralParameters) -> Vec<Variable> {
    let (model, structure) = chosen(structure);
    (model.variables)(&structure)
}

fn prepare(structure: StructuralParameters) -> Box<dyn DynSimulation> {
    let (model, structure) = chosen(&structure);
    let mut simulation = (model.prepare)(structure);
    simulation.limit_work(MOST_WORK);
    simulation
}

/// Each scene with one disk, and with three if it may have so many.
pub fn choices() -> Vec<[(&'static str, u32); 2]> {
    let scenes = MODELS.iter().zip(0..);
    let choices = scenes.flat_map(|(model, scene)| {
        let several = (model.info)().structure[0].range.contains(&3);
        let disks: &[u32] = if several { &[1, 3] } else { &[1] };
        disks.iter().map(move |&disks| [("scene", scene), ("disks", disks)])
    });
    choices.collect()
}

/// Tokens of all choices, with and without array variables, and the most variables that one has.
pub fn tokens() -> (Vec<String>, usize) {
    let choices = choices();
    let structures: Vec<&[(&str, u32)]> = choices.iter().map(<[_; 2]>::as_slice).collect();
    super::tokens::of(&ANY_SCENE, &structures)
}

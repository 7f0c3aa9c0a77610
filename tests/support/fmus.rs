//! Scenes as they are put into FMUs.

use fmi_bundle::{Component, Notices, nominal_amplitude};
use fmi_component::{Kind, ModelType, Unit, Variable};

/// The scene with so many disks, or the most that it takes, licensed as the command line does it.
pub fn component(model: &ModelType, disks: u32) -> Component {
    let range = &(model.info)().structure[0].range;
    let mut component = Component::new(model, &[("disks", disks.min(*range.end()))]).unwrap();
    let mit = include_str!("../../LICENSE-MIT");
    component.notices = Notices {
        license: env!("CARGO_PKG_LICENSE").into(),
        copyright: mit.lines().find(|line| line.starts_with("Copyright")).unwrap().into(),
        files: Vec::new(),
    };
    component.amplitude = amplitude;
    component
}

/// A base is shaken at twice gravity.
fn amplitude(input: &Variable, omega: f64) -> f64 {
    match &input.kind {
        Kind::Real(quantity) if quantity.unit == Unit::METRE => 20.0 / omega.powi(2),
        _ => nominal_amplitude(input, omega),
    }
}

//! The data sheets of the scenes: what they name is there, their defaults move something, and no default is outside of what is
//! recommended.

#![allow(clippy::unwrap_used)]

use std::io::{Cursor, Read};

use fmi_bundle::{Component, Platform, Version, pack};
use fmi_component::{Causality, ExampleRun, Kind, ModelType, Value};
use jostle::scene::catalogue::MODELS;
use zip::ZipArchive;

#[path = "../crates/fmi-bundle/tests/support/fakes.rs"]
#[allow(dead_code)] // what other tests use
mod fakes;
#[path = "support/fmus.rs"]
mod fmus;

/// Bytes of a page without its tables of variables.
const LARGEST_PAGE: usize = 60_000;
/// Bytes of the picture of a run.
const LARGEST_PICTURE: usize = 30_000;

fn page(component: &Component) -> String {
    let mut archive = ZipArchive::new(Cursor::new(
        pack(component, Version::Three, &fakes::libraries(&[Platform::X86Linux])).unwrap(),
    ))
    .unwrap();
    let mut text = String::new();
    let mut entry = archive.by_name("documentation/index.html").unwrap();
    entry.read_to_string(&mut text).unwrap();
    text
}

fn components() -> impl Iterator<Item = (Component, String)> {
    MODELS.iter().map(|model| {
        let component = fmus::component(model, 60);
        let names: Vec<&str> = component.info().variant.iter().map(|(_, value)| *value).collect();
        let name = format!("{} {}", component.info().name, names.join(" "));
        (component, name)
    })
}

fn example(component: &Component) -> ExampleRun {
    component.info().sheet.example.unwrap()
}

#[test]
fn pages_are_light_and_show_their_run_to_its_end() {
    for (component, name) in components() {
        let page = page(&component);
        let tables = page.find("<h3 id=\"parameters\">").unwrap()..page.find("<h2 id=\"fmi\">").unwrap();
        assert!(
            page.len() - tables.len() < LARGEST_PAGE,
            "{name}: {}",
            page.len() - tables.len()
        );
        let picture = page.find("<svg class=\"curves\"").unwrap();
        let length = page[picture..].find("</svg>").unwrap();
        assert!(length < LARGEST_PICTURE, "{name}: {length}");
        assert!(!page.contains("The run ends early"), "{name}");
    }
}

#[test]
fn a_sheet_names_variables_of_its_scene_and_each_name_is_there_in_some_variant() {
    for (component, name) in components() {
        let (sheet, table) = (&component.info().sheet, component.table());
        let known = |wanted: &str, of: &Component| {
            of.table()
                .position(wanted)
                .or(of.table().position(&format!("{wanted}[1]")))
                .is_some()
        };
        assert!(
            !sheet.purpose.is_empty() && sheet.limits.len() > 4 && !sheet.picture.is_empty(),
            "{name}"
        );
        for curve in example(&component).curves {
            assert!(table.position(curve).is_some(), "{name}: no variable {curve}");
        }
        let symbols = sheet
            .symbols
            .iter()
            .map(|symbol| symbol.variable)
            .filter(|variable| !variable.is_empty());
        for wanted in sheet.outputs.iter().chain(&sheet.parameters).copied().chain(symbols) {
            let scene = components().filter(|(other, _)| other.info().name == component.info().name);
            assert!(
                scene.into_iter().any(|(other, _)| known(wanted, &other)),
                "{name}: no variant has {wanted}"
            );
        }
        let inputs = table
            .variables()
            .iter()
            .any(|variable| variable.derivative.is_some() && variable.causality == Causality::Input);
        assert_eq!(
            inputs,
            !sheet.without_inputs.is_empty(),
            "{name} says what happens without inputs if it has any"
        );
    }
}

/// Angles, places and velocities of the disks after `seconds` of a run by itself, less those at its start.
fn moved(model: &ModelType, seconds: f64) -> (f64, f64) {
    let component = fmus::component(model, 20);
    let mut simulation = (model.prepare)(component.structure().clone());
    simulation.start(0.0).unwrap();
    let of = |stem: &str, simulation: &dyn jostle::scene::DynSimulation| -> Vec<f64> {
        let variables = component.table().variables().iter().enumerate();
        let named = variables.filter(|(_, variable)| variable.name.starts_with(stem));
        named
            .map(|(position, _)| simulation.value(position).unwrap().to_f64())
            .collect()
    };
    let stems = ["disk.angle[", "disk.y["];
    let before = stems.map(|stem| of(stem, &*simulation));
    let step = component.info().step_size;
    let mut largest = [0.0_f64; 2];
    for count in 1..=(seconds / step).ceil() as u32 {
        simulation.advance_to(f64::from(count) * step).unwrap();
        for (index, stem) in stems.iter().enumerate() {
            let now = of(stem, &*simulation);
            let differences = now.iter().zip(&before[index]).map(|(now, before)| (now - before).abs());
            largest[index] = differences.fold(largest[index], f64::max);
        }
    }
    (largest[0], largest[1])
}

/// With defaults alone, as a user sees it who imports the FMU and presses run: disks turn by more than a thousandth of a radian, but
/// for the supports that shake at random, which turn the disk by less in so short a time.
#[test]
fn what_is_driven_from_inside_moves_with_the_default_parameters() {
    for model in MODELS {
        let info = (model.info)();
        let drive = info.variant_of("drive").unwrap();
        if drive == "input" {
            continue;
        }
        let (turned, risen) = moved(model, 2.0);
        let least = if drive == "random-supports" { 1e-5 } else { 1e-3 };
        assert!(
            turned > least && risen > 0.0,
            "{} {drive}: turned {turned} rad, rose {risen} m",
            info.name
        );
    }
}

#[test]
fn no_start_value_is_outside_of_what_is_recommended_and_each_scene_recommends() {
    for (component, name) in components() {
        let mut simulation = (component.model().unwrap().prepare)(component.structure().clone());
        simulation.start(0.0).unwrap();
        assert_eq!(simulation.warnings(&[]), [], "{name}");
        let recommended = component
            .table()
            .variables()
            .iter()
            .filter(|variable| variable.recommended.is_some());
        assert!(recommended.count() >= 4, "{name}");
    }
}

/// Who gives a value that is allowed and makes no sense is told of it by name.
#[test]
fn values_outside_of_what_is_recommended_are_warned_of_by_name_range_and_reason() {
    let warned = |scene: &str, engine: &str, drive: &str, name: &str, value: f64| {
        let model = jostle::scene::catalogue::find(scene, Some(engine), Some(drive)).unwrap();
        let component = fmus::component(model, 3);
        let mut simulation = (model.prepare)(component.structure().clone());
        let position = simulation.position(name).unwrap();
        simulation.set_at(position, Value::Real(value)).unwrap();
        simulation.start(0.0).unwrap();
        let warnings = simulation.warnings(&[]);
        warnings
            .into_iter()
            .map(|warning| warning.text)
            .find(|text| text.starts_with(name))
            .unwrap_or_default()
    };
    for (scene, engine, drive, name, value, told) in [
        (
            "packing",
            "molecular-dynamics",
            "sine",
            "contact.friction",
            5.0,
            "5 is outside of the recommended range (0 to 1.5)",
        ),
        // 3.57 pi 0.025 9.8 / 100
        (
            "packing",
            "molecular-dynamics",
            "input",
            "contact.normal_stiffness",
            100.0,
            "over its radius 0.0275, outside",
        ),
        // 0.1 kg/s is 1.4 % of the critical damping
        (
            "packing",
            "event-driven",
            "sine",
            "contact.normal_damping",
            30.0,
            "damping ratio of the two smallest disks 4.22",
        ),
        // half of the acceleration of the default, Gamma = 2
        (
            "packing",
            "event-driven",
            "sine",
            "drive.amplitude",
            3.8785e-5,
            "over gravity 1, outside of the recommended range (at least 1.2)",
        ),
        ("ratchet", "event-driven", "sine", "drive.frequency", 1.0, ""),
        (
            "ratchet",
            "event-driven",
            "sine",
            "collision.restitution",
            1.0,
            "(0.3 to 0.98)",
        ),
        ("wedge", "map", "sine", "wedge.aperture", 1.1, "1.1 rad is outside"),
        (
            "three_disk",
            "molecular-dynamics",
            "input",
            "contact.friction",
            2.0,
            "the supports jam the disk",
        ),
    ] {
        let text = warned(scene, engine, drive, name, value);
        assert!(text.contains(told), "{scene} {name}: {text}");
        assert_eq!(text.is_empty(), told.is_empty(), "{scene} {name}: {text}");
    }
}

/// The bounds lie inside of what is allowed where both are of the same quantity.
#[test]
fn recommended_ranges_lie_inside_of_what_is_allowed() {
    for (component, name) in components() {
        for variable in component.table().variables() {
            let (Some(recommended), Kind::Real(quantity)) = (&variable.recommended, &variable.kind) else {
                continue;
            };
            let (start, end) = (*recommended.range.start(), *recommended.range.end());
            assert!(
                start < end && !recommended.reason.is_empty(),
                "{name}: {}",
                variable.name
            );
            let inside = quantity.min <= start && end <= quantity.max;
            assert!(recommended.of.is_some() || inside, "{name}: {}", variable.name);
        }
    }
}

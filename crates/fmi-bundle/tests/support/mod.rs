//! The oscillators of `fmi-component` as a component with all that an FMU may hold.

#[allow(dead_code)] // not each of the tests needs libraries that are none
pub mod fakes;

use std::path::PathBuf;

use fmi_bundle::{Component, Icon, Libraries, Notices, find_library};
use fmi_component::ModelType;
use oscillators::Oscillators;

pub const MODEL: ModelType = ModelType::of::<Oscillators>();

#[allow(dead_code)] // not each of the tests needs it
pub fn component() -> Component {
    let mut component = Component::new(&MODEL, &[]).unwrap();
    component.notices = Notices {
        license: "MIT".into(),
        copyright: "Copyright (c) 2026 A. & B. Author".into(),
        files: vec![("LICENSE-MIT.txt".into(), "Permission is hereby granted".into())],
    };
    component.icon = Some(Icon {
        png: b"\x89PNG".into(),
        svg: Some("<svg/>".into()),
    });
    component.replay_command = Some("mytool replay FILE.fmu".into());
    component
}

/// The library that cargo built for these tests: beside them, or one folder above.
#[allow(dead_code)] // not each of the tests loads it
pub fn library() -> PathBuf {
    let program = std::env::current_exe().unwrap();
    let folders: Vec<_> = program.ancestors().skip(1).take(2).collect();
    find_library("oscillators", &folders).unwrap()
}

/// A folder for the files of one test, which is made anew.
#[allow(dead_code)] // not each of the tests writes files
pub fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("fmi bundle {name} {}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// The library of [`library`] alone.
#[allow(dead_code)] // not each of the tests loads it
pub fn libraries() -> Libraries {
    Libraries::from_file(&library()).unwrap()
}

//! The two models that `benches/beside_c.rs` compares give the same numbers. Nothing here depends on how long anything takes.
#![allow(unsafe_code)] // plays the importer

#[path = "../benches/beside_c/instance.rs"]
mod instance;
#[path = "../benches/beside_c/libraries.rs"]
mod libraries;
#[path = "../examples/ten_reals.rs"]
mod ten_reals;

use std::path::Path;
use std::ptr::null_mut;

use fmi_component::c_api::Status::{Error, Ok};
use fmi_component::{Export, ModelType};
use instance::{Calls, INPUTS, OUTPUTS, TOKEN_IN_C, Three, Two};
use libloading::Library;
pub use ten_reals::TenReals;

const STEP: f64 = 1.0 / 1024.0;

/// All that the calls of the benchmark give, in one list.
fn numbers<C: Calls>(library: &Library, token: &str) -> Vec<f64> {
    let u: Vec<f64> = (1..=10).map(|index| 0.1 * f64::from(index)).collect();
    let instance = C::ready(library, token, &u);
    let mut numbers = Vec::new();
    let read = |numbers: &mut Vec<f64>| {
        for references in [&[0][..], &INPUTS, &OUTPUTS, &[20, 1, 11]] {
            let mut values = vec![f64::NAN; references.len()];
            assert_eq!(instance.get(references, &mut values), Ok);
            numbers.extend(values);
        }
    };
    read(&mut numbers);
    assert_eq!(instance.step(0.0, STEP), Ok, "FMI {}", C::VERSION);
    let mut state = null_mut();
    assert_eq!(instance.save(&mut state), Ok);
    assert_eq!(instance.set(&INPUTS, &[7.0; 10]), Ok);
    assert_eq!(instance.step(STEP, STEP), Ok);
    read(&mut numbers);
    assert_eq!((instance.save(&mut state), instance.set(&[3], &[8.0])), (Ok, Ok));
    read(&mut numbers);
    assert_eq!(instance.restore(state), Ok);
    read(&mut numbers);
    assert_eq!((instance.forget(&mut state), state), (Ok, null_mut()));
    numbers
}

/// What each of the checks of the benchmark's models refuses.
fn check_refusals<C: Calls>(library: &Library, token: &str) {
    let instance = || C::ready(library, token, &[0.0; 10]);
    assert_eq!(instance().step(0.5, STEP), Error, "a step from elsewhere");
    assert_eq!(instance().step(0.0, 0.0), Error, "a step of length zero");
    assert_eq!(instance().get(&[21], &mut [0.0]), Error, "an unknown reference");
    assert_eq!(instance().set(&[11], &[0.0]), Error, "an output");
    assert_eq!(instance().restore(null_mut()), Error, "no state");
}

#[test]
fn the_model_in_rust_and_the_model_in_c_give_the_same_numbers() {
    let source = match libraries::in_c() {
        Result::Ok(source) => source,
        Err(why) => return eprintln!("left out: {why}"),
    };
    let tests = std::env::current_exe().expect("a program");
    let examples = tests
        .parent()
        .and_then(Path::parent)
        .expect("a folder of cargo's")
        .join("examples");
    let (rust, c) = (instance::open(&libraries::in_rust(&examples)), instance::open(&source));
    std::fs::remove_file(source).expect("it was made"); // loaded
    let token = instance::token(&ModelType::of::<<TenReals as Export>::Model>());
    let expected = numbers::<Two>(&c, TOKEN_IN_C);
    assert_eq!(expected[11..15], [0.2, 0.4, 2.0 * 0.1 * 3.0, 0.8], "twice the inputs");
    assert_eq!(numbers::<Two>(&rust, &token), expected);
    assert_eq!(numbers::<Three>(&rust, &token), expected);
    assert_eq!(numbers::<Three>(&c, TOKEN_IN_C), expected);
    check_refusals::<Two>(&rust, &token);
    check_refusals::<Three>(&rust, &token);
    check_refusals::<Two>(&c, TOKEN_IN_C);
    check_refusals::<Three>(&c, TOKEN_IN_C);
}

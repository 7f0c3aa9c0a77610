//! The calls that an importer makes most, beside the same model written in C: `cargo bench -p fmi-component --bench beside_c`.
//!
//! The model has ten real inputs, ten real outputs and an empty step. In Rust it is `examples/ten_reals.rs`, built as a library in
//! release mode; in C it is `benches/beside_c/ten_reals.c`, compiled by `cc -O3`. Both are loaded as an importer loads them. What is
//! printed is the median of the CPU time of a call, in turns of one and the other. The words `calls N` as arguments make each N times
//! without a clock, for callgrind.
#![allow(unsafe_code)] // plays the importer

#[path = "beside_c/instance.rs"]
mod instance;
#[path = "beside_c/libraries.rs"]
mod libraries;
#[path = "../examples/ten_reals.rs"]
mod ten_reals;

use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr::null_mut;

use cpu_time::ThreadTime;
use fmi_component::c_api::Status;
use fmi_component::{Export, ModelType};
use instance::{Calls, INPUTS, OUTPUTS, TOKEN_IN_C, Three, Two};
use libloading::Library;
pub use ten_reals::TenReals;

/// Turns of one and the other; the median counts.
const TURNS: usize = 31;
/// Calls in a turn.
const CALLS: u32 = 100_000;
/// A step whose multiples are exact \[s\].
const STEP: f64 = 1.0 / 1024.0;

/// What is measured: a name, and what is done so many times by an instance at a step number.
type Work<C> = (&'static str, fn(&C, u32, u32));

fn works<C: Calls>() -> [Work<C>; 6] {
    [
        ("empty step", |instance, first, count| {
            for number in first..first + count {
                let time = f64::from(number) * STEP;
                assert_eq!(instance.step(time, STEP), Status::Ok);
            }
        }),
        ("get ten reals", |instance, _, count| {
            let mut values = [0.0; 10];
            for _ in 0..count {
                assert_eq!(instance.get(&OUTPUTS, black_box(&mut values)), Status::Ok);
            }
        }),
        ("set ten reals", |instance, _, count| {
            let values = [1.5; 10];
            for _ in 0..count {
                assert_eq!(instance.set(&INPUTS, black_box(&values)), Status::Ok);
            }
        }),
        ("save a state over the last", |instance, _, count| {
            let mut state = null_mut();
            for _ in 0..count {
                assert_eq!(instance.save(black_box(&mut state)), Status::Ok);
            }
            assert_eq!(instance.forget(&mut state), Status::Ok);
        }),
        ("save a new state, free it", |instance, _, count| {
            for _ in 0..count {
                let mut state = null_mut();
                assert_eq!(instance.save(black_box(&mut state)), Status::Ok);
                assert_eq!(instance.forget(black_box(&mut state)), Status::Ok);
            }
        }),
        ("restore a state", |instance, _, count| {
            let mut state = null_mut();
            assert_eq!(instance.save(&mut state), Status::Ok);
            for _ in 0..count {
                assert_eq!(instance.restore(black_box(state)), Status::Ok);
            }
            assert_eq!(instance.forget(&mut state), Status::Ok);
        }),
    ]
}

/// Nanoseconds of CPU time of one call.
fn time<C: Calls>(work: Work<C>, instance: &C, first: u32) -> f64 {
    let start = ThreadTime::now();
    work.1(instance, first, CALLS);
    start.elapsed().as_secs_f64() / f64::from(CALLS) * 1e9
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn compare<C: Calls>(rust: &Library, c: &Library, token: &str) {
    let u = [1.0; 10];
    for work in works::<C>() {
        let (ours, theirs) = (C::ready(rust, token, &u), C::ready(c, TOKEN_IN_C, &u));
        let (mut rust, mut c) = (Vec::new(), Vec::new());
        for turn in 0..TURNS as u32 {
            rust.push(time(work, &ours, turn * CALLS));
            c.push(time(work, &theirs, turn * CALLS));
        }
        let (rust, c) = (median(rust), median(c));
        println!(
            "FMI {}  {:27} {rust:7.1} ns {c:7.1} ns {:7.2}",
            C::VERSION,
            work.0,
            rust / c
        );
    }
}

/// The library in release mode. (The profile `bench` is that with the names for profilers, so that nothing is compiled twice.)
fn in_rust() -> Result<PathBuf, String> {
    let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    cargo.args(["build", "--quiet", "--profile", "bench"]);
    cargo.args(["--package", "fmi-component", "--example", "ten_reals"]);
    cargo.current_dir(env!("CARGO_MANIFEST_DIR"));
    libraries::run(&mut cargo)?;
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let release = program.parent().and_then(Path::parent).ok_or("no folder of cargo's")?;
    Ok(libraries::in_rust(&release.join("examples")))
}

fn processor() -> String {
    let facts = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = facts
        .lines()
        .find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
    name.unwrap_or("processor not known").into()
}

/// Makes each call so many times by one library, for a program that counts instructions.
fn only_call<C: Calls>(library: &Library, token: &str, what: &str, calls: u32) {
    let instance = C::ready(library, token, &[1.0; 10]);
    for (name, work) in works::<C>() {
        if name == what {
            work(&instance, 0, calls);
        }
    }
}

fn main() -> Result<(), String> {
    let (rust, c) = (instance::open(&in_rust()?), instance::open(&libraries::in_c()?));
    let token = instance::token(&ModelType::of::<<TenReals as Export>::Model>());
    let words: Vec<String> = std::env::args().skip_while(|word| word != "calls").collect();
    if let [_, language, version, what, calls] = &words[..] {
        let calls = calls.parse().map_err(|error| format!("{calls}: {error}"))?;
        let (library, token) = if language == "c" {
            (&c, TOKEN_IN_C)
        } else {
            (&rust, &token[..])
        };
        match &version[..] {
            "2" => only_call::<Two>(library, token, what, calls),
            _ => only_call::<Three>(library, token, what, calls),
        }
        return Ok(());
    }
    println!("{}, median of {TURNS} turns of {CALLS} calls, CPU time", processor());
    println!("{:36} {:>10} {:>10} {:>7}", "", "Rust", "C", "ratio");
    compare::<Two>(&rust, &c, &token);
    compare::<Three>(&rust, &c, &token);
    Ok(())
}

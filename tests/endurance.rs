//! A long-lived process: libraries loaded and unloaded, many instances at once, runs of a billion events, and
//! memory that does not grow.
//!
//! One test a process: run each alone when its figures matter, since all share the resident size.
#![allow(unsafe_code, clippy::unwrap_used, clippy::undocumented_unsafe_blocks)]

use std::ffi::{CString, c_char};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::ptr::{null, null_mut};

use fmi_component::c_api::{Fmi3Log, Opaque, Status};
use fmi_component::{ModelType, StructuralParameters, token};
use jostle::scene::packing::event_driven::HardPackingOnSine;
use jostle::scene::{AnySimulation, Selection};
use libloading::Library;
use oscillators::Oscillators;

/// Resident memory of this process \[KiB\].
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

type Instantiate = unsafe extern "C" fn(
    *const c_char,
    *const c_char,
    *const c_char,
    u8,
    u8,
    u8,
    u8,
    *const u32,
    usize,
    Opaque,
    Option<Fmi3Log>,
    Opaque,
) -> Opaque;
type Enter = unsafe extern "C" fn(Opaque, u8, f64, f64, u8, f64) -> Status;
type Simple = unsafe extern "C" fn(Opaque) -> Status;
type DoStep = unsafe extern "C" fn(Opaque, f64, f64, u8, *mut u8, *mut u8, *mut u8, *mut f64) -> Status;
type SetReal = unsafe extern "C" fn(Opaque, *const u32, usize, *const f64, usize) -> Status;

/// A library of an FMU with what a run of FMI 3.0 needs.
struct Fmu {
    instantiate: Instantiate,
    enter: Enter,
    exit: Simple,
    set: SetReal,
    step: DoStep,
    free: unsafe extern "C" fn(Opaque),
    _library: Library,
}

impl Fmu {
    fn load(path: &Path) -> Self {
        unsafe {
            let library = Library::new(path).unwrap();
            let get = |name: &str| *library.get::<*mut std::ffi::c_void>(name.as_bytes()).unwrap();
            Self {
                instantiate: std::mem::transmute::<*mut std::ffi::c_void, Instantiate>(get(
                    "fmi3InstantiateCoSimulation",
                )),
                enter: std::mem::transmute::<*mut std::ffi::c_void, Enter>(get("fmi3EnterInitializationMode")),
                exit: std::mem::transmute::<*mut std::ffi::c_void, Simple>(get("fmi3ExitInitializationMode")),
                set: std::mem::transmute::<*mut std::ffi::c_void, SetReal>(get("fmi3SetFloat64")),
                step: std::mem::transmute::<*mut std::ffi::c_void, DoStep>(get("fmi3DoStep")),
                free: std::mem::transmute::<*mut std::ffi::c_void, unsafe extern "C" fn(Opaque)>(get(
                    "fmi3FreeInstance",
                )),
                _library: library,
            }
        }
    }

    /// An instance that may step, with these parameters.
    fn instance(&self, token: &CString, given: &[(u32, f64)]) -> Opaque {
        let (name, none) = (c"endurance".as_ptr(), null_mut());
        unsafe {
            let instance = (self.instantiate)(name, token.as_ptr(), null(), 0, 0, 0, 0, null(), 0, none, None, none);
            assert!(!instance.is_null());
            for (reference, value) in given {
                assert_eq!((self.set)(instance, reference, 1, value, 1), Status::Ok);
            }
            assert_eq!((self.enter)(instance, 0, 0.0, 0.0, 0, 0.0), Status::Ok);
            assert_eq!((self.exit)(instance), Status::Ok);
            instance
        }
    }

    fn step(&self, instance: Opaque, time: f64) -> Status {
        let ([mut event, mut terminate, mut early], mut reached) = ([0_u8; 3], 0.0);
        let flags = (&raw mut event, &raw mut terminate, &raw mut early);
        unsafe { (self.step)(instance, time, 0.01, 0, flags.0, flags.1, flags.2, &mut reached) }
    }

    fn free(&self, instance: Opaque) {
        unsafe { (self.free)(instance) }
    }
}

fn token_of(model: &ModelType, chosen: &[(&str, u32)]) -> CString {
    let info = (model.info)();
    let structure = StructuralParameters::choose(&info, chosen).unwrap();
    CString::new(token::write(&info, &structure, &(model.variables)(&structure), false)).unwrap()
}

/// Loads and unloads 2000 times, with `life` in between, and measures the memory.
fn load_two_thousand_times(path: &Path, life: impl Fn(&Fmu, u32)) {
    let mut settled = 0;
    for cycle in 0..2000 {
        life(&Fmu::load(path), cycle);
        if cycle == 199 {
            settled = resident();
        }
    }
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
    let file = path.file_name().unwrap().to_str().unwrap();
    let (grown, still) = (resident() - settled.min(resident()), maps.contains(file));
    eprintln!("{file}: after 200 cycles {settled} KiB, after 2000 {grown} KiB more; still mapped: {still}");
    assert!(grown < 1024, "{grown} KiB more");
    assert!(!still, "the library is not unloaded");
}

/// Oscillators, every hundredth time into a panic.
#[test]
fn two_thousand_loads_leave_memory_as_it_was() {
    // The loaded library reports its panics; a backtrace of each would keep memory.
    unsafe { std::env::set_var("RUST_BACKTRACE", "0") };
    let path = std::env::current_exe().unwrap().with_file_name("liboscillators.so");
    let model = ModelType::of::<Oscillators>();
    let token = token_of(&model, &[]);
    let variables = (model.variables)(&StructuralParameters::defaults(&(model.info)()));
    let is_panic_time = |variable: &fmi_component::Variable| variable.name == "fault.panic_time";
    let panic_time = 1 + variables.iter().position(is_panic_time).unwrap() as u32;
    load_two_thousand_times(&path, |fmu, cycle| {
        let panics = cycle % 100 == 99;
        let given = [(panic_time, 0.015)];
        let instance = fmu.instance(&token, if panics { &given } else { &[] });
        assert_eq!(fmu.step(instance, 0.0), Status::Ok);
        assert_eq!(
            fmu.step(instance, 0.01),
            if panics { Status::Error } else { Status::Ok }
        );
        fmu.free(instance);
    });
}

/// The library of a packing of ten hard disks, built as it is shipped.
fn packing() -> (PathBuf, CString) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("shipped");
    let build = Command::new(env!("CARGO"))
        .args([
            "build",
            "--release",
            "--package",
            "fmu-packing-event-driven-sine",
            "--target-dir",
        ])
        .arg(&folder)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .status();
    assert!(build.unwrap().success());
    let path = folder.join("release/libjostle_packing_event_driven_sine.so");
    (path, token_of(&ModelType::of::<HardPackingOnSine>(), &[("disks", 10)]))
}

#[test]
#[ignore = "builds the library of a scene"]
fn two_thousand_loads_of_a_packing_leave_memory_as_it_was() {
    let (path, token) = packing();
    load_two_thousand_times(&path, |fmu, _| {
        let instance = fmu.instance(&token, &[]);
        for step in 0..2 {
            assert_eq!(fmu.step(instance, 0.01 * f64::from(step)), Status::Ok);
        }
        fmu.free(instance);
    });
}

#[test]
#[ignore = "builds the library of a scene"]
fn a_thousand_packings_live_side_by_side() {
    let (path, token) = packing();
    let fmu = Fmu::load(&path);
    let before = resident();
    let instances: Vec<_> = (0..1000).map(|_| fmu.instance(&token, &[])).collect();
    let mut time = 0.0;
    for _ in 0..10 {
        for instance in &instances {
            assert_eq!(fmu.step(*instance, time), Status::Ok);
        }
        time += 0.01;
    }
    eprintln!("1000 instances take {} KiB", resident() - before);
    for instance in instances {
        fmu.free(instance);
    }
}

fn time_step(simulation: &AnySimulation) -> Option<f64> {
    let chosen = simulation.real("chosen_time_step");
    chosen.or_else(|_| simulation.real("time_step")).ok()
}

/// What a run of an engine has done: impacts, or steps of time.
fn events(simulation: &AnySimulation) -> f64 {
    let count = simulation.integer("collisions").map(|count| count as f64);
    let count = count.or_else(|_| simulation.real("collisions"));
    count.unwrap_or_else(|_| simulation.time() / time_step(simulation).unwrap())
}

/// One disk for a thousand million events, or as many as `ENDURANCE_EVENTS` says.
fn endure(scene: &str, engine: &str, drive: &str, given: &[(&str, &str)]) {
    let asked = std::env::var("ENDURANCE_EVENTS")
        .ok()
        .and_then(|text| text.parse().ok());
    let wanted = asked.unwrap_or(1e9);
    let selection = Selection {
        scene,
        engine: Some(engine),
        drive: Some(drive),
        disks: Some(1),
    };
    let mut simulation = AnySimulation::new(selection, given).unwrap();
    let step = time_step(&simulation).map_or(100.0, |step| 1e5 * step);
    let (begin, mut settled, mut calls) = (cpu_time::ProcessTime::now(), 0, 0_u32);
    while events(&simulation) < wanted {
        calls += 1;
        simulation.advance_to(step * f64::from(calls)).unwrap();
        if settled == 0 && events(&simulation) >= 0.01 * wanted {
            settled = resident();
        }
    }
    let grown = resident() - settled.min(resident());
    eprintln!(
        "{scene}, {engine}, {drive}: {:e} events in {} s, CPU {:.0} s; {settled} KiB, then {grown} KiB more",
        events(&simulation),
        simulation.time(),
        begin.elapsed().as_secs_f64()
    );
    assert!(grown < 256, "{grown} KiB more");
}

macro_rules! billions {
    ($($name:ident: $scene:literal, $engine:literal, $drive:literal, $given:expr;)*) => {
        /// Minutes each: `cargo test --release --test endurance billion -- --ignored --nocapture --test-threads 1`.
        mod a_billion_events_keep_memory_flat {
            $(#[test]
            #[ignore = "minutes"]
            fn $name() {
                super::endure($scene, $engine, $drive, &$given);
            })*
        }
    };
}

/// A disk that is thrown again and again.
const SHAKEN: [(&str, &str); 2] = [("drive.amplitude", "2e-3"), ("drive.frequency", "20")];

billions! {
    wedge_map: "wedge", "map", "sine", [];
    wedge_event_driven: "wedge", "event-driven", "sine", [];
    wedge_molecular_dynamics: "wedge", "molecular-dynamics", "sine", [("time_step", "1e-6")];
    packing_event_driven: "packing", "event-driven", "sine", [("drive.amplitude", "1e-4"), ("drive.frequency", "80")];
    packing_molecular_dynamics: "packing", "molecular-dynamics", "sine", super::SHAKEN;
    packing_located: "packing", "molecular-dynamics-located", "sine", super::SHAKEN;
    ratchet: "ratchet", "event-driven", "sine", [];
    three_disk_harmonic_torque: "three_disk", "molecular-dynamics", "harmonic-torque", [];
    three_disk_random_supports: "three_disk", "molecular-dynamics", "random-supports", [];
    three_disk_sine: "three_disk", "molecular-dynamics", "sine", [];
}

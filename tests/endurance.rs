//! A process that goes on and on: libraries loaded and unloaded, runs of a billion events, and memory that does not grow.
//!
//! One test a process: run each alone when its figures matter, since all share the resident size.
#![allow(unsafe_code, clippy::unwrap_used, clippy::undocumented_unsafe_blocks)]

use std::ffi::{CString, c_char};
use std::ptr::{null, null_mut};

use jostle::fmi::abi::common::{Opaque, Status};
use jostle::fmi::abi::logger::Fmi3Log;
use jostle::fmi::token;
use jostle::scene::wedge::WedgeMap;
use jostle::scene::{Choice, Scene, Simulation};
use libloading::Library;

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

/// Loads the probe's library, runs an instance, every tenth time into a panic, and unloads it.
fn life(path: &std::path::Path, token: &CString, panic_time: u32, panics: bool) {
    unsafe {
        let library = Library::new(path).unwrap();
        let get = |name: &str| *library.get::<*mut std::ffi::c_void>(name.as_bytes()).unwrap();
        let instantiate: Instantiate = std::mem::transmute(get("fmi3InstantiateCoSimulation"));
        let enter: Enter = std::mem::transmute(get("fmi3EnterInitializationMode"));
        let exit: Simple = std::mem::transmute(get("fmi3ExitInitializationMode"));
        let set: SetReal = std::mem::transmute(get("fmi3SetFloat64"));
        let step: DoStep = std::mem::transmute(get("fmi3DoStep"));
        let free: unsafe extern "C" fn(Opaque) = std::mem::transmute(get("fmi3FreeInstance"));
        let (name, none) = (c"probe".as_ptr(), null_mut());
        let instance = instantiate(name, token.as_ptr(), null(), 0, 0, 0, 0, null(), 0, none, None, none);
        assert!(!instance.is_null());
        if panics {
            assert_eq!(set(instance, &panic_time, 1, &0.015, 1), Status::Ok);
        }
        assert_eq!(enter(instance, 0, 0.0, 0.0, 0, 0.0), Status::Ok);
        assert_eq!(exit(instance), Status::Ok);
        let ([mut event, mut terminate, mut early], mut reached) = ([0_u8; 3], 0.0);
        let mut walk = |time| {
            step(
                instance,
                time,
                0.01,
                0,
                &mut event,
                &mut terminate,
                &mut early,
                &mut reached,
            )
        };
        assert_eq!(walk(0.0), Status::Ok);
        assert_eq!(walk(0.01), if panics { Status::Error } else { Status::Ok });
        free(instance);
    }
}

#[test]
fn two_thousand_loads_leave_memory_as_it_was() {
    // The loaded library tells its panics; looking up where they come from would keep memory.
    unsafe { std::env::set_var("RUST_BACKTRACE", "0") };
    let path = std::env::current_exe().unwrap().with_file_name("libfmu_probe.so");
    let choice = Choice { disks: 3 };
    let rows = fmu_probe::Probe::variables(choice);
    let token = CString::new(token::write(&fmu_probe::Probe::card(), choice, &rows)).unwrap();
    let panic_time = 1 + rows.iter().position(|row| row.name == "fault.panic_time").unwrap() as u32;
    let mut settled = 0;
    for cycle in 0..2000 {
        life(&path, &token, panic_time, cycle % 100 == 99);
        if cycle == 199 {
            settled = resident();
        }
    }
    let maps = std::fs::read_to_string("/proc/self/maps").unwrap();
    let (grown, still) = (resident() - settled.min(resident()), maps.contains("libfmu_probe.so"));
    eprintln!("after 200 cycles {settled} KiB, after 2000 {grown} KiB more; still mapped: {still}");
    assert!(grown < 1024, "{grown} KiB more");
    assert!(!still, "the library is not unloaded");
}

/// Some minutes: `cargo test --test endurance -- --ignored --nocapture`.
#[test]
#[ignore = "a billion impacts"]
fn a_billion_impacts_keep_memory_flat() {
    let mut wedge = Simulation::<WedgeMap>::new(1, &[]).unwrap();
    let (mut settled, mut impacts) = (0, 0_u64);
    for step in 1..=1_000_000_u64 {
        wedge.advance_to(100.0 * step as f64).unwrap();
        impacts = wedge.scene().state().engine.sums.collisions;
        if step == 1000 {
            settled = resident();
        }
        if impacts >= 1_000_000_000 {
            break;
        }
    }
    let grown = resident() - settled.min(resident());
    eprintln!(
        "{impacts} impacts in {} s; {settled} KiB, then {grown} KiB more",
        wedge.time()
    );
    assert!(
        impacts >= 1_000_000_000 && grown < 256,
        "{impacts} impacts, {grown} KiB more"
    );
}

//! What a C program cannot show: panics, threads, texts cut in the middle.
#![allow(clippy::unwrap_used, clippy::undocumented_unsafe_blocks)]

use std::ffi::{CStr, c_char};
use std::ptr::null_mut;

use jostle::scene::{AnySimulation, Simulation};
use oscillators::Oscillators;

use crate::JostleStatus::{Busy, Error, Failed, NoSimulation, Ok, StepRefused};
use crate::*;

/// Oscillators that panic or refuse when set to.
fn probe(given: &[(&str, f64)]) -> *mut JostleSimulation {
    let given: Vec<_> = given.iter().map(|&(name, value)| (name, value.into())).collect();
    handle::hand_out(AnySimulation::from(
        Simulation::<Oscillators>::new(&[], &given).unwrap(),
    ))
}

fn message_of(simulation: *const JostleSimulation) -> String {
    let mut text = [0 as c_char; 512];
    unsafe {
        assert!(jostle_error_text(simulation, text.as_mut_ptr(), text.len()) > 0);
        CStr::from_ptr(text.as_ptr()).to_str().unwrap().into()
    }
}

fn saved(simulation: *const JostleSimulation) -> Vec<u8> {
    let mut size = 0;
    unsafe {
        assert_eq!(jostle_save(simulation, null_mut(), 0, &mut size), Ok);
        let mut bytes = vec![0; size];
        assert_eq!(jostle_save(simulation, bytes.as_mut_ptr(), size, &mut size), Ok);
        bytes
    }
}

#[test]
fn a_panic_stays_in_its_simulation() {
    let (broken, sound) = (probe(&[("fault.panic_time", 0.5)]), probe(&[]));
    unsafe {
        assert_eq!(jostle_advance_to(broken, 0.4), Ok);
        let bytes = saved(broken);
        assert_eq!(jostle_advance_to(broken, 0.6), Failed);
        assert!(
            message_of(broken).contains("set to panic at 0.5 s"),
            "{}",
            message_of(broken)
        );
        assert_eq!(jostle_advance_to(broken, 0.45), Failed);
        let mut time = 0.0;
        assert_eq!((jostle_time(broken, &mut time), time), (Ok, 0.4));
        assert_eq!(jostle_advance_to(sound, 0.6), Ok);
        assert_eq!(jostle_restore(broken, bytes.as_ptr(), 3), Error);
        assert_eq!(jostle_advance_to(broken, 0.45), Failed);
        assert_eq!(jostle_restore(broken, bytes.as_ptr(), bytes.len()), Ok);
        assert_eq!(jostle_advance_to(broken, 0.45), Ok);
        jostle_free(broken);
        jostle_free(sound);
    }
}

#[test]
fn a_refused_step_changes_nothing() {
    let simulation = probe(&[("fault.refuse_time", 0.5)]);
    unsafe {
        assert_eq!(jostle_advance_to(simulation, 0.4), Ok);
        let before = saved(simulation);
        assert_eq!(jostle_advance_to(simulation, 0.6), StepRefused);
        assert!(message_of(simulation).contains("Take a shorter step"));
        assert!(saved(simulation) == before);
        assert_eq!(jostle_advance_to(simulation, 0.5), Ok);
        jostle_free(simulation);
    }
}

#[test]
fn a_second_thread_is_refused_and_waits_for_nobody() {
    let simulation = probe(&[]);
    let address = simulation as usize;
    unsafe {
        let status = handle::enter(simulation, handle::Access::Change, |_| {
            let other = std::thread::spawn(move || {
                let simulation = std::ptr::with_exposed_provenance_mut::<JostleSimulation>(address);
                jostle_free(simulation);
                (jostle_advance_to(simulation, 1.0), jostle_variable_count(simulation))
            });
            assert_eq!(other.join().unwrap(), (Busy, 0));
            Result::Ok(())
        });
        assert_eq!(status, Ok);
        assert_eq!(jostle_advance_to(simulation, 1.0), Ok);
        jostle_free(simulation);
    }
}

#[test]
fn eight_threads_give_the_bits_of_one_run_alone() {
    let run = || {
        let simulation = probe(&[]);
        for step in 1..=200 {
            unsafe { assert_eq!(jostle_advance_to(simulation, 0.01 * f64::from(step)), Ok) };
        }
        let bytes = saved(simulation);
        unsafe { jostle_free(simulation) };
        bytes
    };
    let alone = run();
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|_| scope.spawn(run)).collect();
        assert!(threads.into_iter().all(|thread| thread.join().unwrap() == alone));
    });
}

#[test]
fn texts_are_cut_between_letters_and_always_end() {
    let mut buffer = [1 as c_char; 8];
    for size in 1..8 {
        assert_eq!(unsafe { text::write("ωωω", buffer.as_mut_ptr(), size) }, 7);
        let written = unsafe { CStr::from_ptr(buffer.as_ptr()) }.to_str().unwrap();
        assert_eq!(written.chars().count(), (size - 1) / 2);
    }
}

#[test]
fn foreign_pointers_are_refused_with_a_message() {
    let memory = [0_u64; 16];
    let not_ours = memory.as_ptr().cast::<JostleSimulation>().cast_mut();
    unsafe {
        assert_eq!(jostle_advance_to(not_ours, 1.0), NoSimulation);
        assert_eq!(jostle_advance_to(not_ours.byte_add(1), 1.0), NoSimulation);
        jostle_free(not_ours);
    }
}

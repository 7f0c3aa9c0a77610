//! Nulls, wrong lengths, wrong references, wrong types, unsupported functions, panics.

use std::ffi::{c_char, c_int, c_void};
use std::ptr::{null, null_mut};

use fmi_component::c_api::Opaque;
use fmi_component::c_api::Status::{Error, Ok};
use oscillators::fmi2::*;
use oscillators::fmi3::*;

use crate::client::{Client, Log, callbacks2, log3, reference, token};

#[test]
fn null_instances_are_refused() {
    unsafe {
        assert_eq!(fmi2DoStep(null_mut(), 0.0, 0.1, 0), Error);
        assert_eq!(fmi3Reset(null_mut()), Error);
        assert_eq!(fmi3GetClock(null_mut(), null(), 0, null_mut()), Error);
        fmi2FreeInstance(null_mut());
        fmi3FreeInstance(null_mut());
    }
}

#[test]
fn null_with_length_zero_is_legal() {
    let (two, three) = (Client::two().ready(&[]), Client::three().ready(&[]));
    unsafe {
        assert_eq!(fmi2GetReal(two.pointer, null(), 0, null_mut()), Ok);
        assert_eq!(fmi2SetString(two.pointer, null(), 0, null()), Ok);
        assert_eq!(fmi2SetRealInputDerivatives(two.pointer, null(), 0, null(), null()), Ok);
        assert_eq!(fmi3GetFloat64(three.pointer, null(), 0, null_mut(), 0), Ok);
        assert_eq!(fmi3SetFloat64(three.pointer, null(), 0, null(), 0), Ok);
        assert_eq!(fmi3GetString(three.pointer, null(), 0, null_mut(), 0), Ok);
        assert_eq!(fmi3SetBinary(three.pointer, null(), 0, null(), null(), 0), Ok);
        assert_eq!(
            fmi3GetOutputDerivatives(three.pointer, null(), 0, null(), null_mut(), 0),
            Ok
        );
    }
}

#[test]
fn wrong_pointers_lengths_references_and_types_are_refused() {
    let client = Client::three().ready(&[]);
    let (pointer, mass, mut value) = (client.pointer, reference("body.mass"), 0.0);
    let mut many = [0_i32; 2];
    unsafe {
        assert_eq!(fmi3GetFloat64(pointer, null(), 1, &mut value, 1), Error);
        assert_eq!(fmi3GetFloat64(pointer, &mass, 1, null_mut(), 1), Error);
        assert_eq!(fmi3GetFloat64(pointer, &mass, 1, &mut value, 0), Error);
        assert_eq!(
            fmi3GetFloat64(pointer, &mass, usize::MAX, &mut value, usize::MAX),
            Error
        );
        assert_eq!(
            fmi3GetFloat64(pointer, (&raw const mass).byte_add(1), 1, &mut value, 1),
            Error,
            "misaligned"
        );
        for unknown in [1000, u32::MAX, reference("seed"), reference("start.pattern")] {
            assert_eq!(fmi3GetFloat64(pointer, &unknown, 1, &mut value, 1), Error, "{unknown}");
        }
        assert_eq!(fmi3GetInt32(pointer, &mass, 1, many.as_mut_ptr(), 1), Error);
        assert_eq!(
            fmi3GetInt32(pointer, &reference("seed"), 1, many.as_mut_ptr(), 1),
            Error
        );
        assert_eq!(fmi3GetBoolean(pointer, &mass, 1, many.as_mut_ptr().cast(), 1), Error);
        assert_eq!(
            fmi3SetFloat64(pointer, &0, 1, &value, 1),
            Error,
            "the time cannot be set"
        );
        assert_eq!(fmi3GetFloat64(pointer, &0, 1, &mut value, 1), Ok);
        assert_eq!(value, 0.0);
        let mut state = client.save();
        assert_eq!(fmi3SetFMUState(pointer, std::ptr::from_mut(&mut state).cast()), Error);
        assert_eq!(fmi3GetFMUState(pointer, null_mut()), Error);
        assert_eq!(fmi3DeserializeFMUState(pointer, null(), 100, &mut state), Error);
        assert_eq!(
            fmi3DoStep(pointer, 0.0, 0.1, 0, null_mut(), null_mut(), null_mut(), null_mut()),
            Error
        );
    }
    assert_eq!(client.step(0.0, 0.1), Ok, "a bad call changed nothing");
}

#[test]
fn the_remedy_of_a_null_pointer_says_what_to_pass() {
    let client = Client::three().ready(&[]);
    let remedy = |status, words: &str| {
        assert_eq!(status, Error);
        assert!(client.last_message().contains(words), "{}", client.last_message());
    };
    unsafe {
        remedy(fmi3GetFMUState(client.pointer, null_mut()), "the address of one value");
        remedy(
            fmi3GetFloat64(client.pointer, null(), 1, null_mut(), 1),
            "an array of the length",
        );
        remedy(
            fmi3SetDebugLogging(client.pointer, 1, 1, [null()].as_ptr()),
            "ends with a zero byte",
        );
    }
}

/// An importer whose log calls the instance that it hears of, as none should.
#[test]
fn a_call_while_another_is_under_way_is_told_of_at_the_end_of_that_one() {
    struct Environment {
        instance: Opaque,
        log: Log,
    }
    unsafe extern "C" fn calls_back(
        environment: *mut c_void,
        status: c_int,
        category: *const c_char,
        message: *const c_char,
    ) {
        let environment = unsafe { &*environment.cast::<Environment>() };
        unsafe {
            log3(
                (&raw const environment.log).cast_mut().cast(),
                status,
                category,
                message,
            )
        };
        if environment.log.borrow().len() == 1 {
            let mut value = 0.0;
            let status = unsafe { fmi3GetFloat64(environment.instance, &0, 1, &mut value, 1) };
            assert_eq!(status, Error);
        }
    }
    let mut environment = Box::new(Environment {
        instance: null_mut(),
        log: Log::default(),
    });
    let hears = std::ptr::from_mut(&mut *environment).cast();
    environment.instance = unsafe {
        fmi3InstantiateCoSimulation(
            c"oscillators".as_ptr(),
            token().as_ptr(),
            null(),
            0,
            0,
            0,
            0,
            null(),
            0,
            hears,
            Some(calls_back),
            None,
        )
    };
    let errors = [c"logStatusError".as_ptr()];
    unsafe {
        assert_eq!(fmi3SetDebugLogging(environment.instance, 1, 1, errors.as_ptr()), Ok);
        assert_eq!(fmi3GetFMUState(environment.instance, null_mut()), Error);
    }
    let messages: Vec<String> = environment.log.borrow().iter().map(|line| line.2.clone()).collect();
    assert_eq!(messages.len(), 2, "{messages:?}");
    assert!(
        messages[1].starts_with("fmi3GetFloat64: refused, since another call"),
        "{messages:?}"
    );
    unsafe { fmi3FreeInstance(environment.instance) };
}

#[test]
fn sets_are_all_or_nothing() {
    let client = Client::three().ready(&[]);
    let references = [reference("frame.position"), reference("frame.velocity")];
    let values = [0.5, f64::INFINITY];
    assert_eq!(
        unsafe { fmi3SetFloat64(client.pointer, references.as_ptr(), 2, values.as_ptr(), 2) },
        Error
    );
    assert!(
        client.last_message().contains("frame.velocity"),
        "{}",
        client.last_message()
    );
    assert_eq!(client.get("frame.position"), (Ok, 0.0));
}

#[test]
fn instances_of_one_version_are_not_of_the_other() {
    let (two, three) = (Client::two(), Client::three());
    unsafe {
        assert_eq!(fmi2Reset(three.pointer), Error);
        assert_eq!(fmi3Reset(two.pointer), Error);
        for client in [&two, &three] {
            assert!(
                client.last_message().contains("other version"),
                "{}",
                client.last_message()
            );
        }
        fmi3FreeInstance(two.pointer);
        fmi2FreeInstance(three.pointer);
    }
    assert_eq!((two.reset(), three.reset()), (Ok, Ok), "both live on");
}

#[test]
fn what_is_not_offered_answers() {
    let (two, three) = (Client::two().ready(&[]), Client::three().ready(&[]));
    let mut count = 0;
    unsafe {
        assert_eq!(fmi2SetTime(two.pointer, 1.0), Error);
        assert_eq!(fmi2CancelStep(two.pointer), Error);
        assert_eq!(fmi2GetDerivatives(two.pointer, null_mut(), 0), Error);
        assert!(two.last_message().contains("model exchange"), "{}", two.last_message());
        assert_eq!(fmi2GetStringStatus(two.pointer, 1, null_mut()), Error);
        assert_eq!(fmi3EnterConfigurationMode(three.pointer), Error);
        assert_eq!(fmi3ActivateModelPartition(three.pointer, 0, 0.0), Error);
        assert_eq!(fmi3GetNumberOfContinuousStates(three.pointer, &mut count), Error);
        assert_eq!(fmi3EvaluateDiscreteStates(three.pointer), Error);
        let refused = fmi3InstantiateModelExchange(c"m".as_ptr(), null(), null(), 0, 1, null_mut(), None);
        assert!(refused.is_null());
    }
}

#[test]
fn bad_instantiation_gives_null() {
    let log = Log::default();
    let (callbacks, token) = (callbacks2(&log), token());
    unsafe {
        assert!(fmi2Instantiate(c"oscillators".as_ptr(), 1, token.as_ptr(), null(), null(), 0, 0).is_null());
        assert!(fmi2Instantiate(c"oscillators".as_ptr(), 0, token.as_ptr(), null(), &callbacks, 0, 0).is_null());
        assert!(fmi2Instantiate(c"oscillators".as_ptr(), 1, null(), null(), &callbacks, 0, 0).is_null());
    }
    assert_eq!(log.borrow().len(), 2);
}

#[test]
fn a_panic_stays_in_its_instance() {
    for client in [Client::two(), Client::three()] {
        let neighbour = Client::three().ready(&[]);
        let client = client.ready(&[("fault.panic_time", 0.05)]);
        let state = client.save();
        let before = client.run((0, 4), 0.01);
        assert_eq!(client.step(0.04, 0.02), Error);
        assert!(
            client.last_message().contains("set to panic"),
            "{}",
            client.last_message()
        );
        assert_eq!(client.step(0.04, 0.01), Error);
        assert!(client.last_message().contains("Reset"), "{}", client.last_message());
        assert_eq!(client.set("frame.position", 0.0), Error);
        assert_eq!(neighbour.run((0, 4), 0.01), before, "the neighbour notices nothing");
        assert_eq!(client.restore(state), Ok);
        assert_eq!(client.run((0, 4), 0.01), before, "a saved state heals it");
        assert_eq!(client.step(0.04, 0.02), Error);
        assert_eq!(client.reset(), Ok);
        assert_eq!(client.ready(&[]).run((0, 4), 0.01), before, "so does a reset");
    }
}

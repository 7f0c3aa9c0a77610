//! Every misuse that an importer is known for, and saved states, on each of the models in both versions: refused calls answer and change
//! nothing. The libraries are loaded as an importer loads them.
#![allow(unsafe_code, clippy::undocumented_unsafe_blocks, clippy::unwrap_used)]

mod client;

use std::ffi::{c_char, c_int};
use std::ptr::{null, null_mut};

use client::{Client, Subject, call, subject};
use fmi_component::c_api::Status::{Error, Ok};
use fmi_component::c_api::{Opaque, Status};
use fmi_component::{Causality, Kind};
use reference_models::ALL;

/// Runs `check` for each model and version.
fn each(check: impl Fn(&Subject, bool)) {
    for (name, model) in &ALL {
        let subject = subject(name, model);
        for three in [false, true] {
            check(&subject, three);
        }
    }
}

/// A call that must be refused, by a client in step mode at time 0.
type Misuse = (&'static str, fn(&Client) -> Status);

fn is_fixed_real(variable: &fmi_component::Variable) -> bool {
    let parameter = variable.causality == Causality::Parameter && !variable.tunable;
    parameter && matches!(variable.kind, Kind::Real(_))
}

fn with(found: Option<u32>, call: impl Fn(u32) -> Status) -> Status {
    found.map_or(Error, call) // a model without such a variable has nothing to misuse
}

const MISUSE: &[Misuse] = &[
    ("a step of length zero", |client| client.step(0.0, 0.0)),
    ("a step backward", |client| client.step(0.0, -0.1)),
    ("a step of no number", |client| client.step(0.0, f64::NAN)),
    ("an endless step", |client| client.step(0.0, f64::INFINITY)),
    ("a step from elsewhere", |client| client.step(0.7, 0.1)),
    ("a step from no number", |client| client.step(f64::NAN, 0.1)),
    ("a step beyond all times", |client| client.step(0.0, 1e300)),
    ("initialisation twice", |client| client.enter()),
    ("an end of initialisation without beginning", |client| client.exit()),
    ("an unknown reference", |client| client.get_real(&9999, 1, &mut 0.0, 1)),
    ("no references", |client| client.get_real(null(), 1, &mut 0.0, 1)),
    ("no room for values", |client| client.get_real(&0, 1, null_mut(), 1)),
    ("a length that no memory has", |client| {
        client.get_real(&0, usize::MAX, &mut 0.0, usize::MAX)
    }),
    ("references that are misaligned", |client| {
        client.get_real([0_u32; 2].as_ptr().wrapping_byte_add(1), 1, &mut 0.0, 1)
    }),
    ("setting the time", |client| client.set_real(0, 1.0)),
    ("setting an output", |client| {
        with(
            client.find(|variable| variable.causality == Causality::Output),
            |output| client.set_real(output, 1.0),
        )
    }),
    ("setting a frozen parameter", |client| {
        with(client.find(is_fixed_real), |parameter| client.set_real(parameter, 1.0))
    }),
    ("setting an input to no number", |client| {
        let input =
            client.find(|variable| variable.causality == Causality::Input && variable.kind.quantity().is_some());
        with(input, |input| client.set_real(input, f64::NAN))
    }),
    ("a text for a number", |client| client.set_text(1, c"1.0".as_ptr())),
    ("no text", |client| {
        with(
            client.find(|variable| matches!(variable.kind, Kind::Text { .. })),
            |text| client.set_text(text, null()),
        )
    }),
    ("a text that is not UTF-8", |client| {
        let text = client.find(|variable| matches!(variable.kind, Kind::Text { .. }));
        with(text, |text| client.set_text(text, c"\xff\xfe".as_ptr()))
    }),
    ("a real of a text", |client| {
        let text = client.find(|variable| variable.kind.start_bytes().is_some());
        with(text, |text| client.get_real(&text, 1, &mut 0.0, 1))
    }),
    ("model exchange", |client| match client.three {
        true => call!(client.subject, fmi3SetTime(client.pointer => Opaque, 1.0 => f64) -> Status),
        false => call!(client.subject, fmi2SetTime(client.pointer => Opaque, 1.0 => f64) -> Status),
    }),
    ("event mode that was not asked for", |client| {
        client.plain("EnterEventMode")
    }),
    ("a function of the other version", |client| match client.three {
        true => call!(client.subject, fmi2Reset(client.pointer => Opaque) -> Status),
        false => call!(client.subject, fmi3Reset(client.pointer => Opaque) -> Status),
    }),
    ("no state to restore", |client| client.restore(null_mut())),
    ("a state that is none", |client| client.restore(1234 as Opaque)),
    ("no room for a state", |client| client.state_call("GetFMU", null_mut())),
    ("bytes that are no state", |client| client.deserialize(b"<xml>").0),
    ("a state with too little room for its bytes", |client| {
        let mut state = client.save();
        let status = client.serialize(state, &mut [0; 4]);
        assert_eq!(client.state_call("FreeFMU", &mut state), Ok);
        status
    }),
    ("a state that was freed", |client| {
        let mut state = client.save();
        let stale = state;
        assert_eq!(client.state_call("FreeFMU", &mut state), Ok);
        client.restore(stale)
    }),
    ("a log category that is unknown", |client| {
        let unknown: *const *const c_char = &c"logUnknown".as_ptr();
        match client.three {
            true => call!(client.subject, fmi3SetDebugLogging(
                client.pointer => Opaque, 1 => u8, 1 => usize, unknown => *const *const c_char,
            ) -> Status),
            false => call!(client.subject, fmi2SetDebugLogging(
                client.pointer => Opaque, 1 => c_int, 1 => usize, unknown => *const *const c_char,
            ) -> Status),
        }
    }),
];

#[test]
fn misuse_is_refused_and_changes_nothing() {
    each(|subject, three| {
        let expected = Client::new(subject, three).ready().run(0.0);
        let client = Client::new(subject, three).ready();
        for (what, misuse) in MISUSE {
            let status = misuse(&client);
            assert_eq!(
                status,
                Error,
                "{what}, {:?}, FMI {}",
                subject.token,
                if three { 3 } else { 2 }
            );
        }
        assert_eq!(client.run(0.0), expected, "{:?}", subject.token);
    });
}

#[test]
fn calls_out_of_order_are_refused_and_change_nothing() {
    each(|subject, three| {
        let expected = Client::new(subject, three).ready().run(0.0);
        let client = Client::new(subject, three);
        let output =
            client.find(|variable| variable.causality == Causality::Output && matches!(variable.kind, Kind::Real(_)));
        assert_eq!(client.step(0.0, 0.1), Error, "a step before initialisation");
        assert_eq!(client.exit(), Error);
        assert_eq!(client.plain("Terminate"), Error);
        if let Some(output) = output {
            assert_eq!(
                client.get_real(&output, 1, &mut 0.0, 1),
                Error,
                "an output before initialisation"
            );
        }
        for (start, stop) in [(f64::NAN, None), (1e300, None), (1.0, Some(0.0)), (0.0, Some(f64::NAN))] {
            assert_eq!(client.enter_until(start, stop), Error, "from {start} to {stop:?}");
        }
        assert_eq!(client.enter(), Ok);
        assert_eq!(client.step(0.0, 0.1), Error, "a step in initialisation mode");
        assert_eq!(client.exit(), Ok);
        assert_eq!(client.run(0.0), expected);
        assert_eq!(client.plain("Terminate"), Ok);
        assert_eq!(client.step(1.2, 0.1), Error, "a step after the end");
        assert_eq!(client.plain("Terminate"), Error, "an end after the end");
        assert_eq!(client.plain("Reset"), Ok);
        assert_eq!(client.ready().run(0.0), expected, "as new after a reset");
    });
}

#[test]
fn steps_beyond_the_stop_time_are_refused() {
    each(|subject, three| {
        let client = Client::new(subject, three);
        assert_eq!((client.enter_until(0.0, Some(1.0)), client.exit()), (Ok, Ok));
        assert_eq!(client.step(0.0, 1.5), Error);
        assert_eq!(client.step(0.0, 1.0), Ok);
    });
}

#[test]
fn no_instance_comes_of_wrong_arguments_and_none_is_no_crash() {
    each(|subject, three| {
        for (name, token) in [
            (c"name".as_ptr(), c"wrong".as_ptr()),
            (c"name".as_ptr(), null()),
            (null(), subject.token.as_ptr()),
            (c"".as_ptr(), subject.token.as_ptr()),
        ] {
            let none = Client::make(subject, three, name, token);
            assert!(none.pointer.is_null());
            assert_eq!(none.step(0.0, 0.1), Error);
            assert_eq!(none.plain("Reset"), Error);
            assert_eq!(none.get_real(&0, 1, &mut 0.0, 1), Error);
        }
    });
}

#[test]
fn states_bring_back_the_same_bits_here_and_elsewhere() {
    each(|subject, three| {
        let client = Client::new(subject, three).ready();
        client.run(0.0);
        let state = client.save();
        let later = client.run(1.2);
        assert_eq!(client.restore(state), Ok);
        assert_eq!(client.run(1.2), later, "{:?}", subject.token);
        let bytes = client.bytes(state);
        let other = Client::new(subject, three);
        let (status, state) = other.deserialize(&bytes);
        assert_eq!(status, Ok);
        assert_eq!(other.restore(state), Ok);
        assert_eq!(other.bytes(other.save()), bytes);
        assert_eq!(other.run(1.2), later, "in another instance");
        for length in 0..bytes.len() {
            assert_eq!(other.deserialize(&bytes[..length]).0, Error, "{length} bytes");
        }
        for index in 0..bytes.len() {
            let mut altered = bytes.clone();
            altered[index] ^= 1 << (index % 8);
            assert_eq!(other.deserialize(&altered), (Error, null_mut()), "byte {index}");
        }
    });
}

#[test]
fn ten_threads_give_the_bits_of_one() {
    each(|subject, three| {
        let alone = Client::new(subject, three).ready().run(0.0);
        std::thread::scope(|scope| {
            let runs: Vec<_> = (0..10)
                .map(|_| scope.spawn(|| Client::new(subject, three).ready().run(0.0)))
                .collect();
            for run in runs {
                assert_eq!(run.join().unwrap(), alone);
            }
        });
    });
}

#[test]
fn texts_of_any_length_come_back_as_they_were_set() {
    let (name, model) = &ALL[2];
    let subject = subject(name, model);
    for three in [false, true] {
        let client = Client::new(&subject, three).ready();
        let [input, output] =
            ["String_input", "String_output"].map(|name| client.find(|variable| variable.name == name).unwrap());
        for text in [
            c"",
            c"bar",
            c"\xc3\xa4\xe2\x82\xac",
            &std::ffi::CString::new(vec![b'x'; 100_000]).unwrap(),
        ] {
            assert_eq!(client.set_text(input, text.as_ptr()), Ok);
            assert_eq!(client.text(input).as_bytes(), text.to_bytes());
        }
        assert_eq!(client.set_text(input, c"last".as_ptr()), Ok);
        assert_eq!(client.text(output), "Set me!", "until the next step");
        assert_eq!(client.step(0.0, 0.1), Ok);
        assert_eq!(client.text(output), "last");
    }
}

#[test]
fn every_size_of_number_and_bytes_come_back_as_they_were_set() {
    let (name, model) = &ALL[2];
    let subject = subject(name, model);
    assert!(!subject.events);
    let client = Client::new(&subject, true).ready();
    let find = |name: &str| client.find(|variable| variable.name == name).unwrap();
    macro_rules! pass {
        ($name:literal, $get:ident, $set:ident, $of:ty, [$($value:expr),*]) => {
            let [input, output] = [find(concat!($name, "_input")), find(concat!($name, "_output"))];
            for (index, value) in [$($value as $of),*].into_iter().enumerate() {
                let mut found = <$of>::default();
                let status = call!(subject, $set(
                    client.pointer => Opaque, &input => *const u32, 1 => usize, &value => *const $of, 1 => usize,
                ) -> Status);
                assert_eq!(status, Ok, "{} = {value}", $name);
                assert_eq!(client.plain("EnterStepMode"), Error, "{index}");
                let state = client.save();
                assert_eq!(client.step(0.0, 0.1), Ok);
                let status = call!(subject, $get(
                    client.pointer => Opaque, &output => *const u32, 1 => usize, &mut found => *mut $of, 1 => usize,
                ) -> Status);
                assert_eq!((status, found), (Ok, value), "{}", $name);
                assert_eq!(client.restore(state), Ok);
            }
        };
    }
    pass!(
        "Float32_continuous",
        fmi3GetFloat32,
        fmi3SetFloat32,
        f32,
        [0.1, f32::MAX, -1e-30]
    );
    pass!(
        "Float64_discrete",
        fmi3GetFloat64,
        fmi3SetFloat64,
        f64,
        [0.1, f64::MAX, 5e-324]
    );
    pass!("Int8", fmi3GetInt8, fmi3SetInt8, i8, [i8::MIN, i8::MAX]);
    pass!("UInt8", fmi3GetUInt8, fmi3SetUInt8, u8, [0, u8::MAX]);
    pass!("Int16", fmi3GetInt16, fmi3SetInt16, i16, [i16::MIN, i16::MAX]);
    pass!("UInt16", fmi3GetUInt16, fmi3SetUInt16, u16, [0, u16::MAX]);
    pass!("Int32", fmi3GetInt32, fmi3SetInt32, i32, [i32::MIN, i32::MAX]);
    pass!("UInt32", fmi3GetUInt32, fmi3SetUInt32, u32, [0, u32::MAX]);
    pass!("Int64", fmi3GetInt64, fmi3SetInt64, i64, [i64::MIN, i64::MAX]);
    pass!("UInt64", fmi3GetUInt64, fmi3SetUInt64, u64, [0, i64::MAX]);
    pass!("Enumeration", fmi3GetInt64, fmi3SetInt64, i64, [2, 1]);
    pass!("Boolean", fmi3GetBoolean, fmi3SetBoolean, u8, [1, 0]);
    let too_large = call!(subject, fmi3SetUInt64(
        client.pointer => Opaque, &find("UInt64_input") => *const u32, 1 => usize, &u64::MAX => *const u64, 1 => usize,
    ) -> Status);
    assert_eq!(too_large, Error, "whole numbers are held with a sign");
    binary(&client, find("Binary_input"), find("Binary_output"));
}

fn binary(client: &Client, input: u32, output: u32) {
    let set = |bytes: *const u8, size: usize| {
        call!(client.subject, fmi3SetBinary(
            client.pointer => Opaque, &input => *const u32, 1 => usize, &size => *const usize, &bytes => *const *const u8,
            1 => usize,
        ) -> Status)
    };
    let get = |reference: u32| {
        let (mut size, mut bytes) = (99, null());
        let status = call!(client.subject, fmi3GetBinary(
            client.pointer => Opaque, &reference => *const u32, 1 => usize, &mut size => *mut usize,
            &mut bytes => *mut *const u8, 1 => usize,
        ) -> Status);
        assert_eq!(status, Ok);
        unsafe { std::slice::from_raw_parts(bytes, size) }.to_vec()
    };
    assert_eq!(get(output), b"foo");
    assert_eq!(set([0, 255, 0].as_ptr(), 3), Ok);
    assert_eq!(get(input), b"\0\xff\0");
    assert_eq!(set(null(), 5), Error, "no bytes");
    assert_eq!(set([0].as_ptr(), usize::MAX), Error, "more bytes than memory has");
    let no_sizes = call!(client.subject, fmi3SetBinary(
        client.pointer => Opaque, &input => *const u32, 1 => usize, null() => *const usize, &b"x".as_ptr() => *const *const u8,
        1 => usize,
    ) -> Status);
    assert_eq!(no_sizes, Error);
    assert_eq!(client.step(0.0, 0.1), Ok);
    assert_eq!(get(output), b"\0\xff\0");
    assert_eq!(set(null(), 0), Ok, "nothing is a value too");
    assert_eq!(get(input), b"");
}

/// An importer sets and reads an array as one variable; a wrong number of values is refused.
#[test]
fn arrays_are_set_and_read_as_one_variable() {
    let (name, model) = &ALL[5];
    let structure = fmi_component::StructuralParameters::defaults(&(model.info)());
    let mut subject = subject(name, model);
    let token = fmi_component::token::write(&(model.info)(), &structure, &subject.variables, true);
    subject.token = std::ffi::CString::new(token).unwrap();
    let client = Client::new(&subject, true);
    let find = |name: &str| client.find(|variable| variable.name == name).unwrap();
    let (matrix, input, output, state) = (find("D[1,1]"), find("u[1]"), find("y[1]"), find("x0[1]"));
    let set = |references: &[u32], values: &[f64]| {
        call!(subject, fmi3SetFloat64(
            client.pointer => Opaque, references.as_ptr() => *const u32, references.len() => usize,
            values.as_ptr() => *const f64, values.len() => usize,
        ) -> Status)
    };
    let swap = [0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    assert_eq!(set(&[matrix, input], &[&swap[..], &[5.0, 6.0, 7.0]].concat()), Ok);
    for (references, values) in [
        (&[input][..], &[1.0][..]),
        (&[input], &[1.0, 2.0]),
        (&[input, state], &[1.0, 2.0]),
        (&[input + 1], &[1.0]),
        (&[input, state], &[1.0, 2.0, 3.0, 4.0, 5.0, f64::NAN]),
    ] {
        assert_eq!(set(references, values), Error, "{references:?} {values:?}");
    }
    assert_eq!((client.enter(), client.exit()), (Ok, Ok));
    let mut values = [f64::NAN; 3];
    assert_eq!(client.get_real(&output, 1, values.as_mut_ptr(), 3), Ok);
    assert_eq!(values, [6.0, 5.0, 7.0]);
    assert_eq!(client.get_real(&input, 1, values.as_mut_ptr(), 3), Ok);
    assert_eq!(values, [5.0, 6.0, 7.0]);
}

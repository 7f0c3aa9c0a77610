//! Call order, communication points, discarded steps, reset.

use std::ffi::CString;

use fmi_component::c_api::Status::{Discard, Error, Ok};
use fmi_component::{Importer, StructuralParameters};
use oscillators::fmi2::*;
use oscillators::fmi3::*;

use crate::client::{Client, MODEL, reference, token, token_of};
use crate::decay::DECAY;

fn both() -> [Client; 2] {
    [Client::two(), Client::three()]
}

#[test]
fn versions_give_the_same_bits() {
    let [two, three] = both().map(|client| client.ready(&[("body.mass", 0.3)]));
    assert_eq!(two.run((0, 50), 0.01), three.run((0, 50), 0.01));
}

#[test]
fn one_long_step_equals_two_short_ones() {
    let [long, short] = [Client::three(), Client::three()].map(|client| client.ready(&[]));
    for index in 0..20 {
        let time = f64::from(index) * 0.02;
        assert_eq!(long.step(time, 0.02), Ok);
        assert_eq!(short.step(time, 0.01), Ok);
        assert_eq!(short.step(time + 0.01, 0.01), Ok);
        assert_eq!(long.outputs(), short.outputs());
    }
}

#[test]
fn calls_out_of_order_are_refused_and_change_nothing() {
    for client in both() {
        assert_eq!(client.step(0.0, 0.01), Error);
        assert!(client.last_message().contains("step mode"), "{}", client.last_message());
        assert_eq!(client.exit(), Error);
        assert_eq!(client.get("frame.reaction_force").0, Error, "not computed yet");
        assert_eq!(client.get("body.mass"), (Ok, 0.1));
        assert_eq!(client.enter(), Ok);
        assert_eq!(
            client.set("body.mass", 0.2),
            Ok,
            "parameters may be set until initialisation ends"
        );
        assert_eq!(client.get("natural.angle_rate"), (Ok, (100.0_f64 / 0.2).sqrt()));
        assert_eq!(client.set("body.mass", 0.1), Ok);
        assert_eq!(
            client.get("natural.angle_rate"),
            (Ok, (100.0_f64 / 0.1).sqrt()),
            "it follows the parameter"
        );
        assert_eq!(client.exit(), Ok);
        assert_eq!(client.exit(), Error);
        assert_eq!(client.set("body.mass", 0.2), Error);
        assert!(client.last_message().contains("frozen"), "{}", client.last_message());
        assert_eq!(client.set("frame.reaction_force", 0.2), Error);
        assert_eq!(client.set("frame.position", f64::NAN), Error);
        assert_eq!(client.get("frame.position"), (Ok, 0.0));
        let twin = Client::three().ready(&[]);
        assert_eq!(client.run((0, 10), 0.01), twin.run((0, 10), 0.01));
    }
}

#[test]
fn terminated_instances_are_read_only() {
    let client = Client::three().ready(&[]);
    client.run((0, 3), 0.01);
    let before = client.outputs();
    assert_eq!(unsafe { fmi3Terminate(client.pointer) }, Ok);
    assert_eq!(client.outputs(), before);
    assert_eq!(client.set("frame.position", 0.0), Error);
    assert_eq!(client.step(0.03, 0.01), Error);
    assert_eq!(client.reset(), Ok);
    assert_eq!(client.enter(), Ok);
}

#[test]
fn communication_points_tolerate_rounding_and_nothing_more() {
    let client = Client::three().ready(&[]);
    let mut summed = 0.0;
    for index in 0..1000 {
        let exact = f64::from(index) * 0.1;
        let point = if index % 2 == 0 { summed } else { exact };
        assert_eq!(client.step(point, 0.1), Ok, "{}", client.last_message());
        summed += 0.1;
    }
    for (point, step) in [(0.0, 0.1), (100.05, 0.1), (f64::NAN, 0.1), (f64::INFINITY, 0.1)] {
        assert_eq!(client.step(point, step), Error, "{point}");
    }
    for step in [0.0, -0.1, f64::NAN, f64::INFINITY, 1e-300] {
        assert_eq!(client.step(100.0, step), Error, "{step}");
        assert!(client.last_message().contains("step size"), "{}", client.last_message());
    }
    assert_eq!(client.step(100.0, 0.1), Ok, "{}", client.last_message());
}

#[test]
fn the_stop_time_is_kept() {
    let client = Client::three();
    assert_eq!(
        unsafe { fmi3EnterInitializationMode(client.pointer, 0, 0.0, 1.0, 1, 1.05) },
        Ok
    );
    assert_eq!(client.exit(), Ok);
    assert_eq!(client.step(1.0, 0.05), Ok);
    assert_eq!(client.step(1.05, 0.05), Error);
    assert!(client.last_message().contains("stop time"));
}

#[test]
fn a_discarded_step_keeps_the_state_and_may_be_tried_shorter() {
    for client in both() {
        let client = client.ready(&[("fault.refuse_time", 0.055)]);
        client.run((0, 5), 0.01);
        let before = client.outputs();
        assert_eq!(client.step(0.05, 0.01), Discard);
        assert!(client.last_message().contains("100"), "{}", client.last_message());
        assert_eq!(client.outputs(), before);
        if !client.three {
            let (mut time, mut status, mut terminated) = (0.0, Ok, 7);
            assert_eq!(unsafe { fmi2GetRealStatus(client.pointer, 2, &mut time) }, Ok);
            assert_eq!(unsafe { fmi2GetStatus(client.pointer, 0, &mut status) }, Ok);
            assert_eq!(unsafe { fmi2GetBooleanStatus(client.pointer, 3, &mut terminated) }, Ok);
            assert_eq!((time, status, terminated), (0.05, Discard, 0));
        }
        assert_eq!(client.step(0.05, 0.01), Error, "the very same step again");
        assert_eq!(client.step(0.05, 0.005), Ok, "{}", client.last_message());
        assert_eq!(client.step(0.055, 0.005), Discard);
    }
}

/// A doubtful parameter is told of once, when it is frozen, and is no failure; FMI 3.0 logs what is switched on.
#[test]
fn what_is_doubtful_is_logged_when_initialisation_ends() {
    for client in [Client::two(), Client::three()] {
        if client.three {
            let categories = [c"logStatusWarning".as_ptr()];
            assert_eq!(
                unsafe { fmi3SetDebugLogging(client.pointer, 1, 1, categories.as_ptr()) },
                Ok
            );
        }
        let client = client.ready(&[("damper.damping", 0.0)]);
        client.run((0, 2), 0.01);
        let lines = client.log.borrow();
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert_eq!((lines[0].0, lines[0].1.as_str()), (1, "logStatusWarning"));
        assert!(
            lines[0]
                .2
                .contains("ExitInitializationMode: damper.damping = 0: the bodies never"),
            "{lines:?}"
        );
    }
    assert_eq!(Client::two().ready(&[]).last_message(), "");
}

/// Parameters are frozen, so that it is said once, with the value, the range and the reason.
#[test]
fn a_parameter_outside_of_its_recommended_range_is_logged_once() {
    for client in both() {
        if client.three {
            let categories = [c"logStatusWarning".as_ptr()];
            // SAFETY: the instance is alive, and the category is a text that ends.
            let answer = unsafe { fmi3SetDebugLogging(client.pointer, 1, 1, categories.as_ptr()) };
            assert_eq!(answer, Ok);
        }
        // The critical damping is 6.3 kg/s.
        let client = client.ready(&[("damper.damping", 20.0)]);
        client.run((0, 2), 0.01);
        let lines = client.log.borrow();
        assert_eq!(lines.len(), 1, "{lines:?}");
        assert_eq!((lines[0].0, lines[0].1.as_str()), (1, "logStatusWarning"));
        let told = "damper.damping = 20 kg/s makes the damping ratio 3.16, outside of the recommended range (0 to 1): the bodies creep";
        assert!(lines[0].2.contains(told), "{lines:?}");
    }
}

/// Only the very same step is answered by an error: with other inputs or from another state it may be possible.
#[test]
fn a_discarded_step_with_other_inputs_or_from_another_state_is_another_step() {
    for client in both() {
        let client = client.ready(&[("fault.refuse_time", 0.055)]);
        client.run((0, 5), 0.01);
        let state = client.save();
        assert_eq!(client.step(0.05, 0.01), Discard);
        assert_eq!(client.set("frame.position", 0.25), Ok);
        assert_eq!(client.step(0.05, 0.01), Discard, "{}", client.last_message());
        assert_eq!(client.set("frame.position", 0.25), Ok);
        assert_eq!(client.step(0.05, 0.01), Error, "the same inputs set again");
        assert_eq!(client.restore(state), Ok);
        assert_eq!(client.step(0.05, 0.01), Discard, "{}", client.last_message());
        assert_eq!(client.step(0.05, 0.01), Error);
    }
}

/// Numbers in messages are as short as they can be: 1e-300 is not three hundred zeros.
#[test]
fn numbers_in_messages_are_short() {
    let client = Client::three().ready(&[("fault.refuse_time", 1e-300)]);
    let longest = |message: String| message.split(' ').map(str::len).max();
    for (point, step) in [
        (0.0, -1e-300),
        (0.0, f64::MAX),
        (1e300, 0.1),
        (1e-300, f64::MIN_POSITIVE),
        (0.0, 1.0),
    ] {
        assert_ne!(client.step(point, step), Ok);
        assert!(longest(client.last_message()) < Some(30), "{}", client.last_message());
    }
    for value in [f64::MAX, -1e-300] {
        assert_eq!(Client::three().set("damper.damping", value), Error);
        let other = Client::three();
        assert_eq!(other.set("damper.damping", value), Error);
        assert!(longest(other.last_message()) < Some(30), "{}", other.last_message());
    }
}

#[test]
fn no_simulation_starts_where_no_step_leads_on() {
    for start in [1e10, f64::INFINITY] {
        let client = Client::three();
        let status = unsafe { fmi3EnterInitializationMode(client.pointer, 0, 0.0, start, 0, 0.0) };
        assert_eq!(status, Error, "{start}");
        assert!(
            client.last_message().contains("start time = "),
            "{}",
            client.last_message()
        );
    }
    let client = Client::three();
    let start = -1e10;
    let status = unsafe { fmi3EnterInitializationMode(client.pointer, 0, 0.0, start, 0, 0.0) };
    assert_eq!((status, client.exit()), (Ok, Ok));
    assert_eq!(client.step(start, 0.5), Ok, "{}", client.last_message());
}

#[test]
fn reset_equals_a_new_instance() {
    for client in both() {
        let client = client.ready(&[("body.mass", 0.5)]);
        client.run((0, 20), 0.01);
        assert_eq!(client.reset(), Ok);
        assert_eq!(client.get("body.mass"), (Ok, 0.1));
        let client = client.ready(&[]);
        let new = Client::three().ready(&[]);
        assert_eq!(client.run((0, 20), 0.01), new.run((0, 20), 0.01));
    }
}

#[test]
fn parameters_refused_at_initialisation_may_be_corrected() {
    let client = Client::three();
    assert_eq!(client.set("damper.damping", 99.0), Ok);
    assert_eq!(client.set("body.mass", 1e-3), Ok);
    assert_eq!(client.set("body.mass", 1e3), Error);
    assert!(client.last_message().contains("10"), "{}", client.last_message());
    assert_eq!(client.enter(), Ok);
    assert_eq!(client.exit(), Error);
    assert!(
        client.last_message().contains("damper.damping"),
        "{}",
        client.last_message()
    );
    assert_eq!(client.set("body.mass", 1.0), Ok);
    assert_eq!(client.exit(), Ok);
}

#[test]
fn a_foreign_token_is_refused_with_a_message() {
    for token in [
        "",
        "nonsense",
        "fmi-component:oscillators:input:bodies=3:0000000000000000",
        "fmi-component:oscillators:input:bodies=9999:1",
    ] {
        let client = Client::three_with(&CString::new(token).unwrap(), Importer::default());
        assert!(client.pointer.is_null());
        let message = client.last_message();
        assert!(message.contains(token) && message.contains("same FMU"), "{message}");
    }
}

#[test]
fn errors_and_discarded_steps_are_logged_whatever_logging_on_says() {
    for client in [Client::two(), Client::silent(&token(), Importer::default())] {
        assert_eq!(client.step(0.0, 0.1), Error);
        assert!(client.last_message().contains("step mode"), "{:?}", client.log);
        let client = client.ready(&[("fault.refuse_time", 0.055)]);
        client.run((0, 5), 0.01);
        assert_eq!(client.step(0.05, 0.01), Discard);
        assert!(client.last_message().contains("refused at t = "), "{:?}", client.log);
        assert_eq!(client.log.borrow().len(), 2, "the life cycle is not logged");
    }
}

#[test]
fn log_categories_are_respected() {
    let client = Client::silent(&token(), Importer::default());
    assert_eq!(
        unsafe { fmi3SetDebugLogging(client.pointer, 1, 0, std::ptr::null()) },
        Ok
    );
    assert_eq!(client.step(0.0, 0.1), Error);
    assert!(client.last_message().contains("step mode"));
    let name = c"logEvents".as_ptr();
    assert_eq!(unsafe { fmi3SetDebugLogging(client.pointer, 1, 1, &name) }, Ok);
    assert_eq!(client.enter(), Ok);
    let logged: (i32, String, String) = client.log.borrow_mut().pop().unwrap();
    assert_eq!((logged.0, logged.1.as_str()), (Ok as i32, "logEvents"));
    let unknown = c"logEverything".as_ptr();
    assert_eq!(unsafe { fmi3SetDebugLogging(client.pointer, 1, 1, &unknown) }, Error);
    assert_eq!(client.log.borrow().len(), 1, "errors are off now");
    assert_eq!(
        unsafe { fmi3SetDebugLogging(client.pointer, 0, 0, std::ptr::null()) },
        Ok
    );
    client.log.borrow_mut().clear();
    assert_eq!(client.step(0.0, 0.1), Error);
    assert!(client.log.borrow().is_empty());
}

#[test]
fn seeds_are_64_bits_in_three_and_32_in_two() {
    let [two, three] = both();
    let (seed, mut read) = (1_i64 << 40, 0_i64);
    assert_eq!(
        unsafe { fmi3SetInt64(three.pointer, &reference("seed"), 1, &seed, 1) },
        Ok
    );
    assert_eq!(
        unsafe { fmi3GetInt64(three.pointer, &reference("seed"), 1, &mut read, 1) },
        Ok
    );
    assert_eq!(read, seed);
    let (small, mut read) = (7, 0);
    assert_eq!(
        unsafe { fmi2SetInteger(two.pointer, &reference("seed"), 1, &small) },
        Ok
    );
    assert_eq!(
        unsafe { fmi2GetInteger(two.pointer, &reference("seed"), 1, &mut read) },
        Ok
    );
    assert_eq!(read, small);
    assert_eq!(
        unsafe { fmi2SetInteger(two.pointer, &reference("seed"), 1, &-1) },
        Error
    );
}

#[test]
fn options_are_integers_in_two_and_64_bits_in_three() {
    let pattern = reference("start.pattern");
    let [two, three] = both();
    let (mut small, mut large, mut narrow) = (0, 0_i64, 0);
    unsafe {
        assert_eq!(fmi3SetInt64(three.pointer, &pattern, 1, &2, 1), Ok);
        assert_eq!(fmi3GetInt64(three.pointer, &pattern, 1, &mut large, 1), Ok);
        assert_eq!(fmi2SetInteger(two.pointer, &pattern, 1, &2), Ok);
        assert_eq!(fmi2GetInteger(two.pointer, &pattern, 1, &mut small), Ok);
        assert_eq!((small, large), (2, 2));
        assert_eq!(fmi3GetInt32(three.pointer, &pattern, 1, &mut narrow, 1), Error);
        assert!(three.last_message().contains("enumeration (Integer, Int64)"));
        for wrong in [0, 3, -1] {
            assert_eq!(fmi3SetInt64(three.pointer, &pattern, 1, &wrong, 1), Error);
            assert!(three.last_message().contains("one of: 1 random, 2 at_rest"));
            assert_eq!(fmi2SetInteger(two.pointer, &pattern, 1, &(wrong as i32)), Error);
        }
    }
    let [two, three] = [two, three].map(|client| client.ready(&[]));
    assert_eq!(two.run((0, 5), 0.01), three.run((0, 5), 0.01));
    assert_ne!(two.run((5, 6), 0.01), Client::two().ready(&[]).run((0, 1), 0.01));
}

/// `tolerance` of the importer stands for the parameter that is called so, unless that was set; models without it ignore it.
#[test]
fn the_importers_tolerance_chooses_the_time_step() {
    use fmi_component::instance::Access;
    use fmi_component::{Instance, ModelType, Value, value_reference};

    fn initialized(model: &ModelType, read: &str, own: Option<f64>, importers: Option<f64>) -> Result<Value, String> {
        let token = token_of(model, false);
        let mut instance = Instance::new(model, token.to_str().unwrap(), Importer::default()).unwrap();
        let variables = (model.variables)(&StructuralParameters::defaults(&(model.info)()));
        let reference = |name: &str| value_reference(variables.iter().position(|row| row.name == name).unwrap());
        if let Some(own) = own {
            let references = [reference("tolerance")];
            instance.set(&references, Access::Real, |_| Value::Real(own)).unwrap();
        }
        let message_of = |error: fmi_component::Error| error.to_string();
        instance.set_up_within(importers, 0.0, None).map_err(message_of)?;
        instance.enter_initialization().map_err(message_of)?;
        instance.get(reference(read), Access::Real).map_err(message_of)
    }
    let chosen = |own, importers| initialized(&DECAY, "chosen_time_step", own, importers);
    assert_eq!(chosen(None, Some(1e-8)), chosen(Some(1e-8), None));
    assert_ne!(chosen(None, Some(1e-8)), chosen(None, None));
    assert_eq!(chosen(Some(1e-7), Some(1e-8)), chosen(Some(1e-7), None));
    assert_eq!(chosen(None, Some(0.5)), chosen(Some(1e-4), None));
    for wrong in [0.0, -1.0, 1e-20, f64::NAN, f64::INFINITY] {
        let refusal = chosen(None, Some(wrong)).unwrap_err();
        assert!(refusal.contains("tolerance"), "{refusal}");
    }
    let ignored = |importers| initialized(&MODEL, "natural.angle_rate", None, importers);
    assert_eq!(ignored(Some(0.5)), ignored(None));
}

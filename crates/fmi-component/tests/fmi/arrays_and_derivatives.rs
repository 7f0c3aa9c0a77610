//! Array variables of FMI 3.0, derivatives of inputs and outputs, counts read as reals.

use fmi_component::Importer;
use fmi_component::c_api::Status::{Error, Ok};
use oscillators::fmi2::*;
use oscillators::fmi3::*;

use crate::client::{Client, MODEL, reference, token_of, variables};

fn arrays() -> Client {
    Client::three_with(&token_of(&MODEL, true), Importer::default())
}

#[test]
fn an_array_holds_the_bits_of_the_scalars() {
    let (client, twin) = (arrays().ready(&[]), Client::three().ready(&[]));
    assert_eq!((client.step(0.0, 0.01), twin.step(0.0, 0.01)), (Ok, Ok));
    let (force, first) = (reference("frame.reaction_force"), reference("body.position[1]"));
    let references = [force, first, force];
    let mut values = [f64::NAN; 5];
    let get = |length| unsafe { fmi3GetFloat64(client.pointer, references.as_ptr(), 3, values.as_mut_ptr(), length) };
    let statuses = [3, 4, 6].map(get);
    assert_eq!(statuses, [Error; 3], "wrong lengths");
    assert!(
        client.last_message().contains("expected are 5"),
        "{}",
        client.last_message()
    );
    assert_eq!(
        unsafe { fmi3GetFloat64(client.pointer, references.as_ptr(), 3, values.as_mut_ptr(), 5) },
        Ok
    );
    let bits: Vec<u64> = values[..4].iter().map(|value| value.to_bits()).collect();
    assert_eq!(bits, twin.outputs());
    assert_eq!(values[4], values[0]);
    let mut value = 0.0;
    assert_eq!(
        unsafe { fmi3GetFloat64(client.pointer, &reference("body.position[2]"), 1, &mut value, 1) },
        Error,
        "the reference of an inner element is not one of the model description"
    );
    assert!(client.last_message().contains("inside of an array"));
    let bytes = client.bytes(client.save());
    assert_eq!(twin.deserialize(&bytes).0, Error, "an FMU with arrays is another FMU");
}

/// Parameters, time, counts and elements, in any order and more than once.
#[test]
fn variables_read_in_one_call_have_the_bits_of_those_read_one_by_one() {
    let client = Client::three().ready(&[]);
    assert_eq!(client.step(0.0, 0.01), Ok);
    let names = [
        "body.mass",
        "frame.position",
        "steps",
        "body.position[1]",
        "body.position[3]",
    ];
    let whole = ["start.pattern", "seed"].map(reference);
    let every = (1..=variables().len() as u32).filter(|reference| !whole.contains(reference));
    let mut references: Vec<u32> = every.clone().chain([0]).chain(every.rev()).collect();
    references.extend(names.map(reference));
    let get = |references: &[u32]| {
        let mut values = vec![f64::NAN; references.len()];
        let count = references.len();
        let status = unsafe { fmi3GetFloat64(client.pointer, references.as_ptr(), count, values.as_mut_ptr(), count) };
        (status, values)
    };
    let (status, values) = get(&references);
    assert_eq!(status, Ok, "{}", client.last_message());
    for (reference, value) in references.iter().zip(values) {
        assert_eq!(get(&[*reference]), (Ok, vec![value]), "reference {reference}");
    }
    references.push(whole[1]);
    assert_eq!(get(&references).0, Error, "the seed is no real");
}

#[test]
fn the_derivative_of_an_input_displacement_is_the_input_velocity() {
    let (client, twin) = (Client::two().ready(&[]), Client::two().ready(&[]));
    let (place, rate) = (reference("frame.position"), reference("frame.velocity"));
    unsafe {
        assert_eq!(fmi2SetRealInputDerivatives(client.pointer, &place, 1, &1, &0.3), Ok);
        assert_eq!(fmi2SetReal(twin.pointer, &rate, 1, &0.3), Ok);
        for (reference, order) in [
            (place, 0),
            (place, 2),
            (place, -1),
            (rate, 1),
            (reference("body.mass"), 1),
            (99, 1),
        ] {
            assert_eq!(
                fmi2SetRealInputDerivatives(client.pointer, &reference, 1, &order, &9.0),
                Error
            );
        }
        assert_eq!(
            fmi2SetRealInputDerivatives(client.pointer, &place, 1, &1, &f64::NAN),
            Error
        );
        assert_eq!(
            fmi2SetRealInputDerivatives(client.pointer, &place, 1, std::ptr::null(), &9.0),
            Error
        );
    }
    assert_eq!(client.get("frame.velocity"), (Ok, 0.3));
    assert_eq!(client.step(0.0, 0.1), twin.step(0.0, 0.1));
    assert_eq!(client.outputs(), twin.outputs());
}

/// The model lists no rates of its outputs, so that it offers no output derivatives; models that do are tested by fmpy.
#[test]
fn output_derivatives_are_refused_where_there_are_none() {
    let (two, three) = (Client::two().ready(&[]), Client::three().ready(&[]));
    let (force, mut value) = (reference("frame.reaction_force"), 0.0);
    unsafe {
        assert_eq!(
            fmi2GetRealOutputDerivatives(two.pointer, &force, 1, &1, &mut value),
            Error
        );
        assert_eq!(
            fmi3GetOutputDerivatives(three.pointer, &force, 1, &1, &mut value, 1),
            Error
        );
    }
    assert!(three.last_message().contains("maxOutputDerivativeOrder = 0"));
}

#[test]
fn counts_may_be_read_as_reals_but_not_set() {
    for client in [Client::two(), Client::three()] {
        let client = client.ready(&[]);
        assert_eq!(client.step(0.0, 0.05), Ok);
        assert_eq!(client.get("steps"), (Ok, 50.0));
        assert_eq!(client.set("steps", 3.0), Error);
        assert_eq!(client.get("seed").0, Error, "a seed would lose digits");
    }
}

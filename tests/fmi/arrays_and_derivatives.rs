//! Array variables of FMI 3.0, derivatives of inputs and outputs, counts read as reals.

use std::ffi::CString;

use fmu_probe::fmi2::*;
use fmu_probe::fmi3::*;
use jostle::fmi::Version;
use jostle::fmi::abi::common::Status::{Error, Ok};
use jostle::fmi::instance::Importer;

use crate::client::{Client, component, reference};

fn arrays() -> Client {
    let mut component = component();
    component.arrays = true;
    Client::three_with(&CString::new(component.token()).unwrap(), Importer::default())
}

#[test]
fn an_array_holds_the_bits_of_the_scalars() {
    let (client, twin) = (arrays().ready(&[]), Client::three().ready(&[]));
    assert_eq!((client.step(0.0, 0.01), twin.step(0.0, 0.01)), (Ok, Ok));
    let (force, first) = (reference("base.reaction_force"), reference("disk.displacement[1]"));
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
        unsafe { fmi3GetFloat64(client.pointer, &reference("disk.displacement[2]"), 1, &mut value, 1) },
        Error,
        "the reference of an inner element is not one of the model description"
    );
    assert!(client.last_message().contains("inside of an array"));
    let bytes = client.bytes(client.save());
    assert_eq!(twin.deserialize(&bytes).0, Error, "an FMU with arrays is another FMU");
}

#[test]
fn arrays_are_described_as_such() {
    let mut component = component();
    let scalars = component.model_description(Version::Three);
    component.arrays = true;
    let text = component.model_description(Version::Three);
    assert!(text.contains(":arrays:") && !scalars.contains("Dimension"));
    assert!(text.contains(r#"name="disk.displacement""#) && text.contains(r#"<Dimension start="3"/>"#));
    assert_eq!(
        text.matches("<Output ").count() + 2,
        scalars.matches("<Output ").count()
    );
    assert!(text.contains(r#"name="disk.mass""#), "parameters stay scalar");
}

#[test]
fn the_derivative_of_an_input_displacement_is_the_input_velocity() {
    let (client, twin) = (Client::two().ready(&[]), Client::two().ready(&[]));
    let (place, rate) = (reference("base.displacement"), reference("base.velocity"));
    unsafe {
        assert_eq!(fmi2SetRealInputDerivatives(client.pointer, &place, 1, &1, &0.3), Ok);
        assert_eq!(fmi2SetReal(twin.pointer, &rate, 1, &0.3), Ok);
        for (reference, order) in [
            (place, 0),
            (place, 2),
            (place, -1),
            (rate, 1),
            (reference("disk.mass"), 1),
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
    assert_eq!(client.get("base.velocity"), (Ok, 0.3));
    assert_eq!(client.step(0.0, 0.1), twin.step(0.0, 0.1));
    assert_eq!(client.outputs(), twin.outputs());
    let text = component().model_description(Version::Two);
    assert!(text.contains(r#"canInterpolateInputs="true""#), "the flag says so");
}

/// The probe lists no rates of its outputs, so that it offers no output derivatives; scenes that do are tested by fmpy.
#[test]
fn output_derivatives_are_refused_where_there_are_none() {
    let (two, three) = (Client::two().ready(&[]), Client::three().ready(&[]));
    let (force, mut value) = (reference("base.reaction_force"), 0.0);
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
    assert!(
        component()
            .model_description(Version::Three)
            .contains(r#"maxOutputDerivativeOrder="0""#)
    );
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

//! Models that no importer could read are refused before anything is written, each by the name of what is wrong.

#![allow(clippy::unwrap_used)]

use fmi_bundle::{Component, Libraries, Version, model_description, pack};
use fmi_component::{Model, ModelInfo, ModelType, Row, StructuralParameters, Unit, Variable};
use oscillators::Oscillators;

const MODEL: ModelType = ModelType::of::<Oscillators>();

fn refusal(model: ModelType) -> String {
    Component::new(&model, &[]).unwrap_err().to_string()
}

#[test]
fn facts_of_a_model_are_checked() {
    macro_rules! model {
        ($change:expr) => {
            ModelType {
                info: || {
                    let mut info = Oscillators::info();
                    let change: fn(&mut ModelInfo) = $change;
                    change(&mut info);
                    info
                },
                ..MODEL
            }
        };
    }
    let cases = [
        (
            model!(|info| info.identifier = "".into()),
            "identifier of the model = \"\"",
        ),
        (
            model!(|info| info.identifier = "../../escape".into()),
            "identifier of the model = \"../../escape\"",
        ),
        (model!(|info| info.identifier = "7up".into()), "no digit first"),
        (
            model!(|info| info.package = "a/../b"),
            "package of the model = \"a/../b\"",
        ),
        (
            model!(|info| info.description = "bell \u{7}"),
            "description of the model",
        ),
        (model!(|info| info.version = "\u{1}"), "version of the model"),
        (
            model!(|info| info.step_size = f64::NAN),
            "step size of the default experiment = NaN s",
        ),
        (
            model!(|info| info.step_size = 0.0),
            "step size of the default experiment = 0 s",
        ),
        (
            model!(|info| info.stop_time = -1.0),
            "stop time of the default experiment = -1 s",
        ),
    ];
    for (model, expected) in cases {
        let message = refusal(model);
        assert!(message.contains(expected), "{message}");
    }
}

fn parameter(name: &str, range: std::ops::RangeInclusive<f64>, start: f64) -> Variable {
    Row::<()>::parameter(name, Unit::ONE, range, start, "").variable
}

fn output(name: &str, nominal: f64) -> Variable {
    Row::<()>::output(name, Unit::ONE, nominal, "", |()| 0.0).variable
}

#[test]
fn variables_are_checked() {
    type Variables = fn(&StructuralParameters) -> Vec<Variable>;
    let cases: [(Variables, &str); 9] = [
        (
            |_| vec![output("x", 1.0), output("x", 1.0)],
            "two variables are named x",
        ),
        (
            |_| vec![output("x", 1.0), parameter("p", 0.0..=1.0, 0.0)],
            "p comes after a variable that the model computes",
        ),
        (|_| vec![output("", 1.0)], "name of a variable = \"\""),
        (|_| vec![output("time", 1.0)], "name of a variable = \"time\""),
        (
            |_| vec![output("bell\u{7}", 1.0)],
            "name of a variable = \"bell\\u{7}\"",
        ),
        (|_| vec![output("x", 0.0)], "nominal value of x = 0"),
        (|_| vec![parameter("p", 0.0..=1.0, 2.0)], "p = 2"),
        (|_| vec![parameter("p", 1.0..=0.0, 0.5)], "range of p = from 1 to 0"),
        (
            |_| vec![parameter("p", f64::NAN..=1.0, 0.5)],
            "range of p = from NaN to 1",
        ),
    ];
    for (variables, expected) in cases {
        let message = refusal(ModelType { variables, ..MODEL });
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn an_array_with_the_name_of_a_scalar_is_refused() {
    let model = ModelType {
        variables: |_| vec![output("b", 1.0), output("b[1]", 1.0), output("b[2]", 1.0)],
        ..MODEL
    };
    let mut component = Component::new(&model, &[]).unwrap();
    component.arrays = true;
    let message = pack(&component, Version::Three, &Libraries::default())
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("arrays = b is not allowed: one variable of each name"),
        "{message}"
    );
}

/// The schema of FMI 2.0 asks for one element at least in each of its lists.
#[test]
fn lists_without_elements_are_left_out() {
    let model = ModelType {
        variables: |_| vec![parameter("p", 0.0..=1.0, 0.0)],
        ..MODEL
    };
    let text = model_description::write(&Component::new(&model, &[]).unwrap(), Version::Two);
    assert!(
        text.contains("<ModelStructure>") && !text.contains("<Outputs") && !text.contains("<InitialUnknowns"),
        "{text}"
    );
}

/// Calculated parameters are tunable if they may depend on a tunable one (FMI 2.0 section 2.2.7, FMI 3.0 section 2.4.7.4).
#[test]
fn tunable_parameters_and_what_is_calculated_from_them_say_so() {
    let component = Component::new(&MODEL, &[]).unwrap();
    for version in [Version::Two, Version::Three] {
        let text = model_description::write(&component, version);
        for (name, variability) in [
            ("spring.stiffness", "tunable"),
            ("damper.damping", "tunable"),
            ("body.mass", "fixed"),
            ("seed", "fixed"),
            ("natural.angle_rate", "tunable"),
            ("frame.position", "continuous"),
            ("steps", "discrete"),
        ] {
            let begin = text.find(&format!("name=\"{name}\"")).unwrap();
            let element = &text[begin..begin + text[begin..].find('>').unwrap()];
            let expected = format!("variability=\"{variability}\"");
            assert!(element.contains(&expected), "{version:?}: {element}");
        }
    }
}

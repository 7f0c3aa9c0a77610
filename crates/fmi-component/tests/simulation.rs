//! A model in a Rust program: parameters in, inputs, steps, outputs by name, saved states; and what is refused with which words.
#![allow(clippy::unwrap_used)]

use fmi_component::{
    DynSimulation, Error, Model, ModelType, Result, Row, Simulation, StructuralParameters, Table, Unit, Value, Variable,
};
use oscillators::Oscillators;

type Oscillation = Simulation<Oscillators>;

fn message_of<T>(result: Result<T>) -> String {
    match result {
        Ok(_) => panic!("not refused"),
        Err(error) => error.to_string(),
    }
}

fn bodies(count: u32) -> Oscillation {
    Simulation::new(&[("bodies", count)], &[]).unwrap()
}

#[test]
fn refusals_name_variable_and_remedy() {
    let start = |given: &[(&str, Value)]| Oscillation::new(&[("bodies", 5)], given);
    assert!(message_of(start(&[("spring.glue", 1.0.into())])).contains("drive input has no variable spring.glue"));
    assert!(message_of(start(&[("damper.damping", (-1.0).into())])).contains("damper.damping = -1"));
    assert!(message_of(start(&[("seed", 7.0.into())])).contains("a whole number"));
    assert!(message_of(start(&[("steps", 7.into())])).contains("computed by the model"));
    assert!(message_of(Oscillation::new(&[("bodies", 0)], &[])).contains("number of bodies = 0"));
    assert!(message_of(Oscillation::new(&[("bodies", 101)], &[])).contains("1 to 100"));
    assert!(message_of(Oscillation::new(&[("wheels", 1)], &[])).contains("one of the model oscillators: bodies"));
    assert!(message_of(bodies(5).set_at(100_000, 1.0)).contains("0 to 16"));
    assert!(message_of(bodies(5).value(100_000)).contains("0 to 16"));
}

/// A model that divides by a damping would take -0.0 for a rate of minus infinity.
#[test]
fn a_model_sees_no_negative_zero() {
    let bits = |row: &Oscillation, name: &str| row.real(name).map(f64::to_bits);
    let given = [("damper.damping", (-0.0).into())];
    let mut row = Oscillation::new(&[("bodies", 2)], &given).unwrap();
    row.set("frame.position", -0.0).unwrap();
    assert_eq!(bits(&row, "damper.damping"), Ok(0));
    assert_eq!(bits(&row, "frame.position"), Ok(0));
    let negative: Vec<Value> = (row.values().as_slice().iter())
        .map(|value| match value {
            Value::Real(0.0) => Value::Real(-0.0),
            other => *other,
        })
        .collect();
    let mut values = row.values().clone();
    values.put_back(&negative, &[]).unwrap();
    assert!(values.same_fixed_parameters(&negative, &[]));
    assert_eq!(values.real("frame.velocity").to_bits(), 0);
    for variable in row
        .variables()
        .iter()
        .filter(|variable| variable.causality.is_settable())
    {
        let Value::Real(real) = values.get(row.position(&variable.name).unwrap()).unwrap() else {
            continue;
        };
        assert!(real.to_bits() != (-0.0_f64).to_bits(), "{}", variable.name);
    }
}

#[test]
fn refused_calls_change_nothing() {
    let mut row = bodies(5);
    row.advance_to(0.5).unwrap();
    let before = row.save();
    assert!(message_of(row.set("body.mass", 0.2)).contains("frozen"));
    assert!(message_of(row.set("frame.position", f64::NAN)).contains("frame.position"));
    assert!(message_of(row.real("steps")).contains("Read it as an integer"));
    assert!(message_of(row.integer("frame.reaction_force")).contains("Read it as a real"));
    for end_time in [0.5, 0.0] {
        assert!(message_of(row.advance_to(end_time)).contains("after 0.5 s"));
    }
    for end_time in [f64::NAN, f64::INFINITY, 1e300] {
        assert!(message_of(row.advance_to(end_time)).contains("to 1e10 s"));
    }
    assert!(message_of(row.set_start_time(0.0)).contains("has started at 0 s"));
    assert_eq!((row.save(), row.time()), (before, 0.5));
    assert!(row.integer("steps").unwrap() == 500);
}

#[test]
fn a_simulation_that_has_not_started_takes_parameters_and_computes_nothing() {
    let structure = StructuralParameters::defaults(&Oscillators::info());
    let mut row = Oscillation::prepare(structure);
    row.set_start_time(2.0).unwrap();
    row.set("body.mass", 0.4).unwrap();
    assert_eq!((row.real("body.mass"), row.time()), (Ok(0.4), 2.0));
    for refused in [
        message_of(row.integer("steps")),
        message_of(row.advance_to(3.0)),
        message_of(row.model()),
    ] {
        assert!(refused.contains("has not started"), "{refused}");
    }
    row.start(row.start_time()).unwrap();
    row.advance_to(2.5).unwrap();
    row.stop();
    assert_eq!((row.time(), row.is_started()), (2.0, false));
    row.reset();
    assert_eq!((row.time(), row.real("body.mass")), (0.0, Ok(0.1)));
}

#[test]
fn a_simulation_is_its_model() {
    let given = [("body.mass", 0.3.into()), ("seed", 3.into())];
    let mut row = Oscillation::new(&[("bodies", 20)], &given).unwrap();
    let mut model = Oscillators::new(row.structure(), 0.0, row.values()).unwrap();
    for end_time in [0.1, 0.25] {
        row.advance_to(end_time).unwrap();
        model.advance_to(end_time, row.values()).unwrap();
    }
    assert!(row.model().unwrap().state() == model.state());
    let rows = Oscillators::variables(row.structure());
    let read: Vec<_> = rows
        .iter()
        .filter_map(|row| row.read.as_ref())
        .map(|read| read.value(&model))
        .collect();
    assert!(row.all_values().unwrap().ends_with(&read));
}

#[test]
fn reals_read_at_once_are_those_read_one_by_one() {
    let mut row = bodies(5);
    row.advance_to(0.1).unwrap();
    let all = row.all_values().unwrap();
    for first in 0..all.len() {
        for count in 0..=all.len() - first {
            let mut reals = vec![f64::NAN; count];
            let read = row.read_reals(first, &mut reals);
            let wanted = &all[first..first + count];
            match wanted.iter().find(|value| matches!(value, Value::Integer(_))) {
                None => assert_eq!(reals.into_iter().map(Value::Real).collect::<Vec<_>>(), wanted),
                Some(_) => assert!(message_of(read).contains("is a whole number")),
            }
        }
    }
    assert!(message_of(row.read_reals(all.len() - 1, &mut [0.0; 2])).contains("0 to 16"));
    row.stop();
    assert!(message_of(row.read_reals(all.len() - 1, &mut [0.0])).contains("has not started"));
}

#[test]
fn a_model_behind_a_pointer_gives_the_bits_of_its_type() {
    const MODEL: ModelType = ModelType::of::<Oscillators>();
    let structure = StructuralParameters::defaults(&(MODEL.info)());
    let (mut typed, mut boxed) = (bodies(3), (MODEL.prepare)(structure));
    boxed.start(0.0).unwrap();
    typed.advance_to(0.1).unwrap();
    boxed.advance_to(0.1).unwrap();
    let saved = boxed.save();
    assert_eq!(boxed.to_bytes().unwrap(), typed.to_bytes().unwrap());
    boxed.advance_to(0.2).unwrap();
    typed.advance_to(0.2).unwrap();
    assert_eq!(
        boxed.value(boxed.position("steps").unwrap()),
        typed.integer("steps").map(Value::Integer)
    );
    let payload = boxed.saved_to_payload(&saved).unwrap();
    boxed.restore(&boxed.saved_from_payload(&payload).unwrap()).unwrap();
    assert_eq!(boxed.time(), 0.1);
    for damaged in [&payload[..payload.len() - 1], &[payload.as_slice(), &[0]].concat()] {
        assert!(message_of(boxed.saved_from_payload(damaged)).contains("damaged"));
    }
}

/// The state as bytes with another time in it. `Saved` begins with start and time, each a double.
fn moved(row: &Oscillation, time: f64) -> Result<fmi_component::DynSaved> {
    let saved = DynSimulation::save(row);
    let mut payload = row.saved_to_payload(&saved).unwrap();
    payload[8..16].copy_from_slice(&time.to_le_bytes());
    row.saved_from_payload(&payload)
}

#[test]
fn a_refused_state_changes_nothing() {
    let mut row = bodies(5);
    row.advance_to(0.5).unwrap();
    let before = row.save();
    assert!(message_of(moved(&row, f64::NAN)).contains("NaN"));
    for elsewhere in [0.0, 0.4, 0.6] {
        let refusal = message_of(moved(&row, elsewhere));
        assert!(
            refusal.contains(&format!("its time is {elsewhere} s and its model's 0.5 s")),
            "{refusal}"
        );
    }
    assert!(moved(&row, 0.5).is_ok());
    let larger = bodies(6);
    assert!(message_of(row.restore(&larger.save())).contains("another number of bodies"));
    let bytes = larger.to_bytes().unwrap();
    let refusal = message_of(row.restore_bytes(&bytes));
    assert!(
        refusal.contains("bodies=6") && refusal.contains("bodies=5"),
        "{refusal}"
    );
    let mut bytes = row.to_bytes().unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    assert!(message_of(row.restore_bytes(&bytes)).contains("checksum"));
    assert_eq!(row.save(), before);
}

#[test]
fn a_restored_state_restores_its_parameters() {
    let given = [("body.mass", 0.2.into()), ("seed", 5.into())];
    let mut one = Oscillation::new(&[("bodies", 20)], &given).unwrap();
    one.advance_to(0.1).unwrap();
    let mut other = bodies(20);
    other.restore(&one.save()).unwrap();
    for simulation in [&mut one, &mut other] {
        simulation.advance_to(0.2).unwrap();
    }
    assert_eq!(one.save(), other.save());
}

#[test]
fn the_limit_of_work_outlives_a_model_made_anew() {
    let mut one = bodies(5);
    let bytes = one.to_bytes().unwrap();
    one.limit_work(3);
    one.restore_bytes_anew(&bytes).unwrap();
    assert!(message_of(one.advance_to(1.0)).contains("more than one call may do"));
    assert_eq!(one.to_bytes().unwrap(), bytes);
}

fn variable(row: Row<()>) -> Variable {
    row.variable
}

fn output(name: &str) -> Row<()> {
    Row::output(name, Unit::ONE, 1.0, "", |()| 0.0)
}

#[test]
#[should_panic(expected = "two variables are named x")]
fn a_table_of_two_variables_of_one_name_panics() {
    Table::new(["x", "x"].map(output).map(variable).into());
}

#[test]
#[should_panic(expected = "comes after a variable that the model computes")]
fn a_table_with_an_input_after_an_output_panics() {
    Table::new([output("x"), Row::input("u", Unit::ONE, 1.0, "")].map(variable).into());
}

#[test]
#[should_panic(expected = "v, the derivative of x, is no variable of the same causality")]
fn a_table_with_a_derivative_of_another_causality_panics() {
    let rate = Row::input("v", Unit::ONE, 1.0, "");
    Table::new([rate, output("x").with_derivative("v")].map(variable).into());
}

#[test]
#[should_panic(expected = "x is tunable, but no parameter")]
fn a_table_with_a_tunable_output_panics() {
    Table::new([output("x").tunable()].map(variable).into());
}

#[test]
fn a_table_knows_when_values_may_change() {
    use fmi_component::Variability::{Continuous, Discrete, Fixed, Tunable};
    let parameter = |name: &str| Row::<()>::parameter(name, Unit::ONE, 0.0..=1.0, 0.5, "");
    let calculated = |name: &str| output(name).constant();
    let depending = |name: &str, on: &'static str| calculated(name).depending_on(&[on].into());
    let rows = vec![
        parameter("a"),
        parameter("b").tunable(),
        Row::input("u", Unit::ONE, 1.0, ""),
        calculated("of_all"),
        depending("of_a", "a"),
        depending("of_b", "b"),
        output("x"),
        Row::count_output("n", "", |()| 0),
    ];
    let table = Table::new(rows.into_iter().map(variable).collect());
    let all: Vec<_> = (0..8).map(|position| table.variability(position)).collect();
    assert_eq!(
        all,
        [
            Fixed, Tunable, Continuous, Tunable, Fixed, Tunable, Continuous, Discrete
        ]
    );
    assert_eq!(table.tunable(), [1]);
    let fixed = Table::new([parameter("a"), calculated("of_all")].map(variable).into());
    assert_eq!(fixed.variability(1), Fixed);
}

#[test]
fn what_is_tunable_is_a_part_of_the_fingerprint() {
    let row = || Row::<()>::parameter("a", Unit::ONE, 0.0..=1.0, 0.5, "");
    let fingerprint = |row: Row<()>| fmi_component::variable::fingerprint("1", &[row.variable]);
    assert_ne!(fingerprint(row()), fingerprint(row().tunable()));
}

#[test]
fn a_tunable_parameter_is_set_between_steps_of_a_program() {
    let mut row = bodies(2);
    row.advance_to(0.1).unwrap();
    let before = row.save();
    row.set("spring.stiffness", 400.0).unwrap();
    assert_eq!(row.real("spring.stiffness"), Ok(400.0));
    row.advance_to(0.2).unwrap();
    let after = row.save();
    row.restore(&before).unwrap();
    assert_eq!((row.real("spring.stiffness"), row.save()), (Ok(100.0), before));
    row.advance_to(0.2).unwrap();
    assert_ne!(row.save(), after);
    row.stop();
    row.restore(&after).unwrap();
    assert_eq!((row.real("spring.stiffness"), row.save()), (Ok(400.0), after));
}

#[test]
fn a_table_knows_positions_and_derivatives() {
    let table = Table::new([output("x").with_derivative("v"), output("v")].map(variable).into());
    assert_eq!((table.position("v"), table.position("w")), (Some(1), None));
    assert_eq!((table.derivative(0), table.derivative(1)), (Some(1), None));
    let has = |causality| table.has_derivatives(causality);
    assert!(has(fmi_component::Causality::Output) && !has(fmi_component::Causality::Input));
}

#[test]
fn texts_are_parsed_by_kind() {
    let rows = Oscillators::variables(&StructuralParameters::defaults(&Oscillators::info()));
    let parse = |name: &str, text: &str| {
        let row = rows.iter().find(|row| row.variable.name == name).unwrap();
        row.variable.parse(text).map_err(|error: Error| error.to_string())
    };
    assert_eq!(parse("body.mass", "1e-1"), Ok(Value::Real(0.1)));
    assert_eq!(parse("start.pattern", "at_rest"), Ok(Value::Integer(2)));
    assert!(parse("seed", "1.5").unwrap_err().contains("a whole number"));
    assert!(parse("body.mass", "1,5").unwrap_err().contains("body.mass = 1,5"));
    assert!(
        parse("start.pattern", "fast")
            .unwrap_err()
            .contains("one of: random, at_rest")
    );
}

/// What is outside belongs to the parameters: a state brings them back, and with them the warnings.
#[test]
fn parameters_outside_of_their_recommended_ranges_are_warned_of_until_they_were_told() {
    let told = |row: &Oscillation, topics: &[&'static str]| -> Vec<String> {
        row.warnings(topics).into_iter().map(|warning| warning.text).collect()
    };
    let inside = bodies(2);
    assert_eq!(told(&inside, &[]), Vec::<String>::new());
    let given = [("damper.damping", 20.0.into())];
    let mut outside = Oscillation::new(&[("bodies", 2)], &given).unwrap();
    let warnings = outside.warnings(&[]);
    assert_eq!(warnings.len(), 1);
    assert!(
        warnings[0]
            .text
            .starts_with("damper.damping = 20 kg/s makes the damping ratio 3.16")
    );
    assert_eq!(told(&outside, &[warnings[0].topic]), Vec::<String>::new());
    let saved = outside.save();
    outside.restore(&inside.save()).unwrap();
    assert_eq!(
        told(&outside, &[]),
        Vec::<String>::new(),
        "the parameters of the state are inside"
    );
    outside.restore(&saved).unwrap();
    assert_eq!(told(&outside, &[]).len(), 1);
    outside.stop();
    assert_eq!(told(&outside, &[]), Vec::<String>::new(), "nothing before the start");
}

/// Recommended ranges say nothing of what a model is: FMUs of earlier builds stay valid.
#[test]
fn recommended_ranges_are_no_part_of_the_fingerprint() {
    let variables = Oscillators::variables(&bodies(2).structure().clone());
    let with: Vec<Variable> = variables.into_iter().map(|row| row.variable).collect();
    let without: Vec<Variable> = with
        .iter()
        .cloned()
        .map(|variable| Variable {
            outside_states: false,
            recommended: None,
            ..variable
        })
        .collect();
    assert_ne!(with, without);
    let fingerprint = |variables: &[Variable]| fmi_component::variable::fingerprint("1", variables);
    assert_eq!(fingerprint(&with), fingerprint(&without));
}

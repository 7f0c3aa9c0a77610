//! An importer that allocates nothing while it steps: one instance behind the functions that an FMU exports.

use std::ffi::CString;
use std::ptr::{null, null_mut};

use fmi_component::c_api::fmi3::{Instantiation, StepResults};
use fmi_component::c_api::values::{self, Arrays};
use fmi_component::c_api::{CallbackFunctions, Entry, Status, calls, fmi2, fmi3, free};
use fmi_component::instance::Access;
use fmi_component::{Causality, Instance, Kind, ModelType, StructuralParameters, Variable, Version};
use fmi_component::{token, value_reference};

/// `fmi2CoSimulation`.
const CO_SIMULATION: i32 = 1;

/// A ready instance with the references and the values that go back and forth.
pub struct Importer {
    entry: Entry,
    /// Names of the inputs, in the order of their references.
    names: Vec<String>,
    inputs: Vec<u32>,
    given: Vec<f64>,
    /// Inputs that have a derivative among the inputs, for FMI 2.0.
    integrals: Vec<u32>,
    orders: Vec<i32>,
    /// Where in `given` the derivative of each of them is, and what it is.
    places: Vec<usize>,
    rates: Vec<f64>,
    reals: Vec<u32>,
    read: Vec<f64>,
    counts: Vec<u32>,
    integers: Vec<i32>,
    options: Vec<u32>,
    longs: Vec<i64>,
}

fn references(variables: &[Variable], wanted: impl Fn(&Variable) -> bool) -> Vec<u32> {
    let found = variables.iter().enumerate().filter(|(_, variable)| wanted(variable));
    found.map(|(position, _)| value_reference(position)).collect()
}

impl Importer {
    /// An instance with start values, initialised at time 0.
    pub fn new(model: &ModelType, disks: u32, version: Version) -> Self {
        let info = (model.info)();
        let disks = disks.min(*info.structure[0].range.end());
        let structure = StructuralParameters::choose(&info, &[("disks", disks)]).unwrap();
        let variables = (model.variables)(&structure);
        let token = CString::new(token::write(&info, &structure, &variables, false)).unwrap();
        let pointer = match version {
            Version::Two => {
                let functions = CallbackFunctions {
                    logger: None,
                    allocate_memory: None,
                    free_memory: None,
                    step_finished: None,
                    component_environment: null_mut(),
                };
                unsafe { fmi2::instantiate(model, c"a".as_ptr(), CO_SIMULATION, token.as_ptr(), &functions, 0) }
            }
            Version::Three => unsafe { fmi3::instantiate(model, plain(&token)) },
        };
        assert!(!pointer.is_null());
        let function = "a function";
        let entry = Entry {
            pointer,
            version,
            function,
        };
        let output = |variable: &Variable| variable.causality == Causality::Output;
        let real = |variable: &Variable| matches!(variable.kind, Kind::Real(_));
        let input = |variable: &Variable| variable.causality == Causality::Input;
        let inputs = references(&variables, input);
        let reals = references(&variables, |variable| output(variable) && real(variable));
        let integer = |variable: &Variable| matches!(variable.kind, Kind::Integer { .. });
        let counts = references(&variables, |variable| output(variable) && integer(variable));
        let options = references(&variables, |variable| {
            output(variable) && !real(variable) && !integer(variable)
        });
        let names: Vec<String> = variables
            .iter()
            .filter(|variable| input(variable))
            .map(|variable| variable.name.to_string())
            .collect();
        let integrals = references(&variables, |variable| input(variable) && variable.derivative.is_some());
        let derivatives = variables
            .iter()
            .filter(|variable| input(variable))
            .filter_map(|variable| variable.derivative.as_ref());
        let places: Vec<usize> = derivatives
            .map(|derivative| names.iter().position(|name| name == derivative).unwrap())
            .collect();
        let importer = Self {
            entry,
            names,
            given: vec![0.0; inputs.len()],
            inputs,
            orders: vec![1; integrals.len()],
            integrals,
            rates: vec![0.0; places.len()],
            places,
            read: vec![0.0; reals.len()],
            reals,
            integers: vec![0; counts.len()],
            counts,
            longs: vec![0; options.len()],
            options,
        };
        importer.initialize();
        importer
    }

    fn initialize(&self) {
        let entered = match self.entry.version {
            Version::Two => unsafe { calls::transition(self.entry, Instance::enter_initialization) },
            Version::Three => unsafe { fmi3::enter_initialization_mode(self.entry, None, 0.0, None) },
        };
        let left = unsafe { calls::transition(self.entry, Instance::exit_initialization) };
        assert_eq!((entered, left), (Status::Ok, Status::Ok));
    }

    /// One communication step as a controller does it: sets all inputs to what `input` says of their names, does the step from
    /// `current` by `step` \[s\], reads all outputs.
    pub fn exchange(&mut self, current: f64, step: f64, input: impl Fn(&str) -> f64) {
        for (given, name) in self.given.iter_mut().zip(&self.names) {
            *given = input(name);
        }
        let inputs = arrays(&self.inputs, self.given.as_ptr());
        assert_eq!(unsafe { values::set_real(self.entry, inputs) }, Status::Ok);
        if self.entry.version == Version::Two {
            // The velocity of a displacement, which was set before: the two are the same variable.
            for (rate, place) in self.rates.iter_mut().zip(&self.places) {
                *rate = self.given[*place];
            }
            let rates = arrays(&self.integrals, self.rates.as_ptr());
            let set = unsafe { values::set_input_derivatives(self.entry, self.orders.as_ptr(), rates) };
            assert_eq!(set, Status::Ok);
        }
        assert_eq!(
            self.step(current, step),
            Status::Ok,
            "the step from {current} s by {step} s"
        );
        let reals = arrays(&self.reals, self.read.as_mut_ptr());
        assert_eq!(unsafe { values::get_real(self.entry, reals) }, Status::Ok);
        let whole = if self.entry.version == Version::Two {
            Access::AnyInteger
        } else {
            Access::Integer
        };
        let counts = arrays(&self.counts, self.integers.as_mut_ptr());
        assert_eq!(unsafe { values::get_whole(self.entry, counts, whole) }, Status::Ok);
        let options = arrays(&self.options, self.longs.as_mut_ptr());
        assert_eq!(
            unsafe { values::get_whole(self.entry, options, Access::Long) },
            Status::Ok
        );
    }

    fn step(&self, current: f64, step: f64) -> Status {
        if self.entry.version == Version::Two {
            return unsafe { fmi2::do_step(self.entry, current, step) };
        }
        let (mut flags, mut reached) = ([0_u8; 3], 0.0);
        let [event, terminate, early] = &mut flags;
        let results = StepResults {
            event_handling_needed: event,
            terminate_simulation: terminate,
            early_return: early,
            last_successful_time: &mut reached,
        };
        unsafe { fmi3::do_step(self.entry, current, step, results) }
    }
}

impl Drop for Importer {
    fn drop(&mut self) {
        unsafe { free(self.entry.pointer, self.entry.version) };
    }
}

fn arrays<T>(references: &[u32], values: T) -> Arrays<T> {
    Arrays {
        references: references.as_ptr(),
        count: references.len(),
        values,
        length: references.len(),
    }
}

/// An instance that logs nothing and handles no events.
fn plain(token: &CString) -> Instantiation {
    Instantiation {
        name: c"a".as_ptr(),
        token: token.as_ptr(),
        logging_on: 0,
        event_mode_used: 0,
        early_return_allowed: 0,
        required_intermediate_variables: null(),
        required_count: 0,
        environment: null_mut(),
        log: None,
        intermediate_update: None,
    }
}

//! An importer that measures: nanoseconds of each call of an instance, medians of seven runs.
#![allow(unsafe_code)] // plays the importer

use cpu_time::ProcessTime;
use std::ffi::CString;
use std::hint::black_box;
use std::ptr::{null, null_mut};

use fmi_component::c_api::fmi3::{self, Instantiation, StepResults};
use fmi_component::c_api::values::{self, Arrays};
use fmi_component::c_api::{Entry, Opaque, Status, calls, free, states};
use fmi_component::life_cycle::Version::Three;
use fmi_component::{
    Causality, Instance, Kind, Model, ModelType, Simulation, StructuralParameters, Variable, token, value_reference,
};

const RUNS: usize = 7;

/// Median nanoseconds of one of `calls` calls of `work`.
fn median(calls: u32, mut work: impl FnMut(u32)) -> f64 {
    let mut each: Vec<f64> = (0..RUNS as u32)
        .map(|run| {
            let start = ProcessTime::now();
            (0..calls).for_each(|call| work(run * calls + call));
            start.elapsed().as_secs_f64() / f64::from(calls) * 1e9
        })
        .collect();
    each.sort_by(f64::total_cmp);
    each[RUNS / 2]
}

struct Component(Entry);

impl Component {
    fn ready(model: &ModelType, structure: &StructuralParameters, variables: &[Variable]) -> Self {
        let text = token::write(&(model.info)(), structure, variables, false);
        let text = CString::new(text).expect("no zero byte");
        let asked = Instantiation {
            name: c"bench".as_ptr(),
            token: text.as_ptr(),
            logging_on: 0,
            event_mode_used: 0,
            early_return_allowed: 0,
            required_intermediate_variables: null(),
            required_count: 0,
            environment: null_mut(),
            log: None,
            intermediate_update: None,
        };
        // SAFETY: the strings outlive the call.
        let pointer = unsafe { fmi3::instantiate(model, asked) };
        assert!(!pointer.is_null(), "the token is right");
        let entry = Entry {
            pointer,
            version: Three,
            function: "a function",
        };
        // SAFETY: a living instance.
        let entered = unsafe { fmi3::enter_initialization_mode(entry, None, 0.0, None) };
        // SAFETY: a living instance.
        let left = unsafe { calls::transition(entry, Instance::exit_initialization) };
        assert_eq!((entered, left), (Status::Ok, Status::Ok));
        Self(entry)
    }

    fn step(&self, current: f64, step: f64) {
        let (mut flags, mut reached) = ([0_u8; 3], 0.0);
        let [event, terminate, early] = &mut flags;
        let results = StepResults {
            event_handling_needed: event,
            terminate_simulation: terminate,
            early_return: early,
            last_successful_time: &mut reached,
        };
        // SAFETY: a living instance and living flags.
        let status = unsafe { fmi3::do_step(self.0, current, step, results) };
        assert_eq!(status, Status::Ok);
    }

    fn get(&self, references: &[u32], into: &mut [f64]) {
        let arrays = Arrays {
            references: references.as_ptr(),
            count: references.len(),
            values: into.as_mut_ptr(),
            length: into.len(),
        };
        // SAFETY: a living instance and arrays of the lengths given.
        let status = unsafe { values::get_real(self.0, arrays) };
        assert_eq!(status, Status::Ok);
    }

    fn set(&self, references: &[u32], from: &[f64]) {
        let arrays = Arrays {
            references: references.as_ptr(),
            count: references.len(),
            values: from.as_ptr(),
            length: from.len(),
        };
        // SAFETY: a living instance and arrays of the lengths given.
        let status = unsafe { values::set_real(self.0, arrays) };
        assert_eq!(status, Status::Ok);
    }

    fn save(&self, state: &mut Opaque) {
        // SAFETY: a living instance and a living handle.
        let status = unsafe { states::get(self.0, state) };
        assert_eq!(status, Status::Ok);
    }

    fn restore(&self, state: Opaque) {
        // SAFETY: a living instance.
        let status = unsafe { states::set(self.0, state) };
        assert_eq!(status, Status::Ok);
    }

    fn size(&self, state: Opaque) -> usize {
        let mut size = 0;
        // SAFETY: a living instance and a living size.
        let status = unsafe { states::size(self.0, state, &mut size) };
        assert_eq!(status, Status::Ok);
        size
    }
}

impl Drop for Component {
    fn drop(&mut self) {
        // SAFETY: made by `ready`, freed once.
        unsafe { free(self.0.pointer, Three) };
    }
}

fn references(variables: &[Variable], causality: Causality) -> Vec<u32> {
    let wanted = variables
        .iter()
        .enumerate()
        .filter(|(_, variable)| variable.causality == causality && matches!(variable.kind, Kind::Real(_)));
    wanted.map(|(position, _)| value_reference(position)).collect()
}

/// Prints the cost of each call of the model M with these structural parameters. `step` \[s\] decides how much of the model's
/// work is in a step.
pub fn measure<M: Model>(chosen: &[(&str, u32)], step: f64, calls: u32) {
    let model = ModelType::of::<M>();
    let structure = StructuralParameters::choose(&(model.info)(), chosen).expect("in range");
    let variables = (model.variables)(&structure);
    let component = Component::ready(&model, &structure, &variables);
    let stepping = median(calls, |call| component.step(f64::from(call) * step, step));
    let mut native = Simulation::<M>::new(chosen, &[]).expect("legal defaults");
    let alone = median(calls, |call| {
        native.advance_to(f64::from(call + 1) * step).expect("runs");
    });
    let outputs = references(&variables, Causality::Output);
    let inputs = references(&variables, Causality::Input);
    let (mut read, given) = (vec![0.0; outputs.len()], vec![0.0; inputs.len()]);
    let one = median(calls, |_| component.get(&outputs[..1], black_box(&mut read[..1])));
    let all = median(calls, |_| component.get(&outputs, black_box(&mut read)));
    let setting = median(calls, |_| component.set(&inputs, black_box(&given)));
    let mut state = null_mut();
    component.save(&mut state);
    let saving = median(calls, |_| component.save(&mut state));
    let restoring = median(calls, |_| component.restore(state));
    println!(
        "{} {chosen:?}, step {step:.0e} s: doStep {stepping:.0} ns, in Rust alone {alone:.0}; get one {one:.0}, \
         all {} {all:.0}; set {} inputs {setting:.0}; state get {saving:.0}, set {restoring:.0} ns ({} bytes, {} variables)",
        (model.info)().identifier,
        outputs.len(),
        inputs.len(),
        component.size(state),
        variables.len()
    );
}

//! Cost of the FMI boundary: `cargo bench --bench boundary`.
//!
//! Nanoseconds of each call through the C entry points of FMI 3.0, beside the same step of the scene alone. Medians of
//! seven runs; built for the generic x86-64 that ships.
#![allow(unsafe_code)] // plays the importer

use cpu_time::ProcessTime;
use std::ffi::CString;
use std::hint::black_box;
use std::ptr::{null, null_mut};
use std::sync::Arc;

use jostle::fmi::Version::Three;
use jostle::fmi::abi::common::{self, Opaque, Status};
use jostle::fmi::abi::{fmi3, intermediate, states, values};
use jostle::fmi::{Instance, token, value_reference};
use jostle::scene::packing::PackingOnInput;
use jostle::scene::packing::event_driven::HardPackingOnInput;
use jostle::scene::wedge::{WedgeEventDrivenOnInput, WedgeEventDrivenOnSine, WedgeMap};
use jostle::scene::{Causality, Choice, Kind, Scene, Table, Values};

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

struct Component<S: Scene> {
    pointer: Opaque,
    scene: std::marker::PhantomData<S>,
}

impl<S: Scene> Component<S> {
    fn ready(choice: Choice) -> Self {
        let text = token::write(&S::card(), choice, &S::variables(choice));
        let text = CString::new(text).expect("no zero byte");
        // SAFETY: the strings outlive the call.
        let pointer = unsafe {
            fmi3::instantiate::<S>(
                (c"bench".as_ptr(), text.as_ptr()),
                0,
                (0, 0),
                (null(), 0),
                (null_mut(), None, None),
            )
        };
        assert!(!pointer.is_null(), "the token is right");
        let this = Self {
            pointer,
            scene: std::marker::PhantomData,
        };
        // SAFETY: a living instance.
        let entered = unsafe { fmi3::enter_initialization_mode::<S>(pointer, None, 0.0, 0, 0.0) };
        // SAFETY: a living instance.
        let left = unsafe { common::transition::<S>(pointer, Three, "exit", Instance::exit_initialization) };
        assert_eq!((entered, left), (Status::Ok, Status::Ok));
        this
    }

    fn step(&self, current: f64, step: f64) {
        let (mut flags, mut reached) = ([0_u8; 3], 0.0);
        let flags = flags.each_mut().map(|flag| flag as *mut u8);
        // SAFETY: a living instance and living flags.
        let status = unsafe { intermediate::do_step::<S>(self.pointer, (current, step), flags, &mut reached) };
        assert_eq!(status, Status::Ok);
    }

    fn get(&self, references: &[u32], into: &mut [f64]) {
        let arrays = (references.as_ptr(), references.len(), into.as_mut_ptr(), into.len());
        // SAFETY: a living instance and arrays of the lengths given.
        let status = unsafe { values::get_real::<S>(self.pointer, Three, "get", arrays) };
        assert_eq!(status, Status::Ok);
    }

    fn set(&self, references: &[u32], from: &[f64]) {
        let arrays = (references.as_ptr(), references.len(), from.as_ptr(), from.len());
        // SAFETY: a living instance and arrays of the lengths given.
        let status = unsafe { values::set_real::<S>(self.pointer, Three, "set", arrays) };
        assert_eq!(status, Status::Ok);
    }

    fn save(&self, state: &mut Opaque) {
        // SAFETY: a living instance and a living handle.
        let status = unsafe { states::get::<S>(self.pointer, Three, "save", state) };
        assert_eq!(status, Status::Ok);
    }

    fn restore(&self, state: Opaque) {
        // SAFETY: a living instance.
        let status = unsafe { states::set::<S>(self.pointer, Three, "restore", state) };
        assert_eq!(status, Status::Ok);
    }

    fn size(&self, state: Opaque) -> usize {
        let mut size = 0;
        // SAFETY: a living instance and a living size.
        let status = unsafe { states::size::<S>(self.pointer, Three, "size", state, &mut size) };
        assert_eq!(status, Status::Ok);
        size
    }
}

impl<S: Scene> Drop for Component<S> {
    fn drop(&mut self) {
        // SAFETY: made by `ready`, freed once.
        unsafe { common::free::<S>(self.pointer, Three) };
    }
}

fn references<S: Scene>(choice: Choice, causality: Causality) -> Vec<u32> {
    let rows = S::variables(choice);
    let wanted = rows
        .iter()
        .enumerate()
        .filter(|(_, row)| row.causality == causality && matches!(row.kind, Kind::Real(_)));
    wanted.map(|(position, _)| value_reference(position)).collect()
}

/// `step` \[s\] decides how much physics is in a step.
fn measure<S: Scene>(disks: u32, step: f64, calls: u32) {
    let choice = Choice { disks };
    let component = Component::<S>::ready(choice);
    let stepping = median(calls, |call| component.step(f64::from(call) * step, step));
    let mut scene_values = Values::new(Arc::new(Table::new(S::variables(choice))));
    let mut scene = S::new(choice, 0.0, &scene_values).expect("legal defaults");
    let physics = median(calls, |call| {
        scene
            .advance_to(f64::from(call + 1) * step, &scene_values)
            .expect("runs");
    });
    let writing = median(calls, |_| scene.write_outputs(scene_values.writer()));
    let outputs = references::<S>(choice, Causality::Output);
    let inputs = references::<S>(choice, Causality::Input);
    let (mut seen, given) = (vec![0.0; outputs.len()], vec![0.0; inputs.len()]);
    let one = median(calls, |_| component.get(&outputs[..1], black_box(&mut seen[..1])));
    let all = median(calls, |_| component.get(&outputs, black_box(&mut seen)));
    let setting = median(calls, |_| component.set(&inputs, black_box(&given)));
    let mut state = null_mut();
    component.save(&mut state);
    let saving = median(calls, |_| component.save(&mut state));
    let restoring = median(calls, |_| component.restore(state));
    let rows = S::variables(choice).len();
    println!(
        "{:38} {disks:3} disks, step {step:.0e} s: doStep {stepping:.0} ns, of it the scene {physics:.0} and its outputs \
         {writing:.0}; get one {one:.0}, all {} {all:.0}; set {} inputs {setting:.0}; state get {saving:.0}, set \
         {restoring:.0} ns ({} bytes, {rows} variables)",
        S::card().identifier,
        outputs.len(),
        inputs.len(),
        component.size(state)
    );
}

fn main() {
    measure::<WedgeMap>(1, 1e-9, 20_000);
    measure::<WedgeEventDrivenOnSine>(1, 1e-9, 20_000);
    measure::<WedgeEventDrivenOnInput>(1, 1e-9, 20_000);
    measure::<HardPackingOnInput>(60, 1e-9, 2_000);
    measure::<PackingOnInput>(60, 1e-9, 2_000);
    measure::<PackingOnInput>(60, 1e-3, 20);
}

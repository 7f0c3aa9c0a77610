//! A component from a plain struct: the fields are its variables and its state, one function is its step.
//!
//! Needs: a struct with `#[derive(Component)]` and an `impl CoSimulation`. Guarantees: a step that is refused leaves the fields
//! as they were; saved states hold all fields. Not here: models whose variables depend on choices ([`Model`]), the macro
//! (`fmi-component-derive`), what it calls ([`derived`](crate::derived)).

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::derived::Given;
use crate::error::Result;
use crate::info::ModelInfo;
use crate::model::{Model, Reached, Warning};
use crate::row::Row;
use crate::step::{Events, MOST_POINTS, Step};
use crate::structure::StructuralParameters;
use crate::values::Values;

/// A struct whose fields are variables: implemented by [`#[derive(Component)]`](derive@crate::Component), never by hand.
///
/// ```
/// use fmi_component::{CoSimulation, Component, ComponentModel, Enumeration, Result, Simulation, Step};
///
/// #[derive(Enumeration, Clone, Copy, PartialEq)]
/// enum Valve {
///     /// Nothing flows.
///     Closed,
///     /// The tank empties.
///     Open,
/// }
///
/// /// Tank with an outlet: dV/dt = -V / tau.
/// #[derive(Component)]
/// struct Tank {
///     /// Time that the outlet takes.
///     #[parameter(start = 10, min = 1e-3, unit = "s")]
///     tau: f64,
///     /// Position of the valve.
///     #[input]
///     valve: Valve,
///     /// Volume in the tank.
///     #[output(start = 2, unit = "m3")]
///     volume: f64,
///     steps: u64,
/// }
///
/// impl CoSimulation for Tank {
///     fn do_step(&mut self, step: &mut Step) -> Result<()> {
///         self.steps += 1;
///         if self.valve == Valve::Open {
///             self.volume *= (-step.size() / self.tau).exp();
///         }
///         Ok(())
///     }
/// }
///
/// let mut tank = Simulation::<ComponentModel<Tank>>::new(&[], &[("tau", 1.0.into())])?;
/// tank.advance_to(1.0)?;
/// assert_eq!(tank.real("volume")?, 2.0);
/// tank.set("valve", Valve::Open.number())?;
/// tank.advance_to(2.0)?;
/// assert_eq!(tank.real("volume")?, 2.0 * (-1.0_f64).exp());
/// # Ok::<(), fmi_component::Error>(())
/// ```
/// Any other type is refused, with what to write instead:
/// ```compile_fail
/// #[derive(fmi_component::Component)]
/// struct A { #[output] x: std::time::Duration }
/// # impl fmi_component::CoSimulation for A {
/// #     fn do_step(&mut self, _: &mut fmi_component::Step) -> fmi_component::Result<()> { Ok(()) }
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no component",
    note = "write #[derive(Component)] above the struct"
)]
pub trait Component: Sized + Send + 'static {
    /// All fields, as saved states hold them.
    type State: Clone + PartialEq + Serialize + DeserializeOwned + Send + 'static;

    /// Facts of the model.
    fn info() -> ModelInfo;

    /// The variables, parameters and inputs first.
    fn rows() -> Vec<Row<ComponentModel<Self>>>;

    /// A new component: parameters and inputs from `values`, the rest from the start values.
    fn first(values: &mut Given<'_>) -> Self;

    /// Takes the inputs from `values`.
    fn take(&mut self, values: &mut Given<'_>);

    /// Takes the tunable parameters from `values`.
    fn tune(&mut self, values: &mut Given<'_>);

    /// A copy of all fields.
    fn save(&self) -> Self::State;

    /// Puts a copy of all fields in the place of `state`, whose memory serves again.
    fn save_over(&self, state: &mut Self::State);

    /// Goes to a saved state.
    ///
    /// # Errors
    /// An array has another length: the state is damaged.
    fn load(&mut self, state: &Self::State) -> Result<()>;
}

/// What a component does: written by its author.
///
/// Before each call the fields of the inputs and of the tunable parameters hold what the importer has set; those of the other
/// parameters have it since [`CoSimulation::initialize`]. An error leaves the component as it was before the call. After a panic an
/// FMU's instance only reads, restores, resets and frees.
///
/// A component without a step is refused:
/// ```compile_fail
/// #[derive(fmi_component::Component)]
/// struct A { #[output] x: f64 }
/// fmi_component::export_fmu!(A);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no step",
    note = "write impl CoSimulation for {Self} {{ fn do_step(&mut self, step: &mut Step) -> Result<()> {{ .. }} }}"
)]
pub trait CoSimulation: Component {
    /// The component has events: it calls [`Step::stop_at_event`].
    const EVENTS: bool = false;

    /// Computes what depends on parameters and inputs before the first step. Fields hold their start values.
    ///
    /// # Errors
    /// Parameters that do not go together: [`Error::parameter`](crate::Error::parameter).
    fn initialize(&mut self, _start_time: f64) -> Result<()> {
        Ok(())
    }

    /// Advances all fields from the beginning of `step` to its end, or to an event if [`Step::stop_at_event`] says so.
    ///
    /// # Errors
    /// The step cannot be done: [`Error::Step`](crate::Error::Step), which lets the importer try a shorter one.
    fn do_step(&mut self, step: &mut Step) -> Result<()>;

    /// Computes what depends on tunable parameters (`#[parameter(start = .., tunable)]`) before the first step after one of them has
    /// changed. Their fields hold the new values.
    ///
    /// # Errors
    /// Parameters that do not go together: [`Error::parameter`](crate::Error::parameter).
    fn tuned(&mut self) -> Result<()> {
        Ok(())
    }

    /// What is doubtful about the run so far: see [`Model::warnings`].
    fn warnings(&self, _told: &[&'static str]) -> Vec<Warning> {
        Vec::new()
    }
}

/// The [`Model`] of a component: it with its time.
pub struct ComponentModel<C: Component> {
    component: C,
    /// Fields as they were before the last change that could be refused: memory for the next.
    before: Option<C::State>,
    start: f64,
    time: f64,
    name: &'static str,
    most_points: u64,
}

impl<C: Component + std::fmt::Debug> std::fmt::Debug for ComponentModel<C> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut written = formatter.debug_struct("ComponentModel");
        written
            .field("component", &self.component)
            .field("time", &self.time)
            .finish_non_exhaustive()
    }
}

impl<C: Component> ComponentModel<C> {
    /// The component as it is now.
    pub fn component(&self) -> &C {
        &self.component
    }

    /// Keeps the fields as they are, for [`ComponentModel::go_back`].
    #[inline]
    fn keep(&mut self) {
        match &mut self.before {
            Some(before) => self.component.save_over(before),
            None => self.before = Some(self.component.save()),
        }
    }

    /// The fields are as [`ComponentModel::keep`] kept them.
    #[cold]
    fn go_back(&mut self) -> Result<()> {
        match &self.before {
            Some(before) => self.component.load(before),
            None => Ok(()),
        }
    }
}

impl<C: CoSimulation> ComponentModel<C> {
    /// A step to `end`; the component is as before if it is refused.
    fn step(&mut self, end: f64, values: &Values, events: Events) -> Result<Reached> {
        self.keep();
        self.component.take(&mut Given::new(values));
        let mut step = Step::new([self.start, self.time, end], self.name, self.most_points, events);
        if let Err(refused) = self.component.do_step(&mut step) {
            self.go_back()?;
            return Err(refused);
        }
        let event = step.event();
        self.time = event.unwrap_or(end);
        Ok(Reached {
            time: self.time,
            event: event.is_some(),
        })
    }
}

impl<C: CoSimulation> Model for ComponentModel<C> {
    /// Time \[s\] and fields.
    type State = (f64, C::State);

    const EVENTS: bool = C::EVENTS;

    fn info() -> ModelInfo {
        C::info()
    }

    fn variables(_: &StructuralParameters) -> Vec<Row<Self>> {
        C::rows()
    }

    fn new(_: &StructuralParameters, start_time: f64, values: &Values) -> Result<Self> {
        let mut component = C::first(&mut Given::new(values));
        component.initialize(start_time)?;
        Ok(Self {
            component,
            before: None,
            start: start_time,
            time: start_time,
            name: C::info().name,
            most_points: MOST_POINTS,
        })
    }

    fn tune(&mut self, values: &Values) -> Result<()> {
        self.keep();
        self.component.tune(&mut Given::new(values));
        if let Err(refused) = self.component.tuned() {
            self.go_back()?;
            return Err(refused);
        }
        Ok(())
    }

    fn advance_to(&mut self, end_time: f64, values: &Values) -> Result<()> {
        let events = if C::EVENTS { Events::OnTheWay } else { Events::None };
        self.step(end_time, values, events).map(|_| ())
    }

    fn advance_to_event(&mut self, end_time: f64, values: &Values) -> Result<Reached> {
        let events = if C::EVENTS { Events::Stop } else { Events::None };
        self.step(end_time, values, events)
    }

    fn limit_work(&mut self, most: u64) {
        self.most_points = most;
    }

    fn warnings(&self, told: &[&'static str]) -> Vec<Warning> {
        self.component.warnings(told)
    }

    fn state(&self) -> Self::State {
        (self.time, self.component.save())
    }

    fn state_over(&self, state: &mut Self::State) {
        state.0 = self.time;
        self.component.save_over(&mut state.1);
    }

    fn time_of(state: &Self::State) -> f64 {
        state.0
    }

    fn restore(&mut self, state: &Self::State) -> Result<()> {
        self.keep();
        if let Err(refused) = self.component.load(&state.1) {
            self.go_back()?;
            return Err(refused);
        }
        self.time = state.0;
        Ok(())
    }
}

/// What [`export_fmu!`](crate::export_fmu) exports: any [`Model`], or a struct with `#[derive(Component)]`.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no model",
    note = "write #[derive(Component)] above the struct, or implement fmi_component::Model"
)]
pub trait Export {
    /// Its model.
    type Model: Model;

    /// Name of the library that cargo makes of its crate, where that is known.
    const LIBRARY: Option<&'static str> = None;
}

impl<M: Model> Export for M {
    type Model = Self;
}

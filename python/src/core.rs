//! The class `Core`: any scene by name, its variables by position.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

use jostle::scene::catalogue::{self, Names};
use jostle::scene::{DynSaved, DynSimulation, Listed, StructuralParameters, Value};
use jostle::{Error, Result};
use pyo3::buffer::PyBuffer;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::entry::{Access, Held, enter};
use crate::{refusal, variables};

/// A saved state of a simulation, in memory.
#[pyclass(frozen, module = "jostle._core")]
pub struct State(Mutex<DynSaved>);

/// A simulation.
#[pyclass(frozen, module = "jostle._core")]
pub struct Core {
    names: Names,
    disks: u32,
    held: Mutex<Held>,
    /// Bits of the time reached \[s\], which other threads may read while a step is done.
    time: AtomicU64,
}

impl Core {
    /// [`enter`], and what time it is then.
    fn move_on<T: Send>(
        &self,
        py: Python<'_>,
        access: Access,
        work: impl FnOnce(&mut dyn DynSimulation) -> Result<T> + Send,
    ) -> PyResult<T> {
        enter(py, &self.held, access, |simulation| {
            let value = work(simulation)?;
            self.time.store(simulation.time().to_bits(), Ordering::Relaxed);
            Ok(value)
        })
    }
}

#[pymethods]
impl Core {
    /// Prepares a scene with start values; None: its first engine, the drive sine if it has one, the usual number of disks.
    #[new]
    fn new(
        py: Python<'_>,
        scene: &str,
        engine: Option<&str>,
        drive: Option<&str>,
        disks: Option<u32>,
    ) -> PyResult<Self> {
        let prepare = || {
            let drive = drive.or_else(|| catalogue::sine_if_known(scene, engine));
            let model = catalogue::find(scene, engine, drive)?;
            let info = (model.info)();
            let disks = disks.map(|disks| ("disks", disks));
            let structure = StructuralParameters::choose(&info, disks.as_slice())?;
            let number = structure.get("disks");
            Ok((Names::from(&info), number, (model.prepare)(structure)))
        };
        let (names, disks, simulation) = prepare().map_err(|error| refusal::exception(py, &error))?;
        Ok(Self {
            names,
            disks,
            held: Held::new(simulation),
            time: AtomicU64::new(0),
        })
    }

    /// Scene, engine, drive.
    #[getter]
    fn names(&self) -> (&'static str, &'static str, &'static str) {
        (self.names.scene, self.names.engine, self.names.drive)
    }

    #[getter]
    fn disks(&self) -> u32 {
        self.disks
    }

    /// Time reached [s].
    #[getter]
    fn time(&self) -> f64 {
        f64::from_bits(self.time.load(Ordering::Relaxed))
    }

    /// Builds the model at time 0 from what was set.
    fn start(&self, py: Python<'_>) -> PyResult<()> {
        enter(py, &self.held, Access::Change, |simulation| simulation.start(0.0))
    }

    fn variables(&self, py: Python<'_>) -> PyResult<Vec<variables::Row>> {
        enter(py, &self.held, Access::Read, |simulation| {
            Ok(simulation
                .values()
                .table()
                .variables()
                .iter()
                .map(variables::row)
                .collect())
        })
    }

    /// What is doubtful about the parameters.
    fn warnings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        enter(py, &self.held, Access::Read, |simulation| {
            Ok(simulation
                .warnings(&[])
                .into_iter()
                .map(|warning| warning.text)
                .collect())
        })
    }

    /// Sets parameters (tunable ones alone after the start) and inputs: all, or none if one is refused.
    fn set(&self, py: Python<'_>, given: Vec<(usize, Bound<'_, PyAny>)>) -> PyResult<()> {
        let rows = enter(py, &self.held, Access::Read, |simulation| {
            Ok(simulation.values().table().clone())
        })?;
        let read = |(position, object): &(usize, Bound<'_, PyAny>)| {
            let row = rows.variables().get(*position).ok_or_else(|| unknown(*position))?;
            Ok((*position, variables::value(row, object)?))
        };
        let values: Result<Vec<(usize, Value)>> = given.iter().map(read).collect();
        let values = values.map_err(|error| refusal::exception(py, &error))?;
        enter(py, &self.held, Access::Change, |simulation| {
            set_all(simulation, &values)
        })
    }

    /// Value of a variable.
    fn get(&self, py: Python<'_>, position: usize) -> PyResult<Number> {
        enter(py, &self.held, Access::Read, |simulation| simulation.value(position)).map(Number::from)
    }

    /// Columns (name, unit, description) of a list and its rows as of now: the bytes of doubles, row after row.
    #[expect(clippy::type_complexity, reason = "what Python gets, which has no names for types")]
    fn list<'py>(
        &self,
        py: Python<'py>,
        name: &str,
    ) -> PyResult<(Vec<(&'static str, &'static str, &'static str)>, Bound<'py, PyBytes>)> {
        let Listed { info, numbers } = enter(py, &self.held, Access::Read, |simulation| simulation.list(name))?;
        let columns = info.columns.iter();
        let columns = columns.map(|column| (column.name, column.unit.name, column.description));
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_ne_bytes()).collect();
        Ok((columns.collect(), PyBytes::new(py, &bytes)))
    }

    /// Fills `out` with the variables at `positions`.
    fn read(&self, py: Python<'_>, positions: Vec<usize>, out: &Bound<'_, PyAny>) -> PyResult<()> {
        let buffer = doubles(out)?;
        let row = enter(py, &self.held, Access::Read, |simulation| {
            read_all(simulation, &positions)
        })?;
        buffer.copy_from_slice(py, &row)
    }

    /// Advances to `end_time` [s] as one communication step.
    fn advance_to(&self, py: Python<'_>, end_time: f64) -> PyResult<()> {
        self.move_on(py, Access::Change, |simulation| simulation.advance_to(end_time))
    }

    /// Advances to each of `times` [s] (one that is reached already is only read) and writes the variables at `positions` into
    /// the rows of `out`, of shape (times, positions), NaN where it did not come to. Returns the number of whole rows and what
    /// stopped it, None if nothing.
    fn sample(
        &self,
        py: Python<'_>,
        times: Vec<f64>,
        positions: Vec<usize>,
        out: &Bound<'_, PyAny>,
    ) -> PyResult<(usize, Option<PyErr>)> {
        let buffer = doubles(out)?;
        if buffer.item_count() != times.len() * positions.len() {
            let error = Error::call(
                "the array has another size than times and variables",
                "Make it of that shape.",
            );
            return Err(refusal::exception(py, &error));
        }
        let mut rows = Vec::with_capacity(buffer.item_count());
        let mut done = 0;
        let mut stopped = None;
        while stopped.is_none() && done < times.len() {
            let row = self.move_on(py, Access::Change, |simulation| {
                if times[done] != simulation.time() {
                    simulation.advance_to(times[done])?;
                }
                read_all(simulation, &positions)
            });
            match row {
                Ok(row) => {
                    rows.extend(row);
                    done += 1;
                    stopped = py.check_signals().err();
                }
                Err(error) => stopped = Some(error),
            }
        }
        rows.resize(buffer.item_count(), f64::NAN);
        buffer.copy_from_slice(py, &rows)?;
        Ok((done, stopped))
    }

    /// Lets one step do no more than so much work.
    fn limit_work(&self, py: Python<'_>, most: u64) -> PyResult<()> {
        enter(py, &self.held, Access::Change, |simulation| {
            simulation.limit_work(most);
            Ok(())
        })
    }

    fn save(&self, py: Python<'_>) -> PyResult<State> {
        enter(py, &self.held, Access::Read, |simulation| {
            Ok(State(Mutex::new(simulation.save())))
        })
    }

    fn restore(&self, py: Python<'_>, state: &State) -> PyResult<()> {
        self.move_on(py, Access::Restore, |simulation| {
            simulation.restore_anew(&state.0.lock().unwrap_or_else(PoisonError::into_inner))
        })
    }

    fn to_bytes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = enter(py, &self.held, Access::Read, |simulation| simulation.to_bytes())?;
        Ok(PyBytes::new(py, &bytes))
    }

    fn restore_bytes(&self, py: Python<'_>, state: &[u8]) -> PyResult<()> {
        self.move_on(py, Access::Restore, |simulation| simulation.restore_bytes_anew(state))
    }
}

/// A value as Python's float or int.
#[derive(IntoPyObject)]
enum Number {
    Real(f64),
    Integer(i64),
}

impl From<Value> for Number {
    fn from(value: Value) -> Self {
        match value {
            Value::Real(real) => Self::Real(real),
            Value::Integer(integer) => Self::Integer(integer),
        }
    }
}

/// Values of variables as doubles.
fn read_all(simulation: &dyn DynSimulation, positions: &[usize]) -> Result<Vec<f64>> {
    positions
        .iter()
        .map(|&position| simulation.value(position).map(Value::to_f64))
        .collect()
}

/// Sets all, or puts back what was set before the one that is refused.
fn set_all(simulation: &mut dyn DynSimulation, given: &[(usize, Value)]) -> Result<()> {
    let before: Vec<Option<Value>> = given
        .iter()
        .map(|(position, _)| simulation.values().get(*position))
        .collect();
    for (number, (position, value)) in given.iter().enumerate() {
        if let Err(error) = simulation.set_at(*position, *value) {
            for ((position, _), value) in given[..number].iter().zip(&before).rev() {
                if let Some(value) = value {
                    simulation.set_at(*position, *value)?;
                }
            }
            return Err(error);
        }
    }
    Ok(())
}

fn unknown(position: usize) -> Error {
    Error::call(
        format!("there is no variable number {position}"),
        "Take numbers from the table of variables.",
    )
}

fn doubles(out: &Bound<'_, PyAny>) -> PyResult<PyBuffer<f64>> {
    PyBuffer::get(out)
}

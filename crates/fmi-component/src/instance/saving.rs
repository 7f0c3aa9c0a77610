//! Saved states of an instance: taken and brought back in every phase, bit for bit.

use serde::{Deserialize, Serialize, Serializer};

use super::Instance;
use crate::dynamic::DynSaved;
use crate::error::{Error, Result};
use crate::life_cycle::{Call, Phase};
use crate::saved_bytes;

/// All that a step, a set or a change of phase can alter: the state of the simulation and what the life cycle adds to it.
#[derive(Debug)]
pub struct Snapshot {
    phase: Phase,
    stop: Option<f64>,
    simulation: DynSaved,
}

/// A [`Snapshot`] in bytes.
#[derive(Serialize, Deserialize)]
struct Written<'bytes> {
    phase: Phase,
    stop: Option<f64>,
    #[serde(borrow, serialize_with = "in_one_piece")]
    simulation: &'bytes [u8],
}

fn in_one_piece<S: Serializer>(bytes: &[u8], serializer: S) -> std::result::Result<S::Ok, S::Error> {
    serializer.serialize_bytes(bytes)
}

impl Instance {
    /// Saves everything that may change.
    ///
    /// # Errors
    /// Inside a step, or the instance has failed.
    pub fn save(&self) -> Result<Snapshot> {
        Call::SaveState.check(self.phase)?;
        Ok(Snapshot {
            phase: self.phase,
            stop: self.stop,
            simulation: self.simulation.save(),
        })
    }

    /// As [`Instance::save`], in the place of a state that was saved before and whose memory serves again.
    ///
    /// # Errors
    /// As [`Instance::save`]; the earlier state is then as it was.
    pub fn save_over(&self, snapshot: &mut Snapshot) -> Result<()> {
        Call::SaveState.check(self.phase)?;
        (snapshot.phase, snapshot.stop) = (self.phase, self.stop);
        self.simulation.save_over(&mut snapshot.simulation);
        Ok(())
    }

    /// Goes back (or on) to a saved state, in any phase but inside a step.
    ///
    /// # Errors
    /// Inside a step, or the state does not fit this instance, which is then as before.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<()> {
        self.check_change()?;
        self.go_to(snapshot)
    }

    pub(super) fn go_to(&mut self, snapshot: &Snapshot) -> Result<()> {
        self.check(snapshot)?;
        match self.phase {
            Phase::Failed => self.simulation.restore_anew(&snapshot.simulation)?,
            _ => self.simulation.restore(&snapshot.simulation)?,
        }
        self.stop = snapshot.stop;
        self.phase = snapshot.phase;
        Ok(())
    }

    /// Bytes of a snapshot for another process or a later day, of the same FMU: the token must match.
    ///
    /// # Errors
    /// The model's state cannot be written: a defect.
    pub fn snapshot_to_bytes(&self, snapshot: &Snapshot) -> Result<Vec<u8>> {
        let written = Written {
            phase: snapshot.phase,
            stop: snapshot.stop,
            simulation: &self.simulation.saved_to_payload(&snapshot.simulation)?,
        };
        saved_bytes::write(&written, &self.token)
    }

    /// Reads what [`Instance::snapshot_to_bytes`] of an instance of the same FMU wrote.
    ///
    /// # Errors
    /// The bytes are damaged, foreign, or hold values out of range.
    pub fn snapshot_from_bytes(&self, bytes: &[u8]) -> Result<Snapshot> {
        let written: Written = saved_bytes::read(bytes, &self.token)?;
        let snapshot = Snapshot {
            phase: written.phase,
            stop: written.stop,
            simulation: self.simulation.saved_from_payload(written.simulation)?,
        };
        self.check(&snapshot)?;
        Ok(snapshot)
    }

    /// Whether phase, stop time and simulation fit each other and what the importer can do.
    fn check(&self, snapshot: &Snapshot) -> Result<()> {
        let started = snapshot.simulation.is_started();
        let complete = match snapshot.phase {
            Phase::Instantiated => !started,
            Phase::Initialization => true,
            Phase::Event => self.importer.event_mode && started,
            Phase::Step | Phase::Terminated => started,
            Phase::Failed | Phase::IntermediateUpdate => false,
        };
        if complete && snapshot.stop.is_none_or(f64::is_finite) {
            return Ok(());
        }
        Err(Error::state(
            "its phase or times are impossible",
            "Pass a state that saving gave.",
        ))
    }
}

//! Saved states of an instance: taken and brought back in every phase, bit for bit.
//!
//! A snapshot holds the values too, so that one taken under other parameters comes back with a scene built anew.

use super::Instance;
use crate::error::{Error, Result};
use crate::fmi::life_cycle::{Call, Phase};
use crate::fmi::snapshot::{Clock, Snapshot};
use crate::scene::Scene;

impl<S: Scene> Instance<S> {
    /// Saves everything that may change.
    ///
    /// # Errors
    /// The instance has failed.
    pub fn save(&self) -> Result<Snapshot<S::State>> {
        Call::SaveState.check(self.phase)?;
        let scene = self.scene.as_ref().filter(|_| !self.stale);
        Ok(Snapshot {
            phase: self.phase,
            clock: self.clock,
            values: self.values.as_slice().to_vec(),
            scene: scene.map(|scene| scene.state()),
        })
    }

    /// Goes back (or on) to a saved state, in any phase.
    ///
    /// # Errors
    /// The state does not fit this instance, which is then as before.
    pub fn restore(&mut self, snapshot: &Snapshot<S::State>) -> Result<()> {
        self.check(snapshot)?;
        let mut values = self.values.clone();
        values.put_back(&snapshot.values)?;
        match &snapshot.scene {
            None => {
                self.scene = None;
                self.stale = true;
            }
            Some(state) => {
                let same =
                    !self.stale && self.clock.start == snapshot.clock.start && self.values.same_parameters(&values);
                match self.scene.as_mut().filter(|_| same) {
                    Some(scene) => scene.restore(state)?,
                    None => {
                        let mut scene = S::new(self.choice, snapshot.clock.start, &values)?;
                        scene.restore(state)?;
                        self.scene = Some(scene);
                    }
                }
                self.stale = false;
            }
        }
        self.values = values;
        self.clock = snapshot.clock;
        self.phase = snapshot.phase;
        Ok(())
    }

    /// Reads bytes that an instance of the same FMU wrote.
    ///
    /// # Errors
    /// The bytes are damaged, foreign, or hold values out of range.
    pub fn read_snapshot(&self, bytes: &[u8]) -> Result<Snapshot<S::State>> {
        let snapshot = Snapshot::from_bytes(bytes, &self.token)?;
        self.check(&snapshot)?;
        Ok(snapshot)
    }

    fn check(&self, snapshot: &Snapshot<S::State>) -> Result<()> {
        self.values.check_all(&snapshot.values)?;
        let Clock { start, now, stop } = snapshot.clock;
        let times = start.is_finite() && now.is_finite() && now >= start && stop.is_none_or(f64::is_finite);
        let complete = match snapshot.phase {
            Phase::Instantiated | Phase::Initialization => true,
            Phase::Event => self.importer.event_mode && snapshot.scene.is_some(),
            Phase::Step | Phase::Terminated => snapshot.scene.is_some(),
            Phase::Failed => false,
        };
        if times && complete {
            return Ok(());
        }
        Err(Error::state(
            "its phase or times are impossible",
            "Pass a state that saving gave.",
        ))
    }
}

//! Saved states of an instance: taken and brought back in every phase, bit for bit.
//!
//! A snapshot holds the values too, so that one taken under other parameters comes back with a scene built anew.

use super::Instance;
use crate::error::{Error, Result};
use crate::fmi::life_cycle::{Call, Phase};
use crate::fmi::snapshot::{Clock, Snapshot};
use crate::scene::Scene;
use crate::scene::times::is_simulated;

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

    /// Goes back (or on) to a saved state, in any phase but inside a step.
    ///
    /// # Errors
    /// Inside a step, or the state does not fit this instance, which is then as before.
    pub fn restore(&mut self, snapshot: &Snapshot<S::State>) -> Result<()> {
        self.check_change()?;
        self.bring_back(snapshot)
    }

    pub(super) fn bring_back(&mut self, snapshot: &Snapshot<S::State>) -> Result<()> {
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
        let times = is_simulated(start) && is_simulated(now) && now >= start && stop.is_none_or(f64::is_finite);
        let complete = match snapshot.phase {
            Phase::Instantiated | Phase::Initialization => true,
            Phase::Event => self.importer.event_mode && snapshot.scene.is_some(),
            Phase::Step | Phase::Terminated => snapshot.scene.is_some(),
            Phase::Failed | Phase::IntermediateUpdate => false,
        };
        // A scene elsewhere in time would find events before the communication point, or work off the difference.
        let together = snapshot.scene.as_ref().is_none_or(|state| S::time_of(state) == now);
        if times && complete && together {
            return Ok(());
        }
        Err(Error::state(
            "its phase or times are impossible",
            "Pass a state that saving gave.",
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fmi::instance::Importer;
    use crate::fmi::token;
    use crate::scene::Choice;
    use crate::scene::wedge::WedgeMap;

    #[test]
    fn a_scene_elsewhere_in_time_is_refused() {
        let choice = Choice { disks: 1 };
        let token = token::write(&WedgeMap::card(), choice, &WedgeMap::variables(choice));
        let mut instance = Instance::<WedgeMap>::new(&token, Importer::default()).unwrap();
        instance.set_up(0.0, None).unwrap();
        instance.enter_initialization().unwrap();
        instance.exit_initialization().unwrap();
        instance.do_step(0.0, 0.5).unwrap();
        let saved = instance.save().unwrap();
        assert_eq!(instance.restore(&saved), Ok(()));
        for now in [0.0, 0.4, 0.6] {
            let mut moved = saved.clone();
            moved.clock.now = now;
            let told = instance.restore(&moved).unwrap_err().to_string();
            assert!(told.contains("times are impossible"), "{told}");
        }
        let mut inside = saved.clone();
        inside.phase = Phase::IntermediateUpdate;
        assert!(instance.restore(&inside).is_err(), "nobody saves inside of a step");
        let bytes = inside.to_bytes(&token).unwrap();
        assert!(instance.read_snapshot(&bytes).is_err());
        assert_eq!(instance.save().unwrap(), saved);
    }
}

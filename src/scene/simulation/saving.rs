//! Saved states of a simulation: bit for bit, as values or as bytes.

use serde::{Deserialize, Serialize};

use super::{START, Simulation};
use crate::error::{Error, Result};
use crate::saved_bytes;
use crate::scene::times::is_simulated;
use crate::scene::variables::fingerprint;
use crate::scene::{Scene, Value};

/// All that a simulation is at one time: parameters and inputs, outputs, and the scene's state.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Saved<State> {
    time: f64,
    values: Vec<Value>,
    state: State,
}

/// ```
/// use jostle::scene::Simulation;
/// use jostle::scene::wedge::WedgeMap;
///
/// let mut wedge = Simulation::<WedgeMap>::new(1, &[("seed", 3.into())])?;
/// wedge.advance_to(1.0)?;
/// let (saved, bytes) = (wedge.save(), wedge.to_bytes()?);
/// wedge.advance_to(2.0)?;
/// let angle = wedge.real("disk.angle[1]")?;
///
/// wedge.restore(&saved)?;
/// wedge.advance_to(2.0)?;
/// assert_eq!(wedge.real("disk.angle[1]")?, angle);
///
/// // Bytes take the parameters along.
/// let mut other = Simulation::<WedgeMap>::new(1, &[])?;
/// other.restore_bytes(&bytes)?;
/// assert_eq!((other.time(), other.integer("seed")?), (1.0, 3));
/// other.advance_to(2.0)?;
/// assert_eq!(other.real("disk.angle[1]")?, angle);
/// # jostle::Result::Ok(())
/// ```
impl<S: Scene> Simulation<S> {
    /// Everything that a step or a set can change.
    pub fn save(&self) -> Saved<S::State> {
        Saved {
            time: self.time,
            values: self.values.as_slice().to_vec(),
            state: self.scene.state(),
        }
    }

    /// Goes back (or on) to a saved state; parameters that were others then come back too.
    ///
    /// # Errors
    /// The state does not fit this scene or disk count, or is damaged. The simulation is then as before.
    pub fn restore(&mut self, saved: &Saved<S::State>) -> Result<()> {
        self.go_to(saved, false)
    }

    fn go_to(&mut self, saved: &Saved<S::State>, anew: bool) -> Result<()> {
        let reached = S::time_of(&saved.state);
        if !(is_simulated(saved.time) && saved.time >= START && reached == saved.time) {
            return Err(Error::state(
                format!("its time is {} s and its scene's {reached} s", saved.time),
                "Pass a state that saving gave.",
            ));
        }
        let mut values = self.values.clone();
        values.put_back(&saved.values)?;
        if self.values.same_parameters(&values) && !anew {
            self.scene.restore(&saved.state)?;
        } else {
            let mut scene = S::new(self.choice, START, &values)?;
            scene.restore(&saved.state)?;
            scene.limit_work(self.most_work);
            self.scene = scene;
        }
        self.values = values;
        self.time = saved.time;
        Ok(())
    }

    /// The saved state as bytes without pointers, for a file or another process: see [`saved_bytes`].
    ///
    /// # Errors
    /// The state cannot be written: a defect.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        saved_bytes::write(&self.save(), &self.owner())
    }

    /// Goes to the state in bytes that a simulation of the same scene, disk count and version of jostle wrote.
    ///
    /// # Errors
    /// The bytes are damaged or foreign, or hold values out of range. The simulation is then as before.
    pub fn restore_bytes(&mut self, bytes: &[u8]) -> Result<()> {
        self.restore(&saved_bytes::read(bytes, &self.owner())?)
    }

    /// As [`Simulation::restore_bytes`], with the scene made anew: for one that a panic may have left in pieces.
    ///
    /// # Errors
    /// As [`Simulation::restore_bytes`].
    pub fn restore_bytes_anew(&mut self, bytes: &[u8]) -> Result<()> {
        self.go_to(&saved_bytes::read(bytes, &self.owner())?, true)
    }

    fn owner(&self) -> String {
        let (card, disks) = (S::card(), self.choice.disks);
        let rows = fingerprint(self.values.table().rows());
        format!(
            "simulation:{}:{}:{}:disks={disks}:{rows:016x}",
            card.scene, card.engine, card.drive
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::packing::PackingOnInput;
    use crate::scene::packing::event_driven::HardPackingOnSine;

    #[test]
    fn a_refused_state_changes_nothing() {
        let mut packing = Simulation::<PackingOnInput>::new(5, &[]).unwrap();
        packing.advance_to(0.5).unwrap();
        let before = packing.save();
        let mut late = before.clone();
        late.time = f64::NAN;
        assert!(packing.restore(&late).unwrap_err().to_string().contains("NaN"));
        late.time = 0.6;
        let told = packing.restore(&late).unwrap_err().to_string();
        assert!(told.contains("its time is 0.6 s and its scene's 0.5 s"), "{told}");
        let larger = Simulation::<PackingOnInput>::new(6, &[]).unwrap();
        assert!(packing.restore(&larger.save()).is_err());
        let bytes = larger.to_bytes().unwrap();
        let told = packing.restore_bytes(&bytes).unwrap_err().to_string();
        assert!(told.contains("disks=6") && told.contains("disks=5"), "{told}");
        let mut bytes = packing.to_bytes().unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        assert!(
            packing
                .restore_bytes(&bytes)
                .unwrap_err()
                .to_string()
                .contains("checksum")
        );
        assert!(packing.save() == before);
    }

    #[test]
    fn other_parameters_come_back_too() {
        let given = [("drive.amplitude", 2e-3.into()), ("seed", 5.into())];
        let mut one = Simulation::<HardPackingOnSine>::new(20, &given).unwrap();
        one.advance_to(0.1).unwrap();
        let mut other = Simulation::<HardPackingOnSine>::new(20, &[]).unwrap();
        other.restore(&one.save()).unwrap();
        for simulation in [&mut one, &mut other] {
            simulation.advance_to(0.2).unwrap();
        }
        assert!(one.save() == other.save());
    }

    #[test]
    fn the_limit_of_work_outlives_a_scene_made_anew() {
        let mut one = Simulation::<HardPackingOnSine>::new(5, &[]).unwrap();
        let bytes = one.to_bytes().unwrap();
        one.limit_work(3);
        one.restore_bytes_anew(&bytes).unwrap();
        assert!(
            one.advance_to(1.0)
                .unwrap_err()
                .to_string()
                .contains("more than one call may do")
        );
        assert!(one.to_bytes().unwrap() == bytes);
    }
}

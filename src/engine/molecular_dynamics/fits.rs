//! Which states an engine takes back: what was saved by another run, or spoilt on the way, is refused.

use crate::drive::Drive;
use crate::error::are_sane;

use super::{Integrator, MolecularDynamics, SkinMemory, State};

impl<I: Integrator, D: Drive> MolecularDynamics<I, D> {
    /// Whether `state`, seen at `time` \[s\], can be one of this run: as many disks, indices that exist, and a
    /// grid point just before the time.
    pub fn fits(&self, state: &State<D>, time: f64) -> bool {
        let own = &self.state;
        let lengths = |state: &State<D>| {
            [
                state.position.len(),
                state.velocity.len(),
                state.acceleration.len(),
                state.higher.len(),
                state.searched.len(),
            ]
        };
        let (disks, walls) = (self.radii.len() as u32, self.setup.walls.len() as u32);
        let pairs_hold = state
            .pairs
            .iter()
            .all(|pair| pair.first < pair.second && pair.second < disks);
        let walls_hold = state.at_walls.iter().all(|near| near.disk < disks && near.wall < walls);
        let skins = state.pairs.iter().map(|pair| pair.skin);
        let skins = skins.chain(state.at_walls.iter().map(|near| near.skin));
        let skins_hold = skins.into_iter().all(
            |SkinMemory {
                 direction,
                 reference,
                 stretch,
             }| { are_sane([reference, stretch]) && direction.iter().all(|part| part.abs() <= 1.0 + 1e-9) },
        );
        let reaches_hold = state
            .pairs
            .iter()
            .all(|pair| pairs_hold && pair.reach == self.radii[pair.first as usize] + self.radii[pair.second as usize]);
        let (step, ahead) = (self.setup.time_step, time - self.time_of(state.steps));
        let rounding = 4.0 * f64::EPSILON * (time.abs() + self.setup.start_time.abs());
        lengths(state) == lengths(own)
            && pairs_hold
            && walls_hold
            && skins_hold
            && reaches_hold
            // From step to step only those are counted that close and open.
            && (!self.setup.laws.skin.acts() || state.contacts == state.remembered())
            && ahead >= -step - rounding
            && ahead <= 2.0 * step + rounding
            && state.searched_step <= state.steps
            && are_sane(state.searched.iter().flatten().copied().chain([state.searched_base]))
            && (0.0..=self.smallest_radius).contains(&state.searched_margin)
    }
}

//! Who may touch whom: the Verlet list, renewed at the start of the first step that could outrun it.

use crate::drive::Drive;
use crate::engine::molecular_dynamics::Breakdown;
use crate::engine::molecular_dynamics::neighbours::{CellGrid, Cloud};
use crate::geometry::Wall;

use super::LocatedDynamics;
use super::state::{Contact, Phase, State};

/// Gap, in smallest radii, up to which disks are candidates.
pub const MARGIN: f64 = 0.15;

/// Part of the margin that two bodies may use up together before a new search: the rest is for what forces add to a step
/// beyond its velocity.
const USED: f64 = 0.9;

/// Scratch memory of a search.
#[derive(Debug, Clone, Default)]
pub struct Search {
    grid: CellGrid,
    pairs: Vec<[u32; 2]>,
    kept: Vec<Contact>,
}

impl Search {
    /// Lists all candidates with a gap below `margin` \[m\]; contacts that are not open keep their memory.
    pub fn renew<D>(&mut self, state: &mut State<D>, radii: &[f64], walls: &[Wall], margin: f64) {
        state.margin = margin;
        state.searched.clone_from(&state.places);
        state.searched_base = state.base.displacement;
        let cloud = Cloud {
            places: &state.searched,
            radii,
            margin,
        };
        self.grid.find(cloud, &mut self.pairs);
        keep(&mut state.pairs, &mut self.kept, self.pairs.iter().copied());
        let base = state.searched_base;
        let near = |disk: usize, wall: &Wall| {
            let [x, y, _] = cloud.places[disk];
            wall.distance([x, y], base) < radii[disk] + margin
        };
        let at_walls = (0..radii.len()).flat_map(|disk| {
            let walls = walls.iter().enumerate().filter(move |(_, wall)| near(disk, wall));
            walls.map(move |(wall, _)| [disk as u32, wall as u32])
        });
        keep(&mut state.at_walls, &mut self.kept, at_walls);
    }
}

/// Replaces `contacts` by those of `keys`, which are sorted as they are.
fn keep(contacts: &mut Vec<Contact>, kept: &mut Vec<Contact>, keys: impl Iterator<Item = [u32; 2]>) {
    kept.clear();
    let mut old = contacts
        .iter()
        .filter(|contact| contact.phase != Phase::Open)
        .peekable();
    for key in keys {
        while old.next_if(|contact| [contact.first, contact.second] < key).is_some() {}
        let same = old.next_if(|contact| [contact.first, contact.second] == key);
        kept.push(same.copied().unwrap_or(Contact::open(key[0], key[1])));
    }
    std::mem::swap(contacts, kept);
}

impl<D: Drive> LocatedDynamics<D> {
    /// Searches anew before a step that could bring bodies together that are not on the list.
    pub(super) fn search_if_due(&mut self, step: f64, time: f64, base_after: f64) -> Result<(), Breakdown> {
        let state = &self.state;
        let mut farthest = 0.0;
        for ((now, then), rate) in state.places.iter().zip(&state.searched).zip(&state.rates) {
            let (dx, dy) = (now[0] + step * rate[0] - then[0], now[1] + step * rate[1] - then[1]);
            let squared = dx * dx + dy * dy;
            farthest = if squared > farthest { squared } else { farthest };
        }
        let limit = 0.5 * USED * state.margin;
        if farthest < limit * limit && (base_after - state.searched_base).abs() < limit {
            return Ok(());
        }
        let speeds = state.rates.iter().map(|rate| rate[0].hypot(rate[1]));
        let base_moves = (base_after - state.base.displacement).abs();
        let distance = (step * speeds.fold(0.0, f64::max)).max(base_moves);
        let allowed = 0.5 * self.smallest_radius;
        if distance > allowed {
            return Err(Breakdown::TooFast {
                time,
                distance,
                allowed,
            });
        }
        // A list must last for one step at least.
        let margin = (MARGIN * self.smallest_radius).max(4.0 * distance / USED);
        self.search
            .renew(&mut self.state, &self.radii, &self.setup.walls, margin);
        Ok(())
    }
}

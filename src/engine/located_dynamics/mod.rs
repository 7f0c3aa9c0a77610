//! prototype
#![allow(missing_docs)]
mod frame;
mod passage;
mod pieces;
mod polynomial;
mod state;
mod step;

use crate::drive::Drive;
use crate::engine::molecular_dynamics::{Breakdown, Setup};
use crate::engine::molecular_dynamics::neighbours::{CellGrid, Cloud};
use crate::engine::molecular_dynamics::{Pair, AtWall};
use crate::geometry::Disk;

pub use state::{Contact, Kinematics, Phase, State};
use passage::Laws;
use step::{Disks, Scenery, Work};

const SNAP: f64 = 1e-6;
const MARGIN: f64 = 0.15;

#[derive(Debug, Clone)]
pub struct LocatedDynamics<D> {
    setup: Setup,
    laws: Laws,
    radii: Vec<f64>,
    inverse_masses: Vec<[f64; 3]>,
    smallest_radius: f64,
    state: State<D>,
    between: Option<State<D>>,
    work: Work,
    grid: CellGrid,
    found: Vec<Pair>,
    found_at_walls: Vec<AtWall>,
    pub passes: u32,
    pub events: u64,
}

impl<D: Drive> LocatedDynamics<D> {
    pub fn new(setup: Setup, disks: &[Disk], drive: D) -> Self {
        let radii: Vec<f64> = disks.iter().map(|disk| disk.radius).collect();
        let smallest_radius = radii.iter().copied().fold(f64::INFINITY, f64::min);
        let inverse_masses = disks.iter().zip(&setup.masses).map(|(disk, mass)| {
            [1.0 / mass, 1.0 / mass, 2.0 / (mass * disk.radius * disk.radius)]
        }).collect();
        let state = State {
            steps: 0,
            base: drive.motion(setup.start_time),
            drive,
            places: disks.iter().map(|disk| [disk.x, disk.y, 0.0]).collect(),
            rates: vec![[0.0; 3]; disks.len()],
            wall_impulses: vec![[0.0; 2]; setup.walls.len()],
            pairs: Vec::new(),
            at_walls: Vec::new(),
            searched: Vec::new(),
            searched_base: 0.0,
            margin: 0.0,
            energy_input: 0.0,
            energy_lost: 0.0,
            contacts: 0,
        };
        let laws = Laws::new(setup.laws.normal, setup.laws.skin);
        let mut engine = Self {
            setup, laws, radii, inverse_masses, smallest_radius, state, between: None, work: Work::default(),
            grid: CellGrid::default(), found: Vec::new(), found_at_walls: Vec::new(), passes: 2, events: 0,
        };
        engine.set_motion(|_| ());
        engine
    }

    pub fn set_motion(&mut self, change: impl FnOnce(&mut State<D>)) {
        change(&mut self.state);
        self.state.pairs.clear();
        self.state.at_walls.clear();
        self.search(MARGIN * self.smallest_radius);
        let scenery = Scenery {
            laws: &self.laws,
            radii: &self.radii,
            inverse_masses: &self.inverse_masses,
            walls: &self.setup.walls,
            gravity: self.setup.gravity,
        };
        let state = &mut self.state;
        let disks = Disks { places: &state.places, rates: &state.rates };
        step::close_overlapping(&scenery, disks, &mut state.pairs, &mut state.at_walls, &state.base);
        self.between = None;
    }

    pub fn now(&self) -> &State<D> {
        self.between.as_ref().unwrap_or(&self.state)
    }

    pub fn time(&self) -> f64 {
        self.time_of(self.state.steps)
    }

    fn time_of(&self, steps: u64) -> f64 {
        self.setup.start_time + steps as f64 * self.setup.time_step
    }

    pub fn advance_to(&mut self, end_time: f64) -> Result<(), Breakdown> {
        let target = ((end_time - self.setup.start_time) / self.setup.time_step + SNAP).floor().max(0.0) as u64;
        while self.state.steps < target {
            self.step(self.setup.time_step, self.time_of(self.state.steps + 1))?;
            self.state.steps += 1;
        }
        let ahead = end_time - self.time();
        if ahead.abs() <= SNAP * self.setup.time_step {
            self.between = None;
            return Ok(());
        }
        let mut copy = self.state.clone();
        std::mem::swap(&mut self.state, &mut copy);
        let outcome = self.step(ahead, end_time);
        std::mem::swap(&mut self.state, &mut copy);
        self.between = Some(copy);
        outcome
    }

    fn step(&mut self, step: f64, time: f64) -> Result<(), Breakdown> {
        let base = [self.state.base, self.state.drive.motion(time)];
        self.search_if_due(step, time, (base[1].displacement - self.state.searched_base).abs())?;
        let scenery = Scenery {
            laws: &self.laws,
            radii: &self.radii,
            inverse_masses: &self.inverse_masses,
            walls: &self.setup.walls,
            gravity: self.setup.gravity,
        };
        let state = &mut self.state;
        let disks = Disks { places: &state.places, rates: &state.rates };
        self.work.predict(&scenery, disks, &state.pairs, &state.at_walls, step);
        for pass in 0..self.passes {
            self.work.refine(&scenery, disks, (&state.pairs, &state.at_walls), base, (step, pass == 0));
        }
        self.events += u64::from(self.work.tally.events);
        let tally = self.work.tally;
        let allowed = 0.5 * self.smallest_radius;
        if tally.deepest > allowed {
            return Err(Breakdown::TooDeep { time, overlap: tally.deepest, allowed });
        }
        self.work.commit(&self.radii, &mut state.pairs, &mut state.at_walls);
        std::mem::swap(&mut state.places, &mut self.work.places);
        std::mem::swap(&mut state.rates, &mut self.work.rates);
        for (sum, new) in state.wall_impulses.iter_mut().zip(&self.work.wall_impulses) {
            sum[0] += new[0];
            sum[1] += new[1];
        }
        state.base = base[1];
        state.energy_input += tally.work;
        state.energy_lost += tally.lost;
        state.contacts = tally.contacts;
        Ok(())
    }

    fn search_if_due(&mut self, step: f64, time: f64, base_moved: f64) -> Result<(), Breakdown> {
        let state = &self.state;
        let (mut farthest, mut fastest) = (0.0_f64, 0.0_f64);
        for ((now, then), rate) in state.places.iter().zip(&state.searched).zip(&state.rates) {
            let (dx, dy) = (now[0] + step * rate[0] - then[0], now[1] + step * rate[1] - then[1]);
            farthest = farthest.max(dx * dx + dy * dy);
            fastest = fastest.max(rate[0] * rate[0] + rate[1] * rate[1]);
        }
        let limit = 0.45 * state.margin;
        if farthest < limit * limit && base_moved < limit {
            return Ok(());
        }
        let distance = step * fastest.sqrt();
        let allowed = 0.5 * self.smallest_radius;
        if distance > allowed {
            return Err(Breakdown::TooFast { time, distance, allowed });
        }
        self.search((MARGIN * self.smallest_radius).max(4.0 * distance));
        Ok(())
    }

    fn search(&mut self, margin: f64) {
        let state = &mut self.state;
        state.margin = margin;
        state.searched.clone_from(&state.places);
        state.searched_base = state.base.displacement;
        let cloud = Cloud { places: &state.searched, radii: &self.radii, margin };
        self.grid.find_pairs(cloud, &mut self.found);
        self.grid.find_at_walls(cloud, &self.setup.walls, state.searched_base, &mut self.found_at_walls);
        keep(&mut state.pairs, self.found.iter().map(|pair| (pair.first, pair.second)));
        keep(&mut state.at_walls, self.found_at_walls.iter().map(|near| (near.disk, near.wall)));
    }
}

fn keep(contacts: &mut Vec<Contact>, keys: impl Iterator<Item = (u32, u32)>) {
    let old = std::mem::take(contacts);
    let mut old = old.iter().filter(|contact| contact.phase != Phase::Open).peekable();
    for key in keys {
        while old.next_if(|contact| (contact.first, contact.second) < key).is_some() {}
        let kept = old.next_if(|contact| (contact.first, contact.second) == key);
        contacts.push(kept.copied().unwrap_or(Contact::open(key.0, key.1)));
    }
}

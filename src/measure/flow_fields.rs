//! Mass and momentum of disks by place and phase of the base: flights in, time averages in boxes out (F Figs 13, 14).
//!
//! Accumulated exactly, not sampled: each flight is cut where its parabola leaves a box and where the phase of the base
//! enters another window, and every piece adds its duration and its displacement to one sum. So in each window the masses of all
//! boxes add up to the mass of the disks, and the momenta of all windows to the transport, to rounding.

use std::f64::consts::TAU;

use nalgebra::{Vector2, Vector3};

use crate::drive::{BoundedDrive, Sine};
use crate::engine::event_driven::{Body, Observer};
use crate::error::{Error, Result, Shortest};

/// Most boxes times windows: 24 bytes each.
const MOST_SUMS: f64 = 1e7;

/// Boxes and phase windows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Side of a square box \[m\]; a corner of one is the origin.
    pub side: f64,
    /// Boxes side by side; places are folded into that many.
    pub columns: u32,
    /// Windows of a period of the base.
    pub phases: u32,
    /// Height \[m\] below which all centres of disks stay.
    pub ceiling: f64,
}

/// Average over a phase window of what is in a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// Window j: the phase of the base is from `2 pi j / phases` to `2 pi (j + 1) / phases`.
    pub phase: u32,
    /// Centre of the box, folded \[m\].
    pub x: f64,
    /// Centre of the box \[m\].
    pub y: f64,
    /// Mass of the disks with their centre in the box \[kg\].
    pub mass: f64,
    /// Their momentum \[kg.m/s\].
    pub momentum: Vector2<f64>,
}

/// Average over all phases of what is in a row of boxes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Middle of the row \[m\].
    pub y: f64,
    /// Mass of the disks with their centre in the row \[kg\].
    pub mass: f64,
    /// Their mean horizontal velocity, by mass \[m/s\]; 0 where no mass is.
    pub velocity: f64,
}

/// Sums over flights from a time on.
#[derive(Debug, Clone)]
pub struct FlowFields {
    grid: Grid,
    /// Of the lowest row.
    lowest: i64,
    rows: usize,
    /// Masses of the disks \[kg\].
    masses: Vec<f64>,
    gravity: f64,
    sine: Sine,
    /// Origin of local time \[s\], and the sine counted from there.
    epoch: f64,
    local: Sine,
    /// Start of the averages \[s\].
    start: f64,
    /// Mass times duration and momentum times duration, by row, column and window.
    sums: Vec<Vector3<f64>>,
}

impl FlowFields {
    /// Averages from `start` \[s\] on over disks of these masses \[kg\] that fall with `gravity` \[m/s2\] above a base that
    /// moves as a sine; the engine's local time begins at `epoch` \[s\].
    ///
    /// # Errors
    /// A sine without periods, more boxes than memory should hold.
    pub fn new(grid: Grid, masses: Vec<f64>, gravity: f64, sine: Sine, start: f64, epoch: f64) -> Result<Self> {
        if sine.frequency <= 0.0 {
            return Err(Error::parameter(
                "drive.frequency",
                format!("{} Hz", Shortest(sine.frequency)),
                "above 0 Hz: fields are averaged over windows of the period",
                "Shake the base.",
            ));
        }
        // No centre is ever below the lowest place of the base.
        let lowest = (-sine.amplitude.abs() / grid.side).floor();
        let rows = (grid.ceiling / grid.side).ceil() - lowest;
        let sums = rows * f64::from(grid.columns) * f64::from(grid.phases);
        if !(1.0..=MOST_SUMS).contains(&sums) {
            return Err(Error::parameter(
                "boxes times phase windows",
                Shortest(sums),
                format!("from 1 to {MOST_SUMS:e} up to the ceiling"),
                "Take fewer boxes for a tooth, fewer windows, or lower cell.height.",
            ));
        }
        Ok(Self {
            grid,
            lowest: lowest as i64,
            rows: rows as usize,
            masses,
            gravity,
            sine,
            epoch,
            local: sine.counted_from(epoch),
            start,
            sums: vec![Vector3::zeros(); sums as usize],
        })
    }

    /// Time \[s\] of each window from the start to `end` \[s\].
    pub fn durations(&self, end: f64) -> Vec<f64> {
        let phases = f64::from(self.grid.phases);
        let count = |time: f64| phases * (self.sine.frequency * time + self.sine.phase / TAU);
        let (from, to) = (count(self.start), count(end));
        let window = 1.0 / (phases * self.sine.frequency);
        let periods = ((to - from) / phases).floor();
        let mut durations = vec![periods * window; self.grid.phases as usize];
        let mut at = from + periods * phases;
        while at < to {
            let next = (at.floor() + 1.0).min(to);
            durations[at.floor().rem_euclid(phases) as usize] += (next - at) * window;
            at = next;
        }
        durations
    }

    /// Averages up to `end` \[s\] of all boxes, up to the highest that a disk has been in.
    pub fn cells(&self, end: f64) -> impl Iterator<Item = Cell> {
        let Grid {
            side, columns, phases, ..
        } = self.grid;
        let durations = self.durations(end);
        let all = (0..phases).flat_map(move |phase| {
            let row = move |row: usize| (0..columns as usize).map(move |column| (phase, row, column));
            (0..self.occupied()).flat_map(row)
        });
        all.map(move |(phase, row, column)| {
            let duration = durations[phase as usize];
            let sum = self.sums[self.index(row, column, phase as usize)];
            let average = if duration > 0.0 {
                sum / duration
            } else {
                Vector3::zeros()
            };
            Cell {
                phase,
                x: (column as f64 + 0.5) * side,
                y: self.height(row),
                mass: average.x,
                momentum: average.yz(),
            }
        })
    }

    /// Averages up to `end` \[s\] of all rows, up to the highest that a disk has been in.
    pub fn layers(&self, end: f64) -> impl Iterator<Item = Layer> {
        let time = end - self.start;
        (0..self.occupied()).map(move |row| {
            let [first, next] = [row, row + 1].map(|row| self.index(row, 0, 0));
            let sum: Vector3<f64> = self.sums[first..next].iter().sum();
            let (mass, momentum) = (sum.x, sum.y);
            Layer {
                y: self.height(row),
                mass: mass / time,
                velocity: if mass > 0.0 { momentum / mass } else { 0.0 },
            }
        })
    }

    /// Rows up to the highest with any mass.
    fn occupied(&self) -> usize {
        let row = self.index(1, 0, 0);
        let highest = self.sums.iter().rposition(|sum| sum.x > 0.0);
        highest.map_or(0, |last| last / row + 1)
    }

    fn height(&self, row: usize) -> f64 {
        ((row as i64 + self.lowest) as f64 + 0.5) * self.grid.side
    }

    #[inline]
    fn index(&self, row: usize, column: usize, phase: usize) -> usize {
        (row * self.grid.columns as usize + column) * self.grid.phases as usize + phase
    }

    #[inline]
    fn add(&mut self, [column, row, window]: [i64; 3], amount: Vector3<f64>) {
        let row = (row - self.lowest).clamp(0, self.rows as i64 - 1) as usize;
        let column = column.rem_euclid(i64::from(self.grid.columns)) as usize;
        let phase = window.rem_euclid(i64::from(self.grid.phases)) as usize;
        let index = self.index(row, column, phase);
        self.sums[index] += amount;
    }

    /// Time \[s\] from its start at which the flight next leaves a row, and by how many rows upwards: 1 only while it is
    /// `rising`, else -1.
    #[inline]
    fn leaves_row(&self, body: &Body, row: i64, rising: bool) -> (f64, i64) {
        let (gravity, side) = (self.gravity, self.grid.side);
        let (y, vy) = (body.position.y, body.velocity.y);
        if rising {
            let rise = (row + 1) as f64 * side - y;
            let squared = vy * vy - 2.0 * gravity * rise;
            if squared >= 0.0 {
                return (2.0 * rise / (vy + squared.sqrt()), 1);
            }
        }
        let drop = y - row as f64 * side;
        let root = (vy * vy + 2.0 * gravity * drop).max(0.0).sqrt();
        let time = if vy < 0.0 {
            2.0 * drop / (root - vy)
        } else {
            (vy + root) / gravity
        };
        (time, -1)
    }
}

impl Observer for FlowFields {
    fn flight(&mut self, disk: u32, from: &Body, until: f64) {
        let end = until - from.time;
        let mut now = (self.start - self.epoch - from.time).max(0.0);
        if now >= end {
            return;
        }
        let (mass, side, gravity) = (self.masses[disk as usize], self.grid.side, self.gravity);
        let phases = f64::from(self.grid.phases);
        let (frequency, lead) = (self.local.frequency, self.local.phase / TAU);
        let [vx, vy] = from.velocity.into();
        let height = from.position.y + now * (vy - 0.5 * gravity * now);
        let mut column = ((from.position.x + now * vx) / side).floor() as i64;
        let mut row = (height / side).floor() as i64;
        let mut window = (phases * (frequency * (from.time + now) + lead)).floor() as i64;
        let step = vx.signum() as i64;
        // A flight that has left a row downwards never leaves one upwards: at the top of an edge rounding could go to and
        // fro.
        let mut rising = now * gravity < vy;
        while now < end {
            // Indices go step by step, never back to positions: a piece that rounding makes empty adds nothing.
            let edge = (column + i64::from(step > 0)) as f64 * side;
            let across = if vx == 0.0 {
                f64::INFINITY
            } else {
                (edge - from.position.x) / vx
            };
            let (vertical, up) = self.leaves_row(from, row, rising);
            let phase = ((window + 1) as f64 / phases - lead) / frequency - from.time;
            let next = end.min(across).min(vertical).min(phase).max(now);
            let lasts = next - now;
            let fall = 0.5 * gravity * (now + next);
            self.add([column, row, window], mass * lasts * Vector3::new(1.0, vx, vy - fall));
            if next >= end {
                return;
            }
            now = next;
            if across <= next {
                column += step;
            } else if vertical <= next {
                row += up;
                rising &= up > 0;
            } else {
                window += 1;
            }
        }
    }

    fn shift_origin(&mut self, seconds: f64) {
        self.epoch += seconds;
        self.local = self.sine.counted_from(self.epoch);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::event_driven::Partner;
    use rand::{RngExt, SeedableRng};

    const SINE: Sine = Sine {
        amplitude: 2e-3,
        frequency: 25.0,
        phase: 0.4,
    };
    const GRID: Grid = Grid {
        side: 1e-3,
        columns: 6,
        phases: 6,
        ceiling: 0.1,
    };

    fn body(x: f64, y: f64, vx: f64, vy: f64, time: f64) -> Body {
        Body {
            position: Vector2::new(x, y),
            velocity: Vector2::new(vx, vy),
            time,
            radius: 1e-3,
            next_time: 0.0,
            impacts: 0,
            next_partner: Partner::Shell.into(),
        }
    }

    /// Flights of all kinds against 40,000 places along each: a crossing is off by at most one interval.
    #[test]
    fn a_parabola_adds_what_dense_samples_of_it_add() {
        let mut random = rand_pcg::Pcg64::seed_from_u64(5);
        let epoch = 64.0;
        for _ in 0..100 {
            let mut fields = FlowFields::new(GRID, vec![2.0], 9.81, SINE, epoch + 1.0, epoch).unwrap();
            let mut draw = |low: f64, high: f64| random.random_range(low..high);
            let from = body(
                draw(-0.01, 0.07),
                draw(0.05, 0.06),
                draw(-0.5, 0.5),
                draw(-0.5, 0.5),
                draw(0.98, 1.02),
            );
            let until = from.time + draw(0.03, 0.05);
            fields.flight(0, &from, until);
            let samples = 40_000_u32;
            let begin = from.time.max(1.0);
            let interval = (until - begin) / f64::from(samples);
            let mut expected = vec![Vector3::zeros(); fields.sums.len()];
            for sample in 0..samples {
                let ahead = begin + (f64::from(sample) + 0.5) * interval - from.time;
                let (position, velocity) = from.motion_after(ahead, 9.81);
                let phase = SINE.frequency * (epoch + from.time + ahead) + SINE.phase / TAU;
                let column = (position.x / 1e-3).floor().rem_euclid(6.0) as usize;
                let row = ((position.y / 1e-3).floor() as i64 - fields.lowest) as usize;
                let window = (6.0 * phase).floor().rem_euclid(6.0) as usize;
                let index = fields.index(row, column, window);
                expected[index] += interval * 2.0 * Vector3::new(1.0, velocity.x, velocity.y);
            }
            // A box is entered and left at most a few times in a flight.
            for (sum, expected) in fields.sums.iter().zip(&expected) {
                for index in 0..3 {
                    let size = 2.0;
                    let off = (sum[index] - expected[index]).abs();
                    assert!(off < 4.0 * size * interval, "{sum:?} {expected:?}");
                }
            }
            let total: f64 = fields.sums.iter().map(|sum| sum[0]).sum();
            assert!((total - 2.0 * (until - begin)).abs() < 1e-14);
        }
    }

    /// Edges met exactly: at rest at the top of an edge, straight up and down, along an edge, before the start.
    #[test]
    fn flights_along_edges_end_and_lose_nothing() {
        let rise = (2.0 * 9.81 * 2e-3_f64).sqrt();
        for from in [
            body(3e-3, 20e-3, 0.0, 0.0, 0.0),
            body(0.0, 20e-3, 1e-300, rise, 0.0),
            body(6e-3, 20e-3, -0.1, rise, 0.0),
            body(3e-3, 20e-3, 0.3, -rise, 0.0),
            body(-0.0, 20e-3, 0.1, 5e-324, 0.0),
        ] {
            let mut fields = FlowFields::new(GRID, vec![1.0], 9.81, SINE, 0.0, 0.0).unwrap();
            fields.flight(0, &from, 0.04);
            fields.flight(0, &from, -1.0);
            let sums: Vector3<f64> = fields.sums.iter().sum();
            assert!((sums[0] - 0.04).abs() < 1e-15, "{from:?}: {sums:?}");
            assert!((sums[1] - 0.04 * from.velocity.x).abs() < 1e-15);
            assert!((sums[2] - 0.04 * (from.velocity.y - 0.02 * 9.81)).abs() < 1e-15);
        }
    }

    #[test]
    fn durations_of_windows_add_up_and_are_even_over_periods() {
        let fields = FlowFields::new(GRID, vec![1.0], 9.81, SINE, 0.3, 0.0).unwrap();
        let durations = fields.durations(0.3 + 40.0 * 7.0);
        assert!(durations.iter().all(|duration| (duration - 280.0 / 6.0).abs() < 1e-11));
        let durations = fields.durations(0.3 + 0.047);
        assert!((durations.iter().sum::<f64>() - 0.047).abs() < 1e-14);
    }

    #[test]
    fn what_has_no_periods_or_too_many_boxes_is_refused_by_name() {
        let message = |grid: Grid, sine: Sine| {
            FlowFields::new(grid, vec![], 9.81, sine, 0.0, 0.0)
                .unwrap_err()
                .to_string()
        };
        let still = Sine { frequency: 0.0, ..SINE };
        assert!(message(GRID, still).starts_with("drive.frequency = 0 Hz"));
        let fine = Grid { side: 1e-7, ..GRID };
        assert!(message(fine, SINE).starts_with("boxes times phase windows"));
    }
}

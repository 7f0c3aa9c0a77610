//! Calendar of events: one time per disk, the earliest first, ties by index.
//!
//! Events are never removed before their time: an entry whose time is no longer its disk's next time is stale and is
//! skipped when it comes up. Buckets of equal width hold the near events; the current bucket is kept sorted, events
//! beyond the last bucket wait in a list. All that waits is in one piece of memory with room for all: no bucket allocates
//! when it gets more entries than ever. The order of events depends on times and indices alone, never on the widths, so
//! that a calendar rebuilt from the next times continues to the bit.
//! Source: Paul 2007, doi:10.1016/j.jcp.2006.06.042, with lazily removed entries.

use std::cmp::Ordering;

use super::waiting::{Entry, List, Waiting};

impl Entry {
    /// Latest first, so that the earliest is at the end of a sorted list.
    #[inline]
    fn descending(&self, other: &Self) -> Ordering {
        other.time.total_cmp(&self.time).then(other.disk.cmp(&self.disk))
    }
}

/// Most buckets: the table of buckets should stay in the cache.
const MOST_BUCKETS: usize = 1 << 15;
/// Buckets per disk, as far as there may be.
const BUCKETS_PER_DISK: usize = 4;
/// Mean delays of an event that the buckets cover together.
const DELAYS_COVERED: f64 = 4.0;
/// Entries per disk after which stale ones are removed, and as many for any number of disks. Where events come much more often
/// than the buckets were set up for, stale entries would else pile up until their time comes.
const ENTRIES_PER_DISK: usize = 64;
const ENTRIES_AT_LEAST: usize = 4096;
/// Most entries for which there is room from the start: all that there can be with 2,000 disks.
const MOST_ROOM: usize = 1 << 17;

/// Calendar with lazily removed entries.
#[derive(Debug, Clone, Default)]
pub struct Calendar {
    /// Entries of the current bucket and of all before it, latest first.
    current: Vec<Entry>,
    buckets: Vec<List>,
    far: List,
    /// How many are in `far`.
    far_count: usize,
    waiting: Waiting,
    /// Buckets per second.
    rate: f64,
    /// Number of the current bucket since time zero.
    base: i64,
    /// Entries that may be made until stale ones are removed.
    until_removal: usize,
}

impl Calendar {
    /// Empties the calendar and sets it up for as many `disks`, whose events come after a mean delay \[s\], from `time`
    /// \[s\] on.
    pub fn reset(&mut self, disks: usize, mean_delay: f64, time: f64) {
        let count = (BUCKETS_PER_DISK * disks).next_power_of_two().clamp(64, MOST_BUCKETS);
        self.buckets.clear();
        self.buckets.resize(count, List::EMPTY);
        self.current.clear();
        (self.far, self.far_count) = (List::EMPTY, 0);
        let most = disks + Self::entries_between_removals(disks);
        self.waiting.clear(most.min(MOST_ROOM));
        self.current.reserve(2 * disks + 64);
        let rate = count as f64 / (DELAYS_COVERED * mean_delay);
        self.rate = if rate.is_finite() && rate > 0.0 { rate } else { 1.0 };
        self.base = self.bucket_of(time);
        self.until_removal = Self::entries_between_removals(disks);
    }

    fn entries_between_removals(disks: usize) -> usize {
        ENTRIES_AT_LEAST.max(ENTRIES_PER_DISK * disks)
    }

    /// Notes the next event of a disk. Its earlier entry becomes stale.
    #[inline]
    pub fn schedule(&mut self, disk: u32, time: f64) {
        self.until_removal = self.until_removal.saturating_sub(1);
        self.put(Entry { time, disk });
    }

    /// The earliest valid event, left in place. An entry is valid if its time is the `next_time` of its disk.
    #[inline(always)] // called from one place, once an event
    pub fn peek(&mut self, next_time: impl Fn(u32) -> f64) -> Option<(f64, u32)> {
        if self.until_removal == 0 {
            self.remove_stale(&next_time);
        }
        loop {
            while let Some(entry) = self.current.last() {
                if next_time(entry.disk) == entry.time {
                    return Some((entry.time, entry.disk));
                }
                self.current.pop();
            }
            if !self.turn(&next_time) {
                return None;
            }
        }
    }

    /// Removes the event that [`Self::peek`] returned.
    #[inline]
    pub fn pop(&mut self) {
        self.current.pop();
    }

    #[inline]
    fn bucket_of(&self, time: f64) -> i64 {
        // Saturates for events that never come.
        (time * self.rate) as i64
    }

    #[inline]
    fn put(&mut self, entry: Entry) {
        let bucket = self.bucket_of(entry.time);
        if bucket <= self.base {
            let place = self
                .current
                .partition_point(|other| other.descending(&entry) == Ordering::Less);
            self.current.insert(place, entry);
        } else if bucket < self.base + self.buckets.len() as i64 {
            let mask = self.buckets.len() - 1;
            self.waiting.push(&mut self.buckets[bucket as usize & mask], entry);
        } else {
            self.waiting.push(&mut self.far, entry);
            self.far_count += 1;
        }
    }

    /// Goes on to the next bucket that holds a valid event. False if there is nothing left but events that never come.
    fn turn(&mut self, next_time: &impl Fn(u32) -> f64) -> bool {
        let count = self.buckets.len();
        let mut empty = 0;
        while empty < count {
            self.base += 1;
            empty += 1;
            let bucket = self.base as usize & (count - 1);
            if bucket == 0 && self.far_count > 0 {
                let before = self.far_count;
                self.put_far_anew(next_time);
                if self.far_count < before {
                    empty = 0; // some may have come into buckets that were passed already
                }
            }
            while let Some(entry) = self.waiting.pop(&mut self.buckets[bucket]) {
                if next_time(entry.disk) == entry.time {
                    self.current.push(entry);
                }
            }
            if !self.current.is_empty() {
                self.current.sort_unstable_by(Entry::descending);
                return true;
            }
        }
        self.leap(next_time)
    }

    /// Removes what is no longer valid, wherever it waits. The order of events stays.
    #[cold]
    fn remove_stale(&mut self, next_time: &impl Fn(u32) -> f64) {
        let valid = |entry: &Entry| next_time(entry.disk) == entry.time;
        self.current.retain(valid);
        self.far_count = self.waiting.retain(&mut self.far, valid);
        let mut left = self.current.len() + self.far_count;
        for list in &mut self.buckets {
            left += self.waiting.retain(list, valid);
        }
        self.until_removal = Self::entries_between_removals(left);
    }

    /// Nothing in a whole year of buckets: goes straight to the earliest of the far events.
    #[cold]
    fn leap(&mut self, next_time: &impl Fn(u32) -> f64) -> bool {
        self.far_count = self
            .waiting
            .retain(&mut self.far, |entry| next_time(entry.disk) == entry.time);
        let earliest = self.waiting.earliest(&self.far);
        if earliest == f64::INFINITY {
            return false;
        }
        self.base = self.bucket_of(earliest);
        self.put_far_anew(next_time);
        true
    }

    /// Sorts what is far, less what is stale, into buckets as far as these reach now.
    fn put_far_anew(&mut self, next_time: &impl Fn(u32) -> f64) {
        let mut far = std::mem::replace(&mut self.far, List::EMPTY);
        self.far_count = 0;
        while let Some(entry) = self.waiting.pop(&mut far) {
            if next_time(entry.disk) == entry.time {
                self.put(entry);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    /// Against a plain search for the smallest, with times near, far, equal and infinite, and widths good and bad.
    #[test]
    fn the_calendar_gives_the_event_that_a_plain_search_gives() {
        let mut random = Pcg64::seed_from_u64(11);
        for mean_delay in [1e-6, 0.02, 1.0, 1e3] {
            let disks = 100_usize;
            let mut next: Vec<f64> = (0..disks).map(|disk| disk as f64 * 0.01).collect();
            let mut calendar = Calendar::default();
            calendar.reset(disks, mean_delay, 0.0);
            next.iter()
                .enumerate()
                .for_each(|(disk, time)| calendar.schedule(disk as u32, *time));
            for _ in 0..5000 {
                let expected = (0..disks)
                    .min_by(|a, b| next[*a].total_cmp(&next[*b]).then(a.cmp(b)))
                    .unwrap();
                let (time, disk) = calendar.peek(|disk| next[disk as usize]).unwrap();
                assert_eq!((time, disk as usize), (next[expected], expected));
                calendar.pop();
                for changed in [expected, (random.next_u32() as usize) % disks] {
                    let delay = match random.next_u32() % 10 {
                        0 => 0.0,
                        1 => 40.0,
                        2 if changed != expected => f64::INFINITY,
                        _ => f64::from(random.next_u32() % 1000) * 1e-3,
                    };
                    next[changed] = time + delay;
                    calendar.schedule(changed as u32, time + delay);
                }
            }
        }
    }

    /// Two disks meet a million times before the third has its event, which the buckets were set up for.
    #[test]
    fn events_that_come_too_often_leave_no_stale_entries_behind() {
        let mut calendar = Calendar::default();
        let mut next = [1e-6, 1e-6, 1e3];
        calendar.reset(next.len(), 1e3, 0.0);
        for (disk, time) in next.iter().enumerate() {
            calendar.schedule(disk as u32, *time);
        }
        for _ in 0..1_000_000 {
            let (time, disk) = calendar.peek(|disk| next[disk as usize]).unwrap();
            calendar.pop();
            let other = 1 - disk as usize;
            (next[disk as usize], next[other]) = (time + 1e-6, time + 2e3);
            calendar.schedule(disk, next[disk as usize]);
            calendar.schedule(other as u32, next[other]);
        }
        assert!(calendar.waiting.most() + calendar.current.len() <= 2 * ENTRIES_AT_LEAST);
    }

    #[test]
    fn a_calendar_without_events_to_come_is_empty() {
        let mut calendar = Calendar::default();
        calendar.reset(2, 1.0, 0.0);
        calendar.schedule(0, f64::INFINITY);
        calendar.schedule(1, f64::INFINITY);
        assert_eq!(calendar.peek(|_| f64::INFINITY), None);
    }
}

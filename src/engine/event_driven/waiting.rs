//! Lists of numbered times in one piece of memory: an entry of any list takes the place that an entry of any other left.

/// Next event of one disk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Entry {
    /// When \[s\].
    pub time: f64,
    /// Whose.
    pub disk: u32,
}

/// No place.
const NONE: u32 = u32::MAX;

/// Place of the first entry of a list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct List(u32);

impl List {
    /// Without entries.
    pub const EMPTY: Self = Self(NONE);
}

impl Default for List {
    fn default() -> Self {
        Self::EMPTY
    }
}

/// An entry and the place of the next one in its list.
#[derive(Debug, Clone, Copy)]
struct Place {
    time: f64,
    disk: u32,
    next: u32,
}

/// Entries of all lists.
#[derive(Debug, Clone, Default)]
pub struct Waiting {
    places: Vec<Place>,
    /// Places that were left.
    free: List,
}

impl Waiting {
    /// Forgets all lists and makes room for so many entries together.
    pub fn clear(&mut self, room: usize) {
        self.places.clear();
        self.places.reserve(room);
        self.free = List::EMPTY;
    }

    /// Most entries that there were together since all lists were forgotten.
    #[cfg(test)]
    pub fn most(&self) -> usize {
        self.places.len()
    }

    /// Puts an entry at the front of a list.
    #[inline]
    pub fn push(&mut self, list: &mut List, Entry { time, disk }: Entry) {
        let next = list.0;
        let place = Place { time, disk, next };
        if let Some(free) = self.places.get_mut(self.free.0 as usize) {
            *list = self.free;
            self.free.0 = free.next;
            *free = place;
        } else {
            *list = List(self.places.len() as u32);
            self.places.push(place);
        }
    }

    /// Takes the entry at the front of a list.
    #[inline]
    pub fn pop(&mut self, list: &mut List) -> Option<Entry> {
        let place = self.places.get_mut(list.0 as usize)?;
        let (entry, next) = (
            Entry {
                time: place.time,
                disk: place.disk,
            },
            place.next,
        );
        place.next = self.free.0;
        (self.free, list.0) = (*list, next);
        Some(entry)
    }

    /// Removes what is not `valid` from a list; says how many entries are left.
    pub fn retain(&mut self, list: &mut List, valid: impl Fn(&Entry) -> bool) -> usize {
        let mut old = std::mem::replace(list, List::EMPTY);
        let mut left = 0;
        while let Some(entry) = self.pop(&mut old) {
            if valid(&entry) {
                self.push(list, entry);
                left += 1;
            }
        }
        left
    }

    /// The earliest time in a list \[s\]; infinite if it is empty.
    pub fn earliest(&self, list: &List) -> f64 {
        let mut earliest = f64::INFINITY;
        let mut at = list.0;
        while let Some(place) = self.places.get(at as usize) {
            earliest = earliest.min(place.time);
            at = place.next;
        }
        earliest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_share_places_and_lose_nothing() {
        let mut waiting = Waiting::default();
        let (mut even, mut odd) = (List::EMPTY, List::EMPTY);
        waiting.clear(10);
        let room = waiting.places.capacity();
        for disk in 0..10 {
            let list = if disk % 2 == 0 { &mut even } else { &mut odd };
            let time = f64::from(disk);
            waiting.push(list, Entry { time, disk });
        }
        assert_eq!(waiting.retain(&mut even, |entry| entry.disk > 3), 3);
        assert_eq!((waiting.earliest(&even), waiting.earliest(&odd)), (4.0, 1.0));
        waiting.push(&mut odd, Entry { time: 0.5, disk: 0 });
        waiting.push(&mut odd, Entry { time: 0.7, disk: 2 });
        assert_eq!((waiting.places.len(), waiting.places.capacity()), (10, room));
        let mut all = |mut list: List| {
            let mut found: Vec<u32> = std::iter::from_fn(|| waiting.pop(&mut list))
                .map(|entry| entry.disk)
                .collect();
            found.sort_unstable();
            found
        };
        assert_eq!((all(even), all(odd)), (vec![4, 6, 8], vec![0, 1, 2, 3, 5, 7, 9]));
    }
}

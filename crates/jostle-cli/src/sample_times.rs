//! When a run is sampled: from the start, or from where a saved run has come to.

use jostle::Error;

use crate::text;

/// Most rows of one file; more is a slip of the keyboard.
const MOST_ROWS: f64 = 1e8;

/// Times from `start` to `end`, `sample` apart; the last one is at the end in any case.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleTimes {
    start: f64,
    /// `start` in samples, if it is a whole number of them: then all times are whole numbers of samples from zero, to the bit,
    /// as in a run that was never stopped.
    samples_before: Option<u64>,
    sample: f64,
    end: f64,
    last: u64,
}

impl SampleTimes {
    /// All in seconds.
    ///
    /// # Errors
    /// The end is not after the start, or there are too many.
    pub fn new(start: f64, sample: f64, end: f64) -> Result<Self, Error> {
        if end <= start {
            let allowed = format!("above {} s, where the saved run has come to", text::number(start));
            let remedy = "Give the time of the end, counted from the beginning of the saved run.";
            return Err(Error::parameter("--seconds", text::number(end), allowed, remedy));
        }
        let nearest = (start / sample).round();
        let samples_before = (nearest * sample == start && nearest < 1e15).then_some(nearest as u64);
        // A remainder below a billionth of a sample is rounding, not a row.
        let rows = match samples_before {
            Some(before) => (end / sample - 1e-9).ceil() - before as f64,
            None => ((end - start) / sample - 1e-9).ceil(),
        };
        if rows > MOST_ROWS {
            let allowed = format!("at most {MOST_ROWS:e} rows, here {rows:e}");
            let remedy = "Sample less often or run shorter.";
            return Err(Error::parameter("--sample", format!("{sample:e} s"), allowed, remedy));
        }
        Ok(Self {
            start,
            samples_before,
            sample,
            end,
            last: rows.max(1.0) as u64,
        })
    }

    /// The end and the distance, as a table of parameters has them.
    pub fn of_parameters(&self) -> [(&'static str, f64); 2] {
        [("seconds", self.end), ("sample", self.sample)]
    }

    /// Number of the last time; that of the start is 0.
    pub fn last(&self) -> u64 {
        self.last
    }

    /// Time `number` \[s\]: from the start, never a running sum.
    pub fn at(&self, number: u64) -> f64 {
        let time = match self.samples_before {
            Some(before) => (before + number) as f64 * self.sample,
            None => self.start + number as f64 * self.sample,
        };
        time.min(self.end)
    }

    /// Number of a time in the whole run, as far as it is sampled alike.
    pub fn number(&self, number: u64) -> u64 {
        self.samples_before.unwrap_or_default() + number
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_samples_are_counted_despite_rounding() {
        let last = |seconds, sample| SampleTimes::new(0.0, sample, seconds).unwrap().last();
        assert_eq!(
            (last(0.3, 0.1), last(10.0, 0.01), last(1.0, 3.0), last(0.7, 0.1)),
            (3, 1000, 1, 7)
        );
        let many = SampleTimes::new(0.0, 1e-9, 1e9).unwrap_err().to_string();
        assert!(many.starts_with("--sample = "), "{many}");
    }

    #[test]
    fn a_continued_run_has_the_times_of_one_that_was_not_stopped() {
        let whole = SampleTimes::new(0.0, 0.1, 10.05).unwrap();
        for stop in 1..100 {
            let rest = SampleTimes::new(whole.at(stop), 0.1, 10.05).unwrap();
            assert_eq!(rest.last(), whole.last() - stop);
            for number in 0..=rest.last() {
                assert_eq!(rest.at(number), whole.at(stop + number));
                assert_eq!(rest.number(number), stop + number);
            }
        }
    }

    #[test]
    fn a_start_between_samples_is_where_they_are_counted_from() {
        let times = SampleTimes::new(1.05, 0.4, 2.0).unwrap();
        let all: Vec<f64> = (0..=times.last()).map(|number| times.at(number)).collect();
        assert_eq!(all, [1.05, 1.05 + 0.4, 1.05 + 0.8, 2.0]);
        let message = SampleTimes::new(2.0, 0.1, 2.0).unwrap_err().to_string();
        assert!(
            message.starts_with("--seconds = 2 is not allowed: above 2 s"),
            "{message}"
        );
    }
}

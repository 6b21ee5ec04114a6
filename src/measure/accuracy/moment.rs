//! Worst, mean and RMS of many errors, from sums. Spec clause `M-3`.

use serde::{Deserialize, Serialize};

/// Sums over errors, in one unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// How many.
    pub count: u64,
    /// Largest magnitude.
    pub worst: f64,
    /// Sum of the errors, signs kept.
    pub sum: f64,
    /// Sum of their squares.
    pub squares: f64,
}

/// Worst, mean and RMS error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spread {
    /// Largest magnitude.
    pub worst: f64,
    /// Mean, signs kept.
    pub mean: f64,
    /// Root of the mean square.
    pub rms: f64,
}

impl Moments {
    /// Adds one error.
    #[inline]
    pub fn note(&mut self, error: f64) {
        self.count += 1;
        self.worst = self.worst.max(error.abs());
        self.sum += error;
        self.squares += error * error;
    }

    /// Adds `count` errors in equal steps from `first` to `last`, in closed form.
    #[inline]
    pub fn run(&mut self, first: f64, last: f64, count: u32) {
        match count {
            0 => return,
            1 => return self.note(first),
            2 => {
                self.note(first);
                return self.note(last);
            }
            _ => {}
        }
        let n = f64::from(count);
        let (middle, half) = (f64::midpoint(first, last), 0.5 * (last - first));
        // Around their middle the squares of n equal steps of 2 half / (n - 1) sum to
        // n half^2 (n + 1) / (3 (n - 1)).
        let around = n * half * half * (n + 1.0) / (3.0 * (n - 1.0));
        self.count += u64::from(count);
        self.worst = self.worst.max(first.abs()).max(last.abs());
        self.sum += n * middle;
        self.squares += n * middle * middle + around;
    }

    /// The same errors in another unit.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            count: self.count,
            worst: self.worst * factor,
            sum: self.sum * factor,
            squares: self.squares * factor * factor,
        }
    }

    /// Adds what another sum has.
    pub fn merge(&mut self, other: &Self) {
        self.count += other.count;
        self.worst = self.worst.max(other.worst);
        self.sum += other.sum;
        self.squares += other.squares;
    }

    /// Worst, mean and RMS; all zero for no errors.
    #[allow(clippy::cast_precision_loss, reason = "a count divides in a report")]
    pub fn spread(&self) -> Spread {
        let count = self.count.max(1) as f64;
        Spread {
            worst: self.worst,
            mean: self.sum / count,
            rms: (self.squares / count).max(0.0).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_its_errors_one_by_one() {
        for (first, last, count) in
            [(0.25, -1.5, 1), (0.5, 0.5, 7), (-1.0, 2.0, 2), (-0.75, 0.5, 41)]
        {
            let (mut run, mut single) = (Moments::default(), Moments::default());
            // A run of one error has no last one of its own.
            let last = if count == 1 { first } else { last };
            run.run(first, last, count);
            for n in 0..count {
                single.note(first + (last - first) * f64::from(n) / f64::from((count - 1).max(1)));
            }
            assert_eq!((run.count, run.worst), (single.count, single.worst));
            assert!((run.sum - single.sum).abs() < 1e-12, "{run:?} {single:?}");
            assert!((run.squares - single.squares).abs() < 1e-12, "{run:?} {single:?}");
        }
        let mut none = Moments::default();
        none.run(1.0, 2.0, 0);
        assert_eq!(none.spread(), Spread::default());
    }
}

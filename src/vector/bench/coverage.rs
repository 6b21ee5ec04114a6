//! What a set hit: octant by guard zone by rounding remainder, holes listed. Spec clause `N-5`.

use serde::{Deserialize, Serialize};

/// The eight directions of a pair of slopes.
const OCTANTS: [&str; 8] = ["E-SE", "SE-S", "S-SW", "SW-W", "W-NW", "NW-N", "N-NE", "NE-E"];
/// Where a value stood when read.
const ZONES: [&str; 3] = ["inside", "above", "below"];
/// What was below the last kept bit.
const REMAINDERS: [&str; 4] = ["zero", "below-half", "tie", "above-half"];

/// Counts of rows by octant of the slopes, zone of the read-out and remainder of the rounding.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Coverage {
    cells: [[[u64; 4]; 3]; 8],
}

/// Which zones and remainders a bench can meet at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Inside, above, below.
    pub zones: [bool; 3],
    /// Zero, below half, tie, above half.
    pub remainders: [bool; 4],
}

impl Shape {
    /// Everything.
    pub const ALL: Self = Self { zones: [true; 3], remainders: [true; 4] };

    /// Nothing: the bench does not count.
    pub const NONE: Self = Self { zones: [false; 3], remainders: [false; 4] };

    /// The remainders that `bits` dropped bits can have.
    pub fn of_bits(zones: [bool; 3], bits: u32) -> Self {
        Self { zones, remainders: [true, bits > 1, bits > 0, bits > 1] }
    }
}

/// One counted cell, for the manifest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// `octant.zone.remainder`.
    pub cell: String,
    /// Rows that fell into it.
    pub rows: u64,
}

impl Coverage {
    /// The octant of a direction, x to the right and y down; no direction counts as the first.
    #[inline]
    pub fn octant(dx: i128, dy: i128) -> usize {
        let steep = dx.unsigned_abs() < dy.unsigned_abs();
        match (dx >= 0, dy >= 0) {
            (true, true) => usize::from(steep),
            (false, true) => 2 + usize::from(!steep),
            (false, false) => 4 + usize::from(steep),
            (true, false) => 6 + usize::from(!steep),
        }
    }

    /// The class of a remainder of `bits` bits: zero, below a half, a half, above.
    #[inline]
    pub fn remainder(value: u128, bits: u32) -> usize {
        if bits == 0 {
            return 0;
        }
        let half = 1 << (bits - 1);
        let rest = value & (2 * half - 1);
        usize::from(rest != 0) + usize::from(rest >= half) + usize::from(rest > half)
    }

    /// Counts one row: zone 0 inside, 1 above, 2 below.
    #[inline]
    pub fn note(&mut self, octant: usize, zone: usize, remainder: usize) {
        self.cells[octant & 7][zone.min(2)][remainder & 3] += 1;
    }

    /// Adds another count.
    pub fn add(&mut self, other: &Self) {
        for (mine, theirs) in
            self.cells.iter_mut().flatten().flatten().zip(other.cells.iter().flatten().flatten())
        {
            *mine += theirs;
        }
    }

    /// The cells with rows, and the names of those without that the shape has.
    pub fn report(&self, shape: Shape) -> (Vec<Cell>, Vec<String>) {
        let (mut hits, mut holes) = (Vec::new(), Vec::new());
        for (octant, zones) in OCTANTS.iter().zip(&self.cells) {
            for (z, (zone, remainders)) in ZONES.iter().zip(zones).enumerate() {
                for (r, (remainder, &rows)) in REMAINDERS.iter().zip(remainders).enumerate() {
                    let cell = format!("{octant}.{zone}.{remainder}");
                    if rows > 0 {
                        hits.push(Cell { cell, rows });
                    } else if shape.zones[z] && shape.remainders[r] {
                        holes.push(cell);
                    }
                }
            }
        }
        (hits, holes)
    }
}

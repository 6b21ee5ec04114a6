//! What a set hit: octant by guard zone by rounding remainder, and the goals of each bench; what
//! cannot be hit, and why; what is left open. Spec clause `N-5`.

use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The eight directions of a pair of slopes.
const OCTANTS: [&str; 8] = ["E-SE", "SE-S", "S-SW", "SW-W", "W-NW", "NW-N", "N-NE", "NE-E"];
/// Where a value stood when read.
const ZONES: [&str; 3] = ["inside", "above", "below"];
/// What was below the last kept bit.
const REMAINDERS: [&str; 4] = ["zero", "below-half", "tie", "above-half"];

/// Guard bits that are told apart by pattern.
const GUARD: u32 = 6;

/// Counts of rows by octant of the slopes, zone of the read-out and remainder of the rounding; by
/// octant and guard pattern; and by goal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Coverage {
    cells: [[[u64; 4]; 3]; 8],
    guards: [[u64; 1 << GUARD]; 8],
    goals: BTreeMap<String, u64>,
}

impl Default for Coverage {
    fn default() -> Self {
        Self { cells: [[[0; 4]; 3]; 8], guards: [[0; 1 << GUARD]; 8], goals: BTreeMap::new() }
    }
}

/// Something that a bench should meet, beside the cells of its shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Goal {
    /// Its name in the manifest.
    pub cell: String,
    /// Why nothing can meet it, if nothing can.
    pub unreachable: Option<Reason>,
}

/// Why a cell cannot be hit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reason {
    /// The clause of the specification that bounds what can happen.
    pub clause: &'static str,
    /// The bound, with the numbers of the profile.
    pub bound: String,
}

impl Goal {
    /// One that can be met.
    pub fn new(cell: impl Into<String>) -> Self {
        Self { cell: cell.into(), unreachable: None }
    }

    /// One that cannot, and why.
    pub fn never(cell: impl Into<String>, clause: &'static str, bound: impl Into<String>) -> Self {
        let reason = Reason { clause, bound: bound.into() };
        Self { cell: cell.into(), unreachable: Some(reason) }
    }
}

/// A cell that nothing can hit, for the manifest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unreachable {
    /// Its name.
    pub cell: String,
    /// The clause of the specification behind the bound.
    pub clause: String,
    /// The bound, with the numbers of the profile.
    pub bound: String,
}

/// The cells of a bench: each is in one of the three lists.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cells {
    /// With rows.
    pub hit: Vec<Cell>,
    /// That nothing can hit.
    pub unreachable: Vec<Unreachable>,
    /// That something could hit, and nothing did.
    pub open: Vec<String>,
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
    /// The eight directions of a pair of slopes, by number.
    pub const OCTANTS: [&'static str; 8] = OCTANTS;

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

    /// Counts one row by what its guard bits hold; all patterns from the 64th on count as the last.
    #[inline]
    pub fn note_guard(&mut self, octant: usize, pattern: usize) {
        self.guards[octant & 7][pattern.min((1 << GUARD) - 1)] += 1;
    }

    /// Counts one meeting of a goal.
    pub fn meet(&mut self, goal: &str) {
        match self.goals.get_mut(goal) {
            Some(count) => *count += 1,
            None => drop(self.goals.insert(goal.to_owned(), 1)),
        }
    }

    /// A goal for each guard pattern in each octant.
    pub fn guard_goals(guard: u32) -> Vec<Goal> {
        let patterns = if guard == 0 { 0 } else { 1u32 << guard.min(GUARD) };
        let name = |octant: &str, pattern: u32| {
            Goal::new(format!(
                "{octant}.guard-{pattern:0width$b}",
                width = guard.min(GUARD) as usize
            ))
        };
        let of = |octant: &'static str| (0..patterns).map(move |pattern| name(octant, pattern));
        OCTANTS.into_iter().flat_map(of).collect()
    }

    /// The cells of a zone with these remainders, in every octant.
    pub(super) fn zone_cells(zone: &str, remainders: &[&str]) -> impl Iterator<Item = String> {
        OCTANTS.iter().flat_map(move |octant| {
            remainders.iter().map(move |remainder| format!("{octant}.{zone}.{remainder}"))
        })
    }

    /// The cells of a tie.
    pub(super) fn tie_cells() -> Vec<String> {
        ZONES.iter().flat_map(|zone| Self::zone_cells(zone, &["tie"])).collect()
    }

    /// Adds another count.
    pub fn add(&mut self, other: &Self) {
        for (goal, count) in &other.goals {
            *self.goals.entry(goal.clone()).or_default() += count;
        }
        let guards = self.guards.iter_mut().flatten().zip(other.guards.iter().flatten());
        guards.for_each(|(mine, theirs)| *mine += theirs);
        for (mine, theirs) in
            self.cells.iter_mut().flatten().flatten().zip(other.cells.iter().flatten().flatten())
        {
            *mine += theirs;
        }
    }

    /// The cells of the shape and the goals, each where it belongs.
    pub fn report(&self, shape: Shape, goals: &[Goal]) -> Cells {
        let mut report = Cells::default();
        for (octant, zones) in OCTANTS.iter().zip(&self.cells) {
            for (z, (zone, remainders)) in ZONES.iter().zip(zones).enumerate() {
                for (r, (remainder, &rows)) in REMAINDERS.iter().zip(remainders).enumerate() {
                    let cell = format!("{octant}.{zone}.{remainder}");
                    if rows > 0 {
                        report.hit.push(Cell { cell, rows });
                    } else if shape.zones[z] && shape.remainders[r] {
                        let named = goals.iter().find(|goal| goal.cell == cell);
                        report.miss(cell, named.and_then(|goal| goal.unreachable.as_ref()));
                    }
                }
            }
        }
        let is_of_the_shape = |goal: &&Goal| {
            goal.cell.split('.').count() != 3
                || !OCTANTS.iter().any(|octant| goal.cell.starts_with(octant))
        };
        for Goal { cell, unreachable } in goals.iter().filter(is_of_the_shape) {
            match self.rows(cell) {
                0 => report.miss(cell.clone(), unreachable.as_ref()),
                rows => report.hit.push(Cell { cell: cell.clone(), rows }),
            }
        }
        report
    }

    /// Rows of a cell or a goal.
    pub(super) fn rows(&self, goal: &str) -> u64 {
        let mut parts = goal.split('.');
        let index =
            |names: &[&str], part: Option<&str>| names.iter().position(|name| Some(*name) == part);
        if let (Some(octant), Some(zone), Some(rest)) = (
            index(&OCTANTS, parts.next()),
            index(&ZONES, parts.next()),
            index(&REMAINDERS, parts.next()),
        ) {
            return self.cells[octant][zone][rest];
        }
        let guard = goal.split_once(".guard-").and_then(|(octant, pattern)| {
            let octant = OCTANTS.iter().position(|name| *name == octant)?;
            self.guards[octant].get(usize::from_str_radix(pattern, 2).ok()?)
        });
        guard.copied().unwrap_or_else(|| self.goals.get(goal).copied().unwrap_or_default())
    }
}

impl Cells {
    fn miss(&mut self, cell: String, reason: Option<&Reason>) {
        match reason {
            Some(Reason { clause, bound }) => self.unreachable.push(Unreachable {
                cell,
                clause: (*clause).to_owned(),
                bound: bound.clone(),
            }),
            None => self.open.push(cell),
        }
    }
}

//! Cost against triangle size: where each machine wins.

use super::{quickest, real};
use crate::case::Words;
use crate::machine::triangle_machines;
use crate::machine::{Sink, Work};
use crate::measure::cost::{Count, Operations, estimate};
use crate::model::Model;
use crate::profile::{InvalidProfile, Profile};
use crate::setup::{Snapped, Triangle, VertexField};
use serde::Serialize;

/// Covered pixels of the triangles drawn.
pub const SIZES: [u64; 6] = [1, 10, 100, 1000, 10_000, 100_000];
/// Triangles of one size.
const TRIANGLES: u64 = 60;

/// One machine on triangles of one size.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SizeRow {
    /// Pixels asked for.
    pub pixels: u64,
    /// Machine.
    pub machine: &'static str,
    /// Pixels covered by a triangle, on average.
    pub covered: f64,
    /// Operations a triangle, set-up and all: additions, multiplications, divisions and comparisons
    /// alike.
    pub operations: f64,
    /// Divisions among them.
    pub divisions: f64,
    /// Nanoseconds a triangle; absent if it was not asked for.
    pub ns: Option<f64>,
}

/// Counts what a machine draws and does.
#[derive(Default)]
struct Tally {
    fragments: u64,
    runs: u64,
    work: Work,
}

impl Sink for Tally {
    fn span(&mut self, _: u32, x0: u32, x1: u32, _: &[u64]) {
        self.fragments += u64::from(x1 - x0);
        self.runs += 1;
    }

    fn work(&mut self, work: &Work) {
        self.work.add(work);
    }
}

/// Triangles of about so many pixels, of every direction and of aspects up to 3, inside the window
/// where they fit.
fn triangles(pixels: u64, profile: &Profile) -> Result<Vec<Snapped<Triangle>>, InvalidProfile> {
    let field = VertexField::new(&profile.vertex, profile.depth_max())?;
    let one = 1i128 << profile.vertex.sub_pixel;
    let side = i128::from(pixels.isqrt().max(1)) * one;
    let window = [profile.window.width, profile.window.height].map(|side| i128::from(side) * one);
    let (low, high) = profile.vertex.range();
    let top = i64::try_from(profile.depth_max()).unwrap_or(i64::MAX);
    let narrow = |value: i128| i64::try_from(value).unwrap_or(i64::MAX);
    (0..TRIANGLES)
        .map(|index| {
            let mut words = Words::new(pixels, 12, index);
            // Legs along and across a direction, twice the area being twice the pixels.
            let aspect = words.between(100, 300);
            let (long, short) = (side * aspect / 173, side * 2 * 173 / aspect);
            let turn = [words.between(-100, 100), words.between(-100, 100)];
            let length = (turn[0] * turn[0] + turn[1] * turn[1]).unsigned_abs().isqrt().max(1);
            let length = i128::try_from(length).unwrap_or(1);
            let along = |by: i128, [x, y]: [i128; 2]| [x * by / length, y * by / length];
            let (u, v) = (along(long, turn), along(short, [-turn[1], turn[0]]));
            let slack = words.between(-narrow(short), narrow(short)) / 4;
            let w = along(slack, turn);
            // The middle of the window, moved a little off the grid of pixels.
            let at = window.map(|side| side / 2 + words.between(-narrow(2 * one), narrow(2 * one)));
            let corner = |d: [i128; 2]| {
                let third = [(u[0] + v[0]) / 3, (u[1] + v[1]) / 3];
                [0, 1].map(|axis| (at[axis] + d[axis] - third[axis]).clamp(low, high))
            };
            let xy = [corner([0; 2]), corner(u), corner([v[0] + w[0], v[1] + w[1]])];
            let z = profile.depth.map(|_| [(); 3].map(|()| words.between(0, top)));
            field.check(Triangle { xy, z }).map_err(InvalidProfile::from)
        })
        .collect()
}

/// Every machine on triangles of every size, in a profile's window.
///
/// # Errors
/// [`InvalidProfile`] names the violated inequality.
pub fn sizes(
    profile: &Profile,
    names: &[&str],
    timed: bool,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<SizeRow>, InvalidProfile> {
    let area = u64::from(profile.window.width) * u64::from(profile.window.height);
    let mut rows = Vec::new();
    for pixels in SIZES.into_iter().filter(|pixels| *pixels <= area / 4) {
        let list = triangles(pixels, profile)?;
        for machine in triangle_machines().map(|kind| kind.name).filter(|name| names.contains(name))
        {
            if !go_on() {
                return Ok(rows);
            }
            let profile = profile.with_machine(machine).unwrap_or_else(|| profile.clone());
            let (model, cost) = (Model::new(&profile)?, estimate(&profile)?);
            let mut tally = Tally::default();
            for triangle in &list {
                model.draw_own(triangle, &mut tally);
            }
            let (count, covered) = (real(TRIANGLES), real(tally.fragments));
            let all = |kind: fn(&Count) -> u64| total(&cost.operations, &tally, kind) / count;
            rows.push(SizeRow {
                pixels,
                machine,
                covered: covered / count,
                operations: all(|c| c.add + c.multiply + c.divide + c.compare),
                divisions: all(|c| c.divide),
                ns: timed.then(|| quickest(&model, &list) / count),
            });
        }
    }
    Ok(rows)
}

fn total(operations: &Operations, tally: &Tally, kind: fn(&Count) -> u64) -> f64 {
    let Operations { triangle, row, tile, run, visit, fragment } = operations;
    let parts = [
        (triangle, TRIANGLES),
        (row, tally.work.rows),
        (tile, tally.work.tiles),
        (run, tally.runs),
        (visit, tally.work.visits),
        (fragment, tally.fragments),
    ];
    parts.iter().map(|(count, times)| real(kind(count)) * real(*times)).sum()
}

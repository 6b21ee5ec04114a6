//! Polygons by edge table, active edge list and parity, exactly. Spec clauses `Y-1` and `Y-2`.

use super::rect::Rect;
use super::rule::FillRule;
use super::sample::SampleGrid;
use super::scan::{Grid, Side};

/// An edge in the table: its rows, and its cut of the next one.
struct Edge {
    first: u32,
    end: u32,
    side: Side<i128>,
}

/// Calls `row(y, x0, x1)` for the runs inside a polygon by parity, inside `clip`, top to bottom and left
/// to right; neighbouring runs may touch. Any shape: concave, crossing itself, with holes spliced in,
/// repeated and collinear points.
///
/// A row crosses an edge when its sample is at or below the upper end and above the lower end, so a
/// vertex counts once on either side of a local extreme and a horizontal edge never. Cuts are exact
/// (`A-9`).
pub fn polygon(
    vertices: &[[i128; 2]],
    grid: &SampleGrid,
    clip: Rect,
    rule: FillRule,
    row: &mut dyn FnMut(u32, u32, u32),
) {
    let scan = Grid { offset: grid.offset, sub_pixel: grid.sub_pixel as usize };
    let mut table: Vec<Edge> = (0..vertices.len())
        .filter_map(|k| {
            let (a, b) = (vertices[k], vertices[(k + 1) % vertices.len()]);
            let (top, bottom) = if a[1] <= b[1] { (a, b) } else { (b, a) };
            let (first, end) = clip.clip(1, grid.pixels(1, (top[1], bottom[1] - 1)));
            let at = grid.position(0, i128::from(first))[1];
            (first < end).then(|| Edge {
                first,
                end,
                side: Side::new(top, bottom, at, &scan, rule),
            })
        })
        .collect();
    // By descending first row, so that the next edge to become active is the last.
    table.sort_by_key(|edge| std::cmp::Reverse(edge.first));
    let mut active: Vec<Edge> = Vec::new();
    let mut cuts = Vec::new();
    let mut y = table.last().map_or(clip.y1, |edge| edge.first);
    while y < clip.y1 && !(table.is_empty() && active.is_empty()) {
        while table.last().is_some_and(|edge| edge.first == y) {
            active.extend(table.pop());
        }
        active.retain(|edge| edge.end > y);
        cuts.clear();
        cuts.extend(active.iter().map(|edge| edge.side.cut));
        cuts.sort_unstable();
        for pair in cuts.chunks_exact(2) {
            let (x0, x1) = clip.clip(0, (pair[0], pair[1]));
            if x0 < x1 {
                row(y, x0, x1);
            }
        }
        for edge in &mut active {
            edge.side.down();
        }
        y += 1;
    }
}

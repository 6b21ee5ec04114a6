//! Where the samples of pixels lie in a triangle on the grid: exact edge functions. Spec clause `EN-4`.

use super::rule::Edges;
use crate::setup::{EdgeCoefficients, Triangle, edges};

/// Vertices in sub-pixels.
pub(super) type Placed = [[i128; 2]; 3];

/// Where a sample lies that is not outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum At {
    Inside,
    /// On these edges.
    OnEdge(Edges),
}

/// Classifies by the three edge functions; `None` outside.
fn classify(values: [i128; 3], edges: &[EdgeCoefficients; 3]) -> Option<At> {
    // One sign bit is enough to be outside.
    if values[0] | values[1] | values[2] < 0 {
        return None;
    }
    let mut on = edges.iter().zip(values).filter(|(_, value)| *value == 0);
    let Some((first, _)) = on.next() else { return Some(At::Inside) };
    let second = on.next().map_or(first, |(edge, _)| edge);
    Some(At::OnEdge([first.direction(), second.direction()]))
}

/// The triangle with positive area, and its edges; `None` without area.
fn prepare(xy: Placed) -> Option<[EdgeCoefficients; 3]> {
    let triangle = Triangle { xy, z: None };
    (triangle.area2() != 0).then(|| edges(&triangle.normalised()))
}

/// Where the sample of a pixel lies; `None` outside.
pub(super) fn at(xy: Placed, bits: u32, [x, y]: [u32; 2]) -> Option<At> {
    let edges = prepare(xy)?;
    let [x, y] = [x, y].map(|pixel| (i128::from(pixel) << bits) + (1 << (bits - 1)));
    classify(edges.map(|edge| edge.at(x, y)), &edges)
}

/// Calls for each pixel of the window whose sample is not outside the triangle, by rows.
pub(super) fn visit(xy: Placed, bits: u32, window: (u32, u32), mut seen: impl FnMut(u32, u32, At)) {
    let Some(edges) = prepare(xy) else { return };
    let half = 1i128 << (bits - 1);
    let range = |axis: usize, size: u32| {
        let [a, b, c] = xy.map(|vertex| vertex[axis]);
        let low = (a.min(b).min(c) - half + (1 << bits) - 1) >> bits;
        let high = ((a.max(b).max(c) - half) >> bits) + 1;
        let end = |pixel: i128| u32::try_from(pixel.clamp(0, size.into())).unwrap_or(size);
        end(low)..end(high)
    };
    let (columns, rows) = (range(0, window.0), range(1, window.1));
    let step = edges.map(|edge| edge.a << bits);
    let x0 = (i128::from(columns.start) << bits) + half;
    for y in rows {
        let mut values = edges.map(|edge| edge.at(x0, (i128::from(y) << bits) + half));
        for x in columns.clone() {
            if let Some(at) = classify(values, &edges) {
                seen(x, y, at);
            }
            for (value, step) in values.iter_mut().zip(step) {
                *value += step;
            }
        }
    }
}

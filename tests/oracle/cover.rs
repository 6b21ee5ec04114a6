//! Coverage by another road than edge words and biases: a sample on an edge is moved by an
//! infinitesimal, and then it is strictly inside or it is not.

use guardbit::cover::FillRule;

/// Far more than any cross product of the tests' coordinates, so that the nudge stays infinitesimal.
const SCALE: i128 = 1 << 60;

/// A sample, moved as the rule wants it: right, then by much less down; or left, then down.
/// A left edge owns a sample on it exactly if a step to the right leads inside.
fn nudged(p: [i128; 2], rule: FillRule) -> [i128; 2] {
    let x = match rule {
        FillRule::TopLeft => 1 << 30,
        FillRule::Shadow => -(1 << 30),
    };
    [p[0] * SCALE + x, p[1] * SCALE + 1]
}

/// Whether a triangle of either winding covers the sample. Coordinates stay below 2^28.
pub(crate) fn covers(v: [[i128; 2]; 3], sample: [i128; 2], rule: FillRule) -> bool {
    let q = nudged(sample, rule);
    let side = |a: [i128; 2], b: [i128; 2]| {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        (dx * (q[1] - a[1] * SCALE) - dy * (q[0] - a[0] * SCALE)).signum()
    };
    let sides = [side(v[0], v[1]), side(v[1], v[2]), side(v[2], v[0])];
    sides == [1; 3] || sides == [-1; 3]
}

/// Whether a simple polygon holds the sample, by counting the edges right of it.
#[allow(dead_code, reason = "not every test that shares this file has polygons")]
pub(crate) fn polygon_covers(corners: &[[i128; 2]], sample: [i128; 2], rule: FillRule) -> bool {
    let q = nudged(sample, rule);
    let mut crossings = 0;
    for (n, a) in corners.iter().enumerate() {
        let b = corners[(n + 1) % corners.len()];
        let (low, high) = if a[1] < b[1] { (*a, b) } else { (b, *a) };
        if low[1] * SCALE < q[1] && q[1] < high[1] * SCALE {
            // q is left of the edge at its height.
            let (dx, dy) = (high[0] - low[0], high[1] - low[1]);
            let right = dx * (q[1] - low[1] * SCALE) - dy * (q[0] - low[0] * SCALE);
            crossings += usize::from(right > 0);
        }
    }
    crossings % 2 == 1
}

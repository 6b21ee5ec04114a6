//! The quantities of the suite, as scenes on a profile's grid.

use super::Push;
use crate::explore::field::{Field, Value};
use crate::explore::metric::Metric;
use crate::explore::tolerance::Tolerance;
use crate::format::Clamp;
use crate::profile::Profile;
use crate::scene::{Lens, Triangle};
use crate::setup::VertexConfig;
use crate::value::DepthConfig;

/// Every push that means something for a profile.
pub(super) fn all(profile: &Profile) -> Vec<Push> {
    let grid = Grid::new(profile);
    let mut pushes = Vec::new();
    if profile.form.edge().is_some() {
        pushes.push(corners(profile, &grid));
    }
    if let Some(walk) = profile.form.walk() {
        pushes.extend([walked_edges(walk.fraction, &grid), ties(walk.fraction, &grid)]);
        pushes.push(far_edges(walk.guard, &grid));
    }
    pushes.extend(walked_area(profile, &grid));
    if let Some(depth) = profile.depth {
        pushes.extend([
            longest_walk(&depth, &grid),
            steepest(&depth, &grid),
            smallest_area(&depth, &grid),
            both_ends(&depth, &grid),
            division(&grid),
            toward_zero(&depth, &grid),
        ]);
    }
    pushes.into_iter().filter(|push| !push.scenes.is_empty()).collect()
}

/// Vertices in sub-pixels, and their depths.
type Given = ([[i128; 2]; 3], Option<[i128; 3]>);

/// The window in sub-pixels, as far as vertices go, and the vertex field.
struct Grid {
    vertex: VertexConfig,
    field: (i128, i128),
    low: [i128; 2],
    high: [i128; 2],
    /// The samples of the first and the last pixel.
    first: [i128; 2],
    last: [i128; 2],
    pixel: i128,
    top: i128,
}

impl Grid {
    fn new(profile: &Profile) -> Self {
        let pixel = 1i128 << profile.vertex.sub_pixel;
        let (low, high) = profile.vertex.range();
        let size = [profile.window.width, profile.window.height].map(i128::from);
        let half = i128::from(1u32 << profile.vertex.sub_pixel >> 1);
        let offset = profile.grid().map_or([half; 2], |grid| grid.offset);
        let last = [0, 1].map(|axis| (size[axis] - 1) * pixel + offset[axis]);
        Self {
            vertex: profile.vertex,
            field: (low, high),
            low: [low.max(0); 2],
            high: size.map(|side| high.min(side * pixel)),
            first: offset,
            last,
            pixel,
            top: i128::from(profile.depth_max()),
        }
    }

    /// Triangles whose vertices all lie on the grid, each a scene.
    fn keep(&self, triangles: Vec<Given>) -> Vec<Vec<Triangle>> {
        let inside = |value: &i128| (self.field.0..=self.field.1).contains(value);
        let kept = triangles.into_iter().filter(|(xy, _)| xy.iter().flatten().all(inside));
        kept.map(|(xy, z)| vec![Triangle::Lattice { xy: self.vertex.to_input(xy), z }]).collect()
    }
}

fn at_most(name: &str, limit: f64) -> Tolerance {
    let Some(metric) = Metric::find(name) else { unreachable!("{name} is a metric") };
    Tolerance { metric, limit }
}

/// From so many bits down to none.
fn down(from: u32) -> Vec<Value> {
    (0..=from).rev().map(Value::Bits).collect()
}

/// Edges between the corners of the vertex field, seen from the window's corners.
fn corners(profile: &Profile, grid: &Grid) -> Push {
    let (low, high) = grid.field;
    let half = grid.first[0];
    let own = profile.exact_edge_width().unwrap_or(2);
    Push {
        name: "window to its corners",
        pushed: format!(
            "edges between the corners of the vertex field, {low} to {high} sub-pixels"
        ),
        field: Field::EDGE_WIDTH,
        values: down(own),
        tolerance: at_most("misclassified", 0.0),
        scenes: grid.keep(vec![
            ([[low, low], [high, low], [low, high]], None),
            ([[high, low], [high, high], [low, high]], None),
            // The left column and the top row of samples, with the opposite edge as far as can be.
            ([[low, low], [high, low], [low + half, high]], None),
            ([[low, low], [high, high], [low, low + half + 1]], None),
            ([[low, high], [high, low], [high, high]], None),
            ([[high, low], [low, low], [high, high]], None),
        ]),
        lens: None,
    }
}

/// Slanted edges over the whole height.
fn walked_edges(fraction: u32, grid: &Grid) -> Push {
    let ([x0, y0], [x1, y1]) = (grid.low, grid.high);
    let third = (x1 - x0) / 3;
    Push {
        name: "walk to its longest",
        pushed: "edges over the whole height, with slopes that no number of fraction bits represents exactly".to_owned(),
        field: Field::WALK_FRACTION,
        values: down(fraction),
        tolerance: at_most("misclassified", 0.0),
        scenes: grid.keep(vec![
            ([[x0, y0], [x1, y0], [x0 + third, y1]], None),
            ([[x0 + third, y0], [x1, y1], [x0, y1]], None),
        ]),
        lens: None,
    }
}

/// Edges from the ends of the vertex field into the window.
fn far_edges(guard: u32, grid: &Grid) -> Push {
    let ([_, y0], [x1, y1], (from, to)) = (grid.low, grid.high, grid.field);
    Push {
        name: "x at the ends of its field",
        pushed: "edges from the lowest and from the highest x of a vertex, across the window"
            .to_owned(),
        field: Field::WALK_GUARD,
        values: down(guard),
        tolerance: at_most("misclassified", 0.0),
        scenes: grid.keep(vec![
            ([[from, y0], [x1, y0], [from, y1]], None),
            ([[to, y0], [to, y1], [x1 / 2, y1]], None),
        ]),
        lens: None,
    }
}

/// Edges that meet samples, with slopes that no fraction holds.
fn ties(fraction: u32, grid: &Grid) -> Push {
    let ([x0, y0], p) = (grid.low, grid.pixel);
    // x is half a pixel on the fourth row, and a sixth of a pixel more on each further one.
    let [top, bottom] = [[x0, y0 + p / 2], [x0 + p, y0 + 6 * p + p / 2]];
    Push {
        name: "samples on an edge",
        pushed:
            "an edge that moves 1 pixel over 6 rows and goes through the sample of the fourth row"
                .to_owned(),
        field: Field::WALK_FRACTION,
        values: down(fraction),
        tolerance: at_most("misclassified", 0.0),
        scenes: grid.keep(vec![
            ([top, bottom, [x0, bottom[1]]], None),
            ([top, [x0 + 4 * p, top[1]], bottom], None),
        ]),
        lens: None,
    }
}

/// A triangle of twice-area 1 that covers its own vertex: the smallest there is.
fn walked_area(profile: &Profile, grid: &Grid) -> Option<Push> {
    profile.form.edge()?;
    let [x, y] = grid.last;
    Some(Push {
        name: "area to 1, coverage",
        pushed: "a triangle at the last sample, whose doubled area is 1 square sub-pixel"
            .to_owned(),
        field: Field::EDGE_WIDTH,
        values: down(profile.exact_edge_width().unwrap_or(2)),
        tolerance: at_most("misclassified", 0.0),
        scenes: grid.keep(vec![([[x, y], [x + 1, y], [x, y + 1]], None)]),
        lens: None,
    })
}

/// Planes over the far corner, with slopes that no fraction holds.
fn longest_walk(depth: &DepthConfig, grid: &Grid) -> Push {
    let [x1, y1] = grid.high;
    let ([x0, y0], top) = (grid.low, grid.top);
    let corner = |z| ([[x1, y1], [x0 + 1, y1], [x1, y0 + 1]], Some(z));
    Push {
        name: "walk to its longest",
        pushed: format!(
            "the last pixel, {} steps from the first",
            (grid.last[0] - grid.first[0]) / grid.pixel
                + (grid.last[1] - grid.first[1]) / grid.pixel
        ),
        field: Field::INTERPOLATION,
        values: down(depth.interpolation),
        tolerance: at_most("depth-worst", 0.5),
        // Slopes of so many parts of the range over the width leave residues of every kind.
        scenes: grid
            .keep([8, 7, 5, 3, 2, 1].map(|part| corner([top / part, 0, 0])).into_iter().collect()),
        lens: None,
    }
}

/// Slopes that are far out of range on the way from the window's corner, and in range again over
/// the triangle.
fn steepest(depth: &DepthConfig, grid: &Grid) -> Push {
    let ([x, y], top, p) = (grid.last, grid.top, grid.pixel);
    let clamps = [Clamp::Guard, Clamp::Sign, Clamp::Wrap, Clamp::Saturate];
    Push {
        name: "slopes to their largest",
        pushed: format!(
            "the depth range of {top} over one sub-pixel, {} ULP per pixel, and over three pixels; each \
             clamp mode in turn",
            top * p
        ),
        field: Field::CLAMP,
        values: clamps.map(|clamp| Value::Name(clamp.name())).to_vec(),
        tolerance: at_most("depth-worst", if depth.interpolation == 0 { 1.0 } else { 0.5 }),
        scenes: grid.keep(vec![
            ([[x, y], [x + 1, y], [x, y + 1]], Some([top / 2, top, 0])),
            ([[x - 3 * p, y - 3 * p], [x, y - 3 * p], [x - 3 * p, y]], Some([top / 2, top, 0])),
        ]),
        lens: None,
    }
}

/// Triangles of the smallest areas that cover a sample, one of them with thirds as slopes.
fn smallest_area(depth: &DepthConfig, grid: &Grid) -> Push {
    let ([x, y], top) = (grid.last, grid.top);
    Push {
        name: "area to 1, depth",
        pushed: "triangles at the last sample, whose doubled area is 1 and 3 square sub-pixels"
            .to_owned(),
        field: Field::INTERPOLATION,
        values: down(depth.interpolation),
        tolerance: at_most("depth-worst", 0.5),
        scenes: grid.keep(vec![
            ([[x, y], [x + 1, y], [x, y + 1]], Some([0, top, 1])),
            ([[x, y - 1], [x + 1, y + 1], [x - 1, y]], Some([0, 1, 2])),
            ([[x, y - 1], [x + 1, y + 1], [x - 1, y]], Some([1, top, 0])),
        ]),
        lens: None,
    }
}

/// Planes that touch 0 and the maximum where a rounding carries them beyond.
fn both_ends(depth: &DepthConfig, grid: &Grid) -> Push {
    let ([fx, fy], top, p) = (grid.first, grid.top, grid.pixel);
    let at = |x: i128, y: i128| [fx + x * p, fy + y * p];
    let [w, h] = [0, 1].map(|axis| (grid.last[axis] - grid.first[axis]) / p);
    let mut triangles = Vec::new();
    // Slopes of a third, a fifth, a sixth and a seventh, which no fraction holds.
    for span in [3, 5, 6, 7].into_iter().filter(|span| *span <= w.min(h)) {
        for [x, y] in [[0, 0], [5.min(w - span), 0], [w - span, h - span]] {
            let xy = [at(x, y), at(x + span, y), at(x, y + span)];
            for z in [[0, 1, 0], [0, 0, 1], [top, top - 1, top], [top, top, top - 1]] {
                triangles.push((xy, Some(z)));
            }
        }
    }
    Push {
        name: "z to both ends",
        pushed: format!("vertices at samples, with depths of 0, 1, {} and {top}", top - 1),
        field: Field::GUARD,
        values: down(depth.guard),
        tolerance: at_most("wraps", 0.0),
        scenes: grid.keep(triangles),
        lens: None,
    }
}

/// One reciprocal for a plane over the whole window.
fn division(grid: &Grid) -> Push {
    let ([x0, y0], [x1, y1]) = (grid.low, grid.high);
    let top = grid.top;
    let words = std::iter::once(Value::Name("quotient"));
    Push {
        name: "division to its fewest bits",
        pushed: "one plane over the window, with the whole depth range and with parts of it"
            .to_owned(),
        field: Field::RECIPROCAL,
        values: words.chain((2..=40).rev().map(Value::Bits)).collect(),
        tolerance: at_most("depth-worst", 1.0),
        scenes: grid.keep(vec![
            ([[x0, y0], [x1, y0], [x0, y1]], Some([0, top, top / 3])),
            ([[x1, y1], [x0 + 1, y1], [x1, y0 + 1]], Some([top, top / 7, 0])),
        ]),
        lens: None,
    }
}

/// The near plane toward the eye, w toward zero: nearly all codes lie close by, and two surfaces far
/// away have to share what is left.
fn toward_zero(depth: &DepthConfig, grid: &Grid) -> Push {
    // Far over near, and how far apart the surfaces are as a part of the far distance.
    let (near, far, apart) = (1.0, 65536.0, 1.0 / 256.0);
    let part = |distance: f64| far * (distance - near) / (distance * (far - near));
    #[allow(clippy::cast_precision_loss, reason = "a depth to be snapped")]
    let top = grid.top as f64;
    let [x, y] = [0, 1].map(|axis| {
        #[allow(clippy::cast_precision_loss, reason = "pixels")]
        let pixel = (grid.first[axis] / grid.pixel) as f64;
        pixel
    });
    let flat = |distance: f64| Triangle::Real {
        xy: [[x, y], [x + 2.0, y], [x, y + 2.0]],
        z: Some([part(distance) * top; 3]),
    };
    Push {
        name: "w toward zero",
        pushed: format!(
            "far / near = {far}, with surfaces at the far plane and nearer by {apart} of its distance"
        ),
        field: Field::INTEGER,
        values: (1..=depth.integer).rev().map(Value::Bits).collect(),
        tolerance: at_most("snap-ties", 0.0),
        scenes: vec![vec![flat(far * (1.0 - apart)), flat(far)]],
        lens: Some(Lens { near, far }),
    }
}

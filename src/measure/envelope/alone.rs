//! The envelope of one triangle alone.

use super::family::Family;
use super::raster::{At, Placed, visit};
use super::{Class, Shape};

/// The pixels around one triangle. Outside of them, nothing covers.
#[derive(Clone, Debug)]
pub struct Alone {
    /// The first column and row.
    from: [u32; 2],
    width: u32,
    /// Different triangles on the grids, as `place` made them.
    shapes: u16,
    /// In how many of them the sample of a pixel is covered by every rule.
    inside: Vec<u16>,
    /// Whether it is on an edge of one, and the rule is open.
    edge: Vec<bool>,
}

impl Alone {
    /// Draws a triangle in every way of a family.
    pub fn of(family: &Family, shape: &Shape, window: (u32, u32)) -> Self {
        let [x, y] =
            [0, 1].map(|axis| span(shape, axis, if axis == 0 { window.0 } else { window.1 }));
        let (from, width) = ([x.0, y.0], x.1 - x.0);
        let size = width as usize * (y.1 - y.0) as usize;
        let mut alone =
            Self { from, width, shapes: 0, inside: vec![0; size], edge: vec![false; size] };
        // Two ways that put all vertices at the same places draw the same.
        let mut before: Vec<Placed> = Vec::with_capacity(family.ways.len());
        for way in &family.ways {
            let placed = way.place(shape);
            let finest = placed.map(|vertex| vertex.map(|value| value << (FINEST - way.bits)));
            if before.contains(&finest) {
                continue;
            }
            before.push(finest);
            alone.shapes += 1;
            visit(placed, way.bits, window, |x, y, at| {
                let Some(n) = alone.index(x, y) else { return };
                match (at, family.api.rule()) {
                    (At::Inside, _) => alone.inside[n] += 1,
                    (At::OnEdge(edges), Some(rule)) => {
                        alone.inside[n] += u16::from(rule.takes(edges));
                    }
                    (At::OnEdge(_), None) => alone.edge[n] = true,
                }
            });
        }
        alone
    }

    fn index(&self, x: u32, y: u32) -> Option<usize> {
        let (x, y) = (x.checked_sub(self.from[0])?, y.checked_sub(self.from[1])?);
        let n = y as usize * self.width as usize + x as usize;
        (x < self.width && n < self.inside.len()).then_some(n)
    }

    /// Its pixels with their classes, by rows.
    pub fn pixels(&self) -> impl Iterator<Item = ([u32; 2], Class)> {
        (0u32..).zip(self.inside.iter().zip(&self.edge)).map(|(n, (inside, edge))| {
            let [x, y] = self.from;
            // Where the rule is open, one rule gives a sample on an edge to the triangle, and another does not.
            let class = Class::of(*inside > 0 || *edge, *inside < self.shapes);
            ([x + n % self.width, y + n / self.width], class)
        })
    }

    /// How many pixels every rasterizer covers, and how many some do.
    pub fn count(&self) -> [u32; 2] {
        let mut count = [0, 0];
        for (_, class) in self.pixels() {
            match class {
                Class::Must => count[0] += 1,
                Class::May => count[1] += 1,
                Class::MustNot => {}
            }
        }
        count
    }
}

/// Sub-pixel bits of the finest grid.
const FINEST: u32 = 16;

/// The pixels that a triangle can reach on an axis, however it is snapped: by less than one pixel.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the window, whose sides have 32 bits"
)]
fn span(shape: &Shape, axis: usize, size: u32) -> (u32, u32) {
    let [a, b, c] = shape.map(|vertex| vertex[axis]);
    let end = |value: f64| value.clamp(0.0, f64::from(size)) as u32;
    let low = end(a.min(b).min(c).floor() - 1.0);
    (low, end(a.max(b).max(c).ceil() + 1.0).max(low))
}

/// MUST and MAY pixels of each triangle alone, on so many threads.
pub fn counts(
    family: &Family,
    shapes: &[Shape],
    window: (u32, u32),
    threads: usize,
) -> Vec<[u32; 2]> {
    let part = shapes.len().div_ceil(threads.max(1)).max(1);
    let mut all = Vec::with_capacity(shapes.len());
    std::thread::scope(|scope| {
        let work = |part: &'_ [Shape]| -> Vec<[u32; 2]> {
            part.iter().map(|shape| Alone::of(family, shape, window).count()).collect()
        };
        let handles: Vec<_> =
            shapes.chunks(part).map(|part| scope.spawn(move || work(part))).collect();
        for handle in handles {
            match handle.join() {
                Ok(part) => all.extend(part),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
    });
    all
}

//! How far a triangle is from one that all rasterizers draw alike. Spec clause `EN-7`.

use super::alone::Alone;
use super::family::Family;
use super::raster::{At, visit};
use super::{Class, Shape};
use crate::bits::Rounding;
use crate::setup::snap_f64;

/// Steps of a pixel in which vertices are moved.
pub const STEPS: u32 = 16;
/// Bits below the pixel at which a triangle is taken as it is given.
const GIVEN_BITS: u32 = 40;
/// The most steps by which three vertices move each on its own: their moves are too many beyond.
pub const STEPS_OF_THREE: u32 = 4;

/// Which vertices move.
#[derive(Clone, Copy)]
enum Stage {
    /// All by the same steps.
    Together,
    /// These, each by steps of its own.
    Each(&'static [usize]),
}

/// The order of the search.
const STAGES: [Stage; 8] = [
    Stage::Together,
    Stage::Each(&[0]),
    Stage::Each(&[1]),
    Stage::Each(&[2]),
    Stage::Each(&[0, 1]),
    Stage::Each(&[1, 2]),
    Stage::Each(&[0, 2]),
    Stage::Each(&[0, 1, 2]),
];

/// A move of vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Move {
    /// By how many steps each vertex moves to the right and down.
    pub steps: [[i32; 2]; 3],
}

impl Move {
    /// The largest distance along an axis, in steps.
    pub fn most(&self) -> u32 {
        self.steps.as_flattened().iter().map(|steps| steps.unsigned_abs()).max().unwrap_or(0)
    }

    /// The triangle after the move, as binary32 numbers.
    #[allow(clippy::cast_possible_truncation, reason = "the rounding to binary32 is the point")]
    pub fn apply(&self, shape: &Shape) -> Shape {
        let mut moved = *shape;
        for (vertex, steps) in moved.iter_mut().zip(self.steps) {
            for (value, steps) in vertex.iter_mut().zip(steps) {
                *value = f64::from((*value + f64::from(steps) / f64::from(STEPS)) as f32);
            }
        }
        moved
    }
}

impl Stage {
    /// Its moves of exactly so many steps; short ones of single coordinates come first.
    fn moves(self, most: u32) -> impl Iterator<Item = Move> {
        let free = match self {
            Self::Together => &[0][..],
            Self::Each([_, _, _]) if most > STEPS_OF_THREE => &[],
            Self::Each(vertices) => vertices,
        };
        let base = u64::from(2 * most + 1);
        let digits = 2 * free.len();
        let count = if digits == 0 { 0 } else { (0..digits).fold(1, |count, _| count * base) };
        let every = (0..count).map(move |mut number| {
            let mut steps = [[0; 2]; 3];
            for vertex in free {
                for value in &mut steps[*vertex] {
                    let digit = i32::try_from(number % base).unwrap_or(0);
                    number /= base;
                    // 0, 1, -1, 2, -2 and so on.
                    *value = if digit % 2 == 1 { digit / 2 + 1 } else { -(digit / 2) };
                }
            }
            if matches!(self, Self::Together) {
                steps = [steps[0]; 3];
            }
            Move { steps }
        });
        every.filter(move |by| by.most() == most)
    }
}

/// What a search for a move found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// All rasterizers draw it alike as it is.
    Decided,
    /// The smallest move.
    Found(Move),
    /// No move that was tried is enough.
    Nothing,
}

/// Searches the smallest move, up to so many steps, after which all rasterizers cover the same pixels: every sample
/// inside the triangle as it is given, and none outside of it.
pub fn search(family: &Family, shape: &Shape, window: (u32, u32), most: u32) -> Search {
    if Alone::of(family, shape, window).count()[1] == 0 {
        return Search::Decided;
    }
    let aim = Aim::of(shape, window);
    let mut moves = (1..=most).flat_map(|most| STAGES.into_iter().flat_map(move |s| s.moves(most)));
    let found = moves.find(|by| aim.is_met(family, &by.apply(shape), window));
    found.map_or(Search::Nothing, Search::Found)
}

/// The samples of a triangle as it is given, before any snap.
struct Aim {
    inside: Vec<[u32; 2]>,
    on_edge: Vec<[u32; 2]>,
}

impl Aim {
    fn of(shape: &Shape, window: (u32, u32)) -> Self {
        let given = shape.map(|vertex| {
            vertex
                .map(|value| snap_f64(value, GIVEN_BITS, Rounding::NearestEven).unwrap_or_default())
        });
        let mut aim = Self { inside: Vec::new(), on_edge: Vec::new() };
        visit(given, GIVEN_BITS, window, |x, y, at| match at {
            At::Inside => aim.inside.push([x, y]),
            At::OnEdge(_) => aim.on_edge.push([x, y]),
        });
        aim
    }

    /// Whether all ways cover the same pixels, and these are the aim. It stops at the first way that does not, which
    /// is soon: ways of few bits come first.
    fn is_met(&self, family: &Family, moved: &Shape, window: (u32, u32)) -> bool {
        let (mut first, mut covered) = (None, Vec::new());
        for way in &family.ways {
            covered.clear();
            let mut decided = true;
            visit(way.place(moved), way.bits, window, |x, y, at| match (at, family.api.rule()) {
                (At::Inside, _) => covered.push([x, y]),
                (At::OnEdge(edges), Some(rule)) => {
                    if rule.takes(edges) {
                        covered.push([x, y]);
                    }
                }
                (At::OnEdge(_), None) => decided = false,
            });
            let same = first.as_ref().is_none_or(|first| *first == covered);
            if !decided || !same || (first.is_none() && !self.allows(&covered)) {
                return false;
            }
            first.get_or_insert_with(|| covered.clone());
        }
        true
    }

    /// Whether pixels, by rows, are those inside and none but those on edges.
    fn allows(&self, covered: &[[u32; 2]]) -> bool {
        let by_rows = |[x, y]: &[u32; 2]| [*y, *x];
        let has =
            |list: &[[u32; 2]], pixel| list.binary_search_by_key(&by_rows(pixel), by_rows).is_ok();
        let inside = covered.iter().filter(|pixel| has(&self.inside, pixel)).count();
        let on_edge = covered.iter().filter(|pixel| has(&self.on_edge, pixel)).count();
        inside == self.inside.len() && inside + on_edge == covered.len()
    }
}

/// How close the outline of a triangle comes to the sample of a decided pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Margin {
    /// The pixel.
    pub pixel: [u32; 2],
    /// The distance in pixels.
    pub distance: f64,
}

/// The smallest distance from the sample of a decided pixel to the nearest edge of the triangle as it is given, among
/// the pixels around it.
pub fn margin(family: &Family, shape: &Shape, window: (u32, u32)) -> Option<Margin> {
    let alone = Alone::of(family, shape, window);
    let decided = alone.pixels().filter(|(_, class)| *class != Class::May);
    let margins = decided.map(|(pixel, _)| {
        let sample = pixel.map(|value| f64::from(value) + 0.5);
        let edges = (0..3).map(|n| to_segment(sample, shape[n], shape[(n + 1) % 3]));
        Margin { pixel, distance: edges.fold(f64::INFINITY, f64::min) }
    });
    margins.min_by(|one, other| one.distance.total_cmp(&other.distance))
}

/// The distance from a point to a segment.
fn to_segment([x, y]: [f64; 2], [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let (dx, dy) = (bx - ax, by - ay);
    let length = dx * dx + dy * dy;
    let part = ((x - ax) * dx + (y - ay) * dy) / length;
    // A segment without length is its end.
    let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
    (x - ax - part * dx).hypot(y - ay - part * dy)
}

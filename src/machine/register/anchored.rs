//! Integer vertices, exact spans, and planes anchored at one vertex. Spec clauses `RG-8` to `RG-10`.

mod form;

use super::host::{attributes, target_ends};
use super::input::{Inputs, RegisterError};
use super::{Built, Engine};
use crate::bits::Rounding;
use crate::format::Gather;
use crate::machine::Target;
use crate::setup::{Triangle, VertexConfig};
use crate::value::Channel;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which vertex the planes go through: the leftmost, the last of several in the order looked at but for
/// the first two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Anchor {
    /// Looked for among the vertices as they came.
    LeftmostGiven,
    /// Looked for among the vertices sorted by y.
    LeftmostSorted,
}

/// How the vertices are sorted by y, where two have the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum VertexSort {
    /// They stay as they came.
    #[default]
    Stable,
    /// The first order of a fixed list in which y does not fall: 0 2 1, 1 0 2, 1 2 0, 2 0 1, 2 1 0, 0 1 2.
    FirstMatch,
}

impl VertexSort {
    /// The order of a sort by comparators, from top to bottom.
    fn order(self, y: [i64; 3]) -> [usize; 3] {
        let orders = match self {
            Self::Stable => [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]],
            Self::FirstMatch => [[0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0], [0, 1, 2]],
        };
        let fits = |[a, b, c]: &[usize; 3]| y[*a] <= y[*b] && y[*b] <= y[*c];
        orders
            .into_iter()
            .find(fits)
            .unwrap_or_else(|| unreachable!("all orders of three are tried"))
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
const fn is_stable(sort: &VertexSort) -> bool {
    matches!(sort, VertexSort::Stable)
}

/// Which half of a triangle is drawn first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum HalfOrder {
    /// The lower one, unless the anchor is the top vertex.
    FromAnchor,
    /// The upper one.
    UpperFirst,
}

/// The longest edge that is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Largest {
    /// |dx|, in pixels.
    pub x: u32,
    /// |dy|, in pixels.
    pub y: u32,
}

/// The engine of `[form.registers.engine.anchored]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct AnchoredConfig {
    /// Which vertex the planes go through.
    pub anchor: Anchor,
    /// How vertices of the same y are sorted.
    #[serde(default, skip_serializing_if = "is_stable")]
    pub sort: VertexSort,
    /// Which half is drawn first.
    pub halves: HalfOrder,
    /// How slopes are rounded.
    pub rounding: Rounding,
    /// The longest edge that is drawn; no limit when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub largest: Option<Largest>,
}

const NAME: &str = "anchored";

#[derive(Clone, Debug)]
struct Anchored {
    config: AnchoredConfig,
    signed: bool,
    vertices: [[Gather; 2]; 3],
    /// Values of each channel at the vertices.
    values: Vec<[Gather; 3]>,
    /// Closed: left, top, right, bottom.
    clip: [Gather; 4],
    channels: Vec<Channel>,
    target: Target,
}

/// A vertex and its number as it came.
type Vertex = ([i64; 2], usize);

/// A channel's value at pixel (0, 0), and its slopes.
type Plane = [i64; 3];

impl AnchoredConfig {
    pub(super) fn engine(
        &self,
        inputs: &Inputs<'_>,
        channels: &[Channel],
        vertex: &VertexConfig,
        target: Target,
    ) -> Result<Built, RegisterError> {
        let fault = |reason: String| RegisterError::Together { engine: NAME, reason };
        if vertex.sub_pixel != 0 {
            return Err(fault(format!(
                "vertex sub-pixel = {}: planes are anchored at whole pixels, 0 is needed",
                vertex.sub_pixel
            )));
        }
        // A slope is a cross product of coordinates and values, over another.
        let bits = vertex.difference_bits();
        for channel in channels {
            let need = bits + channel.read.integer() + channel.read.fraction() + 2;
            if need > 62 {
                let name = &channel.name;
                return Err(fault(format!(
                    "channel {name:?}: difference + integer + interpolation + 2 = {need} <= 62 bits is \
                     needed"
                )));
            }
        }
        let pair = |names| inputs.all(NAME, names);
        let vertices = [pair(["x0", "y0"])?, pair(["x1", "y1"])?, pair(["x2", "y2"])?];
        let values = channels
            .iter()
            .map(|channel| {
                let name = |n: usize| format!("{}{n}", channel.name);
                let [a, b, c] = [name(0), name(1), name(2)];
                inputs.all(NAME, [a.as_str(), &b, &c])
            })
            .collect::<Result<_, _>>()?;
        let clip = inputs.all(NAME, ["left", "top", "right", "bottom"])?;
        let mut names = vec!["x".to_owned(), "y".to_owned()];
        names.extend(channels.iter().map(|channel| channel.name.clone()));
        let (config, signed) = (*self, vertex.signed);
        let engine = Anchored {
            config,
            signed,
            vertices,
            values,
            clip,
            channels: channels.to_vec(),
            target,
        };
        Ok((Box::new(engine), vec![names]))
    }
}

/// The leftmost of three: later ones win a tie.
const fn leftmost(v: [[i64; 2]; 3]) -> usize {
    if v[1][0] <= v[0][0] {
        if v[2][0] <= v[1][0] { 2 } else { 1 }
    } else if v[2][0] < v[0][0] {
        2
    } else {
        0
    }
}

impl Anchored {
    fn corners(&self, words: &[u32]) -> [[i64; 2]; 3] {
        let read = |gather: &Gather| {
            if self.signed { gather.signed(words) } else { gather.unsigned(words).cast_signed() }
        };
        self.vertices.each_ref().map(|vertex| vertex.each_ref().map(read))
    }

    /// Vertices from top to bottom, and which of them is the anchor.
    fn sorted(&self, v: [[i64; 2]; 3]) -> ([Vertex; 3], usize) {
        let sorted = self.config.sort.order(v.map(|at| at[1])).map(|n| (v[n], n));
        let anchor = match self.config.anchor {
            Anchor::LeftmostGiven => {
                let given = leftmost(v);
                let place = sorted.iter().position(|(_, n)| *n == given);
                place.unwrap_or_else(|| unreachable!("vertex {given} of three"))
            }
            Anchor::LeftmostSorted => leftmost(sorted.map(|(at, _)| at)),
        };
        (sorted, anchor)
    }

    fn too_large(&self, v: &[[i64; 2]; 3]) -> bool {
        self.config.largest.is_some_and(|Largest { x, y }| {
            let far = |a: [i64; 2], b: [i64; 2]| {
                (a[0] - b[0]).unsigned_abs() > u64::from(x)
                    || (a[1] - b[1]).unsigned_abs() > u64::from(y)
            };
            far(v[0], v[1]) || far(v[1], v[2]) || far(v[2], v[0])
        })
    }

    /// The planes of all channels; `None` without area.
    fn planes(&self, words: &[u32], sorted: &[Vertex; 3], anchor: usize) -> Option<Vec<Plane>> {
        let v = sorted.map(|(at, _)| at);
        let cross = |p: [i64; 3], q: [i64; 3]| {
            (p[1] - p[0]) * (q[2] - q[1]) - (p[2] - p[1]) * (q[1] - q[0])
        };
        let [x, y] = [0, 1].map(|axis: usize| v.map(|at| at[axis]));
        let area = i128::from(cross(x, y));
        if area == 0 {
            return None;
        }
        let plane = |(channel, gathers): (&Channel, &[Gather; 3])| {
            let value = sorted.map(|(_, n)| gathers[n].unsigned(words).cast_signed());
            let fraction = channel.read.fraction();
            let slope = |cross: i64| {
                let exact = self.config.rounding.divide(i128::from(cross) << fraction, area);
                exact.and_then(|(slope, _)| i64::try_from(slope).ok()).unwrap_or(0)
            };
            let (dx, dy) = (slope(cross(value, y)), slope(cross(x, value)));
            // Half a code, so that the read-out's floor rounds.
            let start = (value[anchor] << fraction) + (1 << fraction >> 1);
            let back = dx.wrapping_mul(v[anchor][0]).wrapping_add(dy.wrapping_mul(v[anchor][1]));
            [start.wrapping_sub(back), dx, dy]
        };
        Some(self.channels.iter().zip(&self.values).map(plane).collect())
    }
}

/// The first pixel at or right of an edge in row y: a ceiling, exact.
const fn ceiling(a: [i64; 2], b: [i64; 2], y: i64) -> i64 {
    let (along, height) = ((b[0] - a[0]) * (y - a[1]), b[1] - a[1]);
    a[0] - (-along).div_euclid(height)
}

impl Engine for Anchored {
    fn run(&self, words: &[u32], emit: &mut dyn FnMut(usize, &[i64])) {
        let v = self.corners(words);
        let (sorted, anchor) = self.sorted(v);
        if self.too_large(&v) {
            return;
        }
        let Some(planes) = self.planes(words, &sorted, anchor) else { return };
        let [left, top, right, bottom] =
            self.clip.each_ref().map(|gather| gather.unsigned(words).cast_signed());
        let [a, b, c] = sorted.map(|(at, _)| at);
        let mut values = vec![0; 2 + planes.len()];
        let mut row = |y: i64, short: ([i64; 2], [i64; 2])| {
            let (long, short) = (ceiling(a, c, y), ceiling(short.0, short.1, y));
            let (x0, x1) = (long.min(short).max(left), long.max(short).min(right + 1));
            for x in x0..x1 {
                values[..2].copy_from_slice(&[x, y]);
                for ((value, plane), channel) in
                    values[2..].iter_mut().zip(&planes).zip(&self.channels)
                {
                    let at = plane[0].wrapping_add(plane[1].wrapping_mul(x));
                    *value = channel.value(channel.wrap(at.wrapping_add(plane[2].wrapping_mul(y))));
                }
                emit(0, &values);
            }
        };
        let (from, to) = (top, bottom + 1);
        let upper = (a[1].max(from)..b[1].min(to), (a, b), anchor > 0);
        let lower = (b[1].max(from)..c[1].min(to), (b, c), anchor > 1);
        let lower_first = self.config.halves == HalfOrder::FromAnchor && anchor > 0;
        for (rows, short, upward) in if lower_first { [lower, upper] } else { [upper, lower] } {
            if upward {
                rows.rev().for_each(|y| row(y, short));
            } else {
                rows.for_each(|y| row(y, short));
            }
        }
    }

    /// The pixels of the clipped box.
    fn work(&self, words: &[u32], _: u64) -> u128 {
        let v = self.corners(words);
        let [left, top, right, bottom] = self.clip.each_ref().map(|end| end.unsigned(words));
        let side = |axis: usize, low: u64, high: u64| {
            let all = v.map(|at| i128::from(at[axis]));
            let first = all.into_iter().fold(i128::MAX, i128::min).max(low.into());
            let last = all.into_iter().fold(i128::MIN, i128::max).min(high.into());
            u128::try_from(last - first + 1).unwrap_or(0)
        };
        side(0, left, right) * side(1, top, bottom)
    }

    fn host(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        let mut words = vec![0; count];
        for (vertex, at) in self.vertices.iter().zip(triangle.xy) {
            for (gather, value) in vertex.iter().zip(at) {
                gather.scatter(value, &mut words);
            }
        }
        for (n, (gathers, channel)) in self.values.iter().zip(&self.channels).enumerate() {
            for (gather, value) in gathers.iter().zip(attributes(channel, n)) {
                gather.scatter(value, &mut words);
            }
        }
        let ends = target_ends(&self.target, true, self.clip.each_ref());
        for (gather, end) in self.clip.iter().zip(ends) {
            gather.scatter(end, &mut words);
        }
        vec![words]
    }
}

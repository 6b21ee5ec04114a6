//! Triangles on the sub-pixel grid: directed classes and random ones. Spec clause `X-3`.

use super::{Class, Words};
use crate::profile::Profile;
use crate::setup::Triangle;

/// A directed class and its triangles.
#[derive(Clone, Debug)]
pub struct Directed {
    /// What they are for.
    pub class: Class,
    /// The triangles, all inside the vertex field.
    pub triangles: Vec<Triangle>,
}

/// The class of random triangles.
pub const RANDOM: Class =
    Class { tag: "random", catches: "what nobody thought of: triangles of every size and shape" };

/// The class of the scene's own triangles.
pub const SCENE: Class = Class { tag: "scene", catches: "what a real scene meets" };

/// Stimulus for one profile: its grid, window and depth range.
#[derive(Clone, Copy, Debug)]
pub struct Stimulus {
    range: (i128, i128),
    pixel: i128,
    /// Bits that a slope's numerator is scaled by before it is divided.
    scale: u32,
    centre: [i128; 2],
    window: [i128; 2],
    depth: Option<i128>,
}

impl Stimulus {
    /// Stimulus for a valid profile.
    pub fn new(profile: &Profile) -> Self {
        let grid = profile.grid().map_or([0; 2], |grid| grid.offset);
        Self {
            range: profile.vertex.range(),
            pixel: 1 << profile.vertex.sub_pixel,
            scale: profile.vertex.sub_pixel + profile.depth.map_or(0, |depth| depth.interpolation),
            centre: grid,
            window: [i128::from(profile.window.width), i128::from(profile.window.height)],
            depth: profile.depth.map(|_| i128::from(profile.depth_max())),
        }
    }

    /// The directed classes; what does not fit the vertex field is left out.
    pub fn directed(&self) -> Vec<Directed> {
        [
            self.zero_area(),
            self.shared_edges(),
            self.on_samples(),
            self.slivers(),
            self.widest_slopes(),
            self.ends(),
            self.remainders(),
            self.guard_boundary(),
        ]
        .into_iter()
        .map(|(tag, catches, list)| {
            let triangles = list.into_iter().filter_map(|(xy, z)| self.fit(xy, z)).collect();
            Directed { class: Class { tag, catches }, triangles }
        })
        .filter(|class| !class.triangles.is_empty())
        .collect()
    }

    /// The triangle, if it fits the field; depths are fractions of the range: 0 to 16.
    fn fit(&self, xy: [[i128; 2]; 3], z: [i128; 3]) -> Option<Triangle> {
        let (low, high) = self.range;
        let fits = xy.iter().flatten().all(|value| (low..=high).contains(value));
        let z = self.depth.map(|maximum| z.map(|part| Self::part(part, maximum)));
        fits.then_some(Triangle { xy, z })
    }

    /// `part` sixteenths of the depth range; negative parts count codes down from the top, parts
    /// above 16 are codes plus 17.
    fn part(part: i128, maximum: i128) -> i128 {
        match part {
            0..=16 => maximum * part / 16,
            17.. => (part - 17).min(maximum),
            _ => (maximum + 1 + part).max(0),
        }
    }

    /// The sample nearest the middle of the window's upper left part.
    fn middle(&self) -> [i128; 2] {
        std::array::from_fn(|axis| (self.window[axis].min(16) / 2) * self.pixel + self.centre[axis])
    }

    fn zero_area(&self) -> Kind {
        let [x, y] = self.middle();
        let p = self.pixel;
        let list = [
            [[x, y]; 3],
            [[x, y], [x, y], [x + p, y + p]],
            [[x - p, y], [x, y], [x + p, y]],
            [[x, y - p], [x, y + p], [x, y]],
            [[x - p, y - p], [x + p, y + p], [x, y]],
            [[0, 0], [p, p], [2 * p, 2 * p]],
        ];
        let catches = "a division by zero area, or a degenerate triangle that draws";
        ("zero-area", catches, list.into_iter().map(|xy| (xy, [0, 16, 3])).collect())
    }

    /// Both sides of edges through sample points, in sixteen directions, both windings.
    fn shared_edges(&self) -> Kind {
        let [x, y] = self.middle();
        let p = self.pixel;
        let directions = [[2, 0], [2, 1], [1, 1], [1, 2], [0, 2], [-1, 2], [-1, 1], [-2, 1]];
        let mut list = Vec::new();
        for [dx, dy] in directions {
            let (from, to) = ([x - dx * p, y - dy * p], [x + dx * p, y + dy * p]);
            // The third vertex on either side, off the sample grid where there is a grid finer.
            for side in [1, -1] {
                let apex = [x - side * dy * p + p / 2, y + side * dx * p + p / 4];
                list.push(([from, to, apex], [0, 16, 8]));
                list.push(([to, from, apex], [3, 1, 16]));
            }
        }
        ("shared-edges", "holes and double hits along shared edges: the fill rule's tie", list)
    }

    /// Samples on vertices and on edges, every vertex order.
    fn on_samples(&self) -> Kind {
        let [x, y] = self.middle();
        let p = self.pixel;
        let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
        let shapes = [
            [[x, y], [x + p, y], [x, y + p]],
            [[x, y], [x - p, y + p], [x + p, y + p]],
            [[x, y], [x + p, y - p], [x + p, y + p]],
            [[x, y], [x - p, y - p], [x - p, y + p]],
            [[x, y], [x + p, y - p], [x - p, y - p]],
            [[x - p, y], [x + p, y], [x, y - p]],
        ];
        let list = shapes
            .iter()
            .flat_map(|shape| orders.map(|order| (order.map(|n: usize| shape[n]), [0, 8, 16])))
            .collect();
        ("sample-on-vertex", "a vertex or edge through a sample, in every vertex order", list)
    }

    fn slivers(&self) -> Kind {
        let [x, y] = self.middle();
        let (p, last) =
            (self.pixel, [0, 1].map(|axis| (self.window[axis].min(64) - 1) * self.pixel));
        let list = vec![
            ([[0, y], [last[0], y], [last[0], y + 1]], [0, 16, 16]),
            ([[0, y], [last[0], y + 1], [0, y + 1]], [16, 0, 16]),
            ([[x, 0], [x, last[1]], [x + 1, last[1]]], [0, 16, 0]),
            ([[x, 0], [x + 1, 0], [x, last[1]]], [0, 16, 8]),
            ([[0, 0], [last[0], last[1]], [last[0], last[1] - 1]], [0, 16, 0]),
            ([[0, last[1]], [last[0], 0], [last[0], 1]], [16, 0, 16]),
            ([[1, p], [last[0], p + 1], [last[0] - 1, p + 2]], [0, 1, 16]),
        ];
        ("slivers", "precision lost in long thin triangles", list)
    }

    /// Areas of 1/2, 1 and so on square sub-pixels, with the whole depth range across them.
    fn widest_slopes(&self) -> Kind {
        let [x, y] = self.middle();
        let list = [
            [[x, y], [x + 1, y], [x, y + 1]],
            [[x - 1, y], [x + 1, y], [x, y + 1]],
            [[x - 1, y - 1], [x + 1, y], [x, y + 1]],
            [[x + 1, y], [x, y + 1], [x - 1, y - 1]],
        ]
        .into_iter()
        .flat_map(|xy| [[0, 16, 0], [16, 0, 0], [0, 0, 16], [16, 16, 0]].map(|z| (xy, z)))
        .collect();
        ("widest-slopes", "slope words too narrow, a divider that overflows", list)
    }

    /// Both ends of every range: the whole window, its corners, one pixel, depth 0 and maximum.
    fn ends(&self) -> Kind {
        let (low, high) = self.range;
        let p = self.pixel;
        let [w, h] = self.window.map(|side| (side * self.pixel).min(high));
        let mut list = vec![
            ([[0, 0], [w, 0], [0, h]], [0, 16, 16]),
            ([[w, h], [0, h], [w, 0]], [16, 0, 8]),
            ([[low, low], [high, low], [low, high]], [0, 16, 0]),
            ([[high, high], [low, high], [high, low]], [16, 16, 16]),
        ];
        for [x, y] in [[0, 0], [w - p, 0], [0, h - p], [w - p, h - p]] {
            list.push(([[x, y], [x + p, y], [x, y + p]], [0, 0, 0]));
            list.push(([[x + p, y + p], [x, y + p], [x + p, y]], [16, 16, 16]));
            list.push(([[x, y], [x + p, y], [x + p, y + p]], [0, -1, 18]));
        }
        ("range-ends", "both ends of every field: window, vertex range, depth range", list)
    }

    /// Small areas with every depth difference: every remainder of the slope's rounding.
    fn remainders(&self) -> Kind {
        let [x, y] = self.middle();
        let mut list = Vec::new();
        for area in 1..=12 {
            for z in 0..=area {
                list.push(([[x, y], [x + area, y], [x, y + 1]], [17, 17 + z, 17]));
                list.push(([[x, y], [x + 1, y], [x, y + area]], [17 + z, 17, 17]));
            }
        }
        // Twice the area 2^(scale + 1) under an odd numerator: the slope lies half way between two
        // words. In every octant, and for either slope.
        let ties = self.scale + 1;
        let (p, q) = (1i128 << ties.div_ceil(2), 1i128 << (ties / 2));
        let [x, y] = self.window.map(|side| side * self.pixel / 2);
        // From the window's corner too, for fields too small for those about its middle.
        let turns = [[1, 1], [1, -1], [-1, 1], [-1, -1]].map(|turn| ([x, y], turn));
        for ([x, y], [dx, dy]) in turns.into_iter().chain([([0, 0], [1, 1])]) {
            let at = |u: i128, v: i128| [[x + dx * u, y + dy * v], [x + dx * v, y + dy * u]];
            let (b, c) = (at(p, 1), at(p, 1 + q));
            for axes in 0..2 {
                for z in [[17, 18, 17], [18, 17, 18], [17, 20, 18], [20, 17, 19]] {
                    list.push(([[x, y], b[axes], c[axes]], z));
                }
            }
        }
        ("every-remainder", "a rounding other than the profile's, ties above all", list)
    }

    /// Samples whose plane runs just below zero and just above the maximum.
    fn guard_boundary(&self) -> Kind {
        let [x, y] = self.middle();
        let p = self.pixel;
        let list = [1, 3, 5, 7]
            .into_iter()
            .flat_map(|size| {
                let xy = [[x, y], [x + size * p, y], [x, y + size * p]];
                [[17, 18, 17], [17, 17, 18], [-1, -2, -1], [-1, -1, -2], [17, -1, 18]]
                    .map(|z| (xy, z))
            })
            .collect();
        (
            "guard-boundary",
            "a missing guard bit: covered samples just outside the depth range",
            list,
        )
    }

    /// A random triangle; `reach` bounds its extent in pixels when given.
    pub fn random(&self, mut words: Words, reach: Option<i128>) -> Triangle {
        let (low, high) = self.range;
        // Depth codes of 64 bits are drawn from the lower half of their range: the ends of it are
        // drawn by name below.
        let mut between = |low: i128, high: i128| {
            let [low, high] = [low, high].map(within_i64);
            words.between(low, high.max(low))
        };
        // Sizes of every magnitude, from a sub-pixel to the window.
        let largest = reach.map_or(high - low, |pixels| pixels * self.pixel);
        let bits = i128::BITS - largest.leading_zeros();
        let size = largest >> between(0, i128::from(bits) - 1);
        let corner: [i128; 2] =
            std::array::from_fn(|axis| between(0, (self.window[axis] * self.pixel - size).max(0)));
        let xy = std::array::from_fn(|_| {
            corner.map(|at| (at + between(0, size.max(1))).clamp(low, high))
        });
        let z = self.depth.map(|maximum| {
            std::array::from_fn(|_| match between(0, 7) {
                0 => 0,
                1 => maximum,
                _ => between(0, maximum),
            })
        });
        Triangle { xy, z }
    }
}

/// The nearest value that 64 bits hold.
fn within_i64(value: i128) -> i64 {
    let value = value.clamp(i64::MIN.into(), i64::MAX.into());
    i64::try_from(value).unwrap_or_else(|_| unreachable!("{value} was held in the range"))
}

/// Tag, what it catches, and triangles with depths as [`Stimulus::part`] takes them.
type Kind = (&'static str, &'static str, Vec<([[i128; 2]; 3], [i128; 3])>);

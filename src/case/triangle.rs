//! Triangles on the sub-pixel grid: directed classes and random ones. Spec clause `X-3`.

mod directed;

use super::{Class, Directed, Words};
use crate::profile::Profile;
use crate::setup::Triangle;

/// The class of random triangles.
pub const RANDOM: Class =
    Class { tag: "random", catches: "what nobody thought of: triangles of every size and shape" };

/// The class of triangles searched for cells that the directed classes left open; no seed decides it.
pub const CLOSING: Class = Class {
    tag: "closing",
    catches: "combinations that no directed class meets: ties by octant and zone",
};

/// The class of the scene's own triangles.
pub const SCENE: Class = Class { tag: "scene", catches: "what a real scene meets" };

/// Stimulus for one profile: its grid, window and depth range.
#[derive(Clone, Copy, Debug)]
pub struct Stimulus {
    range: (i128, i128),
    pixel: i128,
    /// Bits that a slope's numerator is scaled by before it is divided.
    scale: u32,
    /// Bits that the start's numerator is scaled by.
    fraction: u32,
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
            fraction: profile.depth.map_or(0, |depth| depth.interpolation),
            centre: grid,
            window: [i128::from(profile.window.width), i128::from(profile.window.height)],
            depth: profile.depth.map(|_| i128::from(profile.depth_max())),
        }
    }

    /// The directed classes; what does not fit the vertex field is left out.
    pub fn directed(&self) -> Vec<Directed<Triangle>> {
        [
            self.all_bits(),
            self.zero_area(),
            self.shared_edges(),
            self.on_samples(),
            self.slivers(),
            self.widest_slopes(),
            self.ends(),
            self.remainders(),
            self.guard_boundary(),
            self.beyond_window(),
        ]
        .into_iter()
        .map(|(tag, catches, list)| {
            let triangles = list.into_iter().filter_map(|(xy, z)| self.fit(xy, z)).collect();
            Directed { class: Class { tag, catches }, tests: triangles }
        })
        .filter(|class| !class.tests.is_empty())
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

    /// A triangle that may close what the directed classes left open: small, or with an area that makes
    /// ties, anywhere in the window and of any depths.
    pub fn closing(&self, mut words: Words) -> Triangle {
        let bounded = |words: &mut Words, high: i128| words.between(0, within_i64(high));
        let (low, high) = self.range;
        let corner: [i128; 2] =
            std::array::from_fn(|axis| bounded(&mut words, self.window[axis] * self.pixel));
        let xy = match bounded(&mut words, 2) {
            0 => std::array::from_fn(|_| corner.map(|at| at + bounded(&mut words, 8))),
            kind => {
                let ties = if kind == 1 { self.scale } else { self.fraction } + 1;
                let (p, q) = (1i128 << ties.div_ceil(2), 1i128 << (ties / 2));
                let [dx, dy] = [(); 2].map(|()| 1 - 2 * bounded(&mut words, 1));
                let turned = bounded(&mut words, 1) == 1;
                let [x, y] = corner;
                let at = |u: i128, v: i128| {
                    let [u, v] = if turned { [v, u] } else { [u, v] };
                    [x + dx * u, y + dy * v]
                };
                [[x, y], at(p, 1), at(p, 1 + q)]
            }
        };
        let z = self.depth.map(|maximum| {
            std::array::from_fn(|_| {
                let bits = i128::from(i128::BITS - maximum.leading_zeros());
                let size = maximum >> bounded(&mut words, bits - 1);
                let part = bounded(&mut words, size);
                if bounded(&mut words, 1) == 0 { part } else { maximum - part }
            })
        });
        Triangle { xy: xy.map(|v: [i128; 2]| v.map(|c| c.clamp(low, high))), z }
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

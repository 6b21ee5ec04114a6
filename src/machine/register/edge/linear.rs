//! Channels at work: planes that are given, planes of vertex values, weights. Spec clauses `RE-7` to `RE-9`.

use super::cover::fold;
use super::part::{Origin, Winding};
use super::reciprocal::Divider;
use super::setup::{Corners, EdgeFunctions};
use super::value::{Division, PlaneStart, ValueSource};
use super::weight::Weights;
use crate::format::Gather;
use crate::value::{Channel, Extension};

/// Bits of a product, where a profile says nothing.
pub(super) const PRODUCT: u32 = 128;
/// Bits of start and slopes before they are cut, where a profile says nothing.
const SETUP: u32 = 64;

/// The channels of a triangle.
#[derive(Debug)]
pub(super) enum Values {
    /// Start and slopes of each, from a pixel on.
    Planes { origin: [i64; 2], planes: Vec<[i64; 3]> },
    /// The same from vertex 0, before they are cut.
    AtVertex { from: Distance, planes: Vec<Setup> },
    /// Values at the vertices, and the weights of a pixel.
    Weighted { weights: Weights, values: Vec<[i128; 3]> },
}

/// Start and slopes before they are cut to a channel's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Setup {
    start: i128,
    slopes: [i64; 2],
    width: u32,
    /// Places that they are cut by.
    cut: u32,
}

/// From vertex 0 to the sample of pixel (0, 0), in sub-pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Distance {
    away: [i128; 2],
    sub_pixel: u32,
}

impl Setup {
    /// The plane at a pixel. Clause `RE-8`.
    fn at(&self, from: &Distance, pixel: [i64; 2]) -> i64 {
        let term = |axis: usize| {
            let away = (i128::from(pixel[axis]) << from.sub_pixel) + from.away[axis];
            (i128::from(self.slopes[axis]) * away) >> from.sub_pixel
        };
        fold(self.start.wrapping_add(term(0) + term(1)), self.width) >> self.cut
    }
}

/// A register of a value, as the profile extends it.
fn extended(channel: &Channel, gather: &Gather, words: &[u32]) -> i128 {
    match channel.start {
        Extension::Sign => gather.signed(words).into(),
        Extension::Zero => gather.unsigned(words).into(),
    }
}

impl Values {
    pub(super) fn new(
        engine: &EdgeFunctions,
        words: &[u32],
        first: [i64; 2],
        corners: Option<&Corners>,
    ) -> Self {
        let wired = || engine.channels.iter().zip(&engine.wires.values);
        let at_vertices = |corners: &Corners, (channel, wires): (&Channel, &[Gather; 3])| {
            corners.from.map(|n| extended(channel, &wires[n], words))
        };
        match (engine.config.values, corners) {
            (Some(ValueSource::Planes { start, .. }), Some(corners)) => {
                let setups = wired()
                    .map(|wired| engine.setup(corners, wired.0, at_vertices(corners, wired)));
                let grid = &engine.target.grid;
                let away = [0, 1].map(|axis| grid.offset[axis] - i128::from(corners.xy[0][axis]));
                let from = Distance { away, sub_pixel: grid.sub_pixel };
                if start == PlaneStart::Vertex {
                    return Self::AtVertex { from, planes: setups.collect() };
                }
                let plane = |(setup, channel): (Setup, &Channel)| {
                    let slopes = setup.slopes.map(|slope| channel.slope(slope >> setup.cut));
                    [channel.wrap(setup.at(&from, first)), slopes[0], slopes[1]]
                };
                let planes = setups.zip(&engine.channels).map(plane).collect();
                Self::Planes { origin: first, planes }
            }
            (Some(ValueSource::Weights { .. }), Some(corners)) => {
                let values = wired()
                    .map(|wired| at_vertices(corners, wired).map(|value| value << wired.0.shift));
                Self::Weighted { weights: engine.weights(corners), values: values.collect() }
            }
            (given, _) => {
                let at = match given {
                    Some(ValueSource::Given { at }) => at,
                    _ => Origin::Box,
                };
                let planes = wired().map(|(channel, wires)| {
                    let start = extended(channel, &wires[0], words) << channel.shift;
                    let along = fold(i128::from(wires[1].signed(words)) << channel.shift_along, 64);
                    let down = fold(i128::from(wires[2].signed(words)) << channel.shift, 64);
                    let slopes = [channel.along(along), down].map(|slope| channel.slope(slope));
                    [fold(start, channel.width), slopes[0], slopes[1]]
                });
                let origin = if at == Origin::Box { first } else { [0; 2] };
                Self::Planes { origin, planes: planes.collect() }
            }
        }
    }

    /// What is read of each channel at a pixel with these edge words.
    pub(super) fn read(
        &self,
        channels: &[Channel],
        pixel: [i64; 2],
        words: [i64; 3],
        out: &mut [i64],
    ) {
        let out = out.iter_mut().zip(channels);
        match self {
            Self::Planes { origin, planes } => {
                let [x, y] = [pixel[0] - origin[0], pixel[1] - origin[1]];
                for ((value, channel), [start, dx, dy]) in out.zip(planes) {
                    *value = channel.value(channel.walk(channel.walk(*start, *dx, x), *dy, y));
                }
            }
            Self::AtVertex { from, planes } => {
                for ((value, channel), plane) in out.zip(planes) {
                    *value = channel.value(channel.wrap(plane.at(from, pixel)));
                }
            }
            Self::Weighted { weights, values } => {
                let shares = weights.at(words);
                for ((value, channel), of) in out.zip(values) {
                    *value = channel.value(fold(weights.sum(shares, *of), channel.width));
                }
            }
        }
    }
}

impl EdgeFunctions {
    /// The division by a triangle's area. Clause `RE-8`.
    pub(super) fn divider(&self, division: Division, area: i128) -> Divider {
        // One winding has no sign to look at: its word is read as a number without one.
        let plain = self.has_one_winding();
        let magnitude = if plain {
            (area & ((1 << self.config.width) - 1)).cast_unsigned()
        } else {
            area.unsigned_abs()
        };
        Divider::new(division, area, magnitude, !plain && area < 0)
    }

    /// Whether the sign of an area is of no interest.
    pub(super) fn has_one_winding(&self) -> bool {
        self.config.winding == Winding::One
    }

    /// The plane of a channel's values at the vertices. Clause `RE-8`.
    fn setup(&self, corners: &Corners, channel: &Channel, v: [i128; 3]) -> Setup {
        let Some(ValueSource::Planes { divide, fraction, width, product, half, .. }) =
            self.config.values
        else {
            unreachable!("the channels are planes of vertex values");
        };
        let of_channel = channel.read.fraction();
        let fraction = fraction.unwrap_or(of_channel);
        let cut = fraction - of_channel;
        let (places, width) = (channel.shift + cut, width.unwrap_or(SETUP));
        let divider = self.divider(divide, corners.area.into());
        let xy = corners.xy.map(|at| at.map(i128::from));
        // The change of the edge words of v2 v0 and v0 v1, which weigh vertices 1 and 2.
        let change = |axis: usize, k: usize| {
            let (p, q) = (xy[(k + 1) % 3], xy[(k + 2) % 3]);
            let change = if axis == 0 { p[1] - q[1] } else { q[0] - p[0] };
            i128::from(corners.sign) * change
        };
        let left = i64::from(places + self.target.grid.sub_pixel) - i64::from(corners.cut);
        let slopes = [0, 1].map(|axis| {
            let number = (v[1] - v[0]) * change(axis, 1) + (v[2] - v[0]) * change(axis, 2);
            fold(divider.divide(number, left, product.unwrap_or(PRODUCT)), width)
        });
        let half = if half { 1 << fraction >> 1 } else { 0 };
        Setup { start: (v[0] << places).wrapping_add(half), slopes, width, cut }
    }
}

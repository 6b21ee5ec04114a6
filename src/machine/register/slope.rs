//! Edges walked by their slopes, one row at a time, and channels along the rows. Spec clauses `RG-11` to
//! `RG-14`.

mod edge;
mod form;
mod host;
mod row;

pub use edge::{RowCounts, RowOrder};

use super::input::{ChannelInput, Inputs, RegisterError};
use super::is_default;
use super::{Built, Engine};
use crate::format::Gather;
use crate::machine::Target;
use crate::setup::{Triangle, VertexConfig};
use crate::value::{Channel, Extension, w_float};
use edge::{EdgeInput, Walk};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where slopes of edges come from. x is kept in words of 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum SlopeEdges {
    /// Divided from vertices, toward zero; x is evaluated anew at the centre of each row.
    Divided {
        /// Fraction bits of x.
        fraction: u32,
        /// Added to y, in sub-pixels, before it is floored to a row.
        row_bias: u32,
    },
    /// Registers hold starts and slopes, and how many rows there are; x is added up.
    Given {
        /// Fraction bits of x.
        fraction: u32,
        /// Which row comes next.
        rows: RowOrder,
        /// What the two counts of rows count.
        #[serde(default, skip_serializing_if = "is_default")]
        counts: RowCounts,
    },
}

/// Where channels start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum Plane {
    /// At the pixel of the first vertex: a row begins `dx` for each column and `dy` for each row from it.
    AtVertex {},
    /// On the long edge, `dy` a row; a row begins with the part of `dx` up to its first pixel.
    AtEdge {
        /// Bits of that part.
        fraction: u32,
    },
    /// At a point of the window: a pixel has the exact distance from it on both axes.
    AtPoint {},
}

/// What the clip rectangle's ends are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum ClipEnds {
    /// The right and lower end are outside.
    HalfOpen,
    /// All ends are inside.
    Closed,
}

/// Depth from one of two channels: the component of spec clause `RG-14`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct DepthChoice {
    /// The channel that is read as an integer.
    pub integer: String,
    /// The channel that is read as a float of 1/w.
    pub w_float: String,
}

/// The engine of `[form.registers.engine.slopes]`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct SlopeConfig {
    /// Where slopes come from.
    pub edges: SlopeEdges,
    /// Added to x before it is floored to a pixel, in units of its fraction.
    pub pixel_bias: u32,
    /// Where channels start.
    pub plane: Plane,
    /// What the clip rectangle's ends are; there is none when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clip: Option<ClipEnds>,
    /// Bits of the numbers of pixels and rows, and of the count of pixels in a row; they wrap. As many as x
    /// has when absent, and a row whose ends have changed places is empty.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pixel_bits: Option<u32>,
    /// Depth from one of two channels; none when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<DepthChoice>,
}

pub(super) const NAME: &str = "slopes";
const CLIP: [&str; 4] = ["clip_left", "clip_right", "clip_top", "clip_bottom"];

#[derive(Clone, Debug)]
pub(super) struct Slopes {
    pub(super) config: SlopeConfig,
    edges: EdgeInput,
    pub(super) clip: Option<[Gather; 4]>,
    /// The point that channels start at; its y is that of the first row where there is no register.
    pub(super) point: Option<(Gather, Option<Gather>)>,
    pub(super) clips: Option<Gather>,
    flip: Option<(Gather, Gather)>,
    pub(super) adjust: Option<Gather>,
    pub(super) channels: Vec<(Channel, ChannelInput)>,
    depth: Option<Depth>,
    pub(super) target: Target,
    pub(super) sub_pixel: u32,
}

/// The channels that depth comes from, which of them, and what is added.
#[derive(Clone, Debug)]
struct Depth {
    integer: usize,
    w_float: usize,
    by_w: Gather,
    biased: Gather,
    bias: Gather,
}

impl SlopeConfig {
    pub(super) fn engine(
        &self,
        inputs: &Inputs<'_>,
        channels: &[Channel],
        vertex: &VertexConfig,
        target: Target,
    ) -> Result<Built, RegisterError> {
        let edges = EdgeInput::new(self, inputs, vertex)?;
        let channels = channels
            .iter()
            .map(|channel| {
                let [start, along, down] =
                    ["", "_dx", "_dy"].map(|end| format!("{}{end}", channel.name));
                let [start, along, down] = inputs.all(NAME, [start.as_str(), &along, &down])?;
                Ok((channel.clone(), ChannelInput { start, along, down }))
            })
            .collect::<Result<Vec<_>, RegisterError>>()?;
        let depth = self.depth.as_ref().map(|choice| {
            let place = |name: &String| {
                let found = channels.iter().position(|(channel, _)| channel.name == *name);
                let reason = format!("depth takes channel {name:?}, and there is none");
                found.ok_or(RegisterError::Together { engine: NAME, reason })
            };
            let [by_w, biased, bias] =
                inputs.all(NAME, ["w_buffer", "depth_biased", "depth_bias"])?;
            let (integer, w_float) = (place(&choice.integer)?, place(&choice.w_float)?);
            let bits = channels[integer].0.read.integer();
            if bits > 32 {
                let name = &choice.integer;
                let reason =
                    format!("depth takes channel {name:?}: integer = {bits} <= 32 is needed");
                return Err(RegisterError::Together { engine: NAME, reason });
            }
            Ok::<_, RegisterError>(Depth { integer, w_float, by_w, biased, bias })
        });
        let depth = depth.transpose()?;
        let point = match self.plane {
            Plane::AtPoint {} => Some((inputs.need(NAME, "anchor_x")?, inputs.may("anchor_y"))),
            _ => None,
        };
        let flip = match inputs.may("flip") {
            None => None,
            Some(flip) => Some((flip, inputs.need(NAME, "height")?)),
        };
        let mut names = vec!["x".to_owned(), "y".to_owned()];
        names.extend(channels.iter().map(|(channel, _)| channel.name.clone()));
        if depth.is_some() {
            names.extend(["w_float", "depth"].map(str::to_owned));
        }
        let engine = Slopes {
            config: self.clone(),
            edges,
            clip: self.clip.map(|_| inputs.all(NAME, CLIP)).transpose()?,
            clips: self.clip.and_then(|_| inputs.may("clip")),
            point,
            flip,
            adjust: inputs.may("adjust"),
            channels,
            depth,
            target,
            sub_pixel: vertex.sub_pixel,
        };
        if let Some(bits) = self.pixel_bits
            && !(2..=32).contains(&bits)
        {
            let reason = format!("pixel-bits = {bits}: 2 to 32 bits are needed");
            return Err(RegisterError::Together { engine: NAME, reason });
        }
        if engine.adjust.is_some() && self.plane != (Plane::AtVertex {}) {
            return Err(RegisterError::Together {
                engine: NAME,
                reason: "`adjust` moves starts from a vertex to its pixel: the plane has to be at-vertex"
                    .to_owned(),
            });
        }
        Ok((Box::new(engine), vec![names]))
    }
}

impl Slopes {
    /// Starts and slopes of the channels, in accumulators.
    fn channels(&self, words: &[u32]) -> Vec<[i64; 3]> {
        // A distance from a point has the fraction bits of x, so a start moves up by as many.
        let up = if self.point.is_some() { self.edges.fraction } else { 0 };
        let channel = |(channel, input): &(Channel, ChannelInput)| {
            let start = match channel.start {
                Extension::Sign => input.start.signed(words),
                Extension::Zero => input.start.unsigned(words).cast_signed(),
            };
            let along = channel.along(input.along.signed(words) << channel.shift_along);
            let down = input.down.signed(words) << channel.shift;
            [start << (channel.shift + up), along, down].map(|value| channel.wrap(value))
        };
        self.channels.iter().map(channel).collect()
    }

    /// Moves starts from the first vertex to the centre of its pixel, where that is asked for.
    fn adjust(&self, words: &[u32], walk: &Walk, starts: &mut [[i64; 3]]) {
        if self.adjust.as_ref().is_none_or(|adjust| adjust.unsigned(words) == 0) {
            return;
        }
        let one = 1i64 << self.sub_pixel;
        let part = walk.vertex.map(|at| {
            let fraction = at & (one - 1);
            one / 2 - fraction + if fraction > one / 2 { one } else { 0 }
        });
        for (start, (channel, _)) in starts.iter_mut().zip(&self.channels) {
            let moved = part[0].wrapping_mul(start[1]).wrapping_add(part[1].wrapping_mul(start[2]));
            start[0] = channel.wrap(start[0].wrapping_add(channel.wrap(moved) >> self.sub_pixel));
        }
    }

    fn depth(
        &self,
        depth: &Depth,
        words: &[u32],
        accumulators: &[i64],
        values: &[i64],
    ) -> [i64; 2] {
        let float = i64::from(w_float(accumulators[depth.w_float]));
        let by_w = depth.by_w.unsigned(words) != 0;
        let chosen = if by_w { float } else { values[2 + depth.integer] };
        let bias = if depth.biased.unsigned(words) != 0 { depth.bias.signed(words) } else { 0 };
        let top = self.channels[depth.integer].0.read.maximum().cast_signed();
        [float, (chosen + bias).clamp(0, top)]
    }
}

impl Engine for Slopes {
    fn run(&self, words: &[u32], emit: &mut dyn FnMut(usize, &[i64])) {
        let walk = self.edges.walk(words, self.sub_pixel);
        let (window, mut starts) = (self.window(words), self.channels(words));
        self.adjust(words, &walk, &mut starts);
        let flipped = self.flip.as_ref().filter(|(flip, _)| flip.unsigned(words) != 0);
        let height = flipped.map(|(_, height)| height.unsigned(words).cast_signed());
        let first = walk.pixel(walk.first_x, self.config.pixel_bias);
        let mut accumulators = vec![0; self.channels.len()];
        let mut values =
            vec![0; 2 + self.channels.len() + if self.depth.is_some() { 2 } else { 0 }];
        let mut point = None;
        walk.rows(|row, y, start, end| {
            let y = self.number(y);
            let point = *point.get_or_insert_with(|| self.point(words, y));
            if y < window.y[0] || y >= window.y[1] {
                return;
            }
            let Some(span) = self.span(&walk, [start, end], &window) else { return };
            // Channels at the first pixel of the span, clipped or not.
            let (part, bits) = match self.config.plane {
                Plane::AtVertex {} => (span.unclipped - first, 0),
                Plane::AtEdge { fraction } => (walk.part(start, fraction), fraction),
                Plane::AtPoint {} => (0, 0),
            };
            // Steps in the direction of the walk add slopes that point along it.
            let along = match self.config.plane {
                Plane::AtEdge { .. } => 1,
                _ => span.step,
            };
            let skipped = (span.first - span.unclipped) * span.step;
            for ((held, start), (channel, _)) in
                accumulators.iter_mut().zip(&starts).zip(&self.channels)
            {
                let moved = channel.wrap(start[1].wrapping_mul(part)) >> bits;
                let at = channel.walk(start[0], start[2], row).wrapping_add(moved);
                *held = channel.walk(at, start[1].wrapping_mul(along), skipped);
            }
            let mut x = span.first;
            for _ in 0..span.count {
                values[0] = x;
                values[1] = height.map_or(y, |height| height - 1 - y);
                for (n, (channel, _)) in self.channels.iter().enumerate() {
                    if let Some(point) = point {
                        accumulators[n] = self.at_point(channel, starts[n], (point, [x, y]));
                    }
                    values[2 + n] = channel.value(accumulators[n]);
                }
                if let Some(depth) = &self.depth {
                    let last = values.len() - 2;
                    let made = self.depth(depth, words, &accumulators, &values);
                    values[last..].copy_from_slice(&made);
                }
                if (window.x[0]..window.x[1]).contains(&x) {
                    emit(0, &values);
                }
                for ((held, start), (channel, _)) in
                    accumulators.iter_mut().zip(&starts).zip(&self.channels)
                {
                    *held = channel.wrap(held.wrapping_add(start[1].wrapping_mul(along)));
                }
                x = self.number(x + span.step);
            }
        });
    }

    fn work(&self, words: &[u32], most: u64) -> u128 {
        self.steps(words, most)
    }

    fn host(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        self.host_words(triangle, count)
    }
}

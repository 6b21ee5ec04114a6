//! Edges walked by their slopes, one row at a time, and channels along the rows. Spec clauses `RG-11` to
//! `RG-14`.

mod edge;
mod form;
mod host;

use super::input::{ChannelInput, Inputs, RegisterError};
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
    },
}

/// Which row comes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum RowOrder {
    /// The one below.
    Down,
    /// The one above.
    Up,
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
    /// What the clip rectangle's ends are.
    pub clip: ClipEnds,
    /// Depth from one of two channels; none when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<DepthChoice>,
}

pub(super) const NAME: &str = "slopes";

#[derive(Clone, Debug)]
pub(super) struct Slopes {
    pub(super) config: SlopeConfig,
    edges: EdgeInput,
    pub(super) clip: [Gather; 4],
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

/// The pixels that may be drawn to: `[low, high)` on each axis.
struct Window {
    x: [i64; 2],
    y: [i64; 2],
}

impl SlopeConfig {
    pub(super) fn engine(
        &self,
        inputs: &Inputs<'_>,
        channels: Vec<Channel>,
        vertex: &VertexConfig,
        target: Target,
    ) -> Result<Built, RegisterError> {
        let edges = EdgeInput::new(self, inputs, vertex)?;
        let channels = channels
            .into_iter()
            .map(|channel| {
                let [start, along, down] =
                    ["", "_dx", "_dy"].map(|end| format!("{}{end}", channel.name));
                let [start, along, down] = inputs.all(NAME, [start.as_str(), &along, &down])?;
                Ok((channel, ChannelInput { start, along, down }))
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
            clip: inputs.all(NAME, ["clip_left", "clip_right", "clip_top", "clip_bottom"])?,
            clips: inputs.may("clip"),
            flip,
            adjust: inputs.may("adjust"),
            channels,
            depth,
            target,
            sub_pixel: vertex.sub_pixel,
        };
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
    fn window(&self, words: &[u32]) -> Window {
        let on = self.clips.as_ref().is_none_or(|clips| clips.unsigned(words) != 0);
        if !on {
            return Window { x: [i64::MIN, i64::MAX], y: [i64::MIN, i64::MAX] };
        }
        let [left, right, top, bottom] =
            self.clip.each_ref().map(|gather| gather.unsigned(words).cast_signed());
        let past = i64::from(self.config.clip == ClipEnds::Closed);
        Window { x: [left, right + past], y: [top, bottom + past] }
    }

    /// Starts and slopes of the channels, in accumulators.
    fn channels(&self, words: &[u32]) -> Vec<[i64; 3]> {
        let channel = |(channel, input): &(Channel, ChannelInput)| {
            let start = match channel.start {
                Extension::Sign => input.start.signed(words),
                Extension::Zero => input.start.unsigned(words).cast_signed(),
            };
            let along = channel.along(input.along.signed(words) << channel.shift_along);
            let down = input.down.signed(words) << channel.shift;
            [start << channel.shift, along, down].map(|value| channel.wrap(value))
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
        walk.rows(|row, y, start, end| {
            if y < window.y[0] || y >= window.y[1] {
                return;
            }
            // Both ends are rounded alike and the right one is outside, whichever way a row runs.
            let step: i64 = if walk.leftward { -1 } else { 1 };
            let back = i64::from(walk.leftward);
            let mut x = walk.pixel(start, self.config.pixel_bias) - back;
            let mut end = walk.pixel(end, self.config.pixel_bias) - back;
            // Channels at the first pixel of the span, clipped or not.
            let (part, bits) = match self.config.plane {
                Plane::AtVertex {} => (x - first, 0),
                Plane::AtEdge { fraction } => (walk.part(start, fraction), fraction),
            };
            if walk.leftward {
                end = end.max(window.x[0].saturating_sub(1));
            } else {
                end = end.min(window.x[1]);
            }
            let unclipped = x;
            x = if walk.leftward { x.min(window.x[1] - 1) } else { x.max(window.x[0]) };
            if (end - x) * step <= 0 {
                return;
            }
            // Steps in the direction of the walk add slopes that point along it.
            let along = match self.config.plane {
                Plane::AtVertex {} => step,
                Plane::AtEdge { .. } => 1,
            };
            let skipped = (x - unclipped) * step;
            for ((held, start), (channel, _)) in
                accumulators.iter_mut().zip(&starts).zip(&self.channels)
            {
                let moved = channel.wrap(start[1].wrapping_mul(part)) >> bits;
                let at = channel.walk(start[0], start[2], row).wrapping_add(moved);
                *held = channel.walk(at, start[1].wrapping_mul(along), skipped);
            }
            while x != end {
                values[0] = x;
                values[1] = height.map_or(y, |height| height - 1 - y);
                for ((value, held), (channel, _)) in
                    values[2..].iter_mut().zip(&accumulators).zip(&self.channels)
                {
                    *value = channel.value(*held);
                }
                if let Some(depth) = &self.depth {
                    let last = values.len() - 2;
                    let made = self.depth(depth, words, &accumulators, &values);
                    values[last..].copy_from_slice(&made);
                }
                emit(0, &values);
                for ((held, start), (channel, _)) in
                    accumulators.iter_mut().zip(&starts).zip(&self.channels)
                {
                    *held = channel.wrap(held.wrapping_add(start[1].wrapping_mul(along)));
                }
                x += step;
            }
        });
    }

    fn host(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        self.host_words(triangle, count)
    }
}

//! Edges walked by their slopes, four sub-scanlines a row. Spec clauses `RG-15` to `RG-19`.

mod form;
mod span;

use super::host::{attributes, gradient};
use super::input::{Inputs, RegisterError};
use super::{Built, Engine};
use crate::bits::{Rounding, bounded};
use crate::format::Gather;
use crate::machine::Target;
use crate::setup::{Triangle, VertexConfig};
use crate::value::{Channel, slope_code};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use span::{Line, Span};

/// What a product of a slope and a distance keeps of its bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Product {
    /// The low ones: it wraps.
    Wrap,
    /// Its sign and the low ones but one: a signed `resize` of VHDL.
    Resize,
}

/// The engine of `[form.registers.engine.sub-scanlines]`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct SubScanlineConfig {
    /// What a product of a slope and a distance keeps of its bits.
    pub product: Product,
    /// Whether the distance to the scissor is two's complement; otherwise it is not negative.
    pub signed_distance: bool,
    /// The channel that is depth.
    pub depth: String,
}

/// Which samples of a pixel are covered, and whether its first one is.
const MASK: [&str; 2] = ["coverage_mask", "first_sample"];
const NAME: &str = "sub-scanlines";

/// Bits of the distance to the scissor.
const DISTANCE: u32 = 12;

/// What an edge word means above its 16 fraction bits: 12 bits of pixel, then two guard bits.
const X_BITS: u32 = 28;

#[derive(Clone, Debug)]
pub(super) struct SubScanlines {
    pub(super) config: SubScanlineConfig,
    /// Whether the long edge is the left one.
    rightward: Gather,
    /// Lower end, middle and upper end.
    y: [Gather; 3],
    /// x and slope of the lower, long and upper edge.
    x: [[Gather; 2]; 3],
    /// A sign of the long edge's slope beside the slope's own.
    sign: Option<Gather>,
    scissor: [Gather; 4],
    /// Start, slopes along a row, along the edge and down.
    values: Vec<[Gather; 4]>,
    pub(super) channels: Vec<Channel>,
    pub(super) depth: usize,
    target: Target,
}

/// The attribute words of a primitive, in accumulators.
pub(super) struct Attributes {
    pub(super) start: Vec<i64>,
    /// Along a row, its low bits dropped.
    pub(super) along: Vec<i64>,
    pub(super) edge: Vec<i64>,
    pub(super) down: Vec<i64>,
    /// What a start is moved by, to the middle of a row.
    pub(super) offset: Vec<i64>,
    /// The code of the depth slopes.
    pub(super) slope_code: i64,
}

impl SubScanlineConfig {
    pub(super) fn engine(
        &self,
        inputs: &Inputs<'_>,
        channels: &[Channel],
        vertex: &VertexConfig,
        target: Target,
    ) -> Result<Built, RegisterError> {
        let fault = |reason: String| RegisterError::Together { engine: NAME, reason };
        if vertex.sub_pixel != 2 {
            return Err(fault(format!(
                "vertex sub-pixel = {}: four sub-scanlines a row need 2",
                vertex.sub_pixel
            )));
        }
        if let Some(channel) = channels.iter().find(|channel| channel.width != 32) {
            let Channel { name, width, .. } = channel;
            return Err(fault(format!(
                "channel {name:?}: width = {width}: attributes have 32 bits"
            )));
        }
        let depth = channels.iter().position(|channel| channel.name == self.depth);
        let Some(depth) = depth.filter(|&depth| channels[depth].read.integer() == 18) else {
            return Err(fault(format!(
                "depth = {:?}: no channel of that name has 18 integer bits, which its codec takes",
                self.depth
            )));
        };
        let edge = |x: &str, slope: &str| inputs.all(NAME, [x, slope]);
        let values = channels
            .iter()
            .map(|channel| {
                let [a, b, c, d] =
                    ["", "_dx", "_de", "_dy"].map(|end| format!("{}{end}", channel.name));
                inputs.all(NAME, [a.as_str(), &b, &c, &d])
            })
            .collect::<Result<_, _>>()?;
        let names = |list: &[&str]| list.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        let mut line = names(&["y", "left_end", "right_end", "edge_x"]);
        line.extend(channels.iter().map(|channel| channel.name.clone()));
        for part in ["long", "short", "invalid"] {
            line.extend((0..4).map(|sub| format!("{part}{sub}")));
        }
        let mut pixel = names(&["x", "y", "coverage", "slope_code", "depth_code"]);
        pixel.extend(channels.iter().map(|channel| channel.name.clone()));
        pixel.extend(names(&MASK));
        let engine = SubScanlines {
            config: self.clone(),
            rightward: inputs.need(NAME, "rightward")?,
            y: inputs.all(NAME, ["yl", "ym", "yh"])?,
            x: [edge("xl", "xl_step")?, edge("xh", "xh_step")?, edge("xm", "xm_step")?],
            sign: inputs.may("long_sign"),
            scissor: inputs.all(NAME, ["scissor_xh", "scissor_yh", "scissor_xl", "scissor_yl"])?,
            values,
            channels: channels.to_vec(),
            depth,
            target,
        };
        Ok((Box::new(engine), vec![line, pixel]))
    }
}

/// The sub-scanlines of whole rows.
const fn sub_scanlines(high: i64, low: i64) -> std::ops::RangeInclusive<i64> {
    (high & !3)..=(low | 3)
}

/// A product as the datapath keeps it.
pub(super) fn product(kind: Product, a: i64, b: i64) -> i64 {
    let exact = i128::from(a) * i128::from(b);
    #[allow(clippy::cast_possible_truncation, reason = "the low bits are what is kept")]
    let low = exact as i64;
    match kind {
        Product::Wrap => low,
        Product::Resize => {
            let kept = low & 0x7fff_ffff;
            if exact < 0 { kept - (1 << 31) } else { kept }
        }
    }
}

impl SubScanlines {
    fn attributes(&self, words: &[u32], offset: bool) -> Attributes {
        let column = |n: usize| -> Vec<i64> {
            self.values.iter().map(|gathers| gathers[n].signed(words)).collect()
        };
        let [start, whole, edge, down] = [0, 1, 2, 3].map(column);
        let along =
            self.channels.iter().zip(&whole).map(|(channel, dx)| channel.along(*dx)).collect();
        let part = |slope: i64| {
            let high = slope & !0x1ff;
            high - (high >> 2)
        };
        let offsets = edge
            .iter()
            .zip(&down)
            .map(|(edge, down)| if offset { part(*edge) - part(*down) } else { 0 });
        let (offset, slope_code) =
            (offsets.collect(), i64::from(slope_code(whole[self.depth], down[self.depth])));
        Attributes { start, along, edge, down, offset, slope_code }
    }

    /// Distance in pixels as the datapath sees it.
    pub(super) const fn distance(&self, pixels: i64) -> i64 {
        let bits = pixels & ((1 << DISTANCE) - 1);
        if self.config.signed_distance && bits >> (DISTANCE - 1) == 1 {
            bits - (1 << DISTANCE)
        } else {
            bits
        }
    }
}

/// An x of an edge in eighths of a pixel, its lowest bit sticky, held in the scissor; whether it lies
/// beyond the right end, and before the left one.
fn clipped(x: i64, [low, high]: [i64; 2]) -> (i64, bool, bool) {
    let sticky = i64::from(x >> 1 & 0x1fff != 0);
    let eighths = |mask: i64| x >> 13 & mask | sticky;
    let (negative, over) = (x >> 27 & 1 == 1, x >> 26 & 1 == 1);
    let under = negative || (eighths(0x1ffe) < low && !over);
    let held = if under { low } else { eighths(0x3ffe) };
    let over = held & 0x2000 != 0 || held & 0x1fff >= high;
    (if over { high } else { held } & 0x1fff, over, under)
}

impl Engine for SubScanlines {
    fn run(&self, words: &[u32], emit: &mut dyn FnMut(usize, &[i64])) {
        let rightward = self.rightward.unsigned(words) != 0;
        let [y_low, y_middle, y_high] = self.y.each_ref().map(|gather| gather.signed(words));
        let x = self.x.each_ref().map(|edge| edge.each_ref().map(|gather| gather.signed(words)));
        let sign = self.sign.as_ref().map_or(x[1][1] < 0, |sign| sign.unsigned(words) != 0);
        let offset = sign == rightward;
        let mut held = self.attributes(words, offset);
        let [left, top, right, bottom] =
            self.scissor.each_ref().map(|gather| gather.unsigned(words).cast_signed());
        let bounds = [left << 1, right << 1];
        let rows = [y_high.max(top), y_low.min(bottom)];
        let step = |slope: i64| slope >> 2 & !1;
        let (mut long, mut short) = ((x[1][0] & !1, step(x[1][1])), (x[2][0] & !1, step(x[2][1])));
        let ordered = |x: i64| (x ^ 1 << (X_BITS - 1)) & 0x3fff << 14;
        let mut line = Line::default();
        let mut span = Span::default();
        for sub in sub_scanlines(y_high, rows[1]) {
            if sub == y_middle {
                short = (x[0][0] & !1, step(x[0][1]));
            }
            let n: usize = bounded(sub & 3);
            if (0..0x1000).contains(&sub) {
                if n == 0 {
                    span = Span::default();
                }
                let wrap = |x: i64| x & ((1 << X_BITS) - 1);
                let ends = [wrap(long.0), wrap(short.0)].map(|x| clipped(x, bounds));
                let crossed = if rightward {
                    ordered(wrap(short.0)) < ordered(wrap(long.0))
                } else {
                    ordered(wrap(long.0)) < ordered(wrap(short.0))
                };
                let invalid = sub < rows[0] || sub >= rows[1] || crossed;
                span.sub_line(n, ends, invalid, rightward);
                if n == if offset { 3 } else { 0 } {
                    line.start(self, &held, long.0);
                }
                if n == 3 && span.is_drawn() {
                    line.y = sub >> 2;
                    line.draw(self, &span, &held, rightward, emit);
                }
            }
            if n == 3 {
                for ((value, edge), channel) in
                    held.start.iter_mut().zip(&held.edge).zip(&self.channels)
                {
                    *value = channel.wrap(value.wrapping_add(*edge));
                }
            }
            long.0 = long.0.wrapping_add(long.1);
            short.0 = short.0.wrapping_add(short.1);
        }
    }

    /// Sub-scanlines; a row is no wider than a clamped x.
    fn work(&self, words: &[u32], _: u64) -> u128 {
        let [y_low, _, y_high] = self.y.each_ref().map(|gather| gather.signed(words));
        let bottom = self.scissor[3].unsigned(words).cast_signed();
        let (first, last) = sub_scanlines(y_high, y_low.min(bottom)).into_inner();
        u128::try_from(i128::from(last) - i128::from(first) + 1).unwrap_or(0)
    }

    fn host(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        let mut v = triangle.xy;
        v.sort_by_key(|at| at[1]);
        let [a, b, c] = v;
        let cross = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if cross == 0 {
            return Vec::new();
        }
        let mut words = vec![0; count];
        let mut put = |gather: &Gather, value: i128| {
            gather.scatter(value, &mut words);
        };
        let nearest = |numerator: i128, denominator: i128| {
            Rounding::NearestEven.divide(numerator, denominator).map_or(0, |(value, _)| value)
        };
        put(&self.rightward, i128::from(cross > 0));
        self.y.iter().zip([c, b, a]).for_each(|(gather, at)| put(gather, at[1]));
        // Edges begin at the upper sub-scanline of the first row, but for the lower one.
        let first = a[1] & !3;
        for (gathers, (p, q, y)) in self.x.iter().zip([(b, c, b[1]), (a, c, first), (a, b, first)])
        {
            let height = (q[1] - p[1]).max(1);
            put(&gathers[0], nearest((p[0] * height + (q[0] - p[0]) * (y - p[1])) << 14, height));
            put(&gathers[1], nearest((q[0] - p[0]) << 16, height));
        }
        if let Some(sign) = &self.sign {
            put(sign, i128::from(c[0] < a[0]));
        }
        for (n, (gathers, channel)) in self.values.iter().zip(&self.channels).enumerate() {
            let values = attributes(channel, n);
            let Some(([dx, dy], area)) = gradient(triangle, values) else { continue };
            let height = c[1] - a[1];
            let (p, along_edge) = (triangle.xy[0], dx * (c[0] - a[0]) + dy * height);
            let start = values[0] * area * height
                + (dx * (a[0] - p[0]) + dy * (a[1] - p[1])) * height
                + along_edge * (first - a[1]);
            let register = |n: i128, d: i128| i128::from(channel.register(n, d, 0));
            put(&gathers[0], register(start, area * height));
            put(&gathers[1], register(dx * 4, area));
            put(&gathers[2], register(along_edge * 4, area * height));
            put(&gathers[3], register(dy * 4, area));
        }
        let ends = [0, 1].map(|axis| self.target.clip.clip(axis, (0, 1023)));
        let ends = [ends[0].0, ends[1].0, ends[0].1, ends[1].1];
        for (gather, end) in self.scissor.iter().zip(ends) {
            put(gather, i128::from(end) * 4);
        }
        vec![words]
    }
}

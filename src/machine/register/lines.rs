//! Lines by a stepper of parts, fills between such lines, and quads as fans of them. Spec clauses `RL-1` to
//! `RL-11`.

mod change;
mod fan;
mod fill;
mod form;

pub use fan::FanConfig;
pub use fill::{FillConfig, MiddleRow, SpanEnd};

use super::host::target_ends;
use super::input::{Inputs, RegisterError};
use super::is_default;
use super::slope::ClipEnds;
use super::{Built, Engine};
use crate::bits::bounded;
use crate::cover::{Measures, Stepper, StepperError};
use crate::format::Gather;
use crate::machine::Target;
use crate::setup::{Triangle, VertexConfig};
use crate::value::Channel;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A pixel.
type Pixel = [i128; 2];

/// What is drawn of the vertices.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LineDraws {
    /// A line between two.
    Line,
    /// A triangle of three: spans between lines.
    Fill(FillConfig),
    /// A quadrilateral of four: lines between two of its edges.
    Fan(Box<FanConfig>),
}

/// Which end of a line is its first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum EndOrder {
    /// The first one given.
    #[default]
    AsGiven,
    /// The left one.
    ByX,
    /// The upper one.
    ByY,
}

/// Which coordinate a filler pixel has moved already; the other one has not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Corner {
    /// x has moved, y has not.
    X,
    /// y has moved, x has not.
    Y,
}

/// When a filler pixel is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum FillerPlace {
    /// Before the pixel that both coordinates move to.
    Before,
    /// After it.
    After,
}

/// A pixel more in each step that moves both coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Filler {
    /// Where both coordinates rise, or both fall.
    pub alike: Corner,
    /// Where one rises and the other falls.
    pub unlike: Corner,
    /// When it is drawn.
    pub place: FillerPlace,
}

/// Whether the last pixel of a line is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum LastPixel {
    /// It is.
    #[default]
    Drawn,
    /// It is not: the next line begins there.
    LeftOut,
}

/// The engine of `[form.registers.engine.lines]`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct LinesConfig {
    /// What is drawn of the vertices.
    pub draws: LineDraws,
    /// Which end of a line is its first.
    #[serde(default, skip_serializing_if = "is_default")]
    pub ends: EndOrder,
    /// Whether the last pixel is drawn.
    #[serde(default, skip_serializing_if = "is_default")]
    pub last: LastPixel,
    /// What the ends of the clip rectangle are; there is none when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub clip: Option<ClipEnds>,
    /// A pixel more in each step that moves both coordinates; none when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub filler: Option<Filler>,
    /// How a line goes from pixel to pixel.
    pub stepper: Stepper,
}

const NAME: &str = "lines";
const CLIP: [&str; 4] = ["left", "top", "right", "bottom"];

#[derive(Clone, Debug)]
struct Lines {
    config: LinesConfig,
    signed: bool,
    vertices: Vec<[Gather; 2]>,
    clip: Option<[Gather; 4]>,
    target: Target,
}

/// What is drawn to: the records, the number of the line and the clip rectangle, its right and lower ends
/// excluded.
struct Pen<'a> {
    emit: &'a mut dyn FnMut(usize, &[i64]),
    line: i64,
    clip: Option<[i128; 4]>,
}

impl Pen<'_> {
    fn plot(&mut self, [x, y]: Pixel, filler: bool) {
        let inside = self.clip.is_none_or(|[left, top, right, bottom]| {
            (left..right).contains(&x) && (top..bottom).contains(&y)
        });
        if inside {
            let [x, y] = [x, y].map(bounded::<_, i64>);
            (self.emit)(0, &[x, y, self.line, i64::from(filler)]);
        }
    }
}

impl LinesConfig {
    /// How many vertices the words hold.
    const fn corners(&self) -> usize {
        match self.draws {
            LineDraws::Line => 2,
            LineDraws::Fill(_) => 3,
            LineDraws::Fan(_) => 4,
        }
    }

    fn check(&self) -> Result<(), RegisterError> {
        let fault = |reason: String| RegisterError::Together { engine: NAME, reason };
        let part = |name: &str, error: StepperError| fault(format!("{name}: {error}"));
        self.stepper.check().map_err(|error| part("stepper", error))?;
        match &self.draws {
            LineDraws::Line => Ok(()),
            LineDraws::Fill(fill) => {
                if self.filler.is_some() || self.last == LastPixel::LeftOut {
                    return Err(fault(
                        "a fill has spans between lines: a filler, or a last pixel that is left out, has no \
                         effect"
                            .to_owned(),
                    ));
                }
                fill.check().map_err(fault)
            }
            LineDraws::Fan(fan) => {
                fan.check(|name, error| part(&format!("draws.fan.{name}"), error), fault)
            }
        }
    }

    pub(super) fn engine(
        &self,
        inputs: &Inputs<'_>,
        channels: &[Channel],
        vertex: &VertexConfig,
        target: Target,
    ) -> Result<Built, RegisterError> {
        let fault = |reason: String| RegisterError::Together { engine: NAME, reason };
        self.check()?;
        if vertex.sub_pixel != 0 {
            return Err(fault(format!(
                "vertex sub-pixel = {}: a line is drawn between whole pixels, 0 is needed",
                vertex.sub_pixel
            )));
        }
        if let Some(channel) = channels.first() {
            return Err(fault(format!(
                "channel {:?}: lines have no channels; remove the channels",
                channel.name
            )));
        }
        let vertices = (0..self.corners()).map(|n| {
            let [x, y] = ["x", "y"].map(|axis| format!("{axis}{n}"));
            inputs.all(NAME, [x.as_str(), &y])
        });
        let vertices = vertices.collect::<Result<Vec<_>, _>>()?;
        if let Some(long) = vertices.iter().flatten().find(|gather| gather.bits() > 32) {
            return Err(fault(format!(
                "a coordinate of {} bits: at most 32 are needed",
                long.bits()
            )));
        }
        let clip = self.clip.map(|_| inputs.all(NAME, CLIP)).transpose()?;
        let names = ["x", "y", "line", "filler"].map(str::to_owned).to_vec();
        let (config, signed) = (self.clone(), vertex.signed);
        Ok((Box::new(Lines { config, signed, vertices, clip, target }), vec![names]))
    }
}

impl Lines {
    fn corners(&self, words: &[u32]) -> Vec<Pixel> {
        let read = |gather: &Gather| {
            if self.signed { gather.signed(words).into() } else { gather.unsigned(words).into() }
        };
        self.vertices.iter().map(|vertex| vertex.each_ref().map(read)).collect()
    }

    /// The ends of a line, the first one first.
    fn ordered(&self, [a, b]: [Pixel; 2]) -> [Pixel; 2] {
        let exchanged = match self.config.ends {
            EndOrder::AsGiven => false,
            EndOrder::ByX => a[0] > b[0],
            EndOrder::ByY => a[1] > b[1],
        };
        if exchanged { [b, a] } else { [a, b] }
    }

    /// The pixels that the stepper goes to.
    fn steps(&self, ends: [Pixel; 2], visit: &mut dyn FnMut(Pixel)) {
        self.config.stepper.walk(self.ordered(ends), visit);
    }

    /// A line, with its filler pixels.
    fn line(&self, ends: [Pixel; 2], pen: &mut Pen<'_>) {
        // A pixel is drawn when the next one is known: the last one may be left out.
        let mut before: Option<Pixel> = None;
        let mut filler: Option<Pixel> = None;
        let after = self.config.filler.is_some_and(|filler| filler.place == FillerPlace::After);
        self.steps(ends, &mut |at| {
            if let Some(before) = before {
                pen.plot(before, false);
                if after && let Some(filler) = filler.take() {
                    pen.plot(filler, true);
                }
                filler = self.filler(before, at);
                if !after && let Some(filler) = filler.take() {
                    pen.plot(filler, true);
                }
            }
            before = Some(at);
        });
        if let Some(last) = before.filter(|_| self.config.last == LastPixel::Drawn) {
            pen.plot(last, false);
            if let Some(filler) = filler {
                pen.plot(filler, true);
            }
        }
    }

    /// The filler pixel of a step, if it moves both coordinates.
    fn filler(&self, from: Pixel, to: Pixel) -> Option<Pixel> {
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let filler = self.config.filler.filter(|_| dx != 0 && dy != 0)?;
        Some(match if dx == dy { filler.alike } else { filler.unlike } {
            Corner::X => [to[0], from[1]],
            Corner::Y => [from[0], to[1]],
        })
    }
}

impl Engine for Lines {
    fn run(&self, words: &[u32], emit: &mut dyn FnMut(usize, &[i64])) {
        let past = i128::from(self.config.clip == Some(ClipEnds::Closed));
        let clip = self.clip.as_ref().map(|ends| {
            let [left, top, right, bottom] = ends.each_ref().map(|end| end.unsigned(words).into());
            [left, top, right + past, bottom + past]
        });
        let mut pen = Pen { emit, line: 0, clip };
        match (&self.config.draws, &*self.corners(words)) {
            (LineDraws::Line, &[a, b]) => self.line([a, b], &mut pen),
            (LineDraws::Fill(fill), &[a, b, c]) => self.fill(fill, [a, b, c], &mut pen),
            (LineDraws::Fan(fan), &[a, b, c, d]) => self.fan(fan, [a, b, c, d], &mut pen),
            (_, corners) => unreachable!("{} vertices", corners.len()),
        }
    }

    fn work(&self, words: &[u32], _: u64) -> u128 {
        let length = |a: Pixel, b: Pixel| Measures::of([a, b], 0).length() + 1;
        let corners = self.corners(words);
        let side = |axis: usize| {
            let least = corners.iter().map(|at| at[axis]).min().unwrap_or(0);
            corners.iter().map(|at| at[axis]).max().unwrap_or(0) - least + 1
        };
        let filler = 1 + i128::from(self.config.filler.is_some());
        let steps = match &self.config.draws {
            LineDraws::Line => length(corners[0], corners[1]) * filler,
            // The row of the middle vertex may have two spans.
            LineDraws::Fill(_) => (side(1) + 1) * side(0),
            LineDraws::Fan(fan) => {
                let [[a, d], [b, c]] = fan.edges.map(|edge| edge.map(|n| corners[usize::from(n)]));
                length(a, d).max(length(b, c)) * side(0).max(side(1)) * filler
            }
        };
        steps.unsigned_abs()
    }

    /// A line is given the edges of the triangle, a fan the triangle with its third vertex twice.
    fn host(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        let [a, b, c] = triangle.xy;
        let lists = match &self.config.draws {
            LineDraws::Line => vec![vec![a, b], vec![b, c], vec![c, a]],
            LineDraws::Fill(_) => vec![vec![a, b, c]],
            LineDraws::Fan(fan) => vec![fan.corners([a, b, c])],
        };
        let closed = self.config.clip == Some(ClipEnds::Closed);
        let write = |corners: Vec<Pixel>| {
            let mut words = vec![0; count];
            for (gather, value) in self.vertices.iter().flatten().zip(corners.into_iter().flatten())
            {
                gather.scatter(value, &mut words);
            }
            if let Some(clip) = &self.clip {
                let ends = target_ends(&self.target, closed, clip.each_ref());
                clip.iter().zip(ends).for_each(|(gather, end)| gather.scatter(end, &mut words));
            }
            words
        };
        lists.into_iter().map(write).collect()
    }
}

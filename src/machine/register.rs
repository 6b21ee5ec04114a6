//! Rasterizers that begin at registers: a list of 32-bit words in, records of what was drawn out.
//! Spec clauses `RG-1` to `RG-4`.

mod anchored;
mod device;
mod edge;
mod engine;
mod form;
mod host;
mod input;
mod legal;
mod lines;
mod quad;
mod slope;
mod sub_scanline;
mod text;

pub use anchored::{Anchor, AnchoredConfig, HalfOrder, Largest, VertexSort};
pub use device::{QuadDevice, RegisterDevice, WiredDevice, WiredEngine};
pub use edge::{
    BoxEnds, BoxLimit, Division, EdgeBox, EdgeEngineConfig, EdgeOrder, EdgeRule, EdgeSense,
    EdgeSource, Origin, PlaneStart, TilePlace, ValueSource, Winding, WithoutArea,
};
pub use engine::EngineConfig;
pub use input::RegisterError;
pub use legal::Legal;
pub use lines::{
    Corner, EndOrder, FanConfig, FillConfig, Filler, FillerPlace, LastPixel, LineDraws,
    LinesConfig, MiddleRow, SpanEnd,
};
pub use quad::{Descent, Emit, QuadConfig, QuadEdges, QuadRule};
pub use slope::{ClipEnds, Plane, RowCounts, RowOrder, SlopeConfig, SlopeEdges};
pub use sub_scanline::{Product, SubScanlineConfig};
pub use text::WordsError;

use super::{DrawError, Input, Machine, Ports, Sink, Target};
use crate::bits::bounded;
use crate::format::{Column, Gather, Layout, Packer};
use crate::setup::{Triangle, VertexConfig};
use crate::value::{Channel, ChannelConfig};
use engine::{Built, ClipNames, Engine};
pub(super) use form::KIND;
use input::Inputs;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The machine of `[form.registers]`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct RegisterConfig {
    /// The radix in which words are given, 10 or 16.
    pub radix: u32,
    /// The words it takes: the fields in each, as `NAME:BITS@LOWEST`.
    pub input: Vec<String>,
    /// Which words a driver may write: comparisons of registers and numbers, such as `rows > 0`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub legal: Vec<String>,
    /// What it writes.
    pub records: Vec<RecordConfig>,
    /// Interpolated values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub channels: Vec<ChannelConfig>,
    /// How registers become fragments.
    pub engine: EngineConfig,
}

/// Whether a profile need not say it.
fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// One kind of record.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct RecordConfig {
    /// The letter that its lines begin with.
    pub letter: char,
    /// Its words: the fields in each.
    pub words: Vec<String>,
}

/// A kind of record, ready to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record {
    /// The letter that its lines begin with.
    pub letter: char,
    /// The values that [`Sink::record`] is given, in order.
    pub names: Vec<String>,
    /// Its words.
    pub layout: Layout,
    packer: Packer,
    /// Places of x, y, mask and coverage; none for a record that is no pixel.
    drawn: [Option<usize>; 4],
}

impl Record {
    /// The words of a record of these values.
    pub fn words<'a>(&'a self, values: &'a [i64]) -> impl Iterator<Item = u32> + 'a {
        self.packer.words(values)
    }

    /// The pixels that a record of these values draws: those of a quad's mask, none where no sample is
    /// covered, else the one at x and y.
    pub fn pixels(&self, values: &[i64]) -> impl Iterator<Item = [i64; 2]> + use<> {
        let [x, y, mask, coverage] = self.drawn.map(|place| place.map(|place| values[place]));
        let (x, y, places) = match (x.zip(y), mask) {
            (None, _) => (0, 0, 0),
            (Some((x, y)), Some(mask)) => (2 * x, 2 * y, mask),
            (Some((x, y)), None) => (x, y, i64::from(coverage != Some(0))),
        };
        let bits = (0..4).filter(move |bit| places >> bit & 1 == 1);
        bits.map(move |bit| [x + (bit & 1), y + (bit >> 1)])
    }

    /// The place of a value.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }
}

/// The words that a register machine takes and makes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Registers {
    /// The radix in which words are given, 10 or 16.
    pub radix: u32,
    /// What it takes.
    pub input: Layout,
    /// What it writes.
    pub records: Vec<Record>,
    /// What a driver keeps to.
    pub legal: Vec<Legal>,
    /// What it leaves out, where there is a clip rectangle.
    pub clip: Option<ClipRegisters>,
}

/// The registers of a clip rectangle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClipRegisters {
    /// Left, top, right and bottom.
    pub ends: [Gather; 4],
    /// Whether they are in sub-pixels of the profile's vertices; in pixels otherwise.
    pub sub_pixels: bool,
    /// The register that says whether there is a rectangle; there always is without it.
    pub on: Option<Gather>,
}

/// A machine that begins at registers.
#[derive(Debug)]
pub struct RegisterMachine {
    engine: Box<dyn Engine>,
    target: Target,
    ports: Ports,
}

impl RegisterConfig {
    /// The place of a channel among all.
    fn channel_place(&self, name: &str) -> Option<i128> {
        let mut names = self.channels.iter().flat_map(|channel| &channel.names);
        i128::try_from(names.position(|known| known == name)?).ok()
    }

    /// The machine, if its configuration is valid.
    ///
    /// # Errors
    /// [`RegisterError`] names the part and the reason.
    pub fn machine(
        &self,
        vertex: &VertexConfig,
        target: Target,
    ) -> Result<RegisterMachine, RegisterError> {
        if !matches!(self.radix, 10 | 16) {
            return Err(RegisterError::Radix(self.radix));
        }
        let input = Layout::parse(&self.input).map_err(RegisterError::Input)?;
        let mut channels: Vec<Channel> = Vec::new();
        for group in &self.channels {
            for channel in group.channels()? {
                if channels.iter().any(|known| known.name == channel.name) {
                    return Err(crate::value::ChannelError::Twice(channel.name).into());
                }
                if channel.slope_width != channel.width && !self.engine.form().cuts_slopes() {
                    let reason = format!(
                        "channel {:?}: its slopes are as wide as its accumulator",
                        channel.name
                    );
                    return Err(RegisterError::Together { engine: self.engine.name(), reason });
                }
                channels.push(channel);
            }
        }
        let inputs = Inputs::new(&input);
        let (engine, made): Built = self.engine.engine(&inputs, &channels, vertex, target)?;
        inputs.all_known(self.engine.name())?;
        if made.len() != self.records.len() {
            let (need, got) = (made.len(), self.records.len());
            return Err(RegisterError::Records { engine: self.engine.name(), need, got });
        }
        let records = self.records.iter().zip(made).map(|(config, names)| {
            let RecordConfig { letter, words } = config;
            let letter = *letter;
            let layout =
                Layout::parse(words).map_err(|source| RegisterError::Record { letter, source })?;
            let packer = layout.packer(&names).map_err(|name| RegisterError::Value {
                letter,
                name,
                known: names.join(", "),
            })?;
            let place = |name: &str| names.iter().position(|known| known == name);
            let drawn = ["x", "y", "mask", "coverage"].map(place);
            Ok(Record { letter, names, layout, packer, drawn })
        });
        let records = records.collect::<Result<Vec<_>, RegisterError>>()?;
        let clip = self.engine.form().clip().map(|ClipNames { ends, sub_pixels, on }| {
            let ends = inputs.all(self.engine.name(), ends)?;
            let on = on.and_then(|name| input.find(name));
            Ok::<_, RegisterError>(ClipRegisters { ends, sub_pixels, on })
        });
        let clip = clip.transpose()?;
        let legal = self.legal.iter().map(|text| Legal::parse(text, &input));
        let legal = legal.collect::<Result<Vec<_>, _>>()?;
        let registers = Some(Registers { radix: self.radix, input, records, legal, clip });
        let ports = Ports { registers, ..Ports::valued(vertex, Vec::new(), None) };
        Ok(RegisterMachine { engine, target, ports })
    }
}

impl RegisterMachine {
    /// Words of a list.
    fn count(&self) -> usize {
        self.ports.registers.as_ref().map_or(0, |registers| registers.input.len())
    }

    /// Refuses words that take too many steps.
    fn allow(&self, words: &[u32], out: &dyn Sink) -> Result<(), DrawError> {
        let most = out.most_steps();
        let steps = self.engine.work(words, most);
        if steps > u128::from(most) { Err(DrawError::Work { steps, most }) } else { Ok(()) }
    }

    /// The pixels of a triangle, by way of the registers that a host would write for it.
    fn triangle(&self, triangle: &Triangle, out: &mut dyn Sink) -> Result<(), DrawError> {
        if triangle.area2() == 0 {
            out.zero_area();
        }
        let Some(registers) = &self.ports.registers else { return Ok(()) };
        let mut pixels: Vec<(i64, i64)> = Vec::new();
        let wanted = out.wants_records();
        let clip = &self.target.clip;
        let inside = |value: i64, axis| {
            let (low, high) = clip.clip(axis, (i128::from(value), i128::from(value) + 1));
            low < high
        };
        for words in self.host(triangle) {
            self.allow(&words, out)?;
            self.engine.run(&words, &mut |kind, values| {
                let drawn = registers.records[kind].pixels(values);
                let drawn = drawn.filter(|&[x, y]| inside(x, 0) && inside(y, 1));
                pixels.extend(drawn.map(|[x, y]| (y, x)));
                if wanted {
                    out.record(kind, values);
                }
            });
        }
        pixels.sort_unstable();
        pixels.dedup();
        for run in pixels.chunk_by(|a, b| a.0 == b.0 && a.1 + 1 == b.1) {
            let at = |value: i64| -> u32 { bounded(value) };
            let ((y, x0), length) = (run[0], run.len());
            out.span(at(y), at(x0), at(x0) + bounded::<_, u32>(length), &[]);
        }
        Ok(())
    }
}

impl Machine for RegisterMachine {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn host(&self, triangle: &Triangle) -> Vec<Vec<u32>> {
        self.engine.host(triangle, self.count())
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        match input {
            Input::Words(words) => {
                if words.len() != self.count() {
                    return Err(DrawError::Words { need: self.count(), got: words.len() });
                }
                self.allow(words, out)?;
                self.engine.run(words, &mut |kind, values| out.record(kind, values));
                Ok(())
            }
            Input::Triangle(triangle) => self.triangle(triangle, out),
            other => Err(DrawError::Primitive(other.name())),
        }
    }
}

/// A column of each word of a list.
pub fn columns(layout: &Layout) -> Vec<Column> {
    let names = layout.word_names().into_iter().enumerate();
    let column = |(n, name): (usize, String)| {
        let fields = layout.fields(n).iter().rev();
        let text = fields.map(|field| {
            let name = field.name.trim_start_matches('-');
            let from =
                if field.piece > 0 { format!(" from bit {}", field.piece) } else { String::new() };
            format!("{name}{from} in bits {} to {}", field.at, field.at + field.width - 1)
        });
        let meaning = format!("Word {n}: {}.", text.collect::<Vec<_>>().join(", "));
        Column::new(&name, crate::format::WORD, false, 0, &meaning)
    };
    names.map(column).collect()
}

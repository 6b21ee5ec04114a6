//! The channels of a triangle over any machine that carries linear values: set-up, places, correction.
//! Spec clauses `CH-1` to `CH-7`.

mod set_up;
mod sink;
mod words;

pub use words::ComponentWords;

use super::{CarriedWords, Carrier, DrawError, Input, Machine, Sink};
use crate::bits::bounded;
use crate::cover::{MultisampleConfig, SampleGrid};
use crate::dda::Processor;
use crate::format::{Column, WordFormat};
use crate::setup::{Division, Snapped, Triangle, VertexConfig};
use crate::value::{
    AttributeConfig, AttributeError, Correction, Corrector, EvaluatedAt, InverseWConfig,
    VertexValues,
};
use set_up::Scratch;
use sink::{Buffers, ChannelSink};

/// A channel as files and drawings have it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChannelPort {
    /// Its name.
    pub name: String,
    /// The values of its components.
    pub components: Vec<Column>,
    /// Whether there is a value for every covered sample of a pixel, and not one a pixel.
    pub by_sample: bool,
}

/// The channels of a profile.
#[derive(Clone, Debug)]
pub struct Channels {
    list: Vec<Channel>,
    /// The words of 1/w, where a channel walks it.
    w: Option<CarriedWords>,
    /// Where values are taken.
    grids: Vec<SampleGrid>,
    ports: Vec<ChannelPort>,
    /// Set-up words that they add to those of their machine.
    columns: Vec<Column>,
    processor: Processor,
    /// Whether linear values are a start and two slopes.
    steps: bool,
}

#[derive(Clone, Debug)]
struct Channel {
    corrector: Corrector,
    words: CarriedWords,
    places: Places,
    /// Its place in the profile.
    number: usize,
    /// Number of its first component among all.
    first: usize,
}

/// Where a channel is evaluated: numbers of grids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Places {
    One(usize),
    /// At each covered sample: the first of so many.
    Samples {
        samples: usize,
        count: u32,
    },
    /// At the centre, or at one of so many samples.
    Centroid {
        centre: usize,
        samples: usize,
        count: u32,
    },
}

impl Channels {
    /// The channels of a profile, which has no others, on a machine that carries them by these means.
    ///
    /// # Errors
    /// [`AttributeError`] names the violated inequality.
    pub fn new(
        configs: &[AttributeConfig],
        w: Option<&InverseWConfig>,
        vertex: &VertexConfig,
        grid: SampleGrid,
        multisample: Option<MultisampleConfig>,
        (carrier, processor): (&dyn Carrier, Processor),
    ) -> Result<Self, AttributeError> {
        let sub_pixel = grid.sub_pixel;
        let mut grids = Vec::new();
        let samples = multisample.map_or_else(|| vec![grid], |config| config.grids(sub_pixel));
        let count = bounded(samples.len());
        let mut list = Vec::new();
        let mut ports = Vec::new();
        let mut first = 0;
        for config in configs {
            let mut place = |wanted: &[SampleGrid]| {
                let found = grids.windows(wanted.len()).position(|known| known == wanted);
                found.unwrap_or_else(|| {
                    grids.extend_from_slice(wanted);
                    grids.len() - wanted.len()
                })
            };
            let centre = SampleGrid::at([1 << sub_pixel >> 1; 2], sub_pixel);
            let places = match (config.at, multisample) {
                (EvaluatedAt::Sample, None) => Places::One(place(&samples)),
                (EvaluatedAt::Sample, Some(_)) => {
                    Places::Samples { samples: place(&samples), count }
                }
                (EvaluatedAt::Centroid, Some(_)) => {
                    Places::Centroid { centre: place(&[centre]), samples: place(&samples), count }
                }
                (EvaluatedAt::Centre | EvaluatedAt::Centroid, _) => Places::One(place(&[centre])),
                (EvaluatedAt::Corner, _) => {
                    Places::One(place(&[SampleGrid::at([0; 2], sub_pixel)]))
                }
            };
            let corrector = Corrector::new(config, w, vertex)?;
            if config.detail.is_some() {
                let name = config.name.clone();
                if !carrier.steps() {
                    return Err(AttributeError::DetailMachine(name));
                }
                if !matches!(places, Places::One(_)) {
                    return Err(AttributeError::DetailPlace(name));
                }
            }
            let words = CarriedWords {
                read: corrector.read_out(),
                rounding: config.rounding,
                division: config.division,
                gain: config.start_gain(),
            };
            let word = code_word(config);
            let component =
                |name: &String| word.column(name.clone(), format!("{name} of {}.", config.name));
            ports.push(ChannelPort {
                name: config.name.clone(),
                components: config.components.iter().map(component).collect(),
                by_sample: matches!(places, Places::Samples { .. }),
            });
            let components = config.components.len();
            list.push(Channel { corrector, words, places, number: list.len(), first });
            first += components;
        }
        let walked = w.filter(|_| configs.iter().any(|config| config.correction.walks_w()));
        let w = walked.map(|w| -> Result<_, AttributeError> {
            let (rounding, division, gain) = (w.rounding, Division::Quotient, 0);
            Ok(CarriedWords { read: w.validate(vertex)?, rounding, division, gain })
        });
        let (w, steps) = (w.transpose()?, carrier.steps());
        let columns = Vec::new();
        let mut channels = Self { list, w, grids, ports, columns, processor, steps };
        channels.columns = channels.named(carrier)?;
        Ok(channels)
    }

    /// The channels, in the order of the profile.
    pub fn ports(&self) -> &[ChannelPort] {
        &self.ports
    }

    /// The set-up columns that the channels add to those of their machine.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Whether linear values are a start and two slopes, which are added sample by sample and row by row.
    pub fn steps(&self) -> bool {
        self.steps
    }

    fn named(&self, carrier: &dyn Carrier) -> Result<Vec<Column>, AttributeError> {
        let mut columns: Vec<Column> = Vec::new();
        let scale = self.scale();
        let numbered = |place: usize, new: Vec<Column>| {
            let several = self.grids.len() > 1;
            new.into_iter().map(move |column| {
                let name = if several { format!("{}_{place}", column.name) } else { column.name };
                Column { name, ..column }
            })
        };
        for place in 0..self.grids.len() {
            if let Some(words) = &self.w {
                columns.extend(numbered(place, carrier.columns("w", words, 0)));
            }
            for channel in self.list.iter().filter(|channel| channel.places.has(place)) {
                let config = channel.corrector.config();
                for component in &config.components {
                    let name = format!("{}_{component}", config.name);
                    let new = match channel.carries() {
                        Some(scaled) => {
                            let scale = if scaled { scale } else { 0 };
                            carrier.columns(&name, &channel.words, scale)
                        }
                        None => channel.vertex_columns(&name),
                    };
                    columns.extend(numbered(place, new));
                }
            }
        }
        let twice = columns.iter().enumerate().find_map(|(n, column)| {
            let before = columns[..n].iter().any(|before| before.name == column.name);
            before.then(|| column.name.clone())
        });
        twice.map_or(Ok(columns), |name| Err(AttributeError::Column(name)))
    }

    /// Whether values were checked against these channels.
    fn takes(&self, values: &VertexValues) -> bool {
        let mut left = values.components();
        let own = self.list.iter().all(|channel| {
            let config = channel.corrector.config();
            let Some((own, rest)) = left.split_at_checked(config.components.len()) else {
                return false;
            };
            left = rest;
            let (low, high) = config.range();
            let most = channel.corrector.w_read_out().map(|w| i128::from(w.maximum()));
            own.iter().flatten().all(|code| (low..=high).contains(code))
                && most.is_none_or(|most| {
                    values.inverse_w().is_some_and(|q| q.iter().all(|q| (1..=most).contains(q)))
                })
        });
        own && left.is_empty()
    }

    /// Bits of a code of 1/w, which are below the binary point of u/w.
    fn scale(&self) -> u32 {
        self.w.map_or(0, |words| words.read.integer())
    }

    /// Draws a triangle on a machine, with the channels of its vertices or without.
    ///
    /// # Errors
    /// [`DrawError`] if the profile refuses what happened.
    pub fn draw(
        &self,
        machine: &dyn Machine,
        triangle: &Snapped<Triangle>,
        values: Option<&VertexValues>,
        out: &mut dyn Sink,
    ) -> Result<(), DrawError> {
        if values.is_some_and(|values| !self.takes(values)) {
            return Err(DrawError::ForeignValues);
        }
        let given = triangle;
        let triangle = triangle.normalised();
        let set_up = values.zip(machine.carrier()).filter(|_| is_drawn(machine, &triangle));
        let set_up = set_up.map(|(values, carrier)| {
            let turned = given.area2() < 0;
            self.set_up(carrier, &triangle, values, turned, &|_| true)
        });
        let mut painter =
            ChannelSink { channels: self, set_up, out, open: None, buffers: Buffers::default() };
        machine.draw(&Input::Triangle(given), &mut painter)
    }
}

/// Whether a normalised triangle is more than its zero area.
fn is_drawn(machine: &dyn Machine, triangle: &Triangle) -> bool {
    triangle.area2() > 0 || machine.draws_degenerate()
}

/// Takes a channel's number, a run and the codes of each component along it.
pub type CodeSink<'a> = dyn FnMut(usize, [u32; 3], &[Vec<i64>]) + 'a;

impl Channels {
    /// The codes along runs of covered samples of a normalised triangle, of the channels that are wanted and
    /// have a place a pixel; `turned` says that two vertices have changed places.
    pub fn along(
        &self,
        carrier: &dyn Carrier,
        (triangle, turned): (&Triangle, bool),
        values: &VertexValues,
        (wanted, runs): (&[bool], impl Iterator<Item = [u32; 3]>),
        out: &mut CodeSink<'_>,
    ) {
        let set_up = self.set_up(carrier, triangle, values, turned, &|n| wanted[n]);
        let (mut scratch, mut codes) = (Scratch::default(), Vec::new());
        for run in runs {
            for channel in self.list.iter().filter(|channel| wanted[channel.number]) {
                if let Places::One(place) = channel.places {
                    channel.run(self.processor, (&set_up, place), run, &mut scratch, &mut codes);
                    out(channel.number, run, &codes);
                }
            }
        }
    }
}

impl Places {
    fn has(self, place: usize) -> bool {
        let among =
            |samples: usize, count: u32| (samples..samples + count as usize).contains(&place);
        match self {
            Self::One(at) => place == at,
            Self::Samples { samples, count } => among(samples, count),
            Self::Centroid { centre, samples, count } => place == centre || among(samples, count),
        }
    }
}

impl Channel {
    /// Whether its components are linear values that a machine carries; if so, whether over w.
    fn carries(&self) -> Option<bool> {
        match self.corrector.config().correction {
            Correction::Affine => Some(false),
            Correction::Flat { .. } | Correction::Barycentric { .. } => None,
            _ => Some(true),
        }
    }

    /// The words of a component that no machine carries: the code, or the codes of the three vertices.
    fn vertex_columns(&self, name: &str) -> Vec<Column> {
        let config = self.corrector.config();
        let word = code_word(config);
        match config.correction {
            Correction::Flat { .. } => {
                vec![word.column(name.to_owned(), format!("{name} of the provoking vertex."))]
            }
            _ => (0..3)
                .map(|n| {
                    let meaning = format!("{name} of vertex {n} of the normalised triangle.");
                    word.column(format!("{name}_v{n}"), meaning)
                })
                .collect(),
        }
    }
}

/// The word of a code.
fn code_word(config: &AttributeConfig) -> WordFormat {
    if config.signed {
        WordFormat::signed(config.integer)
    } else {
        WordFormat::unsigned(config.integer)
    }
}

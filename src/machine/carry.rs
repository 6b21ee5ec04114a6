//! How machines carry a value that is linear in the window over a triangle: a channel's component, u/w or
//! 1/w. Spec clause `CH-13`.

use crate::bits::Rounding;
use crate::cover::SampleGrid;
use crate::format::{Column, ReadOut, Unreduced, WordFormat};
use crate::setup::{Division, Gradient, Plane, Triangle};
use crate::value::Line;
use std::fmt::Debug;

/// The words of a linear value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CarriedWords {
    /// The accumulator's format.
    pub read: ReadOut,
    /// Rounding of what set-up makes.
    pub rounding: Rounding,
    /// How set-up divides.
    pub division: Division,
    /// What is added to the start, in units of the accumulator.
    pub gain: i128,
}

impl CarriedWords {
    /// The accumulator's word.
    pub fn format(&self) -> WordFormat {
        WordFormat::signed(self.read.width()).fraction(self.read.fraction())
    }
}

/// A linear value over one triangle of positive area, before it is set up.
#[derive(Clone, Copy, Debug)]
pub struct LinearValue<'a> {
    /// The triangle, normalised.
    pub triangle: &'a Triangle,
    /// The value at each vertex, in units of 2^-scale.
    pub values: [i128; 3],
    /// Bits of the vertex values below the binary point.
    pub scale: u32,
    /// Where a pixel is sampled.
    pub grid: &'a SampleGrid,
}

/// A machine's own means.
pub trait Carrier: Debug + Send + Sync {
    /// The set-up columns of a value of this name, whose vertex values have `scale` bits below the binary
    /// point.
    fn columns(&self, name: &str, words: &CarriedWords, scale: u32) -> Vec<Column>;

    /// Whether a value is a start and two slopes, which are added sample by sample and row by row: then its
    /// words give the value of any pixel, covered or not.
    fn steps(&self) -> bool {
        false
    }

    /// Sets a value up.
    fn carry(&self, value: &LinearValue<'_>, words: &CarriedWords) -> Box<dyn Carried>;
}

/// The unwrapped accumulators of a run of samples.
#[derive(Debug)]
pub enum Accumulators {
    /// On a straight line.
    Line(Line),
    /// One by one.
    Each(Vec<i128>),
}

/// A linear value, set up.
pub trait Carried: Debug {
    /// The set-up words, in the order of [`Carrier::columns`].
    fn setup(&self) -> Vec<Unreduced>;

    /// The unwrapped accumulators of the run of `length` samples from pixel (x, y) rightward, in the same
    /// form for every value. `x` is where the covered run begins.
    fn run(&self, y: u32, x: u32, length: usize) -> Accumulators;
}

/// Start and slopes of a plane, walked on the sample grid. Spec clause `P-2`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planes;

impl Carrier for Planes {
    fn columns(&self, name: &str, words: &CarriedWords, _: u32) -> Vec<Column> {
        let word = words.format();
        [
            ("init", format!("{name} at pixel (0, 0).")),
            ("dx", format!("{name}, change per pixel to the right.")),
            ("dy", format!("{name}, change per row downward.")),
        ]
        .map(|(what, meaning)| word.column(format!("{name}_{what}"), meaning))
        .into()
    }

    fn steps(&self) -> bool {
        true
    }

    fn carry(&self, value: &LinearValue<'_>, words: &CarriedWords) -> Box<dyn Carried> {
        Box::new(plane(value, words))
    }
}

/// The rounded plane of a value.
pub(super) fn plane(value: &LinearValue<'_>, words: &CarriedWords) -> Plane {
    let (grid, fraction) = (value.grid, words.read.fraction());
    let gradient = Gradient::new(value.triangle, value.values);
    let (rounding, division) = (words.rounding, words.division);
    let plane = if value.scale == 0 {
        grid.plane(&gradient, fraction, rounding, division)
    } else {
        let (numerators, whole) = grid.numerators(&gradient);
        let whole = whole << value.scale;
        Plane::over(numerators, whole, grid.sub_pixel, fraction, rounding, division)
    };
    let raised = plane.raised(Unreduced::new(words.gain, fraction));
    raised.unwrap_or_else(|error| unreachable!("a gain in the plane's units: {error}"))
}

impl Carried for Plane {
    fn setup(&self) -> Vec<Unreduced> {
        self.values().into()
    }

    fn run(&self, y: u32, x: u32, _: usize) -> Accumulators {
        Accumulators::Line([self.at(x.into(), y.into()).raw(), self.dx().raw()])
    }
}

/// The exact plane at the first sample of each run, rounded once, and the x slope from there on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spans;

/// A value that starts anew at each run.
#[derive(Debug)]
struct Started {
    words: CarriedWords,
    gradient: Gradient,
    scale: u32,
    grid: SampleGrid,
    dx: i128,
}

impl Carrier for Spans {
    fn columns(&self, name: &str, words: &CarriedWords, _: u32) -> Vec<Column> {
        let meaning = format!("{name}, change per pixel to the right.");
        vec![words.format().column(format!("{name}_dx"), meaning)]
    }

    fn carry(&self, value: &LinearValue<'_>, words: &CarriedWords) -> Box<dyn Carried> {
        let [_, dx, _] = plane(value, words).raw();
        let gradient = Gradient::new(value.triangle, value.values);
        Box::new(Started { words: *words, gradient, scale: value.scale, grid: *value.grid, dx })
    }
}

impl Carried for Started {
    fn setup(&self) -> Vec<Unreduced> {
        vec![Unreduced::new(self.dx, self.words.read.fraction())]
    }

    fn run(&self, y: u32, x: u32, _: usize) -> Accumulators {
        let CarriedWords { read, rounding, division, gain } = self.words;
        let numerator = self.gradient.numerator(self.grid.position(x.into(), y.into()));
        let divider = division.by(self.gradient.area2 << self.scale);
        let start = divider.apply(numerator, read.fraction(), rounding).0 + gain;
        Accumulators::Line([start, self.dx])
    }
}

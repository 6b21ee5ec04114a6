//! The figures of a budget by name: what sweeps plot, fits bound and Pareto fronts weigh. All are
//! better when smaller. Spec clause `Q-4`.

mod channel;

pub use channel::of_channels;

use super::field::Level;
use super::record::Record;
use crate::measure::accuracy::{Accuracy, Deviation, Spread, ValueError};
use crate::measure::cost::Cost;
use channel::OfChannel;
use std::cmp::Ordering;

/// What a figure is read from.
#[derive(Clone, Copy)]
enum Source {
    Cost(fn(&Cost) -> f64),
    Accuracy(fn(&Accuracy) -> Option<f64>),
    Record(fn(&Record) -> Option<f64>),
    Channel(OfChannel),
}

/// What a figure is about. Searches ask this, never a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Hardware cost, from the bits alone.
    Cost,
    /// Samples that are wrongly covered or wrongly not covered.
    Misclassified,
    /// Samples with too few or too many hits.
    Hits,
    /// Pairs adjacent in depth that are reversed (`Greater`) or become equal (`Equal`).
    Order(Ordering),
    /// Depths outside the guard range.
    Wraps,
    /// Depths clamped to an end of the range.
    Clamps,
    /// Triangles that the profile does not draw.
    Triangles,
    /// The error of an interpolated value.
    Value(Interpolated, Scale),
    /// The error of the codes of the channel of that name.
    Channel(&'static str),
    /// The software model.
    Software,
}

/// Which value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolated {
    /// Depth.
    Depth,
    /// The attribute.
    Attribute,
}

/// In which units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Units of the last place.
    Ulp,
    /// Distance for depth, a part of its range for the attribute.
    World,
}

/// What causes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The vertex grid.
    Snap,
    /// The words.
    Arithmetic,
}

/// A figure of a budget.
#[derive(Clone, Copy)]
pub struct Metric {
    /// Its name on the command line and in reports.
    pub name: &'static str,
    /// Its unit, for axes and tables.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub about: &'static str,
    /// What it is about.
    pub subject: Subject,
    /// What causes it; a cost is a matter of the words.
    pub cause: Cause,
    source: Source,
}

impl std::fmt::Debug for Metric {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

impl PartialEq for Metric {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Metric {
    /// The figure of a record; `None` where it has none.
    pub fn of(&self, record: &Record) -> Option<f64> {
        match self.source {
            Source::Cost(read) => Some(read(&record.cost)),
            Source::Accuracy(read) => read(&record.accuracy),
            Source::Record(read) => read(record),
            Source::Channel(figure) => figure.of(&record.accuracy),
        }
    }

    /// The figure of a cost alone; `None` if it is none of cost.
    pub fn of_cost(&self, cost: &Cost) -> Option<f64> {
        match self.source {
            Source::Cost(read) => Some(read(cost)),
            _ => None,
        }
    }

    /// The figure of an accuracy alone; `None` if it is none of accuracy, or the scene has none.
    pub fn of_accuracy(&self, accuracy: &Accuracy) -> Option<f64> {
        match self.source {
            Source::Accuracy(read) => read(accuracy),
            Source::Channel(figure) => figure.of(accuracy),
            _ => None,
        }
    }

    /// Whether the figure follows from the bits alone.
    pub fn is_cost(&self) -> bool {
        matches!(self.source, Source::Cost(_))
    }

    /// What the figure of an accuracy depends on.
    pub fn level(&self) -> Level {
        match (self.cause, self.subject) {
            (Cause::Snap, _) => Level::Stage,
            (Cause::Arithmetic, Subject::Misclassified | Subject::Hits) => Level::Coverage,
            (Cause::Arithmetic, _) => Level::Value,
        }
    }

    /// Whether the figure is one of accuracy.
    pub fn is_accuracy(&self) -> bool {
        matches!(self.source, Source::Accuracy(_) | Source::Channel(_))
    }

    /// The metric of that name; `color-worst` is one of the channel `color`, `map-worst@1024` one of the
    /// channel `map` in texels of a texture of 1024.
    pub fn find(name: &str) -> Option<Self> {
        all().find(|metric| metric.name == name).or_else(|| Self::of_channel(name))
    }
}

const fn cost(
    name: &'static str,
    unit: &'static str,
    about: &'static str,
    read: fn(&Cost) -> f64,
) -> Metric {
    let (subject, cause) = (Subject::Cost, Cause::Arithmetic);
    Metric { name, unit, about, subject, cause, source: Source::Cost(read) }
}

const COST: [Metric; 10] = [
    cost("area", "um2", "cell area with ripple-carry adders", |c| c.ripple.area_um2),
    cost("area-prefix", "um2", "cell area with prefix adders", |c| c.prefix.area_um2),
    cost("delay", "ps", "delay of the slowest step with ripple-carry adders", |c| {
        c.ripple.delay_ps
    }),
    cost("delay-prefix", "ps", "delay of the slowest step with prefix adders", |c| {
        c.prefix.delay_ps
    }),
    cost("adder-bits", "bits", "adder bits of all units", |c| f64::from(c.adder_bits)),
    cost("register-bits", "bits", "register bits of all units", |c| f64::from(c.register_bits)),
    cost("setup-bits", "bits", "bits of the widest intermediate value of set-up", |c| {
        f64::from(c.setup_bits)
    }),
    cost("setup-area", "um2", "cell area of what sets the planes of a triangle up", |c| {
        c.set_up.area_um2
    }),
    cost("setup-cycles", "clocks", "clocks that the planes of a triangle take", |c| {
        f64::from(c.set_up.cycles)
    }),
    cost(
        "triangle-ns",
        "ns",
        "time that the planes of a triangle take at the clock of area",
        |c| f64::from(c.set_up.cycles) * c.ripple.delay_ps / 1000.0,
    ),
];

/// The words of the tables below as causes and subjects.
macro_rules! table {
    (arithmetic) => {
        Cause::Arithmetic
    };
    (snap) => {
        Cause::Snap
    };
    (misclassified) => {
        Subject::Misclassified
    };
    (holes) => {
        Subject::Hits
    };
    (double_hits) => {
        Subject::Hits
    };
    (inversions) => {
        Subject::Order(Ordering::Greater)
    };
    (ties) => {
        Subject::Order(Ordering::Equal)
    };
    (wraps) => {
        Subject::Wraps
    };
    (clamps) => {
        Subject::Clamps
    };
    (refused) => {
        Subject::Triangles
    };
    (vanished) => {
        Subject::Triangles
    };
    (depth) => {
        Interpolated::Depth
    };
    (attribute) => {
        Interpolated::Attribute
    };
    (ulp) => {
        Scale::Ulp
    };
    (world) => {
        Scale::World
    };
}

/// Counts of samples, pairs or triangles, one cause of error each.
macro_rules! counts {
    ($($name:literal $cause:ident $field:ident $unit:literal $about:literal),* $(,)?) => {[
        $(Metric {
            name: $name,
            unit: $unit,
            about: $about,
            subject: table!($field),
            cause: table!($cause),
            source: Source::Accuracy(|a| counted(a.$cause.$field)),
        },)*
    ]};
}

#[allow(clippy::cast_precision_loss, reason = "a count in a report")]
#[allow(clippy::unnecessary_wraps, reason = "the form of every figure")]
fn counted(count: u64) -> Option<f64> {
    Some(count as f64)
}

const COUNTS: [Metric; 14] = counts![
    "misclassified" arithmetic misclassified "samples" "samples that are wrongly covered or wrongly not covered",
    "holes" arithmetic holes "samples" "samples of the scene with too few hits",
    "double-hits" arithmetic double_hits "samples" "samples of the scene with too many hits",
    "inversions" arithmetic inversions "pairs" "surfaces adjacent in depth whose order is reversed",
    "ties" arithmetic ties "pairs" "surfaces adjacent in depth that become equal",
    "wraps" arithmetic wraps "samples" "depths outside the guard range",
    "clamps" arithmetic clamps "samples" "depths clamped to an end of the range",
    "snap-misclassified" snap misclassified "samples" "samples gained or lost by snapping",
    "snap-holes" snap holes "samples" "samples with too few hits because of snapping",
    "snap-double-hits" snap double_hits "samples" "samples with too many hits because of snapping",
    "snap-inversions" snap inversions "pairs" "surfaces adjacent in depth whose order snapping reverses",
    "snap-ties" snap ties "pairs" "surfaces adjacent in depth that snapping makes equal",
    "snap-refused" snap refused "triangles" "triangles outside the vertex field",
    "snap-vanished" snap vanished "triangles" "triangles without area after snapping",
];

macro_rules! spreads {
    ($($name:literal $cause:ident $value:ident $scale:ident $unit:literal $part:ident $about:literal),* $(,)?) => {[
        $(Metric {
            name: $name,
            unit: $unit,
            about: $about,
            subject: Subject::Value(table!($value), table!($scale)),
            cause: table!($cause),
            source: Source::Accuracy(|a| {
                figure(&a.$cause, |d| d.$value.as_ref(), |e| &e.$scale).map(|s| s.$part.abs())
            }),
        },)*
    ]};
}

fn figure<'a>(
    cause: &'a Deviation,
    value: impl Fn(&'a Deviation) -> Option<&'a ValueError>,
    scale: impl Fn(&'a ValueError) -> &'a Spread,
) -> Option<&'a Spread> {
    value(cause).map(scale)
}

const SPREADS: [Metric; 24] = spreads![
    "depth-worst" arithmetic depth ulp "ULP" worst "worst depth error",
    "depth-mean" arithmetic depth ulp "ULP" mean "mean depth error, absolute value",
    "depth-rms" arithmetic depth ulp "ULP" rms "RMS depth error",
    "depth-worst-world" arithmetic depth world "world" worst "worst depth error as a distance",
    "depth-mean-world" arithmetic depth world "world" mean "mean depth error as a distance",
    "depth-rms-world" arithmetic depth world "world" rms "RMS depth error as a distance",
    "attribute-worst" arithmetic attribute ulp "ULP" worst "worst attribute error",
    "attribute-mean" arithmetic attribute ulp "ULP" mean "mean attribute error, absolute value",
    "attribute-rms" arithmetic attribute ulp "ULP" rms "RMS attribute error",
    "attribute-worst-world" arithmetic attribute world "range" worst "worst attribute error, relative to its range",
    "attribute-mean-world" arithmetic attribute world "range" mean "mean attribute error, relative to its range",
    "attribute-rms-world" arithmetic attribute world "range" rms "RMS attribute error, relative to its range",
    "snap-depth-worst" snap depth ulp "ULP" worst "worst change of depth by snapping",
    "snap-depth-mean" snap depth ulp "ULP" mean "mean change of depth by snapping",
    "snap-depth-rms" snap depth ulp "ULP" rms "RMS change of depth by snapping",
    "snap-depth-worst-world" snap depth world "world" worst "worst change of distance by snapping",
    "snap-depth-mean-world" snap depth world "world" mean "mean change of distance by snapping",
    "snap-depth-rms-world" snap depth world "world" rms "RMS change of distance by snapping",
    "snap-attribute-worst" snap attribute ulp "ULP" worst "worst change of attribute by snapping",
    "snap-attribute-mean" snap attribute ulp "ULP" mean "mean change of attribute by snapping",
    "snap-attribute-rms" snap attribute ulp "ULP" rms "RMS change of attribute by snapping",
    "snap-attribute-worst-world" snap attribute world "range" worst "worst change by snapping, relative to the range",
    "snap-attribute-mean-world" snap attribute world "range" mean "mean change by snapping, relative to the range",
    "snap-attribute-rms-world" snap attribute world "range" rms "RMS change by snapping, relative to the range",
];

const MEASURED: [Metric; 2] = [
    Metric {
        name: "operations",
        unit: "a fragment",
        about: "operations per covered sample, including a share of the set-up",
        subject: Subject::Software,
        cause: Cause::Arithmetic,
        source: Source::Record(|record| Some(record.operations_per_fragment)),
    },
    Metric {
        name: "ns",
        unit: "ns a sample",
        about: "time of the software model on one thread",
        subject: Subject::Software,
        cause: Cause::Arithmetic,
        source: Source::Record(|record| record.speed.map(|speed| speed.ns_per_sample)),
    },
];

/// Every metric but those of channels: cost, coverage, values, software.
pub fn all() -> impl Iterator<Item = Metric> {
    COST.into_iter().chain(COUNTS).chain(SPREADS).chain(MEASURED)
}

/// The names, for a message.
pub fn names() -> String {
    all().map(|metric| metric.name).collect::<Vec<_>>().join(", ")
        + ", and those of channels, such as color-worst or map-rms@1024"
}

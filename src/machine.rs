//! Rasterizers: each machine turns a primitive into spans, values and events with its own algorithm.

mod barycentric;
mod bound;
mod carry;
mod channels;
mod cost;
mod edge_function;
mod edge_walk;
mod edge_words;
mod engine_per_pixel;
mod gouraud;
mod homogeneous;
mod line;
mod list;
mod multisampled;
mod own;
mod painter;
mod port;
mod rasterizer;
mod register;
mod scanline;
mod state;
mod step;
mod tiles;
mod traversed;
mod word;

pub use barycentric::{Barycentric, BarycentricConfig, BarycentricError};
pub use bound::{plane_bound, rounding_error};
pub use carry::{Accumulators, Carried, CarriedWords, Carrier, LinearValue};
pub use channels::{ChannelPort, Channels, CodeSink, ComponentWords};
pub use cost::{Count, Datapath, Dda, Operations, Unit, corners, signed_bits};
pub use edge_function::{EdgeFunction, EdgeFunctionConfig};
pub use edge_walk::{EdgeWalk, EdgeWalkConfig, EdgeWalkError, WalkedEdge};
pub use engine_per_pixel::{EnginePerPixel, EnginePerPixelConfig, serial_plane};
pub use gouraud::{Gouraud, GouraudConfig};
pub use homogeneous::{Homogeneous, HomogeneousConfig, HomogeneousError};
pub use line::Lines;
pub use list::{kinds, triangle_machines};
pub use multisampled::Multisampled;
pub use own::{AddError, Own, OwnForm, add};
pub use painter::{Painter, drawable};
pub use port::{Ports, SetupError};
pub use rasterizer::{
    Carries, EveryLinear, Face, FormError, Intake, Kind, Polygons, Rasterizer, Step,
};
pub use register::{
    Anchor, AnchoredConfig, BoxEnds, BoxLimit, ClipEnds, ClipRegisters, Corner, Descent, Division,
    EdgeBox, EdgeEngineConfig, EdgeOrder, EdgeRule, EdgeSense, EdgeSource, Emit, EndOrder,
    EngineConfig, FanConfig, FillConfig, Filler, FillerPlace, HalfOrder, Largest, LastPixel, Legal,
    LineDraws, LinesConfig, MiddleRow, Origin, Plane, PlaneStart, Product, QuadConfig, QuadDevice,
    QuadEdges, QuadRule, Record, RecordConfig, RegisterConfig, RegisterDevice, RegisterError,
    RegisterMachine, Registers, RowCounts, RowOrder, SlopeConfig, SlopeEdges, SpanEnd,
    SubScanlineConfig, TilePlace, ValueSource, VertexSort, Winding, WiredDevice, WiredEngine,
    WithoutArea, WordsError, columns,
};
pub use scanline::{Scanline, ScanlineConfig};
pub use state::{RasterState, Site};
pub use step::{Steps, near, near_or_none};
pub use tiles::{Tiles, TilesConfig, TilesError};
pub use traversed::Traversed;
pub use word::{Fact, Word, WordField, steps_below_half};

use crate::bits::SpanEvents;
use crate::cover::{Rect, SampleGrid, Segment};
use crate::format::Unreduced;
use crate::setup::{ClipTriangle, Polygon, Snapped, Triangle, VertexField};
use crate::value::VertexValues;

// The one list of machines, in the order that reports and tables have.
list::machines! {
    /// Three edge functions over the bounding box (Pineda), or in the order of `[traversal]`.
    EdgeFunction(EdgeFunctionConfig) in edge_function;
    /// Three x DDAs, depth on a plane (VGX).
    EdgeWalk(EdgeWalkConfig) in edge_walk;
    /// x and depth walked down the edges, depth along each span (GTX).
    Gouraud(GouraudConfig) in gouraud;
    /// An engine at every pixel (Pixel-Planes 4).
    EnginePerPixel(EnginePerPixelConfig) in engine_per_pixel;
    /// An approximate walk, edge functions as a mask, barycentric values (InfiniteReality).
    Barycentric(BarycentricConfig) in barycentric;
    /// Small tiles, an engine each (Bali).
    Tiles(TilesConfig) in tiles;
    /// Homogeneous recursive descent (Olano and Greer).
    Homogeneous(HomogeneousConfig) in homogeneous;
    /// Exact sides and spans between them (Crow).
    Scanline(ScanlineConfig) in scanline;
    /// A machine that begins at registers.
    Registers(Box<RegisterConfig>) in register;
}

/// One primitive, as a machine takes it.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Input<'a> {
    /// A triangle on the profile's sub-pixel grid.
    Triangle(&'a Snapped<Triangle>),
    /// The same with the values of its vertices for the channels of the profile.
    Shaded(&'a Snapped<Triangle>, &'a VertexValues),
    /// A triangle that is neither projected nor clipped.
    Clip(&'a ClipTriangle),
    /// A polygon of three or more vertices, convex or not.
    Polygon(&'a Snapped<Polygon>),
    /// A line from one end to the other, in sub-pixels.
    Line(&'a Snapped<Segment>),
    /// A point, in sub-pixels.
    Point(&'a Snapped<[i128; 2]>),
    /// Registers, as a machine that begins there takes them.
    Words(&'a [u32]),
}

impl Input<'_> {
    /// The form of the primitive, for a message.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Triangle(_) | Self::Shaded(..) => "triangles",
            Self::Clip(_) => "homogeneous vertices",
            Self::Polygon(_) => "polygons",
            Self::Line(_) => "lines",
            Self::Point(_) => "points",
            Self::Words(_) => "registers",
        }
    }

    /// The field that its coordinates were checked against. Homogeneous vertices and registers are
    /// checked by the machine, which alone knows their ranges.
    #[inline]
    pub(crate) const fn field(&self) -> Option<&VertexField> {
        match self {
            Self::Triangle(shape) | Self::Shaded(shape, _) => Some(shape.field()),
            Self::Polygon(shape) => Some(shape.field()),
            Self::Line(shape) => Some(shape.field()),
            Self::Point(shape) => Some(shape.field()),
            Self::Clip(_) | Self::Words(_) => None,
        }
    }

    /// The triangle, for a machine that draws nothing else.
    ///
    /// # Errors
    /// [`DrawError::Primitive`] for any other primitive.
    pub fn triangle(&self) -> Result<&Snapped<Triangle>, DrawError> {
        match self {
            Self::Triangle(triangle) | Self::Shaded(triangle, _) => Ok(triangle),
            other => Err(DrawError::Primitive(other.name())),
        }
    }
}

macro_rules! inputs {
    ($($variant:ident $shape:ty),*) => {$(
        impl<'a> From<&'a $shape> for Input<'a> {
            fn from(shape: &'a $shape) -> Self {
                Self::$variant(shape)
            }
        }
    )*};
}

inputs!(
    Triangle Snapped<Triangle>, Clip ClipTriangle, Polygon Snapped<Polygon>, Line Snapped<Segment>,
    Point Snapped<[i128; 2]>, Words [u32]
);

/// Why a primitive was refused. Numeric events are data; this is not one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DrawError {
    /// Under the clamp mode `error`, a covered sample left the guard range.
    #[error(
        "depth leaves the guard range at pixel ({x}, {y}); the profile has clamp = \"error\", so the triangle is refused"
    )]
    GuardRange {
        /// Column.
        x: i64,
        /// Row.
        y: i64,
    },
    /// The machine draws other primitives.
    #[error("the machine of this profile does not draw {0}")]
    Primitive(&'static str),
    /// A primitive that was checked against the vertex field of another profile.
    #[error(
        "the primitive was made for a different vertex field: {} <= x, y <= {} at {} sub-pixel bits and z <= {}; \
         this profile has {} <= x, y <= {} at {} sub-pixel bits and z <= {}; snap the primitive with the model that draws it",
        .got.range().0, .got.range().1, .got.sub_pixel(), .got.depth_max(),
        .need.range().0, .need.range().1, .need.sub_pixel(), .need.depth_max()
    )]
    Foreign {
        /// The model's field.
        need: VertexField,
        /// The primitive's.
        got: VertexField,
    },
    /// Values of vertices that were checked against the channels of another profile.
    #[error(
        "the values of the vertices were made for other channels; make them with the model that draws them"
    )]
    ForeignValues,
    /// The machine draws polygons, but not their depth.
    #[error(
        "the machine {machine} draws only the coverage of polygons, because more than three points may \
         not lie on one plane; leave z out, or choose a machine that walks depth down the edges: {}",
        with_polygon_depth()
    )]
    PolygonDepth {
        /// The machine.
        machine: &'static str,
    },
    /// A depth bias of what has no plane.
    #[error(
        "the profile has [depth.bias], and polygons have no depth slope of their own, because more than \
         three points may not lie on one plane; leave z out, draw triangles, or leave the bias out"
    )]
    PolygonBias,
    /// Another number of words.
    #[error("{got} words are given, but this machine takes {need}")]
    Words {
        /// Words of its list.
        need: usize,
        /// Words given.
        got: usize,
    },
    /// Registers that would keep the machine busy for longer than the caller allows. Spec clause `RG-4`.
    #[error("the words take up to {steps} steps, but at most {most} are allowed")]
    Work {
        /// What they take: pixels, and whatever else is looked at.
        steps: u128,
        /// What is allowed.
        most: u64,
    },
    /// Numbers too large for exact 128-bit arithmetic.
    #[error("{what} = {value}: {low} <= {what} <= {high} is needed for this machine")]
    Range {
        /// Which number.
        what: &'static str,
        /// The number.
        value: i128,
        /// Smallest taken.
        low: i128,
        /// Largest taken.
        high: i128,
    },
}

/// The machines that draw polygons with depth.
fn with_polygon_depth() -> String {
    let kinds = kinds().filter(|kind| kind.polygons == Polygons::Depth);
    kinds.map(|kind| kind.name).collect::<Vec<_>>().join(", ")
}

/// Where spans, values and events of a primitive go, in the order of y then x.
pub trait Sink {
    /// Whether [`Sink::setup`] is wanted.
    fn wants_setup(&self) -> bool {
        false
    }

    /// The set-up values, in the order of [`Ports::setup`], before they are cut to the columns' words.
    fn setup(&mut self, _values: &[Unreduced]) {}

    /// The triangle has no area and draws nothing.
    fn zero_area(&mut self) {}

    /// The profile leaves the triangle out: as one without area, it draws nothing. Spec clause `FP-10`.
    fn culled(&mut self) {
        self.zero_area();
    }

    /// A maximal run of covered samples `[x0, x1)` in row y; `depth` has one value a sample, or is
    /// empty when the primitive has none. Where pixels have several samples it is a run of pixels
    /// with one covered, and `depth` has a value a pixel or a covered sample: [`Ports::by_sample`].
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]);

    /// A channel's codes of the run just given, from column `x0`, for each component. There is a code a
    /// pixel, or one a covered sample: [`ChannelPort::by_sample`].
    fn channel(&mut self, _channel: usize, _y: u32, _x0: u32, _components: &[Vec<i64>]) {}

    /// The coverage masks of the run just given, where pixels have several samples.
    fn masks(&mut self, _y: u32, _x0: u32, _masks: &[u32]) {}

    /// Whether [`Sink::events`] is wanted.
    fn wants_events(&self) -> bool {
        false
    }

    /// The numeric events of a run, in drawing order.
    fn events(&mut self, _events: &SpanEvents) {}

    /// Whether [`Sink::held`] is wanted.
    fn wants_held(&self) -> bool {
        false
    }

    /// The depth accumulators of the run just given, from column `x0`: wrapped and clamped, with
    /// their fraction. In `[0, 2^(i+F))`.
    fn held(&mut self, _y: u32, _x0: u32, _accumulators: &[i128]) {}

    /// Whether [`Sink::record`] is wanted.
    fn wants_records(&self) -> bool {
        false
    }

    /// The most steps that registers may take: a few words can ask for more than anybody waits for.
    fn most_steps(&self) -> u64 {
        1 << 28
    }

    /// What a register machine writes, in drawing order: the kind of a record and its values, in the
    /// order of [`Record::names`].
    fn record(&mut self, _kind: usize, _values: &[i64]) {}

    /// What finding the fragments of the primitive took, once it is drawn.
    fn work(&mut self, _work: &Work) {}
}

/// What a machine did to find the fragments of a primitive. Spec clause `A-11`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Rows walked.
    pub rows: u64,
    /// Tiles or blocks tested as a whole.
    pub tiles: u64,
    /// Samples evaluated, covered or not.
    pub visits: u64,
    /// Unit steps of the accumulators from one evaluated place to the next.
    pub steps: u64,
}

impl Work {
    /// Adds another primitive's.
    pub fn add(&mut self, other: &Self) {
        self.rows += other.rows;
        self.tiles += other.tiles;
        self.visits += other.visits;
        self.steps += other.steps;
    }
}

/// Where a machine draws: the sample grid, and the pixels it may touch.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Sample positions.
    pub grid: SampleGrid,
    /// The window cut by the scissor.
    pub clip: Rect,
    /// How far a bounding box reaches beyond the vertices, in sub-pixels: 0 where samples are covered.
    pub reach: i128,
}

impl Target {
    /// The pixels `[x0, y0, x1, y1]` that a triangle could cover. Spec clauses `C-7` and `CR-3`.
    pub fn bounds(&self, triangle: &Triangle) -> [u32; 4] {
        let side = |axis| {
            let (low, high) = triangle.extent(axis);
            self.clip.clip(axis, self.grid.pixels(axis, (low - self.reach, high + self.reach)))
        };
        let ((x0, x1), (y0, y1)) = (side(0), side(1));
        [x0, y0, x1, y1]
    }
}

/// A rasterizer.
pub trait Machine: Send + Sync + std::fmt::Debug {
    /// The words it takes and makes.
    fn ports(&self) -> &Ports;

    /// The words that a host would write for a triangle; none on a machine that takes triangles.
    fn host(&self, _triangle: &Triangle) -> Vec<Vec<u32>> {
        Vec::new()
    }

    /// How it carries a value that is linear in the window, where it carries channels.
    fn carrier(&self) -> Option<&dyn Carrier> {
        None
    }

    /// Whether it draws triangles without area, with the values of vertex 0. Spec clause `CR-4`.
    fn draws_degenerate(&self) -> bool {
        false
    }

    /// Draws one primitive.
    ///
    /// # Errors
    /// [`DrawError`] if the profile refuses what happened.
    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError>;
}

//! What a machine costs, as counts: the DDAs it walks with, and its arithmetic operations.
//! Spec clauses `H-1`, `H-3` and `H-4`.

use super::RasterState;
use crate::cover::{EdgeWordConfig, FillRule};
use crate::format::Clamp;
use crate::setup::{Division, VertexConfig};
use crate::value::{DepthConfig, StartBias};
use serde::Serialize;
use std::ops::Add;

/// What a machine's datapath is made of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Datapath {
    /// The walked units: edges, then depth if the profile has it.
    pub units: Vec<Unit>,
    /// Bits of the widest intermediate of coverage set-up, sign included.
    pub setup_bits: u32,
    /// Arithmetic operations of the model.
    pub operations: Operations,
}

/// Equal DDAs that step together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Unit {
    /// `edge` or `depth`.
    pub name: &'static str,
    /// How many of them.
    pub copies: u32,
    /// Bits of the accumulator of each.
    pub width: u32,
    /// Register bits of all copies. A planar DDA holds accumulator, row start and two slopes; the
    /// linear DDA of an edge walk holds accumulator and slope.
    pub register_bits: u32,
    /// Adder bits of all copies: one adder of the accumulator's width each, which the operands of
    /// a step right and of a step down share.
    pub adder_bits: u32,
    /// Whether its read-out clamps.
    pub clamp: bool,
    /// What it walks and how it is read.
    #[serde(skip)]
    pub dda: Dda,
}

/// What a unit walks, and how its accumulator is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dda {
    /// Down an edge: one slope, the accumulator as it is.
    Linear,
    /// Over a plane: two slopes, the sign of the accumulator.
    Planar,
    /// Over a plane: two slopes, the depth read-out of the profile.
    Depth,
}

impl Unit {
    /// One DDA of so many bits, with `registers` words of them.
    const fn new(name: &'static str, dda: Dda, [width, registers]: [u32; 2]) -> Self {
        let (copies, register_bits, adder_bits) = (1, width * registers, width);
        Self { name, copies, width, register_bits, adder_bits, clamp: false, dda }
    }

    /// A DDA with one slope: accumulator and slope.
    pub const fn linear(name: &'static str, width: u32) -> Self {
        Self::new(name, Dda::Linear, [width, 2])
    }

    /// A DDA over a plane, read by its sign: accumulator, row start and two slopes.
    pub const fn planar(name: &'static str, width: u32) -> Self {
        Self::new(name, Dda::Planar, [width, 4])
    }

    /// Whether it walks a coordinate that all values of the machine share.
    pub fn is_shared(&self) -> bool {
        self.name == "share"
    }

    /// So many of this one.
    #[must_use]
    pub const fn times(self, copies: u32) -> Self {
        Self {
            copies: self.copies * copies,
            register_bits: self.register_bits * copies,
            adder_bits: self.adder_bits * copies,
            ..self
        }
    }

    /// The same unit, with a clamp behind it where depth has one.
    #[must_use]
    pub fn clamped(self, depth: &DepthConfig) -> Self {
        Self { clamp: depth.clamp != Clamp::Wrap, ..self }
    }

    /// The DDA of a depth plane.
    pub fn depth(depth: &DepthConfig) -> Self {
        let width = depth.guard + depth.integer + depth.interpolation;
        Self::new("depth", Dda::Depth, [width, 4]).clamped(depth)
    }

    /// The DDA of depth along a span: the slope is that of the span.
    pub fn span_depth(depth: &DepthConfig) -> Self {
        let width = depth.guard + depth.integer + depth.interpolation;
        Self::new("depth", Dda::Depth, [width, 2]).clamped(depth)
    }
}

/// Operations by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Count {
    /// Additions and subtractions.
    pub add: u64,
    /// Multiplications of two variables.
    pub multiply: u64,
    /// Divisions, reciprocals included.
    pub divide: u64,
    /// Comparisons and sign tests; a minimum or maximum of two is one.
    pub compare: u64,
}

impl Count {
    /// The sign of twice the area, and whether there is one: clause `T-3`.
    pub const AREA: Self = Self::new(5, 2, 0, 2);
    /// Lowest and highest of three, on one axis.
    pub const EXTENT: Self = Self::new(0, 0, 0, 4);
    /// Pixels of an interval, on one axis: both ends from the sample's offset, one past the last.
    pub const PIXELS: Self = Self::new(3, 0, 0, 0);
    /// An interval cut by the window: two ends between two bounds, and not reversed.
    pub const CLIP: Self = Self::new(0, 0, 0, 5);
    /// start + x dx + y dy.
    pub const JUMP: Self = Self::new(2, 2, 0, 0);
    /// One step of a DDA.
    pub const STEP: Self = Self::new(1, 0, 0, 0);
    /// A comparison.
    pub const TEST: Self = Self::new(0, 0, 0, 1);

    /// So many additions, multiplications, divisions and comparisons, in this order.
    pub const fn new(add: u64, multiply: u64, divide: u64, compare: u64) -> Self {
        Self { add, multiply, divide, compare }
    }

    /// The same work `n` times over.
    #[must_use]
    pub const fn times(self, n: u64) -> Self {
        Self::new(self.add * n, self.multiply * n, self.divide * n, self.compare * n)
    }

    /// The bounding box on both axes.
    pub fn bounds() -> Self {
        (Self::EXTENT + Self::PIXELS + Self::CLIP).times(2) + Self::TEST
    }

    /// Three edge words stepped to the next sample, and their signs.
    pub fn sample() -> Self {
        (Self::STEP + Self::TEST).times(3)
    }

    /// Three edge words stepped to the next tile; of each the corner that decides either way.
    pub fn block() -> Self {
        (Self::STEP + Self::STEP.times(2) + Self::TEST.times(2)).times(3)
    }

    /// The offsets of an edge's two deciding corners: two steps times the side, kept once a triangle.
    pub const fn corners() -> Self {
        Self::new(2, 2, 0, 4)
    }

    /// One edge function at the first sample, biased.
    pub fn edge_setup(rule: FillRule) -> Self {
        let owns = match rule {
            // Both rules ask for the sign of dy, whether it is zero, and the sign of dx.
            FillRule::TopLeft | FillRule::Shadow => Self::TEST.times(3),
        };
        Self::edge_and_bias() + owns
    }

    /// One edge function at the first sample, and an addition to it.
    fn edge_and_bias() -> Self {
        let differences = Self::new(2, 0, 0, 0);
        let constant = Self::new(1, 2, 0, 0);
        let at_first_sample = Self::new(2, 2, 0, 0);
        let bias = Self::new(1, 0, 0, 0);
        differences + constant + at_first_sample + bias
    }

    /// One edge word at the first sample: biased by the rule, or moved to the corner of a square that decides.
    pub fn edge_word_setup(edges: &EdgeWordConfig) -> Self {
        match edges.conservative {
            None => Self::edge_setup(edges.rule),
            // Two signs, the sum of two magnitudes, and its product with a number of the profile.
            Some(_) => Self::edge_and_bias() + Self::new(1, 1, 0, 2),
        }
    }

    /// Set-up of a depth plane: clauses `P-1` to `P-4`.
    pub fn plane(depth: &DepthConfig) -> Self {
        let gradient = Self::new(8, 4, 0, 0);
        let offset = Self::new(3, 2, 0, 0);
        let divided = match depth.division {
            // z0 A2 joins the dividend; start and two slopes are divided.
            Division::Quotient => Self::new(1, 1, 3, 0),
            // One reciprocal, three products, and z0 joins the first.
            Division::Reciprocal { .. } => Self::new(1, 3, 1, 0),
        };
        let bias = match (depth.start_bias, depth.interpolation) {
            (StartBias::Half, 1..) => Self::new(1, 0, 0, 0),
            _ => Self::default(),
        };
        gradient + offset + divided + bias + Self::depth_bias(depth)
    }

    /// What the depth bias adds to a plane's start takes: clause `Z-7`.
    pub fn depth_bias(depth: &DepthConfig) -> Self {
        let Some(bias) = depth.bias else { return Self::default() };
        let some = |needed: bool, count: Self| if needed { count } else { Self::default() };
        Self::new(1, 0, 0, 0)
            + some(bias.slope != 0, Self::new(1, 1, 0, 1))
            + some(bias.clamp != 0, Self::new(0, 0, 0, 1))
            // The largest of three depths.
            + some(bias.constant != 0 && depth.is_float(), Self::new(0, 0, 0, 2))
    }

    /// The same on a machine without a plane, which sets two slopes up for it.
    pub fn depth_bias_alone(depth: &DepthConfig) -> Self {
        let sloped = depth.bias.is_some_and(|bias| bias.slope != 0);
        let slopes = if sloped { Self::new(8, 4, 2, 0) } else { Self::default() };
        slopes + Self::depth_bias(depth)
    }

    /// Clause `G-6`; a sticky accumulator is held at two ends instead (`G-5`).
    pub fn read_out(clamp: Clamp) -> Self {
        match clamp {
            Clamp::Wrap => Self::default(),
            Clamp::Sign | Clamp::Saturate => Self::TEST.times(2),
            Clamp::Guard | Clamp::Error => Self::TEST.times(2) + Self::new(1, 0, 0, 0),
        }
    }
}

impl Add for Count {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(
            self.add + other.add,
            self.multiply + other.multiply,
            self.divide + other.divide,
            self.compare + other.compare,
        )
    }
}

/// Operations by how often they are done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Operations {
    /// Once a triangle: set-up.
    pub triangle: Count,
    /// Once a row of the bounding box.
    pub row: Count,
    /// Once a tile or block tested as a whole.
    pub tile: Count,
    /// Once a run of covered samples: finding its depth.
    pub run: Count,
    /// Once a visited sample, covered or not. An edge walk visits none in vain.
    pub visit: Count,
    /// Once a covered sample.
    pub fragment: Count,
}

impl Operations {
    /// The same with depth on a plane: set up once, found at each run, stepped to each fragment, read out.
    #[must_use]
    pub fn with_plane(mut self, depth: Option<&DepthConfig>) -> Self {
        let Some(depth) = depth else { return self };
        self.triangle = self.triangle + Count::plane(depth);
        // A sticky accumulator cannot jump: it walks to the run, however far that is.
        if depth.clamp != Clamp::Saturate {
            self.run = Count::JUMP;
        }
        self.fragment = Count::STEP + Count::read_out(depth.clamp);
        self
    }
}

/// Bits of a two's complement word for values of up to this magnitude, of either sign.
pub const fn signed_bits(magnitude: i128) -> u32 {
    1 + i128::BITS - magnitude.leading_zeros()
}

/// The ends of the vertex field chosen by the bits of `n`: what is linear in each coordinate has
/// its extremes there.
pub fn corners<const C: usize>(vertex: &VertexConfig) -> impl Iterator<Item = [i128; C]> + use<C> {
    let (low, high) = vertex.range();
    (0..1usize << C)
        .map(move |n| std::array::from_fn(|bit| if n >> bit & 1 == 0 { low } else { high }))
}

impl Datapath {
    /// The datapath of three planar edge words; `operations` are those of coverage, with depth's own.
    pub(super) fn of_edge_words(
        edges: EdgeWordConfig,
        state: &RasterState,
        operations: Operations,
    ) -> Self {
        let mut units = vec![Unit::planar("edge", edges.width).times(3)];
        units.extend(state.depth.as_ref().map(Unit::depth));
        Self { units, setup_bits: super::edge_words::setup_bits(edges, state), operations }
    }
}

//! The order in which samples are visited: a choice of its own, beside the arithmetic.
//! Spec clauses `O-1` to `O-5`.

mod curve;
mod decision;
mod sweep;

#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where a traversal goes next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// Every stamp of the bounding box, row by row, left to right.
    BoundingBox,
    /// Rows left to right; each begins where the one above did, moved left until the triangle lies
    /// to the right.
    Backtrack,
    /// Rows in alternating directions, so that none is gone back over.
    Zigzag,
    /// Tiles left to right and down, skipped or taken whole by their corners, then the stamps of
    /// each.
    Tiles,
    /// Bins of eight by eight tiles, tested by their corners like the tiles in them.
    Binned,
    /// Z order: the bits of x and y interleaved.
    Morton,
    /// The Hilbert curve: every stamp is next to the one before.
    Hilbert,
}

impl Order {
    /// Every order.
    pub const ALL: [Self; 7] = [
        Self::BoundingBox,
        Self::Backtrack,
        Self::Zigzag,
        Self::Tiles,
        Self::Binned,
        Self::Morton,
        Self::Hilbert,
    ];

    /// The name profiles use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BoundingBox => "bounding-box",
            Self::Backtrack => "backtrack",
            Self::Zigzag => "zigzag",
            Self::Tiles => "tiles",
            Self::Binned => "binned",
            Self::Morton => "morton",
            Self::Hilbert => "hilbert",
        }
    }
}

/// Pixels evaluated side by side in one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
pub enum Stamp {
    /// One pixel.
    #[default]
    #[serde(rename = "1x1")]
    One,
    /// Two pixels of a row.
    #[serde(rename = "2x1")]
    Two,
    /// Two by two pixels.
    #[serde(rename = "2x2")]
    Four,
}

impl Stamp {
    /// Every stamp.
    pub const ALL: [Self; 3] = [Self::One, Self::Two, Self::Four];

    /// The name profiles use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::One => "1x1",
            Self::Two => "2x1",
            Self::Four => "2x2",
        }
    }

    /// Width and height in pixels.
    pub const fn size(self) -> [u32; 2] {
        match self {
            Self::One => [1, 1],
            Self::Two => [2, 1],
            Self::Four => [2, 2],
        }
    }
}

/// How the samples of a primitive are visited.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct TraversalConfig {
    /// The order.
    pub order: Order,
    /// Pixels a step.
    #[serde(default)]
    pub stamp: Stamp,
}

/// Side of a tile in pixels, and of a bin in tiles.
pub const TILE: u32 = 8;

/// What a stamp says about the rest of its row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outside {
    /// All of it lies left of the primitive, so nothing is missed further left.
    pub left: bool,
    /// All of it lies right of the primitive, so nothing is missed further right.
    pub right: bool,
}

/// What the corners of a block of samples say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// None of its samples is covered.
    Outside,
    /// Nothing certain.
    Partly,
    /// All of its samples are covered.
    Inside,
}

/// What a traversal moves over a primitive: it holds the accumulators.
pub trait Visitor {
    /// Goes to the stamp whose first pixel is (x, y) and evaluates it.
    fn stamp(&mut self, x: u32, y: u32) -> Outside;

    /// Looks at the block of `side` by `side` pixels from (x, y) as a whole.
    fn block(&mut self, x: u32, y: u32, side: u32) -> Block;
}

impl TraversalConfig {
    /// Visits the stamps of the pixels `[x0, x1)` by `[y0, y1)`; stamps and tiles are aligned to the
    /// window, so they may begin before the box and end after it.
    pub fn visit(&self, [x0, y0, x1, y1]: [u32; 4], visitor: &mut dyn Visitor) {
        if x0 >= x1 || y0 >= y1 {
            return;
        }
        let [width, height] = self.stamp.size();
        // In stamps from here on.
        let area = sweep::Area {
            x0: x0 / width,
            y0: y0 / height,
            x1: x1.div_ceil(width),
            y1: y1.div_ceil(height),
            size: [width, height],
        };
        match self.order {
            Order::BoundingBox => sweep::bounding_box(&area, visitor),
            Order::Backtrack => sweep::backtrack(&area, visitor),
            Order::Zigzag => sweep::zigzag(&area, visitor),
            Order::Tiles => sweep::tiles(&area, TILE, visitor),
            Order::Binned => sweep::binned(&area, visitor),
            Order::Morton => curve::morton(&area, visitor),
            Order::Hilbert => curve::hilbert(&area, visitor),
        }
    }
}

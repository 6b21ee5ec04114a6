//! The parts of coverage as a profile names them. Spec clauses `RE-1` to `RE-6`.

use crate::machine::register::is_default;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

macro_rules! choice {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident $text:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
        #[cfg_attr(feature = "verification", derive(JsonSchema))]
        pub enum $name {
            $($(#[$variant_doc])* #[serde(rename = $text)] $variant,)*
        }

        impl $name {
            /// Every choice.
            pub const ALL: &[Self] = &[$(Self::$variant,)*];

            /// The name profiles use.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $text,)*
                }
            }
        }
    };
}
pub(super) use choice;

choice! {
    /// The pixel at which registers give a value.
    Origin {
        /// The first pixel of the box.
        #[default]
        Box "box",
        /// Pixel (0, 0).
        Window "window",
    }
}

choice! {
    /// On which side of an edge its word is positive.
    EdgeSense {
        /// Inside of a triangle of positive area.
        #[default]
        Positive "positive",
        /// Inside of a triangle of negative area.
        Negative "negative",
    }
}

/// Where edge functions come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum EdgeSource {
    /// Registers hold the value at a pixel, and its change to the next one, right and down.
    Given {
        /// At which pixel.
        #[serde(default, skip_serializing_if = "is_default")]
        at: Origin,
    },
    /// Registers hold vertices in sub-pixels.
    Vertices {
        /// Where a word is positive.
        #[serde(default, skip_serializing_if = "is_default")]
        sense: EdgeSense,
        /// Places that each product is cut by before one is taken from the other.
        #[serde(default, skip_serializing_if = "is_default")]
        product_cut: u32,
        /// Places that the difference is cut by.
        #[serde(default, skip_serializing_if = "is_default")]
        cut: u32,
    },
}

choice! {
    /// Which windings are drawn, and how the other one is turned.
    Winding {
        /// The one whose edge words are positive inside.
        #[default]
        One "one",
        /// Both: an area below zero turns the test.
        Both "both",
        /// Both: an area below zero negates the edge words.
        Negate "negate",
        /// Both: an area below zero exchanges vertices 1 and 2.
        Swap "swap",
        /// Both, without an area: all three words pass the test, or all three pass the turned one.
        Either "either",
    }
}

choice! {
    /// Who owns what lies on an edge.
    EdgeRule {
        /// Both sides.
        #[default]
        Both "both",
        /// Neither side.
        Strict "strict",
        /// Left edges, and flat ones at the top.
        TopLeft "top-left",
        /// Right edges, and flat ones at the top.
        TopRight "top-right",
        /// Left edges, and flat ones at the bottom.
        BottomLeft "bottom-left",
        /// Right edges, and flat ones at the bottom.
        BottomRight "bottom-right",
        /// Not a right edge and not a flat bottom; the side is found by a truncating division.
        TruncatedSide "truncated-side",
    }
}

choice! {
    /// What is done with a triangle without area.
    WithoutArea {
        /// It is drawn as any other.
        #[default]
        Draw "draw",
        /// It is left out.
        Skip "skip",
    }
}

choice! {
    /// Whether the last pixel of a range belongs to it.
    BoxEnds {
        /// It is the pixel before the end.
        HalfOpen "half-open",
        /// It is the end.
        #[default]
        Closed "closed",
    }
}

/// What a box of vertices is cut to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum BoxLimit {
    /// Nothing.
    #[default]
    None,
    /// A target of this width and height, from pixel (0, 0).
    Size([u32; 2]),
    /// A target whose width and height are registers.
    SizeRegisters,
    /// A target whose width and height are powers of two; registers hold the exponents.
    ExponentRegisters,
    /// A rectangle of registers.
    Rectangle(BoxEnds),
}

/// The pixels that are looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum EdgeBox {
    /// Registers hold its ends, in pixels.
    Given(BoxEnds),
    /// It goes round the vertices.
    Vertices {
        /// Bits of its ends, in pixels, where they have fewer than a vertex.
        #[serde(default, skip_serializing_if = "is_default")]
        bits: Option<u32>,
        /// What it is cut to.
        #[serde(default, skip_serializing_if = "is_default")]
        limit: BoxLimit,
        /// Whether each end is held between both ends of the limit, and not only from its own side: a box
        /// beyond the limit is then its last pixel, and not empty.
        #[serde(default, skip_serializing_if = "is_default")]
        hold_both: bool,
        /// Whether the first column and the first row are tried although the box is empty.
        #[serde(default, skip_serializing_if = "is_default")]
        try_first: bool,
    },
}

choice! {
    /// Where tiles lie.
    TilePlace {
        /// At whole multiples of their size.
        #[default]
        Grid "grid",
        /// From the first pixel of the box on, as many as it needs.
        Box "box",
        /// From the first pixel of the box on, as many as there would be at whole multiples.
        BoxCountedByGrid "box-counted-by-grid",
    }
}

/// The order in which pixels are looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", rename_all_fields = "kebab-case", deny_unknown_fields)]
pub enum EdgeOrder {
    /// By y, then x.
    #[default]
    Rows,
    /// By y; every second row of the box to the left.
    Serpentine,
    /// By y; a walker steps down beside the triangle and turns where it has to.
    Zigzag,
    /// Tile by tile, by y then x of the tiles, then of their pixels.
    Tiles {
        /// Pixels of a row of a tile.
        width: u32,
        /// Rows of a tile.
        height: u32,
        /// Where they lie.
        #[serde(default, skip_serializing_if = "is_default")]
        place: TilePlace,
        /// Whether a tile is left out whose four corner pixels are all outside of one edge.
        #[serde(default, skip_serializing_if = "is_default")]
        reject_corners: bool,
        /// Whether a tile's pixels beyond the box are tried too.
        #[serde(default, skip_serializing_if = "is_default")]
        beyond_box: bool,
    },
}

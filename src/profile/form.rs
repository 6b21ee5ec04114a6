//! How a primitive becomes fragments: the machines, and one profile seen through each of them.

use super::Profile;
use crate::bits::Rounding;
use crate::cover::{EdgeStorage, EdgeWordConfig, FillRule, Order, TILE};
use crate::machine::{
    BarycentricConfig, EdgeWalkConfig, HomogeneousConfig, RegisterConfig, ScanlineConfig,
    TilesConfig,
};
use crate::value::Depth;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The machine of a profile.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Form {
    /// Three edge functions over the bounding box (Pineda), or in the order of `[traversal]`.
    EdgeFunction(EdgeWordConfig),
    /// Three x DDAs, depth on a plane (VGX).
    EdgeWalk(EdgeWalkConfig),
    /// x and depth walked down the edges, depth along each span (GTX).
    Gouraud(EdgeWalkConfig),
    /// An engine at every pixel (Pixel-Planes 4).
    EnginePerPixel(EdgeWordConfig),
    /// An approximate walk, edge functions as a mask, barycentric values (InfiniteReality).
    Barycentric(BarycentricConfig),
    /// Small tiles, an engine each (Bali).
    Tiles(TilesConfig),
    /// Homogeneous recursive descent (Olano and Greer).
    Homogeneous(HomogeneousConfig),
    /// Exact sides and spans between them (Crow).
    Scanline(ScanlineConfig),
    /// A machine that begins at registers.
    Registers(Box<RegisterConfig>),
}

/// The machines by the names profiles use, each with the one that a lecture knows it by.
pub const MACHINES: [(&str, &str); 8] = [
    ("edge-function", "Pineda"),
    ("edge-walk", "VGX"),
    ("gouraud", "GTX"),
    ("engine-per-pixel", "Pixel-Planes 4"),
    ("barycentric", "InfiniteReality"),
    ("tiles", "Bali"),
    ("homogeneous", "recursive descent"),
    ("scanline", "Crow"),
];

impl Profile {
    /// The edge words of a plain engine: edge functions over a box and one sample a pixel, and with
    /// depth a plane whose integer part is stored. `None` for any other profile.
    pub fn plain_edges(&self) -> Option<EdgeWordConfig> {
        let Form::EdgeFunction(edge) = self.form else { return None };
        let stored = self.depth.is_some_and(|depth| depth.format.is_some());
        let other = stored || self.multisample.is_some() || self.traversal.is_some();
        (!other).then_some(edge)
    }
}

impl Form {
    /// The name profiles use.
    pub const fn name(&self) -> &'static str {
        let index = match self {
            Self::EdgeFunction(_) => 0,
            Self::EdgeWalk(_) => 1,
            Self::Gouraud(_) => 2,
            Self::EnginePerPixel(_) => 3,
            Self::Barycentric(_) => 4,
            Self::Tiles(_) => 5,
            Self::Homogeneous(_) => 6,
            Self::Scanline(_) => 7,
            Self::Registers(_) => return "registers",
        };
        MACHINES[index].0
    }

    /// The edge words, of whichever machine has them.
    pub const fn edge(&self) -> Option<&EdgeWordConfig> {
        match self {
            Self::EdgeFunction(edge)
            | Self::EnginePerPixel(edge)
            | Self::Barycentric(BarycentricConfig { edge, .. })
            | Self::Tiles(TilesConfig { edge, .. }) => Some(edge),
            Self::EdgeWalk(_)
            | Self::Gouraud(_)
            | Self::Homogeneous(_)
            | Self::Scanline(_)
            | Self::Registers(_) => None,
        }
    }

    /// The same, to be changed.
    pub const fn edge_mut(&mut self) -> Option<&mut EdgeWordConfig> {
        match self {
            Self::EdgeFunction(edge)
            | Self::EnginePerPixel(edge)
            | Self::Barycentric(BarycentricConfig { edge, .. })
            | Self::Tiles(TilesConfig { edge, .. }) => Some(edge),
            Self::EdgeWalk(_)
            | Self::Gouraud(_)
            | Self::Homogeneous(_)
            | Self::Scanline(_)
            | Self::Registers(_) => None,
        }
    }

    /// The walked x, of whichever machine has it.
    pub const fn walk(&self) -> Option<&EdgeWalkConfig> {
        match self {
            Self::EdgeWalk(walk) | Self::Gouraud(walk) => Some(walk),
            _ => None,
        }
    }

    /// The same, to be changed.
    pub const fn walk_mut(&mut self) -> Option<&mut EdgeWalkConfig> {
        match self {
            Self::EdgeWalk(walk) | Self::Gouraud(walk) => Some(walk),
            _ => None,
        }
    }

    /// Who owns samples on an edge: a walked edge's left end owns its pixel.
    pub const fn rule(&self) -> FillRule {
        match self {
            Self::Homogeneous(HomogeneousConfig { rule, .. })
            | Self::Scanline(ScanlineConfig { rule }) => *rule,
            _ => match self.edge() {
                Some(edge) => edge.rule,
                None => FillRule::TopLeft,
            },
        }
    }

    /// Whether depth is a plane walked on the sample grid; otherwise it is made of the machine's
    /// own means and has an error of its own.
    pub const fn walks_a_plane(&self) -> bool {
        !matches!(self, Self::Gouraud(_) | Self::Barycentric(_))
    }
}

impl Profile {
    /// The edge width that holds every edge value of the vertex field and the window, rounded up to
    /// whole tiles where tiles are tested by their corners; `None` for a machine without edge words,
    /// or where vertex field or sample are malformed.
    pub fn exact_edge_width(&self) -> Option<u32> {
        let edges = self.form.edge()?;
        self.vertex.validate().ok()?;
        let tile = match (&self.form, self.traversal.map(|traversal| traversal.order)) {
            (Form::Tiles(TilesConfig { tile, .. }), _) => (*tile).max(1),
            (_, Some(Order::Tiles)) => TILE,
            (_, Some(Order::Binned)) => TILE * TILE,
            _ => 1,
        };
        let whole = |side: u32| side.div_ceil(tile).saturating_mul(tile);
        let size = (whole(self.window.width), whole(self.window.height));
        Some(edges.exact_width(&self.vertex, &self.grid().ok()?, size))
    }

    /// Whether coverage is exact by construction: words that hold every value, or none at all.
    pub fn covers_exactly(&self) -> bool {
        match (self.form.walk(), self.form.edge(), self.exact_edge_width()) {
            (Some(_), ..) => false,
            (_, Some(edge), Some(exact)) => edge.width >= exact,
            _ => true,
        }
    }

    /// The same profile with another machine, by its name: the same fill rule, and words of the
    /// same width where the machine has such words. `None` for an unknown name.
    ///
    /// Where there is nothing to go by: edge words are as wide as exact coverage asks, a walk has
    /// one guard bit, the integer bits of the vertex field and as many bits as an edge word in all,
    /// an approximate walk the vertex field's integer bits as fraction, a barycentric coordinate
    /// one bit more than depth has below its guard, a tile 16 pixels on a side or as many as a smaller
    /// window has, and W as many bits as fit, at most 16.
    pub fn with_machine(&self, name: &str) -> Option<Self> {
        let mut profile = self.clone();
        let rule = self.form.rule();
        let edge = self.form.edge().copied().unwrap_or_else(|| {
            let edge = EdgeWordConfig { rule, storage: EdgeStorage::Shifted, width: 2 };
            let exact = Self { form: Form::EdgeFunction(edge), ..self.clone() }.exact_edge_width();
            EdgeWordConfig { width: exact.unwrap_or(2), ..edge }
        });
        let walk = self.form.walk().copied().unwrap_or_else(|| {
            let (guard, integer) = (1, self.vertex.integer);
            let fraction = edge.width.saturating_sub(guard + integer);
            EdgeWalkConfig { guard, integer, fraction, rounding: Rounding::NearestEven }
        });
        profile.form = match (name, &self.form) {
            (name, form) if name == form.name() => form.clone(),
            ("edge-function", _) => Form::EdgeFunction(edge),
            ("edge-walk", _) => Form::EdgeWalk(walk),
            ("gouraud", _) => Form::Gouraud(walk),
            ("engine-per-pixel", _) => Form::EnginePerPixel(edge),
            ("barycentric", _) => Form::Barycentric(BarycentricConfig {
                walk_fraction: self.vertex.integer.min(40),
                coordinate: self.depth.map_or(24, |depth| depth.integer + depth.interpolation + 1),
                rounding: self.depth.map_or(Rounding::NearestEven, |depth| depth.rounding),
                edge,
            }),
            ("tiles", _) => {
                let side = self.window.width.min(self.window.height).max(1);
                let tile = 16.min(side.checked_next_power_of_two().unwrap_or(16)).max(2);
                Form::Tiles(TilesConfig { tile, edge })
            }
            ("homogeneous", _) => {
                let depth = self.depth.and_then(|config| {
                    let depth = Depth::new(config, &self.vertex, crate::dda::Processor::baseline());
                    Some((depth.ok()?.read_out(), config.division.growth()))
                });
                let w = HomogeneousConfig::widest_w(&self.vertex, depth);
                Form::Homogeneous(HomogeneousConfig { rule, w })
            }
            ("scanline", _) => Form::Scanline(ScanlineConfig { rule }),
            _ => return None,
        };
        // The order of visits is a choice of edge functions alone.
        if !matches!(profile.form, Form::EdgeFunction(_)) {
            profile.traversal = None;
        }
        Some(profile)
    }
}

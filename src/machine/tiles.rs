//! Small tiles, an engine each: tiles are selected conservatively by the edge functions at their
//! corners, then every engine evaluates its own. Spec clauses `A-2` and `A-7`.

mod form;

pub(super) use form::KIND;

use super::carry::Planes;
use super::edge_function::{edge_columns, setup_words};
use super::edge_words::{drawable, draws_degenerate};
use super::painter::Painter;
use super::{Carrier, DrawError, Input, Machine, Ports, Sink, Target, Work};
use crate::bits::Lane;
use crate::cover::{EdgeWordConfig, EdgeWordError, EdgeWords, for_each_run};
use crate::dda::{Edges, Processor, row_inside};
use crate::setup::VertexConfig;
use crate::value::Depth;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The machine of `[form.tiles]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct TilesConfig {
    /// Side of a tile in pixels, a power of two.
    pub tile: u32,
    /// The edge words, of tile selection and of the engines alike.
    pub edge: EdgeWordConfig,
}

/// Tiles that cannot be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TilesError {
    /// The side of a tile.
    #[error("tile = {0}: a tile has 2, 4, 8, 16, 32 or 64 pixels on a side")]
    Tile(u32),
    /// The edge words.
    #[error(transparent)]
    Edge(#[from] EdgeWordError),
}

impl TilesError {
    /// The key that is at fault, from the machine's table.
    const fn field(self) -> &'static [&'static str] {
        match self {
            Self::Tile(_) => &["tile"],
            Self::Edge(_) => &["edge", "width"],
        }
    }
}

impl TilesConfig {
    /// Checks tile and words.
    ///
    /// # Errors
    /// [`TilesError`] names the violated inequality.
    pub fn validate(&self) -> Result<(), TilesError> {
        if !(self.tile.is_power_of_two() && (2..=64).contains(&self.tile)) {
            return Err(TilesError::Tile(self.tile));
        }
        Ok(self.edge.validate()?)
    }
}

/// Tile selection, and an engine a tile.
#[derive(Clone, Debug)]
pub struct Tiles {
    config: TilesConfig,
    depth: Option<Depth>,
    target: Target,
    processor: Processor,
    ports: Ports,
}

/// What the corners of a tile say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tile {
    Outside,
    Partly,
    Inside,
}

/// The highest and the lowest value of each edge over a tile are at corners that the signs of its
/// steps name, the same for every tile.
struct Corners<L> {
    highest: [L; 3],
    lowest: [L; 3],
}

impl<L: Lane> Corners<L> {
    fn new(words: &EdgeWords, width: u32, tile: u32) -> Self {
        let span = i128::from(tile - 1);
        let corner = |k: usize, sign: i128| {
            let toward = |step: i128| if step * sign > 0 { step * span } else { 0 };
            L::justify(toward(words.dx(k).raw()) + toward(words.dy(k).raw()), width)
        };
        Self {
            highest: std::array::from_fn(|k| corner(k, 1)),
            lowest: std::array::from_fn(|k| corner(k, -1)),
        }
    }

    /// Whether the tile whose first pixel has these edge words can be left out, or taken whole.
    fn classify(&self, edges: &Edges<L>) -> Tile {
        let negative =
            |offsets: &[L; 3]| (0..3).any(|k| edges.value[k].wrapping_add(&offsets[k]) < L::zero());
        match (negative(&self.highest), negative(&self.lowest)) {
            (true, _) => Tile::Outside,
            (_, true) => Tile::Partly,
            _ => Tile::Inside,
        }
    }
}

impl Tiles {
    /// A machine of validated parts.
    pub fn new(
        config: TilesConfig,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
        processor: Processor,
    ) -> Self {
        let setup = edge_columns(config.edge, vertex);
        let ports = Ports::triangle(vertex, setup, depth);
        Self { config, depth, target, processor, ports }
    }

    /// The runs of a row of tiles, top to bottom; the masks of its rows are kept in `rows`.
    fn band<L: Lane>(
        &self,
        words: &EdgeWords,
        [x0, y0, x1, y1]: [u32; 4],
        work: &mut Work,
        out: &mut dyn FnMut(u32, u32, u32) -> Result<(), DrawError>,
    ) -> Result<(), DrawError> {
        let (tile, width) = (self.config.tile, self.config.edge.width);
        let corners = Corners::<L>::new(words, width, tile);
        let mut mask = Vec::new();
        let begin = x0 / tile * tile;
        let pitch = (x1 - begin).div_ceil(64) as usize;
        let mut rows = vec![0u64; pitch * tile as usize];
        for top in (y0 / tile * tile..y1).step_by(tile as usize) {
            rows.fill(0);
            for left in (begin..x1).step_by(tile as usize) {
                let edges = words.lanes::<L>(left, top);
                work.tiles += 1;
                let class = corners.classify(&edges);
                if class == Tile::Outside {
                    continue;
                }
                let (place, shift) = ((left - begin) / 64, (left - begin) % 64);
                let whole = u64::MAX >> (64 - tile);
                let mut row = edges;
                for n in 0..tile as usize {
                    let bits = if class == Tile::Inside {
                        whole
                    } else {
                        row_inside(self.processor, row, tile, &mut mask);
                        row = row.rows_down(L::one());
                        mask[0]
                    };
                    rows[n * pitch + place as usize] |= bits << shift;
                }
                if class == Tile::Partly {
                    work.visits += u64::from(tile) * u64::from(tile);
                }
            }
            for y in top.max(y0)..(top + tile).min(y1) {
                let mut done = Ok(());
                let row = &rows[(y - top) as usize * pitch..][..pitch];
                for_each_run(row, |start, end| {
                    // A tile may reach beyond the bounding box and the scissor.
                    let (from, to) = ((begin + start).max(x0), (begin + end).min(x1));
                    if done.is_ok() && from < to {
                        done = out(y, from, to);
                    }
                });
                done?;
            }
        }
        Ok(())
    }
}

impl Machine for Tiles {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        Some(&Planes)
    }

    fn draws_degenerate(&self) -> bool {
        draws_degenerate(self.config.edge)
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Some(triangle) = drawable(self.config.edge, input.triangle()?, out) else {
            return Ok(());
        };
        let words = self.config.edge.words(&triangle, &self.target.grid);
        let mut painter = Painter::new(self.depth.as_ref(), &triangle, &self.target);
        painter.announce(|| setup_words(&words), out);
        let within = self.target.bounds(&triangle);
        if within[0] == within[2] || within[1] == within[3] {
            return Ok(());
        }
        let mut work = Work::default();
        let mut paint = |y, x0, x1| painter.span(y, x0, x1, out);
        if self.config.edge.width <= 64 {
            self.band::<i64>(&words, within, &mut work, &mut paint)?;
        } else {
            self.band::<i128>(&words, within, &mut work, &mut paint)?;
        }
        out.work(&work);
        Ok(())
    }
}

//! The edge-function machine: three exact (or deliberately narrow) edge words over the bounding
//! box, row by row, and a depth plane. Spec clauses `C-4` to `C-7`.

mod form;

pub use form::EdgeFunctionConfig;
pub(super) use form::KIND;

use super::carry::Planes;
use super::edge_words::{drawable, draws_degenerate};
use super::painter::Painter;
use super::{Carrier, DrawError, Input, Machine, Ports, Sink, Target, Work};
use crate::bits::Lane;
use crate::cover::{EdgeWordConfig, EdgeWords, for_each_run};
use crate::dda::{Processor, row_inside};
use crate::format::{Column, Role, Unreduced, WordFormat};
use crate::setup::VertexConfig;
use crate::value::Depth;

/// The machine of `[form.edge-function]`.
#[derive(Clone, Debug)]
pub struct EdgeFunction {
    edges: EdgeWordConfig,
    depth: Option<Depth>,
    target: Target,
    processor: Processor,
    ports: Ports,
}

impl EdgeFunction {
    /// A machine of validated parts.
    pub fn new(
        edges: EdgeWordConfig,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
        processor: Processor,
    ) -> Self {
        let setup = edge_columns(edges, vertex);
        let ports = Ports::triangle(vertex, setup, depth);
        Self { edges, depth, target, processor, ports }
    }

    /// The covered runs of a box of pixels, row by row.
    pub(super) fn runs(
        &self,
        words: &EdgeWords,
        within: [u32; 4],
        out: &mut dyn FnMut(u32, u32, u32) -> Result<(), DrawError>,
    ) -> Result<(), DrawError> {
        let [x0, _, x1, _] = within;
        if x0 == x1 {
            Ok(())
        } else if self.edges.width <= 64 {
            self.rows::<i64>(words, within, out)
        } else {
            self.rows::<i128>(words, within, out)
        }
    }

    fn rows<L: Lane>(
        &self,
        words: &EdgeWords,
        [x0, y0, x1, y1]: [u32; 4],
        out: &mut dyn FnMut(u32, u32, u32) -> Result<(), DrawError>,
    ) -> Result<(), DrawError> {
        let mut row = words.lanes::<L>(x0, y0);
        let mut mask = Vec::new();
        for y in y0..y1 {
            row_inside(self.processor, row, x1 - x0, &mut mask);
            let mut done = Ok(());
            for_each_run(&mask, |start, end| {
                if done.is_ok() {
                    done = out(y, x0 + start, x0 + end);
                }
            });
            done?;
            row = row.rows_down(L::one());
        }
        Ok(())
    }
}

impl Machine for EdgeFunction {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        Some(&Planes)
    }

    fn draws_degenerate(&self) -> bool {
        draws_degenerate(self.edges)
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Some(triangle) = drawable(self.edges, input.triangle()?, out) else { return Ok(()) };
        let words = self.edges.words(&triangle, &self.target.grid);
        let mut painter = Painter::new(self.depth.as_ref(), &triangle, &self.target);
        painter.announce(|| setup_words(&words), out);
        let [x0, y0, x1, y1] = self.target.bounds(&triangle);
        self.runs(&words, [x0, y0, x1, y1], &mut |y, x0, x1| painter.span(y, x0, x1, out))?;
        let (rows, columns) = (u64::from(y1 - y0), u64::from(x1 - x0));
        out.work(&Work { rows, visits: rows * columns, steps: rows * columns, tiles: 0 });
        Ok(())
    }
}

/// The words of three edges in the order of [`edge_columns`].
pub(super) fn setup_words(words: &EdgeWords) -> Vec<Unreduced> {
    // Room for the three words of a plane behind them.
    let mut setup = Vec::with_capacity(12);
    for k in 0..3 {
        setup.extend(words.values(k));
    }
    setup
}

/// The set-up columns of three edges.
pub(super) fn edge_columns(edges: EdgeWordConfig, vertex: &VertexConfig) -> Vec<Column> {
    let fraction = edges.fraction(vertex.sub_pixel);
    let word = WordFormat::signed(edges.width).fraction(fraction);
    let edge = |k| [Role::EDGE_INIT, Role::EDGE_DX, Role::EDGE_DY].map(|role| role.of(k, word));
    (0..3).flat_map(edge).collect()
}

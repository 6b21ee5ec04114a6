//! The reference model of primitives that are no triangles.

use super::Device;
use crate::model::{Drawing, Model};
use crate::setup::{ClipTriangle, Polygon, VertexError};
use crate::vector::bench::{Coverage, ShapeAnswers, ShapeKind, ShapeTest};
use crate::vector::table::Table;
use std::sync::Arc;

/// Draws primitives of one kind.
pub(in crate::vector) struct ShapeDrawer {
    pub(in crate::vector) kind: ShapeKind,
    /// Whether vertices come with depth.
    pub(in crate::vector) has_depth: bool,
    pub(in crate::vector) model: Arc<Model>,
}

impl ShapeDrawer {
    fn drawn(&self, words: &[i128]) -> Drawing {
        let mut drawing = Drawing::default();
        let stride = words.len() / self.kind.vertices();
        let vertices: Vec<&[i128]> = words.chunks(stride).collect();
        let at = |n: usize| [vertices[n][0], vertices[n][1]];
        let model = &self.model;
        // A device of another profile may have another vertex field.
        let drawn: Result<bool, VertexError> = match self.kind {
            ShapeKind::Line => {
                model.place([at(0), at(1)]).map(|line| model.draw_own(&line, &mut drawing))
            }
            ShapeKind::Point => {
                model.place(at(0)).map(|point| model.draw_own(&point, &mut drawing))
            }
            ShapeKind::Quad => {
                let z = self.has_depth.then(|| vertices.iter().map(|v| v[2]).collect());
                let polygon = Polygon { xy: (0..4).map(at).collect(), z };
                model.place(polygon).map(|polygon| model.draw_own(&polygon, &mut drawing))
            }
            ShapeKind::Clip => {
                let xyw = [0, 1, 2].map(|n: usize| [at(n)[0], at(n)[1], vertices[n][stride - 1]]);
                let z = self.has_depth.then(|| [0, 1, 2].map(|n: usize| vertices[n][2]));
                Ok(model.draw_own(&ClipTriangle { xyw, z }, &mut drawing))
            }
        };
        if drawn != Ok(true) {
            // What a machine refuses has no rows.
            drawing.clear();
        }
        drawing
    }
}

impl Device<ShapeTest> for ShapeDrawer {
    fn answer(&mut self, test: &ShapeTest, rows: &mut ShapeAnswers<Table>, _: &mut Coverage) {
        let drawing = self.drawn(&test.words);
        let number = i128::from(test.test);
        let mut values = drawing.depth.iter();
        for span in &drawing.spans {
            let [y, x0, x1] = [span.y, span.x0, span.x1].map(i128::from);
            rows.spans.push(&[number, y, x0, x1]);
            let Some(depths) = &mut rows.depths else { continue };
            for x in x0..x1 {
                let z = values.next();
                let z = z.unwrap_or_else(|| unreachable!("a depth for each covered sample"));
                depths.push(&[number, y, x, i128::from(*z)]);
            }
        }
    }
}

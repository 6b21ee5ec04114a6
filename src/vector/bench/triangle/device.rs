//! What a device draws and shows, as specified or with a slip.

use super::TriangleBench;
use super::engine::{Answer, Engine, EngineSlip};
use super::quirk::Quirk;
use super::setup::{SetupSlip, Unit};
use super::word::{bounds, setup_words};
use crate::format::Clamp;
use crate::model::{Drawing, Span};
use crate::setup::{Division, Triangle};
use crate::value::Depth;
use crate::vector::bench::locate;
use std::sync::PoisonError;

impl TriangleBench {
    pub(super) fn drawn(&self, triangle: &Triangle) -> Drawing {
        let mut drawing = Drawing::default();
        // A device without the swap sees a negative area and, inside being positive, no samples.
        if self.quirk == Quirk::NoSwap && triangle.area2() < 0 {
            drawing.setup = self.unturned(triangle);
            return drawing;
        }
        // The clamp mode `error` refuses a triangle: it then has no rows.
        let placed = self.model.place(*triangle);
        if placed.is_ok_and(|triangle| !self.model.draw_own(&triangle, &mut drawing)) {
            drawing.spans.clear();
            drawing.depth.clear();
        }
        drawing
    }

    /// Set-up words of a triangle of negative area, edges in the order given. The plane is the same.
    fn unturned(&self, triangle: &Triangle) -> Vec<i128> {
        let Ok(grid) = self.model.profile().grid() else { return Vec::new() };
        let mut words = Vec::new();
        let form = &self.model.profile().form;
        if let Some(edges) = form.edge() {
            let edges = edges.words(triangle, &grid);
            for k in 0..3 {
                words.extend(edges.raw(k));
            }
        } else if let Some(walk) = form.walk() {
            for k in 0..3 {
                let edge = walk.edge(triangle.xy[k], triangle.xy[(k + 1) % 3], &grid);
                words.extend(edge.map_or([0; 4], |edge| edge.words()));
            }
        }
        let turned = triangle.normalised();
        if let (Some(depth), Some(z)) = (self.model.depth(), turned.z) {
            let plane = depth.plane(&turned, z, &grid);
            words.extend(plane.raw());
        }
        words
    }

    /// Depths of a span: those drawn, and beyond them what the plane goes on to give.
    pub(super) fn depths(&self, triangle: &Triangle, span: &Span) -> Vec<u64> {
        let mut values = vec![0; (span.x1 - span.x0) as usize];
        let turned = triangle.normalised();
        let grid = self.model.profile().grid();
        if let (Some(depth), Some(z), Ok(grid)) = (self.model.depth(), turned.z, grid) {
            // A quirk of the row's number leaves the row itself where it was.
            let y = span.y - u32::from(self.quirk == Quirk::RowsLate);
            depth.span(&depth.plane(&turned, z, &grid), y, span.x0, &mut values);
        }
        values
    }

    /// Set-up words as the device under this hypothesis shows them.
    pub(super) fn device_words(&self, triangle: &Triangle, drawing: &Drawing) -> Vec<i128> {
        let mut words = setup_words(&self.model, drawing);
        if let Quirk::Setup(slip) = self.quirk
            && let Some(slipped) =
                self.unit(slip).zip(triangle.z).map(|(u, z)| u.words(triangle, z))
        {
            return slipped;
        }
        if self.quirk == Quirk::ZeroExtended {
            for (word, column) in words.iter_mut().zip(&self.model.ports().setup) {
                *word &= (u128::MAX >> (128 - column.width)).cast_signed();
            }
        }
        words
    }

    /// The set-up of this profile with a slip; `None` where a plain unit does not do it.
    pub(super) fn unit(&self, slip: SetupSlip) -> Option<Unit<'_>> {
        let profile = self.model.profile();
        let edge = profile.plain_edges()?;
        let depth = self.model.depth()?;
        let exact = depth.config().division == Division::Quotient;
        Some(Unit { slip, edge, depth, grid: profile.grid().ok()? }).filter(|_| exact)
    }

    /// The engine of this profile with a slip; `None` where a plain engine does not do it.
    pub(super) fn engine(&self, slip: EngineSlip) -> Option<Engine> {
        let edge = self.model.profile().plain_edges()?;
        let read = self.model.depth().map(Depth::read_out);
        // A sticky accumulator depends on the way, and a refused triangle has no rows.
        let told = read.is_none_or(|r| !matches!(r.clamp(), Clamp::Saturate | Clamp::Error));
        told.then_some(Engine { slip, edge_width: edge.width, read })
    }

    /// What an engine with a slip answers.
    pub(super) fn slipped(
        &self,
        slip: EngineSlip,
        triangle: &Triangle,
        (drawing, test): (&Drawing, u64),
    ) -> Answer {
        let Some(engine) = self.engine(slip) else { return Answer::default() };
        let draw = |triangle: &Triangle, drawing: &Drawing| {
            if drawing.zero_area {
                return Answer::default();
            }
            engine.draw(&setup_words(&self.model, drawing), bounds(&self.model, triangle))
        };
        let mut answer = draw(triangle, drawing);
        answer.samples += u64::from(slip == EngineSlip::CountLarge);
        if slip == EngineSlip::CountKept {
            let mut memory = self.memory.lock().unwrap_or_else(PoisonError::into_inner);
            let before = memory.filter(|(next, _)| *next == test).map(|(_, samples)| samples);
            let before = before.unwrap_or_else(|| {
                let earlier = (0..test).filter_map(|test| locate(&self.groups, test));
                let earlier = earlier.map(|at| self.triangle_at(at));
                earlier.map(|triangle| draw(&triangle, &self.drawn(&triangle)).samples).sum()
            });
            answer.samples += before;
            *memory = Some((test + 1, answer.samples));
        }
        answer
    }
}

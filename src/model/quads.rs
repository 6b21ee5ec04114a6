//! The quads of a triangle: codes of a channel at covered pixels and at those that help them. Spec clause
//! `CH-20`.

use super::{Drawing, Model, Span};
use crate::machine::{Carrier, DrawError, Input};
use crate::setup::{Snapped, Triangle};
use crate::value::{
    AttributeConfig, Correction, Detail, DetailConfig, EvaluatedAt, Quad, VertexValues,
};
use std::collections::BTreeMap;

/// Why a triangle has no quads.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum QuadError {
    /// No channel of this name.
    #[error("the profile has no channel {0:?}")]
    Channel(String),
    /// Values that depend on where a run begins.
    #[error(
        "the machine {0:?} has values only where it covers: quads need a machine that walks planes, such as edge-function"
    )]
    Machine(&'static str),
    /// Values of which a pixel has several, or which depend on a run or on a mask.
    #[error(
        "channel {0:?}: quads need one place in a pixel (`at`) and a correction that is not constant-w"
    )]
    Place(String),
    /// The triangle was not drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
}

/// What a texture unit would take at a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelDetail {
    /// Column.
    pub x: u32,
    /// Row.
    pub y: u32,
    /// Differences of the two coordinates, each to the right and downward.
    pub differences: [[i64; 2]; 2],
    /// The level, in units of `2^-fraction`.
    pub level: u64,
}

impl Model {
    /// The level of detail at each covered pixel of a drawing, in its order, for each channel of the profile
    /// with [`crate::value::AttributeConfig::detail`], in theirs. Spec clause `CH-21`.
    ///
    /// # Errors
    /// [`QuadError`] for a triangle that is not drawn.
    pub fn details(
        &self,
        triangle: &Snapped<Triangle>,
        values: &VertexValues,
        drawing: &Drawing,
    ) -> Result<Vec<Vec<PixelDetail>>, QuadError> {
        let channels = self.profile.channel.iter();
        let details = channels.filter_map(|channel| {
            let config = channel.detail?;
            Some((channel, config, config.unit().ok()?))
        });
        let of_channel = |(channel, config, unit): (&AttributeConfig, DetailConfig, Detail)| {
            let quads = self.quads(triangle, values, &channel.name)?;
            let quads: BTreeMap<_, _> = quads.iter().map(|quad| ((quad.y, quad.x), quad)).collect();
            let pixels = drawing.spans.iter().flat_map(|run| (run.x0..run.x1).map(|x| (x, run.y)));
            let detail = |(x, y): (u32, u32)| {
                let quad = quads.get(&(y & !1, x & !1))?;
                let pixel = (y % 2 * 2 + x % 2) as usize;
                let differences = [0, 1].map(|n| quad.derivatives(n, config.derivatives)[pixel]);
                Some(PixelDetail { x, y, differences, level: unit.level(differences) })
            };
            Ok(pixels.filter_map(detail).collect())
        };
        details.map(of_channel).collect()
    }

    /// The quads of a triangle that have a covered pixel, in y then x order, with the codes of a channel.
    ///
    /// # Errors
    /// [`QuadError`] for a channel without codes beyond the edge, and for a triangle that is not drawn.
    pub fn quads(
        &self,
        triangle: &Snapped<Triangle>,
        values: &VertexValues,
        channel: &str,
    ) -> Result<Vec<Quad>, QuadError> {
        let channels = &self.profile.channel;
        let number = channels.iter().position(|config| config.name == channel);
        let number = number.ok_or_else(|| QuadError::Channel(channel.to_owned()))?;
        let config = &channels[number];
        if !self.machine.carrier().is_some_and(Carrier::steps) {
            return Err(QuadError::Machine(self.profile.form.name()));
        }
        let several = self.profile.multisample.is_some()
            && matches!(config.at, EvaluatedAt::Sample | EvaluatedAt::Centroid);
        if several || matches!(config.correction, Correction::ConstantW { .. }) {
            return Err(QuadError::Place(channel.to_owned()));
        }
        let mut drawing = Drawing::default();
        self.draw(Input::Shaded(triangle, values), &mut drawing)?;
        // By row and column of the quad.
        let mut quads = BTreeMap::new();
        for Span { y, x0, x1 } in &drawing.spans {
            for x in *x0..*x1 {
                let quad = quads.entry((y & !1, x & !1)).or_insert([false; 4]);
                quad[(y % 2 * 2 + x % 2) as usize] = true;
            }
        }
        let rows = quads
            .keys()
            .flat_map(|(y, x)| [0, 1].map(|row| Span { y: y + row, x0: *x, x1: x + 2 }));
        let rows: Vec<Span> = rows.collect();
        let mut codes = Vec::new();
        if !rows.is_empty() {
            let wanted: Vec<bool> = (0..channels.len()).map(|n| n == number).collect();
            let turned = triangle.area2() < 0;
            let triangle = triangle.normalised();
            self.codes_along((&triangle, turned), values, (&wanted, &rows), &mut |_, _, row| {
                codes.push(row.iter().map(|codes| [codes[0], codes[1]]).collect::<Vec<_>>());
            });
        }
        let quads = quads.into_iter().zip(codes.chunks_exact(2));
        let quad = |(((y, x), covered), rows): (_, &[Vec<[i64; 2]>])| {
            let codes = rows[0].iter().zip(&rows[1]);
            let codes = codes.map(|([a, b], [c, d])| [*a, *b, *c, *d]).collect();
            Quad { x, y, covered, codes }
        };
        Ok(quads.map(quad).collect())
    }
}

//! Crow's scanline: the sides of a primitive cut row by row, exactly, by integer remainders, and
//! spans between them. Draws polygons, too. Spec clauses `A-2` and `A-9`.

mod form;

pub(super) use form::KIND;

use super::carry::Spans;
use super::painter::{Painter, drawable};
use super::{Carrier, DrawError, Input, Machine, Ports, Sink, Target, Work};
use crate::cover::{FillRule, fits_narrow, polygon, scan};
use crate::format::{Role, Unreduced, WordFormat};
use crate::setup::{Polygon, Triangle, VertexConfig};
use crate::value::Depth;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The machine of `[form.scanline]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct ScanlineConfig {
    /// Who owns samples on an edge.
    pub rule: FillRule,
}

/// Exact spans between the sides of a triangle.
#[derive(Clone, Debug)]
pub struct Scanline {
    config: ScanlineConfig,
    depth: Option<Depth>,
    target: Target,
    narrow: bool,
    ports: Ports,
}

impl ScanlineConfig {
    /// Bits of a side's word: the numerator that is divided once a side.
    pub const fn width(vertex: &VertexConfig) -> u32 {
        2 * vertex.difference_bits() + 1
    }
}

impl Scanline {
    /// A machine of validated parts.
    pub fn new(
        config: ScanlineConfig,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
    ) -> Self {
        let difference = vertex.difference_bits();
        let word = WordFormat::signed(difference).fraction(vertex.sub_pixel);
        let side = [Role::SIDE_X, Role::SIDE_Y, Role::SIDE_RUN, Role::SIDE_RISE];
        let setup = (0..3).flat_map(|k| side.map(|role| role.of(k, word))).collect();
        let ports = Ports::triangle(vertex, setup, depth);
        Self { config, depth, target, narrow: fits_narrow(difference), ports }
    }

    /// The spans of a triangle, top to bottom, without values: the quickest exact coverage.
    pub fn cover(&self, triangle: &Triangle, row: impl FnMut(u32, u32, u32)) {
        let Target { grid, clip, .. } = &self.target;
        scan(&triangle.xy, grid, *clip, self.config.rule, self.narrow, row);
    }
}

impl Scanline {
    /// Coverage by parity. Three points have a plane, more need not have one, so there is no depth.
    fn polygon(&self, shape: &Polygon, out: &mut dyn Sink) -> Result<(), DrawError> {
        if shape.z.is_some() {
            return Err(DrawError::PolygonDepth { machine: KIND.name });
        }
        let Target { grid, clip, .. } = &self.target;
        let mut open: Option<[u32; 3]> = None;
        polygon(&shape.xy, grid, *clip, self.config.rule, &mut |y, x0, x1| match &mut open {
            // Runs that touch are one.
            Some([row, _, end]) if *row == y && *end == x0 => *end = x1,
            other => {
                if let Some([y, x0, x1]) = other.replace([y, x0, x1]) {
                    out.span(y, x0, x1, &[]);
                }
            }
        });
        if let Some([y, x0, x1]) = open {
            out.span(y, x0, x1, &[]);
        }
        Ok(())
    }
}

impl Machine for Scanline {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        Some(&Spans)
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        if let Input::Polygon(polygon) = input {
            return self.polygon(polygon, out);
        }
        let Some(triangle) = drawable(input.triangle()?, out) else { return Ok(()) };
        let mut painter = Painter::new(self.depth.as_ref(), &triangle, &self.target);
        let sides = || {
            let v = triangle.xy;
            let sides = (0..3).flat_map(|k| {
                let (mut top, mut bottom) = (v[k], v[(k + 1) % 3]);
                if bottom[1] < top[1] {
                    (top, bottom) = (bottom, top);
                }
                [top[0], top[1], bottom[0] - top[0], bottom[1] - top[1]]
            });
            let sub_pixel = self.target.grid.sub_pixel;
            sides.map(|raw| Unreduced::new(raw, sub_pixel)).collect()
        };
        painter.announce(sides, out);
        let mut work = Work::default();
        let mut done = Ok(());
        self.cover(&triangle, |y, x0, x1| {
            work.rows += 1;
            work.visits += u64::from(x1 - x0);
            if done.is_ok() {
                done = painter.span(y, x0, x1, out);
            }
        });
        work.steps = work.visits;
        out.work(&work);
        done
    }
}

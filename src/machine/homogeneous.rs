//! Homogeneous recursive descent: vertices that are neither projected nor clipped, edge functions
//! and clip-plane distances straight from them, and a window halved until two by two samples are
//! left. Spec clauses `A-2` and `A-8`.

mod descent;
mod form;

pub(super) use form::KIND;

use super::carry::Planes;
use super::painter::Painter;
use super::{Carrier, DrawError, Input, Machine, Ports, Sink, Target, Work};
use crate::cover::FillRule;
use crate::format::{Column, ReadOut, Role, Unreduced, WordFormat};
use crate::setup::{ClipSetup, ClipTriangle, Linear, VertexConfig, linear_at};
use crate::value::Depth;
use descent::Descent;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The machine of `[form.homogeneous]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct HomogeneousConfig {
    /// Who owns samples on an edge.
    pub rule: FillRule,
    /// Bits of a vertex's W, without its sign.
    pub w: u32,
}

/// A homogeneous machine that cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum HomogeneousError {
    /// W needs a bit.
    #[error("w = 0: 1 <= w is needed, because a projected vertex has W = 1")]
    NoW,
    /// The plane outgrows 128-bit arithmetic.
    #[error(
        "2 * (vertex difference bits + w) + (depth bits + w) + interpolation + reciprocal bits + 4 \
         = 2 * ({difference} + {w}) + ({integer} + {w}) + {interpolation} + {reciprocal} + 4 = \
         {sum} > 126: set-up does not fit exact 128-bit arithmetic; use fewer bits for w"
    )]
    Growth {
        /// Bits of a vertex difference.
        difference: u32,
        /// Bits of W.
        w: u32,
        /// Depth bits.
        integer: u32,
        /// Interpolation bits.
        interpolation: u32,
        /// Bits of the reciprocal, or 0.
        reciprocal: u32,
        /// Their sum.
        sum: u64,
    },
}

impl HomogeneousConfig {
    /// Checks growth; `depth` is the depth accumulator's format, if there is one, and the bits of
    /// its reciprocal.
    ///
    /// # Errors
    /// [`HomogeneousError`] names the violated inequality.
    pub fn validate(
        &self,
        vertex: &VertexConfig,
        depth: Option<(ReadOut, u32)>,
    ) -> Result<(), HomogeneousError> {
        let (difference, w) = (vertex.difference_bits(), self.w);
        let (integer, interpolation, reciprocal) =
            depth.map_or((0, 0, 0), |(read, bits)| (read.integer(), read.fraction(), bits));
        if w == 0 {
            return Err(HomogeneousError::NoW);
        }
        let [difference64, w64] = [difference, w].map(u64::from);
        let value = u64::from(integer + interpolation + reciprocal);
        let sum = 2 * (difference64 + w64) + w64 + value + 4;
        if sum > 126 {
            return Err(HomogeneousError::Growth {
                difference,
                w,
                integer,
                interpolation,
                reciprocal,
                sum,
            });
        }
        Ok(())
    }

    /// The most bits of W that a profile allows, at most 16.
    pub fn widest_w(vertex: &VertexConfig, depth: Option<(ReadOut, u32)>) -> u32 {
        let fits =
            |w: &u32| Self { rule: FillRule::TopLeft, w: *w }.validate(vertex, depth).is_ok();
        (1..=16).rev().find(fits).unwrap_or(1)
    }

    /// Bits of an edge function over the window.
    pub const fn edge_width(&self, vertex: &VertexConfig) -> u32 {
        2 * (vertex.difference_bits() + self.w) + 1
    }
}

/// The window descended into.
#[derive(Clone, Debug)]
pub struct Homogeneous {
    config: HomogeneousConfig,
    depth: Option<Depth>,
    difference: u32,
    target: Target,
    ports: Ports,
}

impl Homogeneous {
    /// A machine of validated parts.
    pub fn new(
        config: HomogeneousConfig,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
    ) -> Self {
        let difference = vertex.difference_bits();
        let s = vertex.sub_pixel;
        let whole = WordFormat::signed(config.edge_width(vertex)).fraction(2 * s);
        let slope = WordFormat::signed(difference + 2 * config.w + 2).fraction(s);
        let column = |role: Role, k, word, what| Column {
            meaning: format!("Edge {k}, {what}."),
            ..role.of(k, word)
        };
        let edge = |k| {
            [
                column(Role::EDGE_INIT, k, whole, "value at the window's corner"),
                column(Role::EDGE_DX, k, slope, "step per sub-pixel to the right"),
                column(Role::EDGE_DY, k, slope, "step per sub-pixel downward"),
            ]
        };
        let setup = (0..3).flat_map(edge).collect();
        let ports = Ports::triangle(vertex, setup, depth);
        Self { config, depth, difference, target, ports }
    }

    /// Refuses coordinates that would outgrow the arithmetic.
    fn accept(&self, triangle: &ClipTriangle) -> Result<(), DrawError> {
        let check = |what, value: i128, bits: u32| {
            let limit = 1i128 << bits;
            if (-limit..=limit).contains(&value) {
                Ok(())
            } else {
                Err(DrawError::Range { what, value, low: -limit, high: limit })
            }
        };
        let w = self.config.w;
        for [x, y, own] in triangle.xyw {
            check("X", x, self.difference - 1 + w)?;
            check("Y", y, self.difference - 1 + w)?;
            check("W", own, w)?;
        }
        let integer = self.depth.map_or(0, |depth| depth.read_out().integer());
        triangle.z.into_iter().flatten().try_for_each(|z| check("Z", z, integer + w))
    }

    /// The functions that are not negative at a covered sample: three edges with the rule's bias,
    /// and for vertices as they come the distances from the near and the far plane.
    fn functions(&self, setup: &ClipSetup, clipped: bool) -> Vec<Linear> {
        let biased = setup.edges.iter().map(|&[a, b, c]| {
            let owns = self.config.rule.owns([b, -a]);
            [a, b, if owns { c } else { c - 1 }]
        });
        let mut functions: Vec<Linear> = biased.collect();
        if let (true, Some(depth), Some(near)) = (clipped, self.depth, setup.depth) {
            let maximum = i128::from(depth.read_out().maximum());
            let far = [-near[0], -near[1], maximum * setup.determinant - near[2]];
            functions.extend([near, far]);
        }
        functions
    }
}

impl Machine for Homogeneous {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        Some(&Planes)
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let (mut triangle, clipped) = match input {
            Input::Clip(triangle) => (**triangle, true),
            other => (ClipTriangle::projected(other.triangle()?), false),
        };
        // A machine without depth does not look at it.
        triangle.z = triangle.z.filter(|_| self.depth.is_some());
        self.accept(&triangle)?;
        let Some(setup) = triangle.setup() else {
            out.zero_area();
            return Ok(());
        };
        let grid = &self.target.grid;
        let mut painter = Painter::over(self.depth.as_ref(), |depth| {
            let f = setup.depth?;
            let numerators = [linear_at(&f, grid.offset), f[0], f[1]];
            Some(depth.plane_over(numerators, setup.determinant, grid))
        });
        // With W = 1 an edge function counts sub-pixels squared, and its steps sub-pixels.
        let (square, step) = (2 * grid.sub_pixel, grid.sub_pixel);
        let edges = setup.edges.map(|[a, b, c]| {
            [Unreduced::new(c, square), Unreduced::new(a, step), Unreduced::new(b, step)]
        });
        painter.announce(|| edges.concat(), out);
        let mut work = Work::default();
        let functions = self.functions(&setup, clipped);
        for [y, x0, x1] in Descent::new(&functions, &self.target).runs(&mut work) {
            painter.span(y, x0, x1, out)?;
        }
        out.work(&work);
        Ok(())
    }
}

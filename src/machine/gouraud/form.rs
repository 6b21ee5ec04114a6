//! The machine `gouraud` as a profile configures it. Spec clauses `A-2` and `A-3`.

use super::Gouraud;
use crate::cover::FillRule;
use crate::exact::{PlaneNumerator, Rational, dyadic, integer, ratio};
use crate::format::{Clamp, ReadOut, Refused, Value};
use crate::machine::{
    Carries, Count, Datapath, EdgeWalkConfig, EveryLinear, Face, FormError, Intake, Kind, Machine,
    Operations, Polygons, RasterState, Rasterizer, Site, Step, Steps, Unit, Word, rounding_error,
};
use num_traits::Signed;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::{Deref, DerefMut};

/// What is known of the machine.
pub(crate) const KIND: Kind = Kind {
    name: "gouraud",
    known_as: "GTX",
    clause: "A-3",
    intake: Intake::Triangles,
    polygons: Polygons::Depth,
    decisions: EdgeWalkConfig::DECISIONS,
    adopt: |from, state| Some(GouraudConfig(EdgeWalkConfig::adopted(from, state)).into()),
};

/// The machine of `[form.gouraud]`: the x word of its edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(transparent)]
pub struct GouraudConfig(pub EdgeWalkConfig);

impl From<EdgeWalkConfig> for GouraudConfig {
    fn from(config: EdgeWalkConfig) -> Self {
        Self(config)
    }
}

impl Deref for GouraudConfig {
    type Target = EdgeWalkConfig;

    fn deref(&self) -> &EdgeWalkConfig {
        &self.0
    }
}

impl DerefMut for GouraudConfig {
    fn deref_mut(&mut self) -> &mut EdgeWalkConfig {
        &mut self.0
    }
}

/// Depth down the edges and along the span: a start and a slope an edge, a slope a span.
fn operations(state: &RasterState) -> Operations {
    let mut operations = EdgeWalkConfig::operations();
    if let Some(depth) = &state.depth {
        let edge = Count::new(2, 2, 2, 0);
        operations.triangle = operations.triangle + edge.times(3) + Count::depth_bias_alone(depth);
        operations.row = operations.row + Count::STEP.times(2);
        // The span's slope, and the part of a pixel to its first sample.
        operations.run = Count::new(2, 0, 1, 0) + Count::new(2, 1, 0, 0);
        operations.fragment = Count::STEP + Count::read_out(depth.clamp);
    }
    operations
}

/// The longest walk that a bound is for.
struct Walk {
    /// Columns and rows of samples, from the first one on.
    columns: i128,
    rows: i128,
    /// Lowest and highest x of a vertex, in sub-pixels.
    x: [i128; 2],
    sub_pixel: u32,
    /// The largest error of one rounding of the value.
    ulp: Rational,
}

impl GouraudConfig {
    /// H u (2^-F + |G| 2^-f) + L u 2^-F, clause `A-3`; `None` where a walked x can leave its word.
    fn walked_bound(&self, walk: &Walk, steepest: &Rational) -> Option<Rational> {
        let rows = integer(walk.rows + 2);
        let x_off = &rows * rounding_error(self.rounding, self.fraction);
        let word = ReadOut::new(self.guard, self.integer, self.fraction, Clamp::Guard).ok()?;
        let (lowest, limit) = word.range();
        let [low, high] = walk.x.map(|end| dyadic(end, walk.sub_pixel));
        if low - &x_off < dyadic(lowest, self.fraction)
            || high + &x_off >= dyadic(limit, self.fraction)
        {
            return None;
        }
        // The left cut can lie beyond the box by the error of x.
        let length = integer(walk.columns + 1) + (&x_off).max(&integer(1));
        Some(rows * &walk.ulp + steepest * x_off + length * &walk.ulp)
    }
}

impl Rasterizer for GouraudConfig {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, state: &RasterState) -> Result<(), FormError> {
        self.check_word(&KIND, state)?;
        self.validate_values(&state.vertex, state.depth_read_out())
            .map_err(|error| FormError::own(&KIND, &[], error))
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        let Site { depth, target, .. } = site;
        let word = self.check_word(&KIND, state)?;
        Ok(Box::new(Gouraud::new(self.0, word, depth, &state.vertex, target)))
    }

    /// A walked edge's left end owns its pixel.
    fn rule(&self) -> FillRule {
        FillRule::TopLeft
    }

    fn covers_exactly(&self, _: &RasterState) -> bool {
        false
    }

    fn walks_a_plane(&self) -> bool {
        false
    }

    fn words(&self, state: &RasterState) -> Vec<Word> {
        vec![self.word(state)]
    }

    fn datapath(&self, state: &RasterState) -> Option<Datapath> {
        let mut units = vec![self.unit()];
        if let Some(depth) = &state.depth {
            let along = Unit::span_depth(depth);
            units.extend([Unit::linear("edge-depth", along.width).times(2), along]);
        }
        let (setup_bits, operations) = (self.setup_bits(state), operations(state));
        Some(Datapath { units, setup_bits, operations })
    }

    fn depth_bound(
        &self,
        state: &RasterState,
        face: &Face<'_>,
        exact: &PlaneNumerator,
    ) -> Option<Rational> {
        let depth = state.depth?;
        let [x0, y0, x1, y1] = face.bounds.map(i128::from);
        // The walk begins at the first sample of the triangle, also outside the window.
        let [x, y] = [0, 1].map(|axis| face.triangle.extent(axis));
        let first = |axis, extent| face.grid.pixels(axis, extent).0;
        let (left, top) = (x0.min(first(0, x)), y0.min(first(1, y)));
        let walk = Walk {
            columns: x1 - left,
            rows: y1 - top,
            x: x.into(),
            sub_pixel: face.grid.sub_pixel,
            ulp: rounding_error(depth.rounding, depth.interpolation),
        };
        let pixel = integer(1 << face.grid.sub_pixel);
        self.walked_bound(&walk, &(ratio(exact.slope[0], exact.whole)?.abs() * pixel))
    }

    /// The same for the largest box and the steepest slope.
    fn window_bound(&self, value: &EveryLinear) -> Option<Rational> {
        let ([columns, rows], [low, high]) = (value.window, value.vertices);
        // Pixels above and to the left of the window in which a walk can begin.
        let before = low.map(|end| 0.max(-(end >> value.sub_pixel)));
        let walk = Walk {
            columns: columns + before[0],
            rows: rows + before[1],
            x: [low[0], high[0]],
            sub_pixel: value.sub_pixel,
            ulp: rounding_error(value.rounding, value.fraction),
        };
        self.walked_bound(&walk, &value.steepest)
    }

    fn may_misplace(&self, face: &Face<'_>, at: [i128; 2]) -> Option<bool> {
        Some(self.near_an_edge(face, at))
    }

    fn neighbours(&self) -> Vec<Step> {
        let mut steps = Steps::of(self, Into::into);
        self.steps(&mut steps, |config| &mut config.0);
        steps.found()
    }

    fn carries(&self) -> Carries {
        Carries::AtItsSample
    }

    fn check_carried(
        &self,
        state: &RasterState,
        channel: &str,
        read: ReadOut,
        _: u32,
    ) -> Result<(), FormError> {
        let grown = self.validate_values(&state.vertex, Some(read));
        grown.map_err(|error| FormError::own(&KIND, &[], format!("channel {channel:?}: {error}")))
    }

    fn decision(&self, name: &str) -> Option<Value> {
        self.walk_decision(name)
    }

    fn decide(&mut self, name: &str, value: &Value, _: &RasterState) -> Result<(), Refused> {
        self.walk_decide(name, value)
    }

    fn walk(&self) -> Option<&EdgeWalkConfig> {
        Some(self)
    }

    fn walk_mut(&mut self) -> Option<&mut EdgeWalkConfig> {
        Some(self)
    }
}

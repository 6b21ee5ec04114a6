//! The machine `barycentric` as a profile configures it. Spec clauses `A-2` and `A-6`.

use super::{Barycentric, BarycentricConfig, BarycentricError};
use crate::bits::Rounding;
use crate::cover::{EdgeWordConfig, FillRule};
use crate::exact::{PlaneNumerator, Rational, dyadic, integer};
use crate::format::{ReadOut, Refused, Value};
use crate::machine::{
    Carries, Count, Datapath, EveryLinear, Face, FormError, Intake, Kind, Machine, Operations,
    Polygons, RasterState, Rasterizer, Site, Step, Steps, Unit, Word, edge_words, rounding_error,
};

/// What is known of the machine.
pub(crate) const KIND: Kind = Kind {
    name: "barycentric",
    known_as: "InfiniteReality",
    clause: "A-6",
    intake: Intake::Triangles,
    polygons: Polygons::Refused,
    decisions: EdgeWordConfig::DECISIONS,
    // The approximate walk has the vertex field's integer bits as fraction, a coordinate one bit more than
    // depth has below its guard.
    adopt: |from, state| {
        let config = BarycentricConfig {
            walk_fraction: state.vertex.integer.min(40),
            coordinate: state.depth.map_or(24, |depth| depth.integer + depth.interpolation + 1),
            rounding: state.depth.map_or(Rounding::NearestEven, |depth| depth.rounding),
            edge: edge_words::adopted(from, state),
        };
        Some(config.into())
    },
};

/// One side of the approximate walk: direction, differences, rows, start and slope.
fn side() -> Count {
    let rows = Count::new(1, 0, 0, 0) + Count::PIXELS + Count::TEST;
    let differences = Count::new(2, 0, 0, 0);
    Count::TEST + differences + rows + Count::new(2, 0, 0, 0) + Count::new(1, 2, 2, 0)
}

impl BarycentricConfig {
    /// The approximate walk leaves candidates; each is decided by the edge words.
    fn operations(&self, state: &RasterState) -> Operations {
        let rows = Count::EXTENT + Count::PIXELS + Count::CLIP;
        // Both ends of both sides: the step, the slack, the sample's offset.
        let ends = Count::new(4, 0, 0, 2).times(2);
        let edges = Count::edge_setup(self.edge.rule).times(3);
        let mut operations = Operations {
            triangle: Count::AREA + rows + side().times(3) + edges,
            row: ends + Count::CLIP + Count::JUMP.times(3),
            visit: Count::sample(),
            ..Operations::default()
        };
        if let Some(depth) = &state.depth {
            // Depth from two shares: their planes once a triangle, two products and two sums a fragment.
            // Of a share: gradient by differences, offset to the first sample, three quotients.
            let share = Count::new(2, 0, 0, 0) + Count::new(4, 3, 0, 0) + Count::new(0, 0, 3, 0);
            operations.triangle = operations.triangle
                + share.times(2)
                + Count::new(2, 0, 0, 0)
                + Count::depth_bias_alone(depth);
            operations.run = Count::JUMP.times(2);
            let weighed = Count::STEP.times(2) + Count::new(2, 2, 0, 0);
            operations.fragment = weighed + Count::read_out(depth.clamp);
        }
        operations
    }
}

impl BarycentricConfig {
    /// The largest error of a coordinate after so many roundings; `None` where its word, which ends at 2, can wrap
    /// inside a triangle.
    fn share_error(&self, roundings: i128) -> Option<Rational> {
        let error = integer(roundings) * rounding_error(self.rounding, self.coordinate);
        (error < integer(1)).then_some(error)
    }
}

impl Rasterizer for BarycentricConfig {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, state: &RasterState) -> Result<(), FormError> {
        self.validate(&state.vertex, state.depth_read_out())
            .map_err(|error| FormError::own(&KIND, error.field(), error))?;
        let reason = "its walk down the sides looks for samples, and misses squares that a side only touches";
        edge_words::refuse_conservative(self.edge, &KIND, &["edge"], reason)
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        let Site { depth, target, processor } = site;
        Ok(Box::new(Barycentric::new(*self, depth, &state.vertex, target, processor)))
    }

    fn rule(&self) -> FillRule {
        self.edge.rule
    }

    fn covers_exactly(&self, state: &RasterState) -> bool {
        edge_words::hold_all(self.edge, self.exact_edge_width(state))
    }

    fn walks_a_plane(&self) -> bool {
        false
    }

    fn words(&self, state: &RasterState) -> Vec<Word> {
        let facts = [
            ("resolution", format!("2^-{}", self.coordinate)),
            ("rounding", self.rounding.to_string()),
        ];
        let share = Word::new("share", [("integer", 2), ("fraction", self.coordinate)], facts);
        vec![edge_words::word(self.edge, state), share]
    }

    fn datapath(&self, state: &RasterState) -> Option<Datapath> {
        let mut units = vec![Unit::planar("edge", self.edge.width).times(3)];
        // Its multipliers are combinational: they are in the operations, not here.
        units.extend(
            state.depth.as_ref().map(|depth| {
                Unit::planar("share", self.coordinate_width()).times(2).clamped(depth)
            }),
        );
        let setup_bits = edge_words::setup_bits(self.edge, state);
        Some(Datapath { units, setup_bits, operations: self.operations(state) })
    }

    fn depth_bound(
        &self,
        state: &RasterState,
        face: &Face<'_>,
        _: &PlaneNumerator,
    ) -> Option<Rational> {
        let depth = state.depth?;
        let [_, _, x1, y1] = face.bounds.map(i128::from);
        let share = self.share_error(1 + x1 + y1)?;
        let z = face.triangle.z.unwrap_or_default();
        let rise = integer((z[1] - z[0]).abs() + (z[2] - z[0]).abs());
        Some(rise * share + dyadic(1, depth.interpolation))
    }

    /// Two differences of vertex values, weighted by coordinates that have this plane's error: clause `A-6`.
    fn window_bound(&self, value: &EveryLinear) -> Option<Rational> {
        let share = self.share_error(value.window[0] + value.window[1] - 1)?;
        Some(integer(2) * &value.rise * share + dyadic(1, value.fraction))
    }

    fn may_misplace(&self, _: &Face<'_>, _: [i128; 2]) -> Option<bool> {
        Some(false)
    }

    fn neighbours(&self) -> Vec<Step> {
        let mut steps = Steps::of(self, Into::into);
        edge_words::steps(&mut steps, "edge.", |config| &mut config.edge);
        steps.found()
    }

    fn carries(&self) -> Carries {
        Carries::Anywhere
    }

    fn check_carried(
        &self,
        _: &RasterState,
        channel: &str,
        read: ReadOut,
        scale: u32,
    ) -> Result<(), FormError> {
        let (coordinate, interpolation) = (self.coordinate, read.fraction());
        let integer = read.integer() + scale;
        if coordinate + integer + interpolation + 4 <= 126 {
            return Ok(());
        }
        let error = BarycentricError::Sum { coordinate, integer, interpolation };
        Err(FormError::own(&KIND, error.field(), format!("channel {channel:?}: {error}")))
    }

    fn decision(&self, name: &str) -> Option<Value> {
        edge_words::decision(self.edge, name)
    }

    fn decide(&mut self, name: &str, value: &Value, state: &RasterState) -> Result<(), Refused> {
        self.edge.width = edge_words::decided(name, value, self.exact_edge_width(state))?;
        Ok(())
    }

    fn edge(&self) -> Option<&EdgeWordConfig> {
        Some(&self.edge)
    }

    fn edge_mut(&mut self) -> Option<&mut EdgeWordConfig> {
        Some(&mut self.edge)
    }

    fn exact_edge_width(&self, state: &RasterState) -> Option<u32> {
        state.exact_edge_width(&self.edge, 1)
    }
}

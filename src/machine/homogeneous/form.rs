//! The machine `homogeneous` as a profile configures it. Spec clauses `A-2` and `A-8`.

use super::{Homogeneous, HomogeneousConfig};
use crate::cover::FillRule;
use crate::exact::{PlaneNumerator, Rational};
use crate::format::{ReadOut, Refused, Value};
use crate::machine::{
    Carries, Count, Datapath, Face, FormError, Intake, Kind, Machine, Operations, Polygons,
    RasterState, Rasterizer, Site, Step, Steps, Unit, Word, edge_words, plane_bound,
};
use crate::setup::VertexConfig;
use crate::value::{DepthBias, DepthConfig};

/// What is known of the machine.
pub(crate) const KIND: Kind = Kind {
    name: "homogeneous",
    known_as: "recursive descent",
    clause: "A-8",
    intake: Intake::Triangles,
    polygons: Polygons::Refused,
    decisions: &[],
    // W has as many bits as fit, at most 16.
    adopt: |from, state| {
        let w = HomogeneousConfig::widest_w(&state.vertex, depth(state));
        Some(HomogeneousConfig { rule: from.rule(), w }.into())
    },
};

/// The depth accumulator's format and the bits of its reciprocal.
fn depth(state: &RasterState) -> Option<(ReadOut, u32)> {
    Some((state.depth_read_out()?, state.depth?.division.growth()))
}

impl HomogeneousConfig {
    /// Cross products and a determinant, no projection, no clipping, no bounding box.
    fn operations(self) -> Operations {
        let cross = Count::new(3, 6, 0, 0);
        let determinant = Count::new(2, 3, 0, 2);
        let owns = match self.rule {
            FillRule::TopLeft | FillRule::Shadow => Count::TEST.times(3) + Count::new(1, 0, 0, 0),
        };
        Operations {
            triangle: (cross + owns).times(3) + determinant,
            // The value at the block's corner, how far it goes either way, and two signs.
            tile: (Count::JUMP + Count::new(4, 2, 0, 4) + Count::TEST.times(2)).times(3),
            visit: (Count::JUMP + Count::TEST).times(3),
            ..Operations::default()
        }
    }
}

impl HomogeneousConfig {
    /// Whether a depth bias can be set up for vertices that are not projected. Spec clause `Z-7`.
    fn check_bias(
        self,
        vertex: &VertexConfig,
        depth: &DepthConfig,
        bias: DepthBias,
    ) -> Result<(), String> {
        if depth.is_float() && bias.constant != 0 {
            return Err("bias constant counts steps of a float, which depend on the largest z of the triangle, \
                        but homogeneous vertices need not have a z; use constant = 0, a format of integers, or \
                        another machine"
                .to_owned());
        }
        let (slope, sub_pixel) = (bias.slope_bits(), vertex.sub_pixel);
        let (difference, w) = (vertex.difference_bits(), self.w);
        let DepthConfig { integer, interpolation, .. } = *depth;
        let sum = slope + integer + difference + 3 * w + 2 + sub_pixel + interpolation;
        if slope == 0 || sum <= 120 {
            return Ok(());
        }
        Err(format!(
            "bias slope bits + integer + vertex difference bits + 3 w + 2 + sub-pixel + interpolation = {slope} + \
             {integer} + {difference} + 3 * {w} + 2 + {sub_pixel} + {interpolation} = {sum} > 120: the slope term \
             does not fit exact 128-bit arithmetic; use fewer bits in one of these fields"
        ))
    }
}

impl Rasterizer for HomogeneousConfig {
    fn kind(&self) -> &'static Kind {
        &KIND
    }

    fn check(&self, state: &RasterState) -> Result<(), FormError> {
        self.validate(&state.vertex, depth(state))
            .map_err(|error| FormError::own(&KIND, &["w"], error))?;
        let Some((depth, bias)) = state.depth.and_then(|depth| Some((depth, depth.bias?))) else {
            return Ok(());
        };
        self.check_bias(&state.vertex, &depth, bias)
            .map_err(|message| FormError { field: vec!["depth", "bias"], message })
    }

    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError> {
        let Site { depth, target, .. } = site;
        Ok(Box::new(Homogeneous::new(*self, depth, &state.vertex, target)))
    }

    fn rule(&self) -> FillRule {
        self.rule
    }

    fn covers_exactly(&self, _: &RasterState) -> bool {
        true
    }

    fn walks_a_plane(&self) -> bool {
        true
    }

    fn words(&self, state: &RasterState) -> Vec<Word> {
        vec![Word::exact_edge(self.edge_width(&state.vertex))]
    }

    fn datapath(&self, state: &RasterState) -> Option<Datapath> {
        let width = self.edge_width(&state.vertex);
        let mut units = vec![Unit::planar("edge", width).times(3)];
        units.extend(state.depth.as_ref().map(Unit::depth));
        let operations = self.operations().with_plane(state.depth.as_ref());
        Some(Datapath { units, setup_bits: width + 1, operations })
    }

    fn depth_bound(
        &self,
        state: &RasterState,
        face: &Face<'_>,
        _: &PlaneNumerator,
    ) -> Option<Rational> {
        plane_bound(state, face)
    }

    fn may_misplace(&self, _: &Face<'_>, _: [i128; 2]) -> Option<bool> {
        Some(false)
    }

    fn neighbours(&self) -> Vec<Step> {
        let mut steps = Steps::of(self, Into::into);
        edge_words::rules(&mut steps, "", |config, rule| config.rule = rule);
        steps.found()
    }

    fn carries(&self) -> Carries {
        Carries::Anywhere
    }

    fn decision(&self, _: &str) -> Option<Value> {
        None
    }

    fn decide(&mut self, _: &str, _: &Value, _: &RasterState) -> Result<(), Refused> {
        Err(Refused::Absent)
    }

    fn w_bits(&self) -> Option<u32> {
        Some(self.w)
    }
}

//! One pixel of one triangle, drawn by the model. Spec clause `B-10`.

use super::domain::Question;
use crate::bits::Event;
use crate::cover::{FillRule, Rect};
use crate::exact::{self, Rational, Rule, dyadic, integer};
use crate::machine::DrawError;
use crate::model::{Drawing, Model, PrimitiveError, View};
use crate::profile::Profile;
use crate::scene;
use crate::setup::Triangle;

/// What the model drew at one pixel.
#[derive(Clone, Debug)]
pub(super) struct Shot {
    pub(super) covered: bool,
    /// The depth read out, where covered.
    pub(super) depth: Option<u64>,
    /// Whether the accumulator left its range there.
    pub(super) wrapped: bool,
    /// Set-up words of the machine, depth words last.
    pub(super) setup: Vec<i128>,
    /// The depth accumulator's start bias, in its units.
    start_bias: i128,
}

/// Draws a pixel. `None` where the profile cannot be, or refuses the triangle's vertices.
/// Vertices and pixel are the question's own; the profile is the question's but for its widths.
pub(super) fn shoot(
    question: &Question,
    profile: &Profile,
    triangle: &Triangle,
    pixel: [i128; 2],
) -> Option<Shot> {
    let at = [0, 1].map(|axis| u32::try_from(pixel[axis] - question.origin[axis]).ok());
    let [x0, y0] = [at[0]?, at[1]?];
    let scissor = Some(Rect { x0, y0, x1: x0 + 1, y1: y0 + 1 });
    let model = Model::with_view(profile, View { scissor, ..View::default() }).ok()?;
    let xy = profile.vertex.to_input(triangle.xy.map(|vertex| question.to_model(vertex)));
    let triangle = model.snap(&scene::Triangle::Lattice { xy, z: triangle.z }).ok()?;
    let mut drawing = Drawing::default();
    let drawn = model.draw(&triangle, &mut drawing).map_err(PrimitiveError::from);
    // The mode `error` refuses the triangle where others would wrap.
    let refused = matches!(drawn, Err(PrimitiveError::Draw(DrawError::GuardRange { .. })));
    Some(Shot {
        covered: drawing.samples() == 1 || refused,
        depth: drawing.depth.first().copied(),
        wrapped: drawing.events.total.count(Event::Wrap) > 0 || refused,
        setup: drawing.raw_setup(),
        start_bias: model.depth().map_or(0, crate::value::Depth::start_bias),
    })
}

impl Shot {
    /// The depth accumulator at a pixel of the model's window, without its start bias: the start
    /// and slopes that set-up gave, added up.
    pub(super) fn accumulator(&self, [x, y]: [i128; 2]) -> Option<i128> {
        let [.., start, dx, dy] = self.setup[..] else { return None };
        Some(start + dx * x + dy * y - self.start_bias)
    }
}

/// Whether the exact triangle covers a pixel's sample.
pub(super) fn covers(question: &Question, triangle: &Triangle, pixel: [i128; 2]) -> bool {
    let rule = match question.rule() {
        FillRule::TopLeft => Rule::TopLeft,
        FillRule::Shadow => Rule::Shadow,
    };
    exact::covers(triangle.xy, question.sample(pixel), rule)
}

/// How far the drawn depth accumulator of `fraction` fraction bits lies above the exact plane at a
/// pixel, in ULP.
pub(super) fn depth_error(
    question: &Question,
    shot: &Shot,
    triangle: &Triangle,
    pixel: [i128; 2],
    fraction: u32,
) -> Option<Rational> {
    let at = [0, 1].map(|axis| pixel[axis] - question.origin[axis]);
    let exact = exact::plane_at(triangle.xy, triangle.z?, question.sample(pixel))?;
    Some(dyadic(shot.accumulator(at)?, fraction) - exact)
}

/// `value` as a rational times `2^shift`.
pub(super) fn scaled(value: i128, shift: u32) -> Rational {
    integer(value) * Rational::from_integer(num_bigint::BigInt::from(1) << shift)
}

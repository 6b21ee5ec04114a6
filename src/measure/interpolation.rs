//! What each way to interpolate an attribute costs, and how wrong it is, on a scene.
//! Spec clause `I-8`.
#![allow(clippy::cast_precision_loss, reason = "errors are reported as real numbers")]

use crate::bits::Rounding;
use crate::measure::accuracy::Stage;
use crate::measure::cost::Count;
use crate::scene::Lens;
use crate::value::{Interpolation, InterpolationConfig, Interpolator};
use serde::Serialize;
use std::hint::black_box;
use std::time::Instant;

/// One way on a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InterpolationRow {
    /// The way.
    pub name: &'static str,
    /// Fraction bits of planes, coordinates and result.
    pub fraction: u32,
    /// Bits of the reciprocal, if there is one.
    pub reciprocal: Option<u32>,
    /// Fragments looked at.
    pub fragments: u64,
    /// Largest error against the exact value, in units of a 16-bit attribute.
    pub worst_ulp: f64,
    /// Mean size of the error.
    pub mean_ulp: f64,
    /// Operations a triangle, for one attribute.
    pub triangle: Count,
    /// Operations a fragment.
    pub fragment: Count,
    /// Nanoseconds a fragment, set-up included; absent if it was not asked for.
    pub ns_per_fragment: Option<f64>,
}

/// The attribute at the vertices as given: the largest code at the second.
const U: [i128; 3] = [0, (1 << 16) - 1, 0];
/// Fragments looked at, at most.
const MOST: u64 = 200_000;

/// The ways compared: name, means, operations a triangle and a fragment.
fn ways() -> [(&'static str, Interpolation, Count, Count); 6] {
    let count = |add, multiply, divide| Count { add, multiply, divide, compare: 0 };
    let plane = count(11, 6, 3);
    // Products of two w, and u times one of them.
    let over = plane + plane + count(0, 6, 0);
    [
        ("affine", Interpolation::Affine, plane, count(1, 0, 0)),
        ("divide", Interpolation::Divide, over, count(2, 0, 1)),
        ("reciprocal 12", Interpolation::Reciprocal { bits: 12 }, over, count(2, 1, 1)),
        ("reciprocal 20", Interpolation::Reciprocal { bits: 20 }, over, count(2, 1, 1)),
        ("barycentric", Interpolation::Barycentric, count(2, 9, 0), count(7, 2, 2)),
        ("constant w", Interpolation::ConstantW, over, count(1, 1, 0)),
    ]
}

/// A triangle, its w, and some of its runs.
struct Sampled<'a> {
    face: &'a crate::measure::accuracy::Face,
    w: [i128; 3],
    runs: &'a [crate::model::Span],
}

/// Every way over the fragments of a scene; w comes from depth through the lens, as a part of the
/// far plane's distance in 1/65536, and is constant without one.
pub fn interpolations(
    stage: &Stage,
    lens: Option<Lens>,
    fraction: u32,
    timed: bool,
) -> Vec<InterpolationRow> {
    let mut chosen = Vec::new();
    let mut fragments = 0;
    for face in &stage.faces {
        let runs = &stage.runs[face.runs.clone()];
        let w = match (lens, face.triangle.z) {
            (Some(lens), Some(z)) => z.map(|code| {
                let distance = lens.distance(code as f64 / stage.world.top);
                let lens = lens.finite();
                #[allow(clippy::cast_possible_truncation, reason = "at most 65536")]
                let w = (distance / lens.far * 65_536.0).round() as i128;
                w.clamp(1, 1 << 16)
            }),
            _ => [1; 3],
        };
        if fragments < MOST && !runs.is_empty() {
            fragments += runs.iter().map(|run| u64::from(run.x1 - run.x0)).sum::<u64>();
            chosen.push(Sampled { face, w, runs });
        }
    }
    ways()
        .into_iter()
        .map(|(name, by, triangle, fragment)| {
            let config = InterpolationConfig { by, fraction, rounding: Rounding::NearestEven };
            let begin = Instant::now();
            let mut sum = 0i128;
            each(&chosen, stage, config, &mut |_, _, _, value| sum = sum.wrapping_add(value));
            black_box(sum);
            let elapsed = begin.elapsed().as_secs_f64() * 1e9;
            let (mut worst, mut total, mut count) = (0.0f64, 0.0, 0u64);
            each(&chosen, stage, config, &mut |sampled, x, y, value| {
                let exact = truth(stage, sampled, x, y);
                let error = (value as f64 / f64::from(1u32 << fraction) - exact).abs();
                worst = worst.max(error);
                total += error;
                count += 1;
            });
            InterpolationRow {
                name,
                fraction,
                reciprocal: match by {
                    Interpolation::Reciprocal { bits } => Some(bits),
                    _ => None,
                },
                fragments: count,
                worst_ulp: worst,
                mean_ulp: total / (count.max(1) as f64),
                triangle,
                fragment,
                ns_per_fragment: timed.then(|| elapsed / count.max(1) as f64),
            }
        })
        .collect()
}

fn each(
    chosen: &[Sampled<'_>],
    stage: &Stage,
    config: InterpolationConfig,
    note: &mut dyn FnMut(&Sampled<'_>, u32, u32, i128),
) {
    for sampled in chosen {
        let made = Interpolator::new(config, &sampled.face.triangle, stage.grid, U, sampled.w);
        let Ok(interpolator) = made else { continue };
        for run in sampled.runs {
            for x in run.x0..run.x1 {
                if let Some(value) = interpolator.at(x, run.y, [run.x0, run.x1 - 1]) {
                    note(sampled, x, run.y, value);
                }
            }
        }
    }
}

/// The exact value, from integer weights, divided once.
fn truth(stage: &Stage, sampled: &Sampled<'_>, x: u32, y: u32) -> f64 {
    let at = stage.grid.position(x.into(), y.into());
    let v = sampled.face.triangle.xy;
    let w = sampled.w;
    let weight = |k: usize| {
        let (b, c) = (v[(k + 1) % 3], v[(k + 2) % 3]);
        let area = (c[0] - b[0]) * (at[1] - b[1]) - (c[1] - b[1]) * (at[0] - b[0]);
        area * w[(k + 1) % 3] * w[(k + 2) % 3]
    };
    let weights = [weight(0), weight(1), weight(2)];
    let whole: i128 = weights.iter().sum();
    let above: i128 = weights.iter().zip(U).map(|(weight, u)| weight * u).sum();
    above as f64 / whole as f64
}

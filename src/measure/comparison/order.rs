//! Order against order: what each looks at, and what accumulators that have a path read.
//! Spec clauses `O-1` to `O-4`.

use super::Compared;
use crate::bits::Rounding;
use crate::cover::{Block, Order, Outside, Stamp, TraversalConfig, Visitor};
use crate::format::Clamp;
use crate::machine::{Sink, Work};
use crate::measure::accuracy::Face;
use crate::model::{Model, Span};
use crate::profile::{InvalidProfile, Profile};
use serde::Serialize;
use std::collections::BTreeMap;

/// One order of visits on a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OrderRow {
    /// The order.
    pub order: &'static str,
    /// The stamp.
    pub stamp: &'static str,
    /// Samples evaluated over samples covered.
    pub visits_per_fragment: f64,
    /// Tiles tested as a whole.
    pub tiles: u64,
    /// Unit steps between stamps over stamps visited: 1 is a path that never jumps.
    pub steps_per_stamp: f64,
    /// Samples whose coverage differs from row by row.
    pub coverage_differs: u64,
    /// Samples whose depth differs from row by row, with the profile's wrapping accumulator.
    pub wrapping_differs: u64,
    /// The same with an accumulator that is held in its range at every step.
    pub sticky_differs: u64,
    /// The same with an accumulator of binary32, rounded at every step.
    pub floating_differs: u64,
}

/// Spans and depths of a drawing.
#[derive(Default, PartialEq)]
struct Seen {
    spans: Vec<Span>,
    depth: Vec<u64>,
    work: Work,
}

impl Sink for Seen {
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        self.spans.push(Span { y, x0, x1 });
        self.depth.extend_from_slice(depth);
    }

    fn work(&mut self, work: &Work) {
        self.work.add(work);
    }
}

fn draw(model: &Model, faces: &[Face]) -> Seen {
    let mut seen = Seen::default();
    for face in faces {
        model.draw_own(&face.triangle, &mut seen);
    }
    seen
}

/// Samples of one list of spans that another does not have, and the other way round.
fn differing_samples(a: &Seen, b: &Seen) -> u64 {
    let mut hits: BTreeMap<(u32, u32), i64> = BTreeMap::new();
    for (seen, sign) in [(a, 1), (b, -1)] {
        for span in &seen.spans {
            (span.x0..span.x1).for_each(|x| *hits.entry((span.y, x)).or_default() += sign);
        }
    }
    hits.values().map(|sum| sum.unsigned_abs()).sum()
}

fn differing(a: &[u64], b: &[u64]) -> u64 {
    let pairs = a.iter().zip(b).filter(|(a, b)| a != b).count();
    (pairs + a.len().abs_diff(b.len())) as u64
}

/// Every order with a stamp, on the scene; a machine of edge functions is taken.
///
/// # Errors
/// [`InvalidProfile`] names the violated inequality.
pub fn orders(
    mut compared: Compared,
    stamp: Stamp,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<Vec<OrderRow>, InvalidProfile> {
    let (mut base, stage) = compared.stage("edge-function")?;
    base.traversal = None;
    let faces = &stage.faces;
    let with = |order: Option<Order>, clamp: Option<Clamp>| -> Result<Model, InvalidProfile> {
        let traversal = order.map(|order| TraversalConfig { order, stamp });
        let mut profile = Profile { traversal, ..base.clone() };
        if let (Some(depth), Some(clamp)) = (&mut profile.depth, clamp) {
            depth.clamp = clamp;
        }
        Model::new(&profile)
    };
    let plain = draw(&with(None, None)?, faces);
    let by_rows = Some(Order::BoundingBox);
    let sticky = draw(&with(by_rows, Some(Clamp::Saturate))?, faces);
    let floating =
        float_depths(&base, faces, by_rows.map(|order| TraversalConfig { order, stamp }));
    let mut rows = Vec::new();
    for order in Order::ALL {
        if !go_on() {
            break;
        }
        let seen = draw(&with(Some(order), None)?, faces);
        let held = draw(&with(Some(order), Some(Clamp::Saturate))?, faces);
        let float = float_depths(&base, faces, Some(TraversalConfig { order, stamp }));
        let fragments: u64 = seen.spans.iter().map(|span| u64::from(span.x1 - span.x0)).sum();
        let [width, height] = stamp.size().map(u64::from);
        let stamps = seen.work.visits / (width * height);
        rows.push(OrderRow {
            order: order.name(),
            stamp: stamp.name(),
            visits_per_fragment: ratio(seen.work.visits, fragments),
            tiles: seen.work.tiles,
            steps_per_stamp: ratio(seen.work.steps, stamps),
            coverage_differs: if seen.spans == plain.spans {
                0
            } else {
                differing_samples(&seen, &plain)
            },
            wrapping_differs: differing(&seen.depth, &plain.depth),
            sticky_differs: differing(&held.depth, &sticky.depth),
            floating_differs: differing(&float, &floating),
        });
    }
    Ok(rows)
}

fn ratio(a: u64, b: u64) -> f64 {
    if b == 0 { 0.0 } else { super::real(a) / super::real(b) }
}

/// A depth accumulator of binary32 on its way over one triangle.
struct Floating<'a> {
    edges: &'a crate::cover::EdgeWords,
    plane: [f32; 3],
    size: [u32; 2],
    at: Option<[u32; 2]>,
    value: f32,
    found: BTreeMap<(u32, u32), u64>,
}

impl Floating<'_> {
    fn edge(&self, k: usize, x: u32, y: u32) -> i128 {
        self.edges.at(k, x.into(), y.into()).raw()
    }
}

impl Visitor for Floating<'_> {
    fn stamp(&mut self, x: u32, y: u32) -> Outside {
        let [_, dx, dy] = self.plane;
        match self.at.replace([x, y]) {
            None => self.value = self.plane[0] + dx * float(x) + dy * float(y),
            Some([from_x, from_y]) => {
                for (from, to, slope) in [(from_y, y, dy), (from_x, x, dx)] {
                    (from..to).for_each(|_| self.value += slope);
                    (to..from).for_each(|_| self.value -= slope);
                }
            }
        }
        let [width, height] = self.size;
        let mut outside = Outside { left: true, right: true };
        for (px, py) in (y..y + height).flat_map(|py| (x..x + width).map(move |px| (px, py))) {
            let value = [0, 1, 2].map(|k| self.edge(k, px, py));
            let behind = |sign: i128| {
                (0..3).any(|k| value[k] < 0 && self.edges.dx(k).raw().signum() * sign >= 0)
            };
            outside.left &= behind(1);
            outside.right &= behind(-1);
            if value.iter().all(|value| *value >= 0) {
                let here = self.value + dx * float(px - x) + dy * float(py - y);
                self.found.insert((py, px), here.to_bits().into());
            }
        }
        outside
    }

    fn block(&mut self, _: u32, _: u32, _: u32) -> Block {
        Block::Partly
    }
}

#[allow(clippy::cast_precision_loss, reason = "at most 2^16")]
fn float(value: u32) -> f32 {
    value as f32
}

/// Depth as a binary32 accumulator reads it, triangle by triangle in the order of y then x.
fn float_depths(profile: &Profile, faces: &[Face], traversal: Option<TraversalConfig>) -> Vec<u64> {
    let (Some(edges), Ok(grid), Ok(clip), Some(traversal)) =
        (profile.form.edge(), profile.whole_grid(), profile.window(), traversal)
    else {
        return Vec::new();
    };
    let mut all = Vec::new();
    for face in faces {
        let Some(surface) = &face.depth else { continue };
        let words = edges.words(&face.triangle, &grid);
        let gradient = crate::setup::Gradient::new(&face.triangle, surface.vertex);
        let rounded = crate::setup::Plane::round(
            &gradient,
            grid.offset,
            grid.sub_pixel,
            24,
            Rounding::NearestEven,
            crate::setup::Division::Quotient,
        );
        #[allow(clippy::cast_precision_loss, reason = "rounded to binary32 on purpose")]
        let plane = rounded.raw().map(|value| value as f32 / 16_777_216.0);
        let target = crate::machine::Target { grid, clip, reach: profile.box_reach() };
        let mut visitor = Floating {
            edges: &words,
            plane,
            size: traversal.stamp.size(),
            at: None,
            value: 0.0,
            found: BTreeMap::new(),
        };
        traversal.visit(target.bounds(&face.triangle), &mut visitor);
        all.extend(visitor.found.into_values());
    }
    all
}

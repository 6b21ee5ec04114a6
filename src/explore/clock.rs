//! The software speed of a budget: the model draws a part of a scene, in turn with another profile.

use crate::machine::Sink;
use crate::measure::accuracy::Reference;
use crate::model::Model;
use crate::profile::Profile;
use crate::setup::{Snapped, Triangle};
use std::hint::black_box;
use std::time::Instant;

/// Triangles that a pass draws: evenly spread over the scene.
const TRIANGLES: usize = 512;
/// Covered samples that end a pass of large triangles earlier.
const SAMPLES: u64 = 1 << 15;
/// Pairs of passes; the median counts.
const PAIRS: usize = 3;

/// A part of a scene to draw, and the profile to compare with.
#[derive(Debug)]
pub(super) struct Clock<'a> {
    reference: &'a Reference,
    base: Prepared,
    sources: Vec<usize>,
}

#[derive(Debug)]
struct Prepared {
    model: Model,
    triangles: Vec<Snapped<Triangle>>,
    samples: u64,
}

/// A consumer that looks at every value.
#[derive(Default)]
struct Fold {
    sum: u64,
    samples: u64,
}

impl Sink for Fold {
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        self.samples += u64::from(x1 - x0);
        let sum = depth.iter().fold(u64::from(y ^ x0), |sum, value| sum.wrapping_add(*value));
        self.sum = self.sum.wrapping_add(sum);
    }
}

impl Prepared {
    fn new(reference: &Reference, profile: &Profile, sources: &[usize]) -> Option<Self> {
        let model = Model::new(profile).ok()?;
        let snap = |source: &usize| model.snap(&reference.triangle(*source, profile)).ok();
        let triangles = sources.iter().filter_map(snap).collect();
        let mut prepared = Self { model, triangles, samples: 0 };
        prepared.samples = prepared.draw().samples;
        Some(prepared)
    }

    fn draw(&self) -> Fold {
        let mut fold = Fold::default();
        for triangle in &self.triangles {
            // Under the clamp `error` a refused triangle is part of the work.
            self.model.draw_own(triangle, &mut fold);
        }
        fold
    }

    /// Nanoseconds a covered sample of one pass.
    #[allow(clippy::cast_precision_loss, reason = "a count in a report")]
    fn pass(&self) -> f64 {
        let begin = Instant::now();
        black_box(self.draw().sum);
        begin.elapsed().as_secs_f64() * 1e9 / self.samples as f64
    }
}

impl<'a> Clock<'a> {
    /// A clock for a scene; `None` if the part that would be drawn covers nothing.
    pub(super) fn new(reference: &'a Reference, profile: &Profile) -> Option<Self> {
        let count = reference.triangles.len();
        let step = count.div_ceil(TRIANGLES).max(1);
        let mut sources: Vec<usize> = (0..count).step_by(step).collect();
        let mut base = Prepared::new(reference, profile, &sources)?;
        while base.samples > SAMPLES && sources.len() > 1 {
            sources = sources.into_iter().step_by(2).collect();
            base = Prepared::new(reference, profile, &sources)?;
        }
        (base.samples > 0).then_some(Self { reference, base, sources })
    }

    /// Nanoseconds a sample through a profile, and the median ratio to the base profile.
    pub(super) fn time(&self, profile: &Profile) -> Option<[f64; 2]> {
        let prepared = Prepared::new(self.reference, profile, &self.sources)?;
        if prepared.samples == 0 {
            return None;
        }
        let mut pairs: Vec<[f64; 2]> = (0..PAIRS)
            .map(|_| {
                let (base, own) = (self.base.pass(), prepared.pass());
                [own, own / base]
            })
            .collect();
        Some([0, 1].map(|n| {
            pairs.sort_by(|a, b| a[n].total_cmp(&b[n]));
            pairs[PAIRS / 2][n]
        }))
    }
}

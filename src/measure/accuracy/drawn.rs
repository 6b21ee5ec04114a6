//! What a coverage form draws, against the exact picture. Spec clause `M-4`.

use super::reference::misplaced;
use super::run::{Hits, Side, compare};
use super::stage::{Face, Stage};
use super::tally::Tally;
use crate::cover::EdgeWordConfig;
use crate::machine::{Sink, Target, Work};
use crate::model::{Model, Span};
use crate::profile::{InvalidProfile, Profile};

/// The coverage of a form over a stage.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Samples drawn that are right, face by face; `None` where that is the exact picture.
    both: Option<(Vec<Span>, Vec<usize>)>,
    /// Missing and extra samples, holes and double hits.
    pub tally: Tally,
    /// What finding them took.
    pub work: Work,
    /// Samples that it covered.
    pub covered: u64,
}

/// Collects runs and work.
#[derive(Default)]
pub(super) struct Runs(pub(super) Vec<Span>, pub(super) Work);

impl Sink for Runs {
    fn span(&mut self, y: u32, x0: u32, x1: u32, _: &[u64]) {
        self.0.push(Span { y, x0, x1 });
    }

    fn work(&mut self, work: &Work) {
        self.1.add(work);
    }
}

impl Drawn {
    /// Draws a stage's coverage and compares it with the exact one. Depth plays no part.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn new(stage: &Stage, profile: &Profile) -> Result<Self, InvalidProfile> {
        Self::until(stage, profile, &mut |_, _| true)
            .map(|drawn| drawn.unwrap_or_else(|_| unreachable!("nobody stops it")))
    }

    /// The same, as long as `go_on` of a face and the missing and extra samples so far says so;
    /// otherwise the tally at which it was stopped, without holes and double hits.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn until(
        stage: &Stage,
        profile: &Profile,
        go_on: &mut dyn FnMut(usize, &Tally) -> bool,
    ) -> Result<Result<Self, Tally>, InvalidProfile> {
        let coverage = Profile { depth: None, multisample: None, ..profile.clone() };
        let model = Model::new(&coverage)?;
        let mut runs = Runs::default();
        let (mut both, mut ends) = (Vec::new(), Vec::with_capacity(stage.faces.len()));
        let (mut tally, mut hits) = (Tally::default(), Hits::default());
        let mut covered = 0;
        let rows = profile.form.visits_the_box() && profile.traversal.is_none();
        let boxed = profile.form.edge().filter(|_| rows);
        for (n, face) in stage.faces.iter().enumerate() {
            let exact = &stage.runs[face.runs.clone()];
            // A word that holds every value the walk meets covers what the exact edges do: `B-2`.
            // What other machines look at is known by drawing alone.
            let certain =
                boxed.is_some_and(|edges| needed_width(stage, face, *edges) <= edges.width);
            if certain {
                let [x0, y0, x1, y1] = bounding_box(stage, face);
                let (rows, columns) = (u64::from(y1 - y0), u64::from(x1 - x0));
                runs.1.rows += rows;
                runs.1.visits += rows * columns;
                both.extend_from_slice(exact);
                covered += exact.iter().map(|run| u64::from(run.x1 - run.x0)).sum::<u64>();
            } else {
                runs.0.clear();
                model.draw_own(&face.triangle, &mut runs);
                compare(exact, &runs.0, |side, run| {
                    misplaced(side, run, &mut tally.missing, &mut tally.extra);
                    hits.note(side, run);
                    if side == Side::Both {
                        both.push(run);
                    }
                });
                covered += runs.0.iter().map(|run| u64::from(run.x1 - run.x0)).sum::<u64>();
            }
            if !go_on(n, &tally) {
                return Ok(Err(tally));
            }
            ends.push(both.len());
        }
        (tally.holes, tally.double_hits) = hits.holes_and_doubles();
        let exact = tally.missing == 0;
        Ok(Ok(Self { both: (!exact).then_some((both, ends)), tally, work: runs.1, covered }))
    }

    /// How many of the samples that are drawn and right have depth.
    pub fn depth_samples(&self, stage: &Stage) -> u64 {
        let faces = stage.faces.iter().enumerate().filter(|(_, face)| face.depth.is_some());
        let runs = faces.flat_map(|(n, _)| self.runs(stage, n));
        runs.map(|run| u64::from(run.x1 - run.x0)).sum()
    }

    /// Whether every sample that should be drawn is.
    pub fn is_whole(&self) -> bool {
        self.both.is_none()
    }

    /// The samples of face `index` that are both drawn and right.
    pub fn runs<'a>(&'a self, stage: &'a Stage, index: usize) -> &'a [Span] {
        match &self.both {
            None => &stage.runs[stage.faces[index].runs.clone()],
            Some((runs, ends)) => {
                let begin = index.checked_sub(1).map_or(0, |before| ends[before]);
                &runs[begin..ends[index]]
            }
        }
    }
}

/// The pixels `[x0, y0, x1, y1]` that an edge-function machine visits for a face.
pub fn bounding_box(stage: &Stage, face: &Face) -> [u32; 4] {
    Target { grid: stage.grid, clip: stage.clip, reach: 0 }.bounds(&face.triangle)
}

/// Bits that hold every edge word that drawing a face meets.
pub fn needed_width(stage: &Stage, face: &Face, edges: EdgeWordConfig) -> u32 {
    edges.words(&face.triangle, &stage.grid).bits_over(bounding_box(stage, face))
}

//! The envelope of a picture: a pixel is covered where a triangle covers it. Spec clauses `EN-1` and `EN-6`.

use super::family::{Family, Rasterizer, Way};
use super::raster::{At, at, visit};
use super::rule::{Edges, Rule};
use super::{Class, EnvelopeError, Shape};

/// No way at all.
const NONE: u8 = u8::MAX;

/// What a way says of a pixel before the rule is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    Outside,
    OnEdge,
    Inside,
}

/// A scene in one way. Samples on edges are kept apart, because the rule decides them.
pub(super) struct Picture {
    pub(super) marks: Vec<Mark>,
    /// A pixel's place and the edges of a triangle through its sample, sorted; pixels inside another triangle are
    /// left out.
    pub(super) ties: Vec<(usize, Edges)>,
}

impl Picture {
    pub(super) fn of(family: &Family, way: Way, shapes: &[Shape], window: (u32, u32)) -> Self {
        let size = window.0 as usize * window.1 as usize;
        let (mut marks, mut ties) = (vec![Mark::Outside; size], Vec::new());
        for shape in shapes {
            visit(way.place(shape), way.bits, window, |x, y, at| {
                let n = y as usize * window.0 as usize + x as usize;
                match (at, family.api.rule()) {
                    (At::Inside, _) => marks[n] = Mark::Inside,
                    (At::OnEdge(edges), Some(rule)) => {
                        if rule.takes(edges) {
                            marks[n] = Mark::Inside;
                        }
                    }
                    (At::OnEdge(edges), None) => {
                        if marks[n] != Mark::Inside {
                            marks[n] = Mark::OnEdge;
                            ties.push((n, edges));
                        }
                    }
                }
            });
        }
        ties.retain(|(n, _)| marks[*n] == Mark::OnEdge);
        ties.sort_unstable();
        Self { marks, ties }
    }
}

/// The class of each pixel of a window.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Envelope {
    /// Width and height.
    pub window: (u32, u32),
    /// The first way in which a rule covers the pixel, by rows.
    covers: Vec<u8>,
    /// The first way in which a rule does not.
    misses: Vec<u8>,
    /// Whether some way has the sample only on edges.
    edge: Vec<bool>,
}

impl Envelope {
    /// Draws a scene in every way of a family, on so many threads.
    ///
    /// # Errors
    /// [`EnvelopeError::Window`] for a window without pixels or with too many.
    pub fn of(
        family: &Family,
        shapes: &[Shape],
        window: (u32, u32),
        threads: usize,
    ) -> Result<Self, EnvelopeError> {
        let (width, height) = window;
        let size = u64::from(width) * u64::from(height);
        if size == 0 || size > 1 << 24 {
            return Err(EnvelopeError::Window { width, height });
        }
        let threads = threads.clamp(1, family.ways.len().max(1));
        let mut whole = Self::nothing(window);
        std::thread::scope(|scope| {
            let part = |first| move || Self::part(family, shapes, window, (first, threads));
            let handles: Vec<_> = (0..threads).map(|first| scope.spawn(part(first))).collect();
            for handle in handles {
                match handle.join() {
                    Ok(part) => whole.join(&part),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
        });
        Ok(whole)
    }

    /// The ways from one on, each so many after the one before.
    fn part(
        family: &Family,
        shapes: &[Shape],
        window: (u32, u32),
        (first, every): (usize, usize),
    ) -> Self {
        let mut part = Self::nothing(window);
        for (n, way) in family.ways.iter().enumerate().skip(first).step_by(every) {
            // At most 130 ways.
            let n = u8::try_from(n).unwrap_or(NONE - 1);
            part.add(n, family, &Picture::of(family, *way, shapes, window));
        }
        part
    }

    fn nothing(window: (u32, u32)) -> Self {
        let size = window.0 as usize * window.1 as usize;
        Self { window, covers: vec![NONE; size], misses: vec![NONE; size], edge: vec![false; size] }
    }

    fn add(&mut self, way: u8, family: &Family, picture: &Picture) {
        for (n, mark) in picture.marks.iter().enumerate() {
            match mark {
                Mark::Inside => self.covers[n] = self.covers[n].min(way),
                Mark::Outside => self.misses[n] = self.misses[n].min(way),
                Mark::OnEdge => self.edge[n] = true,
            }
        }
        for ties in picture.ties.chunk_by(|(one, _), (other, _)| one == other) {
            let n = ties[0].0;
            let edges = || ties.iter().map(|(_, edges)| *edges);
            let [covers, misses] = answers(family, edges).map(|rule| rule.is_some());
            if covers {
                self.covers[n] = self.covers[n].min(way);
            }
            if misses {
                self.misses[n] = self.misses[n].min(way);
            }
        }
    }

    fn join(&mut self, other: &Self) {
        for (mine, other) in [(&mut self.covers, &other.covers), (&mut self.misses, &other.misses)]
        {
            for (mine, other) in mine.iter_mut().zip(other) {
                *mine = (*mine).min(*other);
            }
        }
        for (mine, other) in self.edge.iter_mut().zip(&other.edge) {
            *mine |= other;
        }
    }

    /// The classes of all pixels, by rows.
    pub fn classes(&self) -> impl Iterator<Item = Class> {
        let pairs = self.covers.iter().zip(&self.misses);
        pairs.map(|(covers, misses)| Class::of(*covers != NONE, *misses != NONE))
    }

    /// Whether a way has the sample of a pixel only on edges, so that the rule for edges decides it.
    pub(super) fn on_edge(&self, n: usize) -> bool {
        self.edge[n]
    }

    /// How many pixels are MUST, MAY and MUST NOT.
    pub fn count(&self) -> [u64; 3] {
        let mut count = [0; 3];
        for class in self.classes() {
            count[class as usize] += 1;
        }
        count
    }
}

/// A rule that gives a sample on these edges to a triangle, and one that does not.
fn answers<I: Iterator<Item = Edges>>(
    family: &Family,
    triangles: impl Fn() -> I,
) -> [Option<Rule>; 2] {
    let rules = family.rules(triangles().flatten());
    let covered = |rule: &Rule| triangles().any(|edges| rule.takes(edges));
    [true, false].map(|want| rules.iter().copied().find(|rule| covered(rule) == want))
}

/// Two rasterizers that differ in a pixel: one that covers it, and one that does not. Each is the first whose rule
/// has a name, or else the first.
pub fn witness(family: &Family, shapes: &[Shape], pixel: [u32; 2]) -> [Option<Rasterizer>; 2] {
    let mut found: [Option<Rasterizer>; 2] = [None, None];
    for way in &family.ways {
        let seen: Vec<At> =
            shapes.iter().filter_map(|shape| at(way.place(shape), way.bits, pixel)).collect();
        let edges = || {
            seen.iter().filter_map(|at| match at {
                At::OnEdge(edges) => Some(*edges),
                At::Inside => None,
            })
        };
        let any = family.api.rule().unwrap_or(Rule::TOP_LEFT);
        let rules = if seen.contains(&At::Inside) {
            [Some(any), None]
        } else if seen.is_empty() {
            [None, Some(any)]
        } else {
            answers(family, edges)
        };
        for (found, rule) in found.iter_mut().zip(rules) {
            let better =
                |rule: &Rule| found.is_none_or(|old| !old.rule.is_named() && rule.is_named());
            if let Some(rule) = rule.filter(better) {
                *found = Some(Rasterizer { way: *way, rule });
            }
        }
        if found.iter().all(|found| found.is_some_and(|found| found.rule.is_named())) {
            break;
        }
    }
    found
}

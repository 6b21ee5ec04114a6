//! Whether a picture is one that the API allows. Spec clause `EN-6`.

use super::family::{Family, Rasterizer};
use super::rule::Rule;
use super::window::{Envelope, Mark, Picture};
use super::{Class, EnvelopeError, Shape};

/// A pixel that no legal rasterizer draws so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Whether the picture covers it.
    pub covered: bool,
    /// The clause that it breaks.
    pub clause: &'static str,
}

/// What is said of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// Every wrong pixel, by rows.
    pub wrong: Vec<Wrong>,
    /// A rasterizer that draws the whole picture: the first whose rule has a name, or else the first.
    pub drawn_by: Option<Rasterizer>,
    /// In how many ways the picture can be drawn, each with some rule.
    pub ways: usize,
}

/// Compares a picture, covered or not by rows, with an envelope and with each single rasterizer.
///
/// # Errors
/// [`EnvelopeError::Size`] if the picture is not as large as the window.
pub fn check(
    family: &Family,
    shapes: &[Shape],
    envelope: &Envelope,
    picture: (&[bool], (u32, u32)),
) -> Result<Verdict, EnvelopeError> {
    let (covered, (width, height)) = picture;
    let window = envelope.window;
    if (width, height) != window || covered.len() as u64 != u64::from(width) * u64::from(height) {
        return Err(EnvelopeError::Size { width, height, window });
    }
    let mut wrong = Vec::new();
    for (n, (class, seen)) in envelope.classes().zip(covered).enumerate() {
        if (class, *seen) == (Class::Must, false) || (class, *seen) == (Class::MustNot, true) {
            let at = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
            let pixel = [at(n % width as usize), at(n / width as usize)];
            // A sample on an edge has to be missing in both triangles of the edge to be missing.
            let clause = if !seen && envelope.on_edge(n) { "EN-5" } else { "EN-4" };
            wrong.push(Wrong { pixel, covered: *seen, clause });
        }
    }
    let mut verdict = Verdict { wrong, drawn_by: None, ways: 0 };
    if verdict.wrong.is_empty() {
        for way in &family.ways {
            let drawn = Picture::of(family, *way, shapes, window);
            if let Some(rule) = explain(family, &drawn, covered) {
                let old = verdict.drawn_by.map(|old| old.rule.is_named());
                if old.is_none_or(|named| !named && rule.is_named()) {
                    verdict.drawn_by = Some(Rasterizer { way: *way, rule });
                }
                verdict.ways += 1;
            }
        }
    }
    Ok(verdict)
}

/// A rule by which a scene in one way is the picture.
fn explain(family: &Family, drawn: &Picture, covered: &[bool]) -> Option<Rule> {
    let agrees = drawn.marks.iter().zip(covered).all(|(mark, covered)| match mark {
        Mark::Inside => *covered,
        Mark::Outside => !covered,
        Mark::OnEdge => true,
    });
    if !agrees {
        return None;
    }
    let rules = family.rules(drawn.ties.iter().flat_map(|(_, edges)| *edges));
    rules.into_iter().find(|rule| {
        let mut pixels = drawn.ties.chunk_by(|(one, _), (other, _)| one == other);
        pixels.all(|ties| ties.iter().any(|(_, edges)| rule.takes(*edges)) == covered[ties[0].0])
    })
}

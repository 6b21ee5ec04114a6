//! The coverage of edge words of many widths, without a model for each: the words of a triangle at the samples
//! of its box, mod 2^N. A test beside it ties it to the machine.

use super::picture::Picture;
use crate::cover::{EdgeWordConfig, Rect};
use crate::machine::Target;
use crate::model::Model;
use crate::setup::Triangle;

/// A normalised triangle on the samples of a machine that looks at those of its box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boxed {
    triangle: Triangle,
    area: Rect,
}

/// The edge words of a triangle: at the first sample of its box, and their steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Narrow {
    area: Rect,
    /// Start, step right and step down of each edge, mod 2^64.
    edges: [[i64; 3]; 3],
    /// Places above a word in 64 bits.
    above: u32,
}

impl Boxed {
    /// None for a machine that decides coverage by other means.
    pub(super) fn new(model: &Model, triangle: &Triangle) -> Option<Self> {
        let profile = model.profile();
        if !profile.form.visits_the_box() || profile.traversal.is_some() {
            return None;
        }
        let target =
            Target { grid: profile.grid().ok()?, clip: model.clip(), reach: profile.box_reach() };
        // Nothing is drawn without an area, or by the winding before vertices change places.
        let culled = profile.culls(triangle);
        let triangle = triangle.normalised();
        let [x0, y0, x1, y1] = target.bounds(&triangle);
        let x1 = if culled { x0 } else { x1 };
        Some(Self { triangle, area: Rect { x0, y0, x1, y1 } })
    }

    /// Bits that hold every edge word at the samples of the box.
    pub(super) fn needed(&self, model: &Model, words: EdgeWordConfig) -> u32 {
        let Rect { x0, y0, x1, y1 } = self.area;
        let grid = model.profile().grid();
        grid.map_or(u32::MAX, |grid| words.words(&self.triangle, &grid).bits_over([x0, y0, x1, y1]))
    }

    /// The words of some width; none for those that 64 bits do not hold.
    pub(super) fn words(&self, model: &Model, words: EdgeWordConfig) -> Option<Narrow> {
        let values = words.words(&self.triangle, &model.profile().grid().ok()?);
        #[allow(clippy::cast_possible_truncation, reason = "words are mod 2^N, N at most 64")]
        let edges = [0, 1, 2].map(|k| {
            let [start, dx, dy] = values.raw(k);
            let at = start + dx * i128::from(self.area.x0) + dy * i128::from(self.area.y0);
            [at, dx, dy].map(|value| value as i64)
        });
        Some(Narrow { area: self.area, edges, above: 64u32.checked_sub(words.width)? })
    }
}

impl Narrow {
    /// Calls `each` with the pixels of the box and whether they are covered, until it says no.
    fn walk(&self, mut each: impl FnMut(u32, u32, bool) -> bool) -> bool {
        let mut row = self.edges.map(|[start, ..]| start);
        for y in self.area.y0..self.area.y1 {
            let mut at = row;
            for x in self.area.x0..self.area.x1 {
                // The sign bit of a word is inside when it is clear.
                let outside = at.iter().any(|value| value << self.above < 0);
                if !each(x, y, !outside) {
                    return false;
                }
                for (value, [_, dx, _]) in at.iter_mut().zip(&self.edges) {
                    *value = value.wrapping_add(*dx);
                }
            }
            for (value, [_, _, dy]) in row.iter_mut().zip(&self.edges) {
                *value = value.wrapping_add(*dy);
            }
        }
        true
    }

    /// Whether they cover what a picture shows, whose covered and known pixels are `count`.
    pub(super) fn agrees(&self, [covered, known]: &[Picture; 2], count: u32) -> bool {
        let mut seen = 0;
        let inside = self.walk(|x, y, inside| {
            let is_known = known.get(x, y);
            seen += u32::from(is_known && inside);
            !is_known || covered.get(x, y) == inside
        });
        // Outside the box nothing is covered.
        inside && seen == count
    }

    /// Sets what they cover.
    pub(super) fn paint(&self, picture: &mut Picture) {
        self.walk(|x, y, inside| {
            if inside {
                picture.fill(Rect { x0: x, y0: y, x1: x + 1, y1: y + 1 });
            }
            true
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Words;
    use crate::cover::EdgeStorage;
    use crate::explore::identify::picture::Picture;
    use crate::scene;

    /// Edge words of any width cover what the machine covers, and are as wide as is said.
    #[test]
    fn narrow_words_cover_what_the_machine_covers() {
        let base = crate::profile::load("sgi-4k").unwrap();
        let mut wraps = 0;
        for case in 0..2000 {
            let mut words = Words::new(5, 0, case);
            let mut profile = base.clone();
            profile.depth = None;
            (profile.window.width, profile.window.height) = (40, 24);
            profile.vertex.sub_pixel = 3 + u32::try_from(words.draw() % 4).unwrap();
            let edge = profile.form.edge_mut().unwrap();
            edge.storage = [EdgeStorage::Full, EdgeStorage::Shifted][(case % 2) as usize];
            edge.width = 6 + u32::try_from(words.draw() % 18).unwrap();
            let config = *edge;
            let model = Model::new(&profile).unwrap();
            let end = 44i64 << profile.vertex.sub_pixel;
            let xy = [0, 1, 2].map(|_| [0, 1].map(|_| words.between(0, end)));
            let triangle = model.snap(&scene::Triangle::Lattice { xy, z: None }).unwrap();
            let mut drawn = Picture::empty((40, 24));
            model.draw(&triangle, &mut drawn).unwrap();
            let boxed = Boxed::new(&model, &triangle).unwrap();
            let narrow = boxed.words(&model, config).unwrap();
            let mut painted = Picture::empty((40, 24));
            narrow.paint(&mut painted);
            assert_eq!(painted, drawn, "{xy:?} {config:?}");
            let mut known = Picture::empty((40, 24));
            known.fill(model.clip());
            assert!(narrow.agrees(&[drawn.clone(), known.clone()], drawn.count()));
            let mut other = drawn.clone();
            let at = Rect { x0: 7, y0: 5, x1: 8, y1: 6 };
            other.fill(at);
            assert_eq!(narrow.agrees(&[other.clone(), known], other.count()), other == drawn);
            // A word that is wide enough covers what the widest covers.
            profile.form.edge_mut().unwrap().width = 60;
            let mut wide = Picture::empty((40, 24));
            Model::new(&profile).unwrap().draw(&triangle, &mut wide).unwrap();
            if boxed.needed(&model, config) <= config.width {
                assert_eq!(wide, drawn);
            } else {
                wraps += u32::from(wide != drawn);
            }
        }
        assert!(wraps > 100, "{wraps}");
    }
}

//! The triangles of a bench: directed classes, those of the scene, random ones.

use super::{Group, Source, TestAt, cut};
use crate::case::triangle::{self, Directed, Stimulus};
use crate::case::{Words, place};
use crate::setup::Triangle;

/// Triangles by test.
#[derive(Clone, Debug)]
pub(super) struct Triangles {
    directed: Vec<Directed>,
    scene: Vec<Triangle>,
    stimulus: Stimulus,
    seed: u64,
    random: Random,
    groups: Vec<Group>,
}

/// What a bench asks for beside the directed classes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Random {
    /// Rows asked for in a walk file for each random or scene test.
    pub(super) rows_per_test: u64,
    /// Class of the random words.
    pub(super) class: u64,
    /// Extent of a random triangle in pixels, if it is bounded.
    pub(super) reach: Option<i128>,
}

impl Triangles {
    /// Those that `fits` accepts.
    pub(super) fn new(source: &Source, random: Random, fits: impl Fn(&Triangle) -> bool) -> Self {
        let stimulus = Stimulus::new(&source.profile);
        let mut directed = stimulus.directed();
        for class in &mut directed {
            class.triangles.retain(&fits);
        }
        directed.retain(|class| !class.triangles.is_empty());
        // The columns of a vertex hold zeros where the scene has no depth: so it has a depth of 0.
        let flat = source.profile.depth.map(|_| [0; 3]);
        let with_depth = |triangle: &Triangle| Triangle { z: triangle.z.or(flat), ..*triangle };
        let scene: Vec<Triangle> = source.scene.iter().map(with_depth).filter(fits).collect();
        let share = source.count / random.rows_per_test;
        let mut groups: Vec<Group> = directed
            .iter()
            .map(|class| Group { class: class.class, tests: class.triangles.len() as u64 })
            .collect();
        groups.push(Group { class: triangle::SCENE, tests: share.min(scene.len() as u64) });
        groups.push(Group { class: triangle::RANDOM, tests: share });
        cut(&mut groups, source.count);
        Self { directed, scene, stimulus, seed: source.seed, random, groups }
    }

    pub(super) fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The vertices of a test.
    pub(super) fn at(&self, at: TestAt) -> Triangle {
        if let Some(class) = self.directed.get(at.group) {
            return class.triangles[place(at.index)];
        }
        if at.group == self.directed.len() {
            return self.scene[scattered(at.index, self.scene.len())];
        }
        let words = Words::new(self.seed, self.random.class, at.index);
        self.stimulus.random(words, self.random.reach)
    }

    /// In words, for a person.
    pub(super) fn describe(&self, at: TestAt) -> String {
        let Triangle { xy, z } = self.at(at);
        let vertex = |(n, [x, y]): (usize, [i128; 2])| {
            let z = z.map_or_else(String::new, |z| format!(", {}", z[n]));
            format!(" ({x}, {y}{z})")
        };
        let vertices: String = xy.into_iter().enumerate().map(vertex).collect();
        format!("triangle{vertices} in sub-pixels and depth codes")
    }
}

/// Scene triangle number `index`, scattered over the whole scene: a stride that shares no factor
/// with the length visits each once a lap, whatever the size of the set.
fn scattered(index: u64, length: usize) -> usize {
    let length = length as u64;
    // The length plus one shares no factor with the length.
    let near = (length * 5 / 8..=length + 1).find(|n| num_integer::gcd(*n, length) == 1);
    let stride = near.unwrap_or_else(|| unreachable!("gcd(n + 1, n) = 1"));
    let at = u128::from(index) * u128::from(stride) % u128::from(length);
    place(u64::try_from(at).unwrap_or_else(|_| unreachable!("{at} < {length}")))
}

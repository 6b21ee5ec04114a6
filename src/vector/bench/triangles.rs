//! The triangles of a bench: directed classes, those of the scene, random ones.

use super::{Group, Source, TestAt, cut};
use crate::case::engine::Drawn;
use crate::case::triangle::{self, Stimulus};
use crate::case::{Directed, Words, place};
use crate::setup::Triangle;

/// What a test gives.
#[derive(Clone, Debug)]
pub(super) enum Given {
    /// Vertices.
    Triangle(Triangle),
    /// Set-up words that no vertices need give.
    Words(Drawn),
}

/// Triangles by test.
#[derive(Clone, Debug)]
pub(super) struct Triangles {
    directed: Vec<Directed<Given>>,
    /// With their numbers in the scene.
    scene: Vec<(usize, Triangle)>,
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
    /// Those that `fits` accepts, with set-up words before them and `more` after the directed classes;
    /// `rows` says how many rows a directed test has.
    pub(super) fn new(
        source: &Source,
        random: Random,
        (words, more): (Vec<Directed<Drawn>>, Option<Directed<Triangle>>),
        fits: impl Fn(&Triangle) -> bool,
        rows: impl Fn(&Given) -> u64,
    ) -> Self {
        let stimulus = Stimulus::new(&source.profile);
        let words = words.into_iter().map(|class| Directed {
            class: class.class,
            tests: class.tests.into_iter().map(Given::Words).collect(),
        });
        let triangles = stimulus.directed().into_iter().chain(more).map(|class| Directed {
            class: class.class,
            tests: class.tests.into_iter().filter(&fits).map(Given::Triangle).collect(),
        });
        let mut directed: Vec<Directed<Given>> = words.chain(triangles).collect();
        directed.retain(|class| !class.tests.is_empty());
        directed.insert(0, Directed::core(&directed, rows));
        // The columns of a vertex hold zeros where the scene has no depth: so it has a depth of 0.
        let flat = source.profile.depth.map(|_| [0; 3]);
        let with_depth = |triangle: &Triangle| Triangle { z: triangle.z.or(flat), ..*triangle };
        let scene = source.scene.iter().map(with_depth).enumerate();
        let scene: Vec<(usize, Triangle)> = scene.filter(|(_, triangle)| fits(triangle)).collect();
        let share = source.count / random.rows_per_test;
        let mut groups: Vec<Group> = directed
            .iter()
            .map(|class| Group { class: class.class, tests: class.tests.len() as u64 })
            .collect();
        groups.push(Group { class: triangle::SCENE, tests: share.min(scene.len() as u64) });
        groups.push(Group { class: triangle::RANDOM, tests: share });
        cut(&mut groups, source.count);
        Self { directed, scene, stimulus, seed: source.seed, random, groups }
    }

    pub(super) fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The number in the scene of the triangle of a test, where it comes from the scene.
    pub(super) fn number(&self, at: TestAt) -> Option<usize> {
        (at.group == self.directed.len()).then(|| self.of_scene(at).0)
    }

    fn of_scene(&self, at: TestAt) -> (usize, Triangle) {
        self.scene[scattered(at.index, self.scene.len())]
    }

    /// What a test gives.
    pub(super) fn at(&self, at: TestAt) -> Given {
        if let Some(class) = self.directed.get(at.group) {
            return class.tests[place(at.index)].clone();
        }
        Given::Triangle(if at.group == self.directed.len() {
            self.of_scene(at).1
        } else {
            let words = Words::new(self.seed, self.random.class, at.index);
            self.stimulus.random(words, self.random.reach)
        })
    }
}

impl Given {
    /// In words, for a person.
    pub(super) fn describe(&self) -> String {
        match self {
            Self::Triangle(Triangle { xy, z }) => {
                let vertex = |(n, [x, y]): (usize, &[i128; 2])| {
                    let z = z.map_or_else(String::new, |z| format!(", {}", z[n]));
                    format!(" ({x}, {y}{z})")
                };
                let vertices: String = xy.iter().enumerate().map(vertex).collect();
                format!("triangle{vertices} in sub-pixels and depth codes")
            }
            Self::Words(Drawn { bounds: [x0, y0, x1, y1], .. }) => {
                format!("set-up words over the box x {x0} to {x1}, y {y0} to {y1}")
            }
        }
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

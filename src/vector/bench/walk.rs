//! The `dda` and `edge` benches: a planar DDA with its read-out, and an edge stepper.

use super::rig::OperandRig;
use super::{
    Bench, Coverage, FileSpec, Goal, Group, Rig, Run, Shape, Single, Source, TestAt, TestBench,
};
use crate::case::walk::{self, Pattern, RANDOM_ROWS, SCENE_ROWS, Walk};
use crate::case::{Directed, Words, place};
use crate::cover::SampleGrid;
use crate::format::{Clamp, ReadOut, Role, WordFormat};
use crate::profile::Profile;
use crate::setup::Triangle;
use crate::value::Depth;
use crate::vector::device::{Operands, Stepper, Stimulus, walker};
use crate::vector::table::{RowFormat, Table};

/// Which stepper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WalkKind {
    /// Depth accumulator with clamped read-out.
    Depth,
    /// Edge word with its sign test.
    Edge,
}

/// What a stepper is given: the words of a walk, and its operations clock by clock.
#[derive(Clone, Copy, Debug)]
pub struct WalkTest {
    /// Start, slopes and operations.
    pub walk: Walk,
    /// Clocks, the load included.
    pub rows: u32,
}

impl WalkTest {
    /// A walk, of at most so many rows.
    pub(super) fn within(walk: Walk, limit: u64) -> Self {
        Self { walk, rows: u32::try_from(limit).map_or(walk.rows, |most| walk.rows.min(most)) }
    }

    /// The words of the configuration file.
    pub(super) fn words(&self) -> Vec<i128> {
        vec![self.walk.init, self.walk.dx, self.walk.dy]
    }
}

impl Stimulus for WalkTest {
    type Rows = Single<Table>;
}

/// Tests of a stepper.
#[derive(Clone, Debug)]
pub struct WalkBench {
    kind: WalkKind,
    /// The accumulator and its read-out; of an edge word only the width counts.
    read: ReadOut,
    directed: Vec<Directed<Walk>>,
    scene: Vec<SceneWalk>,
    profile: Profile,
    grid: SampleGrid,
    seed: u64,
    cfg: FileSpec,
    exp: Single<FileSpec>,
    groups: Vec<Group>,
}

/// A triangle of the scene: where its walk begins, and its words at pixel (0, 0).
#[derive(Clone, Debug)]
struct SceneWalk {
    triangle: Triangle,
    /// A word and its slopes: those of the depth plane, or of each edge.
    planes: Vec<[i128; 3]>,
}

impl WalkBench {
    /// The bench of this kind, or `None` if the profile has no such stepper.
    pub fn new(kind: WalkKind, source: &Source) -> Option<Self> {
        let profile = &source.profile;
        let grid = profile.whole_grid().ok()?;
        let depth = depth_of(profile);
        let read = read_out(kind, profile)?;
        let mut directed = match kind {
            WalkKind::Depth => walk::depth(read),
            WalkKind::Edge => walk::edge(read.width()),
        };
        directed.insert(0, Directed::core(&directed, |walk| walk.rows.into()));
        let planes = |triangle: &Triangle| match kind {
            WalkKind::Depth => {
                let plane = depth.zip(triangle.z).map(|(d, z)| d.plane(triangle, z, &grid));
                plane.map(|plane| plane.raw()).into_iter().collect()
            }
            WalkKind::Edge => {
                let words = profile.form.edge().map(|edges| edges.words(triangle, &grid));
                let edge = |k: usize| words.as_ref().map(|w| w.raw(k));
                (0..3).filter_map(edge).collect::<Vec<_>>()
            }
        };
        let scene: Vec<SceneWalk> = source
            .scene
            .iter()
            .map(|triangle| triangle.normalised())
            .filter(|triangle| triangle.area2() > 0)
            .map(|triangle| SceneWalk { planes: planes(&triangle), triangle })
            .filter(|walk| !walk.planes.is_empty())
            .collect();
        let directed_rows: u64 =
            directed.iter().flat_map(|class| &class.tests).map(|walk| u64::from(walk.rows)).sum();
        let rest = source.count.saturating_sub(directed_rows);
        // Half of what is left walks along the scene, the rest is random; the last walk is cut.
        let scene_walks = if scene.is_empty() { 0 } else { rest / 2 / u64::from(SCENE_ROWS) };
        let random_rows = rest - scene_walks * u64::from(SCENE_ROWS);
        let mut groups: Vec<Group> = directed
            .iter()
            .map(|class| Group { class: class.class, tests: class.tests.len() as u64 })
            .collect();
        groups.push(Group { class: walk::SCENE, tests: scene_walks });
        groups.push(Group {
            class: walk::RANDOM,
            tests: random_rows.div_ceil(u64::from(RANDOM_ROWS)),
        });
        let (cfg, exp) = Self::file_specs(kind, read);
        let (profile, seed) = (profile.clone(), source.seed);
        Some(Self { kind, read, directed, scene, profile, grid, seed, cfg, exp, groups })
    }

    /// Which stepper it is for.
    pub fn kind(&self) -> WalkKind {
        self.kind
    }

    /// The accumulator and its read-out.
    pub fn read(&self) -> ReadOut {
        self.read
    }

    /// The profile of the set.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    fn file_specs(kind: WalkKind, read: ReadOut) -> (FileSpec, Single<FileSpec>) {
        let width = read.width();
        let op = Role::OP.column(WordFormat::unsigned(2));
        let word = |role: Role| {
            let fraction = if kind == WalkKind::Depth { read.fraction() } else { 0 };
            role.column(WordFormat::signed(width).fraction(fraction))
        };
        match kind {
            WalkKind::Depth => {
                let cfg = [Role::INIT, Role::DX, Role::DY].map(word).to_vec();
                let out = Role::OUT.column(WordFormat::unsigned(read.integer()));
                let exp = vec![op, word(Role::ACC), out];
                (
                    FileSpec::ordered("dda.cfg", cfg),
                    Single { exp: FileSpec::ordered("dda.exp", exp) },
                )
            }
            WalkKind::Edge => {
                let roles = [Role::WALKED_EDGE_INIT, Role::WALKED_EDGE_DX, Role::WALKED_EDGE_DY];
                let cfg = roles.map(word).to_vec();
                let inside = Role::INSIDE.column(WordFormat::unsigned(1));
                let exp = vec![op, word(Role::WALKED_EDGE), inside];
                (
                    FileSpec::ordered("edge.cfg", cfg),
                    Single { exp: FileSpec::ordered("edge.exp", exp) },
                )
            }
        }
    }

    /// The file of the operand form.
    fn operands(&self) -> FileSpec {
        let word = WordFormat::signed(self.read.width());
        let operands = [Role::BEFORE, Role::ADDEND, Role::AFTER].map(|role| role.column(word));
        let result = self.exp.exp.columns[2].clone();
        let flags = Role::FLAGS.column(WordFormat::unsigned(4));
        let columns = operands.into_iter().chain([result, flags]).collect();
        FileSpec::ordered(self.name(), columns)
    }

    fn walk(&self, at: TestAt) -> Walk {
        if let Some(class) = self.directed.get(at.group) {
            return class.tests[place(at.index)];
        }
        if at.group == self.directed.len() {
            return self.scene_walk(at.index);
        }
        let class = if self.kind == WalkKind::Depth { 1 } else { 2 };
        walk::random(self.read.width(), Words::new(self.seed, class, at.index))
    }

    /// A walk over the pixels of a scene triangle from the corner of its bounding box.
    fn scene_walk(&self, index: u64) -> Walk {
        let count = self.scene.len() as u64;
        let SceneWalk { triangle, planes } = &self.scene[place(index % count)];
        let (x0, x1) = self.grid.pixels(0, triangle.extent(0));
        let (y0, _) = self.grid.pixels(1, triangle.extent(1));
        let width = u32::try_from((x1 - x0).clamp(1, 1 << 16))
            .unwrap_or_else(|_| unreachable!("1 to 2^16 columns"));
        // Each lap over the scene takes another edge.
        let [start, dx, dy] = planes[place(index / count) % planes.len()];
        let init = start.wrapping_add(dx.wrapping_mul(x0)).wrapping_add(dy.wrapping_mul(y0));
        Walk { init, dx, dy, pattern: Pattern::Raster(width), rows: SCENE_ROWS }
    }
}

/// The depth of a profile, if it has any.
fn depth_of(profile: &Profile) -> Option<Depth> {
    let processor = crate::dda::Processor::best();
    profile.evaluator(processor).ok().flatten()
}

/// The accumulator of a stepper of this profile, if it has one.
pub(in crate::vector) fn read_out(kind: WalkKind, profile: &Profile) -> Option<ReadOut> {
    match kind {
        WalkKind::Depth => Some(depth_of(profile)?.read_out()),
        // An edge word has no fraction that is read out and no clamp.
        WalkKind::Edge => profile.form.edge()?.read_out(),
    }
}

impl TestBench for WalkBench {
    type Test = WalkTest;

    fn test(&self, at: TestAt, limit: u64) -> WalkTest {
        WalkTest::within(self.walk(at), limit)
    }

    fn words(&self, test: &WalkTest) -> Vec<i128> {
        test.words()
    }

    fn tables(&self, format: RowFormat) -> (Table, Single<Table>) {
        let table = |spec: &FileSpec| Table::new(format, &spec.columns);
        (table(&self.cfg), self.exp.map(table))
    }
}

impl Bench for WalkBench {
    fn name(&self) -> &str {
        if self.kind == WalkKind::Depth { "dda" } else { "edge" }
    }

    fn files(&self) -> Vec<FileSpec> {
        std::iter::once(&self.cfg).chain(self.exp.list()).cloned().collect()
    }

    fn groups(&self) -> &[Group] {
        &self.groups
    }

    fn rows(&self, at: TestAt) -> Option<u64> {
        Some(match self.directed.get(at.group) {
            Some(class) => u64::from(class.tests[place(at.index)].rows),
            None if at.group == self.directed.len() => u64::from(SCENE_ROWS),
            None => u64::from(RANDOM_ROWS),
        })
    }

    fn reference(&self, format: RowFormat) -> Box<dyn Run + '_> {
        if format != RowFormat::TestFloat {
            return Box::new(Rig::new(self, walker(self.kind, self.read), format));
        }
        let (kind, read) = (self.kind, self.read);
        let operands = Operands(Stepper { kind, port: read.width(), read });
        let write = move |at, limit, table: &mut Table| {
            operands.write(&self.test(at, limit), table);
        };
        Box::new(OperandRig::new(Table::new(format, &self.operands().columns), write))
    }

    fn operand_file(&self) -> Option<FileSpec> {
        Some(self.operands())
    }

    fn shape(&self) -> Shape {
        match self.kind {
            // An edge word is inside or outside, and on the edge (0 or, biased, -1) or not.
            WalkKind::Edge => {
                Shape { zones: [true, false, true], remainders: [true, false, true, false] }
            }
            WalkKind::Depth => {
                // A sticky accumulator never leaves the range. Without guard bits only a sign tells
                // a value below it, and the sign takes one of them away from those above.
                let held = self.read.clamps() && self.read.clamp() != Clamp::Saturate;
                let signed = self.read.clamp() == Clamp::Sign;
                let above = held && self.read.guard() > u32::from(signed);
                let below = held && (self.read.guard() > 0 || signed);
                Shape::of_bits([true, above, below], self.read.fraction())
            }
        }
    }

    fn goals(&self) -> Vec<Goal> {
        let mut goals = super::rig::RECORDS.map(Goal::new).to_vec();
        if self.kind == WalkKind::Depth {
            // A sticky accumulator stays within the integer range.
            let sticky = self.read.clamp() == Clamp::Saturate;
            goals.extend(Coverage::guard_goals(self.read.guard()).into_iter().map(|goal| {
                if sticky && !goal.cell.ends_with(&"0".repeat(self.read.guard().min(6) as usize)) {
                    let top = self.read.top();
                    Goal::never(goal.cell, "G-5", format!("0 <= accumulator < {top} = 2^(i+F)"))
                } else {
                    goal
                }
            }));
        }
        goals
    }

    fn describe(&self, at: TestAt) -> String {
        let walk = self.walk(at);
        let word = |value: i128| {
            let width = self.read.width();
            crate::bits::hex(value.cast_unsigned() & (u128::MAX >> (128 - width)), width)
        };
        let [start, dx, dy] = [walk.init, walk.dx, walk.dy].map(word);
        format!("a walk from {start} by dx {dx}, dy {dy}")
    }

    fn fields(&self, column: &str) -> Vec<(String, u32)> {
        if column == Role::ACC.pattern { super::accumulator_fields(self.read) } else { Vec::new() }
    }
}

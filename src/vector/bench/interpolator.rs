//! The benches `interpolator-NAME`: a component, or 1/w, along a walk, with its read-out. Words and walks are
//! those of a DDA. Spec clause `CH-16`.

use super::rig::NoFiles;
use super::{
    Bench, Coverage, FileSpec, Goal, Group, Rig, Run, Shape, Single, Source, TestAt, TestBench,
    WalkTest,
};
use crate::case::walk::{self, RANDOM_ROWS, Walk};
use crate::case::{Directed, Words, place};
use crate::format::{Role, WordFormat};
use crate::value::InterpolatorUnit;
use crate::vector::device::Interpolates;
use crate::vector::table::{RowFormat, Table};
use crate::vector::units::Units;

/// Class of the words of random walks; a number of the unit is added.
const WALKS: u64 = 32;

/// Tests of an interpolator.
#[derive(Clone, Debug)]
pub struct InterpolatorBench {
    name: String,
    unit: InterpolatorUnit,
    directed: Vec<Directed<Walk>>,
    class: u64,
    seed: u64,
    cfg: FileSpec,
    exp: Single<FileSpec>,
    groups: Vec<Group>,
}

impl InterpolatorBench {
    /// The benches of a profile.
    pub fn all(source: &Source) -> Vec<Self> {
        let units = Units::of(&source.profile).interpolators;
        let numbered = (WALKS..).zip(units);
        numbered.map(|(class, named)| Self::new(named.bench, named.unit, source, class)).collect()
    }

    fn new(name: String, unit: InterpolatorUnit, source: &Source, class: u64) -> Self {
        let offset = unit.offset() << unit.read.fraction();
        // The boundaries of a signed range lie as much lower.
        let moved = |class: Directed<Walk>| {
            let tests = class.tests.into_iter();
            let tests = tests.map(|walk| Walk { init: walk.init.wrapping_sub(offset), ..walk });
            Directed { class: class.class, tests: tests.collect() }
        };
        let mut directed: Vec<_> = walk::depth(unit.read).into_iter().map(moved).collect();
        directed.insert(0, Directed::core(&directed, |walk| walk.rows.into()));
        let rows = |class: &Directed<Walk>| -> u64 {
            class.tests.iter().map(|walk| u64::from(walk.rows)).sum()
        };
        let rest = source.count.saturating_sub(directed.iter().map(rows).sum());
        let group =
            |class: &Directed<Walk>| Group { class: class.class, tests: class.tests.len() as u64 };
        let mut groups: Vec<Group> = directed.iter().map(group).collect();
        let random = rest.div_ceil(u64::from(RANDOM_ROWS));
        groups.push(Group { class: walk::RANDOM, tests: random });
        let word = |role: Role| {
            role.column(WordFormat::signed(unit.read.width()).fraction(unit.fraction()))
        };
        let out = if unit.signed { WordFormat::signed } else { WordFormat::unsigned };
        let out = out(unit.read.integer());
        let op = Role::OP.column(WordFormat::unsigned(2));
        let exp = vec![op, word(Role::ACC), Role::OUT.column(out.fraction(unit.below))];
        let cfg = [Role::INIT, Role::DX, Role::DY].map(word).to_vec();
        Self {
            cfg: FileSpec::ordered(format!("{name}.cfg"), cfg),
            exp: Single { exp: FileSpec::ordered(format!("{name}.exp"), exp) },
            name,
            unit,
            directed,
            class,
            seed: source.seed,
            groups,
        }
    }

    /// What it is for.
    pub(in crate::vector) fn unit(&self) -> InterpolatorUnit {
        self.unit
    }

    fn walk(&self, at: TestAt) -> Walk {
        match self.directed.get(at.group) {
            Some(class) => class.tests[place(at.index)],
            None => {
                walk::random(self.unit.read.width(), Words::new(self.seed, self.class, at.index))
            }
        }
    }
}

impl TestBench for InterpolatorBench {
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

impl Bench for InterpolatorBench {
    fn name(&self) -> &str {
        &self.name
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
            None => u64::from(RANDOM_ROWS),
        })
    }

    fn reference(&self, format: RowFormat) -> Box<dyn Run + '_> {
        if format == RowFormat::TestFloat {
            return Box::new(NoFiles(Coverage::default()));
        }
        Box::new(Rig::new(self, Box::new(Interpolates(self.unit)), format))
    }

    fn shape(&self) -> Shape {
        let read = self.unit.read;
        let signed = read.clamp() == crate::format::Clamp::Sign;
        let above = read.clamps() && read.guard() > u32::from(signed);
        let below = read.clamps() && (read.guard() > 0 || signed);
        Shape::of_bits([true, above, below], read.fraction())
    }

    fn goals(&self) -> Vec<Goal> {
        let mut goals = super::rig::RECORDS.map(Goal::new).to_vec();
        goals.extend(Coverage::guard_goals(self.unit.read.guard()));
        goals
    }

    fn describe(&self, at: TestAt) -> String {
        let walk = self.walk(at);
        let width = self.unit.read.width();
        let word = |value: i128| {
            crate::bits::hex(value.cast_unsigned() & (u128::MAX >> (128 - width)), width)
        };
        let [start, dx, dy] = [walk.init, walk.dx, walk.dy].map(word);
        format!("a walk from {start} by dx {dx}, dy {dy}")
    }

    fn fields(&self, column: &str) -> Vec<(String, u32)> {
        if column != Role::ACC.pattern {
            return Vec::new();
        }
        let (read, below) = (self.unit.read, self.unit.fraction());
        let integer = read.integer() + read.fraction() - below;
        [("guard", read.guard()), ("integer", integer), ("fraction", below)]
            .map(|(name, bits)| (name.to_owned(), bits))
            .to_vec()
    }
}

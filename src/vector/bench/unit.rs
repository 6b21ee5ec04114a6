//! The benches `reciprocal-NAME` and `divider-NAME`: words in, and every word on the way to the result out.
//! Spec clauses `CH-17` and `CH-18`.

mod stimulus;

use super::rig::NoFiles;
use super::{
    Bench, Coverage, FileSpec, Goal, Group, Rig, Run, Shape, Single, Source, TestAt, TestBench,
};
use crate::case::{Directed, Words, place, walk};
use crate::format::{Column, ReadOut, WordFormat};
use crate::profile::Profile;
use crate::value::{Corrector, Refine};
use crate::vector::device::{Computes, Stimulus};
use crate::vector::table::{RowFormat, Table};
use crate::vector::units::{ReciprocalPort, Units};
use std::sync::Arc;

/// Class of the words of random tests; a number of the unit is added.
const RANDOM: u64 = 64;

/// A unit without a state.
#[derive(Clone, Debug)]
pub(in crate::vector) enum UnitKind {
    /// A reciprocal unit.
    Reciprocal(ReciprocalPort),
    /// What divides u/w by 1/w.
    Divider(Box<Corrector>),
}

/// What such a unit is given: the words of the configuration file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnitTest {
    /// q; or the accumulators of u/w and 1/w.
    pub words: [i128; 2],
}

impl Stimulus for UnitTest {
    type Rows = Single<Table>;
}

/// Tests of a reciprocal unit or a divider.
#[derive(Clone, Debug)]
pub struct UnitBench {
    name: String,
    kind: UnitKind,
    profile: Arc<Profile>,
    directed: Vec<Directed<[i128; 2]>>,
    class: u64,
    seed: u64,
    cfg: FileSpec,
    exp: Single<FileSpec>,
    groups: Vec<Group>,
}

impl UnitBench {
    /// The benches of a profile.
    pub fn all(source: &Source) -> Vec<Self> {
        let Units { reciprocals, dividers, .. } = Units::of(&source.profile);
        let profile = Arc::new(source.profile.clone());
        let reciprocals =
            reciprocals.into_iter().map(|named| (named.bench, UnitKind::Reciprocal(named.unit)));
        let dividers = dividers
            .into_iter()
            .map(|named| (named.bench, UnitKind::Divider(Box::new(named.unit))));
        let all = (RANDOM..).zip(reciprocals.chain(dividers));
        all.map(|(class, (name, kind))| {
            let profile = Arc::clone(&profile);
            Self::new(name, kind, profile, source, class)
        })
        .collect()
    }

    fn new(
        name: String,
        kind: UnitKind,
        profile: Arc<Profile>,
        source: &Source,
        class: u64,
    ) -> Self {
        let mut directed = match &kind {
            UnitKind::Reciprocal(port) => stimulus::reciprocal(port),
            UnitKind::Divider(corrector) => stimulus::divider(corrector),
        };
        directed.insert(0, Directed::core(&directed, |_| 1));
        let used: u64 = directed.iter().map(|class| class.tests.len() as u64).sum();
        let group = |class: &Directed<[i128; 2]>| Group {
            class: class.class,
            tests: class.tests.len() as u64,
        };
        let mut groups: Vec<Group> = directed.iter().map(group).collect();
        groups.push(Group { class: walk::RANDOM, tests: source.count.saturating_sub(used) });
        super::cut(&mut groups, source.count);
        let (cfg, exp) = columns(&kind);
        Self {
            cfg: FileSpec::ordered(format!("{name}.cfg"), cfg),
            exp: Single { exp: FileSpec::ordered(format!("{name}.exp"), exp) },
            name,
            kind,
            profile,
            directed,
            class,
            seed: source.seed,
            groups,
        }
    }

    /// What it is for.
    pub(in crate::vector) fn kind(&self) -> &UnitKind {
        &self.kind
    }

    /// The profile of the set.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The names of the words that are answered, in order.
    pub fn answered(&self) -> Vec<String> {
        self.exp.exp.columns.iter().map(|column| column.name.clone()).collect()
    }
}

/// The bits of a number up to `most`.
fn bits(most: u32) -> u32 {
    u32::BITS - most.leading_zeros()
}

fn columns(kind: &UnitKind) -> (Vec<Column>, Vec<Column>) {
    let plain = |bits: u32| WordFormat::unsigned(bits);
    match kind {
        UnitKind::Reciprocal(port) => {
            let config = port.unit.config();
            let (p, m, n) = (config.operand, config.entry, port.unit.bits());
            let mut exp = vec![
                plain(bits(port.width)).column("length", "Bit length of q."),
                plain(p).fraction(p - 1).column("x", "Normalised operand."),
                plain(m).fraction(m).column("entry", "Entry of the table."),
            ];
            match &config.refine {
                Refine::None => {}
                Refine::Linear => {
                    let h = (p - 1 - config.index).max(1);
                    exp.push(
                        plain(m)
                            .fraction(m)
                            .column("far", "The entry at the far end of its interval."),
                    );
                    exp.push(plain(h).column("part", "Bits of x below the index."));
                    exp.push(plain(m).fraction(m).column("fall", "What the line falls up to x."));
                }
                Refine::Newton { bits } => {
                    for (n, b) in (1..).zip(bits) {
                        let word = |bits: u32| plain(bits).fraction(*b);
                        exp.extend([
                            word(b + 1).column(format!("r{n}"), format!("x y of Newton step {n}.")),
                            word(b + 2)
                                .column(format!("t{n}"), format!("2 - r of Newton step {n}.")),
                            word(*b).column(format!("y{n}"), format!("Result of Newton step {n}.")),
                        ]);
                    }
                }
            }
            exp.push(plain(n).column("mantissa", "Result."));
            exp.push(plain(bits(n + port.width - 1)).column("exponent", "1/q is m 2^-exponent."));
            (vec![plain(port.width).column("q", "What is turned into its reciprocal.")], exp)
        }
        UnitKind::Divider(corrector) => {
            let (read, w) = (corrector.read_out(), inverse(corrector));
            let word = |read: ReadOut| WordFormat::signed(read.width()).fraction(read.fraction());
            let either =
                |signed: bool| if signed { WordFormat::signed } else { WordFormat::unsigned };
            let held = |read: ReadOut, signed: bool| {
                either(signed)(read.integer() + read.fraction()).fraction(read.fraction())
            };
            let signed = corrector.config().signed;
            let mut exp = vec![
                held(read, signed).column("p", "u/w as the division sees it."),
                held(w, false).column("q", "1/w as the division sees it."),
            ];
            let below = w.integer() + w.fraction();
            if let Some(unit) = corrector.unit() {
                let n = unit.bits();
                exp.push(plain(n).column("mantissa", "Reciprocal of q; 0 where q is 0."));
                let most = bits(n + below - 1);
                exp.push(plain(most).column("exponent", "1/q is m 2^-exponent; 0 where q is 0."));
            }
            let value = WordFormat::signed(read.integer() + below + 2);
            exp.push(value.column("value", "Rounded, before the clamp; 0 where q is 0."));
            let code = either(signed)(read.integer());
            exp.push(code.column("code", "The code."));
            let cfg = vec![
                word(read).column("acc", "Accumulator of u/w."),
                word(w).column("acc_w", "Accumulator of 1/w."),
            ];
            (cfg, exp)
        }
    }
}

/// The accumulator of 1/w of what divides by it.
fn inverse(corrector: &Corrector) -> ReadOut {
    corrector.w_read_out().unwrap_or_else(|| unreachable!("a divider takes 1/w"))
}

impl UnitBench {
    fn given(&self, at: TestAt) -> [i128; 2] {
        if let Some(class) = self.directed.get(at.group) {
            return class.tests[place(at.index)];
        }
        let words = Words::new(self.seed, self.class, at.index);
        match &self.kind {
            UnitKind::Reciprocal(port) => stimulus::random_operand(port, words),
            UnitKind::Divider(corrector) => stimulus::random_pair(corrector, words),
        }
    }
}

impl TestBench for UnitBench {
    type Test = UnitTest;

    fn test(&self, at: TestAt, _: u64) -> UnitTest {
        UnitTest { words: self.given(at) }
    }

    fn words(&self, test: &UnitTest) -> Vec<i128> {
        test.words[..self.cfg.columns.len()].to_vec()
    }

    fn tables(&self, format: RowFormat) -> (Table, Single<Table>) {
        let table = |spec: &FileSpec| Table::new(format, &spec.columns);
        (table(&self.cfg), self.exp.map(table))
    }
}

impl Bench for UnitBench {
    fn name(&self) -> &str {
        &self.name
    }

    fn files(&self) -> Vec<FileSpec> {
        std::iter::once(&self.cfg).chain(self.exp.list()).cloned().collect()
    }

    fn groups(&self) -> &[Group] {
        &self.groups
    }

    fn rows(&self, _: TestAt) -> Option<u64> {
        Some(1)
    }

    fn reference(&self, format: RowFormat) -> Box<dyn Run + '_> {
        if format == RowFormat::TestFloat {
            return Box::new(NoFiles(Coverage::default()));
        }
        let device = Computes { kind: self.kind.clone(), names: self.answered() };
        Box::new(Rig::new(self, Box::new(device), format))
    }

    fn shape(&self) -> Shape {
        Shape::NONE
    }

    fn goals(&self) -> Vec<Goal> {
        let mut goals = super::rig::RECORDS.map(Goal::new).to_vec();
        if let UnitKind::Divider(corrector) = &self.kind {
            goals.extend(stimulus::goals(corrector));
        }
        goals
    }

    fn describe(&self, at: TestAt) -> String {
        let [a, b] = self.given(at);
        match &self.kind {
            UnitKind::Reciprocal(_) => format!("q = {a}"),
            UnitKind::Divider(_) => format!("accumulators {a} of u/w and {b} of 1/w"),
        }
    }

    fn fields(&self, column: &str) -> Vec<(String, u32)> {
        match (&self.kind, column) {
            (UnitKind::Divider(corrector), "acc") => {
                super::accumulator_fields(corrector.read_out())
            }
            (UnitKind::Divider(corrector), "acc_w") => {
                super::accumulator_fields(inverse(corrector))
            }
            _ => Vec::new(),
        }
    }
}

//! The `dda` and `edge` benches: a planar DDA with its read-out, and an edge stepper.

mod body;
mod quirk;

use super::{Bench, Coverage, FileSpec, Group, Shape, Source, TestAt};
use crate::case::Words;
use crate::case::walk::{self, Directed, Pattern, RANDOM_ROWS, SCENE_ROWS, Walk};
use crate::cover::SampleGrid;
use crate::format::{Clamp, Column, Decode, ReadOut};
use crate::profile::{Profile, neighbours};
use crate::setup::Triangle;
use crate::value::Depth;
use crate::vector::bench::slip::Register;
use crate::vector::table::Table;
use quirk::{Quirk, quirks};
use std::sync::{Arc, Mutex};

/// Which stepper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WalkKind {
    /// Depth accumulator with clamped read-out.
    Depth,
    /// Edge word with its sign test.
    Edge,
}

/// A body on `i64` lanes.
#[derive(Clone, Copy, Debug)]
enum Fast {
    /// A read-out that keeps the whole accumulator.
    Depth(Decode<i64>),
    /// An edge word.
    Edge,
}

/// Tests of a stepper.
#[derive(Clone, Debug)]
pub struct WalkBench {
    kind: WalkKind,
    /// Width of the stimulus words and of the files' columns.
    width: u32,
    /// How the device under this hypothesis reads out; for edges only its width counts.
    read: ReadOut,
    quirk: Quirk,
    /// A slipping device's state before the test of that number.
    memory: Arc<Mutex<Option<(u64, Register)>>>,
    /// The quick body, if the word fits a lane and the device is as specified.
    fast: Option<Fast>,
    directed: Arc<Vec<Directed>>,
    scene: Arc<Vec<Triangle>>,
    profile: Profile,
    depth: Option<Depth>,
    grid: SampleGrid,
    seed: u64,
    files: Vec<FileSpec>,
    groups: Vec<Group>,
}

impl WalkBench {
    /// The bench of this kind, or `None` if the profile has no such stepper.
    pub fn new(kind: WalkKind, source: &Source) -> Option<Self> {
        let profile = &source.profile;
        let grid = profile.grid().ok()?;
        let depth = profile.depth.and_then(|config| {
            Depth::new(config, &profile.vertex, crate::dda::Processor::best()).ok()
        });
        let read = Self::read_out(kind, profile, depth)?;
        let width = read.width();
        let directed = match kind {
            WalkKind::Depth => walk::depth(read),
            WalkKind::Edge => walk::edge(width),
        };
        let scene: Vec<Triangle> = source
            .scene
            .iter()
            .map(|triangle| triangle.normalised())
            .filter(|t| t.area2() > 0 && (kind == WalkKind::Edge || t.z.is_some()))
            .collect();
        let directed_rows: u64 =
            directed.iter().flat_map(|class| &class.walks).map(|walk| u64::from(walk.rows)).sum();
        let rest = source.count.saturating_sub(directed_rows);
        // Half of what is left walks along the scene, the rest is random; the last walk is cut.
        let scene_walks = if scene.is_empty() { 0 } else { rest / 2 / u64::from(SCENE_ROWS) };
        let random_rows = rest - scene_walks * u64::from(SCENE_ROWS);
        let mut groups: Vec<Group> = directed
            .iter()
            .map(|class| Group { class: class.class, tests: class.walks.len() as u64 })
            .collect();
        groups.push(Group { class: walk::SCENE, tests: scene_walks });
        groups.push(Group {
            class: walk::RANDOM,
            tests: random_rows.div_ceil(u64::from(RANDOM_ROWS)),
        });
        let files = Self::file_specs(kind, width, read);
        Some(Self {
            kind,
            width,
            read,
            quirk: Quirk::None,
            memory: Arc::default(),
            fast: Self::fast(kind, read),
            directed: Arc::new(directed),
            scene: Arc::new(scene),
            profile: profile.clone(),
            depth,
            grid,
            seed: source.seed,
            files,
            groups,
        })
    }

    fn read_out(kind: WalkKind, profile: &Profile, depth: Option<Depth>) -> Option<ReadOut> {
        match kind {
            WalkKind::Depth => Some(depth?.read_out()),
            // An edge word has no fraction that is read out and no clamp.
            WalkKind::Edge => profile.form.edge()?.read_out(),
        }
    }

    fn fast(kind: WalkKind, read: ReadOut) -> Option<Fast> {
        match kind {
            WalkKind::Edge => (read.width() <= 64).then_some(Fast::Edge),
            WalkKind::Depth if matches!(read.clamp(), Clamp::Wrap | Clamp::Saturate) => None,
            WalkKind::Depth => read.decode().map(Fast::Depth),
        }
    }

    fn file_specs(kind: WalkKind, width: u32, read: ReadOut) -> Vec<FileSpec> {
        let op = Column::new("op", 2, false, 0, "0 load, 1 step by dx, 2 step by dy, 3 hold.");
        let fraction = if kind == WalkKind::Depth { read.fraction() } else { 0 };
        let word = |name, meaning| Column::new(name, width, true, fraction, meaning);
        match kind {
            WalkKind::Depth => {
                let out = "Read-out after the clamp.";
                let exp = vec![
                    op,
                    word("acc", "Accumulator after the clock edge."),
                    Column::new("out", read.integer(), false, 0, out),
                ];
                let cfg = vec![
                    word("init", "Accumulator that the load takes."),
                    word("dx", "Slope per pixel to the right."),
                    word("dy", "Slope per row downward."),
                ];
                vec![
                    FileSpec { stem: "dda.cfg".to_owned(), columns: cfg },
                    FileSpec { stem: "dda.exp".to_owned(), columns: exp },
                ]
            }
            WalkKind::Edge => {
                let cfg = vec![
                    word("e0", "Edge word that the load takes, bias and shift done."),
                    word("ea", "Step per pixel to the right."),
                    word("eb", "Step per row downward."),
                ];
                let exp = vec![
                    op,
                    word("e", "Edge word after the clock edge."),
                    Column::new("in", 1, false, 0, "1 when the sign bit of e is clear."),
                ];
                vec![
                    FileSpec { stem: "edge.cfg".to_owned(), columns: cfg },
                    FileSpec { stem: "edge.exp".to_owned(), columns: exp },
                ]
            }
        }
    }

    fn walk(&self, at: TestAt) -> Walk {
        if let Some(class) = self.directed.get(at.group) {
            return class.walks[usize::try_from(at.index).unwrap_or(usize::MAX)];
        }
        if at.group == self.directed.len() {
            return self.scene_walk(at.index);
        }
        let class = if self.kind == WalkKind::Depth { 1 } else { 2 };
        walk::random(self.width, Words::new(self.seed, class, at.index))
    }

    /// A walk over the pixels of a scene triangle from the corner of its bounding box.
    fn scene_walk(&self, index: u64) -> Walk {
        let count = self.scene.len() as u64;
        let triangle = self.scene[usize::try_from(index % count).unwrap_or(0)];
        let (x0, x1) = self.grid.pixels(0, triangle.extent(0));
        let (y0, _) = self.grid.pixels(1, triangle.extent(1));
        let width = u32::try_from((x1 - x0).clamp(1, 1 << 16)).unwrap_or(1);
        let pattern = Pattern::Raster(width);
        let (init, dx, dy) = match (self.kind, self.profile.form.edge(), self.depth, triangle.z) {
            (WalkKind::Depth, _, Some(depth), Some(z)) => {
                let plane = depth.plane(&triangle, z, &self.grid);
                (plane.at(x0, y0).raw(), plane.dx().raw(), plane.dy().raw())
            }
            (WalkKind::Edge, Some(edges), ..) => {
                let words = edges.words(&triangle, &self.grid);
                // Each lap over the scene takes another edge.
                let k = usize::try_from(index / count % 3).unwrap_or(0);
                let [_, dx, dy] = words.raw(k);
                (words.at(k, x0, y0).raw(), dx, dy)
            }
            _ => (0, 0, 0),
        };
        Walk { init, dx, dy, pattern, rows: SCENE_ROWS }
    }
}

impl Bench for WalkBench {
    fn name(&self) -> &'static str {
        if self.kind == WalkKind::Depth { "dda" } else { "edge" }
    }

    fn files(&self) -> &[FileSpec] {
        &self.files
    }

    fn groups(&self) -> &[Group] {
        &self.groups
    }

    fn rows(&self, at: TestAt) -> Option<u64> {
        Some(match self.directed.get(at.group) {
            Some(class) => u64::from(class.walks[usize::try_from(at.index).ok()?].rows),
            None if at.group == self.directed.len() => u64::from(SCENE_ROWS),
            None => u64::from(RANDOM_ROWS),
        })
    }

    fn emit(&self, at: TestAt, limit: u64, tables: &mut [Table], coverage: &mut Coverage) {
        let walk = self.walk(at);
        let rows = walk.rows.min(u32::try_from(limit).unwrap_or(u32::MAX));
        if let [operands] = tables {
            self.emit_operands(&walk, rows, operands);
            return;
        }
        let [cfg, exp] = tables else { return };
        cfg.push(&[walk.init, walk.dx, walk.dy]);
        match &self.fast {
            Some(Fast::Depth(decode)) => self.emit_depth(&walk, rows, decode, exp, coverage),
            Some(Fast::Edge) => self.emit_edge(&walk, rows, exp, coverage),
            None => self.emit_plain(&walk, (at.test, rows), exp, coverage),
        }
    }

    fn operand_file(&self) -> Option<FileSpec> {
        let word = |name, meaning| Column::new(name, self.width, true, 0, meaning);
        let result = self.files[1].columns[2].clone();
        let flags = "Bit 0 wrap, 1 clamped above, 2 clamped below, 3 inexact.";
        let columns = vec![
            word("a", "Accumulator before the clock edge, 0 for a load."),
            word("b", "What is added."),
            word("r", "Accumulator after the clock edge."),
            result,
            Column::new("flags", 4, false, 0, flags),
        ];
        Some(FileSpec { stem: self.name().to_owned(), columns })
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

    fn unsettled(&self) -> u64 {
        u64::from(matches!(self.quirk, Quirk::Late | Quirk::LateOut))
    }

    fn describe(&self, at: TestAt) -> String {
        let walk = self.walk(at);
        let word = |value: i128| {
            let bits = value.cast_unsigned() & (u128::MAX >> (128 - self.width));
            crate::bits::hex(bits, self.width)
        };
        let [start, dx, dy] = [walk.init, walk.dx, walk.dy].map(word);
        format!("a walk from {start} by dx {dx}, dy {dy}")
    }

    fn fields(&self, column: &str) -> Vec<(String, u32)> {
        let (guard, integer, fraction) =
            (self.read.guard(), self.read.integer(), self.read.fraction());
        if column == "acc" {
            [("guard", guard), ("integer", integer), ("fraction", fraction)]
                .map(|(name, bits)| (name.to_owned(), bits))
                .to_vec()
        } else {
            Vec::new()
        }
    }

    fn variants(&self) -> Vec<(String, Box<dyn Bench>)> {
        let mut list: Vec<(String, Box<dyn Bench>)> = Vec::new();
        for neighbour in neighbours(&self.profile) {
            let depth = neighbour.profile.depth.and_then(|config| {
                Depth::new(config, &neighbour.profile.vertex, crate::dda::Processor::best()).ok()
            });
            let Some(read) = Self::read_out(self.kind, &neighbour.profile, depth) else { continue };
            if read != self.read {
                // Stimulus and columns stay; only the device changes.
                let bench = Self { read, fast: None, ..self.clone() };
                list.push((neighbour.change, Box::new(bench)));
            }
        }
        for (quirk, name) in quirks(self.kind, self.read) {
            let memory = Arc::default();
            list.push((name, Box::new(Self { quirk, memory, fast: None, ..self.clone() })));
        }
        list
    }
}

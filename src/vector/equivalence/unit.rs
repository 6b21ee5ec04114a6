//! The units that a module is compared with: their signals, operations and parameters.

use crate::format::{ReadOut, Role};
use crate::profile::Profile;
use crate::vector::write::Devices;

/// The unit that a module is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Block {
    /// What is read out of a depth accumulator, without a register.
    ReadOut,
    /// The depth DDA with its read-out.
    Dda,
    /// The edge stepper with its sign test.
    EdgeStepper,
    /// An edge function over a box, sample by sample.
    EdgeEvaluator,
    /// A depth plane over a box, sample by sample.
    DepthEvaluator,
    /// Edge words and plane numerators of a triangle, without the division.
    SetUp,
    /// The divider of the plane, with its rounding: its bits are those of the module.
    Divider,
    /// The engine: set-up words and a box in, runs, samples and a record of each triangle out.
    Engine,
}

/// A signal of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signal {
    /// Its name in a map.
    pub name: &'static str,
    /// Its port in the devices of `hdl` and in the reference.
    pub port: &'static str,
    /// Its bits.
    pub width: u32,
    /// Whether the unit answers it.
    pub output: bool,
}

const fn input(name: &'static str, port: &'static str, width: u32) -> Signal {
    Signal { name, port, width, output: false }
}

const fn output(name: &'static str, port: &'static str, width: u32) -> Signal {
    Signal { name, port, width, output: true }
}

/// A unit of a profile.
pub(super) struct Unit {
    pub(super) block: Block,
    /// Its signals, beside clock and reset.
    pub(super) signals: Vec<Signal>,
    /// The parameters of the device in `hdl`.
    pub(super) parameters: Vec<(&'static str, i128)>,
}

impl Block {
    /// The module of `hdl` and of the reference.
    pub const fn module(self) -> &'static str {
        match self {
            Self::ReadOut => "read_out",
            Self::Dda => "dda",
            Self::EdgeStepper => "edge_stepper",
            Self::EdgeEvaluator => "edge_evaluator",
            Self::DepthEvaluator => "depth_evaluator",
            Self::SetUp => "triangle_setup",
            Self::Divider => "setup_divider",
            Self::Engine => "triangle_engine",
        }
    }

    /// Whether it has registers.
    pub(super) const fn is_clocked(self) -> bool {
        !matches!(self, Self::ReadOut | Self::SetUp)
    }

    /// The operations, in the order of their codes; the first one loads.
    pub(super) const fn operations(self) -> &'static [&'static str] {
        match self {
            Self::ReadOut | Self::SetUp | Self::Divider | Self::Engine => &[],
            Self::Dda | Self::EdgeStepper => &["load", "step-x", "step-y", "hold"],
            Self::EdgeEvaluator | Self::DepthEvaluator => &["corner", "sample", "row", "hold"],
        }
    }
}

impl Unit {
    /// A unit of the devices of a profile.
    pub(super) fn new(block: Block, (profile, devices): (&Profile, &Devices)) -> Self {
        let [read, edge] = devices.registers();
        let [word, out, m] = [read.width(), read.integer(), edge.width()];
        let op = input("op", "op", 2);
        let same = |name, width| input(name, name, width);
        let coordinate = Role::PIXEL_WORD.width();
        let over_a_box = |words: [&'static str; 3], width, answer| {
            let corner = ["box_x_begin", "box_y_begin"].map(|name| same(name, coordinate));
            let words = words.map(|name| same(name, width));
            [vec![op], corner.to_vec(), words.to_vec(), vec![answer]].concat()
        };
        let (signals, parameters) = match block {
            Block::ReadOut => {
                (vec![input("acc", "acc", word), output("out", "out_v", out)], of_read_out(read))
            }
            Block::Dda => (
                vec![
                    op,
                    input("init", "init", word),
                    input("dx", "dx", word),
                    input("dy", "dy", word),
                    output("acc", "acc", word),
                    output("out", "out_v", out),
                ],
                of_read_out(read),
            ),
            Block::EdgeStepper => (
                vec![
                    op,
                    input("e0", "e0", m),
                    input("ea", "ea", m),
                    input("eb", "eb", m),
                    output("e", "e", m),
                    output("in", "in_v", 1),
                ],
                vec![("M", m.into())],
            ),
            Block::EdgeEvaluator => (
                over_a_box(["edge_init", "edge_dx", "edge_dy"], m, output("in", "in_v", 1)),
                vec![("M", m.into()), ("C", coordinate.into())],
            ),
            Block::DepthEvaluator => (
                over_a_box(
                    ["depth_init", "depth_dx", "depth_dy"],
                    word,
                    output("depth", "depth", out),
                ),
                [of_read_out(read), vec![("C", coordinate.into())]].concat(),
            ),
            Block::SetUp => {
                let bits = profile.vertex.bits();
                let parameters = [
                    vec![("VW", bits.into()), ("M", m.into())],
                    of_read_out(read).into_iter().filter(|(name, _)| *name != "MODE").collect(),
                    devices.setup.parameters().to_vec(),
                ];
                (set_up([bits, out, m]), parameters.concat())
            }
            Block::Divider => {
                // The widest of a set-up: the start's numerator, and twice the area (P-5).
                let difference = profile.vertex.bits() + 2;
                let divisor = 2 * difference + 2;
                let numerator = out + divisor + difference + 3 + read.fraction();
                let rounding = devices.depth.rounding.names().code;
                let parameters = [
                    ("NW", numerator.into()),
                    ("DW", divisor.into()),
                    ("ROUNDING", rounding.into()),
                    ("SERIAL", 1),
                ];
                let signals = [
                    same("start", 1),
                    same("numerator", ANY),
                    same("divisor", ANY),
                    output("quotient", "quotient", ANY),
                    output("busy", "busy", 1),
                    output("done", "done", 1),
                ];
                (signals.to_vec(), parameters.to_vec())
            }
            Block::Engine => (
                engine([m, word, out, coordinate]),
                [vec![("M", m.into())], of_read_out(read), vec![("C", coordinate.into())]].concat(),
            ),
        };
        Self { block, signals, parameters }
    }
}

/// A width of its own: what holds each value.
pub(super) const ANY: u32 = 0;

/// The signals of a set-up, of these bits a coordinate, a depth and an edge word.
fn set_up([vertex, depth, edge]: [u32; 3]) -> Vec<Signal> {
    let corner = |names: [&'static str; 3]| {
        [(names[0], vertex), (names[1], vertex), (names[2], depth)]
            .map(|(name, width)| input(name, name, width))
    };
    let mut list: Vec<Signal> =
        [["v0_x", "v0_y", "v0_z"], ["v1_x", "v1_y", "v1_z"], ["v2_x", "v2_y", "v2_z"]]
            .into_iter()
            .flat_map(corner)
            .collect();
    list.extend([
        output("edge0_init", "o_edge0_init", edge),
        output("edge0_dx", "o_edge0_dx", edge),
        output("edge0_dy", "o_edge0_dy", edge),
        output("edge1_init", "o_edge1_init", edge),
        output("edge1_dx", "o_edge1_dx", edge),
        output("edge1_dy", "o_edge1_dy", edge),
        output("edge2_init", "o_edge2_init", edge),
        output("edge2_dx", "o_edge2_dx", edge),
        output("edge2_dy", "o_edge2_dy", edge),
        output("zero_area", "o_zero_area", 1),
        output("area", "area", ANY),
        output("plane_x", "gx", ANY),
        output("plane_y", "gy", ANY),
        output("plane_start", "gz", ANY),
    ]);
    list
}

/// The signals of an engine, of these bits an edge word, a depth word, a depth and a coordinate.
fn engine([edge, word, depth, coordinate]: [u32; 4]) -> Vec<Signal> {
    /// A number of a test, or a count.
    const NUMBER: u32 = 32;
    let takes = |names: &'static [&'static str], width| {
        names.iter().map(move |name| input(name, name, width))
    };
    let gives = |names: &'static [&'static str], width| {
        names.iter().map(move |name| output(name, name, width))
    };
    let mut list = vec![input("in_valid", "in_valid", 1), output("in_ready", "in_ready", 1)];
    list.extend(takes(&["test"], NUMBER));
    list.extend(takes(
        &["edge0_init", "edge0_dx", "edge0_dy", "edge1_init", "edge1_dx", "edge1_dy"],
        edge,
    ));
    list.extend(takes(&["edge2_init", "edge2_dx", "edge2_dy"], edge));
    list.extend(takes(&["depth_init", "depth_dx", "depth_dy"], word));
    list.extend(takes(&["zero_area"], 1));
    list.extend(takes(&["box_y_begin", "box_y_end", "box_x_begin", "box_x_end"], coordinate));
    list.extend(takes(&["span_ready", "sample_ready", "triangle_ready"], 1));
    list.extend(gives(&["span_valid", "sample_valid", "triangle_valid"], 1));
    list.extend(gives(&["span_test", "sample_test", "triangle_test"], NUMBER));
    list.extend(gives(
        &["span_y", "span_x_begin", "span_x_end", "sample_y", "sample_x"],
        coordinate,
    ));
    list.extend(gives(&["sample_depth"], depth));
    list.extend(gives(&["triangle_spans", "triangle_samples"], NUMBER));
    list.extend(gives(&["triangle_zero_area"], 1));
    list
}

/// What the devices of `hdl` are told of a depth accumulator.
fn of_read_out(read: ReadOut) -> Vec<(&'static str, i128)> {
    vec![
        ("G", read.guard().into()),
        ("I", read.integer().into()),
        ("F", read.fraction().into()),
        ("MODE", read.clamp().code().into()),
    ]
}

//! One half of a bench: a device, its two files and their fixed columns.

use super::record::{Field, Record};
use super::rtl::{self, Source};
use super::template::fill;
use super::unit::{self, wire};
use super::{Interface, UnitDevice};
use crate::format::Role;

/// A pair of files that one device answers: walks in, a row of state and output a clock out.
pub(super) struct Half<'a> {
    /// `dda`, `edge` or `interpolator-NAME`.
    pub(super) name: String,
    /// Its module or entity, in either language.
    pub(super) device: String,
    /// What it is in `hdl`; a unit of channels is a module around one of these.
    pub(super) module: Option<&'static Source>,
    /// The same in VHDL.
    pub(super) entity: Option<&'static Source>,
    cfg: &'a Record<'a>,
    /// The file of expectations.
    pub(super) exp: &'a Record<'a>,
    inputs: [&'a Field<'a>; 3],
    /// The column of the device's state.
    pub(super) state: &'a Field<'a>,
    output: &'a Field<'a>,
    /// Widths of the parts of the state from the top down, for reports.
    parts: Vec<u32>,
}

/// What a half is in any set: its name, its device in both languages, and its fixed columns.
struct Shape<'n> {
    name: &'n str,
    device: &'n str,
    module: Option<&'static Source>,
    entity: Option<&'static Source>,
    inputs: [Role; 3],
    state: Role,
    output: Role,
}

const DDA: Shape<'static> = Shape {
    name: "dda",
    device: "dda",
    module: Some(&rtl::DDA),
    entity: Some(&rtl::DDA_VHDL),
    inputs: [Role::INIT, Role::DX, Role::DY],
    state: Role::ACC,
    output: Role::OUT,
};
const EDGE: Shape<'static> = Shape {
    name: "edge",
    device: "edge_stepper",
    module: Some(&rtl::EDGE_STEPPER),
    entity: Some(&rtl::EDGE_STEPPER_VHDL),
    inputs: [Role::WALKED_EDGE_INIT, Role::WALKED_EDGE_DX, Role::WALKED_EDGE_DY],
    state: Role::WALKED_EDGE,
    output: Role::INSIDE,
};

/// The half, if the set has both of its files with all of their fixed columns.
fn half<'a>(records: &'a [Record<'a>], shape: &Shape<'_>, parts: &[u32]) -> Option<Half<'a>> {
    let &Shape { name, device, module, entity, inputs: [in0, in1, in2], state, output } = shape;
    let find =
        |kind: &str| records.iter().find(|record| record.file.name == format!("{name}.{kind}.tv"));
    let (cfg, exp) = (find("cfg")?, find("exp")?);
    exp.field(Role::OP.pattern)?;
    let state = exp.field(state.pattern)?;
    let known = parts.iter().sum::<u32>() == state.column.width;
    Some(Half {
        name: name.to_owned(),
        device: device.to_owned(),
        module,
        entity,
        cfg,
        exp,
        inputs: [cfg.field(in0.pattern)?, cfg.field(in1.pattern)?, cfg.field(in2.pattern)?],
        state,
        output: exp.field(output.pattern)?,
        parts: if known { parts.to_vec() } else { vec![state.column.width] },
    })
}

/// The halves the set has.
pub(super) fn halves<'a>(interface: &Interface, records: &'a [Record<'a>]) -> Vec<Half<'a>> {
    let clamp = &interface.clamp;
    let dda = half(records, &DDA, &[clamp.guard, clamp.integer, clamp.fraction]);
    let edge = half(records, &EDGE, &[]);
    let walks = interface.units.iter().filter(|unit| unit.module == unit::INTERPOLATOR);
    let interpolator = |unit: &UnitDevice| {
        let (name, device) = (unit.bench.as_str(), unit.device());
        half(records, &Shape { name, device: &device, module: None, entity: None, ..DDA }, &[])
    };
    dda.into_iter().chain(edge).chain(walks.filter_map(interpolator)).collect()
}

impl Half<'_> {
    /// The device's parameters as the package has them.
    fn parameters(&self) -> String {
        let width = format!("{}_{}_WIDTH", self.exp.constant(), self.state.constant());
        self.module.map_or_else(String::new, |module| parameters(module, &[("M", width)]))
    }

    /// Highest and lowest bit of each part of the state that is not empty.
    fn slices(&self) -> Vec<(u32, u32)> {
        let mut top = self.state.column.width;
        let parts = self.parts.iter().filter(|&&width| width > 0);
        parts
            .map(|width| {
                top -= width;
                (top + width - 1, top)
            })
            .collect()
    }

    /// What both languages fill in.
    pub(super) fn fill(&self, template: &str, more: &[(&str, &str)]) -> String {
        let state_top = (self.state.column.width - 1).to_string();
        let output_top = (self.output.column.width - 1).to_string();
        let [in0, in1, in2] = self.inputs;
        let text = fill(template, more);
        fill(
            &text,
            &[
                ("HALF", &self.name),
                ("ID", &wire(&self.name)),
                ("DEVICE", &self.device),
                ("CFG", &self.cfg.constant()),
                ("EXP", &self.exp.constant()),
                ("CFG_ID", &self.cfg.id),
                ("EXP_ID", &self.exp.id),
                ("IN0", &in0.id),
                ("IN1", &in1.id),
                ("IN2", &in2.id),
                ("STATE", &self.state.id),
                ("OUT", &self.output.id),
                ("STATE_NAME", &self.state.column.name),
                ("OUT_NAME", &self.output.column.name),
                ("STATE_TOP", &state_top),
                ("IN_TOP", &state_top),
                ("OUT_TOP", &output_top),
            ],
        )
    }

    /// The module that checks this half.
    pub(super) fn systemverilog(&self) -> String {
        let slices = self.slices();
        let bits = |word: &str| join(&slices, ", ", |(msb, lsb)| format!("{word}[{msb}:{lsb}]"));
        let state = &self.state.id;
        self.fill(
            include_str!("tb.walk.sv.in"),
            &[
                ("CFG_FIXED", &text_mask(self.cfg, false)),
                ("CFG_DIGITS", &text_mask(self.cfg, true)),
                ("CFG_PACK", &pack(self.cfg, "cfg_file.nibbles")),
                ("EXP_FIXED", &text_mask(self.exp, false)),
                ("EXP_DIGITS", &text_mask(self.exp, true)),
                ("EXP_PACK", &pack(self.exp, "exp_file.nibbles")),
                ("STATE_FORMAT", &join(&slices, ".", |_| "%b".to_owned())),
                ("STATE_WANT", &bits(&format!("answer.{state}"))),
                ("STATE_GOT", &bits(state)),
                ("PARAMETERS", &self.parameters()),
            ],
        )
    }

    /// The entity that checks this half.
    pub(super) fn vhdl(&self) -> String {
        let slices = self.slices();
        let bits = |word: &str| {
            join(&slices, " & \".\" & ", |(msb, lsb)| {
                format!("to_string({word}({msb} downto {lsb}))")
            })
        };
        let state = &self.state.id;
        self.fill(
            include_str!("tb.walk.vhd.in"),
            &[
                ("CFG_SHAPE", self.cfg.shape().trim_end()),
                ("EXP_SHAPE", self.exp.shape().trim_end()),
                ("STATE_WANT", &bits(&format!("told.want.{state}"))),
                ("STATE_GOT", &bits(state)),
                // The stepper's inside flag is a single wire.
                ("OUT_INDEX", if self.name == "edge" { "(0)" } else { "" }),
            ],
        )
    }
}

/// The parameters of a device, each by its name, set to constants of the package: on request, since a
/// device of one's own need not have them.
pub(super) fn parameters(module: &Source, of_files: &[(&str, String)]) -> String {
    let constant = |name: &str| {
        let found = of_files.iter().find(|(known, _)| *known == name);
        found.map(|(_, constant)| constant.as_str()).or_else(|| rtl::constant(name))
    };
    let set = module.parameters().iter().filter_map(|name| Some((name, constant(name)?)));
    let list: Vec<String> = set.map(|(name, value)| format!(".{name}({value})")).collect();
    format!("\n`ifdef GUARDBIT_PARAMETERS\n        #({})\n`endif\n        ", list.join(", "))
}

fn join<T: Copy>(items: &[T], between: &str, text: impl Fn(T) -> String) -> String {
    items.iter().map(|&item| text(item)).collect::<Vec<_>>().join(between)
}

/// A constant of one byte a character: the separators' own codes, or 01 for each digit.
pub(super) fn text_mask(record: &Record, digits: bool) -> String {
    let byte = |c: char| {
        if (c == '0') == digits { if digits { 1 } else { u32::from(c) } } else { 0 }
    };
    let bytes: Vec<String> = record.shape().chars().map(|c| format!("{:02x}", byte(c))).collect();
    format!("{}'h{}", 8 * record.line, bytes.concat())
}

/// The nibbles of a decoded line, separators left out.
pub(super) fn pack(record: &Record, nibbles: &str) -> String {
    let places = record.shape().chars().rev().collect::<Vec<_>>();
    let digits = (0..places.len()).rev().filter(|&place| places[place] == '0');
    let parts: Vec<String> =
        digits.map(|place| format!("{nibbles}[{}:{}]", 8 * place + 3, 8 * place)).collect();
    let lines: Vec<String> = parts.chunks(4).map(|chunk| chunk.join(", ")).collect();
    format!("{{\n                    {}}}", lines.join(",\n                    "))
}

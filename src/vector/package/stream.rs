//! Benches of devices behind valid/ready streams: one record in, rows of several files out.

mod answer;
mod vhdl;

use super::half::{Half, pack, parameters, text_mask};
use super::record::{Field, Record};
use super::rtl::{self, Source, Values};
use super::template::fill;
use super::{EngineParameters, Interface, SetupParameters, wired};
use crate::format::Role;
use crate::machine::{QuadDevice, RegisterDevice, WiredDevice};
use answer::{Answer, COMPLETE, COMPLETE_ANY, FORGET, MISSING, READY, WATCH};

/// A device, the file that drives it and the files that it answers.
pub(super) struct Stream<'a> {
    /// The bench's name, and the stem of the file that drives it.
    pub(super) name: &'static str,
    device: &'static str,
    /// The modules that the device is made of, itself last.
    parts: &'static [&'static Source],
    /// The same in VHDL; empty if there is no such device.
    entities: &'static [&'static Source],
    /// What its modules are told.
    values: Values,
    /// The parameters whose values the package has as widths of columns, and the names of these constants.
    of_files: Vec<(&'static str, String)>,
    /// Whether answers of a test may come in any order unless the simulation asks for another.
    pub(super) any_order: bool,
    /// A port that the set's column gives another name.
    renamed: Option<(&'static str, &'static str)>,
    cfg: &'a Record<'a>,
    answers: Vec<Answer<'a>>,
}

/// What the summary's events look at is wider than any word of the engine: they are not compared.
const EVENTS: [Role; 4] = [Role::WRAP, Role::CLAMP_ABOVE, Role::CLAMP_BELOW, Role::INEXACT];

/// Names of columns of three vertices or edges.
fn three(roles: [Role; 3]) -> Vec<String> {
    (0..3).flat_map(|k| roles.map(|role| role.name(k))).collect()
}

/// Names of columns.
fn names(roles: &[Role]) -> Vec<String> {
    roles.iter().map(|role| role.name(0)).collect()
}

/// The streams that the set has all files for, and whose device this crate has.
pub(super) fn streams<'a>(interface: &Interface, records: &'a [Record<'a>]) -> Vec<Stream<'a>> {
    let clamp = Values::of_clamp(&interface.clamp);
    let setup = interface.setup.as_ref().ok().and_then(|known| setup(records, &clamp, known));
    let engine = interface.engine.as_ref().ok().and_then(|known| engine(records, &clamp, *known));
    let registers = interface.registers.as_ref().ok().and_then(|known| match known {
        RegisterDevice::Quads(known) => quads(records, known),
        RegisterDevice::Wired(device) => wired_stream(records, device),
    });
    setup.into_iter().chain(engine).chain(registers).collect()
}

/// Set-up words of edge functions and a depth plane.
fn words() -> Vec<String> {
    let plane = [Role::DEPTH_INIT, Role::DEPTH_DX, Role::DEPTH_DY, Role::ZERO_AREA];
    [three([Role::EDGE_INIT, Role::EDGE_DX, Role::EDGE_DY]), names(&plane)].concat()
}

/// The stream of the set-up.
fn setup<'a>(
    records: &'a [Record<'a>],
    clamp: &Values,
    known: &SetupParameters,
) -> Option<Stream<'a>> {
    let vertices = three([Role::VERTEX_X, Role::VERTEX_Y, Role::VERTEX_Z]);
    let answers = [("setup.exp", "o_", 0, words())];
    let mut stream = stream(records, "setup", SETUP, &vertices, &answers)?;
    stream.values = clamp.clone().and_setup(known);
    stream.entities = SETUP_VHDL;
    stream.width("VW", &Role::VERTEX_X)?;
    stream.width("M", &Role::EDGE_INIT)?;
    let x = stream.column(&Role::VERTEX_X)?;
    stream.of_files.push(("VS", format!("{x}_SIGNED")));
    Some(stream)
}

/// The stream of the engine.
fn engine<'a>(
    records: &'a [Record<'a>],
    clamp: &Values,
    known: EngineParameters,
) -> Option<Stream<'a>> {
    let sides = [Role::BOX_Y_BEGIN, Role::BOX_Y_END, Role::BOX_X_BEGIN, Role::BOX_X_END];
    let inputs = [names(&[Role::TEST]), words(), names(&sides)].concat();
    let summary =
        [&[Role::TEST, Role::SPANS, Role::SAMPLES][..], &EVENTS, &[Role::ZERO_AREA]].concat();
    let answers = [
        ("span.exp", "span_", 4, names(&[Role::TEST, Role::Y, Role::X_BEGIN, Role::X_END])),
        ("depth.exp", "sample_", 3, names(&[Role::TEST, Role::Y, Role::X, Role::DEPTH])),
        ("triangle.exp", "triangle_", 1, names(&summary)),
    ];
    let mut stream = stream(records, "triangle", ENGINE, &inputs, &answers)?;
    stream.values = clamp.clone();
    stream.entities = ENGINE_VHDL;
    stream.any_order = known.any_order;
    stream.width("C", &Role::BOX_X_BEGIN)?;
    stream.width("M", &Role::EDGE_INIT)?;
    Some(stream)
}

/// The stream of an engine of given edge functions.
fn quads<'a>(records: &'a [Record<'a>], known: &QuadDevice) -> Option<Stream<'a>> {
    let list = |names: &str| names.split(' ').map(str::to_owned).collect::<Vec<_>>();
    let inputs = list("test tile_x tile_y x_min x_max y_min y_max a0 b0 c0 a1 b1 c1 a2 b2 c2");
    let places = (0..3).flat_map(|k| (0..4).map(move |place| format!("e{k}_{place}")));
    let outputs = list("test x y mask").into_iter().chain(places).collect();
    let answers = [("words-q.exp", "q_", 0, outputs)];
    let mut stream = stream(records, "words", QUADS, &inputs, &answers)?;
    stream.values = Values::of_quads(known);
    stream.of_files.push(("C", "QUAD_COORDINATE_BITS".to_owned()));
    Some(stream)
}

/// The stream of a device that is wired for a built-in profile: the columns are those of its words.
fn wired_stream<'a>(records: &'a [Record<'a>], device: &WiredDevice) -> Option<Stream<'a>> {
    let columns = |stem: &str| {
        let record = records.iter().find(|record| record.file.name == format!("{stem}.tv"))?;
        Some(record.fields.iter().map(|field| field.column.name.clone()).collect::<Vec<_>>())
    };
    let kinds = [("words-s.exp", "span_"), ("words-p.exp", "p_")];
    let answers = kinds.map(|(stem, prefix)| Some((stem, prefix, 0, columns(stem)?)));
    let answers: Vec<Wanted> = answers.into_iter().flatten().collect();
    let mut stream =
        stream(records, "words", wired::device(device.engine), &columns("words.cfg")?, &answers)?;
    stream.values = Values::listed(&device.values);
    // Without a register for the sign of the long side, its word is named after the step alone.
    stream.renamed =
        Some(("long_sign_xh_step", "xh_step")).filter(|(_, new)| stream.cfg.field(new).is_some());
    Some(stream)
}

/// A device of `hdl` behind streams, and the modules that it is made of, itself last.
type Device = (&'static str, &'static [&'static Source]);

const SETUP: Device = ("triangle_setup", &[&rtl::SETUP_DIVIDER, &rtl::TRIANGLE_SETUP]);
/// The same in VHDL.
const SETUP_VHDL: &[&Source] = &[&rtl::SETUP_DIVIDER_VHDL, &rtl::TRIANGLE_SETUP_VHDL];
const ENGINE_VHDL: &[&Source] = &[&rtl::DDA_VHDL, &rtl::TRIANGLE_ENGINE_VHDL];
const ENGINE: Device = (
    "triangle_engine",
    &[
        &rtl::DDA,
        &rtl::EDGE_STEPPER,
        &rtl::EDGE_EVALUATOR,
        &rtl::DEPTH_EVALUATOR,
        &rtl::TRIANGLE_ENGINE,
    ],
);

const QUADS: Device = ("quad_engine", &[&rtl::QUAD_ENGINE]);

/// A file that a device answers: its stem, what the names of the ports begin with, how many columns are
/// its key, its columns.
type Wanted = (&'static str, &'static str, usize, Vec<String>);

/// The stream of that name, if the set has its files with just these columns.
fn stream<'a>(
    records: &'a [Record<'a>],
    name: &'static str,
    (device, parts): Device,
    inputs: &[String],
    answers: &[Wanted],
) -> Option<Stream<'a>> {
    let find = |stem: &str, columns: &[String]| {
        let record = records.iter().find(|record| record.file.name == format!("{stem}.tv"))?;
        let same = record.fields.iter().map(|field| &field.column.name).eq(columns);
        (same && record.file.rows > 0).then_some(record)
    };
    let cfg = find(&format!("{name}.cfg"), inputs)?;
    let answers = answers.iter().map(|(stem, prefix, key, columns)| {
        let exp = find(stem, columns)?;
        let skipped = |field: &Field| EVENTS.iter().any(|role| role.pattern == field.column.name);
        let fields = exp.fields.iter().map(|field| (field, !skipped(field))).collect();
        Some(Answer { prefix, exp, key: *key, fields })
    });
    let answers: Vec<Answer> = answers.collect::<Option<_>>()?;
    let (values, of_files) = (Values::default(), Vec::new());
    let (any_order, renamed) = (false, None);
    Some(Stream {
        name,
        device,
        parts,
        entities: &[],
        values,
        of_files,
        any_order,
        renamed,
        cfg,
        answers,
    })
}

/// The modules of these streams' devices, without those of `halves`, which the text has already.
pub(super) fn modules(streams: &[Stream], halves: &[Half]) -> String {
    devices(streams, halves, |stream| stream.parts, |half| half.module)
}

/// The same in VHDL.
pub(super) fn entities(streams: &[Stream], halves: &[Half]) -> String {
    devices(streams, halves, |stream| stream.entities, |half| half.entity)
}

fn devices(
    streams: &[Stream],
    halves: &[Half],
    parts: fn(&Stream) -> &'static [&'static Source],
    of_half: fn(&Half) -> &'static Source,
) -> String {
    let have = |source: &Source| halves.iter().any(|half| of_half(half).file() == source.file());
    let mut text = String::new();
    for stream in streams {
        for part in parts(stream).iter().filter(|part| !have(part)) {
            text += "\n";
            let module = part.with(&stream.values);
            text += &stream
                .renamed
                .map_or_else(|| module.clone(), |(old, new)| module.replace(old, new));
        }
    }
    text
}

impl Stream<'_> {
    /// The column of a role in the first file that has it.
    fn field(&self, role: &Role) -> Option<(&Record<'_>, &Field<'_>)> {
        let mut files = [self.cfg].into_iter().chain(self.answers.iter().map(|answer| answer.exp));
        files.find_map(|record| Some((record, record.field(&role.name(0))?)))
    }

    /// What the constants of a role's column begin with.
    fn column(&self, role: &Role) -> Option<String> {
        let (record, field) = self.field(role)?;
        Some(format!("{}_{}", record.constant(), field.constant()))
    }

    /// Sets a parameter to the width of a role's column.
    fn width(&mut self, parameter: &'static str, role: &Role) -> Option<()> {
        let width = self.field(role)?.1.column.width;
        let constant = format!("{}_WIDTH", self.column(role)?);
        self.values = std::mem::take(&mut self.values).and(parameter, width);
        self.of_files.push((parameter, constant));
        Some(())
    }
}

impl Stream<'_> {
    /// The module that checks this device.
    pub(super) fn systemverilog(&self) -> String {
        let each =
            |text: &dyn Fn(&Answer) -> String| self.answers.iter().map(text).collect::<String>();
        let inputs =
            self.cfg.fields.iter().map(|field| format!("        .{0}(cfg.{0}),\n", field.id));
        let inputs: Vec<String> = inputs.collect();
        let all = |between: &str, text: &str| {
            let parts: Vec<String> = self.answers.iter().map(|answer| answer.fill(text)).collect();
            parts.join(between)
        };
        let keyed = self.keyed();
        let order = |text: &'static str| if keyed { text } else { "" };
        let complete =
            |answer: &Answer| answer.fill(if answer.key > 0 { COMPLETE_ANY } else { COMPLETE });
        let complete: Vec<String> = self.answers.iter().map(complete).collect();
        let start = ORDER_START.replace("@DEFAULT@", if self.any_order { "1'b1" } else { "1'b0" });
        let text = fill(
            include_str!("tb.stream.sv.in"),
            &[
                ("ORDER_HELP", order(ORDER_HELP)),
                ("ORDER_START", if keyed { &start } else { "" }),
                (
                    "ORDER",
                    order(
                        "    reg any_order;                          // rows of a test are matched by their key\n",
                    ),
                ),
                ("MISSING", &each(&|answer| answer.keyed(MISSING))),
                ("HINT", order(HINT)),
                ("PARAMETERS", &self.parameters()),
                ("ANSWERS", &each(&|answer| answer.declare(self.name))),
                ("INPUTS", &inputs.concat()),
                ("OUTPUTS", each(&|answer| answer.connect()).trim_end_matches([',', '\n'])),
                ("START", &each(&|answer| answer.start())),
                ("WATCH", &each(&|answer| answer.fill(WATCH))),
                ("CUT", &self.cut()),
                ("FORGET", &each(&|answer| answer.fill(FORGET))),
                ("READY", &all("", READY)),
                ("COMPLETE", &complete.join(" && ")),
                ("VALID", &all(" || ", "@ANSWER@valid")),
                ("LAST", &all("", "                @ANSWER@file.last;\n")),
                ("WAVES", &self.waves()),
            ],
        );
        fill(
            &text,
            &[
                ("HALF", self.name),
                ("DEVICE", self.device),
                ("CFG", &self.cfg.constant()),
                ("CFG_ID", &self.cfg.id),
                ("CFG_FIXED", &text_mask(self.cfg, false)),
                ("CFG_DIGITS", &text_mask(self.cfg, true)),
                ("CFG_PACK", &pack(self.cfg, "cfg_file.nibbles")),
            ],
        )
    }
}

impl Stream<'_> {
    /// The device's parameters as the package has them.
    fn parameters(&self) -> String {
        let [.., top] = self.parts else { return String::new() };
        parameters(top, &self.of_files)
    }
}

/// A signal of a wave: name, width and what it shows.
type Shown<'n> = (&'n str, u32, String);

impl Stream<'_> {
    /// Another record in the place of the next: where and what is drawn stays, so that the device has
    /// something to work on; numbers, depths and vertices are others.
    fn cut(&self) -> String {
        let line = |field: &Field| format!("                    cfg.{0} = ~cfg.{0};\n", field.id);
        self.cut_fields().map(line).collect::<Vec<_>>().concat()
    }

    fn cut_fields(&self) -> impl Iterator<Item = &Field<'_>> {
        let stays = |id: &str| match self.name {
            // Other registers would draw nothing.
            "words" => id != Role::TEST.pattern,
            _ => id.starts_with("box") || id.starts_with("edge") || id == "zero_area",
        };
        self.cfg.fields.iter().filter(move |field| !stays(&field.id))
    }

    /// The columns as signals of their own names, each once: as a trace shows them.
    fn waves(&self) -> String {
        let mut shown: Vec<Shown> = Vec::new();
        let taken = self.cfg.fields.iter().map(|field| (field, "cfg."));
        let answered = self
            .answers
            .iter()
            .flat_map(|answer| answer.ports().map(|field| (field, answer.prefix)));
        for (field, prefix) in taken.chain(answered) {
            shown.retain(|(name, ..)| *name != field.id);
            shown.push((&field.id, field.column.width, format!("{prefix}{}", field.id)));
        }
        let wire =
            |(name, width, what): Shown| format!("    wire [{}:0] {name} = {what};\n", width - 1);
        shown.into_iter().map(wire).collect()
    }
}

const ORDER_HELP: &str = "// +anyorder takes the rows of a test in any order, each matched by its key; +fileorder takes them in
// the order of the files.
";

const HINT: &str = "                    if (mismatches != 0 && !any_order)
                        $display(\"HINT @HALF@: rows are compared in the order of the files; for an engine with an order of its own, +anyorder\");
";

const ORDER_START: &str = "        any_order = @DEFAULT@;
        if ($test$plusargs(\"anyorder\")) any_order = 1'b1;
        if ($test$plusargs(\"fileorder\")) any_order = 1'b0;
";

//! Benches of devices behind valid/ready streams: one record in, rows of several files out.

mod answer;
mod list;
mod vhdl;

use super::half::{Half, pack, parameters, text_mask};
use super::record::{Field, Record};
use super::rtl::{Source, Values};
use super::template::fill;
use super::unit::wire;
use crate::format::Role;
use answer::{Answer, COMPLETE, COMPLETE_ANY, FORGET, MISSING, READY, WATCH};
pub(super) use list::streams;

/// A device, the file that drives it and the files that it answers.
pub(super) struct Stream<'a> {
    /// The bench's name, and the stem of the file that drives it.
    pub(super) name: String,
    device: String,
    /// The modules that the device is made of, itself last; none of a unit of channels, which is a module
    /// around one of them.
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
    of_half: fn(&Half) -> Option<&'static Source>,
) -> String {
    let have = |source: &Source| {
        halves.iter().filter_map(of_half).any(|module| module.file() == source.file())
    };
    let mut text = String::new();
    for stream in streams {
        for part in parts(stream).iter().filter(|part| !have(part)) {
            text += "\n";
            let module = part.with(&stream.values);
            text += &match stream.renamed {
                Some((old, new)) => module.replace(old, new),
                None => module,
            };
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
                ("ANSWERS", &each(&|answer| answer.declare(&self.name))),
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
        self.fill(&text)
    }
}

impl Stream<'_> {
    /// What both languages fill in.
    fn fill(&self, text: &str) -> String {
        fill(
            text,
            &[
                ("HALF", &self.name),
                ("ID", &wire(&self.name)),
                ("CHARS", &self.longest().to_string()),
                ("DEVICE", &self.device),
                ("CFG", &self.cfg.constant()),
                ("CFG_ID", &self.cfg.id),
                ("CFG_SHAPE", self.cfg.shape().trim_end()),
                ("CFG_FIXED", &text_mask(self.cfg, false)),
                ("CFG_DIGITS", &text_mask(self.cfg, true)),
                ("CFG_PACK", &pack(self.cfg, "cfg_file.nibbles")),
            ],
        )
    }

    /// Characters of the longest name of a file that it answers; 16 at least.
    fn longest(&self) -> usize {
        let names = self.answers.iter().map(|answer| answer.exp.file.name.len() - ".tv".len());
        names.max().unwrap_or(0).max(16)
    }

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
        let stays = |id: &str| match self.name.as_str() {
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

//! One stream of answers of a device: its file, its wires, and what is done with each row.

use crate::vector::package::half::{pack, text_mask};
use crate::vector::package::record::{Field, Record};
use crate::vector::package::template::fill;

/// One stream of answers.
pub(super) struct Answer<'a> {
    /// What its ports' names begin with.
    pub(super) prefix: &'static str,
    pub(super) exp: &'a Record<'a>,
    /// How many of its first columns say where a row belongs; 0 where only the order says it.
    pub(super) key: usize,
    /// Its columns, and whether the device has a port for each.
    pub(super) fields: Vec<(&'a Field<'a>, bool)>,
}

pub(super) const COMPLETE: &str = "@ANSWER@file.line >= @EXP@_ROWS";

pub(super) const COMPLETE_ANY: &str =
    "@ANSWER@file.line >= @EXP@_ROWS && !@ANSWER@ahead && @ANSWER@open.size() == 0";

pub(super) const MISSING: &str = "                if (@ANSWER@open.size() > 0) begin
                    {@ANSWER@line, @ANSWER@picked} = @ANSWER@open[0];
                    $display(\"MISMATCH @HALF@ (@STEM@.tv line %0d): this row and %0d others of the tests so far are missing\", @ANSWER@line, @ANSWER@open.size() - 1);
                end
";

pub(super) const START: &str = "@AHEAD@        @ANSWER@ready = 1'b0;
        @ANSWER@held = 1'b0;
        @ANSWER@dump = 0;
        if ($test$plusargs(\"dump\")) @ANSWER@dump = $fopen(\"@STEM@.dut.tv\", \"w\");
";

pub(super) const WATCH: &str = "                if (@ANSWER@held || @ANSWER@valid !== 1'b0) begin
                    if (@ANSWER@held && (!@ANSWER@valid || @ANSWER@now !== @ANSWER@kept))
                        unstable(\"@STEM@\", @ANSWER@file.line + 1);
                    @ANSWER@held = @ANSWER@valid && !@ANSWER@ready;
                    if (@ANSWER@held) @ANSWER@kept = @ANSWER@now;
                    if (@ANSWER@valid === 1'b1 && @ANSWER@ready) @ANSWER@compare;
                end
";

/// What a reset makes the bench forget.
pub(super) const FORGET: &str = "                @ANSWER@held = 1'b0;
";

pub(super) const READY: &str = "        @ANSWER@ready = !stalls && !cutting;
        noise = {noise[14:0], noise[15] ^ noise[13] ^ noise[12] ^ noise[10]};
";

impl Answer<'_> {
    pub(super) fn fill(&self, text: &str) -> String {
        let stem = self.exp.file.name.trim_end_matches(".tv");
        fill(
            text,
            &[
                ("ANSWER", self.prefix),
                ("EXP", &self.exp.constant()),
                ("EXP_ID", &self.exp.id),
                ("STEM", stem),
            ],
        )
    }

    /// A text that only an answer with a key has.
    pub(super) fn keyed(&self, text: &str) -> String {
        if self.key > 0 { self.fill(text) } else { String::new() }
    }

    pub(super) fn start(&self) -> String {
        let ahead = self.keyed("        @ANSWER@ahead = 1'b0;\n");
        self.fill(&fill(START, &[("AHEAD", &ahead)]))
    }

    /// The task that finds the row of an answer's key.
    pub(super) fn any_order(&self) -> String {
        let key: Vec<&str> =
            self.fields[..self.key].iter().map(|(field, _)| field.id.as_str()).collect();
        let Some(test) = key.first() else { return String::new() };
        let list = |between: &str, text: &dyn Fn(&str) -> String| {
            key.iter().map(|id| text(id)).collect::<Vec<_>>().join(between)
        };
        let same = |id: &str| format!("{0}{id} === {0}want.{id}", self.prefix);
        let text = fill(
            include_str!("../tb.any.sv.in"),
            &[
                ("SAME_KEY", &list(" && ", &same)),
                ("KEY_FORMAT", &list(", ", &|id| format!("{id} %0d"))),
                ("KEY", &list(", ", &|id| format!("{}{id}", self.prefix))),
                ("TEST", test),
            ],
        );
        self.fill(&text)
    }

    pub(super) fn ports(&self) -> impl Iterator<Item = &Field<'_>> {
        self.fields.iter().filter(|(_, port)| *port).map(|(field, _)| *field)
    }

    /// Its file, its wires, and the task that compares a row.
    pub(super) fn declare(&self, name: &str) -> String {
        let wires: Vec<String> = self
            .ports()
            .map(|field| {
                format!("    wire [{}:0] {}{};\n", field.column.width - 1, self.prefix, field.id)
            })
            .collect();
        let now: Vec<String> =
            self.ports().map(|field| format!("{}{}", self.prefix, field.id)).collect();
        let bits: u32 = self.ports().map(|field| field.column.width).sum();
        let compare: Vec<String> = self
            .ports()
            .map(|field| {
                let Field { id, column, .. } = field;
                let (prefix, stem) = (self.prefix, self.exp.file.name.trim_end_matches(".tv"));
                format!(
                    "            if ({prefix}{id} !== {prefix}want.{id}) begin
                mismatches = mismatches + 1;
                if (mismatches <= REPORTED)
                    $display(\"MISMATCH {name} ({stem}.tv line %0d) field {field}\\n    expected %h  %b\\n    got      %h  %b\",
                        line, {prefix}want.{id}, {prefix}want.{id}, {prefix}{id}, {prefix}{id});
            end
",
                    field = column.name
                )
            })
            .collect();
        let masked = self.fields.iter().any(|(_, port)| !port);
        let (formats, words): (Vec<&str>, Vec<String>) = self
            .fields
            .iter()
            .map(|(field, port)| {
                if *port {
                    ("%h", format!("{}{}", self.prefix, field.id))
                } else {
                    ("%h", format!("{}'h0", field.column.width))
                }
            })
            .unzip();
        let mask: String = self
            .fields
            .iter()
            .map(|(field, port)| if *port { "0" } else { "f" }.repeat(field.column.digits()))
            .collect();
        let mask = if masked { format!("_{mask}") } else { String::new() };
        let text = self.fill(include_str!("../tb.answer.sv.in"));
        fill(
            &text,
            &[
                ("FIXED", &text_mask(self.exp, false)),
                ("DIGITS", &text_mask(self.exp, true)),
                ("PACK", &pack(self.exp, &format!("{}file.nibbles", self.prefix))),
                ("WIRES", &wires.concat()),
                ("NOW_TOP", &(bits - 1).to_string()),
                ("NOW", &now.join(", ")),
                ("COMPARE", &compare.concat()),
                ("FORMATS", &(formats.join("_") + &mask)),
                ("WORDS", &words.join(", ")),
                ("ANY_ORDER", &self.any_order()),
                ("FIND", &self.keyed("if (any_order) @ANSWER@find;\n            else ")),
            ],
        )
    }

    pub(super) fn connect(&self) -> String {
        let ports = self.ports().map(|field| field.id.as_str()).chain(["valid", "ready"]);
        let ports: Vec<String> =
            ports.map(|id| format!("        .{}({}{id}),\n", self.port(id), self.prefix)).collect();
        ports.concat()
    }

    /// The port of a signal. `o_valid` is the set-up's `out_valid`: its ports have no stream's name.
    pub(super) fn port(&self, id: &str) -> String {
        match (self.prefix, id) {
            ("o_", "valid" | "ready") => format!("out_{id}"),
            (prefix, id) => format!("{prefix}{id}"),
        }
    }
}

//! What an engine has to answer, as hardware: shared by the proof and by the search for a difference.

use crate::vector::equivalence::miter::range;
use crate::vector::equivalence::{Asked, Signal};
use crate::vector::reference::package;
use std::fmt::Write as _;

/// The streams, in the order of their bits in vectors of valid and ready.
pub(super) const STREAMS: [&str; 3] = ["span", "sample", "triangle"];

/// A question about an engine, as text.
pub(super) struct Texts<'a> {
    pub(super) asked: &'a Asked<'a>,
    /// Columns and rows of the window.
    pub(super) window: [u32; 2],
    /// Bits of edge words, depth words and depths.
    pub(super) widths: [u32; 3],
}

impl Texts<'_> {
    pub(super) fn has(&self, signal: &str) -> bool {
        self.asked.map.ports.contains_key(signal)
    }

    /// What comes with a triangle.
    pub(super) fn words(&self) -> impl Iterator<Item = &Signal> {
        let is_word = |name: &str| {
            name == "test"
                || name == "zero_area"
                || ["edge", "depth_", "box_"].iter().any(|prefix| name.starts_with(prefix))
        };
        self.asked
            .unit
            .signals
            .iter()
            .filter(move |signal| !signal.output && is_word(signal.name) && self.has(signal.name))
    }

    /// The fields of a stream's records that are looked at.
    pub(super) fn fields(&self, stream: &'static str) -> impl Iterator<Item = &Signal> {
        let of = move |name: &str| {
            name.strip_prefix(stream).is_some_and(|rest| rest.starts_with('_') && rest != "_valid")
        };
        let signals = self.asked.unit.signals.iter();
        signals.filter(move |signal| signal.output && of(signal.name) && self.has(signal.name))
    }

    /// The pins of the engine: the words that `given` has, the bits of `ready`, and answers that begin with `got`.
    pub(super) fn pins(
        &self,
        reset: &str,
        given: impl Fn(&str) -> String,
        ready: &str,
        got: &str,
    ) -> (String, String) {
        let Asked { map, wiring, .. } = *self.asked;
        let (mut wires, mut pins) = (String::new(), Vec::new());
        pins.extend(wiring.clock.iter().map(|clock| format!(".{clock}(clk)")));
        if let Some(port) = &map.reset {
            let level = if port.active_low { format!("!({reset})") } else { reset.to_owned() };
            pins.push(format!(".{}({level})", port.port));
        }
        for (port, value) in &map.constants {
            pins.push(format!(".{port}(64'd{value})"));
        }
        for word in self.words() {
            pins.push(format!(".{}({})", map.ports[word.name], given(word.name)));
        }
        pins.push(format!(".{}({})", map.ports["in_valid"], given("in_valid")));
        let _ = writeln!(wires, "    wire {got}in_ready;\n    wire [2:0] {got}v;");
        pins.push(format!(".{}({got}in_ready)", map.ports["in_ready"]));
        for (place, stream) in STREAMS.into_iter().enumerate() {
            match map.ports.get(&format!("{stream}_valid")) {
                Some(port) => pins.push(format!(".{port}({got}v[{place}])")),
                None => {
                    let _ = writeln!(wires, "    assign {got}v[{place}] = 1'b0;");
                }
            }
            if let Some(port) = map.ports.get(&format!("{stream}_ready")) {
                pins.push(format!(".{port}({ready}[{place}])"));
            }
            for field in self.fields(stream) {
                let _ = writeln!(wires, "    wire {}{got}{};", range(field.width), field.name);
                pins.push(format!(".{}({got}{})", map.ports[field.name], field.name));
            }
        }
        (wires, pins.join(", "))
    }

    /// Where the fields of two answers differ, by the streams that are valid.
    pub(super) fn differ(&self, valid: &str, here: &str, there: &str) -> String {
        let mut text = "1'b0".to_owned();
        for (place, stream) in STREAMS.into_iter().enumerate() {
            for field in self.fields(stream) {
                let name = field.name;
                let _ = write!(text, " || ({valid}[{place}] && {here}{name} != {there}{name})");
            }
        }
        text
    }

    /// The samples of the triangle whose words begin with `own`, and what of the answers is wrong. The text around
    /// it has `reset`, `begins` (a triangle is taken), `got_v` and `takes` (records that are valid, and taken).
    pub(super) fn expected(&self, own: &str) -> String {
        let [edge, word, depth] = self.widths;
        let package = package(self.asked.profile);
        let [columns, rows] = self.window;
        let count = columns * rows;
        let mut text = String::from(
            "    // Words at the samples of the box, by steps from its corner (C-5, P-2).\n",
        );
        let planes = [("edge0", edge), ("edge1", edge), ("edge2", edge), ("depth", word)];
        for (plane, width) in planes {
            let at = if plane == "depth" { "depth_at" } else { "edge_at" };
            let _ = writeln!(
                text,
                "    wire {0}{plane}_corner = {package}::{at}({own}{plane}_init, {own}{plane}_dx, {own}{plane}_dy, \
                 {own}box_x_begin, {own}box_y_begin);",
                range(width)
            );
            for y in 0..rows {
                let row = match y.checked_sub(1) {
                    None => format!("{plane}_corner"),
                    Some(above) => format!(
                        "{own}box_y_begin == 17'd{y} ? {plane}_corner : {plane}_left_{above} + {own}{plane}_dy"
                    ),
                };
                let _ = writeln!(text, "    wire {}{plane}_left_{y} = {row};", range(width));
                for x in 0..columns {
                    let sample = match x.checked_sub(1) {
                        None => format!("{plane}_left_{y}"),
                        Some(left) => format!(
                            "{own}box_x_begin == 17'd{x} ? {plane}_left_{y} : {plane}_{y}_{left} + {own}{plane}_dx"
                        ),
                    };
                    let _ = writeln!(text, "    wire {}{plane}_{y}_{x} = {sample};", range(width));
                }
            }
        }
        let _ = writeln!(text, "    wire [{0}:0] covered, starts;", count - 1);
        let mut samples = String::new();
        let mut spans = String::new();
        for n in 0..count {
            let [x, y] = [n % columns, n / columns];
            let sign = edge - 1;
            let _ = writeln!(
                text,
                "    assign covered[{n}] = !{own}zero_area && !edge0_{y}_{x}[{sign}] && !edge1_{y}_{x}[{sign}] \
                 && !edge2_{y}_{x}[{sign}]\n        && {own}box_y_begin <= 17'd{y} && {own}box_y_end > 17'd{y} \
                 && {own}box_x_begin <= 17'd{x} && {own}box_x_end > 17'd{x};"
            );
            let after = if x == 0 { String::new() } else { format!(" && !covered[{}]", n - 1) };
            let _ = writeln!(text, "    assign starts[{n}] = covered[{n}]{after};");
            let mut end = format!("17'd{columns}");
            for right in (x + 1..columns).rev() {
                end = format!("!covered[{}] ? 17'd{right} : {end}", y * columns + right);
            }
            let (here, before) = (1u64 << n, (1u64 << n) - 1);
            let _ = writeln!(
                samples,
                "        if (got_sample_y == 17'd{y} && got_sample_x == 17'd{x}) begin\n            \
                 is_sample = covered[{n}]; want_sample_depth = {package}::read_out(depth_{y}_{x}); \
                 sample_here = {count}'d{here}; samples_before = {count}'d{before};\n        end"
            );
            let _ = writeln!(
                spans,
                "        if (got_span_y == 17'd{y} && got_span_x_begin == 17'd{x}) begin\n            \
                 is_span = starts[{n}]; want_span_x_end = {end}; span_here = {count}'d{here}; \
                 spans_before = {count}'d{before};\n        end"
            );
        }
        let [has_span, has_sample] = ["span_valid", "sample_valid"].map(|valid| self.has(valid));
        let _ = write!(
            text,
            "    reg is_sample, is_span;\n    reg [{0}:0] sample_here, samples_before, span_here, spans_before;\n    \
             reg {1}want_sample_depth;\n    reg [16:0] want_span_x_end;\n    always @* begin\n        \
             is_sample = 1'b0; is_span = 1'b0; want_sample_depth = 0; want_span_x_end = 0;\n        \
             sample_here = 0; samples_before = 0; span_here = 0; spans_before = 0;\n{2}{3}    end\n",
            count - 1,
            range(depth),
            if has_sample { &samples } else { "" },
            if has_span { &spans } else { "" },
        );
        text + &self.wrong(own, count)
    }

    /// Which records were taken, and which are wrong.
    fn wrong(&self, own: &str, count: u32) -> String {
        let top = count - 1;
        let unlike = |pairs: &[(&str, String)]| {
            let mapped = pairs.iter().filter(|(field, _)| self.has(field));
            mapped.fold(String::new(), |mut text, (field, want)| {
                let _ = write!(text, " || got_{field} != {want}");
                text
            })
        };
        let test = format!("{own}test");
        let sample = unlike(&[
            ("sample_depth", "want_sample_depth".to_owned()),
            ("sample_test", test.clone()),
        ]);
        let span =
            unlike(&[("span_x_end", "want_span_x_end".to_owned()), ("span_test", test.clone())]);
        let [spans, samples] =
            [("span_valid", "starts"), ("sample_valid", "covered")].map(|(valid, all)| {
                // Without a stream its records are counted, and not followed.
                if self.has(valid) { String::new() } else { sum(all, count) }
            });
        let number = |count: &str, sum: String| if sum.is_empty() { count.to_owned() } else { sum };
        let [want_spans, want_samples] = [number("spans", spans), number("samples", samples)];
        let ended = unlike(&[
            ("triangle_test", test),
            ("triangle_spans", "want_triangle_spans".to_owned()),
            ("triangle_samples", "want_triangle_samples".to_owned()),
            ("triangle_zero_area", format!("{own}zero_area")),
        ]);
        let left = |valid: &str, all: &str, taken: &str| {
            if self.has(valid) { format!(" || ({all} & ~{taken}) != 0") } else { String::new() }
        };
        let left = left("sample_valid", "covered", "samples_taken")
            + &left("span_valid", "starts", "spans_taken");
        format!(
            "    // Records that were taken, and how many.\n    reg busy = 1'b0;\n    \
             reg [{top}:0] samples_taken = 0, spans_taken = 0;\n    reg [31:0] samples = 0, spans = 0;\n    \
             wire [31:0] want_triangle_spans = {want_spans};\n    wire [31:0] want_triangle_samples = {want_samples};\n    \
             always @(posedge clk)\n        if (reset || begins) begin\n            \
             busy <= !reset; samples_taken <= 0; spans_taken <= 0; samples <= 0; spans <= 0;\n        end\n        \
             else begin\n            busy <= busy && !takes[2];\n            \
             samples_taken <= takes[1] ? samples_taken | sample_here : samples_taken;\n            \
             spans_taken <= takes[0] ? spans_taken | span_here : spans_taken;\n            \
             samples <= samples + takes[1];\n            spans <= spans + takes[0];\n        end\n    \
             // Each record is the next one of its stream, and the last one comes when nothing is left.\n    \
             wire wrong_sample = got_v[1] && (!busy || !is_sample || (covered & samples_before & ~samples_taken) != 0\n        \
             || (samples_taken & ~samples_before) != 0{sample});\n    \
             wire wrong_span = got_v[0] && (!busy || !is_span || (starts & spans_before & ~spans_taken) != 0\n        \
             || (spans_taken & ~spans_before) != 0{span});\n    \
             wire wrong_triangle = got_v[2] && (!busy || got_v[1] || got_v[0]{left}{ended});\n    \
             wire wrong = wrong_sample || wrong_span || wrong_triangle;\n"
        )
    }
}

/// The number of ones.
fn sum(bits: &str, count: u32) -> String {
    let ones: Vec<String> = (0..count).map(|n| format!("{bits}[{n}]")).collect();
    format!("32'd0 + {}", ones.join(" + "))
}

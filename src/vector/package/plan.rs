//! Which benches of a set a testbench drives, and why it leaves the others out.

use super::Interface;
use super::half::{Half, halves};
use super::record::Record;
use super::stream::{Stream, streams};
use super::template::comment;

/// A bench of a set that a testbench does not drive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unchecked {
    /// The testbench: `tb.sv`, with the same devices as `tb_cocotb.py`, or `tb.vhd`.
    pub testbench: &'static str,
    /// The bench, such as `triangle`.
    pub bench: String,
    /// Why.
    pub reason: String,
}

/// What the testbench of a language drives.
pub(super) struct Plan<'a> {
    pub(super) halves: Vec<Half<'a>>,
    pub(super) streams: Vec<Stream<'a>>,
    pub(super) unchecked: Vec<Unchecked>,
}

impl<'a> Plan<'a> {
    /// Of `tb.sv`.
    pub(super) fn systemverilog(interface: &Interface, records: &'a [Record<'a>]) -> Self {
        let halves = halves(interface, records);
        Self::new("tb.sv", interface, records, halves, streams(interface, records))
    }

    /// Of `tb.vhd`.
    pub(super) fn vhdl(interface: &Interface, records: &'a [Record<'a>]) -> Self {
        let streams = streams(interface, records).into_iter().filter(Stream::has_entity);
        let halves = halves(interface, records).into_iter().filter(|half| half.entity.is_some());
        Self::new("tb.vhd", interface, records, halves.collect(), streams.collect())
    }

    fn new(
        testbench: &'static str,
        interface: &Interface,
        records: &'a [Record<'a>],
        halves: Vec<Half<'a>>,
        streams: Vec<Stream<'a>>,
    ) -> Self {
        let mut plan = Self { halves, streams, unchecked: Vec::new() };
        let names = plan.names();
        let benches = records.iter().filter_map(|record| record.file.name.strip_suffix(".cfg.tv"));
        let left = benches.filter(|bench| !names.contains(bench));
        plan.unchecked = left
            .map(|bench| Unchecked {
                testbench,
                bench: bench.to_owned(),
                reason: comment(&reason(interface, records, bench, testbench)),
            })
            .collect();
        plan
    }

    /// The benches that it drives.
    pub(super) fn names(&self) -> Vec<&str> {
        let halves = self.halves.iter().map(|half| half.name.as_str());
        halves.chain(self.streams.iter().map(|stream| stream.name.as_str())).collect()
    }

    /// A line for each bench that is left out; `@BENCH@` and `@REASON@` of the text are filled in.
    pub(super) fn each_unchecked(&self, text: &str) -> String {
        let fill = |left: &Unchecked| {
            super::template::fill(text, &[("BENCH", &left.bench), ("REASON", &left.reason)])
        };
        self.unchecked.iter().map(fill).collect()
    }

    /// What a verdict says of them: nothing if there is none.
    pub(super) fn verdict(&self) -> String {
        match &self.unchecked[..] {
            [] => String::new(),
            left => {
                let names: Vec<&str> = left.iter().map(|left| left.bench.as_str()).collect();
                format!(" not checked: {}", names.join(" "))
            }
        }
    }
}

/// Why no device of the set does the job of a bench.
fn reason(interface: &Interface, records: &[Record], bench: &str, testbench: &str) -> String {
    let stems: &[&str] = match bench {
        "triangle" => &["triangle.cfg", "triangle.exp", "span.exp", "depth.exp"],
        _ => &[&format!("{bench}.cfg"), &format!("{bench}.exp")],
    };
    let files = records.iter().map(|record| record.file);
    let mut files = files.filter(|file| stems.iter().any(|stem| file.name == format!("{stem}.tv")));
    if let Some(file) = files.find(|file| file.rows == 0) {
        return format!("{} has no rows", file.name);
    }
    let other = || match bench {
        "setup" | "triangle" => "its columns are not those of a device for edge functions and a \
                                 depth plane"
            .to_owned(),
        "dda" | "edge" => "its files lack a column of the device".to_owned(),
        _ => format!("no device of the set does what {bench}.cfg.tv asks for"),
    };
    let missing = match bench {
        "setup" => interface.setup.as_ref().err().cloned(),
        "triangle" => interface.engine.as_ref().err().cloned(),
        "words" => interface.registers.as_ref().err().cloned(),
        _ => None,
    };
    let unit = interface.units.iter().any(|unit| unit.bench == bench);
    let here = (unit || matches!(bench, "setup" | "triangle" | "words"))
        && missing.is_none()
        && testbench == "tb.vhd";
    if here && (unit || !streams(interface, records).is_empty()) {
        return "the set has no such device in VHDL; tb.sv checks it".to_owned();
    }
    missing.unwrap_or_else(other)
}

//! The generated HDL side of a vector set: packages, testbenches and a device that passes.
//!
//! A set's data files are plain columns of hexadecimal words. This room writes what a hardware
//! engineer puts beside them: packages that name every width and row count in four languages, a
//! testbench in SystemVerilog and one in VHDL, and a small device under test to replace.
//! Templates lie beside this file as `*.in`; `@NAME@` in them is filled in here.

mod bench;
mod c;
mod half;
mod keyword;
mod plan;
mod record;
mod rtl;
mod stream;
mod systemverilog;
mod template;
mod unit;
mod verilog;
mod vhdl;
mod wired;

#[cfg(test)]
mod test;

use crate::bits::Rounding;
use crate::format::{Clamp, Column};
use crate::machine::{RegisterDevice, WiredEngine};
pub use keyword::identifier;
use plan::Plan;
pub use plan::Unchecked;
use record::Record;
pub(super) use template::{comment, fill};

/// The module in `hdl` that draws as an engine does.
pub(super) fn device_name(engine: WiredEngine) -> &'static str {
    wired::device(engine).0
}

/// One data file of a set: its name, how many records it holds and what a record is made of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileLayout {
    /// File name inside the set, such as `dda.exp.tv`.
    pub name: String,
    /// Number of records, one a line.
    pub rows: u64,
    /// Columns from left to right; a file without any is left out.
    pub columns: Vec<Column>,
}

/// The read-out of the depth machine: how an accumulator of `guard + integer + fraction` bits
/// becomes an output of `integer` bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClampParameters {
    /// Guard bits above the integer bits.
    pub guard: u32,
    /// Integer bits, the width of the output; at least 1.
    pub integer: u32,
    /// Interpolation bits below the binary point.
    pub fraction: u32,
    /// What is read outside the range. A device cannot refuse a primitive: under `error` it reads
    /// out as under `guard`.
    pub mode: Clamp,
}

/// Set-up by edge functions and an exact quotient, as `triangle_setup` does it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SetupParameters {
    /// Whether coordinates are signed.
    pub signed: bool,
    /// Sub-pixel bits.
    pub sub_pixel: u32,
    /// The sample in its pixel, in sub-pixels.
    pub sample: [i128; 2],
    /// The shadow rule instead of top-left.
    pub shadow: bool,
    /// Low bits of an edge value that are not kept.
    pub shift: u32,
    /// Rounding of the start and of each slope.
    pub rounding: Rounding,
    /// Whether the start gains half a depth step.
    pub half: bool,
}

impl SetupParameters {
    /// The parameters of `triangle_setup` that it has alone.
    pub(super) fn parameters(&self) -> [(&'static str, i128); 8] {
        [
            ("VS", self.signed.into()),
            ("S", self.sub_pixel.into()),
            ("SAMPLE_X", self.sample[0]),
            ("SAMPLE_Y", self.sample[1]),
            ("RULE", self.shadow.into()),
            ("SHIFT", self.shift.into()),
            ("ROUNDING", self.rounding.names().code.into()),
            ("HALF", self.half.into()),
        ]
    }
}

/// What draws set-up words, as `triangle_engine` does it: edge functions and a depth plane over a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EngineParameters {
    /// Whether engines of this profile answer the samples of a triangle in an order of their own.
    pub any_order: bool,
}

/// The device of a unit of channels: a module that sets the parameters of one of `hdl`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitDevice {
    /// The bench that drives it, such as `reciprocal-map`. Its module is `dut_reciprocal_map`.
    pub bench: String,
    /// The module of `hdl`.
    pub module: &'static str,
    /// The parameters of that module, and their values in SystemVerilog.
    pub values: Vec<(&'static str, String)>,
}

/// Everything the generated files depend on; equal interfaces give equal text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interface {
    /// Name of the set, such as `sgi-4k-g2`.
    pub set: String,
    /// Version of the model that wrote the vectors.
    pub model_version: u32,
    /// Read-out of the depth machine. Where the set has a `dda` pair, `acc` is
    /// `guard + integer + fraction` bits wide and `out` is `integer` bits wide.
    pub clamp: ClampParameters,
    /// Set-up, or why no device that this crate brings can do it.
    pub setup: Result<SetupParameters, String>,
    /// The engine, or why no device that this crate brings can do its job.
    pub engine: Result<EngineParameters, String>,
    /// What draws registers, or why no device that this crate brings can do its job.
    pub registers: Result<RegisterDevice, String>,
    /// The units of channels that this crate has a device for.
    pub units: Vec<UnitDevice>,
    /// The data files, in the order they are described.
    pub files: Vec<FileLayout>,
}

/// Names and texts of the generated files, in a fixed order: `pkg.sv`, `pkg.vh`, `pkg.vhd`,
/// `pkg.h`, `tb.sv`, `dut.sv`, `tb.vhd`, `dut.vhd`, `tb_cocotb.py`.
///
/// A bench drives every bench of the set for which there is a device. It names the others with the reason,
/// in its head and beside its verdict ([`unchecked`]); if nothing is left, it says so and fails. Names that are a keyword in
/// any of the target languages take the suffix `_v` in all of them (`in` is `in_v`), since VHDL
/// allows no trailing underscore.
pub fn files(interface: &Interface) -> Vec<(String, String)> {
    let records = records(interface);
    [
        ("pkg.sv", systemverilog::package(interface, &records)),
        ("pkg.vh", verilog::package(interface, &records)),
        ("pkg.vhd", vhdl::package(interface, &records)),
        ("pkg.h", c::package(interface, &records)),
        ("tb.sv", bench::systemverilog(interface, &records)),
        ("dut.sv", bench::systemverilog_device(interface, &records)),
        ("tb.vhd", bench::vhdl(interface, &records)),
        ("dut.vhd", bench::vhdl_device(interface, &records)),
        ("tb_cocotb.py", bench::cocotb(interface)),
    ]
    .map(|(name, text)| (name.to_owned(), text))
    .to_vec()
}

/// The benches of the set that its testbenches do not drive, with the reasons.
pub fn unchecked(interface: &Interface) -> Vec<Unchecked> {
    let records = records(interface);
    let plans = [Plan::systemverilog(interface, &records), Plan::vhdl(interface, &records)];
    plans.into_iter().flat_map(|plan| plan.unchecked).collect()
}

fn records(interface: &Interface) -> Vec<Record<'_>> {
    interface.files.iter().filter(|file| !file.columns.is_empty()).map(Record::new).collect()
}

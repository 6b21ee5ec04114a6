//! Wave files of a trace: Value Change Dump and FST, one clock a row.

use super::failure::Failure;
use super::output::{write_bytes, write_whole};
use fst_writer::{
    FstFileType, FstHeaderWriter, FstInfo, FstScopeType, FstSignalType, FstVarDirection, FstVarType,
};
use guardbit::vector::bench::FileSpec;
use guardbit::vector::package::identifier;
use std::fs::File;
use std::io::{BufWriter, Result, Write};
use std::path::Path;
use vcd::{TimescaleUnit, Value, VarType};

/// The files of a test and their rows.
type Files = [(FileSpec, Vec<Vec<u128>>)];

/// Time units a clock: the edge falls in its middle.
const CLOCK: u64 = 10;

/// A column as a signal under its name in the generated benches, and its word at each clock;
/// configuration holds its first row.
struct Signal<'a> {
    name: String,
    width: u32,
    rows: &'a [Vec<u128>],
    column: usize,
}

impl Signal<'_> {
    fn at(&self, clock: usize) -> Option<u128> {
        Some(self.rows.get(clock.min(self.rows.len().checked_sub(1)?))?[self.column])
    }

    fn bits(&self, clock: usize) -> Option<String> {
        Some(format!("{:0width$b}", self.at(clock)?, width = self.width as usize))
    }
}

/// The rows of the last file are the clocks: a walk's steps, a triangle's covered samples. Files
/// of one row, such as its configuration, stand beside them unchanged. A name is shown once.
fn signals(files: &Files) -> (Vec<Signal<'_>>, usize) {
    let last = files.len().saturating_sub(1);
    let clocks = files.get(last).map_or(0, |(_, rows)| rows.len());
    let mut list: Vec<Signal<'_>> = Vec::new();
    for (n, (spec, rows)) in files.iter().enumerate() {
        if n < last && rows.len() != 1 {
            continue;
        }
        for (column, shape) in spec.columns.iter().enumerate() {
            // What varies is worth more than what stands still under the same name.
            let name = identifier(&shape.name);
            list.retain(|signal| signal.name != name);
            list.push(Signal { name, width: shape.width, rows, column });
        }
    }
    (list, clocks)
}

/// Writes a Value Change Dump, whole or not at all.
pub(crate) fn vcd(path: &Path, module: &str, files: &Files) -> std::result::Result<(), Failure> {
    write_whole(path, |file| write_vcd(file, module, files))
}

fn write_vcd(file: BufWriter<File>, module: &str, files: &Files) -> Result<()> {
    let (signals, clocks) = signals(files);
    let mut writer = vcd::Writer::new(file);
    writer.timescale(1, TimescaleUnit::NS)?;
    writer.add_module(&identifier(module))?;
    let clock = writer.add_wire(1, "clk")?;
    let mut ids = Vec::new();
    for signal in &signals {
        ids.push(writer.add_var(VarType::Reg, signal.width, &signal.name, None)?);
    }
    writer.upscope()?;
    writer.enddefinitions()?;
    for n in 0..clocks {
        writer.timestamp(n as u64 * CLOCK)?;
        writer.change_scalar(clock, Value::V1)?;
        for (signal, id) in signals.iter().zip(&ids) {
            if n > 0 && signal.at(n) == signal.at(n - 1) {
                continue;
            }
            let bits = signal.bits(n).unwrap_or_default();
            writer.change_vector(*id, bits.bytes().map(|bit| Value::from(bit == b'1')))?;
        }
        writer.timestamp(n as u64 * CLOCK + CLOCK / 2)?;
        writer.change_scalar(clock, Value::V0)?;
    }
    writer.timestamp(clocks as u64 * CLOCK)?;
    writer.writer().flush()
}

/// Writes an FST file, whole or not at all. It is made in memory, where its writer can go back, so that a pipe
/// takes it as well.
pub(crate) fn fst(path: &Path, module: &str, files: &Files) -> std::result::Result<(), Failure> {
    let bytes = fst_bytes(module, files)
        .map_err(|error| Failure::input(format!("{}: {error}", path.display())))?;
    write_bytes(path, &bytes)
}

fn fst_bytes(module: &str, files: &Files) -> fst_writer::Result<Vec<u8>> {
    let (signals, clocks) = signals(files);
    let info = FstInfo {
        start_time: 0,
        timescale_exponent: -9,
        version: "guardbit".to_owned(),
        // No date: the same trace gives the same bytes.
        date: String::new(),
        file_type: FstFileType::Verilog,
    };
    let mut header = FstHeaderWriter::write_to_mem(&info)?;
    let module = identifier(module);
    header.scope(&module, &module, FstScopeType::Module)?;
    let mut var = |name: &str, width| {
        let (kind, direction) = (FstVarType::Reg, FstVarDirection::Implicit);
        header.var(name, FstSignalType::bit_vec(width), kind, direction, None)
    };
    let clock = var("clk", 1)?;
    let ids: Vec<_> = signals
        .iter()
        .map(|signal| var(&signal.name, signal.width))
        .collect::<fst_writer::Result<_>>()?;
    header.up_scope()?;
    let mut body = header.finish()?;
    for n in 0..clocks {
        body.time_change(n as u64 * CLOCK)?;
        body.signal_change(clock, b"1")?;
        for (signal, id) in signals.iter().zip(&ids) {
            body.signal_change(*id, signal.bits(n).unwrap_or_default().as_bytes())?;
        }
        body.time_change(n as u64 * CLOCK + CLOCK / 2)?;
        body.signal_change(clock, b"0")?;
    }
    body.time_change(clocks as u64 * CLOCK)?;
    Ok(body.finish()?.into_inner())
}

//! Drives a bench into an output, a buffer at a time: memory does not grow with the rows.

use super::bench::{Bench, Coverage, FileSpec, Run, TestAt};
use super::plan::{Shard, walk_tests};
use super::table::{RowFormat, Table, unpack};
use crate::format::Column;

/// Encoded bytes kept before they are handed on.
const BUFFER: usize = 1 << 18;

/// Takes a bench's files as they grow.
pub trait Output {
    /// Bytes of file number `file`, in order. An error or `false` in `Ok` stops the emission.
    ///
    /// # Errors
    /// Whatever writing or reading runs into.
    fn bytes(&mut self, file: usize, bytes: &[u8]) -> std::io::Result<bool>;
}

/// What an emission gave.
#[derive(Clone, Debug, Default)]
pub struct Emitted {
    /// Rows of each file.
    pub rows: Vec<u64>,
    /// Tests and rows of the first expectation file, by group.
    pub groups: Vec<(u64, u64)>,
    /// What the rows hit.
    pub coverage: Coverage,
}

/// The files of a bench in a format; none if the bench has no such form.
pub fn files(bench: &dyn Bench, format: RowFormat) -> Vec<FileSpec> {
    if format == RowFormat::TestFloat {
        bench.operand_file().into_iter().collect()
    } else {
        bench.files()
    }
}

/// Emits the tests of a shard as the reference model answers them.
///
/// # Errors
/// Whatever the output runs into.
pub fn emit(
    bench: &dyn Bench,
    shard: Shard,
    count: u64,
    format: RowFormat,
    output: &mut dyn Output,
) -> std::io::Result<Emitted> {
    run(bench, &mut *bench.reference(format), (shard, count), output)
}

/// Takes a device through the tests of a shard; `count` bounds the rows of a walk file.
///
/// # Errors
/// Whatever the output runs into.
pub fn run(
    bench: &dyn Bench,
    device: &mut dyn Run,
    (shard, count): (Shard, u64),
    output: &mut dyn Output,
) -> std::io::Result<Emitted> {
    if shard.index > 0 {
        // A header belongs to the first part only: the parts joined are the file.
        device.tables().into_iter().for_each(|table| table.buffer.clear());
    }
    let mut emitted = Emitted { groups: vec![(0, 0); bench.groups().len()], ..Emitted::default() };
    // Configuration files come first; the first expectation file counts the rows of a group.
    let counted = match device.tables().len() {
        // The bench has no such form.
        0 => return Ok(emitted),
        tables => usize::from(tables > 1),
    };
    let mut before = 0;
    for (at, limit) in walk_tests(bench, shard, count) {
        device.run(at, limit);
        let mut tables = device.tables();
        let rows = tables[counted].rows;
        let group = &mut emitted.groups[at.group];
        group.0 += 1;
        group.1 += rows - before;
        before = rows;
        if !flush(&mut tables, BUFFER, output)? {
            break;
        }
    }
    flush(&mut device.tables(), 1, output)?;
    emitted.rows = device.tables().iter().map(|table| table.rows).collect();
    emitted.coverage = device.met().clone();
    Ok(emitted)
}

/// Hands on every buffer of at least `least` bytes.
fn flush(
    tables: &mut [&mut Table],
    least: usize,
    output: &mut dyn Output,
) -> std::io::Result<bool> {
    for (file, table) in tables.iter_mut().enumerate() {
        if table.buffer.len() >= least {
            let go_on = output.bytes(file, &table.buffer)?;
            table.buffer.clear();
            if !go_on {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// The lines of one test, file by file.
pub fn test_lines(bench: &dyn Bench, at: TestAt, format: RowFormat) -> Vec<(FileSpec, String)> {
    let mut device = bench.reference(format);
    device.run(at, u64::MAX);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let tables = device.tables().into_iter().map(|table| text(&table.buffer));
    files(bench, format).into_iter().zip(tables).collect()
}

/// The rows of one test, file by file, as words.
pub fn test_rows(bench: &dyn Bench, at: TestAt) -> Vec<(FileSpec, Vec<Vec<u128>>)> {
    let mut device = bench.reference(RowFormat::Bin);
    device.run(at, u64::MAX);
    let files = bench.files().into_iter().zip(device.tables());
    let rows = files.map(|(spec, table)| {
        let stride: usize = spec.columns.iter().map(Column::bytes).sum();
        let rows = table.buffer.chunks_exact(stride).map(|row| unpack(row, &spec.columns));
        let rows = rows.collect();
        (spec, rows)
    });
    rows.collect()
}

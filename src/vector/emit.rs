//! Drives a bench into an output, a buffer at a time: memory does not grow with the rows.

use super::bench::{Bench, Coverage, FileSpec, TestAt};
use super::plan::{Shard, walk_tests};
use super::table::{RowFormat, Table};

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
        bench.files().to_vec()
    }
}

/// Emits the tests of a shard.
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
    let specs = files(bench, format);
    let mut tables: Vec<Table> =
        specs.iter().map(|spec| Table::new(format, &spec.columns)).collect();
    if shard.index > 0 {
        // A header belongs to the first part only: the parts joined are the file.
        for table in &mut tables {
            table.buffer.clear();
        }
    }
    let mut emitted = Emitted { groups: vec![(0, 0); bench.groups().len()], ..Emitted::default() };
    // Configuration files come first; the first expectation file counts the rows of a group.
    let counted = usize::from(tables.len() > 1);
    for (at, limit) in walk_tests(bench, shard, count) {
        if tables.is_empty() {
            break;
        }
        let before = tables[counted].rows;
        bench.emit(at, limit, &mut tables, &mut emitted.coverage);
        let group = &mut emitted.groups[at.group];
        group.0 += 1;
        group.1 += tables[counted].rows - before;
        if !flush(&mut tables, BUFFER, output)? {
            break;
        }
    }
    flush(&mut tables, 1, output)?;
    emitted.rows = tables.iter().map(|table| table.rows).collect();
    Ok(emitted)
}

/// Hands on every buffer of at least `least` bytes.
fn flush(tables: &mut [Table], least: usize, output: &mut dyn Output) -> std::io::Result<bool> {
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

/// The rows of one test, file by file, as words.
pub fn test_rows(bench: &dyn Bench, at: TestAt) -> Vec<(FileSpec, Vec<Vec<u128>>)> {
    let specs = bench.files().to_vec();
    let mut tables: Vec<Table> =
        specs.iter().map(|spec| Table::new(RowFormat::Tv, &spec.columns)).collect();
    bench.emit(at, u64::MAX, &mut tables, &mut Coverage::default());
    specs.into_iter().zip(tables.iter_mut().map(Table::take_words)).collect()
}

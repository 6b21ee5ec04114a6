//! `pkg.vh`: macros for Verilog-2001, to be included anywhere.

use super::Interface;
use super::record::Record;
use super::template::{self, comment};

const TEMPLATE: &str = include_str!("pkg.vh.in");

/// The whole include file.
pub(super) fn package(interface: &Interface, records: &[Record]) -> String {
    let files: Vec<String> = records.iter().map(file).collect();
    template::package(
        interface,
        TEMPLATE,
        ("// @TEXT@\n", "`define GUARDBIT_@NAME@ @VALUE@\n"),
        &files,
    )
}

fn file(record: &Record) -> String {
    let name = format!("GUARDBIT_{}", record.constant());
    let mut lines = vec![
        format!(
            "// {}: rows, characters of a line with its newline, bits of a record",
            comment(&record.file.name)
        ),
        format!("`define {name}_ROWS 64'd{}", record.file.rows),
        format!("`define {name}_LINE {}", record.line),
        format!("`define {name}_BITS {}", record.bits),
        format!("`define {name}_PADS {}'h{}", record.bits, record.pads()),
    ];
    for field in &record.fields {
        let column = format!("{name}_{}", field.constant());
        let (msb, lsb) = (field.msb(), field.lsb);
        lines.push(format!("// {}", field.comment()));
        lines.push(format!("`define {column}_WIDTH {}", field.column.width));
        lines.push(format!("`define {column}_FRACTION {}", field.column.fraction));
        lines.push(format!("`define {column}_SIGNED {}", u8::from(field.column.signed)));
        lines.push(format!("`define {column}_MSB {msb}"));
        lines.push(format!("`define {column}_LSB {lsb}"));
        lines.push(format!("`define {column}(row) row[{msb}:{lsb}]"));
    }
    lines.push(String::new());
    lines.join("\n")
}

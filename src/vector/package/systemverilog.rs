//! `pkg.sv`: a SystemVerilog package.

use super::Interface;
use super::record::{Field, Record};
use super::template::{self, comment};

const TEMPLATE: &str = include_str!("pkg.sv.in");

/// The whole package.
pub(super) fn package(interface: &Interface, records: &[Record]) -> String {
    let files: Vec<String> = records.iter().map(file).collect();
    template::package(
        interface,
        TEMPLATE,
        ("    // @TEXT@\n", "    localparam int @NAME@ = @VALUE@;\n"),
        &files,
    )
}

fn file(record: &Record) -> String {
    let name = record.constant();
    let bits = record.bits;
    let mut lines = vec![
        format!("    // {}", comment(&record.file.name)),
        format!("    localparam logic [63:0] {name}_ROWS = 64'd{};", record.file.rows),
        format!(
            "    localparam int {name}_LINE = {};  // characters of a line with its newline",
            record.line
        ),
        format!("    localparam int {name}_BITS = {bits};  // four a digit"),
        format!(
            "    localparam logic [{}:0] {name}_PADS = {bits}'h{};  // zero in every record",
            bits - 1,
            record.pads()
        ),
    ];
    for field in &record.fields {
        let column = format!("{name}_{}", field.constant());
        lines.push(format!("    // {}", field.comment()));
        lines.push(format!("    localparam int {column}_WIDTH = {};", field.column.width));
        lines.push(format!("    localparam int {column}_FRACTION = {};", field.column.fraction));
        lines.push(format!(
            "    localparam int {column}_SIGNED = {};",
            u8::from(field.column.signed)
        ));
    }
    lines.push("    typedef struct packed {".to_owned());
    lines.extend(record.fields.iter().enumerate().flat_map(|(index, field)| members(index, field)));
    lines.push(format!("    }} {}_t;\n", record.id));
    lines.join("\n")
}

/// The padding of a column, if it has any, and the column.
fn members(index: usize, field: &Field) -> Vec<String> {
    let pad = field.pad();
    let mut lines = Vec::new();
    if pad > 0 {
        lines.push(format!("        logic [{}:0] pad{index};", pad - 1));
    }
    let sign = if field.column.signed { "signed " } else { "" };
    lines.push(format!("        logic {sign}[{}:0] {};", field.column.width - 1, field.id));
    lines
}

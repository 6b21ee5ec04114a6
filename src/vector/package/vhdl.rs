//! `pkg.vhd`: a VHDL-2008 package.

use super::Interface;
use super::record::Record;
use super::template::{self, comment, fill};

const TEMPLATE: &str = include_str!("pkg.vhd.in");

/// The whole package, declaration and body.
pub(super) fn package(interface: &Interface, records: &[Record]) -> String {
    let files: Vec<String> = records.iter().map(declaration).collect();
    let bodies: Vec<String> = records.iter().map(body).collect();
    template::package(
        interface,
        &fill(TEMPLATE, &[("BODIES", &bodies.join("\n"))]),
        ("    -- @TEXT@\n", "    constant @NAME@ : natural := @VALUE@;\n"),
        &files,
    )
}

fn declaration(record: &Record) -> String {
    let name = record.constant();
    let top = record.bits - 1;
    let mut lines = vec![
        format!(
            "    -- {}: rows, characters of a line without its newline, bits of a record",
            comment(&record.file.name)
        ),
        format!(
            "    constant {name}_ROWS : unsigned(63 downto 0) := x\"{:016x}\";  -- {}",
            record.file.rows, record.file.rows
        ),
        format!("    constant {name}_LINE : positive := {};", record.line - 1),
        format!("    constant {name}_BITS : positive := {};", record.bits),
        format!(
            "    constant {name}_PADS : std_logic_vector({top} downto 0) := x\"{}\";",
            record.pads()
        ),
    ];
    for field in &record.fields {
        let column = format!("{name}_{}", field.constant());
        lines.push(format!("    -- {}", field.comment()));
        lines.push(format!("    constant {column}_WIDTH : positive := {};", field.column.width));
        lines.push(format!(
            "    constant {column}_FRACTION : natural := {};",
            field.column.fraction
        ));
        lines.push(format!("    constant {column}_SIGNED : boolean := {};", field.column.signed));
    }
    lines.push(format!("    type {}_t is record", record.id));
    for field in &record.fields {
        lines.push(format!(
            "        {} : std_logic_vector({} downto 0);",
            field.id,
            field.column.width - 1
        ));
    }
    lines.push(format!("    end record {}_t;", record.id));
    lines.push(format!("    function to_{0}(bits : std_logic_vector) return {0}_t;\n", record.id));
    lines.join("\n")
}

fn body(record: &Record) -> String {
    let id = &record.id;
    let mut lines = vec![
        format!("    function to_{id}(bits : std_logic_vector) return {id}_t is"),
        format!(
            "        alias packed_bits : std_logic_vector({} downto 0) is bits;",
            record.bits - 1
        ),
        format!("        variable row : {id}_t;"),
        "    begin".to_owned(),
    ];
    for field in &record.fields {
        lines.push(format!(
            "        row.{} := packed_bits({} downto {});",
            field.id,
            field.msb(),
            field.lsb
        ));
    }
    lines.push("        return row;".to_owned());
    lines.push(format!("    end function to_{id};\n"));
    lines.join("\n")
}

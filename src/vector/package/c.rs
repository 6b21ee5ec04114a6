//! `pkg.h`: a header for C99 and C++.

use super::Interface;
use super::record::{Field, Record};
use super::template::{self, comment};

const TEMPLATE: &str = include_str!("pkg.h.in");

/// The whole header.
pub(super) fn package(interface: &Interface, records: &[Record]) -> String {
    let files: Vec<String> = records.iter().map(file).collect();
    template::package(
        interface,
        TEMPLATE,
        ("/* @TEXT@ */\n", "#define GUARDBIT_@NAME@ @VALUE@\n"),
        &files,
    )
}

fn file(record: &Record) -> String {
    let name = format!("GUARDBIT_{}", record.constant());
    let id = &record.id;
    let mut lines = vec![
        format!(
            "/* {}: rows, characters of a line with its newline, bits of a record */",
            comment(&record.file.name)
        ),
        format!("#define {name}_ROWS UINT64_C({})", record.file.rows),
        format!("#define {name}_LINE {}", record.line),
        format!("#define {name}_BITS {}", record.bits),
    ];
    for field in &record.fields {
        let column = format!("{name}_{}", field.constant());
        lines.push(format!("/* {} */", field.comment()));
        lines.push(format!("#define {column}_WIDTH {}", field.column.width));
        lines.push(format!("#define {column}_FRACTION {}", field.column.fraction));
        lines.push(format!("#define {column}_SIGNED {}", u8::from(field.column.signed)));
    }
    lines.push(
        "/* X(name, width, signed, fraction, digits, lowest bit in the packed record) */"
            .to_owned(),
    );
    let columns: Vec<String> =
        record.fields.iter().map(|f| format!("    X({})", shape(f))).collect();
    lines.push(format!("#define {name}_COLUMNS(X) \\\n{}", columns.join(" \\\n")));
    lines.push(format!("struct guardbit_{id} {{"));
    for field in &record.fields {
        let words = if field.column.width > 64 { "[2]" } else { "" };
        lines.push(format!("    uint64_t {}{words};", field.id));
    }
    lines.push("};".to_owned());
    lines.push(format!(
        "static inline int guardbit_{id}_parse(const char *line, struct guardbit_{id} *row) {{"
    ));
    lines.push("    uint64_t word[2];".to_owned());
    for (index, field) in record.fields.iter().enumerate() {
        let end = if index + 1 == record.fields.len() { "\\n" } else { "_" };
        let digits = field.column.digits();
        lines.push(format!(
            "    if (!guardbit_word(&line, {digits}, {}, '{end}', word)) return 0;",
            field.column.width
        ));
        if field.column.width > 64 {
            lines.push(format!("    row->{0}[0] = word[0];\n    row->{0}[1] = word[1];", field.id));
        } else {
            lines.push(format!("    row->{} = word[0];", field.id));
        }
    }
    lines.push("    return 1;\n}\n".to_owned());
    lines.join("\n")
}

fn shape(field: &Field) -> String {
    let column = field.column;
    let signed = u8::from(column.signed);
    format!(
        "{}, {}, {signed}, {}, {}, {}",
        field.id,
        column.width,
        column.fraction,
        column.digits(),
        field.lsb
    )
}

//! Devices of the units of channels: modules of `hdl`, and a module around each for every bench. Clause
//! `CH-19`.

use super::plan::Plan;
use super::record::{Field, Record};
use super::rtl::{Source, Values, systemverilog};
use super::{Interface, UnitDevice};
use crate::format::Role;

/// The module that walks; the others are driven by streams.
pub(super) const INTERPOLATOR: &str = "interpolator";

static BIT_LENGTH: Source =
    systemverilog("bit_length.sv", include_str!("../../../hdl/bit_length.sv"), &[]);
static TABLE: Source =
    systemverilog("reciprocal_table.sv", include_str!("../../../hdl/reciprocal_table.sv"), &[]);
static NEWTON_STEP: Source =
    systemverilog("newton_step.sv", include_str!("../../../hdl/newton_step.sv"), &[]);
static RECIPROCAL: Source =
    systemverilog("reciprocal_unit.sv", include_str!("../../../hdl/reciprocal_unit.sv"), &[]);
static HELD_VALUE: Source =
    systemverilog("held_value.sv", include_str!("../../../hdl/held_value.sv"), &[]);
static INTERPOLATES: Source =
    systemverilog("interpolator.sv", include_str!("../../../hdl/interpolator.sv"), &[]);
pub(super) static ROUNDED_SHIFT: Source =
    systemverilog("rounded_shift.sv", include_str!("../../../hdl/rounded_shift.sv"), &[]);
static DIVIDER: Source = systemverilog(
    "perspective_divider.sv",
    include_str!("../../../hdl/perspective_divider.sv"),
    &[],
);

/// What each kind of device is made of.
const WALKS: &[&Source] = &[&HELD_VALUE, &INTERPOLATES];
const RECIPROCALS: &[&Source] = &[&BIT_LENGTH, &TABLE, &NEWTON_STEP, &RECIPROCAL];
const DIVIDES: &[&Source] = &[
    &HELD_VALUE,
    &super::rtl::SETUP_DIVIDER,
    &BIT_LENGTH,
    &TABLE,
    &NEWTON_STEP,
    &RECIPROCAL,
    &ROUNDED_SHIFT,
    &DIVIDER,
];

/// All of them, for what is asked of every device.
#[cfg(test)]
pub(super) const ALL: [&Source; 8] = [
    &BIT_LENGTH,
    &TABLE,
    &NEWTON_STEP,
    &RECIPROCAL,
    &HELD_VALUE,
    &INTERPOLATES,
    &ROUNDED_SHIFT,
    &DIVIDER,
];

/// The name of a bench where only letters, digits and _ can stand.
pub(super) fn wire(bench: &str) -> String {
    bench.replace('-', "_")
}

impl UnitDevice {
    /// The name of its module, which is none of those in `hdl`, however a channel is called.
    pub(super) fn device(&self) -> String {
        format!("dut_{}", wire(&self.bench))
    }

    /// The modules of `hdl` that it is made of.
    fn parts(&self) -> &'static [&'static Source] {
        match self.module {
            INTERPOLATOR => WALKS,
            "reciprocal_unit" => RECIPROCALS,
            _ => DIVIDES,
        }
    }
}

/// The modules of the units that a testbench drives: each of `hdl` once, where the set-up has not brought
/// it, and one around it for each bench.
pub(super) fn modules(interface: &Interface, records: &[Record], plan: &Plan<'_>) -> String {
    let names = plan.names();
    let driven: Vec<&UnitDevice> =
        interface.units.iter().filter(|unit| names.contains(&unit.bench.as_str())).collect();
    let has_setup = names.contains(&"setup");
    let mut text = String::new();
    let mut known: Vec<&str> = Vec::new();
    for part in driven.iter().flat_map(|unit| unit.parts()) {
        let file = part.file();
        if known.contains(&file) || has_setup && file == super::rtl::SETUP_DIVIDER.file() {
            continue;
        }
        known.push(file);
        text += "\n";
        text += &part.with(&Values::default());
    }
    for unit in driven {
        text += &around(unit, records);
    }
    text
}

/// The module of a bench.
fn around(unit: &UnitDevice, records: &[Record]) -> String {
    let find = |kind: &str| {
        let name = format!("{}.{kind}.tv", unit.bench);
        records.iter().find(|record| record.file.name == name)
    };
    let (Some(cfg), Some(exp)) = (find("cfg"), find("exp")) else { return String::new() };
    let walks = unit.module == INTERPOLATOR;
    let width = |bits: u32| if bits == 1 { String::new() } else { format!("[{}:0]", bits - 1) };
    let mut ports = vec![("input", String::new(), "clk".to_owned())];
    ports.push(("input", String::new(), "rst".to_owned()));
    let field = |field: &Field, prefix: &str| {
        (format!("[{}:0]", field.column.width - 1), format!("{prefix}{}", field.id))
    };
    if walks {
        ports.push(("input", width(2), Role::OP.pattern.to_owned()));
    } else {
        ports.push(("input", String::new(), "in_valid".to_owned()));
        ports.push(("output", String::new(), "in_ready".to_owned()));
        ports.push(("output", String::new(), "out_valid".to_owned()));
        ports.push(("input", String::new(), "out_ready".to_owned()));
    }
    ports.extend(cfg.fields.iter().map(|column| field(column, "")).map(|(w, id)| ("input", w, id)));
    let answered = exp.fields.iter().filter(|column| column.column.name != Role::OP.pattern);
    let prefix = if walks { "" } else { "o_" };
    ports.extend(answered.map(|column| field(column, prefix)).map(|(w, id)| ("output", w, id)));
    let widest = ports.iter().map(|(_, width, _)| width.len()).max().unwrap_or(0);
    let declared: Vec<String> = ports
        .iter()
        .map(|(way, width, id)| format!("    {way:<6} logic {width:<widest$} {id}"))
        .collect();
    let values: Vec<String> =
        unit.values.iter().map(|(name, value)| format!("        .{name}({value})")).collect();
    let connected: Vec<String> =
        ports.iter().map(|(_, _, id)| format!("        .{id}({id})")).collect();
    let (module, bench) = (unit.module, &unit.bench);
    format!(
        "\n// The device of the bench {bench}, with the words of this set.\nmodule {} (\n{}\n);\n    {module} #(\n{}\n    ) device (\n{}\n    );\nendmodule\n",
        unit.device(),
        declared.join(",\n"),
        values.join(",\n"),
        connected.join(",\n"),
    )
}

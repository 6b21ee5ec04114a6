//! The devices of `hdl` with a set's parameters as their defaults.

use super::template::mode;
use super::{ClampParameters, SetupParameters};

/// A module or entity, its text, and the mark before the value of a parameter.
struct Source {
    text: &'static str,
    mark: fn(&str) -> String,
}

const fn systemverilog(text: &'static str) -> Source {
    Source { text, mark: |name| format!("parameter int {name} = ") }
}

const fn vhdl(text: &'static str) -> Source {
    Source { text, mark: |name| format!("        {name:<4} : natural := ") }
}

/// A device in SystemVerilog by the name of its module.
pub(super) fn module(name: &str, values: &[(&str, i128)]) -> String {
    let text = match name {
        "dda" => include_str!("../../../hdl/dda.sv"),
        "edge_stepper" => include_str!("../../../hdl/edge_stepper.sv"),
        "edge_evaluator" => include_str!("../../../hdl/edge_evaluator.sv"),
        "depth_evaluator" => include_str!("../../../hdl/depth_evaluator.sv"),
        "setup_divider" => include_str!("../../../hdl/setup_divider.sv"),
        "triangle_setup" => include_str!("../../../hdl/triangle_setup.sv"),
        "triangle_engine" => include_str!("../../../hdl/triangle_engine.sv"),
        _ => "",
    };
    systemverilog(text).with(values)
}

/// A device in VHDL by the name of its entity.
pub(super) fn entity(name: &str, values: &[(&str, i128)]) -> String {
    let text = match name {
        "dda" => include_str!("../../../hdl/dda.vhd"),
        "edge_stepper" => include_str!("../../../hdl/edge_stepper.vhd"),
        _ => "",
    };
    vhdl(text).with(values)
}

impl Source {
    fn with(&self, values: &[(&str, i128)]) -> String {
        values.iter().fold(self.text.to_owned(), |text, (name, value)| {
            let mark = (self.mark)(name);
            let Some(at) = text.find(&mark).map(|at| at + mark.len()) else { return text };
            let rest = &text[at..];
            let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
            format!("{}{value}{}", &text[..at], &rest[end..])
        })
    }
}

/// Parameters of the depth read-out.
pub(super) fn clamp(clamp: &ClampParameters) -> Vec<(&'static str, i128)> {
    vec![
        ("G", clamp.guard.into()),
        ("I", clamp.integer.into()),
        ("F", clamp.fraction.into()),
        ("MODE", mode(&clamp.mode).1),
    ]
}

/// Parameters of the set-up.
pub(super) fn setup(setup: &SetupParameters) -> Vec<(&'static str, i128)> {
    vec![
        ("VS", setup.signed.into()),
        ("S", setup.sub_pixel.into()),
        ("SAMPLE_X", setup.sample[0]),
        ("SAMPLE_Y", setup.sample[1]),
        ("RULE", setup.shadow.into()),
        ("SHIFT", setup.shift.into()),
        ("M", setup.edge.into()),
        ("ROUNDING", setup.rounding as i128),
        ("HALF", setup.half.into()),
        // A bit a clock is for hardware: in an event-driven simulator it takes most of a bench's time.
        ("SERIAL", 0),
    ]
}

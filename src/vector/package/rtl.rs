//! The devices of `hdl` with a set's parameters as their defaults.

use super::{ClampParameters, Interface, SetupParameters, wired};
use crate::machine::{QuadDevice, RegisterDevice, WiredDevice};

/// A module or entity of `hdl`.
pub(super) struct Source {
    /// Its file and the file's text.
    file: &'static str,
    text: &'static str,
    /// The parameters that a set decides. The others are told by whoever instantiates the device.
    parameters: &'static [&'static str],
    /// What stands before the value of a parameter.
    mark: fn(&str) -> String,
}

/// A parameter that a set decides and that a device's text does not declare, or the other way
/// round: the text and the list of parameters no longer belong together.
#[derive(Debug, thiserror::Error, PartialEq, Eq)]
pub(super) enum ParameterError {
    #[error("{file}: no line declares the parameter {parameter} in the form `{mark}VALUE`")]
    Undeclared { file: &'static str, parameter: String, mark: String },
    #[error("{file}: the set has no value for the parameter {parameter}")]
    NoValue { file: &'static str, parameter: String },
}

pub(super) const fn systemverilog(
    file: &'static str,
    text: &'static str,
    parameters: &'static [&'static str],
) -> Source {
    Source { file, text, parameters, mark: |name| format!("parameter int {name} = ") }
}

const fn vhdl(
    file: &'static str,
    text: &'static str,
    parameters: &'static [&'static str],
) -> Source {
    Source { file, text, parameters, mark: |name| format!("        {name:<4} : natural := ") }
}

const READ_OUT: &[&str] = &["G", "I", "F", "MODE"];
const ENGINE: &[&str] = &["M", "G", "I", "F", "MODE", "C"];
const SET_UP: &[&str] = &[
    "VW", "VS", "S", "SAMPLE_X", "SAMPLE_Y", "RULE", "SHIFT", "M", "G", "I", "F", "ROUNDING",
    "HALF",
];

/// The depth DDA.
pub(super) static DDA: Source =
    systemverilog("dda.sv", include_str!("../../../hdl/dda.sv"), READ_OUT);
/// The edge stepper.
pub(super) static EDGE_STEPPER: Source =
    systemverilog("edge_stepper.sv", include_str!("../../../hdl/edge_stepper.sv"), &["M"]);
/// An edge function over a box.
pub(super) static EDGE_EVALUATOR: Source =
    systemverilog("edge_evaluator.sv", include_str!("../../../hdl/edge_evaluator.sv"), &["M", "C"]);
/// A depth plane over a box.
pub(super) static DEPTH_EVALUATOR: Source = systemverilog(
    "depth_evaluator.sv",
    include_str!("../../../hdl/depth_evaluator.sv"),
    &["G", "I", "F", "MODE", "C"],
);
/// The divider of the set-up, which tells it everything.
pub(super) static SETUP_DIVIDER: Source =
    systemverilog("setup_divider.sv", include_str!("../../../hdl/setup_divider.sv"), &[]);
/// The set-up.
pub(super) static TRIANGLE_SETUP: Source = systemverilog(
    "triangle_setup.sv",
    include_str!("../../../hdl/triangle_setup.sv"),
    &[
        "VW", "VS", "S", "SAMPLE_X", "SAMPLE_Y", "RULE", "SHIFT", "M", "G", "I", "F", "ROUNDING",
        "HALF", "SERIAL",
    ],
);
/// The triangle engine.
pub(super) static TRIANGLE_ENGINE: Source =
    systemverilog("triangle_engine.sv", include_str!("../../../hdl/triangle_engine.sv"), ENGINE);
/// The engine of given edge functions.
pub(super) static QUAD_ENGINE: Source = systemverilog(
    "quad_engine.sv",
    include_str!("../../../hdl/quad_engine.sv"),
    &["W", "T", "B", "C"],
);
/// The depth DDA in VHDL.
pub(super) static DDA_VHDL: Source =
    vhdl("dda.vhd", include_str!("../../../hdl/dda.vhd"), READ_OUT);
/// The edge stepper in VHDL.
pub(super) static EDGE_STEPPER_VHDL: Source =
    vhdl("edge_stepper.vhd", include_str!("../../../hdl/edge_stepper.vhd"), &["M"]);
/// The divider of the set-up in VHDL, which tells it everything.
pub(super) static SETUP_DIVIDER_VHDL: Source =
    vhdl("setup_divider.vhd", include_str!("../../../hdl/setup_divider.vhd"), &[]);
/// The set-up in VHDL.
pub(super) static TRIANGLE_SETUP_VHDL: Source =
    vhdl("triangle_setup.vhd", include_str!("../../../hdl/triangle_setup.vhd"), SET_UP);
/// The triangle engine in VHDL.
pub(super) static TRIANGLE_ENGINE_VHDL: Source =
    vhdl("triangle_engine.vhd", include_str!("../../../hdl/triangle_engine.vhd"), ENGINE);

/// The constant of the packages that a parameter is set to; those of widths depend on the bench.
pub(super) fn constant(parameter: &str) -> Option<&'static str> {
    let constants = [
        ("G", "GUARD_BITS"),
        ("I", "INTEGER_BITS"),
        ("F", "FRACTION_BITS"),
        ("MODE", "CLAMP_MODE"),
        ("S", "SUB_PIXEL_BITS"),
        ("SAMPLE_X", "SAMPLE_X"),
        ("SAMPLE_Y", "SAMPLE_Y"),
        ("RULE", "SHADOW_RULE"),
        ("SHIFT", "EDGE_SHIFT"),
        ("ROUNDING", "ROUNDING"),
        ("HALF", "START_HALF"),
        ("W", "QUAD_EDGE_BITS"),
        ("T", "QUAD_TILE"),
        ("B", "QUAD_BLOCK"),
    ];
    let wired = wired::PARAMETERS.map(|(name, constant, _)| (name, constant));
    let mut all = constants.into_iter().chain(wired);
    all.find(|(name, _)| *name == parameter).map(|(_, constant)| constant)
}

/// What the packages say of set-up and engine: constant, value, and what it is.
pub(super) fn constants(interface: &Interface) -> Vec<(&'static str, i128, String)> {
    let listed = |Values(values): Values, what: &[(&str, String)]| {
        let constants = what.iter().map(|(parameter, what)| {
            let value = values.iter().find(|(name, _)| name == parameter);
            let (Some(name), Some((_, value))) = (constant(parameter), value) else {
                unreachable!("{parameter} is a parameter with a constant")
            };
            (name, *value, what.clone())
        });
        constants.collect::<Vec<_>>()
    };
    let mut all = Vec::new();
    if let Ok(setup) = &interface.setup {
        let rounding = setup.rounding.names().guardbit;
        all.extend(listed(
            Values::default().and_setup(setup),
            &[
                ("S", "Set-up: sub-pixel bits of a vertex".to_owned()),
                ("SAMPLE_X", "the sample in its pixel, in sub-pixels".to_owned()),
                ("SAMPLE_Y", "the same, downward".to_owned()),
                ("RULE", "fill rule: 0 top-left, 1 shadow".to_owned()),
                ("SHIFT", "low bits of an edge value that are not kept".to_owned()),
                ("ROUNDING", format!("of start and slopes, as setup_divider has it: {rounding}")),
                ("HALF", "1: the start gains half a depth step".to_owned()),
            ],
        ));
    }
    match &interface.registers {
        Ok(RegisterDevice::Quads(quads)) => {
            all.extend(listed(
                Values::of_quads(quads),
                &[
                    ("W", "Quad engine: bits of an edge word".to_owned()),
                    ("T", "pixels on a side of a tile".to_owned()),
                    ("B", "pixels on a side of the smallest part that is tested".to_owned()),
                ],
            ));
            let what = "bits of a register of a pixel coordinate".to_owned();
            all.push(("QUAD_COORDINATE_BITS", quads.coordinate.into(), what));
        }
        Ok(RegisterDevice::Wired(WiredDevice { values, .. })) => {
            for (parameter, constant, what) in wired::PARAMETERS {
                let value = values.iter().find(|(name, _)| *name == parameter);
                all.extend(value.map(|(_, value)| (constant, *value, what.to_owned())));
            }
        }
        Err(_) => {}
    }
    all
}

impl Source {
    /// The parameters that a set decides.
    pub(super) fn parameters(&self) -> &'static [&'static str] {
        self.parameters
    }

    /// The name of its file in `hdl`.
    pub(super) fn file(&self) -> &'static str {
        self.file
    }

    /// The text with a set's values as defaults.
    ///
    /// # Panics
    /// If the device does not declare a parameter of its list: then the text in `hdl` and the list
    /// here have parted, and no set of this build can be right.
    pub(super) fn with(&self, values: &Values) -> String {
        self.filled(values)
            .unwrap_or_else(|error| unreachable!("the devices are part of this crate: {error}"))
    }

    fn filled(&self, values: &Values) -> Result<String, ParameterError> {
        self.parameters.iter().try_fold(self.text.to_owned(), |text, name| {
            let parameter = (*name).to_owned();
            let Some((_, value)) = values.0.iter().find(|(known, _)| known == name) else {
                return Err(ParameterError::NoValue { file: self.file, parameter });
            };
            let mark = (self.mark)(name);
            let Some(at) = text.find(&mark).map(|at| at + mark.len()) else {
                return Err(ParameterError::Undeclared { file: self.file, parameter, mark });
            };
            let (before, rest) = text.split_at(at);
            let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
            Ok(format!("{before}{value}{after}"))
        })
    }
}

/// Parameters and their values.
#[derive(Clone, Debug, Default)]
pub(super) struct Values(Vec<(&'static str, i128)>);

impl Values {
    /// Parameters of the depth read-out.
    pub(super) fn of_clamp(clamp: &ClampParameters) -> Self {
        Self(vec![
            ("G", clamp.guard.into()),
            ("I", clamp.integer.into()),
            ("F", clamp.fraction.into()),
            ("MODE", clamp.mode.code().into()),
        ])
    }

    /// Parameters of the engine of given edge functions.
    pub(super) fn of_quads(quads: &QuadDevice) -> Self {
        Self(vec![
            ("W", quads.edge.into()),
            ("T", quads.tile.into()),
            ("B", quads.block.into()),
            ("C", quads.coordinate.into()),
        ])
    }

    /// Parameters as they are listed.
    pub(super) fn listed(values: &[(&'static str, i128)]) -> Self {
        Self(values.to_vec())
    }

    /// With those of the set-up.
    pub(super) fn and_setup(mut self, setup: &SetupParameters) -> Self {
        self.0.extend(setup.parameters());
        // A bit a clock is for hardware: in an event-driven simulator it takes most of a bench's
        // time.
        self.0.push(("SERIAL", 0));
        self
    }

    /// With one more.
    pub(super) fn and(mut self, name: &'static str, value: impl Into<i128>) -> Self {
        self.0.push((name, value.into()));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bits::Rounding;
    use crate::format::Clamp;
    use crate::vector::package::unit;
    use std::collections::BTreeMap;

    const ALL: [&Source; 13] = [
        &DDA,
        &EDGE_STEPPER,
        &EDGE_EVALUATOR,
        &DEPTH_EVALUATOR,
        &SETUP_DIVIDER,
        &TRIANGLE_SETUP,
        &TRIANGLE_ENGINE,
        &QUAD_ENGINE,
        &DDA_VHDL,
        &EDGE_STEPPER_VHDL,
        &SETUP_DIVIDER_VHDL,
        &TRIANGLE_SETUP_VHDL,
        &TRIANGLE_ENGINE_VHDL,
    ];

    fn all() -> impl Iterator<Item = &'static Source> {
        ALL.into_iter().chain(wired::ALL).chain(unit::ALL)
    }

    /// A value of its own for each parameter of a device.
    fn values(source: &Source) -> Values {
        Values(source.parameters.iter().zip(101..).map(|(name, value)| (*name, value)).collect())
    }

    /// Integer constants of a text, `NAME = 1` or `NAME : natural := 1`.
    fn constants(text: &str) -> BTreeMap<String, u32> {
        let declared = text.lines().map(str::trim_start).filter(|line| {
            ["localparam int ", "constant "].iter().any(|start| line.starts_with(start))
        });
        let declared = declared.map(|line| line.split("//").next().unwrap().replace(":=", "="));
        let pairs = declared.flat_map(|line| {
            let parts: Vec<String> = line.split([',', ';']).map(str::to_owned).collect();
            parts.into_iter().filter_map(|part| {
                let (left, right) = part.split_once('=')?;
                let left = left.split(':').next()?;
                Some((left.split_whitespace().last()?.to_owned(), right.trim().parse().ok()?))
            })
        });
        pairs.collect()
    }

    #[test]
    fn every_parameter_of_a_set_is_set_in_every_device() {
        for source in all() {
            let text = source.filled(&values(source)).unwrap();
            for (name, value) in values(source).0 {
                let set = format!("{}{value}", (source.mark)(name));
                assert_eq!(text.matches(&set).count(), 1, "{}: {set}", source.file);
            }
            // Nothing else has moved.
            assert_eq!(text.lines().count(), source.text.lines().count(), "{}", source.file);
        }
    }

    #[test]
    fn a_parameter_that_is_not_declared_stops_loudly() {
        for source in all() {
            for name in source.parameters {
                let renamed = source.text.replace(&(source.mark)(name), &(source.mark)("OTHER"));
                let text: &'static str = Box::leak(renamed.into_boxed_str());
                let error = Source { text, ..*source }.filled(&values(source)).unwrap_err();
                let said = error.to_string();
                assert!(said.contains(source.file) && said.contains(name), "{said}");
            }
        }
        let no_value = TRIANGLE_ENGINE.filled(&values(&DDA)).unwrap_err();
        let expected =
            ParameterError::NoValue { file: "triangle_engine.sv", parameter: "M".into() };
        assert_eq!(no_value, expected);
    }

    #[test]
    #[should_panic(expected = "edge_stepper.sv: no line declares the parameter M")]
    fn a_device_without_its_parameter_makes_no_set() {
        let source = Source { text: "module edge_stepper;\nendmodule\n", ..EDGE_STEPPER };
        source.with(&values(&source));
    }

    // Clause J-1
    #[test]
    fn codes_of_roundings_and_clamps_are_those_of_the_devices() {
        let dividers = [&SETUP_DIVIDER, &SETUP_DIVIDER_VHDL].map(|source| constants(source.text));
        for rounding in Rounding::ALL {
            let names = rounding.names();
            let constant = names.guardbit.replace('-', "_").to_uppercase();
            for divider in &dividers {
                assert_eq!(divider.get(&constant), Some(&names.code), "{constant}");
            }
            let used = format!("            {constant}: up = ");
            assert_eq!(SETUP_DIVIDER.text.matches(&used).count(), 1, "{used}");
            // The product of a perspective divider is rounded by a table of its own.
            let shift = unit::ROUNDED_SHIFT.text;
            assert_eq!(constants(shift).get(&constant), Some(&names.code), "{constant}");
            let table = |text: &str| {
                let line = text.lines().find(|line| line.starts_with(&used));
                line.map(str::to_owned)
            };
            assert_eq!(table(shift), table(SETUP_DIVIDER.text), "{used}");
            // In VHDL the others leave the magnitude as it is.
            let used = format!("                when {constant} => up := ");
            let times = usize::from(rounding != Rounding::TowardZero);
            assert_eq!(SETUP_DIVIDER_VHDL.text.matches(&used).count(), times, "{used}");
        }
        let mut codes: Vec<u32> = Rounding::ALL.iter().map(|r| r.names().code).collect();
        codes.sort_unstable();
        codes.dedup();
        assert_eq!(codes.len(), Rounding::ALL.len(), "one code a rounding");
        for source in [&DDA, &DDA_VHDL] {
            let constants = constants(source.text);
            for clamp in [Clamp::Guard, Clamp::Sign, Clamp::Saturate] {
                let constant = clamp.name().to_uppercase();
                assert_eq!(constants.get(&constant), Some(&clamp.code()), "{}", source.file);
            }
            // Everything else is read out as it is.
            assert!(![1, 2, 3].contains(&Clamp::Wrap.code()));
        }
        assert_eq!(Clamp::Error.code(), Clamp::Guard.code());
        // The specification has both tables.
        let clamps = Clamp::ALL.into_iter().filter(|clamp| *clamp != Clamp::Error);
        let clamps: Vec<_> = clamps.map(|c| format!("{} {}", c.name(), c.code())).collect();
        let roundings = Rounding::ALL.map(|r| format!("{r} {}", r.names().code));
        let spec = include_str!("../../../spec/21-hardware.md");
        for (parameter, codes) in [("MODE", clamps.join(", ")), ("ROUNDING", roundings.join(", "))]
        {
            let line = format!("| `{parameter}` | {codes} |\n");
            assert!(spec.contains(&line), "{line}");
        }
        // The packages spell each mode, in VHDL by its place in the type.
        let places = ["WRAP", "GUARD", "SIGN", "SATURATE"];
        for clamp in Clamp::ALL.into_iter().filter(|clamp| *clamp != Clamp::Error) {
            let (name, code) = (clamp.name().to_uppercase(), clamp.code());
            for (text, line) in [
                (include_str!("pkg.sv.in"), format!("localparam int CLAMP_{name} = {code};\n")),
                (include_str!("pkg.vh.in"), format!("`define GUARDBIT_CLAMP_{name} {code}\n")),
                (include_str!("pkg.h.in"), format!("#define GUARDBIT_CLAMP_{name} {code}\n")),
            ] {
                assert!(text.contains(&line), "{line}");
            }
            assert_eq!(places[code as usize], name);
        }
        let listed = places.map(|name| format!("CLAMP_{name}")).join(", ");
        let line = format!("type clamp_t is ({listed});");
        assert!(include_str!("pkg.vhd.in").contains(&line), "{line}");
    }
}

//! Programs from outside. Where one is missing its trials count as ignored, with the reason in
//! their name; with `GUARDBIT_REQUIRE_TOOLS=1` a missing program is a failure, with
//! `GUARDBIT_REQUIRE_HDL=1` a missing hardware tool.
#![allow(dead_code, reason = "each test file takes what it needs")]

use libtest_mimic::{Failed, Trial};
use std::process::{Command, Stdio};

/// A program that this crate does not bring.
pub(crate) struct Tool {
    pub(crate) name: &'static str,
    /// The names it may have on the search path.
    pub(crate) programs: &'static [&'static str],
    /// What asks it for its version.
    pub(crate) version: &'static str,
    /// Whether it is a tool of hardware design.
    pub(crate) hardware: bool,
    /// What to install.
    pub(crate) package: &'static str,
}

/// The programs that more than one test file runs.
pub(crate) const ICARUS: Tool = Tool::hardware(&["iverilog"], "-V", "apt-get install iverilog");
pub(crate) const VERILATOR: Tool =
    Tool::hardware(&["verilator"], "--version", "apt-get install verilator");
pub(crate) const GHDL: Tool = Tool::hardware(&["ghdl"], "--version", "apt-get install ghdl");
pub(crate) const YOSYS: Tool = Tool::hardware(&["yosys"], "-V", "apt-get install yosys");
pub(crate) const Z3: Tool = Tool::hardware(&["z3"], "--version", "apt-get install z3");

impl Tool {
    /// A tool of hardware design, with one program of its name.
    pub(crate) const fn hardware(
        programs: &'static [&'static str],
        version: &'static str,
        package: &'static str,
    ) -> Self {
        Self { name: programs[0], programs, version, hardware: true, package }
    }

    /// Another tool, named after the first of its programs.
    pub(crate) const fn other(programs: &'static [&'static str], package: &'static str) -> Self {
        Self { name: programs[0], programs, version: "--version", hardware: false, package }
    }

    /// The first of its programs that this machine has.
    pub(crate) fn program(&self) -> Option<&'static str> {
        self.programs.iter().copied().find(|program| {
            let mut command = Command::new(program);
            command.arg(self.version).stdin(Stdio::null());
            command.output().is_ok_and(|output| output.status.success())
        })
    }

    /// A trial of the soak tier: it counts as ignored, and says so, unless it is asked for.
    pub(crate) fn soak_trial(&self, name: &str, test: fn(&str)) -> Trial {
        let name = format!("{name} (soak tier: cargo test -- --include-ignored)");
        self.trial(&name, test).with_ignored_flag(true)
    }

    /// A trial that is run with the tool's program.
    pub(crate) fn trial(&self, name: &str, test: fn(&str)) -> Trial {
        let Some(program) = self.program() else {
            let reason = format!("{} is missing: {}", self.name, self.package);
            let set = |name| std::env::var_os(name).is_some_and(|value| value == "1");
            let hardware = self.hardware && set("GUARDBIT_REQUIRE_HDL");
            let required = hardware || set("GUARDBIT_REQUIRE_TOOLS");
            let name = format!("{name} ({reason})");
            return Trial::test(name, || Err(Failed::from(reason))).with_ignored_flag(!required);
        };
        Trial::test(name, move || {
            test(program);
            Ok(())
        })
    }
}

//! The folder of a question, and the tools that run in it.

use super::map::Steps;
use super::netlist::{self, Port};
use super::tool::{self, Ran};
use super::{EquivalenceError, Map, io};
use crate::vector::formal::WIDER_FIRST;
use crate::vector::manifest::sha256;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Parameters of a module, with their values.
type Parameters = [(String, i128)];

/// The folder of a question, and what runs in it.
pub(super) struct Work<'a> {
    pub(super) folder: &'a Path,
    pub(super) limit: Duration,
}

/// A module, as yosys sees it.
pub(super) struct Device {
    /// How yosys reads it.
    pub(super) read: String,
    /// The parameters that yosys has to set.
    pub(super) parameters: Vec<(String, i128)>,
    pub(super) ports: Vec<Port>,
}

/// Digests of the texts of a question.
const DIGESTS: &str = "texts.sha256";

impl Work<'_> {
    pub(super) fn write(&self, name: &str, text: &str) -> Result<(), EquivalenceError> {
        let path = self.folder.join(name);
        std::fs::write(&path, text).map_err(io(&path))
    }

    pub(super) fn read(&self, name: &str) -> Result<String, EquivalenceError> {
        let path = self.folder.join(name);
        std::fs::read_to_string(&path).map_err(io(&path))
    }

    /// The SHA-256 of each text of the question, as `sha256sum` has it: of the module's files, and of all in the folder.
    pub(super) fn digests(&self, rtl: &[PathBuf]) -> Result<(), EquivalenceError> {
        let entries = std::fs::read_dir(self.folder).map_err(io(self.folder))?;
        let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        files.sort();
        let mut text = String::new();
        for file in rtl.iter().chain(&files) {
            let bytes = std::fs::read(file).map_err(io(file))?;
            let name = match file.strip_prefix(self.folder) {
                Ok(inner) => inner.to_owned(),
                Err(_) => file.canonicalize().map_err(io(file))?,
            };
            text.extend([&sha256(&bytes), "  ", &name.display().to_string(), "\n"]);
        }
        self.write(DIGESTS, &text)
    }

    /// Runs a tool; what it prints stays in a file. `None` after the limit.
    pub(super) fn run(
        &self,
        tool: &'static str,
        arguments: &[&str],
        log: &str,
    ) -> Result<Option<Ran>, EquivalenceError> {
        self.run_into(tool, arguments, (log, None))
    }

    /// The same, with what the tool prints as its result in a file of its own.
    pub(super) fn run_into(
        &self,
        tool: &'static str,
        arguments: &[&str],
        (log, output): (&str, Option<&str>),
    ) -> Result<Option<Ran>, EquivalenceError> {
        let path = self.folder.join(log);
        let output = output.map(|name| self.folder.join(name));
        match tool::run(self.folder, (tool, arguments), (&path, output.as_deref()), self.limit) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                Err(EquivalenceError::Missing { tool })
            }
            other => other.map_err(io(&path)),
        }
    }

    /// A tool that has to end well.
    pub(super) fn good(
        &self,
        tool: &'static str,
        ran: Option<Ran>,
        log: &str,
    ) -> Result<(), EquivalenceError> {
        let failed = |words: String| EquivalenceError::Tool {
            tool,
            words,
            log: self.folder.join(log).display().to_string(),
        };
        match ran {
            Some(ran) if ran.good() => Ok(()),
            Some(ran) => Err(failed(ran.error())),
            None => Err(failed(format!("it ran longer than {} s", self.limit.as_secs()))),
        }
    }

    /// Lets yosys run a script, which has to end well.
    pub(super) fn yosys(&self, name: &str, script: &str) -> Result<(), EquivalenceError> {
        let (file, log) = (format!("{name}.ys"), format!("{name}.log"));
        self.write(&file, script)?;
        let ran = self.run("yosys", &["-q", &file], &log)?;
        self.good("yosys", ran, &log)
    }

    /// Lets yosys read the files of a module, and says what else sets its parameters; VHDL goes through GHDL,
    /// which sets them itself.
    pub(super) fn sources<'p>(
        &self,
        rtl: &[PathBuf],
        module: Option<&str>,
        parameters: &'p Parameters,
    ) -> Result<(String, &'p Parameters), EquivalenceError> {
        let is_vhdl = |file: &PathBuf| {
            let ending = file.extension().unwrap_or_default();
            ["vhd", "vhdl"].iter().any(|known| ending.eq_ignore_ascii_case(known))
        };
        let (vhdl, verilog): (Vec<PathBuf>, Vec<PathBuf>) = rtl.iter().cloned().partition(is_vhdl);
        let read = format!("read_verilog -sv{}", files(&verilog)?);
        if vhdl.is_empty() {
            return Ok((read, parameters));
        }
        let paths: Result<Vec<_>, _> =
            vhdl.iter().map(|file| file.canonicalize().map_err(io(file))).collect();
        let generics = parameters.iter().map(|(name, value)| format!("-g{name}={value}"));
        let mut arguments =
            vec!["--synth".to_owned(), "--std=08".to_owned(), "--out=verilog".to_owned()];
        arguments.extend(generics);
        arguments.extend(paths?.iter().map(|path| path.display().to_string()));
        arguments.push("-e".to_owned());
        arguments.extend(module.map(str::to_owned));
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let ran = self.run_into("ghdl", &arguments, ("ghdl.log", Some("device.v")))?;
        self.good("ghdl", ran, "ghdl.log")?;
        Ok((format!("{read} device.v"), &[]))
    }

    /// A map's module, as yosys sees it.
    pub(super) fn device(&self, rtl: &[PathBuf], map: &Map) -> Result<Device, EquivalenceError> {
        let parameters: Vec<(String, i128)> = map.parameters.clone().into_iter().collect();
        let (read, parameters) = self.sources(rtl, Some(&map.module), &parameters)?;
        let (_, ports) = self.ports(&read, Some(&map.module), parameters)?;
        Ok(Device { read, parameters: parameters.to_vec(), ports })
    }

    /// A module's ports; without a name, of the one that no other has in it.
    pub(super) fn ports(
        &self,
        read: &str,
        module: Option<&str>,
        parameters: &Parameters,
    ) -> Result<(String, Vec<Port>), EquivalenceError> {
        let top = module.map_or_else(|| "-auto-top".to_owned(), |name| format!("-top {name}"));
        let set = module.map_or_else(String::new, |name| set(name, parameters));
        let script = format!("{read}\n{set}hierarchy -check {top}\nproc\nwrite_json ports.json\n");
        self.yosys("ports", &script)?;
        netlist::top(&self.read("ports.json")?).map_err(|what| EquivalenceError::Design {
            module: module.unwrap_or("the files").to_owned(),
            what,
        })
    }

    /// The miter as a flat netlist of registers and operators, checked.
    pub(super) fn netlist(&self, device: &str, module: &str) -> Result<(), EquivalenceError> {
        // What is checked is what stands there before a latch can be made a register.
        let script = format!(
            "{device}\nchformal -remove\n\
             read_verilog -sv -formal miter.sv\nhierarchy -check -top guardbit_miter\nproc\nflatten\n\
             setundef -undriven -anyseq\nmemory\nopt_clean\ncheck\nwrite_json netlist.json\n\
             async2sync\ndffunmap\nopt_clean\nwrite_json clocked.json\n\
             write_rtlil netlist.il\n"
        );
        self.yosys("netlist", &script)?;
        let wrong = |what| EquivalenceError::Design { module: module.to_owned(), what };
        if self.read("netlist.log")?.contains("found logic loop") {
            let log = self.folder.join("netlist.log");
            let what = "it has a loop without a register, whose cells are in";
            return Err(wrong(format!("{what} {}", log.display())));
        }
        self.has_one_driver("netlist.log", module)?;
        netlist::check(&self.read("netlist.json")?).map_err(wrong)
    }

    /// The module, flat, with some of its wires as outputs: written for `read_rtlil opened.il`. Gives the wires by
    /// the names that lemmas have for them.
    pub(super) fn opened<'s>(
        &self,
        device: &Device,
        map: &Map,
        steps: &'s Steps,
    ) -> Result<Vec<(&'s str, Port)>, EquivalenceError> {
        let mut script = format!(
            "{}\nchformal -remove\n{}hierarchy -check -top {}\nproc\nflatten\nopt_clean\n",
            device.read,
            set(&map.module, &device.parameters),
            map.module
        );
        for wire in steps.wires.values() {
            script.extend(["expose w:", wire, "\n"]);
        }
        script += "rename -top guardbit_device\nwrite_json opened.json\nwrite_rtlil opened.il\n";
        self.yosys("opened", &script)?;
        let design = |what| EquivalenceError::Design { module: map.module.clone(), what };
        let (_, ports) = netlist::top(&self.read("opened.json")?).map_err(design)?;
        let find = |(name, wire): (&'s String, &'s String)| {
            let port = ports.iter().find(|port| port.name == *wire).cloned();
            let what = format!("[division.wires] {name}: the module has no wire {wire}");
            port.map(|port| (name.as_str(), port)).ok_or_else(|| design(what))
        };
        steps.wires.iter().map(find).collect()
    }

    /// The module as a flat netlist of words, `words.json`, and with plain registers, `clocked.json`.
    pub(super) fn words(&self, device: &Device, module: &str) -> Result<(), EquivalenceError> {
        let set = set(module, &device.parameters);
        let script = format!(
            "{}\nchformal -remove\n{set}hierarchy -check -top {module}\nproc\nflatten\ncheck\nopt_expr\nopt_clean\n\
             pmuxtree\nmemory\nopt_dff -nosdff\nopt_expr\nopt_merge\nopt_clean\nwrite_json words.json\n\
             async2sync\ndffunmap\nopt_clean\nwrite_json clocked.json\n",
            device.read
        );
        self.yosys("words", &script)?;
        self.has_one_driver("words.log", module)
    }

    /// Whether yosys found that two things drive a wire.
    pub(super) fn has_one_driver(&self, log: &str, module: &str) -> Result<(), EquivalenceError> {
        let text = self.read(log)?;
        let Some(line) = text.lines().find(|line| line.contains("conflicting drivers")) else {
            return Ok(());
        };
        let what = format!("two things drive one wire: {}", line.trim());
        Err(EquivalenceError::Design { module: module.to_owned(), what })
    }

    /// One of the netlist's two outputs as gates.
    pub(super) fn gates(&self, output: &str, other: &str) -> Result<(), EquivalenceError> {
        self.write("products.v", WIDER_FIRST)?;
        self.yosys(
            &format!("aiger-{output}"),
            &format!(
                "read_rtlil netlist.il\nchformal -remove\ndelete -output w:{other}\n\
                 opt_expr\nwreduce\ntechmap -map products.v\nopt_expr\nopt_merge\nformalff -clk2ff -ff2anyinit\ntechmap\nopt_clean\nabc -g AND -fast\nopt_clean\n\
                 write_aiger -zinit {output}.aig\n"
            ),
        )
    }

    /// Asks whether one of the netlist's two outputs can ever be high.
    pub(super) fn pdr(&self, output: &str, other: &str) -> Result<Option<Ran>, EquivalenceError> {
        self.gates(output, other)?;
        // What both sides have in common is found first; pdr alone takes minutes for some adders.
        self.abc(output, "scorr; pdr")
    }

    /// Lets abc work on one of the outputs that [`Work::gates`] has written.
    pub(super) fn abc(&self, output: &str, how: &str) -> Result<Option<Ran>, EquivalenceError> {
        let command = format!("read_aiger {output}.aig; strash; {how}");
        self.run("yosys-abc", &["-c", &command], &format!("{output}.log"))
    }
}

/// How yosys sets parameters of the top module: before it looks for what is below, as `hierarchy -chparam` of
/// yosys 0.23 stops at a module whose parts have parameters.
pub(super) fn set(module: &str, parameters: &Parameters) -> String {
    if parameters.is_empty() {
        return String::new();
    }
    let mut text = "chparam".to_owned();
    for (name, value) in parameters {
        text.extend([" -set ", name, " ", &value.to_string()]);
    }
    text.extend([" ", module, "\n"]);
    text
}

/// The names of files in a script of yosys.
fn files(rtl: &[PathBuf]) -> Result<String, EquivalenceError> {
    let mut names = String::new();
    for file in rtl {
        let path = file.canonicalize().map_err(io(file))?;
        let name = path.display().to_string();
        if name.contains('"') {
            let source = std::io::Error::other("a name with a quotation mark is none for yosys");
            return Err(EquivalenceError::Io { path: name, source });
        }
        names.extend([" \"", &name, "\""]);
    }
    Ok(names)
}

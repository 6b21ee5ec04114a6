//! The lemmas of `formal/` on the devices: proved by induction, and refuted on a mutant with a
//! waveform.

// Clause J-6.
use crate::set::{good, run};
use std::path::Path;
use tempfile::TempDir;

/// A lemma, the module it is about, and what is changed of its parameters.
struct Lemma {
    name: &'static str,
    module: &'static str,
    parameters: &'static str,
}

fn source(path: &str) -> String {
    let here = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    std::fs::read_to_string(here).unwrap()
}

impl Lemma {
    /// Writes the lemma as an SMT-LIB problem, with an edit of the device's text.
    fn problem(&self, edit: Option<(&str, &str)>) -> TempDir {
        let home = tempfile::tempdir().unwrap();
        let mut device = source(&format!("hdl/{}.sv", self.module));
        if let Some((old, new)) = edit {
            assert_eq!(device.matches(old).count(), 1, "{old}");
            device = device.replace(old, new);
        }
        std::fs::write(home.path().join("device.sv"), device).unwrap();
        let lemma = source(&format!("tests/hdl/formal/{}.sv", self.name));
        std::fs::write(home.path().join("lemma.sv"), lemma).unwrap();
        let set = match self.parameters {
            "" => String::new(),
            parameters => format!("chparam {parameters} {};", self.name),
        };
        let script = format!(
            "read_verilog -sv -formal device.sv lemma.sv; {set} prep -flatten -top {}; memory_map; \
             async2sync; write_smt2 -wires lemma.smt2",
            self.name
        );
        good(home.path(), "yosys", &["-q", "-p", &script]);
        home
    }

    /// From reset for some clocks, and by induction from any clock to the next.
    fn is_proved(&self) {
        let home = self.problem(None);
        let solve = ["-s", "z3", "-t", "4", "--noprogress"];
        for mode in [&[][..], &["-i"]] {
            let text =
                good(home.path(), "yosys-smtbmc", &[&solve[..], mode, &["lemma.smt2"]].concat());
            assert!(text.contains("Status: PASSED"), "{} {}: {text}", self.name, self.parameters);
        }
    }

    /// From reset within some clocks, with a waveform of how.
    fn is_refuted(&self, edit: Option<(&str, &str)>) {
        let home = self.problem(edit);
        let arguments =
            ["-s", "z3", "-t", "6", "--noprogress", "--dump-vcd", "how.vcd", "lemma.smt2"];
        let (proved, text) = run(home.path(), "yosys-smtbmc", &arguments);
        assert!(!proved && text.contains("Status: FAILED"), "{} {edit:?}: {text}", self.name);
        let wave = std::fs::read_to_string(home.path().join("how.vcd")).unwrap();
        assert!(wave.contains("$enddefinitions"), "a waveform");
    }
}

const WRAP: Lemma = Lemma { name: "wrap", module: "edge_stepper", parameters: "" };

fn guard(parameters: &'static str) -> Lemma {
    Lemma { name: "guard", module: "dda", parameters }
}

fn width(parameters: &'static str) -> Lemma {
    Lemma { name: "edge_width", module: "edge_stepper", parameters }
}

pub(crate) fn words_wrap(_: &str) {
    WRAP.is_proved();
    WRAP.is_refuted(Some(("STEP_X: e <= e + ea", "STEP_X: e <= e + {1'b0, ea[M-2:0]}")));
    WRAP.is_refuted(Some(("STEP_Y: e <= e + eb", "STEP_Y: e <= e + (eb >> 1)")));
}

pub(crate) fn guard_clamps(_: &str) {
    for parameters in ["", "-set G 1", "-set G 3", "-set G 4", "-set G 1 -set I 3 -set F 3"] {
        guard(parameters).is_proved();
    }
    for (old, new) in [
        ("u >= MIDDLE", "u > MIDDLE"),
        ("u >= WHOLE", "u > WHOLE"),
        ("outside && u >= MIDDLE", "outside && acc[N-1]"),
        ("low ? {I{1'b0}} : high ? {I{1'b1}}", "low ? {I{1'b1}} : high ? {I{1'b0}}"),
    ] {
        guard("").is_refuted(Some((old, new)));
    }
}

pub(crate) fn edges_fit(_: &str) {
    // sgi-4k at its corners; the toy profile at every point of every field.
    width("").is_proved();
    width("-set M 34").is_refuted(None);
    let toy = "-set M 6 -set K 2 -set S 1 -set CORNERS 0";
    width(toy).is_proved();
    width("-set M 5 -set K 2 -set S 1 -set CORNERS 0").is_refuted(None);
    width(toy).is_refuted(Some(("in_v = ~e[M-1]", "in_v = ~e[M-1] && e != 0")));
}

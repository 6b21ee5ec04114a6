//! `prove --rtl`: shipped and foreign modules, and what it says of nonsense.

// Clause J-9.
use crate::run::{Ran, run_in};
use sha2::{Digest as _, Sha256};
use std::path::Path;

const HDL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/hdl");

/// Asks in a folder; the proof's own folder is fresh.
pub(crate) fn ask(home: &Path, question: &str) -> Ran {
    let proof = home.join("guardbit-proof");
    if proof.exists() {
        std::fs::remove_dir_all(&proof).unwrap();
    }
    run_in(home, &format!("prove {question}"))
}

#[track_caller]
fn proves(home: &Path, question: &str) {
    let ran = ask(home, question).ends(0);
    assert!(ran.out.starts_with("PROVED by yosys-abc scorr and pdr in "), "{}", ran.out);
    // The tool's own words are kept.
    let log = std::fs::read_to_string(home.join("guardbit-proof/bad.log")).unwrap();
    assert!(log.contains("Property proved."), "{log}");
}

#[track_caller]
fn refutes(home: &Path, question: &str) -> Ran {
    let ran = ask(home, question).ends(1);
    assert!(ran.out.starts_with("REFUTED in "), "{}", ran.out);
    assert!(home.join("guardbit-proof/counterexample.vcd").exists());
    ran
}

/// A profile with other guard bits and another clamp.
fn profile(home: &Path, guard: u32, clamp: &str) -> String {
    let text = run_in(home, "profile show sgi-4k").ends(0).out;
    let text = text
        .replace("name = \"sgi-4k\"", &format!("name = \"own-{guard}-{clamp}\""))
        .replace("\nguard = 2\n", &format!("\nguard = {guard}\n"))
        .replace("clamp = \"guard\"", &format!("clamp = \"{clamp}\""));
    let name = format!("own-{guard}-{clamp}.toml");
    std::fs::write(home.join(&name), text).unwrap();
    name
}

pub(crate) fn shipped_devices(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    for name in ["sgi-4k", "tiny", "d3d11"] {
        proves(home, &format!("{name} --rtl {HDL}/dda.sv --block dda"));
        proves(home, &format!("{name} --rtl {HDL}/edge_stepper.sv --block edge-stepper"));
    }
    for (guard, clamp) in [(1, "guard"), (3, "guard"), (4, "guard"), (2, "wrap"), (2, "sign")] {
        let own = profile(home, guard, clamp);
        proves(home, &format!("{own} --rtl {HDL}/dda.sv --block dda"));
    }
    // A module of one width, without any parameter.
    let stepper = std::fs::read_to_string(format!("{HDL}/edge_stepper.sv")).unwrap();
    let fixed = stepper.replace("parameter int M = 35", "localparam int M = 35");
    assert_ne!(fixed, stepper);
    std::fs::write(home.join("fixed.sv"), &fixed).unwrap();
    proves(home, "sgi-4k --rtl fixed.sv --block edge-stepper");
    ask(home, "tiny --rtl fixed.sv --block edge-stepper").complains(2, &["35 bits"]);
    // The template is of the unit's module, whatever else stands in the files.
    std::fs::write(
        home.join("more.sv"),
        fixed + "module zoo (input a, output b); assign b = a; endmodule\n",
    )
    .unwrap();
    let template = ask(home, "sgi-4k --rtl more.sv --block edge-stepper --map-template").ends(0);
    assert!(template.out.contains("module = \"edge_stepper\""), "{}", template.out);
    // The parameters are the profile's and not the text's: an accumulator of other bits is none.
    let map = "module = \"dda\"\n[reset]\nport = \"rst\"\n[ports]\nop = \"op\"\ninit = \"init\"\ndx = \"dx\"\n\
               dy = \"dy\"\nacc = \"acc\"\nout = \"out_v\"\n[parameters]\nG = 2\nI = 24\nF = 13\nMODE = 0\n";
    std::fs::write(home.join("wrap.toml"), map).unwrap();
    let ran = refutes(home, &format!("sgi-4k --rtl {HDL}/dda.sv --block dda --map wrap.toml"));
    let last = ran.out.lines().rfind(|line| line.trim_start().starts_with("0 ")).unwrap();
    let words: Vec<&str> = last.split_whitespace().collect();
    // reset op init dx dy got_acc want_acc got_out want_out: the same state, read out otherwise.
    assert!(words.len() == 9 && words[5] == words[6] && words[7] != words[8], "{}", ran.out);
}

/// A stepper in VHDL, without a case: GHDL 2.0 drops `when others` from the Verilog that it writes.
const VHDL: &str = "library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
entity stepper is
    generic (M : natural := 8);
    port (
        clk, rst : in std_logic;
        op : in std_logic_vector(1 downto 0);
        e0, ea, eb : in std_logic_vector(M - 1 downto 0);
        e : out std_logic_vector(M - 1 downto 0);
        in_v : out std_logic
    );
end entity;
architecture rtl of stepper is
    signal word : unsigned(M - 1 downto 0);
    signal addend, base : unsigned(M - 1 downto 0);
begin
    base <= (others => '0') when op = \"00\" else word;
    addend <= unsigned(e0) when op = \"00\" else unsigned(ea) when op = \"01\"
        else unsigned(eb) when op = \"10\" else (others => '0');
    process (clk) begin
        if rising_edge(clk) then
            if rst = '1' then word <= (others => '0'); else word <= base + addend; end if;
        end if;
    end process;
    e <= std_logic_vector(word);
    in_v <= not word(M - 1);
end architecture;
";

pub(crate) fn vhdl_devices(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let map = "module = \"stepper\"\n[reset]\nport = \"rst\"\n[ports]\nop = \"op\"\ne0 = \"e0\"\nea = \"ea\"\n\
               eb = \"eb\"\ne = \"e\"\nin = \"in_v\"\n[parameters]\nM = 35\n";
    std::fs::write(home.join("map.toml"), map).unwrap();
    let question = "sgi-4k --rtl stepper.vhd --block edge-stepper --map map.toml";
    std::fs::write(home.join("stepper.vhd"), VHDL).unwrap();
    proves(home, question);
    std::fs::write(home.join("stepper.vhd"), VHDL.replace("base + addend", "base - addend"))
        .unwrap();
    refutes(home, question);
    let fixed =
        VHDL.replace("    generic (M : natural := 8);\n", "").replace("stepper", "edge_stepper");
    let fixed = fixed.replace("M - 1", "34");
    std::fs::write(home.join("fixed.vhd"), fixed).unwrap();
    proves(home, "sgi-4k --rtl fixed.vhd --block edge-stepper");
    // Ours have a case: proved by a GHDL that keeps it, refused with another one, and never refuted.
    for (file, block) in [("dda.vhd", "dda"), ("edge_stepper.vhd", "edge-stepper")] {
        let ran = ask(home, &format!("sgi-4k --rtl {HDL}/{file} --block {block}"));
        let kept = ran.status == Some(0) && ran.out.starts_with("PROVED");
        let dropped = ran.status == Some(2) && ran.err.contains("take a GHDL newer than 2.0");
        assert!(kept || dropped, "{}{}", ran.out, ran.err);
    }
}

/// A DDA of another architecture, and its map.
const FOREIGN: &str = include_str!("../../examples/equivalence/walker.sv");
const MAP: &str = include_str!("../../examples/equivalence/walker.toml");

pub(crate) fn foreign_device(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let write = |name: &str, text: &str| std::fs::write(home.join(name), text).unwrap();
    write("walker.sv", FOREIGN);
    let ask_map = "sgi-4k --rtl walker.sv --block dda --map map.toml";
    write("map.toml", MAP);
    proves(home, ask_map);
    // Each text has its digest beside it, the module's own file, too.
    let folder = home.join("guardbit-proof");
    let list = std::fs::read_to_string(folder.join("texts.sha256")).unwrap();
    for line in list.lines() {
        let (digest, name) = line.split_once("  ").unwrap();
        let found = Sha256::digest(std::fs::read(folder.join(name)).unwrap());
        let found = found.iter().fold(String::new(), |text, byte| format!("{text}{byte:02x}"));
        assert_eq!(digest, found, "{name}");
    }
    for name in ["/walker.sv", "  reference.sv", "  miter.sv", "  bad.log"] {
        assert!(list.lines().any(|line| line.ends_with(name)), "{name}: {list}");
    }
    // Without a reset, and with a state that begins anywhere.
    write(
        "free.sv",
        &FOREIGN.replace("if (!rst_n) begin", "if (1'b0) begin").replace("clock, rst_n,", "clock,"),
    );
    write("free.toml", &MAP.replace("[reset]\nport = \"rst_n\"\nactive-low = true\n", ""));
    proves(home, "sgi-4k --rtl free.sv --block dda --map free.toml");
    // A reset that does not wait for the clock.
    write("walker.sv", &FOREIGN.replace("(posedge clock)", "(posedge clock or negedge rst_n)"));
    proves(home, ask_map);
    // A comment in another encoding.
    let mut latin = FOREIGN.as_bytes().to_vec();
    latin.splice(0..0, *b"// z\xe4hler\n");
    std::fs::write(home.join("walker.sv"), latin).unwrap();
    proves(home, ask_map);
    // One thing wrong: in the module, or in the map.
    for (old, new) in [
        ("3'd2, 3'd3, 3'd4:", "3'd2, 3'd3:"),
        ("{18'd0, low[20]}", "19'd0"),
        ("cmd == 3'd4 ? zy", "cmd == 3'd4 ? zx"),
        ("!rst_n", "rst_n"),
        ("lo <= 0;", "lo <= 1;"),
    ] {
        assert_eq!(FOREIGN.matches(old).count(), 1, "{old}");
        write("walker.sv", &FOREIGN.replace(old, new));
        refutes(home, ask_map);
    }
    write("walker.sv", FOREIGN);
    for (old, new) in [
        ("latency = 1", "latency = 0"),
        ("latency = 1", "latency = 2"),
        ("step-x = 2\nstep-y = 4", "step-x = 4\nstep-y = 2"),
        ("active-low = true", "active-low = false"),
        ("test_mode = 0", "test_mode = 1"),
    ] {
        assert_eq!(MAP.matches(old).count(), 1, "{old}");
        write("map.toml", &MAP.replace(old, new));
        refutes(home, ask_map);
    }
    let template = ask(home, "sgi-4k --rtl walker.sv --block dda --map-template").ends(0).out;
    for part in
        ["module = \"walker\"", "#   input cmd, 3 bits", "active-low = true", "clock = \"clock\""]
    {
        assert!(template.contains(part), "{template}");
    }
}

/// A DDA that takes its slopes with a load, two clocks late.
const LATCHED: [&str; 2] =
    [include_str!("designs/latched.sv"), include_str!("designs/latched.toml")];

pub(crate) fn latched_device(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let [text, map] = LATCHED;
    let write = |text: &str, map: &str| {
        std::fs::write(home.join("latched.sv"), text).unwrap();
        std::fs::write(home.join("latched.toml"), map).unwrap();
    };
    let question = "sgi-4k --rtl latched.sv --block dda --map latched.toml";
    write(text, map);
    proves(home, question);
    // A slope that another word overwrites, one that is not taken, and a reset in the middle that is not seen.
    for (old, new) in [
        ("sx<=zx; sy<=zy;", "sx<=zx; sy<=zx;"),
        ("3'd3: acc <= acc + sy;", "3'd3: acc <= acc + zy + 1;"),
        ("oct[1:0]!=0", "oct[1:0]!=1"),
    ] {
        assert_eq!(text.matches(old).count(), 1, "{old}");
        write(&text.replace(old, new), map);
        refutes(home, question);
    }
    // Slopes that may change at any clock are others.
    write(text, &map.replace("held = true", "held = false"));
    refutes(home, question);
}

pub(crate) fn bad_input(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let write = |name: &str, text: &str| std::fs::write(home.join(name), text).unwrap();
    let says = |question: &str, about: &[&str]| {
        let _ = ask(home, question).complains(2, about);
    };
    let map = |old: &str, new: &str, about: &[&str]| {
        assert_eq!(MAP.matches(old).count(), 1, "{old}");
        write("map.toml", &MAP.replace(old, new));
        says("sgi-4k --rtl walker.sv --block dda --map map.toml", about);
    };
    write("walker.sv", FOREIGN);
    map("dx = \"zx\"", "dx = \"zz\"", &["dx: the module has no port zz", "z0, zx, zy"]);
    map("dx = \"zx\"", "dx = \"z\"", &["dx: the port z is an output, and an input is wanted"]);
    map("out = \"z\"", "acc = \"z\"", &["acc: the port z has 24 bits != 39"]);
    map("out = \"z\"\n", "", &["[ports] has no output"]);
    map("dx = \"zx\"\n", "", &["[ports] has no dx"]);
    map("dx = \"zx\"", "dx = \"zy\"", &["zx", "nothing drives"]);
    map("\ntest_mode = 0", "", &["nothing drives the input test_mode", "[constants]"]);
    map("test_mode = 0", "test_mode = 2", &["[constants] test_mode = 2 >= 2^1"]);
    map("hold = 0", "hold = 4", &["[op] hold = 4 is the code of another operation"]);
    map("hold = 0", "hold = 9", &["[op] hold = 9 >= 2^3"]);
    map("latency = 1", "latency = 64", &["latency = 64: 0 to 63"]);
    map("latency = 1", "late = 1", &["map.toml", "late"]);
    map(
        "latency = 1",
        "latency = 1\n[division]\nlead = 1",
        &["[division] belongs to the block divider"],
    );
    map("module = \"walker\"", "module = \"guardbit_walker\"", &["may not begin with guardbit_"]);
    map("module = \"walker\"", "module = \"walkman\"", &["yosys stopped", "walkman"]);
    map("module = \"walker\"", "module = \"walker; !touch x\"", &["is no name"]);
    let broken = |text: &str, about: &[&str]| {
        write("walker.sv", text);
        write("map.toml", MAP);
        says("sgi-4k --rtl walker.sv --block dda --map map.toml", about);
    };
    broken(" \n", &["walker.sv is empty"]);
    broken("module walker; assign = 1;\nendmodule\n", &["yosys stopped", "syntax error"]);
    broken(&FOREIGN.replace("posedge clock", "negedge clock"), &["rising edge"]);
    let latch = "    reg latch;\n    always @* if (test_mode) latch = cmd[0];\n    wire [38:0] addend = latch ? 39'd0 : ";
    broken(&FOREIGN.replace("    wire [38:0] addend = ", latch), &["latch", "registers alone"]);
    let gated = "    wire slow = clock && cmd[0];\n    always @(posedge slow)";
    broken(&FOREIGN.replace("    always @(posedge clock)", gated), &["rising edge"]);
    let looped = "wire [2:0] octant = hi[18:16] ^ {3{z[0] && octant[0]}};";
    broken(
        &FOREIGN.replace("wire [2:0] octant = hi[18:16];", looped),
        &["a loop without a register"],
    );
    // yosys itself refuses its gates.
    let gate = "    \\$_DFF_N_ odd (.C(clock), .D(cmd[0]), .Q());\n    always @(posedge clock)";
    broken(&FOREIGN.replace("    always @(posedge clock)", gate), &["yosys stopped", "$_DFF_N_"]);
    write("walker.sv", FOREIGN);
    let plain = "sgi-4k --rtl walker.sv --block dda --map map.toml";
    let _ = ask(home, "sgi-4k --rtl nowhere.sv --block dda")
        .complains(3, &["nowhere.sv: No such file"]);
    says("vortex --rtl walker.sv --block dda", &["vortex: no reference"]);
    // The folder of a proof is never written over.
    std::fs::create_dir(home.join("there")).unwrap();
    says(&format!("{plain} --out there"), &["there is there already"]);
    // What the module assumes of its own is not taken.
    let vacuous = FOREIGN
        .replace(
            "        if (!rst_n) begin",
            "        if (cmd == 3'd7) assume (1'b0);\n        else if (!rst_n) begin",
        )
        .replace("3'd2, 3'd3, 3'd4:", "3'd2, 3'd3:");
    write("walker.sv", &vacuous);
    refutes(home, plain);
    // Undriven wires are anything, and so found out.
    write("walker.sv", &FOREIGN.replace("wire [2:0] octant = hi[18:16];", "wire [2:0] octant;"));
    refutes(home, plain);
    write(
        "walker.sv",
        &FOREIGN
            .replace("3'd2, 3'd3, 3'd4: z <= 24'hffffff;", "3'd2, 3'd3, 3'd4: z <= 24'hxfffff;"),
    );
    refutes(home, plain);
}

/// A solver of another mind: whatever it says of the proof, the first question is answered as it should.
fn with_solver(home: &Path, says: &str, status: i32) -> Ran {
    let bin = home.join("bin");
    std::fs::create_dir_all(&bin).unwrap();
    let script = format!(
        "#!/bin/sh\ncase \"$2\" in *compared.aig*) echo 'Output 0 was asserted in frame 2.';;\n\
         *bad.aig*) {says}; exit {status};;\n*) PATH=${{PATH#*:}} exec yosys-abc \"$@\";; esac\n"
    );
    std::fs::write(bin.join("yosys-abc"), script).unwrap();
    let mode = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    std::fs::set_permissions(bin.join("yosys-abc"), mode).unwrap();
    let proof = home.join("guardbit-proof");
    if proof.exists() {
        std::fs::remove_dir_all(&proof).unwrap();
    }
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let mut command = crate::run::guardbit();
    let question = format!("prove sgi-4k --rtl {HDL}/dda.sv --block dda --limit 10");
    command.current_dir(home).env("PATH", path).args(question.split(' '));
    command.output().unwrap().into()
}

pub(crate) fn only_the_solvers_words_prove(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    assert!(with_solver(home, "echo 'Property proved.'", 0).ends(0).out.starts_with("PROVED"));
    for (says, status, told) in [
        ("echo 'Property proved.'", 1, "Property proved."),
        ("echo 'Property PROVED'", 0, "Property PROVED"),
        ("true", 0, "exit status: 0"),
        ("kill -9 $$", 0, "signal: 9"),
        ("exec sleep 60", 0, "yosys-abc pdr ran longer than 10 s"),
    ] {
        let ran = with_solver(home, says, status).ends(1);
        assert!(ran.out.starts_with("UNDECIDED after ") && ran.out.contains(told), "{}", ran.out);
    }
    // No tools, no answer.
    let mut command = crate::run::guardbit();
    let question = format!("prove sgi-4k --rtl {HDL}/dda.sv --block dda --out other");
    command.current_dir(home).env("PATH", home).args(question.split(' '));
    let ran: Ran = command.output().unwrap().into();
    let _ = ran.complains(2, &["yosys is not on the search path", "apt-get install yosys"]);
}

//! The bench in VHDL: what it takes and what it sees, of walks and of streams.

// Clauses J-1 to J-4.
use crate::set::{GHDL, Set, build_ghdl, run};

/// Runs the bench on other devices: whether it passes, and its text.
fn bench(set: &Set, devices: &str, generics: &[&str]) -> (bool, String) {
    std::fs::write(set.folder.join("dut.vhd"), devices).unwrap();
    build_ghdl(&set.folder);
    let (ended, text) = run(&set.folder, GHDL.0, &[GHDL.1, generics].concat());
    let says = |word: &str| text.lines().any(|line| line.starts_with(word));
    assert_eq!((ended, !ended), (says("PASS "), says("FAIL ")), "{text}");
    (ended, text)
}

fn replace(text: &str, pairs: &[(&str, &str)]) -> String {
    pairs.iter().fold(text.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replace(old, new)
    })
}

/// A device of `tiny` behind two registers.
const LATE: &str = "
library ieee;
use ieee.std_logic_1164.all;

entity @NAME@ is
    port (
        clk, rst : in std_logic;
        op : in std_logic_vector(1 downto 0);
        @IN@ : in std_logic_vector(@TOP@ downto 0);
        @STATE@ : out std_logic_vector(@TOP@ downto 0);
        @OUT@
    );
end entity @NAME@;

architecture late of @NAME@ is
    signal state, state1, state2 : std_logic_vector(@TOP@ downto 0);
    signal read, read1, read2 : @TYPE@;
begin
    core : entity work.@NAME@_core
        port map (clk, rst, op, @IN@, state, read);
    state1 <= state when rising_edge(clk);
    state2 <= state1 when rising_edge(clk);
    read1 <= read when rising_edge(clk);
    read2 <= read1 when rising_edge(clk);
    @STATE@ <= state2;
    @READ@ <= read2;
end architecture late;
";

pub(crate) fn late_outputs(_: &str) {
    let set = Set::new("tiny --count 1200");
    let mut devices = set.read("dut.vhd");
    let out = "std_logic_vector(2 downto 0)";
    for (name, inputs, top, state, read, kind) in [
        ("dda", "init, dx, dy", "6", "acc", "out_v", out),
        ("edge_stepper", "e0, ea, eb", "5", "e", "in_v", "std_logic"),
    ] {
        devices = replace(
            &devices,
            &[
                (&format!("entity {name} "), &format!("entity {name}_core ")),
                (&format!("entity {name};"), &format!("entity {name}_core;")),
                (&format!("of {name} is"), &format!("of {name}_core is")),
            ],
        );
        devices = devices
            .replace(&format!("entity work.{name}\n"), &format!("entity work.{name}_core\n"));
        devices += &[
            ("@OUT@", &*format!("{read} : out {kind}")),
            ("@NAME@", name),
            ("@IN@", inputs),
            ("@TOP@", top),
            ("@STATE@", state),
            ("@READ@", read),
            ("@TYPE@", kind),
        ]
        .iter()
        .fold(LATE.to_owned(), |text, (key, value)| text.replace(key, value));
    }
    let (good, text) = bench(&set, &devices, &["-gLATENCY=2", "-gDUMP=true"]);
    assert!(good && text.contains("dda rows=1200 edge rows=1200 "), "{text}");
    assert_eq!(set.read("dda.exp.dut.tv").to_lowercase(), set.read("dda.exp.tv"));
    assert!(bench(&set, &devices, &["-gLATENCY=2"]).0);
    for wrong in ["-gLATENCY=0", "-gLATENCY=1", "-gLATENCY=3"] {
        assert!(bench(&set, &devices, &[wrong]).1.contains("MISMATCH dda walk"), "{wrong}");
    }
    // Late and wrong.
    let spoilt = replace(
        &devices,
        &[("sum := resize(signed(init), N + 2);", "sum := to_signed(1, N + 2);")],
    );
    let (good, text) = bench(&set, &spoilt, &["-gLATENCY=2"]);
    assert!(
        !good && text.contains("MISMATCH dda walk 0 row 0 (dda.exp.tv line 1, op 0) field acc"),
        "{text}"
    );
}

pub(crate) fn other_orders(_: &str) {
    let set = Set::new("tiny --count 1500");
    let ours = set.read("dut.vhd");
    // Rows from the bottom up.
    let upward = replace(
        &ours,
        &[
            ("bottom <= unsigned(box_y_end);", "bottom <= unsigned(box_y_begin);"),
            ("y <= unsigned(box_y_begin);", "y <= unsigned(box_y_end) - 1;"),
            ("last_row <= ('0' & y) + 1 >= bottom;", "last_row <= y = bottom;"),
            ("or y >= bottom", "or y < bottom or y + 1 = 0"),
            ("y <= y + 1;", "y <= y - 1;"),
            ("row(k) + b(k)", "row(k) - b(k)"),
            ("else depth_row + slope_y", "else depth_row - slope_y"),
        ],
    );
    let (good, text) = bench(&set, &upward, &["-gANY_ORDER=true"]);
    assert!(good && text.contains(" triangle rows="), "{text}");
    assert!(!bench(&set, &upward, &[]).0);
    // A wrong depth has no row of its key, or another depth; a lost row is missed.
    let wrong = upward.replace("else depth_row - slope_y", "else depth_row + slope_y");
    assert!(bench(&set, &wrong, &["-gANY_ORDER=true"]).1.contains("field depth"));
    let wrong = upward.replace("first <= x;", "first <= x + 1;");
    assert!(
        bench(&set, &wrong, &["-gANY_ORDER=true"]).1.contains("no row is left with test 0, y ")
    );
    let lost = upward
        .replace(
            "span_valid <= '1' when closes else '0';",
            "span_valid <= '1' when closes and first /= 2 else '0';",
        )
        .replace(
            "and not (closes and span_ready = '0')",
            "and not (closes and first /= 2 and span_ready = '0')",
        );
    let (good, text) = bench(&set, &lost, &["-gANY_ORDER=true"]);
    assert!(!good && text.contains("maybe others of the tests so far are missing"), "{text}");
}

pub(crate) fn defects(_: &str) {
    let set = Set::new("tiny --count 500");
    let ours = set.read("dut.vhd");
    let set_up = "if rst = '1' then\n                held <= '0';";
    let engine = "if rst = '1' then\n                state <= IDLE;";
    let divider = "if rst = '1' then\n                left <= 0;";
    let stepper = "if rst = '1' then\n                state <= (others => '0');";
    for (old, new, says) in [
        ("here(k) <= here(k) + a(k);", "here(k) <= here(k) + b(k);", "MISMATCH triangle (span.exp"),
        ("at_end <= x = right;", "at_end <= x + 1 = right;", "MISMATCH triangle (span.exp"),
        ("spans <= spans + 1;", "spans <= spans + 2;", "(triangle.exp.tv line 1) field spans"),
        (
            "moves <= state = RUN and not (covered and sample_ready = '0')",
            "moves <= state = RUN",
            "an answer changes or goes before it is taken",
        ),
        ("triangle_zero_area <= nothing;", "triangle_zero_area <= 'X';", "got      X  X"),
        (engine, "if false then\n                state <= IDLE;", "MISMATCH triangle"),
        (
            "triangle_valid <= '1' when state = FINISHED else '0';",
            "triangle_valid <= '0';",
            "no transfer for ",
        ),
        ("if triangle_ready = '1' then", "if false then", "the device answers without end"),
        ("e := e - 1;", "e := e;", "MISMATCH setup (setup.exp.tv line "),
        ("over or (tie and is_odd)", "over or tie", "field depth_"),
        (set_up, "if false then\n                held <= '0';", "MISMATCH setup"),
        (divider, "if false then\n                left <= 0;", "MISMATCH setup"),
        (
            stepper,
            "if false then\n                state <= (others => '0');",
            "after a reset, not zero",
        ),
    ] {
        let (good, text) = bench(&set, &replace(&ours, &[(old, new)]), &[]);
        assert!(!good && text.contains(says), "{new}: {text}");
    }
}

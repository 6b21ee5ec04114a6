//! Devices of machines that begin at registers: they pass, and defects of them are seen.

// Clauses J-1 to J-3.
use crate::foreign::{bench, build};
use crate::set::Set;
use std::path::Path;

/// The engine of a register-level machine: it passes, in other widths too, and defects of it are seen.
pub(crate) fn quads(_: &str) {
    let tile = ("tile = 32, block = 4", "tile = 8, block = 2");
    let narrow = ("width = 32", "width = 24");
    for (lines, count) in [(vec![], 400), (vec![narrow, tile], 700)] {
        let set = Set::of("vortex", &lines, &format!("--count {count}"));
        build(&set.folder, &[], &["dut.sv"]);
        let (good, text) = bench(&set.folder, &[]);
        assert!(
            good && text.contains("PASS words rows=") && !text.contains("not checked"),
            "{text}"
        );
        let rows = text.split("rows=").nth(1).unwrap().split_whitespace().next().unwrap();
        assert_eq!(rows.parse::<usize>().unwrap(), set.read("words-q.exp.tv").lines().count());
        let hdl = Path::new(env!("CARGO_MANIFEST_DIR")).join("hdl/quad_engine.sv");
        build(&set.folder, &["-DGUARDBIT_PARAMETERS"], &[hdl.to_str().unwrap()]);
        assert!(bench(&set.folder, &[]).0, "{text}");
    }
    let set = Set::new("vortex --count 300");
    let ours = set.read("dut.sv");
    for (what, with) in [
        // An edge, a corner of a part, its extent, the scissor, and a stream that does not wait.
        ("place >= 2 ? dy", "place >= 2 ? dx"),
        ("(dy[W-1] ? {W{1'b0}} : dy)", "dy"),
        ("(reach >> level)", "(reach >> level + 1)"),
        ("corner + (dx << S)", "corner + dx"),
        ("column >= low_x", "column > low_x"),
        ("row >= low_y", "row > low_y"),
        (" || edges[2].pixels[place].e < 0", ""),
        ("busy && (!q_valid || q_ready)", "busy"),
    ] {
        assert!(ours.contains(what), "{what}");
        std::fs::write(set.folder.join("dut.sv"), ours.replace(what, with)).unwrap();
        build(&set.folder, &[], &["dut.sv"]);
        assert!(!bench(&set.folder, &[]).0, "{what}");
    }
}

/// Devices that are wired for the registers of a built-in profile pass.
pub(crate) fn wired(_: &str) {
    for (profile, device, _) in WIRED {
        let count = if SLOW.contains(&profile) { 500 } else { 1500 };
        let set = Set::new(&format!("{profile} --count {count}"));
        assert!(set.read("dut.sv").contains(&format!("\nmodule {device} ")), "{profile}");
        build(&set.folder, &[], &["dut.sv"]);
        let (good, text) = bench(&set.folder, &[]);
        assert!(good && !text.contains("not checked"), "{profile}: {text}");
        let rows = text.split("rows=").nth(1).unwrap().split_whitespace().next().unwrap();
        let files = ["words-s.exp.tv", "words-p.exp.tv"].map(|name| set.folder.join(name));
        let files = files.iter().filter_map(|path| std::fs::read_to_string(path).ok());
        let lines = files.map(|file| file.lines().count()).sum::<usize>();
        assert_eq!(rows.parse::<usize>().unwrap(), lines);
    }
    // The parameters of a device are the set's.
    let set = Set::of(
        "ps1",
        &[("x = 1023", "x = 20"), ("leftmost-given", "leftmost-sorted")],
        "--count 900",
    );
    let hdl = Path::new(env!("CARGO_MANIFEST_DIR")).join("hdl/anchored_engine.sv");
    let hdl = hdl.to_str().unwrap();
    build(&set.folder, &["-DGUARDBIT_PARAMETERS"], &[hdl]);
    assert!(bench(&set.folder, &[]).0);
    build(&set.folder, &[], &[hdl]);
    assert!(!bench(&set.folder, &[]).0);
    // Another profile of the same engine has no device: what is wired is what the device does.
    for (profile, old, new) in [
        ("virge", "pixel-bias = 0xfffff", "pixel-bias = 0xffffe"),
        ("psp", "width = 32", "width = 31"),
        ("n64", "scissor_xh:12", "scissor_xh:11"),
    ] {
        let set = Set::of(profile, &[(old, new)], "--count 300");
        build(&set.folder, &[], &["dut.sv"]);
        let (good, text) = bench(&set.folder, &[]);
        assert!(!good && text.contains("FAIL nothing to check"), "{text}");
        let says = "with these registers: each device is wired for those of a built-in profile";
        assert!(text.contains("NOT CHECKED words: there is no device for ") && text.contains(says));
    }
}

/// Defects of these devices are seen.
pub(crate) fn wired_defects(_: &str) {
    let mut missed = Vec::new();
    for (profile, device, defects) in WIRED {
        let count = if SLOW.contains(&profile) { 2500 } else { 8000 };
        let set = Set::new(&format!("{profile} --count {count}"));
        let ours = set.read("dut.sv");
        for (old, new) in defects {
            assert_eq!(ours.matches(old).count(), 1, "{device}: {old}");
            std::fs::write(set.folder.join("dut.sv"), ours.replace(old, new)).unwrap();
            build(&set.folder, &[], &["dut.sv"]);
            if bench(&set.folder, &[]).0 {
                missed.push(format!("{device}: {new}"));
            }
        }
    }
    assert_eq!(missed, [""; 0]);
}

/// Profiles of which there are fewer rows: they take a simulator a minute.
const SLOW: [&str; 3] = ["n64", "n64-rtl", "psp"];

/// A profile, its device, and defects of it: a text and what replaces it.
type Wired = (&'static str, &'static str, &'static [(&'static str, &'static str)]);

const WIRED: [Wired; 7] = [
    (
        "ps1",
        "anchored_engine",
        &[
            ("r <= q ? 2'd2 : 2'd1", "r < q ? 2'd2 : 2'd1"),
            ("12'h800} + dx", "12'h7ff} + dx"),
            ("if (distance >= parts)", "if (distance > parts)"),
            ("exceeds(acx, LARGEST_X)", "1'b0"),
            ("{1'b0, left[10:0],", "{left[10], left[10:0],"),
        ],
    ),
    ("ps1-rtl", "anchored_engine", &[("FIRST_MATCH == 0 && ay", "ay")]),
    (
        "psp",
        "vertex_quad_engine",
        &[
            ("beyond_y < edge_y", "beyond_y <= edge_y"),
            ("rises[k] = change > 0", "rises[k] = 1'b1"),
            ("32'(beyond_x) < side", "32'(beyond_x) <= side"),
            ("SAMPLE = 19'sd7", "SAMPLE = 19'sd8"),
            ("{edge_yields, yields[2:1]}", "{yields[1:0], edge_yields}"),
        ],
    ),
    (
        "virge",
        "given_slope_engine",
        &[
            ("(long_x - 1) >> (F - N)", "long_x >> (F - N)"),
            ("line > high_y", "line >= high_y"),
            ("clips <= clip != 0", "clips <= clip[0]"),
            ("here[30:15] != 0", "here[22:15] != 0"),
            ("BIAS = 32'd1048575", "BIAS = 32'd1048576"),
            ("v_dy, u_dy, z_dy << 1,", "v_dy, u_dy, z_dy,"),
            ("32'(a[15:0])", "32'($signed(a[15:0]))"),
        ],
    ),
    (
        "voodoo",
        "divided_slope_engine",
        &[
            ("ROW_BIAS = 17'sd7", "ROW_BIAS = 17'sd8"),
            ("centre < 32'(b_y)", "centre <= 32'(b_y)"),
            ("33'(line) >= high_y", "33'(line) > high_y"),
            ("float[16] ? 16'hffff : float[15:0]", "float[15:0]"),
            ("18'(bias)", "18'(bias[14:0])"),
            ("here - dx : here + dx", "here + dx : here + dx"),
            ("W'(part_y) * dy", "W'(part_x) * dy"),
        ],
    ),
    (
        "n64",
        "sub_scanline_engine",
        &[("{spot_x, spot_y} = 6'd0;", "{spot_x, spot_y} = 6'o33;"), ("!invalid[LINE] && ", "")],
    ),
    (
        "n64-rtl",
        "sub_scanline_engine",
        &[
            ("(k == Z ? DROP_Z : 5)", "(k == Z ? 0 : 5)"),
            ("if (rst) {busy, drawing, s_waits} <= 3'b000;", "if (rst) {busy, s_waits} <= 2'b00;"),
        ],
    ),
];

//! Designs that are not ours: outputs that come later, an order of visits of their own, parameters, and
//! profiles for which the set has no device.

// Clauses J-1, J-2, J-3 and J-4.
use crate::set::{ICARUS, Set, VERILATOR, build_verilator, good, run};
use std::path::Path;

/// Builds the bench in Icarus with macros defined; every `dut.sv` of the folder's own.
pub(crate) fn build(folder: &Path, macros: &[&str], devices: &[&str]) {
    let fixed = ["-g2012", "-o", "sim.vvp", "pkg.sv"];
    good(folder, "iverilog", &[&fixed[..], macros, devices, &["tb.sv"]].concat());
}

/// Runs the built bench with plusargs: whether it passes, and its text.
pub(crate) fn bench(folder: &Path, plusargs: &[&str]) -> (bool, String) {
    let (ended, text) = run(folder, ICARUS.0, &[ICARUS.1, plusargs].concat());
    let says = |word: &str| text.lines().any(|line| line.starts_with(word));
    assert_eq!((ended, !ended), (says("PASS "), says("FAIL ")), "{text}");
    (ended, text)
}

/// A device behind two registers.
const LATE: &str = "
module @NAME@ (
    input logic clk, rst, input logic [1:0] op, input logic [@W@-1:0] @IN@,
    output logic [@W@-1:0] @STATE@, output logic [@O@-1:0] @OUT@
);
    wire [@W@-1:0] now;
    wire [@O@-1:0] read;
    @NAME@_core core (.clk(clk), .rst(rst), .op(op), @PORTS@, .@STATE@(now), .@OUT@(read));
    logic [@W@+@O@-1:0] first;
    always_ff @(posedge clk) begin
        first <= {now, read};
        {@STATE@, @OUT@} <= first;
    end
endmodule
";

/// A device behind three registers that says when it takes a row and when it answers.
const VALID: &str = "
module @NAME@ (
    input logic clk, rst, input logic [1:0] op, input logic in_valid, output logic out_valid,
    input logic [@W@-1:0] @IN@,
    output logic [@W@-1:0] @STATE@, output logic [@O@-1:0] @OUT@
);
    wire [@W@-1:0] now;
    wire [@O@-1:0] read;
    @NAME@_core core (.clk(clk), .rst(rst), .op(in_valid ? op : 2'd3), @PORTS@, .@STATE@(now), .@OUT@(read));
    logic [@W@+@O@-1:0] first, second;
    logic [3:0] seen;
    assign out_valid = seen[3];
    always_ff @(posedge clk) begin
        first <= {now, read};
        second <= first;
        {@STATE@, @OUT@} <= second;
        seen <= rst ? 0 : {seen[2:0], in_valid};
    end
endmodule
";

/// The walks of a set's devices, their outputs two clocks late; with `valid`, three clocks and two ports more.
fn registered(devices: &str, valid: bool) -> String {
    let core = |text: String, name: &str| {
        let renamed = text.replace(&format!("{name} #("), &format!("{name}_core #("));
        renamed.replace(&format!("{name}_core_core"), &format!("{name}_core"))
    };
    let mut text = core(core(devices.to_owned(), "dda"), "edge_stepper");
    for (name, state, inputs, output) in
        [("dda", "acc", "init, dx, dy", "out_v"), ("edge_stepper", "e", "e0, ea, eb", "in_v")]
    {
        // The wrapper is as wide as the device of `tiny`.
        let ports: Vec<String> = inputs.split(", ").map(|id| format!(".{id}({id})")).collect();
        let (width, out) = if name == "dda" { ("7", "3") } else { ("6", "1") };
        let wrapper = if valid { VALID } else { LATE };
        let values = [
            ("@NAME@", name),
            ("@W@", width),
            ("@O@", out),
            ("@IN@", inputs),
            ("@PORTS@", &ports.join(", ")),
            ("@STATE@", state),
            ("@OUT@", output),
        ];
        text +=
            &values.iter().fold(wrapper.to_owned(), |text, (key, value)| text.replace(key, value));
    }
    text
}

pub(crate) fn latency(_: &str) {
    let set = Set::new("tiny --count 1200");
    let ours = set.read("dut.sv");
    let file = |text: &str| std::fs::write(set.folder.join("late.sv"), text).unwrap();
    let slow = registered(&ours, false);
    file(&slow);
    build(&set.folder, &[], &["late.sv"]);
    let (good, text) = bench(&set.folder, &["+latency=2"]);
    assert!(good && text.contains("dda rows=1200 edge rows=1200 "), "{text}");
    // As the files have it, with every row in the dump.
    assert!(bench(&set.folder, &["+latency=2", "+dump"]).0);
    assert_eq!(set.read("dda.exp.dut.tv"), set.read("dda.exp.tv"));
    for wrong in ["+latency=1", "+latency=0", "+latency=3"] {
        assert!(!bench(&set.folder, &[wrong]).0, "{wrong}");
    }
    assert!(bench(&set.folder, &["+latency=64"]).1.contains("0 to 63 is possible"));
    // Late and wrong.
    let spoil = |text: &str| {
        let spoilt = text.replace("addend = op == LOAD ? init", "addend = op == LOAD ? init | 1");
        assert_ne!(spoilt, text);
        spoilt
    };
    file(&spoil(&slow));
    build(&set.folder, &[], &["late.sv"]);
    let (good, text) = bench(&set.folder, &["+latency=2"]);
    assert!(
        !good && text.contains("(dda.exp.tv line ") && text.contains("op 0) field acc"),
        "{text}"
    );
    // With valid, whatever the latency.
    let valid = registered(&ours, true);
    file(&valid);
    build(&set.folder, &["-DGUARDBIT_VALID"], &["late.sv"]);
    assert!(bench(&set.folder, &[]).0);
    assert!(bench(&set.folder, &["+dump"]).0);
    assert_eq!(set.read("edge.exp.dut.tv"), set.read("edge.exp.tv"));
    for (what, with, says) in [
        ("addend = op == LOAD ? init", "addend = op == LOAD ? init | 1", "field acc"),
        // An answer too much after the reset, and one that never comes.
        ("rst ? 0", "rst ? 8", "out_valid is 1, and 0 rows are awaited"),
        ("out_valid = seen[3]", "out_valid = 1'b0", "out_valid has been low"),
        ("out_valid = seen[3]", "out_valid = 1'bx", "out_valid is x"),
    ] {
        assert!(valid.contains(what), "{what}");
        file(&valid.replace(what, with));
        build(&set.folder, &["-DGUARDBIT_VALID"], &["late.sv"]);
        let (good, text) = bench(&set.folder, &[]);
        assert!(!good && text.contains(says), "{what}: {text}");
    }
}

/// The devices as `hdl` has them, with the defaults of nobody's profile: the bench sets their parameters.
pub(crate) fn parameters(_: &str) {
    let hdl = Path::new(env!("CARGO_MANIFEST_DIR")).join("hdl");
    let names = [
        "dda.sv",
        "edge_stepper.sv",
        "edge_evaluator.sv",
        "depth_evaluator.sv",
        "triangle_engine.sv",
        "setup_divider.sv",
        "triangle_setup.sv",
    ];
    let files: Vec<String> =
        names.iter().map(|name| hdl.join(name).display().to_string()).collect();
    let files: Vec<&str> = files.iter().map(String::as_str).collect();
    for profile in ["tiny", "sgi-4k"] {
        let set = Set::new(&format!("{profile} --count 600"));
        build(&set.folder, &["-DGUARDBIT_PARAMETERS"], &files);
        let (good, text) = bench(&set.folder, &[]);
        assert!(good && text.contains(" triangle rows="), "{text}");
        assert!(!text.contains("not checked"), "{text}");
        // The widths are the package's and nothing else's.
        let package = set.read("pkg.sv");
        let other =
            package.replace("localparam int EDGE_SHIFT = ", "localparam int EDGE_SHIFT = 1 + ");
        assert_ne!(other, package);
        std::fs::write(set.folder.join("pkg.sv"), other).unwrap();
        build(&set.folder, &["-DGUARDBIT_PARAMETERS"], &files);
        assert!(!bench(&set.folder, &[]).0);
    }
}

/// An engine that answers by stamps of 2 x 2 pixels, and runs from the last row up: the set's engine, whose
/// answers are held back until the triangle is done.
const STAMPS: &str = "
module triangle_engine #(parameter int M = @M@, D = @D@, I = @I@, C = @C@) (
    input logic clk, rst, in_valid, output logic in_ready,
    input logic [31:0] test,
    input logic [M-1:0] edge0_init, edge0_dx, edge0_dy, edge1_init, edge1_dx, edge1_dy, edge2_init, edge2_dx, edge2_dy,
    input logic [D-1:0] depth_init, depth_dx, depth_dy,
    input logic zero_area,
    input logic [C-1:0] box_y_begin, box_y_end, box_x_begin, box_x_end,
    output logic span_valid, input logic span_ready,
    output logic [31:0] span_test, output logic [C-1:0] span_y, span_x_begin, span_x_end,
    output logic sample_valid, input logic sample_ready,
    output logic [31:0] sample_test, output logic [C-1:0] sample_y, sample_x, output logic [I-1:0] sample_depth,
    output logic triangle_valid, input logic triangle_ready,
    output logic [31:0] triangle_test, triangle_spans, triangle_samples, output logic triangle_zero_area
);
    wire c_span, c_sample, c_done;
    wire [31:0] st, pt;
    wire [C-1:0] sy, sb, se, py, px;
    wire [I-1:0] pd;
    engine_core core (
        .clk(clk), .rst(rst), .in_valid(in_valid), .in_ready(in_ready), .test(test),
        .edge0_init(edge0_init), .edge0_dx(edge0_dx), .edge0_dy(edge0_dy),
        .edge1_init(edge1_init), .edge1_dx(edge1_dx), .edge1_dy(edge1_dy),
        .edge2_init(edge2_init), .edge2_dx(edge2_dx), .edge2_dy(edge2_dy),
        .depth_init(depth_init), .depth_dx(depth_dx), .depth_dy(depth_dy), .zero_area(zero_area),
        .box_y_begin(box_y_begin), .box_y_end(box_y_end), .box_x_begin(box_x_begin), .box_x_end(box_x_end),
        .span_valid(c_span), .span_ready(1'b1), .span_test(st), .span_y(sy), .span_x_begin(sb), .span_x_end(se),
        .sample_valid(c_sample), .sample_ready(1'b1), .sample_test(pt), .sample_y(py), .sample_x(px), .sample_depth(pd),
        .triangle_valid(c_done), .triangle_ready(triangle_ready && triangle_valid), .triangle_test(triangle_test),
        .triangle_spans(triangle_spans), .triangle_samples(triangle_samples), .triangle_zero_area(triangle_zero_area)
    );
    reg [32+3*C-1:0] spans [$];
    reg [32+2*C+I-1:0] samples [$];
    reg [2*C-1:0] key, least;
    reg [C-1:0] y, x;
    reg [I-1:0] depth;
    reg [31:0] name;
    integer k, at;
    initial begin
        span_valid = 0;
        sample_valid = 0;
        triangle_valid = 0;
    end
    always @(posedge clk) begin
        if (c_span) spans.push_back({st, sy, sb, se});
        if (c_sample) samples.push_back({pt, py, px, pd});
        if (sample_valid && sample_ready) sample_valid <= 0;
        if (span_valid && span_ready) span_valid <= 0;
        if (triangle_valid && triangle_ready) triangle_valid <= 0;
        else if (c_done && !triangle_valid) begin
            if (samples.size() > 0 && (!sample_valid || sample_ready)) begin
                at = 0;
                for (k = 0; k < samples.size(); k = k + 1) begin
                    {name, y, x, depth} = samples[k];
                    key = {y[C-1:1], x[C-1:1], y[0], x[0]};
                    if (k == 0 || key < least) begin
                        least = key;
                        at = k;
                    end
                end
                {name, y, x, depth} = samples[at];
                samples.delete(at);
                sample_test <= name;
                sample_y <= y;
                sample_x <= x;
                sample_depth <= depth;
                sample_valid <= 1;
            end
            if (spans.size() > 0 && (!span_valid || span_ready)) begin
                {name, y, x, key[C-1:0]} = spans.pop_back();
                span_test <= name;
                span_y <= y;
                span_x_begin <= x;
                span_x_end <= key[C-1:0];
                span_valid <= 1;
            end
            if (spans.size() == 0 && samples.size() == 0 && !span_valid && !sample_valid) triangle_valid <= 1;
        end
    end
endmodule
";

/// The set's devices with that engine.
fn stamps(set: &Set) -> String {
    let devices = set.read("dut.sv").replace("module triangle_engine #(", "module engine_core #(");
    let package = set.read("pkg.sv");
    let value = |name: &str| {
        let start = format!("localparam int {name} = ");
        let at = package.find(&start).expect(name) + start.len();
        package[at..].split(';').next().unwrap().to_owned()
    };
    let names = [
        ("@M@", "TRIANGLE_CFG_EDGE0_INIT_WIDTH"),
        ("@D@", "TRIANGLE_CFG_DEPTH_INIT_WIDTH"),
        ("@I@", "INTEGER_BITS"),
        ("@C@", "TRIANGLE_CFG_BOX_X_BEGIN_WIDTH"),
    ];
    devices
        + &names.iter().fold(STAMPS.to_owned(), |text, (key, name)| text.replace(key, &value(name)))
}

pub(crate) fn order(_: &str) {
    let profile = "[traversal]\norder = \"bounding-box\"\nstamp = \"2x2\"\n\n[depth]";
    // By default the order is the profile's: its own in the second set, that of the files in the first.
    for (set, default) in [
        (Set::new("tiny --count 400"), "+fileorder"),
        (Set::of("tiny", &[("[depth]", profile)], "--count 400"), "+anyorder"),
        (Set::of("sgi-4k", &[("[depth]", profile)], "--count 200"), "+anyorder"),
    ] {
        let ours = stamps(&set);
        let file = |text: &str| std::fs::write(set.folder.join("stamps.sv"), text).unwrap();
        file(&ours);
        build(&set.folder, &[], &["stamps.sv"]);
        let (good, text) = bench(&set.folder, &["+anyorder", "+dump"]);
        assert!(
            good && text.contains(" triangle rows=") && !text.contains("not checked"),
            "{text}"
        );
        // The rows are those of the files, in another order.
        let sorted = |name: &str| {
            let text = set.read(name);
            let mut rows: Vec<String> = text.lines().map(str::to_owned).collect();
            rows.sort_unstable();
            rows
        };
        assert_ne!(set.read("depth.exp.dut.tv"), set.read("depth.exp.tv"));
        assert_eq!(sorted("depth.exp.dut.tv"), sorted("depth.exp.tv"));
        let (good, text) = bench(&set.folder, &["+fileorder"]);
        assert!(!good && text.contains("MISMATCH triangle (span.exp.tv line "), "{text}");
        assert_eq!(bench(&set.folder, &["+no-reset"]).0, default == "+anyorder");
        // In any order, a wrong value, a row too much, a row twice and a missing one are still seen.
        for (what, with, says) in [
            (
                "sample_depth <= depth;",
                "sample_depth <= depth ^ (x == 1 && y == 1);",
                "field depth",
            ),
            ("sample_x <= x;", "sample_x <= x + (x == 1);", "no row is left with test"),
            (
                "samples.delete(at);",
                "if (x != 1 || y != 1 || least[0]) samples.delete(at);",
                "FAIL",
            ),
            ("if (c_span) ", "if (c_span && sy != 1) ", "others of the tests so far are missing"),
            ("sample_test <= name;", "sample_test <= name + 5;", "no row is left with test"),
        ] {
            assert!(ours.contains(what), "{what}");
            let spoilt =
                ours.replace(what, with).replace("|| least[0]) samples", "|| beat_twice) samples");
            let spoilt = spoilt.replace(
                "    integer k, at;",
                "    integer k, at;\n    reg beat_twice = 0;\n    always @(posedge clk) beat_twice <= ~beat_twice;",
            );
            file(&spoilt);
            build(&set.folder, &[], &["stamps.sv"]);
            let (good, text) = bench(&set.folder, &["+anyorder"]);
            assert!(!good && text.contains(says), "{what}: {text}");
        }
    }
}

/// Conservative coverage, in words that hold every value of it.
const SQUARES: &str = "width = 7\n[form.edge-function.conservative]\nmode = \"outer\"\ngrow = 1\n\
                       degenerate = \"draw\"";

/// What a set has no device for is named: in the verdict, in the head of the bench, in the manifest.
pub(crate) fn left_out(_: &str) {
    let reciprocal = ("division = \"quotient\"", "division = { reciprocal = { bits = 12 } }");
    for (profile, lines, bench_name, reason, rest) in [
        ("tiny", vec![reciprocal], "setup", "division is not quotient", " triangle rows="),
        (
            "tiny",
            vec![("clamp = \"guard\"", "clamp = \"saturate\"")],
            "triangle",
            "clamp is saturate",
            " setup rows=",
        ),
        (
            "tiny",
            vec![("width = 6", SQUARES)],
            "setup",
            "coverage is conservative",
            " triangle rows=",
        ),
        (
            "sgi-4k-walk",
            vec![],
            "setup triangle",
            "the devices draw edge functions over a box, and the machine is edge-walk",
            "dda rows=",
        ),
        (
            "d3d11",
            vec![],
            "line point",
            "no device of the set does what line.cfg.tv asks",
            " triangle rows=",
        ),
    ] {
        let set = Set::of(profile, &lines, "--count 300");
        build(&set.folder, &[], &["dut.sv"]);
        let (good, text) = bench(&set.folder, &[]);
        let verdict = text.lines().find(|line| line.starts_with("PASS ")).expect(&text);
        assert!(good && verdict.ends_with(&format!(" not checked: {bench_name}")), "{text}");
        assert!(verdict.contains(rest), "{text}");
        let first = bench_name.split(' ').next().unwrap();
        assert!(text.contains(&format!("NOT CHECKED {first}: {reason}")), "{text}");
        assert!(set.read("tb.sv").contains(&format!("// Not checked, {first}: {reason}")));
        let manifest: serde_json::Value = serde_json::from_str(&set.read("manifest.json")).unwrap();
        let left = manifest["unchecked"].as_array().unwrap();
        for name in bench_name.split(' ') {
            assert!(left.iter().any(|left| left["bench"] == name && left["testbench"] == "tb.sv"));
        }
    }
}

/// A dump is complete up to the clock at which the simulation stops.
pub(crate) fn dump_before_the_end(_: &str) {
    let set = Set::new("tiny --count 300");
    // An engine that stops answering after 5 triangles.
    let devices = set.read("dut.sv");
    let stops = devices.replace(
        "assign in_ready = state == IDLE;",
        "assign in_ready = state == IDLE && !(test > 4);",
    );
    assert_ne!(stops, devices);
    let file = |text: &str| std::fs::write(set.folder.join("dut.sv"), text).unwrap();
    // It takes a record without saying so, again and again: an end is put to that.
    file(&stops);
    build_verilator(&set.folder);
    let (good, text) = run(&set.folder, VERILATOR.0, &[]);
    let ended = ["the device answers without end", "the device hangs"];
    assert!(!good && ended.iter().any(|end| text.contains(end)), "{text}");
    let takes = "IDLE:\n                    if (in_valid)";
    assert!(stops.contains(takes));
    file(&stops.replace(takes, "IDLE:\n                    if (in_valid && in_ready)"));
    build_verilator(&set.folder);
    let (good, text) = run(&set.folder, VERILATOR.0, &["+dump"]);
    assert!(!good && text.contains("FAIL triangle: no transfer"), "{text}");
    let dump = set.read("triangle.exp.dut.tv");
    assert_eq!(dump.lines().count(), 5, "{dump}");
    assert!(dump.ends_with('\n'));
}

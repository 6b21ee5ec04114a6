//! A set-up by itself in a simulator: what is proved of its words is looked at there.

use crate::set::run;
use guardbit::setup::{Gradient, Triangle};
use std::fmt::Write as _;
use std::path::Path;

/// Rows of a set that are looked at.
const ROWS: usize = 2_000;

/// Holds each triangle for some clocks, its handshake open, and compares the words after them.
const PROBE: &str = "module probe;
  reg [9*24-1:0] given [0:ROWS-1];
  reg [10*36-1:0] edges [0:ROWS-1];
  reg [3*96+51:0] planes [0:ROWS-1];
  reg clk = 0, rst = 1;
  integer i, k, wrong = 0;
  reg [23:0] x0, y0, z0, x1, y1, z1, x2, y2, z2;
  reg [35:0] want [0:8];
  reg [35:0] want_flag;
  reg [95:0] gx, gy, gz;
  reg [51:0] area;
  wire [34:0] e0, a0, b0, e1, a1, b1, e2, a2, b2;
  wire flag;
  triangle_setup #(.SERIAL(0)) device (.clk(clk), .rst(rst), .in_valid(1'b1), .out_ready(1'b1),
    .v0_x(x0[22:0]), .v0_y(y0[22:0]), .v0_z(z0), .v1_x(x1[22:0]), .v1_y(y1[22:0]), .v1_z(z1),
    .v2_x(x2[22:0]), .v2_y(y2[22:0]), .v2_z(z2),
    .o_edge0_init(e0), .o_edge0_dx(a0), .o_edge0_dy(b0), .o_edge1_init(e1), .o_edge1_dx(a1), .o_edge1_dy(b1),
    .o_edge2_init(e2), .o_edge2_dx(a2), .o_edge2_dy(b2), .o_zero_area(flag));
  initial begin
    // Without a reset a register holds anything, but no X.
    device.held = 1'b1;
    device.going = 1'b1;
    $readmemh(\"given.mem\", given);
    $readmemh(\"edges.mem\", edges);
    $readmemh(\"planes.mem\", planes);
    for (i = 0; i < ROWS; i = i + 1) begin
      {x0, y0, z0, x1, y1, z1, x2, y2, z2} = given[i];
      {want[0], want[1], want[2], want[3], want[4], want[5], want[6], want[7], want[8], want_flag} = edges[i];
      {gx, gy, gz, area} = planes[i];
      for (k = 0; k < 12; k = k + 1) begin
        rst = k < 2 && i == 0;
        #1 clk = 1;
        #1 clk = 0;
      end
      if (flag !== want_flag[0]) wrong = wrong + 1;
      else if (!flag && ({e0, a0, b0, e1, a1, b1, e2, a2, b2} !== {want[0][34:0], want[1][34:0], want[2][34:0],
          want[3][34:0], want[4][34:0], want[5][34:0], want[6][34:0], want[7][34:0], want[8][34:0]}
          || $signed(device.gx) !== $signed(gx) || $signed(device.gy) !== $signed(gy)
          || $signed(device.gz) !== $signed(gz) || device.area !== area[$bits(device.area)-1:0])) wrong = wrong + 1;
    end
    $display(\"%0d rows, %0d wrong\", ROWS, wrong);
    $finish;
  end
endmodule
";

/// How many rows of the set `dut.sv` in `home` answers otherwise than the set and the plane's numerators (`P-1`).
pub(super) fn wrong(home: &Path, set: &Path) -> usize {
    let rows = |name: &str| -> Vec<Vec<u128>> {
        let text = std::fs::read_to_string(set.join(name)).unwrap();
        let row = |line: &str| -> Vec<u128> {
            line.split('_').map(|word| u128::from_str_radix(word, 16).unwrap()).collect()
        };
        text.lines().take(ROWS).map(row).collect()
    };
    let [mut given, mut edges, mut planes] = [const { String::new() }; 3];
    let triangles = rows("setup.cfg.tv");
    for (row, answer) in triangles.iter().zip(rows("setup.exp.tv")) {
        for word in row {
            let _ = write!(given, "{word:06x}");
        }
        for word in &answer[..9] {
            let _ = write!(edges, "{word:09x}");
        }
        let _ = write!(edges, "{:09x}", answer[12]);
        let word = |at: usize| i128::try_from(row[at]).unwrap();
        let corner = |at: usize| [word(3 * at), word(3 * at + 1)];
        let depth = |at: usize| word(3 * at + 2);
        let turned = Triangle { xy: [0, 1, 2].map(corner), z: None }.area2() < 0;
        let order = if turned { [0, 2, 1] } else { [0, 1, 2] };
        let triangle = Triangle { xy: order.map(corner), z: None };
        let Gradient { x, y, area2, anchor: ([ax, ay], z) } =
            Gradient::new(&triangle, order.map(depth));
        let start = z * area2 + x * (512 - ax) + y * (512 - ay);
        for word in [x, y, start] {
            let _ = write!(planes, "{:024x}", word & ((1 << 96) - 1));
        }
        let _ = writeln!(planes, "{area2:013x}");
        given.push('\n');
        edges.push('\n');
    }
    for (name, text) in [("given.mem", given), ("edges.mem", edges), ("planes.mem", planes)] {
        std::fs::write(home.join(name), text).unwrap();
    }
    let probe = PROBE.replace("ROWS", &triangles.len().to_string());
    std::fs::write(home.join("probe.sv"), probe).unwrap();
    let (good, said) =
        run(home, "iverilog", &["-g2012", "-s", "probe", "-o", "probe.vvp", "dut.sv", "probe.sv"]);
    assert!(good, "{said}");
    let (good, said) = run(home, "vvp", &["-n", "probe.vvp"]);
    let counted =
        said.lines().find_map(|line| line.strip_suffix(" wrong")?.split(", ").nth(1)?.parse().ok());
    assert!(good && counted.is_some(), "{said}");
    counted.unwrap()
}

// A set-up behind valid and ready: vertices are exchanged in the second of three stages.
module staged (
  input clock, reset_n,
  input in_valid, output in_ready,
  input [22:0] v0_x, v0_y, v1_x, v1_y, v2_x, v2_y,
  input [23:0] v0_z, v1_z, v2_z,
  output reg out_valid, input out_ready,
  output [34:0] edge0_init, edge0_dx, edge0_dy, edge1_init, edge1_dx, edge1_dy, edge2_init, edge2_dx, edge2_dy,
  output zero_area
);
  // stage 1: area only, raw vertices kept
  reg s1v, s2v;
  wire en3 = !out_valid || out_ready;
  wire en2 = !s2v || en3;
  wire en1 = !s1v || en2;
  assign in_ready = en1;
  reg [22:0] x0, y0, x1, y1, x2, y2;
  reg signed [46:0] pa, pb;
  always @(posedge clock) if (!reset_n) s1v <= 1'b0; else if (en1) s1v <= in_valid;
  always @(posedge clock) if (en1) begin
    x0 <= v0_x; y0 <= v0_y; x1 <= v1_x; y1 <= v1_y; x2 <= v2_x; y2 <= v2_y;
    pa <= ($signed({1'b0,v1_x}) - $signed({1'b0,v0_x})) * ($signed({1'b0,v2_y}) - $signed({1'b0,v0_y}));
    pb <= ($signed({1'b0,v2_x}) - $signed({1'b0,v0_x})) * ($signed({1'b0,v1_y}) - $signed({1'b0,v0_y}));
  end
  // stage 2: exchange
  wire sw = pa < pb;
  reg [22:0] ax, ay, bx, by, cx, cy; reg flat;
  always @(posedge clock) if (!reset_n) s2v <= 1'b0; else if (en2) s2v <= s1v;
  always @(posedge clock) if (en2) begin
    ax <= x0; ay <= y0;
    bx <= sw ? x2 : x1; by <= sw ? y2 : y1;
    cx <= sw ? x1 : x2; cy <= sw ? y1 : y2;
    flat <= pa == pb;
  end
  // stage 3
  reg [104:0] r0, r1, r2; reg fl;
  wire [104:0] n0, n1, n2;
  staged_edge k0(ax, ay, bx, by, n0);
  staged_edge k1(bx, by, cx, cy, n1);
  staged_edge k2(cx, cy, ax, ay, n2);
  always @(posedge clock) if (!reset_n) out_valid <= 1'b0; else if (en3) out_valid <= s2v;
  always @(posedge clock) if (en3) begin r0 <= n0; r1 <= n1; r2 <= n2; fl <= flat; end
  assign zero_area = fl;
  assign {edge0_init, edge0_dx, edge0_dy} = fl ? 105'd0 : r0;
  assign {edge1_init, edge1_dx, edge1_dy} = fl ? 105'd0 : r1;
  assign {edge2_init, edge2_dx, edge2_dy} = fl ? 105'd0 : r2;
endmodule
module staged_edge (input [22:0] px, py, qx, qy, output [104:0] w);
  wire [23:0] a = {1'b0,py} - {1'b0,qy};
  wire [23:0] b = {1'b0,qx} - {1'b0,px};
  wire signed [23:0] sa = a, sb = b;
  // E = a*(512-px) + b*(512-py);  owns: a>0 or a==0 and b>0, as a case on signs
  reg bias;
  always @* case ({a[23], |a, b[23], |b})
      4'b0100, 4'b0101, 4'b0111: bias = 1'b0;
      4'b0001: bias = 1'b0;
      default: bias = 1'b1;
    endcase
  wire signed [47:0] e = sa * (24'sd512 - $signed({1'b0,px})) + sb * (24'sd512 - $signed({1'b0,py}));
  wire signed [47:0] f = e - $signed({1'b0,bias});
  wire signed [37:0] g = f >>> 10;
  assign w = {g[34:0], {{11{a[23]}},a}, {{11{b[23]}},b}};
endmodule

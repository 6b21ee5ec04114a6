// A set-up in four stages: the words of both windings are worked out, and chosen at the end.
module late_edge (
  input clk, input [22:0] fx, fy, tx, ty,
  output reg signed [34:0] w, nw, dx, dy, ndx, ndy   // forward, and reversed edge
);
  reg signed [23:0] ex, ey; reg signed [23:0] rx, ry; reg own, nown;
  always @(posedge clk) begin
    ex <= {1'b0,tx} - {1'b0,fx};
    ey <= {1'b0,ty} - {1'b0,fy};
    rx <= $signed({1'b0,fx}) - 24'sd512;
    ry <= $signed({1'b0,fy}) - 24'sd512;
    own  <= !(ty > fy) && (ty != fy || tx > fx);
    nown <= ty > fy || (ty >= fy && tx < fx);
  end
  reg signed [46:0] p, q; reg signed [23:0] ex2, ey2; reg own2, nown2;
  always @(posedge clk) begin
    p <= ey * rx; q <= ex * ry; ex2 <= ex; ey2 <= ey; own2 <= own; nown2 <= nown;
  end
  wire signed [45:0] e  = p[45:0] - q[45:0];
  wire [45:0] wf = e + {46{~own2}};
  wire [45:0] wr = -e + {46{~nown2}};
  always @(posedge clk) begin
    w <= wf[44:10]; nw <= wr[44:10];
    dx <= -ey2; dy <= ex2; ndx <= ey2; ndy <= -ex2;
  end
endmodule

module late (
  input clk,
  input [22:0] v0_x, v0_y, v1_x, v1_y, v2_x, v2_y,
  input [23:0] v0_z, v1_z, v2_z,
  output reg [34:0] edge0_init, edge0_dx, edge0_dy, edge1_init, edge1_dx, edge1_dy, edge2_init, edge2_dx, edge2_dy,
  output reg zero_area,
  output reg [44:0] area,
  output reg signed [72:0] plane_x, plane_y, plane_start
);
  wire signed [34:0] w[0:2], nw[0:2], dx[0:2], dy[0:2], ndx[0:2], ndy[0:2];
  late_edge g0(clk, v0_x,v0_y,v1_x,v1_y, w[0],nw[0],dx[0],dy[0],ndx[0],ndy[0]);
  late_edge g1(clk, v1_x,v1_y,v2_x,v2_y, w[1],nw[1],dx[1],dy[1],ndx[1],ndy[1]);
  late_edge g2(clk, v2_x,v2_y,v0_x,v0_y, w[2],nw[2],dx[2],dy[2],ndx[2],ndy[2]);

  // stage 1
  reg signed [23:0] x1, y1, x2, y2, sx, sy; reg signed [24:0] z1, z2; reg [23:0] z0;
  always @(posedge clk) begin
    x1 <= $signed({1'b0,v1_x}) - $signed({1'b0,v0_x});  y1 <= $signed({1'b0,v1_y}) - $signed({1'b0,v0_y});
    x2 <= $signed({1'b0,v2_x}) - $signed({1'b0,v0_x});  y2 <= $signed({1'b0,v2_y}) - $signed({1'b0,v0_y});
    z1 <= $signed({1'b0,v1_z}) - $signed({1'b0,v0_z});  z2 <= $signed({1'b0,v2_z}) - $signed({1'b0,v0_z});
    sx <= 24'sd512 - $signed({1'b0,v0_x});  sy <= 24'sd512 - $signed({1'b0,v0_y});  z0 <= v0_z;
  end
  // stage 2
  reg signed [45:0] a; reg signed [49:0] nx, ny; reg signed [23:0] sxx, syy; reg [23:0] z00;
  always @(posedge clk) begin
    a  <= x1*y2 - x2*y1;
    nx <= z1*y2 - z2*y1;
    ny <= x1*z2 - x2*z1;
    sxx <= sx; syy <= sy; z00 <= z0;
  end
  // stage 3
  reg signed [45:0] a3; reg signed [49:0] nx3, ny3; reg signed [72:0] st3;
  reg left, empty;
  always @(posedge clk) begin
    a3 <= a; nx3 <= nx; ny3 <= ny; left <= a < 0; empty <= a == 0;
    st3 <= $signed({1'b0,z00})*a + nx*sxx + ny*syy;
  end
  // stage 4
  always @(posedge clk) begin
    zero_area <= empty;
    area <= left ? -a3 : a3;
    plane_x <= left ? -nx3 : nx3;
    plane_y <= left ? -ny3 : ny3;
    plane_start <= left ? -st3 : st3;
    {edge0_init, edge0_dx, edge0_dy} <= (left ? {nw[2], ndx[2], ndy[2]} : {w[0], dx[0], dy[0]}) & {105{~empty}};
    {edge1_init, edge1_dx, edge1_dy} <= (left ? {nw[1], ndx[1], ndy[1]} : {w[1], dx[1], dy[1]}) & {105{~empty}};
    {edge2_init, edge2_dx, edge2_dy} <= (left ? {nw[0], ndx[0], ndy[0]} : {w[2], dx[2], dy[2]}) & {105{~empty}};
  end
endmodule

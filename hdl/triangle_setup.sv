// Triangle set-up: three vertices in, edge words and a depth plane at pixel (0, 0) out.
// Spec: triangles T, edges E and C, planes P.
module triangle_setup #(
    parameter int VW = 23,               // bits of a vertex coordinate
    parameter int VS = 0,                // 1 where coordinates are signed
    parameter int S = 10,                // sub-pixel bits
    parameter int SAMPLE_X = 512,        // the sample in its pixel, in sub-pixels
    parameter int SAMPLE_Y = 512,
    parameter int RULE = 0,              // 0 top-left, 1 shadow
    parameter int SHIFT = 10,            // low bits of an edge value that are not kept: 0 or S
    parameter int M = 35,                // bits of an edge word
    parameter int G = 1,                 // guard bits
    parameter int I = 24,                // depth bits
    parameter int F = 13,                // interpolation bits
    parameter int ROUNDING = 4,          // as setup_divider has it
    parameter int HALF = 0,              // 1 where the start gains half a depth step
    parameter int SERIAL = 1             // as setup_divider has it
) (
    input  logic             clk,
    input  logic             rst,
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [VW-1:0]    v0_x, v0_y, v1_x, v1_y, v2_x, v2_y,
    input  logic [I-1:0]     v0_z, v1_z, v2_z,
    output logic             out_valid,
    input  logic             out_ready,
    output logic [M-1:0]     o_edge0_init, o_edge0_dx, o_edge0_dy,
    output logic [M-1:0]     o_edge1_init, o_edge1_dx, o_edge1_dy,
    output logic [M-1:0]     o_edge2_init, o_edge2_dx, o_edge2_dy,
    output logic [G+I+F-1:0] o_depth_init, o_depth_dx, o_depth_dy,
    output logic             o_zero_area
);
    localparam int N = G + I + F;
    localparam int D = VW + 2;           // a coordinate, a sample's offset, their difference
    localparam int P = 2 * D + 2;        // a product of two of them, a sum of four
    localparam int Q = I + P + D + 3;    // a numerator of the plane
    localparam int ZW = Q + F;           // the start's, scaled
    localparam int SW = I + D + 3 + S + F; // a slope's, scaled
    localparam int EW = P > M + SHIFT ? P : M + SHIFT;

    function automatic logic signed [D-1:0] coordinate(input logic [VW-1:0] v);
        coordinate = {{2{VS != 0 && v[VW-1]}}, v};
    endfunction

    // Vertices are held while the dividers work.
    logic signed [D-1:0] x0, y0, x1, y1, x2, y2;
    logic signed [I:0] z0, z1, z2;
    logic held, going;

    // E(p) = a x + b y + c at the sample of pixel (0, 0), less one unless the edge owns its samples.
    function automatic logic [EW-1:0] edge_value(input logic signed [D-1:0] fx, fy, tx, ty);
        logic signed [D-1:0] ex, ey;
        logic owns;
        begin
            ex = tx - fx;
            ey = ty - fy;
            owns = RULE == 0 ? ey < 0 || (ey == 0 && ex > 0) : ey > 0 || (ey == 0 && ex > 0);
            edge_value = EW'(ex) * (EW'(SAMPLE_Y) - EW'(fy)) - EW'(ey) * (EW'(SAMPLE_X) - EW'(fx))
                - (owns ? EW'(0) : EW'(1));
        end
    endfunction
    function automatic logic [M-1:0] step(input logic signed [D-1:0] to, from);
        step = (M'(to) - M'(from)) << (S - SHIFT);
    endfunction

    logic signed [D-1:0] x01, y01, x02, y02;
    logic signed [P-1:0] area2;
    logic turned, zero_area;
    logic [P-1:0] area;
    logic signed [D-1:0] xa, ya, xb, yb, xc, yc;
    logic signed [I:0] za, zb, zc;
    /* verilator lint_off UNUSED */
    logic signed [EW-1:0] e0, e1, e2;
    /* verilator lint_on UNUSED */
    logic signed [I:0] zab, zac;
    logic signed [D-1:0] xab, yab, xac, yac;
    logic signed [Q-1:0] gx, gy, gz;
    // One process: a simulator runs it once for a triangle. As wires, each of these wide words would
    // be worked out again for every vertex that arrives.
    always_comb begin
        // Twice the area, and the order of vertices that makes it positive.
        x01 = x1 - x0;
        y01 = y1 - y0;
        x02 = x2 - x0;
        y02 = y2 - y0;
        area2 = P'(x01) * P'(y02) - P'(x02) * P'(y01);
        turned = area2 < 0;
        area = turned ? -area2 : area2;
        zero_area = area2 == 0;
        xa = x0;
        ya = y0;
        za = z0;
        xb = turned ? x2 : x1;
        yb = turned ? y2 : y1;
        zb = turned ? z2 : z1;
        xc = turned ? x1 : x2;
        yc = turned ? y1 : y2;
        zc = turned ? z1 : z2;
        e0 = edge_value(xa, ya, xb, yb);
        e1 = edge_value(xb, yb, xc, yc);
        e2 = edge_value(xc, yc, xa, ya);

        // The plane's numerators over twice the area.
        xab = xb - xa;
        yab = yb - ya;
        zab = zb - za;
        xac = xc - xa;
        yac = yc - ya;
        zac = zc - za;
        gx = Q'(zab) * Q'(yac) - Q'(zac) * Q'(yab);
        gy = Q'(xab) * Q'(zac) - Q'(xac) * Q'(zab);
        gz = Q'(za) * $signed(Q'(area)) + gx * (Q'(SAMPLE_X) - Q'(xa)) + gy * (Q'(SAMPLE_Y) - Q'(ya));
    end

    /* verilator lint_off UNUSED */
    wire [ZW-1:0] start;
    wire [SW-1:0] depth_dx, depth_dy;
    /* verilator lint_on UNUSED */
    wire [2:0] busy;
    wire go = held && !going;
    setup_divider #(.NW(ZW), .DW(P), .ROUNDING(ROUNDING), .SERIAL(SERIAL)) divide_z (
        .clk(clk), .rst(rst), .start(go), .numerator(ZW'(gz) << F), .divisor(area), .busy(busy[0]), .quotient(start)
    );
    setup_divider #(.NW(SW), .DW(P), .ROUNDING(ROUNDING), .SERIAL(SERIAL)) divide_x (
        .clk(clk), .rst(rst), .start(go), .numerator(SW'(gx) << (S + F)), .divisor(area), .busy(busy[1]), .quotient(depth_dx)
    );
    setup_divider #(.NW(SW), .DW(P), .ROUNDING(ROUNDING), .SERIAL(SERIAL)) divide_y (
        .clk(clk), .rst(rst), .start(go), .numerator(SW'(gy) << (S + F)), .divisor(area), .busy(busy[2]), .quotient(depth_dy)
    );

    assign in_ready = !held;
    assign out_valid = held && going && busy == 0;
    always_ff @(posedge clk)
        if (rst) begin
            held <= 1'b0;
            going <= 1'b0;
        end
        else if (!held) begin
            if (in_valid) begin
                held <= 1'b1;
                x0 <= coordinate(v0_x);
                y0 <= coordinate(v0_y);
                z0 <= {1'b0, v0_z};
                x1 <= coordinate(v1_x);
                y1 <= coordinate(v1_y);
                z1 <= {1'b0, v1_z};
                x2 <= coordinate(v2_x);
                y2 <= coordinate(v2_y);
                z2 <= {1'b0, v2_z};
            end
        end
        else if (!going)
            going <= 1'b1;
        else if (out_valid && out_ready) begin
            held <= 1'b0;
            going <= 1'b0;
        end

    // A triangle of no area has no words.
    localparam logic [N-1:0] BIAS = HALF != 0 && F > 0 ? {{(N-1){1'b0}}, 1'b1} << (F - 1) : {N{1'b0}};
    wire [M-1:0] live = {M{!zero_area}};
    wire [N-1:0] alive = {N{!zero_area}};
    assign o_edge0_init = e0[SHIFT+M-1:SHIFT] & live;
    assign o_edge0_dx = step(ya, yb) & live;
    assign o_edge0_dy = step(xb, xa) & live;
    assign o_edge1_init = e1[SHIFT+M-1:SHIFT] & live;
    assign o_edge1_dx = step(yb, yc) & live;
    assign o_edge1_dy = step(xc, xb) & live;
    assign o_edge2_init = e2[SHIFT+M-1:SHIFT] & live;
    assign o_edge2_dx = step(yc, ya) & live;
    assign o_edge2_dy = step(xa, xc) & live;
    assign o_depth_init = (start[N-1:0] + BIAS) & alive;
    assign o_depth_dx = depth_dx[N-1:0] & alive;
    assign o_depth_dy = depth_dy[N-1:0] & alive;
    assign o_zero_area = zero_area;
endmodule

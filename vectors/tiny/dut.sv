// guardbit vector set tiny, model version 1: devices that pass, in SystemVerilog, generated.
//
// Small, synthesizable and plain. Put your own modules in their place: same names, same ports,
// no parameters needed. Run from inside the set folder:
//     $ iverilog -g2012 -o sim.vvp pkg.sv dut.sv tb.sv && vvp -n sim.vvp
//     $ verilator --binary -O3 -Wno-fatal --top-module tb pkg.sv dut.sv tb.sv -o sim && obj_dir/sim

// Digital differential analyzer with a guard clamp: an accumulator, two slopes, and a read-out of
// the integer bits. The accumulator wraps; only SATURATE writes the clamp back to it.
// Spec: words W, walks D, guard clamp G.
module dda #(
    parameter int G = 1,                 // guard bits
    parameter int I = 3,                // integer bits, the width of the read-out
    parameter int F = 3,                // interpolation bits
    parameter int MODE = 1               // read-out: 0 wrap, 1 guard, 2 sign, 3 saturate
) (
    input  logic             clk,
    input  logic             rst,
    input  logic [1:0]       op,         // 0 load, 1 step by dx, 2 step by dy, 3 hold
    input  logic [G+I+F-1:0] init,
    input  logic [G+I+F-1:0] dx,
    input  logic [G+I+F-1:0] dy,
    output logic [G+I+F-1:0] acc,        // state after the clock edge
    output logic [I-1:0]     out_v
);
    localparam int N = G + I + F;
    localparam logic [1:0] LOAD = 2'd0, STEP_X = 2'd1, STEP_Y = 2'd2, HOLD = 2'd3;
    localparam int GUARD = 1, SIGN = 2, SATURATE = 3;

    // Next state. Two bits more than the accumulator hold any sum of it and a signed step.
    localparam logic [N+1:0] LIMIT = {{(N+1){1'b0}}, 1'b1} << (I + F);
    wire [N-1:0] base = op == LOAD ? {N{1'b0}} : acc;
    wire [N-1:0] addend = op == LOAD ? init : op == STEP_X ? dx : op == STEP_Y ? dy : {N{1'b0}};
    wire is_signed = addend[N-1] && !(G == 0 && op == LOAD);
    wire [N+1:0] sum = {2'b00, base} + {{2{is_signed}}, addend};
    wire below = sum[N+1];
    wire above = !below && sum >= LIMIT;
    wire [N-1:0] saturated = below ? {N{1'b0}} : above ? LIMIT[N-1:0] - 1'b1 : sum[N-1:0];

    always_ff @(posedge clk)
        if (rst) acc <= {N{1'b0}};
        else if (op != HOLD) acc <= MODE == SATURATE ? saturated : sum[N-1:0];

    // Read-out: the guard and integer bits as a pattern u. GUARD splits the patterns above the
    // integer range in the middle: the lower half has come from above, the upper from below.
    localparam logic [G+I:0] ONE = {{(G+I){1'b0}}, 1'b1};
    localparam logic [G+I:0] WHOLE = ONE << I;
    localparam logic [G+I:0] MIDDLE = (ONE << (G + I - 1)) + (ONE << (I - 1));
    wire [G+I:0] u = {1'b0, acc[N-1:F]};
    wire outside = u >= WHOLE;
    wire low = MODE == GUARD ? outside && u >= MIDDLE : MODE == SIGN && acc[N-1];
    wire high = (MODE == GUARD || MODE == SIGN) && outside && !low;
    assign out_v = low ? {I{1'b0}} : high ? {I{1'b1}} : u[I-1:0];
endmodule

// Edge function stepper: a word and its two steps; inside is a clear sign bit. Spec: edges E and C.
module edge_stepper #(
    parameter int M = 6                 // bits of an edge word
) (
    input  logic         clk,
    input  logic         rst,
    input  logic [1:0]   op,             // 0 load, 1 step by ea, 2 step by eb, 3 hold
    input  logic [M-1:0] e0,
    input  logic [M-1:0] ea,
    input  logic [M-1:0] eb,
    output logic [M-1:0] e,              // state after the clock edge
    output logic         in_v
);
    localparam logic [1:0] LOAD = 2'd0, STEP_X = 2'd1, STEP_Y = 2'd2;

    always_ff @(posedge clk)
        if (rst) e <= {M{1'b0}};
        else
            case (op)
                LOAD: e <= e0;
                STEP_X: e <= e + ea;
                STEP_Y: e <= e + eb;
                default: ;
            endcase

    assign in_v = ~e[M-1];
endmodule

// Set-up divider: a signed numerator over a positive divisor, rounded once; one quotient bit a clock,
// or for quick simulation all of them. Spec: planes P and rounding R.
module setup_divider #(
    parameter int NW = 100,              // bits of the numerator and of the quotient, signed
    parameter int DW = 50,               // bits of the divisor, unsigned, at least 1
    // 0 floor, 1 ceiling, 2 toward zero, 3 away from zero; nearest, ties: 4 even, 5 up, 6 down,
    // 7 away from zero, 8 toward zero; 9 to odd if inexact
    parameter int ROUNDING = 4,
    parameter int SERIAL = 1             // 1 a quotient bit a clock, 0 a whole quotient
) (
    input  logic          clk,
    input  logic          rst,
    input  logic          start,         // takes the operands; ignored while busy
    input  logic [NW-1:0] numerator,
    input  logic [DW-1:0] divisor,
    output logic          busy,
    output logic [NW-1:0] quotient       // valid when not busy
);
    localparam int W = NW > DW ? NW : DW;
    // Magnitudes are divided: |n| = q d + r. The sign says what rounding does to q.
    logic [NW-1:0] q;                    // numerator shifting out, quotient shifting in
    logic [DW:0] r;
    logic [DW-1:0] d;
    logic negative;
    logic [$clog2(NW+1)-1:0] left;

    wire [DW:0] shifted = {r[DW-1:0], q[NW-1]};
    wire fits = shifted >= {1'b0, d};

    always_ff @(posedge clk)
        if (rst) begin
            left <= '0;
            q <= '0;
            r <= '0;
            d <= '0;
            negative <= 1'b0;
        end
        else if (left != 0 && SERIAL == 0) begin
            // As the steps below leave them, a divisor of zero apart: nobody reads that quotient.
            q <= d == 0 ? '1 : NW'(W'(q) / W'(d));
            r <= d == 0 ? '0 : (DW+1)'(W'(q) % W'(d));
            left <= '0;
        end
        else if (left != 0) begin
            q <= {q[NW-2:0], fits};
            r <= fits ? shifted - {1'b0, d} : shifted;
            left <= left - 1'b1;
        end
        else if (start) begin
            negative <= numerator[NW-1];
            q <= numerator[NW-1] ? -numerator : numerator;
            r <= '0;
            d <= divisor;
            left <= ($clog2(NW+1))'(NW);
        end

    assign busy = left != 0;

    // Rounded when it stands: nothing behind the registers moves while they work.
    wire [NW-1:0] whole = busy ? '0 : q;
    wire [DW:0] rest = busy ? '0 : r;
    wire inexact = rest != 0;
    wire [DW+1:0] twice = {rest, 1'b0};
    wire over = twice > {2'b00, d};
    wire tie = twice == {2'b00, d};
    wire is_odd = whole[0];
    logic up;                            // one more of magnitude
    always_comb
        case (ROUNDING)
            0: up = inexact && negative;
            1: up = inexact && !negative;
            2: up = 1'b0;
            3: up = inexact;
            4: up = over || (tie && is_odd);
            5: up = over || (tie && !negative);
            6: up = over || (tie && negative);
            7: up = over || tie;
            8: up = over;
            default: up = inexact && !is_odd;
        endcase
    wire [NW-1:0] rounded = whole + {{(NW-1){1'b0}}, up};
    assign quotient = negative ? -rounded : rounded;
endmodule

// Triangle set-up: three vertices in, edge words and a depth plane at pixel (0, 0) out.
// Spec: triangles T, edges E and C, planes P.
module triangle_setup #(
    parameter int VW = 4,               // bits of a vertex coordinate
    parameter int VS = 0,                // 1 where coordinates are signed
    parameter int S = 1,                // sub-pixel bits
    parameter int SAMPLE_X = 1,        // the sample in its pixel, in sub-pixels
    parameter int SAMPLE_Y = 1,
    parameter int RULE = 0,              // 0 top-left, 1 shadow
    parameter int SHIFT = 1,            // low bits of an edge value that are not kept: 0 or S
    parameter int M = 6,                // bits of an edge word
    parameter int G = 1,                 // guard bits
    parameter int I = 3,                // depth bits
    parameter int F = 3,                // interpolation bits
    parameter int ROUNDING = 4,          // as setup_divider has it
    parameter int HALF = 0,              // 1 where the start gains half a depth step
    parameter int SERIAL = 0             // as setup_divider has it
) (
    input  logic             clk,
    input  logic             rst,
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [VW-1:0]    x0, y0, x1, y1, x2, y2,
    input  logic [I-1:0]     z0, z1, z2,
    output logic             out_valid,
    input  logic             out_ready,
    output logic [M-1:0]     o_e0, o_a0, o_b0, o_e1, o_a1, o_b1, o_e2, o_a2, o_b2,
    output logic [G+I+F-1:0] o_z, o_dzdx, o_dzdy,
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
    logic signed [D-1:0] x [0:2];
    logic signed [D-1:0] y [0:2];
    logic signed [I:0] z [0:2];
    logic held, going;

    // Twice the area, and the order of vertices that makes it positive.
    wire signed [D-1:0] x01 = x[1] - x[0], y01 = y[1] - y[0];
    wire signed [D-1:0] x02 = x[2] - x[0], y02 = y[2] - y[0];
    wire signed [P-1:0] area2 = P'(x01) * P'(y02) - P'(x02) * P'(y01);
    wire turned = area2 < 0;
    wire [P-1:0] area = turned ? -area2 : area2;
    wire zero_area = area2 == 0;
    wire signed [D-1:0] xa = x[0], ya = y[0];
    wire signed [D-1:0] xb = turned ? x[2] : x[1], yb = turned ? y[2] : y[1];
    wire signed [D-1:0] xc = turned ? x[1] : x[2], yc = turned ? y[1] : y[2];
    wire signed [I:0] za = z[0];
    wire signed [I:0] zb = turned ? z[2] : z[1];
    wire signed [I:0] zc = turned ? z[1] : z[2];

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
    /* verilator lint_off UNUSED */
    wire signed [EW-1:0] e0 = edge_value(xa, ya, xb, yb);
    wire signed [EW-1:0] e1 = edge_value(xb, yb, xc, yc);
    wire signed [EW-1:0] e2 = edge_value(xc, yc, xa, ya);
    /* verilator lint_on UNUSED */
    function automatic logic [M-1:0] step(input logic signed [D-1:0] to, from);
        step = (M'(to) - M'(from)) << (S - SHIFT);
    endfunction

    // The plane's numerators over twice the area.
    wire signed [I:0] zab = zb - za, zac = zc - za;
    wire signed [D-1:0] xab = xb - xa, yab = yb - ya, xac = xc - xa, yac = yc - ya;
    wire signed [Q-1:0] gx = Q'(zab) * Q'(yac) - Q'(zac) * Q'(yab);
    wire signed [Q-1:0] gy = Q'(xab) * Q'(zac) - Q'(xac) * Q'(zab);
    wire signed [Q-1:0] gz = Q'(za) * $signed(Q'(area)) + gx * (Q'(SAMPLE_X) - Q'(xa)) + gy * (Q'(SAMPLE_Y) - Q'(ya));
    /* verilator lint_off UNUSED */
    wire [ZW-1:0] start;
    wire [SW-1:0] dzdx, dzdy;
    /* verilator lint_on UNUSED */
    wire [2:0] busy;
    wire go = held && !going;
    setup_divider #(.NW(ZW), .DW(P), .ROUNDING(ROUNDING), .SERIAL(SERIAL)) divide_z (
        .clk(clk), .rst(rst), .start(go), .numerator(ZW'(gz) << F), .divisor(area), .busy(busy[0]), .quotient(start)
    );
    setup_divider #(.NW(SW), .DW(P), .ROUNDING(ROUNDING), .SERIAL(SERIAL)) divide_x (
        .clk(clk), .rst(rst), .start(go), .numerator(SW'(gx) << (S + F)), .divisor(area), .busy(busy[1]), .quotient(dzdx)
    );
    setup_divider #(.NW(SW), .DW(P), .ROUNDING(ROUNDING), .SERIAL(SERIAL)) divide_y (
        .clk(clk), .rst(rst), .start(go), .numerator(SW'(gy) << (S + F)), .divisor(area), .busy(busy[2]), .quotient(dzdy)
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
                x[0] <= coordinate(x0);
                y[0] <= coordinate(y0);
                z[0] <= {1'b0, z0};
                x[1] <= coordinate(x1);
                y[1] <= coordinate(y1);
                z[1] <= {1'b0, z1};
                x[2] <= coordinate(x2);
                y[2] <= coordinate(y2);
                z[2] <= {1'b0, z2};
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
    assign o_e0 = e0[SHIFT+M-1:SHIFT] & live;
    assign o_a0 = step(ya, yb) & live;
    assign o_b0 = step(xb, xa) & live;
    assign o_e1 = e1[SHIFT+M-1:SHIFT] & live;
    assign o_a1 = step(yb, yc) & live;
    assign o_b1 = step(xc, xb) & live;
    assign o_e2 = e2[SHIFT+M-1:SHIFT] & live;
    assign o_a2 = step(yc, ya) & live;
    assign o_b2 = step(xa, xc) & live;
    assign o_z = (start[N-1:0] + BIAS) & alive;
    assign o_dzdx = dzdx[N-1:0] & alive;
    assign o_dzdy = dzdy[N-1:0] & alive;
    assign o_zero_area = zero_area;
endmodule

// An edge function over a box: one stepper goes down the box's left side, the other along a row.
// The word at the box's corner takes the only multiplications, mod 2^M as everything else.
module edge_evaluator #(
    parameter int M = 6,                // bits of an edge word
    parameter int C = 17                 // bits of a pixel coordinate
) (
    input  logic         clk,
    input  logic         rst,
    input  logic [1:0]   op,             // 0 to the corner, 1 next sample, 2 next row, 3 hold
    input  logic [C-1:0] x0,             // corner of the box
    input  logic [C-1:0] y0,
    input  logic [M-1:0] e0,             // word at pixel (0, 0)
    input  logic [M-1:0] ea,
    input  logic [M-1:0] eb,
    output logic         in_v            // at the sample that op has reached
);
    localparam logic [1:0] CORNER = 2'd0, SAMPLE = 2'd1, ROW = 2'd2, HOLD = 2'd3;
    localparam logic [1:0] LOAD = 2'd0, STEP_X = 2'd1, STEP_Y = 2'd2;
    localparam int W = M + C;
    /* verilator lint_off UNUSED */
    wire [W-1:0] across = {{C{1'b0}}, ea} * {{M{1'b0}}, x0};
    wire [W-1:0] down = {{C{1'b0}}, eb} * {{M{1'b0}}, y0};
    wire [M-1:0] left;
    wire left_in;
    wire [M-1:0] e;
    /* verilator lint_on UNUSED */
    wire [M-1:0] corner = e0 + across[M-1:0] + down[M-1:0];

    edge_stepper #(.M(M)) side (
        .clk(clk), .rst(rst), .op(op == CORNER ? LOAD : op == ROW ? STEP_Y : HOLD),
        .e0(corner), .ea(ea), .eb(eb), .e(left), .in_v(left_in)
    );
    edge_stepper #(.M(M)) run (
        .clk(clk), .rst(rst), .op(op == SAMPLE ? STEP_X : op == HOLD ? HOLD : LOAD),
        .e0(op == CORNER ? corner : left + eb), .ea(ea), .eb(eb), .e(e), .in_v(in_v)
    );
endmodule

// A depth plane over a box: one DDA goes down the box's left side, the other along a row and reads
// out. The word at the box's corner takes the only multiplications, mod 2^N. Not for SATURATE, whose
// words depend on the way.
module depth_evaluator #(
    parameter int G = 1,                 // guard bits
    parameter int I = 3,                // integer bits
    parameter int F = 3,                // interpolation bits
    parameter int MODE = 1,              // read-out, as dda has it
    parameter int C = 17                 // bits of a pixel coordinate
) (
    input  logic             clk,
    input  logic             rst,
    input  logic [1:0]       op,         // 0 to the corner, 1 next sample, 2 next row, 3 hold
    input  logic [C-1:0]     x0,         // corner of the box
    input  logic [C-1:0]     y0,
    input  logic [G+I+F-1:0] z,          // word at pixel (0, 0)
    input  logic [G+I+F-1:0] dzdx,
    input  logic [G+I+F-1:0] dzdy,
    output logic [I-1:0]     depth       // at the sample that op has reached
);
    localparam logic [1:0] CORNER = 2'd0, SAMPLE = 2'd1, ROW = 2'd2, HOLD = 2'd3;
    localparam logic [1:0] LOAD = 2'd0, STEP_X = 2'd1, STEP_Y = 2'd2;
    localparam int N = G + I + F;
    localparam int W = N + C;
    /* verilator lint_off UNUSED */
    wire [W-1:0] across = {{C{1'b0}}, dzdx} * {{N{1'b0}}, x0};
    wire [W-1:0] down = {{C{1'b0}}, dzdy} * {{N{1'b0}}, y0};
    wire [N-1:0] left;
    wire [I-1:0] left_out;
    wire [N-1:0] acc;
    /* verilator lint_on UNUSED */
    wire [N-1:0] corner = z + across[N-1:0] + down[N-1:0];

    dda #(.G(G), .I(I), .F(F), .MODE(MODE)) side (
        .clk(clk), .rst(rst), .op(op == CORNER ? LOAD : op == ROW ? STEP_Y : HOLD),
        .init(corner), .dx(dzdx), .dy(dzdy), .acc(left), .out_v(left_out)
    );
    dda #(.G(G), .I(I), .F(F), .MODE(MODE)) run (
        .clk(clk), .rst(rst), .op(op == SAMPLE ? STEP_X : op == HOLD ? HOLD : LOAD),
        .init(op == CORNER ? corner : left + dzdy), .dx(dzdx), .dy(dzdy), .acc(acc), .out_v(depth)
    );
endmodule

// A small triangle engine: set-up words and a box in, one triangle at a time; covered runs, depths
// of covered samples and a summary out, each a valid/ready stream of its own. One sample a clock.
// Spec: coverage C, depth P and G, vectors N.
module triangle_engine #(
    parameter int M = 6,                // bits of an edge word
    parameter int G = 1,                 // guard bits
    parameter int I = 3,                // depth bits
    parameter int F = 3,                // interpolation bits
    parameter int MODE = 1,              // read-out, as dda has it; not saturate
    parameter int C = 17                 // bits of a pixel coordinate
) (
    input  logic             clk,
    input  logic             rst,
    input  logic             in_valid,
    output logic             in_ready,
    input  logic [31:0]      test,
    input  logic [M-1:0]     e0, a0, b0, e1, a1, b1, e2, a2, b2,
    input  logic [G+I+F-1:0] z, dzdx, dzdy,
    input  logic             zero_area,
    input  logic [C-1:0]     x0, y0, x1, y1,   // the box, half open
    // Maximal runs of covered samples, half open, in the order of y then x.
    output logic             span_valid,
    input  logic             span_ready,
    output logic [31:0]      span_test,
    output logic [C-1:0]     span_y, span_x0, span_x1,
    // Covered samples.
    output logic             depth_valid,
    input  logic             depth_ready,
    output logic [31:0]      depth_test,
    output logic [C-1:0]     depth_x, depth_y,
    output logic [I-1:0]     depth_z,
    // One a triangle, when the rest of it has been taken.
    output logic             triangle_valid,
    input  logic             triangle_ready,
    output logic [31:0]      triangle_test, triangle_spans, triangle_samples,
    output logic             triangle_zero_area
);
    typedef enum logic [1:0] {IDLE, CORNER, RUN, DONE} state_t;
    localparam logic [1:0] TO_CORNER = 2'd0, NEXT = 2'd1, ROW = 2'd2, HOLD = 2'd3;

    state_t state;
    logic [31:0] name;
    logic [M-1:0] e [0:2];
    logic [M-1:0] a [0:2];
    logic [M-1:0] b [0:2];
    logic [G+I+F-1:0] start, slope_x, slope_y;
    logic nothing;
    logic [C-1:0] left, right, bottom;
    logic [C-1:0] x, y;
    logic in_run;                        // samples since first are covered
    logic [C-1:0] first;
    logic [31:0] spans, samples;

    wire [2:0] covers;
    logic [1:0] op;
    edge_evaluator #(.M(M), .C(C)) edge_0 (.clk(clk), .rst(rst), .op(op), .x0(left), .y0(y), .e0(e[0]), .ea(a[0]), .eb(b[0]), .in_v(covers[0]));
    edge_evaluator #(.M(M), .C(C)) edge_1 (.clk(clk), .rst(rst), .op(op), .x0(left), .y0(y), .e0(e[1]), .ea(a[1]), .eb(b[1]), .in_v(covers[1]));
    edge_evaluator #(.M(M), .C(C)) edge_2 (.clk(clk), .rst(rst), .op(op), .x0(left), .y0(y), .e0(e[2]), .ea(a[2]), .eb(b[2]), .in_v(covers[2]));
    depth_evaluator #(.G(G), .I(I), .F(F), .MODE(MODE), .C(C)) plane (.clk(clk), .rst(rst), .op(op), .x0(left), .y0(y), .z(start), .dzdx(slope_x), .dzdy(slope_y), .depth(depth_z));

    wire at_end = x == right;
    wire covered = state == RUN && !at_end && covers == 3'b111;
    wire closes = state == RUN && in_run && !covered;
    wire stalled = (covered && !depth_ready) || (closes && !span_ready);
    wire moves = state == RUN && !stalled;
    wire last_row = y + 1'b1 >= bottom;

    always_comb
        case (state)
            CORNER: op = TO_CORNER;
            RUN: op = !moves || (at_end && last_row) ? HOLD : at_end ? ROW : NEXT;
            default: op = HOLD;
        endcase

    assign in_ready = state == IDLE;
    assign span_valid = closes;
    assign span_test = name;
    assign span_y = y;
    assign span_x0 = first;
    assign span_x1 = x;
    assign depth_valid = covered;
    assign depth_test = name;
    assign depth_x = x;
    assign depth_y = y;
    assign triangle_valid = state == DONE;
    assign triangle_test = name;
    assign triangle_spans = spans;
    assign triangle_samples = samples;
    assign triangle_zero_area = nothing;

    always_ff @(posedge clk)
        if (rst) begin
            state <= IDLE;
            in_run <= 1'b0;
        end
        else
            case (state)
                IDLE:
                    if (in_valid) begin
                        name <= test;
                        e[0] <= e0;
                        a[0] <= a0;
                        b[0] <= b0;
                        e[1] <= e1;
                        a[1] <= a1;
                        b[1] <= b1;
                        e[2] <= e2;
                        a[2] <= a2;
                        b[2] <= b2;
                        start <= z;
                        slope_x <= dzdx;
                        slope_y <= dzdy;
                        nothing <= zero_area;
                        left <= x0;
                        right <= x1;
                        bottom <= y1;
                        x <= x0;
                        y <= y0;
                        spans <= 0;
                        samples <= 0;
                        in_run <= 1'b0;
                        state <= CORNER;
                    end
                CORNER: state <= nothing || left >= right || y >= bottom ? DONE : RUN;
                RUN:
                    if (moves) begin
                        if (covered) begin
                            samples <= samples + 1;
                            if (!in_run) first <= x;
                        end
                        in_run <= covered;
                        if (closes) spans <= spans + 1;
                        if (!at_end) x <= x + 1'b1;
                        else begin
                            x <= left;
                            y <= y + 1'b1;
                            if (last_row) state <= DONE;
                        end
                    end
                default:
                    if (triangle_ready) state <= IDLE;
            endcase
endmodule

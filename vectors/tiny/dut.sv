// guardbit vector set tiny, model version 2: devices, in SystemVerilog, generated.
//
// Small, synthesizable devices that pass. Put your own modules in their place: same names, same ports,
// no parameters needed; with -DGUARDBIT_PARAMETERS the bench sets parameters of these names from pkg.sv.
// Run from inside the set folder:
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
    parameter int ROUNDING = 4,          // one of the codes below
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
    localparam int FLOOR = 0, CEILING = 1, TOWARD_ZERO = 2, AWAY_FROM_ZERO = 3;
    // To the nearest; a tie goes where the name says.
    localparam int NEAREST_EVEN = 4, NEAREST_UP = 5, NEAREST_DOWN = 6;
    localparam int NEAREST_AWAY = 7, NEAREST_TOWARD_ZERO = 8;
    localparam int ODD = 9;              // to the odd neighbour if inexact
    localparam int W = NW > DW ? NW : DW;
    // Magnitudes are divided: |n| = q d + r. The sign says what rounding does to q.
    logic [NW-1:0] q;                    // numerator shifting out, quotient shifting in
    logic [DW:0] r;
    logic [DW-1:0] d;
    logic negative;
    logic [$clog2(NW+1)-1:0] left;

    wire [DW:0] shifted = {r[DW-1:0], q[NW-1]};
    wire fits = shifted >= {1'b0, d};

    function automatic logic [NW-1:0] magnitude(input logic [NW-1:0] signed_word);
        magnitude = signed_word[NW-1] ? -signed_word : signed_word;
    endfunction

    always_ff @(posedge clk)
        if (rst) begin
            left <= '0;
            q <= '0;
            r <= '0;
            d <= '0;
            negative <= 1'b0;
        end
        else if (left != 0) begin
            q <= {q[NW-2:0], fits};
            r <= fits ? shifted - {1'b0, d} : shifted;
            left <= left - 1'b1;
        end
        else if (start) begin
            negative <= numerator[NW-1];
            d <= divisor;
            if (SERIAL == 0) begin
                // As the steps leave them, a divisor of zero apart: nobody reads that quotient.
                q <= divisor == 0 ? '1 : NW'(W'(magnitude(numerator)) / W'(divisor));
                r <= divisor == 0 ? '0 : (DW+1)'(W'(magnitude(numerator)) % W'(divisor));
            end
            else begin
                q <= magnitude(numerator);
                r <= '0;
                left <= ($clog2(NW+1))'(NW);
            end
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
            FLOOR: up = inexact && negative;
            CEILING: up = inexact && !negative;
            TOWARD_ZERO: up = 1'b0;
            AWAY_FROM_ZERO: up = inexact;
            NEAREST_EVEN: up = over || (tie && is_odd);
            NEAREST_UP: up = over || (tie && !negative);
            NEAREST_DOWN: up = over || (tie && negative);
            NEAREST_AWAY: up = over || tie;
            NEAREST_TOWARD_ZERO: up = over;
            ODD: up = inexact && !is_odd;
            default: up = 1'b0;
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

// An edge function over a box: one stepper goes down the box's left side, the other along a row.
// The word at the box's corner takes the only multiplications, mod 2^M as everything else.
module edge_evaluator #(
    parameter int M = 6,                // bits of an edge word
    parameter int C = 17                 // bits of a pixel coordinate
) (
    input  logic         clk,
    input  logic         rst,
    input  logic [1:0]   op,             // 0 to the corner, 1 next sample, 2 next row, 3 hold
    input  logic [C-1:0] box_y_begin,    // corner of the box
    input  logic [C-1:0] box_x_begin,
    input  logic [M-1:0] edge_init,      // word at pixel (0, 0)
    input  logic [M-1:0] edge_dx,
    input  logic [M-1:0] edge_dy,
    output logic         in_v            // at the sample that op has reached
);
    localparam logic [1:0] CORNER = 2'd0, SAMPLE = 2'd1, ROW = 2'd2, HOLD = 2'd3;
    localparam logic [1:0] LOAD = 2'd0, STEP_X = 2'd1, STEP_Y = 2'd2;
    localparam int W = M + C;
    /* verilator lint_off UNUSED */
    wire [W-1:0] across = {{C{1'b0}}, edge_dx} * {{M{1'b0}}, box_x_begin};
    wire [W-1:0] down = {{C{1'b0}}, edge_dy} * {{M{1'b0}}, box_y_begin};
    wire [M-1:0] left;
    wire left_in;
    wire [M-1:0] e;
    /* verilator lint_on UNUSED */
    wire [M-1:0] corner = edge_init + across[M-1:0] + down[M-1:0];

    edge_stepper #(.M(M)) side (
        .clk(clk), .rst(rst), .op(op == CORNER ? LOAD : op == ROW ? STEP_Y : HOLD),
        .e0(corner), .ea(edge_dx), .eb(edge_dy), .e(left), .in_v(left_in)
    );
    edge_stepper #(.M(M)) run (
        .clk(clk), .rst(rst), .op(op == SAMPLE ? STEP_X : op == HOLD ? HOLD : LOAD),
        .e0(op == CORNER ? corner : left + edge_dy), .ea(edge_dx), .eb(edge_dy), .e(e), .in_v(in_v)
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
    input  logic [C-1:0]     box_y_begin, // corner of the box
    input  logic [C-1:0]     box_x_begin,
    input  logic [G+I+F-1:0] depth_init, // word at pixel (0, 0)
    input  logic [G+I+F-1:0] depth_dx,
    input  logic [G+I+F-1:0] depth_dy,
    output logic [I-1:0]     depth       // at the sample that op has reached
);
    localparam logic [1:0] CORNER = 2'd0, SAMPLE = 2'd1, ROW = 2'd2, HOLD = 2'd3;
    localparam logic [1:0] LOAD = 2'd0, STEP_X = 2'd1, STEP_Y = 2'd2;
    localparam int N = G + I + F;
    localparam int W = N + C;
    /* verilator lint_off UNUSED */
    wire [W-1:0] across = {{C{1'b0}}, depth_dx} * {{N{1'b0}}, box_x_begin};
    wire [W-1:0] down = {{C{1'b0}}, depth_dy} * {{N{1'b0}}, box_y_begin};
    wire [N-1:0] left;
    wire [I-1:0] left_out;
    wire [N-1:0] acc;
    /* verilator lint_on UNUSED */
    wire [N-1:0] corner = depth_init + across[N-1:0] + down[N-1:0];

    dda #(.G(G), .I(I), .F(F), .MODE(MODE)) side (
        .clk(clk), .rst(rst), .op(op == CORNER ? LOAD : op == ROW ? STEP_Y : HOLD),
        .init(corner), .dx(depth_dx), .dy(depth_dy), .acc(left), .out_v(left_out)
    );
    dda #(.G(G), .I(I), .F(F), .MODE(MODE)) run (
        .clk(clk), .rst(rst), .op(op == SAMPLE ? STEP_X : op == HOLD ? HOLD : LOAD),
        .init(op == CORNER ? corner : left + depth_dy), .dx(depth_dx), .dy(depth_dy), .acc(acc), .out_v(depth)
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
    input  logic [M-1:0]     edge0_init, edge0_dx, edge0_dy,
    input  logic [M-1:0]     edge1_init, edge1_dx, edge1_dy,
    input  logic [M-1:0]     edge2_init, edge2_dx, edge2_dy,
    input  logic [G+I+F-1:0] depth_init, depth_dx, depth_dy,
    input  logic             zero_area,
    input  logic [C-1:0]     box_y_begin, box_y_end, box_x_begin, box_x_end,   // half open
    // Maximal runs of covered samples, half open, in the order of y then x.
    output logic             span_valid,
    input  logic             span_ready,
    output logic [31:0]      span_test,
    output logic [C-1:0]     span_y, span_x_begin, span_x_end,
    // Covered samples.
    output logic             sample_valid,
    input  logic             sample_ready,
    output logic [31:0]      sample_test,
    output logic [C-1:0]     sample_y, sample_x,
    output logic [I-1:0]     sample_depth,
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
    edge_evaluator #(.M(M), .C(C)) edge_0 (.clk(clk), .rst(rst), .op(op), .box_y_begin(y), .box_x_begin(left), .edge_init(e[0]), .edge_dx(a[0]), .edge_dy(b[0]), .in_v(covers[0]));
    edge_evaluator #(.M(M), .C(C)) edge_1 (.clk(clk), .rst(rst), .op(op), .box_y_begin(y), .box_x_begin(left), .edge_init(e[1]), .edge_dx(a[1]), .edge_dy(b[1]), .in_v(covers[1]));
    edge_evaluator #(.M(M), .C(C)) edge_2 (.clk(clk), .rst(rst), .op(op), .box_y_begin(y), .box_x_begin(left), .edge_init(e[2]), .edge_dx(a[2]), .edge_dy(b[2]), .in_v(covers[2]));
    depth_evaluator #(.G(G), .I(I), .F(F), .MODE(MODE), .C(C)) plane (.clk(clk), .rst(rst), .op(op), .box_y_begin(y), .box_x_begin(left), .depth_init(start), .depth_dx(slope_x), .depth_dy(slope_y), .depth(sample_depth));

    wire at_end = x == right;
    wire covered = state == RUN && !at_end && covers == 3'b111;
    wire closes = state == RUN && in_run && !covered;
    wire stalled = (covered && !sample_ready) || (closes && !span_ready);
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
    assign span_x_begin = first;
    assign span_x_end = x;
    assign sample_valid = covered;
    assign sample_test = name;
    assign sample_y = y;
    assign sample_x = x;
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
                        e[0] <= edge0_init;
                        a[0] <= edge0_dx;
                        b[0] <= edge0_dy;
                        e[1] <= edge1_init;
                        a[1] <= edge1_dx;
                        b[1] <= edge1_dy;
                        e[2] <= edge2_init;
                        a[2] <= edge2_dx;
                        b[2] <= edge2_dy;
                        start <= depth_init;
                        slope_x <= depth_dx;
                        slope_y <= depth_dy;
                        nothing <= zero_area;
                        left <= box_x_begin;
                        right <= box_x_end;
                        bottom <= box_y_end;
                        x <= box_x_begin;
                        y <= box_y_begin;
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

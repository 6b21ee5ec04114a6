// tiny: reference of a triangle rasterizer, exact in every bit.
//
// Written by guardbit 0.1.0, model version 2, from the profile with the SHA-256
// e422b496a088c29229b4b9d785b19f2e2f17be4f2c3967712b8029d59c6bebbd.
// The same profile gives the same text. Clauses in brackets are those of guardbit's specification.
//
// A vertex counts sub-pixels of 1/2^1 pixel, from the corner of pixel (0, 0); y points down. Its depth is a
// code of 3 bits. The modules at the end can be synthesized, or be the other side of an equivalence
// proof. The self test is module tiny_reference_self_test.
/* verilator lint_off DECLFILENAME */
package tiny_reference;
    localparam int WIDTH = 4, HEIGHT = 4;      // the window, in pixels
    localparam int S = 1;                         // sub-pixel bits
    localparam int SAMPLE_X = 1, SAMPLE_Y = 1;  // the sample in its pixel, in sub-pixels
    localparam int LOW = 0, HIGH = 8;          // the range of a coordinate
    localparam int M = 6;                        // bits of an edge word
    localparam int SHIFT = 1;                    // low bits of an edge value that are not kept
    localparam int G = 1, I = 3, F = 3;           // guard, integer and interpolation bits
    localparam int N = G + I + F;
    localparam int D = 5;                        // bits of a coordinate, of a difference of two
    localparam int P = 2 * D + 2;                  // bits of a sum of products
    localparam int E = P > M + SHIFT ? P : M + SHIFT;
    localparam int Q = I + P + D + 5 + F + S;      // bits of a scaled numerator

    // A quotient, rounded: nearest-even (P-3, R-1). The divisor is positive.
    function automatic logic [N-1:0] divide(input logic signed [Q-1:0] numerator, input logic [P-1:0] divisor);
        /* verilator lint_off UNUSED */
        logic negative, inexact, over, tie, odd, up;
        logic [Q-1:0] magnitude, d, q, r;
        /* verilator lint_on UNUSED */
        begin
            negative = numerator < 0;
            magnitude = negative ? -numerator : numerator;
            d = Q'(divisor);
            q = magnitude / d;
            r = magnitude % d;
            inexact = r != 0;
            over = r > d - r;
            tie = r == d - r;
            odd = q[0];
            up = over || (tie && odd);
            q = q + {{(Q-1){1'b0}}, up};
            q = negative ? -q : q;
            divide = q[N-1:0];
        end
    endfunction

    // Edge words at the sample of pixel (0, 0): E >> SHIFT, less one first where the edge does not own
    // its samples (E-1 to E-4, C-2 to C-4).
    function automatic logic [M-1:0] edge_init(input logic signed [D-1:0] fx, fy, tx, ty);
        logic signed [D-1:0] ex, ey;
        logic owns;
        /* verilator lint_off UNUSED */
        logic signed [E-1:0] value;
        /* verilator lint_on UNUSED */
        begin
            ex = tx - fx;
            ey = ty - fy;
            owns = ey < 0 || (ey == 0 && ex > 0);
            value = E'(ex) * (E'(SAMPLE_Y) - E'(fy)) - E'(ey) * (E'(SAMPLE_X) - E'(fx)) - (owns ? E'(0) : E'(1));
            edge_init = value[SHIFT+M-1:SHIFT];
        end
    endfunction

    // What an edge word steps by.
    function automatic logic [M-1:0] edge_step(input logic signed [D-1:0] to, from);
        edge_step = (M'(to) - M'(from)) << (S - SHIFT);
    endfunction

    // Twice the area; its sign is the winding.
    function automatic logic signed [P-1:0] area2(input logic signed [D-1:0] x0, y0, x1, y1, x2, y2);
        area2 = (P'(x1) - P'(x0)) * (P'(y2) - P'(y0)) - (P'(x2) - P'(x0)) * (P'(y1) - P'(y0));
    endfunction

    // Numerators of the depth plane (P-2).
    function automatic logic signed [Q-1:0] slope_x(input logic signed [D-1:0] ya, yb, yc, input logic signed [I:0] za, zb, zc);
        slope_x = (Q'(zb) - Q'(za)) * (Q'(yc) - Q'(ya)) - (Q'(zc) - Q'(za)) * (Q'(yb) - Q'(ya));
    endfunction
    function automatic logic signed [Q-1:0] slope_y(input logic signed [D-1:0] xa, xb, xc, input logic signed [I:0] za, zb, zc);
        slope_y = (Q'(xb) - Q'(xa)) * (Q'(zc) - Q'(za)) - (Q'(xc) - Q'(xa)) * (Q'(zb) - Q'(za));
    endfunction
    function automatic logic signed [Q-1:0] start(input logic signed [D-1:0] xa, ya, input logic signed [I:0] za, input logic signed [P-1:0] area, input logic signed [Q-1:0] gx, gy);
        start = Q'(za) * Q'(area) + gx * (Q'(SAMPLE_X) - Q'(xa)) + gy * (Q'(SAMPLE_Y) - Q'(ya));
    endfunction

    // What is read out of an accumulator: guard (G-1 to G-5).
    /* verilator lint_off UNUSED */
    localparam logic [G+I:0] WHOLE = {{(G+I){1'b0}}, 1'b1} << I;
    function automatic logic [I-1:0] read_out(input logic [N-1:0] acc);
        logic [G+I:0] u;
        begin
            u = {1'b0, acc[N-1:F]};
            read_out = u[I-1:0];
            if (u >= WHOLE) read_out = u >= (WHOLE << G >> 1) + (WHOLE >> 1) ? {I{1'b0}} : {I{1'b1}};
        end
    endfunction
    /* verilator lint_on UNUSED */

    // An accumulator and an edge word after a clock edge (D-4, C-5). op: 0 load, 1 step by dx, 2 step by
    // dy, 3 hold.
    function automatic logic [N-1:0] dda_next(input logic [N-1:0] acc, input logic [1:0] op, input logic [N-1:0] init, dx, dy);
        dda_next = op == 2'd0 ? init : op == 2'd1 ? acc + dx : op == 2'd2 ? acc + dy : acc;
    endfunction
    function automatic logic [M-1:0] edge_next(input logic [M-1:0] word, input logic [1:0] op, input logic [M-1:0] init, dx, dy);
        edge_next = op == 2'd0 ? init : op == 2'd1 ? word + dx : op == 2'd2 ? word + dy : word;
    endfunction

    // The words at the sample of a pixel; inside is a clear sign bit (C-5, P-2).
    /* verilator lint_off UNUSED */
    function automatic logic [M-1:0] edge_at(input logic [M-1:0] init, dx, dy, input logic [16:0] x, y);
        edge_at = M'(init + M'(x) * dx + M'(y) * dy);
    endfunction
    function automatic logic [N-1:0] depth_at(input logic [N-1:0] init, dx, dy, input logic [16:0] x, y);
        depth_at = N'(init + N'(x) * dx + N'(y) * dy);
    endfunction
    /* verilator lint_on UNUSED */

    // The pixels of the window whose samples lie between the extremes of three coordinates (C-7): the
    // first, and the one after the last.
    function automatic int clamped(input int value, low, high);
        clamped = value < low ? low : value > high ? high : value;
    endfunction
    function automatic int least(input int a, b);
        least = a < b ? a : b;
    endfunction
    function automatic int first_pixel(input int a, b, c, sample, size);
        first_pixel = clamped(-((sample - least(a, least(b, c))) >>> S), 0, size);
    endfunction
    function automatic int end_pixel(input int a, b, c, sample, size);
        end_pixel = clamped(((-least(-a, least(-b, -c)) - sample) >>> S) + 1, first_pixel(a, b, c, sample, size), size);
    endfunction
endpackage

// A depth DDA with its read-out.
module tiny_reference_dda #(parameter int N = tiny_reference::N, I = tiny_reference::I) (
    input  logic         clk, rst,
    input  logic [1:0]   op,
    input  logic [N-1:0] init, dx, dy,
    output logic [N-1:0] acc,
    output logic [I-1:0] out_v
);
    always_ff @(posedge clk) acc <= rst ? {N{1'b0}} : tiny_reference::dda_next(acc, op, init, dx, dy);
    assign out_v = tiny_reference::read_out(acc);
endmodule

// An edge stepper.
module tiny_reference_edge_stepper #(parameter int M = tiny_reference::M) (
    input  logic         clk, rst,
    input  logic [1:0]   op,
    input  logic [M-1:0] e0, ea, eb,
    output logic [M-1:0] e,
    output logic         in_v
);
    always_ff @(posedge clk) e <= rst ? {M{1'b0}} : tiny_reference::edge_next(e, op, e0, ea, eb);
    assign in_v = !e[M-1];
endmodule

// The read-out of a depth accumulator.
module tiny_reference_read_out #(parameter int N = tiny_reference::N, I = tiny_reference::I) (
    input  logic [N-1:0] acc,
    output logic [I-1:0] out_v
);
    assign out_v = tiny_reference::read_out(acc);
endmodule

// An edge function and a depth plane over a box (C-5, P-2). op: 0 to the corner, 1 next sample, 2 next row, 3 hold.
module tiny_reference_edge_evaluator #(parameter int M = tiny_reference::M) (
    input  logic         clk, rst,
    input  logic [1:0]   op,
    input  logic [16:0]  box_x_begin, box_y_begin,
    input  logic [M-1:0] edge_init, edge_dx, edge_dy,
    output logic         in_v
);
    logic [M-1:0] left, word;
    wire [M-1:0] row = op == 2'd0 ? tiny_reference::edge_at(edge_init, edge_dx, edge_dy, box_x_begin, box_y_begin) : left + edge_dy;
    always_ff @(posedge clk) begin
        left <= rst ? {M{1'b0}} : op == 2'd0 || op == 2'd2 ? row : left;
        word <= rst ? {M{1'b0}} : op == 2'd1 ? word + edge_dx : op == 2'd3 ? word : row;
    end
    assign in_v = !word[M-1];
endmodule
module tiny_reference_depth_evaluator #(parameter int N = tiny_reference::N, I = tiny_reference::I) (
    input  logic         clk, rst,
    input  logic [1:0]   op,
    input  logic [16:0]  box_x_begin, box_y_begin,
    input  logic [N-1:0] depth_init, depth_dx, depth_dy,
    output logic [I-1:0] depth
);
    logic [N-1:0] left, word;
    wire [N-1:0] row = op == 2'd0 ? tiny_reference::depth_at(depth_init, depth_dx, depth_dy, box_x_begin, box_y_begin) : left + depth_dy;
    always_ff @(posedge clk) begin
        left <= rst ? {N{1'b0}} : op == 2'd0 || op == 2'd2 ? row : left;
        word <= rst ? {N{1'b0}} : op == 2'd1 ? word + depth_dx : op == 2'd3 ? word : row;
    end
    assign depth = tiny_reference::read_out(word);
endmodule

// The set-up (T-3, E, P), without a clock; all words are zero where there is no area.
module tiny_reference_setup #(
    parameter int D = tiny_reference::D, M = tiny_reference::M, N = tiny_reference::N, I = tiny_reference::I, P = tiny_reference::P, Q = tiny_reference::Q, F = tiny_reference::F, S = tiny_reference::S
) (
    input  logic signed [D-1:0] v0_x, v0_y, v1_x, v1_y, v2_x, v2_y,
    input  logic [I-1:0] v0_z, v1_z, v2_z,
    output logic [M-1:0] edge0_init, edge0_dx, edge0_dy,
    output logic [M-1:0] edge1_init, edge1_dx, edge1_dy,
    output logic [M-1:0] edge2_init, edge2_dx, edge2_dy,
    output logic [N-1:0] depth_init, depth_dx, depth_dy,
    output logic         zero_area
);
    wire signed [P-1:0] signed_area = tiny_reference::area2(v0_x, v0_y, v1_x, v1_y, v2_x, v2_y);
    wire turned = signed_area < 0;
    wire signed [P-1:0] area = turned ? -signed_area : signed_area;
    assign zero_area = signed_area == 0;
    wire signed [D-1:0] xb = turned ? v2_x : v1_x, yb = turned ? v2_y : v1_y;
    wire signed [D-1:0] xc = turned ? v1_x : v2_x, yc = turned ? v1_y : v2_y;
    wire signed [I:0] za = {1'b0, v0_z};
    wire signed [I:0] zb = {1'b0, turned ? v2_z : v1_z};
    wire signed [I:0] zc = {1'b0, turned ? v1_z : v2_z};
    wire signed [Q-1:0] gx = tiny_reference::slope_x(v0_y, yb, yc, za, zb, zc);
    wire signed [Q-1:0] gy = tiny_reference::slope_y(v0_x, xb, xc, za, zb, zc);
    wire signed [Q-1:0] gz = tiny_reference::start(v0_x, v0_y, za, area, gx, gy);
    wire [P-1:0] divisor = zero_area ? {{(P-1){1'b0}}, 1'b1} : area;
    wire [M-1:0] live = {M{!zero_area}};
    assign edge0_init = tiny_reference::edge_init(v0_x, v0_y, xb, yb) & live;
    assign edge0_dx = tiny_reference::edge_step(v0_y, yb) & live;
    assign edge0_dy = tiny_reference::edge_step(xb, v0_x) & live;
    assign edge1_init = tiny_reference::edge_init(xb, yb, xc, yc) & live;
    assign edge1_dx = tiny_reference::edge_step(yb, yc) & live;
    assign edge1_dy = tiny_reference::edge_step(xc, xb) & live;
    assign edge2_init = tiny_reference::edge_init(xc, yc, v0_x, v0_y) & live;
    assign edge2_dx = tiny_reference::edge_step(yc, v0_y) & live;
    assign edge2_dy = tiny_reference::edge_step(v0_x, xc) & live;
    assign depth_init = (tiny_reference::divide(gz <<< F, divisor) + N'(0)) & {N{!zero_area}};
    assign depth_dx = tiny_reference::divide(gx <<< (F + S), divisor) & {N{!zero_area}};
    assign depth_dy = tiny_reference::divide(gy <<< (F + S), divisor) & {N{!zero_area}};
endmodule

// A triangle at the sample of a pixel of its box.
module tiny_reference_sample #(parameter int M = tiny_reference::M, N = tiny_reference::N, I = tiny_reference::I) (
    input  logic [M-1:0] edge0_init, edge0_dx, edge0_dy,
    input  logic [M-1:0] edge1_init, edge1_dx, edge1_dy,
    input  logic [M-1:0] edge2_init, edge2_dx, edge2_dy,
    input  logic [N-1:0] depth_init, depth_dx, depth_dy,
    input  logic         zero_area,
    input  logic [16:0]  x, y,
    output logic         covered,
    output logic [I-1:0] depth
);
    /* verilator lint_off UNUSED */
    wire [M-1:0] any = tiny_reference::edge_at(edge0_init, edge0_dx, edge0_dy, x, y) | tiny_reference::edge_at(edge1_init, edge1_dx, edge1_dy, x, y)
        | tiny_reference::edge_at(edge2_init, edge2_dx, edge2_dy, x, y);
    /* verilator lint_on UNUSED */
    assign covered = !zero_area && !any[M-1];
    assign depth = tiny_reference::read_out(tiny_reference::depth_at(depth_init, depth_dx, depth_dy, x, y));
endmodule

`ifndef SYNTHESIS
`ifndef FORMAL
/* verilator lint_off WIDTH */
/* verilator lint_off UNUSED */
// Digests of random cases, by unit, against those of guardbit. +seed=N +cases=N prints those of other cases.
module tiny_reference_self_test import tiny_reference::*; ();
    logic [63:0] state, digest [0:3], expected [0:3];
    int seed, cases, wrong;

    function automatic logic [63:0] random(input int unused);
        state = state * 64'd6364136223846793005 + 64'd1442695040888963407;
        random = state >> 33;
    endfunction
    function automatic logic [63:0] below(input logic [63:0] count);
        logic [63:0] high, low;
        begin
            high = random(0);
            low = random(0);
            below = (high << 31 | low) % count;
        end
    endfunction
    function automatic logic [127:0] word(input int unused);
        logic [63:0] next;
        begin
            word = 0;
            for (int k = 0; k < 5; k++) begin
                next = random(0);
                word = word << 31 | {64'd0, next};
            end
        end
    endfunction
    task automatic fold(input int unit, input logic [127:0] value, input int width);
        digest[unit] = (digest[unit] ^ value[63:0]) * 64'h100000001b3;
        if (width > 64) digest[unit] = (digest[unit] ^ value[127:64]) * 64'h100000001b3;
    endtask
    function automatic int coordinate(input int kind, size, near, first);
        int unit, reach, at;
        logic [63:0] drawn;
        begin
            unit = kind == 2 && S > 0 ? (1 << S) / 2 : 1;
            reach = (4 << S) / unit;
            if (kind == 0 || kind == 3) begin
                drawn = below(HIGH - LOW + 1);
                coordinate = LOW + $signed(drawn[31:0]);
            end else begin
                drawn = below(first != 0 ? (size << S) / unit + 1 : 2 * reach + 1);
                at = first != 0 ? $signed(drawn[31:0]) * unit : near + ($signed(drawn[31:0]) - reach) * unit;
                coordinate = tiny_reference::clamped(at, LOW, HIGH);
            end
        end
    endfunction

    logic [1:0] op, edge_op;
    logic [N-1:0] acc, init, dx, dy;
    logic [M-1:0] e, e0, ea, eb;
    logic [127:0] drawn;
    logic signed [D-1:0] vx [0:2], vy [0:2];
    logic [I-1:0] vz [0:2];
    logic [M-1:0] w [0:8];
    logic [N-1:0] d [0:2];
    logic zero_area, covered;
    logic [I-1:0] depth;
    logic [16:0] x, y;
    tiny_reference_setup set_up (.v0_x(vx[0]), .v0_y(vy[0]), .v1_x(vx[1]), .v1_y(vy[1]), .v2_x(vx[2]), .v2_y(vy[2]),
        .v0_z(vz[0]), .v1_z(vz[1]), .v2_z(vz[2]),
        .edge0_init(w[0]), .edge0_dx(w[1]), .edge0_dy(w[2]), .edge1_init(w[3]), .edge1_dx(w[4]), .edge1_dy(w[5]),
        .edge2_init(w[6]), .edge2_dx(w[7]), .edge2_dy(w[8]),
        .depth_init(d[0]), .depth_dx(d[1]), .depth_dy(d[2]), .zero_area(zero_area));
    tiny_reference_sample sample (.edge0_init(w[0]), .edge0_dx(w[1]), .edge0_dy(w[2]), .edge1_init(w[3]), .edge1_dx(w[4]), .edge1_dy(w[5]),
        .edge2_init(w[6]), .edge2_dx(w[7]), .edge2_dy(w[8]),
        .depth_init(d[0]), .depth_dx(d[1]), .depth_dy(d[2]), .zero_area(zero_area), .x(x), .y(y), .covered(covered), .depth(depth));

    int x0, x1, y0, y1, kind, count;
    logic [63:0] column [0:15], z [0:15];
    initial begin
        if (!$value$plusargs("seed=%d", seed)) seed = 1;
        if (!$value$plusargs("cases=%d", cases)) cases = 1000;
        expected[0] = 64'h61e3ec3a046a2a69; expected[1] = 64'h21f48d7b3147fcd3; expected[2] = 64'h8c8bb1c5936f541c; expected[3] = 64'h213436e79c369b09;
        state = {32'd0, seed};
        for (int k = 0; k < 4; k++) digest[k] = 64'hcbf29ce484222325;
        acc = 0;
        e = 0;
        for (int n = 0; n < cases; n++) begin
            kind = n % 4;
            drawn = {64'd0, random(0)};
            op = drawn[1:0];
            drawn = {64'd0, random(0)};
            edge_op = drawn[1:0];
            drawn = word(0); init = drawn[N-1:0];
            drawn = word(0); dx = drawn[N-1:0];
            drawn = word(0); dy = drawn[N-1:0];
            acc = tiny_reference::dda_next(acc, op, init, dx, dy);
            fold(0, acc, N);
            fold(0, tiny_reference::read_out(acc), I);
            drawn = word(0); e0 = drawn[M-1:0];
            drawn = word(0); ea = drawn[M-1:0];
            drawn = word(0); eb = drawn[M-1:0];
            e = tiny_reference::edge_next(e, edge_op, e0, ea, eb);
            fold(1, e, M);
            fold(1, !e[M-1], 1);
            for (int k = 0; k < 3; k++) begin
                vx[k] = coordinate(kind, WIDTH, vx[0], k == 0 ? 1 : 0);
                vy[k] = coordinate(kind, HEIGHT, vy[0], k == 0 ? 1 : 0);
                drawn = word(0);
                vz[k] = kind == 3 ? {I{drawn[0]}} : drawn[I-1:0];
            end
            #1;
            for (int k = 0; k < 9; k++) fold(2, w[k], M);
            for (int k = 0; k < 3; k++) fold(2, d[k], N);
            fold(2, zero_area, 1);
            x0 = tiny_reference::first_pixel(vx[0], vx[1], vx[2], SAMPLE_X, WIDTH);
            x1 = tiny_reference::end_pixel(vx[0], vx[1], vx[2], SAMPLE_X, WIDTH);
            y0 = tiny_reference::first_pixel(vy[0], vy[1], vy[2], SAMPLE_Y, HEIGHT);
            y1 = tiny_reference::end_pixel(vy[0], vy[1], vy[2], SAMPLE_Y, HEIGHT);
            fold(2, x0, 64);
            fold(2, y0, 64);
            fold(2, x1, 64);
            fold(2, y1, 64);
            for (int k = 0; k < 4; k++) begin
                drawn = {64'd0, below(WIDTH)};
                x = drawn[16:0];
                drawn = {64'd0, below(HEIGHT)};
                y = drawn[16:0];
                #1;
                fold(3, covered, 1);
                fold(3, depth, I);
            end
            // A small triangle is drawn.
            if (kind == 1 || kind == 2)
                for (int row = y0; row < y1; row++) begin
                    count = 0;
                    for (int at = x0; at < x1; at++) begin
                        x = 17'(at);
                        y = 17'(row);
                        #1;
                        if (covered) begin
                            column[count] = at;
                            z[count] = depth;
                            count = count + 1;
                        end
                    end
                    fold(3, count, 64);
                    for (int k = 0; k < count; k++) begin
                        fold(3, column[k], 64);
                        fold(3, z[k], I);
                    end
                end
        end
        if (seed != 1 || cases != 1000)
            for (int k = 0; k < 4; k++) $display("%h", digest[k]);
        else begin
            wrong = 0;
            for (int k = 0; k < 4; k++)
                if (digest[k] != expected[k]) wrong = wrong | (1 << k);
            $display("tiny: %s", wrong == 0 ? "PASS, 1000 cases" : "FAIL");
            if ((wrong & 1) != 0) $display("the DDA differs");
            if ((wrong & 2) != 0) $display("the edge stepper differs");
            if ((wrong & 4) != 0) $display("the set-up differs");
            if ((wrong & 8) != 0) $display("the samples differ");
        end
        $finish;
    end
endmodule
`endif
`endif

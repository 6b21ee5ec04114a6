// An engine of whole pixels: three vertices with five values each and a clip rectangle in; each pixel with
// its values out, in the order of drawing. The planes of the values go through one vertex, the anchor; the
// halves of the triangle are walked away from it. One pixel a clock. Spec: registers RG-8 to RG-10, RG-20.
module anchored_engine #(
    parameter int SORTED = 0,            // 0: the anchor is looked for among the vertices as given, 1: sorted
    parameter int FIRST_MATCH = 0,       // 0: vertices of one y stay as given, 1: first order that matches
    parameter int UPPER_FIRST = 0,       // 0: the anchor says which half comes first, 1: always the upper
    parameter int LARGEST_X = 1023,      // columns of the longest edge that is drawn
    parameter int LARGEST_Y = 511        // rows of it
) (
    input  logic        clk,
    input  logic        rst,
    input  logic        in_valid,
    output logic        in_ready,
    input  logic [31:0] test,
    // Words are registers of 32 bits; the bits above a field are not wired.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [31:0] x0, y0, u0, v0, r0, g0, b0,
    input  logic [31:0] x1, y1, u1, v1, r1, g1, b1,
    input  logic [31:0] x2, y2, u2, v2, r2, g2, b2,
    input  logic [31:0] left, top, right, bottom,                     // closed, without sign
    /* verilator lint_on UNUSEDSIGNAL */
    output logic        p_valid,
    input  logic        p_ready,
    output logic [31:0] p_test, p_x, p_y, p_r_g_b, p_u, p_v
);
    typedef enum logic [2:0] {IDLE, ORDER, LIMITS, DIVIDE, ROW, DRAW} state_t;
    localparam logic [3:0] LAST_SIDE = 4'd3, LAST_PLANE = 4'd13;

    state_t state;
    logic [31:0] name;
    logic signed [11:0] low_x, low_y, high_x, high_y;
    logic [61:0] a, b, c;                // vertices, later from top to bottom: x, y, then u v r g b upward
    logic [1:0] anchor;                  // its place from the top
    logic lower, more;                   // which half is walked, and whether the other one follows
    logic known;                         // the slopes of the planes are there

    wire takes = state == IDLE && in_valid;

    // Order. Both sorts try the same orders, but 0 1 2 is the first of one and the last of the other.
    wire signed [11:0] ax = {a[10], a[10:0]}, ay = {a[21], a[21:11]};
    wire signed [11:0] bx = {b[10], b[10:0]}, by = {b[21], b[21:11]};
    wire signed [11:0] cx = {c[10], c[10:0]}, cy = {c[21], c[21:11]};
    logic [5:0] order;                   // numbers of the vertices, the top one in the low bits
    always_comb
        if (FIRST_MATCH == 0 && ay <= by && by <= cy) order = {2'd2, 2'd1, 2'd0};
        else if (ay <= cy && cy <= by) order = {2'd1, 2'd2, 2'd0};
        else if (by <= ay && ay <= cy) order = {2'd2, 2'd0, 2'd1};
        else if (by <= cy && cy <= ay) order = {2'd0, 2'd2, 2'd1};
        else if (cy <= ay && ay <= by) order = {2'd1, 2'd0, 2'd2};
        else if (cy <= by && by <= ay) order = {2'd0, 2'd1, 2'd2};
        else order = {2'd2, 2'd1, 2'd0};

    function automatic logic [61:0] pick(input logic [1:0] number, input logic [61:0] p, q, r);
        pick = number == 2'd0 ? p : number == 2'd1 ? q : r;
    endfunction
    wire [61:0] upmost = pick(order[1:0], a, b, c);
    wire [61:0] middle = pick(order[3:2], a, b, c);
    wire [61:0] lowest = pick(order[5:4], a, b, c);

    function automatic logic [1:0] leftmost(input logic signed [10:0] p, q, r);
        leftmost = q <= p ? (r <= q ? 2'd2 : 2'd1) : (r < p ? 2'd2 : 2'd0);
    endfunction
    wire [1:0] of_given = leftmost(a[10:0], b[10:0], c[10:0]);
    wire [1:0] of_sorted = leftmost(upmost[10:0], middle[10:0], lowest[10:0]);
    wire [1:0] place = of_given == order[1:0] ? 2'd0 : of_given == order[3:2] ? 2'd1 : 2'd2;

    // Edges of the sorted triangle.
    wire signed [11:0] abx = bx - ax, bcx = cx - bx, acx = cx - ax;
    wire signed [11:0] aby = by - ay, bcy = cy - by, acy = cy - ay;
    function automatic logic signed [23:0] turn(input logic signed [11:0] p, q, r, s);
        turn = 24'(p) * 24'(q) - 24'(r) * 24'(s);
    endfunction
    function automatic logic exceeds(input logic signed [11:0] length, input int limit);
        exceeds = 32'(length) > limit || 32'(length) < -limit;
    endfunction
    wire signed [23:0] doubled = turn(abx, bcy, bcx, aby);
    logic signed [23:0] area;            // doubled; above 0 if the long side is the left one
    wire refused = doubled == 0 || exceeds(abx, LARGEST_X) || exceeds(bcx, LARGEST_X) || exceeds(acx, LARGEST_X)
        || exceeds(acy, LARGEST_Y);
    wire from_lower = aby == 0 || (bcy != 0 && UPPER_FIRST == 0 && anchor != 2'd0);

    // The half that is walked: its short side, and the end at which it starts.
    wire up = lower ? anchor == 2'd2 : anchor != 2'd0;
    wire signed [11:0] short_dx = lower ? bcx : abx;
    wire signed [11:0] height = lower ? bcy : aby;
    wire signed [11:0] start_x = lower == up ? (up ? cx : ax) : bx;
    wire signed [11:0] start_y = lower == up ? (up ? cy : ay) : by;
    wire signed [11:0] below_top = start_y - ay;

    // All divisions share one divider. It works in one clock here; hardware would take a bit a clock.
    // A side divides its change against the walk; 2^12 on top keeps that positive, so that the division is
    // a floor, and falls out of the 12 bits that are kept. A plane divides towards zero.
    logic [3:0] step;
    logic signed [35:0] dividend, divisor;
    wire [19:0] whole = 20'(dividend / divisor);
    wire [10:0] rest = 11'(dividend % divisor);
    wire signed [11:0] side_dx = step == 4'd1 ? acx : short_dx;
    wire signed [11:0] side_height = step == 4'd2 ? height : acy;
    wire signed [23:0] change = step == 4'd0 ? -(24'(acx) * 24'(below_top)) : up ? 24'(side_dx) : -(24'(side_dx));
    wire [3:0] plane = step - LAST_SIDE;
    wire [5:0] value = 6'd22 + {plane[3:1], 3'd0};
    wire signed [11:0] ab_value = {4'd0, b[value +: 8]} - {4'd0, a[value +: 8]};
    wire signed [11:0] bc_value = {4'd0, c[value +: 8]} - {4'd0, b[value +: 8]};
    wire signed [23:0] rise = plane[0] ? turn(abx, bc_value, bcx, ab_value) : turn(ab_value, bcy, bc_value, aby);

    // A side: the first pixel at or right of it, and how far right, in parts of its height.
    logic [22:0] long_side, long_step, short_side, short_step;
    function automatic logic [22:0] walked(input logic [22:0] side, pace, input logic [11:0] parts);
        logic [11:0] distance;
        distance = {1'b0, side[10:0]} + {1'b0, pace[10:0]};
        if (distance >= parts) walked = {side[22:11] - pace[22:11] - 12'd1, side[10:0] + pace[10:0] - parts[10:0]};
        else walked = {side[22:11] - pace[22:11], distance[10:0]};
    endfunction
    wire [22:0] next_long = walked(long_side, long_step, acy);
    wire [22:0] next_short = walked(short_side, short_step, height);

    // A row. Upward, it lies between the walk's place and the next one, so its ends are those of the next.
    logic signed [11:0] y;
    logic [11:0] rows;
    wire signed [11:0] next_y = up ? y - 12'sd1 : y + 12'sd1;
    wire signed [11:0] here = up ? next_y : y;
    wire signed [11:0] long_end = up ? next_long[22:11] : long_side[22:11];
    wire signed [11:0] short_end = up ? next_short[22:11] : short_side[22:11];
    wire signed [11:0] begins = area > 0 ? long_end : short_end;
    wire signed [11:0] ends = (area > 0 ? short_end : long_end) - 12'sd1;
    wire signed [11:0] first = begins < low_x ? low_x : begins;
    wire signed [11:0] last = ends > high_x ? high_x : ends;
    wire draws = here >= low_y && here <= high_y && first <= last;

    // Planes: of each value, its slopes along x (low bits) and y, and its accumulator.
    logic [199:0] slopes;
    logic [99:0] acc;
    wire [61:0] through = pick(anchor, a, b, c);
    wire signed [11:0] from_x = first - $signed({through[10], through[10:0]});
    wire signed [11:0] from_y = here - $signed({through[21], through[21:11]});
    wire [19:0] columns = {{8{from_x[11]}}, from_x};
    wire [19:0] lines = {{8{from_y[11]}}, from_y};
    logic signed [11:0] x, drawn_y, drawn_end;
    genvar k;
    generate
        for (k = 0; k < 5; k = k + 1) begin : planes
            wire [19:0] dx = slopes[40*k +: 20], dy = slopes[40*k + 20 +: 20];
            always_ff @(posedge clk)
                if (state == ROW && draws)
                    acc[20*k +: 20] <= {through[22 + 8*k +: 8], 12'h800} + dx * columns + dy * lines;
                else if (state == DRAW && p_ready) acc[20*k +: 20] <= acc[20*k +: 20] + dx;
        end
    endgenerate

    assign in_ready = state == IDLE;
    assign p_valid = state == DRAW;
    assign p_test = name;
    assign p_x = 32'(x);
    assign p_y = 32'(drawn_y);
    assign p_r_g_b = {8'd0, acc[59:52], acc[79:72], acc[99:92]};
    assign p_u = {24'd0, acc[19:12]};
    assign p_v = {24'd0, acc[39:32]};

    always_ff @(posedge clk)
        if (rst) state <= IDLE;
        else case (state)
            IDLE: if (takes) begin
                state <= ORDER;
                name <= test;
                a <= {b0[7:0], g0[7:0], r0[7:0], v0[7:0], u0[7:0], y0[10:0], x0[10:0]};
                b <= {b1[7:0], g1[7:0], r1[7:0], v1[7:0], u1[7:0], y1[10:0], x1[10:0]};
                c <= {b2[7:0], g2[7:0], r2[7:0], v2[7:0], u2[7:0], y2[10:0], x2[10:0]};
                {low_x, low_y} <= {1'b0, left[10:0], 1'b0, top[10:0]};
                {high_x, high_y} <= {1'b0, right[10:0], 1'b0, bottom[10:0]};
            end
            ORDER: begin
                state <= LIMITS;
                {a, b, c} <= {upmost, middle, lowest};
                anchor <= SORTED != 0 ? of_sorted : place;
            end
            LIMITS: begin
                state <= refused ? IDLE : DIVIDE;
                area <= doubled;
                lower <= from_lower;
                more <= aby != 0 && bcy != 0;
                known <= 1'b0;
                step <= 4'd0;
            end
            DIVIDE: begin                // gives the divider one division, and keeps the result of the one before
                step <= step + 4'd1;
                dividend <= step < LAST_SIDE ? 36'(change) + (36'(side_height) << 12) : 36'(rise) << 12;
                divisor <= step < LAST_SIDE ? 36'(side_height) : 36'(area);
                case (step)
                    4'd0: {short_side, y, rows} <= {start_x, 11'd0, start_y, height};
                    4'd1: long_side <= {ax - whole[11:0], rest};
                    4'd2: long_step <= {whole[11:0], rest};
                    LAST_SIDE: short_step <= {whole[11:0], rest};
                    default: slopes <= {whole, slopes[199:20]};
                endcase
                // The second half has the planes of the first.
                if (step == (known ? LAST_SIDE : LAST_PLANE)) begin
                    known <= 1'b1;
                    state <= ROW;
                end
            end
            ROW: if (rows == 12'd0) begin
                state <= more ? DIVIDE : IDLE;
                {lower, more, step} <= {!lower, 1'b0, 4'd0};
            end
            else begin
                {long_side, short_side, y} <= {next_long, next_short, next_y};
                rows <= rows - 12'd1;
                {x, drawn_end, drawn_y} <= {first, last, here};
                if (draws) state <= DRAW;
            end
            DRAW: if (p_ready) begin
                x <= x + 12'sd1;
                if (x == drawn_end) state <= ROW;
            end
            default: state <= IDLE;
        endcase
endmodule

// An engine of divided edge slopes: three vertices, starts and slopes of eight channels in; each drawn pixel
// out with its channels and depth, row by row downward, from the long side on. Three clocks for the slopes
// of the edges, one for each row, and one for each pixel. Spec: registers RG-11, RG-13 (plane at-vertex),
// RG-14, RG-20.
module divided_slope_engine (
    input  logic        clk,
    input  logic        rst,
    input  logic        in_valid,
    output logic        in_ready,
    input  logic [31:0] test,
    // Words are registers of 32 bits; the bits above a field are not wired.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [31:0] xa, ya, xb, yb, xc, yc,                              // in sub-pixels
    input  logic [31:0] r, g, b, a, z, s, t, w,
    input  logic [31:0] r_dx, g_dx, b_dx, a_dx, z_dx, s_dx, t_dx, w_dx,
    input  logic [31:0] r_dy, g_dy, b_dy, a_dy, z_dy, s_dy, t_dy, w_dy,
    input  logic [31:0] leftward, flip_depth_biased_w_buffer_clip,
    input  logic [31:0] clip_left, clip_right, clip_top, clip_bottom,        // half open
    input  logic [31:0] depth_bias, adjust, height,
    /* verilator lint_on UNUSEDSIGNAL */
    output logic        p_valid,
    input  logic        p_ready,
    output logic [31:0] p_test, p_y_x, p_a_b_g_r, p_z_w_float, p_depth, p_s, p_s_32, p_t, p_t_32
);
    localparam int F = 16;               // fraction bits of an x
    localparam int S = 4;                // sub-pixel bits of a vertex
    localparam logic [31:0] BIAS = 32'd28672;
    localparam logic signed [16:0] ROW_BIAS = 17'sd7;
    localparam logic [S-1:0] HALF = S'(1 << (S - 1));
    localparam int CHANNELS = 8;         // r g b a z in words of 32 bits, s t w in words of 64 bits
    localparam int BITS = 5 * 32 + 3 * 64;

    logic busy, drawing;                 // drawing: a pixel is raised; else the next row is looked at
    logic [1:0] side;                    // the edge that is divided: AC, AB, BC; then none
    logic [31:0] name;
    logic leftwards, flips, biases, by_w, clips, adjusts;
    logic signed [32:0] low_x, high_x, low_y, high_y;   // never negative
    logic signed [15:0] a_x, a_y, b_x, b_y, c_x, c_y, bias;
    logic [15:0] rows_of_window;
    logic signed [31:0] slope_ac, slope_ab, slope_bc;
    logic signed [12:0] line;            // the next row
    logic [15:0] column, last, row;      // the pixel drawn, and the last one of its row

    wire takes = !busy && in_valid;
    wire divides = busy && side != 2'd3;
    wire looks = busy && side == 2'd3 && !drawing;
    wire moves = drawing && p_ready;

    // One divider for three edges. The quotient comes in one clock here; hardware would take a bit a clock.
    wire signed [15:0] from_x = side == 2'd2 ? b_x : a_x;
    wire signed [15:0] from_y = side == 2'd2 ? b_y : a_y;
    wire signed [15:0] to_x = side == 2'd1 ? b_x : c_x;
    wire signed [15:0] to_y = side == 2'd1 ? b_y : c_y;
    wire signed [15:0] columns = to_x - from_x;          // its upper bit leaves the word of 32 bits
    wire signed [32:0] numerator = 33'(columns) <<< F;
    wire signed [32:0] lines = 33'(to_y) - 33'(from_y);
    wire [31:0] slope = 32'(lines == 0 ? 33'sd0 : numerator / lines);

    // Both ends of the row, anew in each row from the first vertex of their edge.
    wire signed [31:0] centre = (32'(line) <<< S) + 32'(HALF);
    wire upper = centre < 32'(b_y);
    wire signed [31:0] short_slope = upper ? slope_ab : slope_bc;
    wire signed [15:0] short_from_x = upper ? a_x : b_x;
    wire signed [15:0] short_from_y = upper ? a_y : b_y;
    wire signed [31:0] long_product = slope_ac * (centre - 32'(a_y));
    wire signed [31:0] short_product = short_slope * (centre - 32'(short_from_y));
    wire signed [31:0] first_x = 32'(a_x) <<< (F - S);
    wire signed [31:0] long_x = first_x + (long_product >>> S);
    wire signed [31:0] short_x = (32'(short_from_x) <<< (F - S)) + (short_product >>> S);

    // The row holds the pixels from left to before right; the clip rectangle takes some of them away.
    wire signed [31:0] first_end = first_x + BIAS;
    wire signed [31:0] left_end = (leftwards ? short_x : long_x) + BIAS;
    wire signed [31:0] right_end = (leftwards ? long_x : short_x) + BIAS;
    wire signed [32:0] left = 33'(left_end) >>> F;
    wire signed [32:0] right = 33'(right_end) >>> F;
    wire signed [32:0] low = clips && low_x > left ? low_x : left;
    wire signed [32:0] past = clips && high_x < right ? high_x : right;
    wire signed [32:0] high = past - 1;
    wire holds = low <= high && !(clips && (33'(line) < low_y || 33'(line) >= high_y));
    wire signed [12:0] first_line = 13'((17'(a_y) + ROW_BIAS) >>> S);
    wire signed [12:0] end_line = 13'((17'(c_y) + ROW_BIAS) >>> S);
    wire ends = line >= end_line;
    wire signed [32:0] begins = leftwards ? high : low;
    wire signed [63:0] distance = 64'(begins) - (64'(first_end) >>> F);

    // From the first vertex to the next centre of a pixel. The pixel that is added where the fraction is more
    // than half a pixel is the bit that this word drops.
    wire [S-1:0] part_x = HALF - a_x[S-1:0];
    wire [S-1:0] part_y = HALF - a_y[S-1:0];

    // A colour has 24 bits: zeros above a start, the sign above a slope. s, t and 1/w have bits below a register.
    wire [BITS-1:0] starts = {64'($signed(w)) << 2, 64'($signed(t)) << 14, 64'($signed(s)) << 14, z,
        32'(a[23:0]), 32'(b[23:0]), 32'(g[23:0]), 32'(r[23:0])};
    wire [BITS-1:0] along = {64'($signed(w_dx)) << 2, 64'($signed(t_dx)) << 14, 64'($signed(s_dx)) << 14, z_dx,
        32'($signed(a_dx[23:0])), 32'($signed(b_dx[23:0])), 32'($signed(g_dx[23:0])), 32'($signed(r_dx[23:0]))};
    wire [BITS-1:0] down = {64'($signed(w_dy)) << 2, 64'($signed(t_dy)) << 14, 64'($signed(s_dy)) << 14, z_dy,
        32'($signed(a_dy[23:0])), 32'($signed(b_dy[23:0])), 32'($signed(g_dy[23:0])), 32'($signed(r_dy[23:0]))};
    genvar k;
    generate
        for (k = 0; k < CHANNELS; k = k + 1) begin : channels
            localparam int W = k < 5 ? 32 : 64;
            localparam int PLACE = k < 5 ? 32 * k : 64 * k - 5 * 32;
            logic signed [W-1:0] dx, dy, line_start, here;
            wire signed [W-1:0] product = W'(part_x) * dx + W'(part_y) * dy;
            wire signed [W-1:0] moved = product >>> S;     // its own word: the shift keeps the sign
            always_ff @(posedge clk)
                if (takes) begin
                    dx <= along[PLACE +: W];
                    dy <= down[PLACE +: W];
                    line_start <= starts[PLACE +: W];
                end
                else if (divides && side == 0 && adjusts) line_start <= line_start + moved;
                else if (looks) begin
                    line_start <= line_start + dy;
                    if (holds) here <= line_start + dx * distance[W-1:0];
                end
                else if (moves) here <= leftwards ? here - dx : here + dx;
            if (k < 4) begin : colour
                assign p_a_b_g_r[8*k +: 8] = here < 0 ? 8'd0 : here[30:20] != 0 ? 8'd255 : here[19:12];
            end
        end
    endgenerate

    // The float of 1/w: a half, a quarter and so on of bits 16 to 31 is left, where the leading one is.
    wire [31:0] one_over_w = channels[7].here[31:0];
    wire zero_8 = one_over_w[31:24] == 0;
    wire [7:1] upper_8 = zero_8 ? one_over_w[23:17] : one_over_w[31:25];
    wire zero_4 = upper_8[7:4] == 0;
    wire [3:1] upper_4 = zero_4 ? upper_8[3:1] : upper_8[7:5];
    wire zero_2 = upper_4[3:2] == 0;
    wire zero_1 = !(zero_2 ? upper_4[1] : upper_4[3]);
    wire [3:0] zeros = {zero_8, zero_4, zero_2, zero_1};
    wire [11:0] below = 12'((one_over_w << zeros) >> 19);
    wire [16:0] float = {1'b0, zeros, ~below} + 17'd1;
    wire [15:0] w_float = channels[7].here[47:32] != 0 ? 16'd0 : one_over_w[31:16] == 0 ? 16'hf001
        : float[16] ? 16'hffff : float[15:0];
    wire signed [31:0] z_here = channels[4].here;
    wire [15:0] z_value = z_here < 0 ? 16'd0 : z_here[30:28] != 0 ? 16'hffff : z_here[27:12];
    wire signed [17:0] chosen = {2'b00, by_w ? w_float : z_value};
    wire signed [17:0] biased = chosen + (biases ? 18'(bias) : 18'sd0);
    wire [15:0] depth = biased[17] ? 16'd0 : biased[16] ? 16'hffff : biased[15:0];

    assign in_ready = !busy;
    assign p_valid = drawing;
    assign p_test = name;
    assign p_y_x = {row, column};
    assign p_z_w_float = {z_value, w_float};
    assign p_depth = 32'(depth);
    assign {p_s_32, p_s} = channels[5].here;
    assign {p_t_32, p_t} = channels[6].here;

    always_ff @(posedge clk)
        if (rst) {busy, drawing} <= 2'b00;
        else if (takes) begin
            busy <= 1'b1;
            side <= 2'd0;
            name <= test;
            leftwards <= leftward[31];
            {flips, biases} <= flip_depth_biased_w_buffer_clip[17:16];
            {by_w, clips} <= {flip_depth_biased_w_buffer_clip[3], flip_depth_biased_w_buffer_clip[0]};
            adjusts <= adjust != 0;
            {low_x, high_x} <= {1'b0, clip_left, 1'b0, clip_right};
            {low_y, high_y} <= {1'b0, clip_top, 1'b0, clip_bottom};
            {a_x, a_y, b_x, b_y} <= {xa[15:0], ya[15:0], xb[15:0], yb[15:0]};
            {c_x, c_y} <= {xc[15:0], yc[15:0]};
            {bias, rows_of_window} <= {depth_bias[15:0], height[15:0]};
        end
        else if (divides) begin
            side <= side + 1'b1;
            {slope_ac, slope_ab, slope_bc} <= {slope_ab, slope_bc, slope};
            line <= first_line;
        end
        else if (looks) begin
            busy <= !ends;
            drawing <= !ends && holds;
            {column, last} <= leftwards ? {high[15:0], low[15:0]} : {low[15:0], high[15:0]};
            row <= flips ? rows_of_window - 16'd1 - 16'(line) : 16'(line);
            line <= line + 1'b1;
        end
        else if (moves) begin
            column <= leftwards ? column - 1'b1 : column + 1'b1;
            if (column == last) drawing <= 1'b0;
        end
endmodule

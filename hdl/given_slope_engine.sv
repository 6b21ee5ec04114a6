// An engine of given edge slopes: the starts and steps of three sides and of nine channels in; each drawn
// pixel out with its channels, row by row from the bottom upward, from the long side on. One clock for each
// row, and one for each pixel. Spec: registers RG-12, RG-13 (plane at-edge), RG-20.
module given_slope_engine (
    input  logic        clk,
    input  logic        rst,
    input  logic        in_valid,
    output logic        in_ready,
    input  logic [31:0] test,
    // Words are registers of 32 bits; the bits above a field are not wired.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [31:0] clip, clip_left, clip_right, clip_top, clip_bottom,   // closed
    input  logic [31:0] x, y, x_step, end01, end01_step, end12, end12_step,
    input  logic [31:0] rightward_rows01_rows12,
    input  logic [31:0] r, g, b, a, z, u, v, w, d,
    input  logic [31:0] r_dx, g_dx, b_dx, a_dx, z_dx, u_dx, v_dx, w_dx, d_dx,
    input  logic [31:0] r_dy, g_dy, b_dy, a_dy, z_dy, u_dy, v_dy, w_dy, d_dy,
    input  logic [31:0] unused40, unused41, unused42, unused43,
    /* verilator lint_on UNUSEDSIGNAL */
    output logic        p_valid,
    input  logic        p_ready,
    output logic [31:0] p_test, p_y_x, p_a_b_g_r, p_z, p_u, p_v, p_w, p_d
);
    localparam int F = 20;               // fraction bits of an x
    localparam int N = 5;                // bits of them that place the edge in its pixel
    localparam int CHANNELS = 9;         // r g b a z u v w d, each in a word of 32 bits
    localparam logic [31:0] BIAS = 32'd1048575;

    logic busy, drawing;                 // drawing: a pixel is raised; else the next row is looked at
    logic [31:0] name;
    logic clips, rightwards;
    logic signed [32:0] low_x, high_x, low_y, high_y;   // never negative
    logic [31:0] long_x, short_x, long_step, step01, start12, step12;
    logic [10:0] rows01, rows12;         // rows that remain beside each short side
    logic signed [32:0] line;            // the next row
    logic [11:0] column, last;           // the pixel drawn, and the last one of its row
    logic [15:0] row;

    wire takes = !busy && in_valid;
    wire looks = busy && !drawing;
    wire moves = drawing && p_ready;

    // The row holds the pixels from left to right, both included; the clip rectangle takes some of them away.
    wire signed [31:0] left_end = (rightwards ? long_x : short_x) + BIAS;
    wire signed [31:0] right_end = (rightwards ? short_x : long_x) + BIAS;
    wire signed [32:0] left = 33'(left_end) >>> F;
    wire signed [32:0] right = (33'(right_end) >>> F) - 1;
    wire signed [32:0] low = clips && low_x > left ? low_x : left;
    wire signed [32:0] high = clips && high_x < right ? high_x : right;
    wire holds = low <= high && !(clips && (line < low_y || line > high_y));
    wire ends = rows01 == 0 && rows12 == 0;

    // The first pixel is this far from the long side: a fraction of a pixel, and the clipped pixels.
    wire [N-1:0] f = N'((long_x - 1) >> (F - N));
    wire [N:0] part = rightwards ? (N+1)'(1 << N) - (N+1)'(f) : (N+1)'(f);
    wire [31:0] clipped = 32'(rightwards ? low - left : right - high);

    // A colour has 16 bits: zeros above a start, the sign above a slope. Depth has one more bit down.
    wire [32*CHANNELS-1:0] starts = {d, w, v, u, z << 1,
        32'(a[15:0]), 32'(b[15:0]), 32'(g[15:0]), 32'(r[15:0])};
    wire [32*CHANNELS-1:0] along = {d_dx, w_dx, v_dx, u_dx, z_dx,
        32'($signed(a_dx[15:0])), 32'($signed(b_dx[15:0])), 32'($signed(g_dx[15:0])), 32'($signed(r_dx[15:0]))};
    wire [32*CHANNELS-1:0] down = {d_dy, w_dy, v_dy, u_dy, z_dy << 1,
        32'($signed(a_dy[15:0])), 32'($signed(b_dy[15:0])), 32'($signed(g_dy[15:0])), 32'($signed(r_dy[15:0]))};
    genvar k;
    generate
        for (k = 0; k < CHANNELS; k = k + 1) begin : channels
            logic signed [31:0] dx, dy, edge_of_row, here;
            wire signed [31:0] product = dx * 32'(part);
            wire signed [31:0] share = product >>> N;      // its own word: the shift keeps the sign
            always_ff @(posedge clk)
                if (takes) begin
                    dx <= along[32*k +: 32];
                    dy <= down[32*k +: 32];
                    edge_of_row <= starts[32*k +: 32];
                end
                else if (looks) begin
                    edge_of_row <= edge_of_row + dy;
                    if (holds) here <= edge_of_row + share + dx * clipped;
                end
                else if (moves) here <= here + dx;
            // A colour is read out with its clamp, the other channels as they are.
            if (k < 4) begin : colour
                assign p_a_b_g_r[8*k +: 8] = here < 0 ? 8'd0 : here[30:15] != 0 ? 8'd255 : here[14:7];
            end
        end
    endgenerate

    assign in_ready = !busy;
    assign p_valid = drawing;
    assign p_test = name;
    assign p_y_x = {row, 4'b0000, column};
    assign p_z = channels[4].here;
    assign p_u = channels[5].here;
    assign p_v = channels[6].here;
    assign p_w = channels[7].here;
    assign p_d = channels[8].here;

    always_ff @(posedge clk)
        if (rst) {busy, drawing} <= 2'b00;
        else if (takes) begin
            busy <= 1'b1;
            name <= test;
            clips <= clip != 0;
            {low_x, high_x} <= {1'b0, clip_left, 1'b0, clip_right};
            {low_y, high_y} <= {1'b0, clip_top, 1'b0, clip_bottom};
            {rightwards, rows01} <= {rightward_rows01_rows12[31], rightward_rows01_rows12[26:16]};
            rows12 <= rightward_rows01_rows12[10:0];
            {long_x, long_step} <= {x, x_step};
            line <= 33'($signed(y));
            short_x <= rightward_rows01_rows12[26:16] == 0 ? end12 : end01;
            {step01, start12, step12} <= {end01_step, end12, end12_step};
        end
        else if (looks) begin
            busy <= !ends;
            drawing <= !ends && holds;
            {column, last} <= rightwards ? {low[11:0], high[11:0]} : {high[11:0], low[11:0]};
            row <= line[15:0];
            line <= line - 1;
            long_x <= long_x + long_step;
            if (rows01 != 0) begin
                rows01 <= rows01 - 1'b1;
                short_x <= rows01 == 1 ? start12 : short_x + step01;
            end
            else begin
                rows12 <= rows12 - 1'b1;
                short_x <= short_x + step12;
            end
        end
        else if (moves) begin
            column <= rightwards ? column + 1'b1 : column - 1'b1;
            if (column == last) drawing <= 1'b0;
        end
endmodule

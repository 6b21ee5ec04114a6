// An engine of sub-scanlines: the sides of a triangle and the values of eight channels in; each row with its
// ends, its sides and the channels at its start out, and each pixel with its coverage, colour and depth. A
// row has four sub-scanlines, and a pixel has eight samples. One clock for each empty row, one for each
// pixel, and two more for each drawn row. Spec: registers RG-15 to RG-20.
module sub_scanline_engine #(
    parameter int RESIZE = 0,            // 1: a product keeps its sign and its low 31 bits; 0: its low 32 bits
    parameter int SIGNED_DISTANCE = 0,   // 1: the distance from the long side to the first pixel is signed
    parameter int LONG_SIGN = 1,         // 1: bit 31 is the sign of the long side; 0: the slope has the sign
    parameter int DROP_Z = 0             // low bits that the slope of z along a row lacks
) (
    input  logic        clk,
    input  logic        rst,
    input  logic        in_valid,
    output logic        in_ready,
    input  logic [31:0] test,
    // Words are registers of 32 bits; the bits outside the fields are not wired.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [31:0] command_rightward_level_tile_yl, ym_yh,
    input  logic [31:0] xl, xl_step, xh, long_sign_xh_step, xm, xm_step,
    input  logic [31:0] r_16_g_16, b_16_a_16, r_dx_16_g_dx_16, b_dx_16_a_dx_16,
    input  logic [31:0] r_g, b_a, r_dx_g_dx, b_dx_a_dx,
    input  logic [31:0] r_de_16_g_de_16, b_de_16_a_de_16, r_dy_16_g_dy_16, b_dy_16_a_dy_16,
    input  logic [31:0] r_de_g_de, b_de_a_de, r_dy_g_dy, b_dy_a_dy,
    input  logic [31:0] s_16_t_16, w_16_l1, s_dx_16_t_dx_16, w_dx_16_l1_dx,
    input  logic [31:0] s_t, w_l2, s_dx_t_dx, w_dx_l2_dx,
    input  logic [31:0] s_de_16_t_de_16, w_de_16_l1_de, s_dy_16_t_dy_16, w_dy_16_l1_dy,
    input  logic [31:0] s_de_t_de, w_de_l2_de, s_dy_t_dy, w_dy_l2_dy,
    input  logic [31:0] z, z_dx, z_de, z_dy,
    input  logic [31:0] scissor_xh, scissor_yh, scissor_xl, scissor_yl,   // left, top, right, bottom
    /* verilator lint_on UNUSEDSIGNAL */
    output logic        span_valid,
    input  logic        span_ready,
    output logic [31:0] span_test, span_y, span_left_end, span_right_end, span_edge_x,
    output logic [31:0] span_r, span_g, span_b, span_a, span_s, span_t, span_w, span_z,          // the input has the name s_t
    output logic [31:0] span_invalid0_short0_long0, span_invalid1_short1_long1,
    output logic [31:0] span_invalid2_short2_long2, span_invalid3_short3_long3,
    output logic        p_valid,
    input  logic        p_ready,
    output logic [31:0] p_test, p_x, p_slope_code_coverage, p_a_b_g_r, p_z, p_depth_code
);
    localparam int CHANNELS = 8;         // z w t s a b g r, each in a word of 32 bits
    localparam int Z = 0;
    localparam int COLOUR = 4;           // the colours are the channels from here on

    logic busy, drawing, s_waits;        // drawing: a pixel is raised; s_waits: a row is raised
    logic shown;                         // the row has been raised: when it and its pixels are taken, the next
    logic [31:0] name;
    logic rightward, sign;
    logic signed [13:0] top, bottom;     // sub-scanlines, half open
    logic [11:0] turn_row;               // the short side starts again at sub-scanline ym
    logic [1:0] turn_line;
    logic [12:0] left_limit, right_limit;                      // in eighths of a pixel
    // The lowest bit of an x is 0, and has no wire. A step is a quarter of a slope.
    logic [27:1] long_x, long_step, short_x, short_step, start12, step12;
    logic [11:0] row;
    logic [9:0] column;                  // the pixel drawn

    wire holds;
    wire [9:0] first, last;              // the pixels of the row, in the order of drawing
    wire takes = !busy && in_valid;
    wire looks = busy && !drawing && !s_waits;
    wire raises = looks && !shown && holds;
    wire steps = looks && !raises;
    wire moves = drawing && p_ready;
    wire ends = $signed({row, 2'b00}) >= bottom;

    // Four sub-scanlines of the row: both sides, and where they reach the next row (place 4).
    wire turns = row == turn_row;
    wire [4:0] turned = turns ? 5'b11111 << turn_line : 5'b00000;
    wire [4*13-1:0] lefts, rights;       // in eighths of a pixel, inside the scissor
    wire [4*27-1:0] words;               // of a row's record
    wire [3:0] invalid, left_of, right_of;                     // both sides lie beyond an end
    genvar k;
    generate
        for (k = 0; k < 5; k = k + 1) begin : lines
            wire [27:1] long_side = long_x + 27'(k) * long_step;
            wire [27:1] lower = start12 + (27'(k) - 27'(turn_line)) * step12;
            wire [27:1] short_side = turned[k] ? lower : short_x + 27'(k) * short_step;
        end
        for (k = 0; k < 4; k = k + 1) begin : sides
            wire [27:1] left = rightward ? lines[k].long_side : lines[k].short_side;
            wire [27:1] right = rightward ? lines[k].short_side : lines[k].long_side;
            // A fraction below a quarter of a pixel only shows that there is one.
            wire [12:0] left_eighths = {left[25:14], left[13:1] != 0};
            wire [12:0] right_eighths = {right[25:14], right[13:1] != 0};
            wire left_below = left[27] || (!left[26] && left_eighths < left_limit);
            wire right_below = right[27] || (!right[26] && right_eighths < left_limit);
            // A side at the right end counts as beyond it.
            wire left_above = !left_below && (left[26] || left_eighths >= right_limit);
            wire right_above = !right_below && (right[26] || right_eighths >= right_limit);
            wire [12:0] left_end = left_below ? left_limit : left_above ? right_limit : left_eighths;
            wire [12:0] right_end = right_below ? left_limit : right_above ? right_limit : right_eighths;
            wire signed [13:0] y = {row, 2'(k)};
            wire crosses = $signed(right[27:14]) < $signed(left[27:14]);
            assign lefts[13*k +: 13] = left_end;
            assign rights[13*k +: 13] = right_end;
            assign invalid[k] = y < top || y >= bottom || crosses;
            assign left_of[k] = left_below && right_below;
            assign right_of[k] = left_above && right_above;
            assign words[27*k +: 27] = {invalid[k], rightward ? {right_end, left_end} : {left_end, right_end}};
        end
    endgenerate
    logic [9:0] leftmost, rightmost;     // over the valid sub-scanlines
    always_comb begin
        {leftmost, rightmost} = {10'h3ff, 10'h000};
        for (int i = 0; i < 4; i = i + 1)
            if (!invalid[i]) begin
                if (lefts[13*i + 3 +: 10] < leftmost) leftmost = lefts[13*i + 3 +: 10];
                if (rights[13*i + 3 +: 10] > rightmost) rightmost = rights[13*i + 3 +: 10];
            end
    end
    // A scissor without width holds nothing, wherever the sides are.
    assign holds = left_limit < right_limit && invalid != 4'b1111 && left_of != 4'b1111 && right_of != 4'b1111;
    assign {first, last} = rightward ? {leftmost, rightmost} : {rightmost, leftmost};

    // The start of the row is taken at the sub-scanline on which the long side lies farther out.
    wire [27:8] long_side = sign == rightward ? lines[3].long_side[27:8] : lines[0].long_side[27:8];
    wire signed [8:0] part = {1'b0, long_side[15:8]};
    wire [11:0] distance = rightward ? 12'(first) - long_side[27:16] : long_side[27:16] - 12'(first);
    wire signed [12:0] far = {SIGNED_DISTANCE != 0 && distance[11], distance};

    // The samples of a pixel: on each sub-scanline two of its four columns, the first one at LINE % 2.
    wire [7:0] covers;
    generate
        for (k = 0; k < 8; k = k + 1) begin : samples
            localparam int LINE = k / 2;
            wire [12:0] x = {column, 1'(k), 1'(LINE), 1'b0};
            assign covers[k] = !invalid[LINE] && lefts[13*LINE +: 13] <= x && x < rights[13*LINE +: 13];
        end
    endgenerate
    logic [3:0] coverage;
    logic signed [2:0] spot_x, spot_y;   // the first covered sample, never negative
    always_comb begin
        coverage = 4'd0;
        {spot_x, spot_y} = 6'd0;
        for (int i = 7; i >= 0; i = i - 1)
            if (covers[i]) begin
                coverage = coverage + 4'd1;
                spot_x = {1'b0, 1'(i), 1'(i >> 1)};
                spot_y = {1'b0, 2'(i >> 1)};
            end
    end

    // Channels, z in the low bits. The halves of a value or a slope are in different words.
    wire [127:0] high = {r_16_g_16, b_16_a_16, s_16_t_16, w_16_l1[31:16], z[31:16]};
    wire [127:0] low = {r_g, b_a, s_t, w_l2[31:16], z[15:0]};
    wire [127:0] dx_high = {r_dx_16_g_dx_16, b_dx_16_a_dx_16, s_dx_16_t_dx_16, w_dx_16_l1_dx[31:16], z_dx[31:16]};
    wire [127:0] dx_low = {r_dx_g_dx, b_dx_a_dx, s_dx_t_dx, w_dx_l2_dx[31:16], z_dx[15:0]};
    wire [127:0] de_high = {r_de_16_g_de_16, b_de_16_a_de_16, s_de_16_t_de_16, w_de_16_l1_de[31:16], z_de[31:16]};
    wire [127:0] de_low = {r_de_g_de, b_de_a_de, s_de_t_de, w_de_l2_de[31:16], z_de[15:0]};
    wire [127:0] dy_high = {r_dy_16_g_dy_16, b_dy_16_a_dy_16, s_dy_16_t_dy_16, w_dy_16_l1_dy[31:16], z_dy[31:16]};
    wire [127:0] dy_low = {r_dy_g_dy, b_dy_a_dy, s_dy_t_dy, w_dy_l2_dy[31:16], z_dy[15:0]};
    wire [32*CHANNELS-1:0] starts;
    generate
        for (k = 0; k < CHANNELS; k = k + 1) begin : channels
            localparam logic [31:0] KEPT = 32'hffff_ffff << (k == Z ? DROP_Z : 5);
            logic signed [31:0] value, dx, de, dy;
            wire signed [31:0] high_de = de & ~32'h1ff;
            wire signed [31:0] high_dy = dy & ~32'h1ff;
            wire signed [31:0] middle = high_de - (high_de >>> 2) - high_dy + (high_dy >>> 2);
            wire [31:0] offset = sign == rightward ? middle : 32'd0;
            wire signed [31:0] lean = (dx >>> 8) & ~32'sd1;
            wire [31:0] share = lean * part;               // it fits: as wrapped, so resized
            wire [31:0] start = ((value & ~32'h1ff) + offset - share) & ~32'h3ff;
            assign starts[32*k +: 32] = start;
            always_ff @(posedge clk)
                if (takes) begin
                    value <= {high[16*k +: 16], low[16*k +: 16]};
                    dx <= {dx_high[16*k +: 16], dx_low[16*k +: 16]} & KEPT;
                    de <= {de_high[16*k +: 16], de_low[16*k +: 16]};
                    dy <= {dy_high[16*k +: 16], dy_low[16*k +: 16]};
                end
                else if (steps) value <= value + de;

            // Colours and z are stepped along the row. Each pixel is corrected with BITS bits below the integer:
            // if all eight samples are covered, the first one is that at 0, 0, and the value remains.
            if (k >= COLOUR || k == Z) begin : pixel
                localparam int I = k == Z ? 18 : 8;
                localparam int BITS = k == Z ? 3 : 2;
                localparam int SHIFT = (k == Z ? 13 : 16) - BITS;
                logic signed [31:0] here;
                wire signed [31:0] change = rightward ? dx : -dx;
                wire signed [44:0] way = change * far;
                wire [31:0] way_word = RESIZE != 0 ? {way < 0, way[30:0]} : way[31:0];
                always_ff @(posedge clk)
                    if (raises) here <= start + way_word;
                    else if (moves) here <= here + change;
                wire signed [31:0] cut = here >>> SHIFT;
                wire signed [31:0] cut_dx = dx >>> SHIFT;
                wire signed [31:0] cut_dy = dy >>> SHIFT;
                wire signed [31:0] sum = (cut <<< 2) + cut_dx * spot_x + cut_dy * spot_y;
                wire [I:0] whole = (I+1)'(sum >>> (2 + BITS));
                wire [I-1:0] reading = !whole[I] ? whole[I-1:0] : {I{!whole[I-1]}};
            end
            if (k >= COLOUR) assign p_a_b_g_r[8*(CHANNELS - 1 - k) +: 8] = pixel.reading;
        end
    endgenerate

    // Depth as a float: leading ones, and the bits below the zero that ends them.
    wire [17:0] depth = channels[Z].pixel.reading;
    logic [2:0] ones;
    logic [10:0] fraction;
    always_comb begin
        ones = 3'd7;
        for (int i = 0; i < 7; i = i + 1)
            if (!depth[11 + i]) ones = 3'(6 - i);
        fraction = 11'(depth >> (ones < 3'd6 ? 3'd6 - ones : 3'd0));
    end

    // The slope of depth over a pixel, as a power of two: its exponent is the code.
    wire [15:0] slope_x = channels[Z].dx[31:16];
    wire [15:0] slope_y = channels[Z].dy[31:16];
    wire [15:0] slope = (slope_x[15] ? ~slope_x : slope_x) + (slope_y[15] ? ~slope_y : slope_y);
    logic [15:0] power;
    always_comb begin
        power = 16'h0001;
        for (int i = 1; i < 14; i = i + 1)
            if (slope[i]) power = 16'h0002 << i;
        if (slope == 16'd1) power = 16'h0003;
        if (slope >= 16'h4000) power = 16'h8000;
    end
    wire [3:0] slope_code = {|(power & 16'hff00), |(power & 16'hf0f0), |(power & 16'hcccc), |(power & 16'haaaa)};

    assign {in_ready, span_valid, p_valid} = {!busy, s_waits, drawing};
    assign {span_test, p_test} = {name, name};
    assign span_y = 32'(row);
    assign span_left_end = 32'(last);       // the pixel at which drawing ends
    assign span_right_end = 32'(first);     // and at which it begins, on the long side
    assign span_edge_x = 32'($signed(long_side[27:16]));
    assign {span_r, span_g, span_b, span_a, span_s, span_t, span_w, span_z} = starts;
    assign span_invalid0_short0_long0 = 32'(words[0 +: 27]);
    assign span_invalid1_short1_long1 = 32'(words[27 +: 27]);
    assign span_invalid2_short2_long2 = 32'(words[54 +: 27]);
    assign span_invalid3_short3_long3 = 32'(words[81 +: 27]);
    assign p_x = 32'(column);
    assign p_slope_code_coverage = {20'd0, slope_code, 4'd0, coverage};
    assign p_z = 32'(depth);
    assign p_depth_code = {16'd0, ones, fraction, 2'b00};

    // The scissor is never negative; yh and yl have a sign.
    wire signed [13:0] yh = ym_yh[13:0];
    wire signed [13:0] yl = command_rightward_level_tile_yl[13:0];
    wire signed [13:0] scissor_top = {2'b00, scissor_yh[11:0]}, scissor_bottom = {2'b00, scissor_yl[11:0]};
    always_ff @(posedge clk)
        if (rst) {busy, drawing, s_waits} <= 3'b000;
        else if (takes) begin
            busy <= 1'b1;
            name <= test;
            rightward <= command_rightward_level_tile_yl[23];
            sign <= LONG_SIGN != 0 ? long_sign_xh_step[31] : long_sign_xh_step[29];
            top <= yh > scissor_top ? yh : scissor_top;
            bottom <= yl < scissor_bottom ? yl : scissor_bottom;
            {turn_row, turn_line} <= ym_yh[29:16];
            {left_limit, right_limit} <= {scissor_xh[11:0], 1'b0, scissor_xl[11:0], 1'b0};
            {long_x, long_step} <= {xh[27:1], long_sign_xh_step[29:3]};
            {short_x, short_step} <= {xm[27:1], xm_step[29:3]};
            {start12, step12} <= {xl[27:1], xl_step[29:3]};
            row <= yh[13:2];
            shown <= 1'b0;
        end
        else begin
            if (raises) begin
                {drawing, s_waits, shown} <= 3'b111;
                column <= first;
            end
            if (moves) begin
                column <= rightward ? column + 1'b1 : column - 1'b1;
                if (column == last) drawing <= 1'b0;
            end
            if (s_waits && span_ready) s_waits <= 1'b0;
            if (steps) begin
                busy <= !ends;
                shown <= 1'b0;
                row <= row + 1'b1;
                long_x <= lines[4].long_side;
                short_x <= lines[4].short_side;
                if (turns) short_step <= step12;
            end
        end
endmodule

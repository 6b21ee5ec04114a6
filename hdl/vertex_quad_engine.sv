// An engine of three vertices with sub-pixels: the vertices and a range in; each covered pixel with its three
// edge words out, row by row. A division for each edge says whether the edge owns its samples, and one for
// each edge and row of quads narrows the row. One pixel a clock. Spec: registers RG-5, RG-6.
module vertex_quad_engine (
    input  logic        clk,
    input  logic        rst,
    input  logic        in_valid,
    output logic        in_ready,
    input  logic [31:0] test,
    // Words are registers of 32 bits; the bits above a field are not wired.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [31:0] x0, y0, x1, y1, x2, y2,                       // 12.4, without sign
    input  logic [31:0] left, top, right, bottom,                     // closed, in sub-pixels, without sign
    /* verilator lint_on UNUSEDSIGNAL */
    output logic        p_valid,
    input  logic        p_ready,
    output logic [31:0] p_test, p_y_x, p_e0, p_e1, p_e2
);
    typedef enum logic [1:0] {IDLE, EDGES, NARROW, DRAW} state_t;
    localparam logic signed [18:0] SAMPLE = 19'sd7, PIXEL = 19'sd16, QUAD = 19'sd32;

    state_t state;
    logic [2:0] step;
    logic [31:0] name;
    logic [95:0] vertices;               // y, x of a third vertex, of an edge's end and of its start, downward
    logic signed [18:0] first_x, last_x, last_y;   // the first sample of a row, the ends of the range
    logic signed [18:0] line_y;          // the upper samples of the row of quads
    logic [2:0] yields;                  // edges that do not own their samples; edge 0 in the low bit
    logic [95:0] a, b, line;             // change of an edge word along x and y; edge words at the row's start

    wire takes = state == IDLE && in_valid;

    // An edge from `from` to `to`. The vertices turn after each edge.
    wire signed [18:0] from_x = {3'd0, vertices[15:0]}, from_y = {3'd0, vertices[31:16]};
    wire signed [18:0] to_x = {3'd0, vertices[47:32]}, to_y = {3'd0, vertices[63:48]};
    wire signed [18:0] third_x = {3'd0, vertices[79:64]}, third_y = {3'd0, vertices[95:80]};
    wire signed [18:0] dx = to_x - from_x, dy = to_y - from_y;
    wire signed [18:0] sample_dx = first_x - from_x, sample_dy = line_y - from_y, third_dy = third_y - from_y;
    wire [31:0] edge_a = -(32'(dy) << 4);
    wire [31:0] edge_b = 32'(dx) << 4;
    wire [31:0] edge_word = 32'(dx) * 32'(sample_dy) - 32'(dy) * 32'(sample_dx);
    wire signed [31:0] edge_product = 32'(dx) * 32'(third_dy);

    // All divisions share one divider. It works in one clock here; hardware would take a bit a clock.
    // A bit above 32 holds the quotient of the lowest word by -1. A divisor of 0 has no use.
    logic signed [32:0] dividend, divisor;
    wire signed [31:0] quotient = 32'(dividend / divisor);

    // Whether an edge yields its samples to a neighbour. The quotient is there after the vertices have turned.
    wire signed [18:0] edge_x = third_x, edge_y = third_y, end_y = from_y, beyond_x = to_x, beyond_y = to_y;
    wire signed [31:0] side = 32'(edge_x) + quotient;
    wire edge_yields = end_y == edge_y ? beyond_y < edge_y : 32'(beyond_x) < side;

    // A row of quads. An edge is negative in all of it, or its quotient is where the edge changes sign.
    wire [95:0] most, quad_step, next_line;
    wire [2:0] negative, rises, falls;   // in the first quad; along the row
    genvar k;
    generate
        for (k = 0; k < 3; k = k + 1) begin : edges
            wire [31:0] here = line[32*k +: 32], along = a[32*k +: 32], down = b[32*k +: 32];
            wire signed [31:0] e0 = here, e1 = here + along, e2 = here + down, e3 = here + along + down;
            wire signed [31:0] above = e0 > e1 ? e0 : e1;
            wire signed [31:0] below = e2 > e3 ? e2 : e3;
            wire signed [31:0] change = along << 1;
            assign most[32*k +: 32] = above > below ? above : below;
            assign quad_step[32*k +: 32] = change;
            assign next_line[32*k +: 32] = here + (down << 1);
            assign negative[k] = most[32*k + 31];
            assign rises[k] = change > 0;
            assign falls[k] = change < 0;
        end
    endgenerate
    wire signed [18:0] width = last_x - first_x;
    wire no_row = line_y > last_y || width < 0;
    wire no_quad = (negative & ~rises) != 3'd0;
    wire [1:0] now = step[1:0];          // the edge to divide for
    wire [1:0] divided = step[1:0] - 2'd1;
    wire [31:0] now_most = most[32*now +: 32], now_step = quad_step[32*now +: 32];

    // Quads that remain, by the distance of their first samples from the row's first one.
    logic signed [31:0] low, high;
    wire signed [31:0] bound = (negative[divided] ? quotient : quotient + 32'sd1) << 5;
    wire [31:0] skipped = 32'(low[16:5]);
    wire signed [18:0] row_end = first_x + high[18:0] + PIXEL;

    // Pixels.
    logic signed [18:0] x, y, start_x, end_x;
    logic [95:0] word, start;            // edge words at the pixel, and at the first one of its row
    wire [2:0] outside;
    wire moves = state == DRAW && (!p_valid || p_ready);
    wire row_ends = x + PIXEL > end_x;
    wire lower_follows = y == line_y && y + PIXEL <= last_y;
    generate
        for (k = 0; k < 3; k = k + 1) begin : words
            wire [31:0] here = word[32*k +: 32];
            wire signed [31:0] tested = here - 32'(yields[k]);
            wire [31:0] skips = line[32*k +: 32] + quad_step[32*k +: 32] * skipped;
            assign outside[k] = tested < 0;
            always_ff @(posedge clk)
                if (state == NARROW) {word[32*k +: 32], start[32*k +: 32]} <= {2{skips}};
                else if (moves)
                    word[32*k +: 32] <= row_ends ? start[32*k +: 32] + b[32*k +: 32] : here + a[32*k +: 32];
        end
    endgenerate

    wire next_row = state == NARROW && step == 3'd0 && !no_row && no_quad
        || state == NARROW && step == 3'd4 && low > high
        || moves && row_ends && !lower_follows;

    assign in_ready = state == IDLE;
    assign p_valid = state == DRAW && outside == 3'd0;
    assign p_test = name;
    assign p_y_x = {3'd0, y[16:4], 3'd0, x[16:4]};
    assign {p_e2, p_e1, p_e0} = word;

    always_ff @(posedge clk)
        if (rst) state <= IDLE;
        else if (next_row) begin
            {state, step} <= {NARROW, 3'd0};
            {line, line_y} <= {next_line, line_y + QUAD};
        end
        else case (state)
            IDLE: if (takes) begin
                state <= EDGES;
                step <= 3'd0;
                name <= test;
                vertices <= {y0[15:0], x0[15:0], y2[15:0], x2[15:0], y1[15:0], x1[15:0]};
                first_x <= $signed({2'd0, left[16:0]}) + SAMPLE;
                line_y <= $signed({2'd0, top[16:0]}) + SAMPLE;
                {last_x, last_y} <= {2'd0, right[16:0], 2'd0, bottom[16:0]};
            end
            EDGES: begin                 // gives the divider one edge, and keeps the owner of the one before
                step <= step + 3'd1;
                dividend <= 33'(edge_product);
                divisor <= dy == 0 ? 33'sd1 : 33'(dy);
                vertices <= {vertices[31:0], vertices[95:32]};
                if (step != 3'd0) yields <= {edge_yields, yields[2:1]};
                if (step != 3'd3) {a, b, line} <= {edge_a, a[95:32], edge_b, b[95:32], edge_word, line[95:32]};
                else {state, step} <= {NARROW, 3'd0};
            end
            NARROW: begin                // the same for the edges of a row of quads
                step <= step + 3'd1;
                if (step < 3'd3) begin
                    dividend <= 33'($signed(-now_most));
                    divisor <= now_step == 0 ? 33'sd1 : 33'($signed(now_step));
                end
                case (step)
                    3'd0: begin
                        {low, high} <= {32'd0, 32'(width)};
                        if (no_row) state <= IDLE;
                    end
                    3'd4: begin
                        {x, start_x, y} <= {{2{first_x + low[18:0]}}, line_y};
                        end_x <= row_end < last_x ? row_end : last_x;
                        state <= DRAW;
                    end
                    default: if (negative[divided]) begin
                        if (bound > low) low <= bound;
                    end
                    else if (falls[divided] && bound < high) high <= bound;
                endcase
            end
            DRAW: if (moves) begin
                x <= row_ends ? start_x : x + PIXEL;
                if (row_ends) y <= y + PIXEL;
            end
            default: state <= IDLE;
        endcase
endmodule

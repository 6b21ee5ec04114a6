// An engine of given edge functions: the coefficients of three edges, a tile and a scissor in; each quad
// of 2 x 2 pixels with a covered pixel out, row by row. A quad is left out if the tile, or a part of it
// that holds the quad, lies outside an edge. One quad a clock. Spec: registers RG-5 to RG-7.
module quad_engine #(
    parameter int W = 32,                // bits of an edge word
    parameter int T = 32,                // pixels on a side of a tile, a power of two
    parameter int B = 4,                 // pixels on a side of the smallest part that is tested
    parameter int C = 16                 // bits of a pixel coordinate
) (
    input  logic        clk,
    input  logic        rst,
    input  logic        in_valid,
    output logic        in_ready,
    input  logic [31:0] test,
    // Words are registers of 32 bits; the bits above a field are not wired.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [31:0] tile_x, tile_y, x_min, x_max, y_min, y_max,   // half open
    input  logic [31:0] a0, b0, c0, a1, b1, c1, a2, b2, c2,           // c at the tile's first pixel
    /* verilator lint_on UNUSEDSIGNAL */
    output logic        q_valid,
    input  logic        q_ready,
    output logic [31:0] q_test, q_x, q_y, q_mask,                     // x and y in quads
    output logic [31:0] q_e0_0, q_e0_1, q_e0_2, q_e0_3,
    output logic [31:0] q_e1_0, q_e1_1, q_e1_2, q_e1_3,
    output logic [31:0] q_e2_0, q_e2_1, q_e2_2, q_e2_3
);
    localparam int LEVELS = $clog2(T / B) + 1;
    localparam int K = $clog2(T);        // bits of a place in the tile
    localparam logic [K-1:0] LAST = K'(T - 2);

    logic busy;
    logic [31:0] name;
    logic [C:0] left, top;               // the tile's first pixel
    logic [C:0] low_x, high_x, low_y, high_y;
    logic [3*W-1:0] a, b;                // edge 0 in the low bits
    logic [K-1:0] x, y;                  // the quad's first pixel in the tile
    wire [C:0] pixel_x = left + (C+1)'(x);
    wire [C:0] pixel_y = top + (C+1)'(y);

    wire takes = !busy && in_valid;
    wire moves = busy && (!q_valid || q_ready);
    wire row_ends = x == LAST;

    // Edge values at the four pixels, and at the corners of the parts of the tile that hold the quad. All
    // of them are stepped: a part of 2^S pixels on a side steps by 2^S times dx or dy.
    wire [3*W-1:0] first = {c2[W-1:0], c1[W-1:0], c0[W-1:0]};
    wire [3*LEVELS-1:0] beyond;
    wire [3:0] covers;
    genvar k, place, level;
    generate
        for (k = 0; k < 3; k = k + 1) begin : edges
            wire [W-1:0] dx = a[k*W +: W];
            wire [W-1:0] dy = b[k*W +: W];
            wire [W-1:0] reach = ((dx[W-1] ? {W{1'b0}} : dx) + (dy[W-1] ? {W{1'b0}} : dy)) << K;
            logic [W-1:0] here, line;    // at the quad's first pixel, and at the first one of its row
            always_ff @(posedge clk)
                if (takes) {here, line} <= {2{first[k*W +: W]}};
                else if (moves) begin
                    here <= row_ends ? line + (dy << 1) : here + (dx << 1);
                    if (row_ends) line <= line + (dy << 1);
                end
            for (place = 0; place < 4; place = place + 1) begin : pixels
                wire signed [W-1:0] e = here + (place % 2 == 1 ? dx : {W{1'b0}}) + (place >= 2 ? dy : {W{1'b0}});
            end
            for (level = 0; level < LEVELS; level = level + 1) begin : parts
                localparam int S = K - level;
                localparam logic [S-1:0] END = S'((1 << S) - 2);
                logic [W-1:0] corner, edge_of_row;
                wire [W-1:0] most = corner + (reach >> level);
                assign beyond[3*level + k] = most[W-1];
                always_ff @(posedge clk)
                    if (takes) {corner, edge_of_row} <= {2{first[k*W +: W]}};
                    else if (moves && row_ends) begin
                        corner <= edge_of_row + (y[S-1:0] == END ? dy << S : {W{1'b0}});
                        if (y[S-1:0] == END) edge_of_row <= edge_of_row + (dy << S);
                    end
                    else if (moves && x[S-1:0] == END) corner <= corner + (dx << S);
            end
        end
        for (place = 0; place < 4; place = place + 1) begin : quad
            wire [C:0] column = pixel_x + (C+1)'(place & 1);
            wire [C:0] row = pixel_y + (C+1)'(place >> 1);
            wire outside = edges[0].pixels[place].e < 0 || edges[1].pixels[place].e < 0 || edges[2].pixels[place].e < 0;
            assign covers[place] = !outside
                && column >= low_x && column < high_x && row >= low_y && row < high_y;
        end
    endgenerate

    assign in_ready = !busy;
    assign q_valid = busy && beyond == 0 && covers != 4'b0000;
    assign q_test = name;
    assign q_x = 32'(pixel_x) >> 1;
    assign q_y = 32'(pixel_y) >> 1;
    assign q_mask = 32'(covers);
    // A record holds an edge word with copies of its sign above it.
    assign q_e0_0 = 32'(edges[0].pixels[0].e);
    assign q_e0_1 = 32'(edges[0].pixels[1].e);
    assign q_e0_2 = 32'(edges[0].pixels[2].e);
    assign q_e0_3 = 32'(edges[0].pixels[3].e);
    assign q_e1_0 = 32'(edges[1].pixels[0].e);
    assign q_e1_1 = 32'(edges[1].pixels[1].e);
    assign q_e1_2 = 32'(edges[1].pixels[2].e);
    assign q_e1_3 = 32'(edges[1].pixels[3].e);
    assign q_e2_0 = 32'(edges[2].pixels[0].e);
    assign q_e2_1 = 32'(edges[2].pixels[1].e);
    assign q_e2_2 = 32'(edges[2].pixels[2].e);
    assign q_e2_3 = 32'(edges[2].pixels[3].e);

    always_ff @(posedge clk)
        if (rst) busy <= 1'b0;
        else if (takes) begin
            busy <= 1'b1;
            name <= test;
            {left, top} <= {1'b0, tile_x[C-1:0], 1'b0, tile_y[C-1:0]};
            {low_x, high_x} <= {1'b0, x_min[C-1:0], 1'b0, x_max[C-1:0]};
            {low_y, high_y} <= {1'b0, y_min[C-1:0], 1'b0, y_max[C-1:0]};
            a <= {a2[W-1:0], a1[W-1:0], a0[W-1:0]};
            b <= {b2[W-1:0], b1[W-1:0], b0[W-1:0]};
            x <= '0;
            y <= '0;
        end
        else if (moves) begin
            x <= row_ends ? '0 : x + K'(2);
            if (row_ends) y <= y + K'(2);
            if (row_ends && y == LAST) busy <= 1'b0;
        end
endmodule

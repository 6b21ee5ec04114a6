// An edge function over a box: one stepper goes down the box's left side, the other along a row.
// The word at the box's corner takes the only multiplications, mod 2^M as everything else.
module edge_evaluator #(
    parameter int M = 35,                // bits of an edge word
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

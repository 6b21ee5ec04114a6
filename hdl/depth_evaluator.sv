// A depth plane over a box: one DDA goes down the box's left side, the other along a row and reads
// out. The word at the box's corner takes the only multiplications, mod 2^N. Not for SATURATE, whose
// words depend on the way.
module depth_evaluator #(
    parameter int G = 1,                 // guard bits
    parameter int I = 24,                // integer bits
    parameter int F = 13,                // interpolation bits
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

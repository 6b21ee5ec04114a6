// A channel's component, or 1/w, along a walk: the accumulator, and its read-out. Spec: CH-2, CH-3, CH-5.
module interpolator #(
    parameter int G = 1,                 // guard bits
    parameter int I = 8,                 // bits of what is read out
    parameter int F = 14,                // bits below them, which the read-out drops
    parameter int MODE = 1,              // read-out: 0 wrap, 1 guard, 2 sign
    parameter int SIGNED = 0             // 1: what is read out is two's complement
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
    localparam logic [1:0] LOAD = 2'd0, STEP_X = 2'd1, STEP_Y = 2'd2;
    wire [N-1:0] base = op == LOAD ? {N{1'b0}} : acc;
    wire [N-1:0] addend = op == LOAD ? init : op == STEP_X ? dx : op == STEP_Y ? dy : {N{1'b0}};
    always_ff @(posedge clk)
        if (rst) acc <= {N{1'b0}};
        else acc <= base + addend;
    held_value #(.G(G), .I(I), .MODE(MODE), .SIGNED(SIGNED)) read (.acc(acc[N-1:F]), .held(out_v));
endmodule

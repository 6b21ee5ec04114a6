// Digital differential analyzer with a guard clamp: an accumulator, two slopes, and a read-out of
// the integer bits. The accumulator wraps; only SATURATE writes the clamp back to it.
// Spec: words W, walks D, guard clamp G.
module dda #(
    parameter int G = 1,                 // guard bits
    parameter int I = 24,                // integer bits, the width of the read-out
    parameter int F = 13,                // interpolation bits
    parameter int MODE = 1               // read-out: 0 wrap, 1 guard, 2 sign, 3 saturate
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
    localparam logic [1:0] LOAD = 2'd0, STEP_X = 2'd1, STEP_Y = 2'd2, HOLD = 2'd3;
    localparam int GUARD = 1, SIGN = 2, SATURATE = 3;

    // Next state. Two bits more than the accumulator hold any sum of it and a signed step.
    localparam logic [N+1:0] LIMIT = {{(N+1){1'b0}}, 1'b1} << (I + F);
    wire [N-1:0] base = op == LOAD ? {N{1'b0}} : acc;
    wire [N-1:0] addend = op == LOAD ? init : op == STEP_X ? dx : op == STEP_Y ? dy : {N{1'b0}};
    wire is_signed = addend[N-1] && !(G == 0 && op == LOAD);
    wire [N+1:0] sum = {2'b00, base} + {{2{is_signed}}, addend};
    wire below = sum[N+1];
    wire above = !below && sum >= LIMIT;
    wire [N-1:0] saturated = below ? {N{1'b0}} : above ? LIMIT[N-1:0] - 1'b1 : sum[N-1:0];

    always_ff @(posedge clk)
        if (rst) acc <= {N{1'b0}};
        else if (op != HOLD) acc <= MODE == SATURATE ? saturated : sum[N-1:0];

    // Read-out: the guard and integer bits as a pattern u. GUARD splits the patterns above the
    // integer range in the middle: the lower half has come from above, the upper from below.
    localparam logic [G+I:0] ONE = {{(G+I){1'b0}}, 1'b1};
    localparam logic [G+I:0] WHOLE = ONE << I;
    localparam logic [G+I:0] MIDDLE = (ONE << (G + I - 1)) + (ONE << (I - 1));
    wire [G+I:0] u = {1'b0, acc[N-1:F]};
    wire outside = u >= WHOLE;
    wire low = MODE == GUARD ? outside && u >= MIDDLE : MODE == SIGN && acc[N-1];
    wire high = (MODE == GUARD || MODE == SIGN) && outside && !low;
    assign out_v = low ? {I{1'b0}} : high ? {I{1'b1}} : u[I-1:0];
endmodule

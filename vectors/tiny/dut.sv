// guardbit vector set tiny, model version 1: devices that pass, in SystemVerilog, generated.
//
// Small, synthesizable and plain. Put your own modules in their place: same names, same ports,
// no parameters needed. Run from inside the set folder:
//     $ iverilog -g2012 -o sim.vvp pkg.sv dut.sv tb.sv && vvp -n sim.vvp
//     $ verilator --binary -O3 -Wno-fatal --top-module tb pkg.sv dut.sv tb.sv -o sim && obj_dir/sim

// Walks a plane: start, then steps of dx or dy, with a read-out of the integer bits that the
// guard bits clamp. The accumulator wraps; only SATURATE writes the clamp back to it.
module dda #(
    parameter int G = guardbit_pkg::GUARD_BITS,
    parameter int I = guardbit_pkg::INTEGER_BITS,
    parameter int F = guardbit_pkg::FRACTION_BITS,
    parameter int MODE = guardbit_pkg::CLAMP_MODE
) (
    input  logic             clk,
    input  logic             rst,
    input  logic [1:0]       op,     // 0 load, 1 step by dx, 2 step by dy, 3 hold
    input  logic [G+I+F-1:0] init,
    input  logic [G+I+F-1:0] dx,
    input  logic [G+I+F-1:0] dy,
    output logic [G+I+F-1:0] acc,    // state after the clock edge
    output logic [I-1:0]     out_v
);
    import guardbit_pkg::*;
    localparam int N = G + I + F;

    // Next state. Two bits more than the accumulator hold any sum of it and a signed step.
    localparam logic [N+1:0] LIMIT = {{(N+1){1'b0}}, 1'b1} << (I + F);
    wire [N-1:0] base = op == OP_LOAD ? {N{1'b0}} : acc;
    wire [N-1:0] addend = op == OP_LOAD ? init : op == OP_STEP_X ? dx : op == OP_STEP_Y ? dy : {N{1'b0}};
    wire signed_addend = addend[N-1] && !(G == 0 && op == OP_LOAD);
    wire [N+1:0] sum = {2'b00, base} + {{2{signed_addend}}, addend};
    wire below = sum[N+1];
    wire above = !below && sum >= LIMIT;
    wire [N-1:0] saturated = below ? {N{1'b0}} : above ? LIMIT[N-1:0] - 1'b1 : sum[N-1:0];

    always_ff @(posedge clk)
        if (rst) acc <= {N{1'b0}};
        else if (op != OP_HOLD) acc <= MODE == CLAMP_SATURATE ? saturated : sum[N-1:0];

    // Read-out: the guard and integer bits as a pattern u. GUARD splits the patterns above the
    // integer range in the middle: the lower half has come from above, the upper from below.
    localparam logic [G+I:0] ONE = {{(G+I){1'b0}}, 1'b1};
    localparam logic [G+I:0] WHOLE = ONE << I;
    localparam logic [G+I:0] MIDDLE = (ONE << (G + I - 1)) + (ONE << (I - 1));
    wire [G+I:0] u = {1'b0, acc[N-1:F]};
    wire outside = u >= WHOLE;
    wire low = MODE == CLAMP_GUARD ? outside && u >= MIDDLE : MODE == CLAMP_SIGN && acc[N-1];
    wire high = (MODE == CLAMP_GUARD || MODE == CLAMP_SIGN) && outside && !low;
    assign out_v = low ? {I{1'b0}} : high ? {I{1'b1}} : u[I-1:0];
endmodule

// Walks an edge function: start, then steps of its two coefficients; inside is a clear sign bit.
module edge_stepper #(
    parameter int M = guardbit_pkg::EDGE_EXP_E_WIDTH
) (
    input  logic         clk,
    input  logic         rst,
    input  logic [1:0]   op,     // 0 load, 1 step by ea, 2 step by eb, 3 hold
    input  logic [M-1:0] e0,
    input  logic [M-1:0] ea,
    input  logic [M-1:0] eb,
    output logic [M-1:0] e,      // state after the clock edge
    output logic         in_v
);
    import guardbit_pkg::*;

    always_ff @(posedge clk)
        if (rst) e <= {M{1'b0}};
        else
            case (op)
                OP_LOAD: e <= e0;
                OP_STEP_X: e <= e + ea;
                OP_STEP_Y: e <= e + eb;
                default: ;
            endcase

    assign in_v = ~e[M-1];
endmodule

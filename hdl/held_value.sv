// What a read-out sees of an accumulator: wrapped, then clamped to the range of the bits below the guard
// bits. A signed value is moved up by half of the range before, and down after. Spec: CH-2, G-1.
module held_value #(
    parameter int G = 1,                 // guard bits
    parameter int I = 24,                // bits below them
    parameter int MODE = 1,              // read-out: 0 wrap, 1 guard, 2 sign
    parameter int SIGNED = 0             // 1: the range is that of two's complement
) (
    input  logic [G+I-1:0] acc,
    output logic [I-1:0]   held
);
    localparam int GUARD = 1, SIGN = 2;
    localparam logic [G+I:0] ONE = {{(G+I){1'b0}}, 1'b1};
    localparam logic [G+I:0] WHOLE = ONE << I;
    localparam logic [G+I:0] MIDDLE = (ONE << (G + I - 1)) + (ONE << (I - 1));
    localparam logic [G+I:0] OFFSET = SIGNED != 0 ? ONE << (I - 1) : '0;
    wire [G+I-1:0] moved = acc + OFFSET[G+I-1:0];
    wire [G+I:0] u = {1'b0, moved};
    wire outside = u >= WHOLE;
    wire low = MODE == GUARD ? outside && u >= MIDDLE : MODE == SIGN && moved[G+I-1];
    wire high = (MODE == GUARD || MODE == SIGN) && outside && !low;
    wire [I-1:0] clamped = low ? {I{1'b0}} : high ? {I{1'b1}} : moved[I-1:0];
    assign held = clamped - OFFSET[I-1:0];
endmodule

// A Newton step towards 1 / x: from y of M bits to one of B bits. Spec: CH-12.
module newton_step #(
    parameter int P = 20,                // bits of x, P - 1 of them below its one
    parameter int M = 10,                // bits of y
    parameter int B = 18                 // bits of the result
) (
    input  logic [P-1:0] x,
    input  logic [M-1:0] y,
    output logic [B:0]   r,              // x y, cut to B bits below its one
    output logic [B+1:0] t,              // 2 - r
    output logic [B-1:0] next
);
    /* verilator lint_off UNUSED */
    wire [P+M-1:0] xy = {{M{1'b0}}, x} * {{P{1'b0}}, y};
    wire [P+M+B-1:0] scaled = {xy, {B{1'b0}}} >> (P - 1 + M);
    wire [M+B+1:0] yt = {{(B+2){1'b0}}, y} * {{M{1'b0}}, t};
    /* verilator lint_on UNUSED */
    assign r = scaled[B:0];
    assign t = {2'b10, {B{1'b0}}} - {1'b0, r};
    wire [B+1:0] whole = yt[M+B+1:M];
    assign next = |whole[B+1:B] ? {B{1'b1}} : whole[B-1:0];
endmodule
